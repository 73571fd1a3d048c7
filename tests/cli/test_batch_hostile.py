"""vantage batch and results where folders, stores, archives and lists were made to do harm."""

import csv
import io
import json
import os
import pathlib
import shutil
import signal
import sqlite3
import struct
import subprocess
import tarfile
import threading
import time
import unittest
import zipfile

from program import PROGRAM, ProgramTest
from shapes import box

FAST = ["--search", "rapid", "--write", "json", "--jobs", "2"]
TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def gltf(*uris):
    return json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": uri} for uri in uris]})


class HostileTest(ProgramTest):

    def setUp(self):
        super().setUp()
        self.victim = self.dir / "victim"
        self.victim.mkdir()
        (self.victim / "thesis.txt").write_text("mine")
        (self.victim / "local").mkdir()
        (self.victim / "local" / "notes.txt").write_text("mine")
        self.before = self.state_of(self.victim)

    @staticmethod
    def state_of(folder):
        return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in folder.rglob("*")}

    def assert_untouched(self):
        self.assertEqual(self.state_of(self.victim), self.before)

    def batch(self, *arguments, exit_code=0, out="out", **more):
        return self.vantage("batch", *arguments, "-o", out, *FAST, exit_code=exit_code, **more)

    def rows(self, out="out"):
        text = self.vantage("results", "export", out, "--format", "jsonl").out
        return {row["key"]: row for row in map(json.loads, text.splitlines())}

    def change_store(self, sql, out="out"):
        with sqlite3.connect(self.dir / out / "results.sqlite") as store:
            store.executescript(sql)
        store.close()


