"""Archives and files that `vantage batch` is given by strangers."""

import io
import json
import math
import os
import pathlib
import signal
import struct
import subprocess
import tarfile
import threading
import time
import unittest
import zipfile

from hostile import FAST, TRIANGLE, gltf, HostileTest
from png import png
from program import PROGRAM
from program import contract_quickly as setUpModule
from shapes import box


class ArchivesOfStrangers(HostileTest):

    def test_names_marked_as_utf8_are_read_in_every_locale(self):
        names = ["plain.off", "Größe.off", "日本.off", "naïve.off"]
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            for i, name in enumerate(names):
                archive.writestr(name, box(1 + i))
        for locale in ("C", "C.UTF-8"):
            done = subprocess.run([PROGRAM, "batch", "m.zip", "-o", locale, *FAST], cwd=self.dir, capture_output=True,
                                  env={**os.environ, "LC_ALL": locale}, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sorted(self.rows(locale)), sorted("m.zip//" + name for name in names))
        self.assertEqual(self.vantage("results", "export", "C").out, self.vantage("results", "export", "C.UTF-8").out)

    def test_what_macos_adds_to_archives_and_folders_is_no_model(self):
        (self.dir / "in").mkdir()
        with zipfile.ZipFile(self.dir / "in/m.zip", "w") as archive:
            archive.writestr("m.off", box(1))
            archive.writestr("__MACOSX/._m.off", b"\0\5\x16\7")
            archive.writestr("__MACOSX/m.off", b"")
        self.write("in/n.off", box(2))
        self.write("in/._n.off", b"\0\5\x16\7")
        self.vantage("batch", "in", "-o", "out", *FAST, "--include", "*.zip", "--include", "*.off")
        self.assertEqual(list(self.rows()), ["in/m.zip//m.off", "in/n.off"])

    def test_an_archive_in_a_folder_is_read_where_a_pattern_names_it(self):
        (self.dir / "all/deep").mkdir(parents=True)
        with zipfile.ZipFile(self.dir / "all/deep/m.zip", "w") as archive:
            archive.writestr("a.off", box(1))
            archive.writestr("b.txt", "no model")
        self.write("all/c.off", box(2))
        self.vantage("batch", "all", "-o", "zip", *FAST, "--include", "*.zip")
        self.assertEqual(sorted(self.rows("zip")), ["all/deep/m.zip//a.off"])
        self.vantage("batch", "all", "-o", "both", *FAST, "--include", "*.zip", "--include", "*.off")
        self.assertEqual(sorted(self.rows("both")), ["all/c.off", "all/deep/m.zip//a.off"])

    def test_what_cannot_be_named_or_followed_is_recorded(self):
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            archive.writestr("ü.off", box(1))
            archive.writestr("a.off", box(2))
        data = (self.dir / "m.zip").read_bytes()
        self.write("m.zip", data.replace("ü.off".encode(), b"\xff\xfe.off"))  # marked as UTF-8, and none
        self.batch("m.zip", exit_code=4)
        rows = self.rows()
        self.assertEqual(len(rows), 2, rows.keys())
        [failed] = [row for row in rows.values() if row["status"] == "failed"]
        self.assertIn("name", failed["error"])
        with tarfile.open(self.dir / "m.tar", "w") as archive:
            for kind, name in ((tarfile.SYMTYPE, "link.off"), (tarfile.FIFOTYPE, "pipe.off"),
                               (tarfile.SYMTYPE, "notes.txt")):
                info = tarfile.TarInfo(name)
                info.type = kind
                info.linkname = "a.off"
                archive.addfile(info)
        self.batch("m.tar", exit_code=4, out="tar")
        self.assertEqual({k: r["status"] for k, r in self.rows("tar").items()},
                         {"m.tar//link.off": "failed", "m.tar//pipe.off": "failed"})

    def disturb(self, number, *flags):
        """A batch whose unpacker gets a signal while it is at an entry of 100 MB, between two small ones."""
        with tarfile.open(self.dir / "m.tar.gz", "w:gz", compresslevel=1) as archive:
            for name, content in (("a.off", box(1).encode()), ("slow.off", bytes(100_000_000)),
                                  ("b.off", box(2).encode())):
                info = tarfile.TarInfo(name)
                info.size = len(content)
                archive.addfile(info, io.BytesIO(content))
        process = subprocess.Popen([PROGRAM, "batch", "m.tar.gz", "-o", "out", *FAST, *flags], cwd=self.dir,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        disturbed = False
        while process.poll() is None and not disturbed:
            for entry in pathlib.Path("/proc").glob("[0-9]*"):
                try:
                    words = (entry / "cmdline").read_bytes().split(b"\0")
                    parent = (entry / "stat").read_text().rpartition(")")[2].split()[1]
                except OSError:
                    continue
                # in the middle of the slow entry, which is being written then
                if b"batch-unpack" in words and parent == str(process.pid) and list(
                        (self.dir / "out").glob(".work/local/in-*/slow.off")):
                    os.kill(int(entry.name), number)
                    disturbed = True
        process.wait(timeout=200)
        self.assertTrue(disturbed)
        rows = self.rows()
        self.assertEqual({key: row["status"] for key, row in rows.items()},
                         {"m.tar.gz//a.off": "done", "m.tar.gz//slow.off": "failed", "m.tar.gz//b.off": "done"})
        return rows["m.tar.gz//slow.off"]

    def test_a_killed_unpacker_costs_nothing_but_time(self):
        row = self.disturb(signal.SIGKILL)
        self.assertEqual(row["reason"], "input")  # it was unpacked in the end, and is no OFF
        self.assertNotIn("signal", row["error"])

    def test_an_unpacker_killed_as_often_as_tried_costs_its_entry(self):
        row = self.disturb(signal.SIGKILL, "--attempts", "1")
        self.assertEqual(row["reason"], "crash")
        self.assertIn("signal 9", row["error"])

    def test_an_unpacker_that_hangs_ends_at_the_time_limit_and_says_so(self):
        row = self.disturb(signal.SIGSTOP, "--attempts", "1", "--timeout", "8")
        self.assertEqual(row["reason"], "timeout")
        self.assertIn("time limit of 8 s", row["error"])

    def test_a_sparse_entry_is_not_blown_up(self):
        def sparse(name, size):
            path = self.dir / name
            with path.open("wb") as file:
                file.write(box(1).encode())
                file.truncate(size)
            return path
        sparse("huge.off", 7 << 30)
        sparse("large.off", 200 << 20)
        subprocess.run(["tar", "--sparse", "-cf", "m.tar", "huge.off", "large.off"], cwd=self.dir, check=True)
        self.assertLess((self.dir / "m.tar").stat().st_size, 50_000)
        written = []
        done = threading.Event()

        def watch():
            while not done.wait(0.005):
                for path in (self.dir / "out").glob(".work/local/in-*/*"):
                    try:
                        written.append((path.name, path.stat().st_blocks * 512))
                    except OSError:
                        pass
        watcher = threading.Thread(target=watch)
        watcher.start()
        self.batch("m.tar", exit_code=4)
        done.set()
        watcher.join()
        self.assertIn("larger than 256 MB", self.rows()["m.tar//huge.off"]["error"])
        self.assertLess(max((size for _, size in written), default=0), 1 << 20)

    def test_not_many_unpacked_copies_wait_for_an_equal_one(self):
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            for i in range(300):
                archive.writestr(f"{i:03}.off", box(1))
        process = subprocess.Popen([PROGRAM, "batch", "m.zip", "-o", "out", *FAST, "--timeout", "15", "--attempts", "1"],
                                   cwd=self.dir, env={**os.environ, "VANTAGE_TEST_FAULT": "hang:000"},
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        most = 0
        while process.poll() is None:
            most = max(most, len(list((self.dir / "out").glob(".work/local/in-*"))))
            time.sleep(0.01)
        self.assertLessEqual(most, 64)
        self.assertGreater(most, 8)
        self.assertEqual(len(self.rows()), 300)

    def test_an_archive_that_is_a_pipe_or_never_ends_fails_at_once(self):
        os.mkfifo(self.dir / "pipe.zip")
        os.symlink("/dev/zero", self.dir / "zero.tar")
        self.batch("pipe.zip", "zero.tar", exit_code=4)
        for row in self.rows().values():
            self.assertIn("not a regular file", row["error"])


class Inputs(HostileTest):

    def test_of_two_rows_with_one_key_the_first_counts_in_every_run(self):
        self.write("a.off", box(1))
        self.write("m.csv", "path,key,name\na.off,k,first\na.off,k,second\n")
        for skipped in (0, 1, 1):
            done = self.vantage("batch", "--manifest", "m.csv", "-o", "r", *FAST, "--json")
            counts = json.loads(done.out)
            self.assertEqual((counts["skipped"], counts["repeated"]), (skipped, 1), done.out)
            self.assertEqual(self.rows("r")["k"]["name"], "first")

    def test_a_folder_without_models_is_told(self):
        (self.dir / "in").mkdir()
        self.write("in/notes.txt", "none")
        self.assertIn("no models were found in 'in'", self.vantage("batch", "in", "-o", "out").err)
        self.write("in/a.off", box(1))
        for _ in range(2):
            self.assertNotIn("no models", self.vantage("batch", "in", "-o", "out", *FAST).err)

    def test_a_buffer_outside_the_models_folder_is_never_read(self):
        (self.dir / "in").mkdir()
        self.write("secret.bin", TRIANGLE)
        os.symlink(self.dir / "secret.bin", self.dir / "in/link.bin")
        os.symlink(self.dir / "secret.bin", self.dir / "in/abs.bin")
        uris = ["../secret.bin", "%2e%2e/secret.bin", str(self.dir / "secret.bin"), "link.bin", "/etc/hostname",
                "/proc/self/environ", "/proc/kmsg"]
        for i, uri in enumerate(uris):
            self.write(f"in/{i}.gltf", gltf(uri))
        began = time.monotonic()
        self.batch("in", "--timeout", "30", exit_code=4)
        self.assertLess(time.monotonic() - began, 60)  # /proc/kmsg waits for ever
        rows = self.rows()
        for i in range(len(uris)):
            row = rows[f"in/{i}.gltf"]
            self.assertEqual((row["status"], row["reason"]), ("failed", "input"), uris[i])
            import hashlib
            alone = hashlib.sha256((self.dir / f"in/{i}.gltf").read_bytes()).hexdigest()
            self.assertEqual(row["content"], alone, uris[i])

    def test_a_buffer_that_changes_makes_a_new_content(self):
        (self.dir / "in/below").mkdir(parents=True)
        os.symlink("below/real.bin", self.dir / "in/own.bin")
        self.write("in/below/real.bin", TRIANGLE)
        self.write("in/a.gltf", gltf("own.bin"))
        self.batch("in")
        before = self.rows()["in/a.gltf"]["content"]
        self.write("in/below/real.bin", struct.pack("<9f", 0, 0, 0, 2, 0, 0, 0, 1, 0))
        self.batch("in")
        self.assertNotEqual(self.rows()["in/a.gltf"]["content"], before)

    def textured(self, name, library, folder, colour):
        """A triangle in folder `name` whose library, in `folder` below that, names a picture beside it."""
        place = self.dir / name / folder
        place.mkdir(parents=True, exist_ok=True)
        self.write(f"{name}/m.obj", f"mtllib {library}\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
        for file in ("a.mtl", "b.mtl"):
            material = "m" if file == library.replace("\\", "/").split("/")[-1].split()[-1] else "other"
            (place / file).write_text(f"newmtl {material}\nmap_Kd t.png\n")
        (place / "t.png").write_bytes(png(colour))

    def test_models_whose_pictures_differ_are_not_called_equal(self):
        cases = (("mats/a.mtl", "mats"), ("a.mtl b.mtl", "."), (".\\mats\\a.mtl", "mats"))
        for i, (library, folder) in enumerate(cases):
            self.textured(f"{i}/red", library, folder, (200, 0, 0, 255))
            self.textured(f"{i}/blue", library, folder, (0, 0, 200, 255))
            self.textured(f"{i}/same", library, folder, (0, 0, 200, 255))
            self.batch(f"{i}/red", f"{i}/blue", f"{i}/same", out=f"out{i}")
            rows = self.rows(f"out{i}")
            self.assertEqual([rows[f"{i}/{name}/m.obj"]["duplicate_of"] for name in ("red", "blue", "same")],
                             ["", "", f"{i}/blue/m.obj"], library)

    def test_equal_bytes_of_other_endings_are_other_models(self):
        (self.dir / "in").mkdir()
        turns = [(i, 2.4 * i, 1 - (2 * i + 1) / 200) for i in range(200)]
        points = "".join(f"{math.cos(a) * math.sqrt(1 - z * z)} {math.sin(a) * math.sqrt(1 - z * z)} {z}\n"
                         for _, a, z in turns)
        for name in ("a.off", "b.xyz", "c.XYZ"):
            self.write(f"in/{name}", points)
        self.batch("in", exit_code=4)
        rows = self.rows()
        self.assertEqual([rows[f"in/{name}"]["status"] for name in ("a.off", "b.xyz", "c.XYZ")],
                         ["failed", "done", "done"])
        self.assertEqual(rows["in/c.XYZ"]["duplicate_of"], "in/b.xyz")

    def test_a_sidecar_that_is_mended_is_tried_again(self):
        (self.dir / "in").mkdir()
        self.write("in/a.off", box(1))
        self.write("in/a.off.vantage.json", '{"uq": "y"}')
        self.batch("in", exit_code=4)
        self.assertIn("uq", self.rows()["in/a.off"]["error"])
        self.write("in/a.off.vantage.json", "{}")
        self.batch("in")
        self.assertEqual(self.rows()["in/a.off"]["status"], "done")

    def test_a_picture_or_library_that_changes_makes_a_new_content(self):
        self.textured("in", "mats\\a.mtl", "mats", (200, 0, 0, 255))
        contents = []
        for change in (lambda: None, lambda: self.write("in/mats/t.png", png((9, 9, 9, 255))),
                       lambda: self.write("in/mats/a.mtl", "newmtl m\nKd 0 1 0\n"), (self.dir / "in/mats/a.mtl").unlink):
            change()
            self.batch("in")
            contents.append(self.rows()["in/m.obj"]["content"])
        self.assertEqual(len(set(contents)), 4, contents)

    def test_a_model_whose_files_are_as_they_were_is_not_read_again(self):
        def counts():
            counts = json.loads(self.batch("in", "--json").out)
            return counts["done"], counts["skipped"]

        self.textured("in", "mats/a.mtl", "mats", (200, 0, 0, 255))
        self.assertEqual(counts(), (1, 0))
        self.assertEqual(counts(), (0, 1))
        os.utime(self.dir / "in/mats/t.png", (1, 1))  # read again, and found to be what it was
        self.assertEqual(counts(), (0, 1))
        self.write("in/mats/t.png", png((9, 9, 9, 255)))
        self.assertEqual(counts(), (1, 0))
        self.assertEqual(counts(), (0, 1))

    def test_what_is_no_regular_file_fails_at_once(self):
        (self.dir / "in").mkdir()
        os.mkfifo(self.dir / "in/pipe.off")
        os.symlink("/dev/zero", self.dir / "in/zero.off")
        os.mkfifo(self.dir / "in/buffer.bin")
        self.write("in/a.gltf", gltf("buffer.bin"))
        began = time.monotonic()
        self.batch("in", "--timeout", "60", "--attempts", "3", exit_code=4)
        self.assertLess(time.monotonic() - began, 60)
        rows = self.rows()
        for key in ("in/pipe.off", "in/zero.off"):
            self.assertEqual(rows[key]["reason"], "input")
            self.assertIn("not a regular file", rows[key]["error"])
        self.assertEqual(rows["in/a.gltf"]["reason"], "input")

    def test_a_planned_line_with_a_wrong_axis_fails_alone(self):
        self.write("a.off", box(1))
        plan = "".join(json.dumps({"planned": True, "path": str(self.dir / "a.off"), "key": key, "up": up, "shard": 7})
                       + "\n" for key, up in (("a", "evil"), ("b", "x")))
        self.write("plan", plan)
        self.batch("--manifest", "plan", exit_code=4)
        rows = self.rows()
        self.assertEqual((rows["a"]["status"], rows["b"]["status"]), ("failed", "done"))
        self.assertIn('line 1 of the manifest has an "up"', rows["a"]["error"])

    def test_a_planned_line_of_no_shard_is_lost_in_none(self):
        self.write("a.off", box(1))
        self.write("plan", json.dumps({"planned": True, "path": str(self.dir / "a.off"), "key": "a", "shard": 99}))
        for shard in ("0/2", "1/2"):
            self.batch("--manifest", "plan", "--shard", shard)
        self.vantage("results", "merge", "out")
        self.assertEqual(list(self.rows()), ["a"])

    def test_a_file_that_is_replaced_while_it_is_read_is_not_taken_for_what_it_was(self):
        import hashlib
        (self.dir / "in").mkdir()
        path = self.dir / "in/a.off"
        stop = threading.Event()

        def replace():
            i = 0
            while not stop.is_set():
                i += 1
                (self.dir / "next").write_text(box(1 + i % 50))
                os.replace(self.dir / "next", path)
        replacer = threading.Thread(target=replace)
        path.write_text(box(1))
        replacer.start()
        widths = {hashlib.sha256(box(1 + i).encode()).hexdigest(): 1 + i for i in range(51)}
        try:
            for i in range(4):
                self.batch("in", "--attempts", "5", exit_code=None)
                for row in self.rows().values():
                    if row["status"] == "done":
                        # the camera looks at the middle of the box
                        self.assertAlmostEqual(2 * row["camera"]["target"][0], widths[row["content"]], delta=0.1)
        finally:
            stop.set()
            replacer.join()

    def test_a_slow_writer_of_the_list_keeps_no_model_waiting(self):
        self.write("a.off", box(1))
        process = subprocess.Popen([PROGRAM, "batch", "--manifest", "-", "-o", "out", *FAST], cwd=self.dir,
                                   stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        process.stdin.write(b"a.off\n")
        process.stdin.flush()
        end = time.monotonic() + 100
        while not list((self.dir / "out").glob("models/*/view.json")) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertTrue(list((self.dir / "out").glob("models/*/view.json")))
        self.assertIsNone(process.poll())  # the list goes on
        process.communicate(timeout=100)
        self.assertEqual(process.returncode, 0)

    def test_archives_are_not_shared_out_by_slurm(self):
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            archive.writestr("a.off", box(1))
        done = self.vantage("batch", "m.zip", "-o", "out", "--engine", "slurm", "--detach", exit_code=3)
        self.assertIn("unpack it first", done.err)
        self.assertEqual(len(done.err.splitlines()), 1, done.err)

    def test_odd_output_folders_and_long_names_work(self):
        long = "x" * 251
        self.write(long + ".off", box(1))
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            archive.writestr("d" * 240 + "/" + long + ".off", box(2))
            archive.writestr("y" * 400 + ".off", box(3))
        for i, out in enumerate(("new\nline", "tab\tquote'\"", "per%cent %a", "z" * 250)):
            self.batch(long + ".off", "m.zip", "--name", "{parent}-{stem}", out=out)
            self.assertEqual({row["status"] for row in self.rows(out).values()}, {"done"}, out)
            self.vantage("results", "export", out, "-o", f"{i}" + "e" * 250)
            self.assertTrue((self.dir / (f"{i}" + "e" * 250)).exists())


if __name__ == "__main__":
    unittest.main()