class Folders(HostileTest):
    """Nothing outside the results' folder is written or removed, whatever that holds."""

    def test_a_folder_that_the_store_names_outside_is_not_removed(self):
        for name in ("../../victim", "../victim", str(self.victim), "x/../../../victim", ".", "", ".."):
            with self.subTest(name=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.write("a.off", box(1))
                self.batch("a.off")
                self.change_store(f"UPDATE models SET folder = '{name}'")
                self.write("a.off", box(2))
                self.batch("a.off")
                self.assert_untouched()
                self.assertEqual(self.rows()["a.off"]["status"], "done")

    def test_a_folder_inside_that_holds_no_results_is_not_removed(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        (self.dir / "out/models/mine").mkdir()
        self.write("out/models/mine/thesis.txt", "mine")
        self.change_store("UPDATE models SET folder = 'mine'")
        self.write("a.off", box(2))
        self.batch("a.off")
        self.assertTrue((self.dir / "out/models/mine/thesis.txt").exists())

    def test_a_folder_that_a_shard_names_outside_is_not_removed(self):
        self.write("a.off", box(1))
        for name in (str(self.victim), "../../victim"):
            with self.subTest(name=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.write("b.off", box(3))
                self.batch("a.off", "b.off", "--shard", "0/1")
                [file] = (self.dir / "out/shards").glob("*.jsonl")
                first, second = file.read_text().splitlines()
                file.write_text(first + "\n" + json.dumps({**json.loads(second), "folder": name}) + "\n")
                self.write("b.off", box(2))
                self.batch("a.off", "b.off", "--shard", "0/1")
                self.vantage("results", "merge", "out")
                self.assert_untouched()

    def test_no_link_in_the_folder_is_written_or_removed_through(self):
        self.write("a.off", box(1))
        inside = ("results.sqlite", ".work", "models", "index.html")
        for name in inside:
            with self.subTest(link=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.batch("a.off")
                path = self.dir / "out" / name
                shutil.rmtree(path) if path.is_dir() else path.unlink()
                path.symlink_to(self.victim if name in (".work", "models") else self.victim / "thesis.txt")
                self.write("a.off", box(2))
                done = self.batch("a.off", exit_code=None)
                self.assertIn(done.returncode, (1, 4), name)
                self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                self.assert_untouched()
                self.write("a.off", box(1))

    def test_no_link_in_place_of_a_lock_a_log_or_a_part_is_written_through(self):
        self.write("a.off", box(1))
        target = self.victim / "thesis.txt"
        for name in (".work/shard-0-of-1.lock", "shards/shard-00000-of-00001.jsonl.log",
                     "shards/shard-00000-of-00001.jsonl", ".work/shard-0-of-1.part", ".work/shard-0-of-1"):
            with self.subTest(link=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.batch("a.off", "--shard", "0/1")
                path = self.dir / "out" / name
                if path.exists():
                    path.unlink()
                path.symlink_to(self.victim if name.endswith("1") else target)
                self.write("a.off", box(2))
                self.batch("a.off", "--shard", "0/1", exit_code=None)
                self.assert_untouched()

    def test_a_model_whose_place_is_a_link_fails_alone(self):
        self.write("a.off", box(1))
        self.write("b.off", box(2))
        self.batch("a.off", "b.off", "--name", "{stem}/{stem}")
        shutil.rmtree(self.dir / "out/models/a")
        (self.dir / "out/models/a").symlink_to(self.victim)
        self.write("a.off", box(3))
        self.write("b.off", box(4))
        self.batch("a.off", "b.off", "--name", "{stem}/{stem}", exit_code=4)
        self.assertEqual({k: r["status"] for k, r in self.rows().items()}, {"a.off": "failed", "b.off": "done"})
        self.assert_untouched()

    def test_the_folder_itself_may_be_a_link(self):
        (self.dir / "disk").mkdir()
        (self.dir / "out").symlink_to("disk")
        self.write("a.off", box(1))
        self.batch("a.off")
        self.assertTrue((self.dir / "disk/index.html").exists())


class ForeignFiles(HostileTest):
    """A folder is a batch's only if it holds its records; in it only its own files are replaced."""

    def assert_refused(self, *command, pattern="", exit_code=1):
        before = self.state_of(self.dir / "out")
        done = self.vantage(*command, exit_code=exit_code)
        self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
        self.assertRegex(done.err, pattern)
        after = self.state_of(self.dir / "out")
        self.assertEqual({name: after.get(name) for name in before}, before)

    def test_names_that_a_batch_uses_make_no_folder_its_own(self):
        self.write("a.off", box(1))
        for name in ("shards/mine.txt", ".work/mine.txt", "models/mine.txt", "results.sqlite",
                     "shards/shard-00000-of-00001.jsonl"):
            for index in ("index.html", "index-2.html", "contact-sheet-0001.png"):
                with self.subTest(name=name):
                    shutil.rmtree(self.dir / "out", ignore_errors=True)
                    (self.dir / "out" / name).parent.mkdir(parents=True)
                    self.write(f"out/{name}", "mine, not yours\n")
                    self.write(f"out/{index}", "mine")
                    self.assert_refused("batch", "a.off", "-o", "out", *FAST, pattern="choose another folder")
                    self.assert_refused("results", "merge", "out", pattern="choose another folder")

    def test_a_database_of_something_else_is_left_alone(self):
        self.write("a.off", box(1))
        (self.dir / "out").mkdir()
        with sqlite3.connect(self.dir / "out/results.sqlite") as store:
            store.execute("CREATE TABLE exams(grade)")
        store.close()
        for command in (("batch", "a.off", "-o", "out"), ("results", "merge", "out"), ("results", "export", "out")):
            self.assert_refused(*command, pattern="not of results of a batch", exit_code=None)

    def test_a_page_or_a_sheet_of_somebody_else_is_neither_replaced_nor_removed(self):
        self.write("a.off", box(1))
        self.batch("a.off", "--no-overview")
        for name in ("index.html", "contact-sheet-0001.png"):
            self.write(f"out/{name}", "mine")
            self.write("a.off", box(2))
            self.assert_refused("batch", "a.off", "-o", "out", *FAST, pattern="--no-overview")
            self.assert_refused("results", "merge", "out", pattern="--no-overview")
            (self.dir / "out" / name).unlink()
        for name in ("index-2.html", "contact-sheet-0002.png"):
            self.write(f"out/{name}", "mine")
        self.batch("a.off")
        for name in ("index-2.html", "contact-sheet-0002.png"):
            self.assertEqual((self.dir / "out" / name).read_text(), "mine")

    def test_results_are_not_put_in_the_place_of_somebody_elses_folder(self):
        self.write("a.off", box(1))
        self.batch("a.off", "--name", "{stem}")
        shutil.rmtree(self.dir / "out/models/a")
        (self.dir / "out/models/a").mkdir()
        self.write("out/models/a/thesis.txt", "mine")
        self.write("a.off", box(2))
        self.batch("a.off", "--name", "{stem}", exit_code=4)
        self.assertEqual(self.rows()["a.off"]["reason"], "name")
        self.assertEqual((self.dir / "out/models/a/thesis.txt").read_text(), "mine")

    def test_files_whose_names_end_like_ours_are_kept(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        names = ("e2.csv.part", ".e2.csv.part.77777", "out/.notes.part.77777", "out/.index.html.part.77777")
        for name in names:
            self.write(name, "mine")
        self.vantage("results", "export", "out", "-o", "e2.csv")
        self.write("a.off", box(2))
        self.batch("a.off")
        self.vantage("results", "merge", "out")
        for name in names:
            self.assertEqual((self.dir / name).read_text(), "mine", name)

    def test_what_a_killed_run_left_is_removed_by_the_next_one(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        self.write("out/.work/local.part", "<!doctype")
        (self.dir / "out/.work/local").mkdir()
        self.write("out/.work/local/x", "")
        self.write("a.off", box(2))
        self.batch("a.off")
        self.assertEqual([p.name for p in (self.dir / "out/.work").iterdir()], ["local.lock"])
        self.assertEqual([p.name for p in (self.dir / "out").iterdir() if ".part" in p.name], [])


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
        self.batch("in", "--verify")
        self.assertNotEqual(self.rows()["in/a.gltf"]["content"], before)

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


class StoresOfStrangers(HostileTest):

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1))
        self.write("b.off", box(2))
        self.batch("a.off", "b.off", out="evil")

    def change(self, sql):
        self.change_store(sql, "evil")

    def test_a_row_that_is_no_record_is_left_out_of_a_merge(self):
        for column, value in (("folder", "'../../victim'"), ("folder", "'/etc'"), ("status", "'fine'"),
                              ("result", "'{'"), ("result", f"'{'[' * 100_000}'"), ("folder", "'a//b'")):
            with self.subTest(value=value[:20]):
                shutil.rmtree(self.dir / "all", ignore_errors=True)
                (self.dir / "all").mkdir()
                self.batch("a.off", "b.off", "--verify", out="evil")
                self.change(f"UPDATE models SET {column} = {value} WHERE key = 'a.off'")
                done = self.vantage("results", "merge", "all", "evil")
                self.assertIn("1 line", done.err)
                self.assertEqual(list(self.rows("all")), ["b.off"])
                shutil.rmtree(self.dir / "evil")
        self.assert_untouched()

    def test_text_that_is_no_utf8_is_exported_all_the_same(self):
        self.change("UPDATE models SET name = CAST(x'ff80' AS TEXT) WHERE key = 'a.off'")
        for command in (("export", "--format", "jsonl"), ("export",), ("query", "--json"), ("query",)):
            done = subprocess.run([PROGRAM, "results", command[0], "evil", *command[1:]], cwd=self.dir,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.write("a.off", box(3))
        self.batch("a.off", out="evil")
        self.vantage("results", "merge", "evil")

    def test_nothing_that_the_schema_says_is_run(self):
        self.change("DROP VIEW results; CREATE VIEW results AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 "
                    "FROM n) SELECT i AS key FROM n")
        self.assertEqual(len(self.rows("evil")), 2)
        self.change("CREATE TRIGGER t AFTER INSERT ON models BEGIN DELETE FROM models; END")
        done = self.vantage("results", "merge", "all", "evil", exit_code=3)
        self.assertIn("not of results of a batch", done.err)

    def test_shard_files_may_hold_anything(self):
        self.batch("a.off", "b.off", "--shard", "0/1", out="s")
        file = self.dir / "s/shards/shard-00000-of-00001.jsonl"
        records = file.read_text().splitlines()
        odd = [b"", b"{}", b"[" * 1_000_000, b'{"a":' * 200_000, b"\xff\xfe", b'"' * 17_000_000, b"null", b"1e999",
               json.dumps({**json.loads(records[0]), "key": "", "folder": "x"}).encode(),
               json.dumps({**json.loads(records[0]), "key": "c", "stamp": []}).encode(),
               json.dumps({**json.loads(records[0]), "key": "d", "folder": "../../victim"}).encode(),
               json.dumps({**json.loads(records[0]), "key": "e", "timings": {"seconds": 1e308}}).encode()]
        file.write_bytes(b"\n".join([records[0].encode(), *odd, records[1].encode()]) + b"\n")
        for command in (("results", "merge", "s", "--max-memory", "500MB"),
                        ("batch", "a.off", "b.off", "-o", "s", *FAST, "--shard", "0/1")):
            self.vantage(*command)
        self.vantage("results", "merge", "s")
        self.assertEqual(sorted(self.rows("s")), ["a.off", "b.off"])
        self.assert_untouched()

    def test_a_shard_file_that_is_a_pipe_or_never_ends_is_refused(self):
        for make in (os.mkfifo, lambda path: os.symlink("/dev/zero", path)):
            self.batch("a.off", "--shard", "0/2", exit_code=None, out="p")
            make(self.dir / "p/shards/shard-00001-of-00002.jsonl")
            done = self.vantage("results", "merge", "p", "--timeout", "60", exit_code=3)
            self.assertIn("not a regular file", done.err)
            shutil.rmtree(self.dir / "p")

    def test_small_pictures_that_are_pipes_or_links_do_not_stop_the_page(self):
        folder = self.dir / "evil/models" / self.rows("evil")["a.off"]["folder"]
        os.mkfifo(folder / "thumb.png")
        self.write("b.off", box(5))
        self.batch("a.off", "b.off", "--timeout", "60", out="evil")
        self.assertTrue((self.dir / "evil/index.html").exists())

    def test_an_index_of_more_than_one_page_holds_every_row_once(self):
        rows = 60_001
        with sqlite3.connect(self.dir / "evil/results.sqlite") as store:
            columns = [row[1] for row in store.execute("PRAGMA table_info(models)")]
            copied = ", ".join("'k' || n" if c == "key" else "'c' || n" if c == "content" else c for c in columns)
            store.execute(f"""INSERT INTO models WITH RECURSIVE i(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM i WHERE n < {rows - 2})
                              SELECT {copied} FROM models, i WHERE key = 'a.off'""")
        store.close()
        self.vantage("results", "merge", "evil")
        keys = []
        for page in ("index.html", "index-2.html"):
            text = (self.dir / "evil" / page).read_text()
            data = text.partition('id="data">')[2].partition("</script>")[0]
            keys += [row[0] for row in json.loads(data)["rows"]]
        self.assertEqual(len(keys), rows)
        self.assertEqual(len(set(keys)), rows)
        self.assertFalse((self.dir / "evil/index-3.html").exists())
        self.change(f"DELETE FROM models WHERE key LIKE 'k%'")
        self.vantage("results", "merge", "evil")
        self.assertFalse((self.dir / "evil/index-2.html").exists())


class Output(HostileTest):

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1))
        self.batch("a.off")

    def test_a_full_standard_output_is_no_success(self):
        for command in (("results", "export", "out"), ("results", "export", "out", "--format", "jsonl"),
                        ("results", "export", "out", "-o", "/dev/full"),
                        ("results", "query", "out"), ("results", "query", "out", "--json"),
                        ("results", "diff", "out", "out"), ("results", "merge", "out"),
                        ("results", "merge", "out", "--json"), ("batch", "a.off", "-o", "out", "--json")):
            with self.subTest(command=command), open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *command], cwd=self.dir, stdout=full, stderr=subprocess.PIPE, check=False)
                self.assertEqual(done.returncode, 75, done.stderr)
                self.assertRegex(done.stderr.decode(), "cannot be written.*No space left")
                self.assertTrue(pathlib.Path("/dev/full").is_char_device())

    def test_cells_that_a_spreadsheet_would_compute_are_text_in_csv_and_exact_in_json(self):
        (self.dir / "in").mkdir()
        names = ["=1+1", "+1", "-1", "@sum", "\tx", "plain"]
        lines = "".join(json.dumps({"path": "a.off", "key": name, "name": name}) + "\n" for name in names)
        self.write("list", lines)
        self.batch("--manifest", "list", out="o")
        table = list(csv.DictReader(io.StringIO(self.vantage("results", "export", "o").out, newline="")))
        self.assertEqual(sorted(row["name"] for row in table), sorted("'" + n if n != "plain" else n for n in names))
        for row in table:
            for name, cell in row.items():
                self.assertFalse(cell[:1] in "=@+\t" and cell, (name, cell))
        self.assertTrue(any(float(row[c]) < 0 for row in table for c in ("best_dx", "best_dy", "best_dz", "worst_dx",
                                                                         "worst_dy", "worst_dz")))
        self.assertEqual({row["name"] for row in self.rows("o").values()}, set(names))


if __name__ == "__main__":
    unittest.main()
