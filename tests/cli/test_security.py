"""What SECURITY.md promises, with the real program: limits, paths, names, full disks, killed runs, the network."""

import base64
import http.server
import json
import os
import pathlib
import re
import resource
import signal
import struct
import subprocess
import threading
import time
import unittest
import zipfile

from png import png, read_png
from program import MODELS, PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAST = ("--search", "rapid")
TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def gltf(uri, image=None):
    scene = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
             "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": uri}]}
    if image is not None:
        scene["images"] = [{"uri": image}]
        scene["textures"] = [{"source": 0}]
        scene["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        scene["meshes"][0]["primitives"][0]["material"] = 0
        scene["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 1
        scene["accessors"].append({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"})
    return json.dumps(scene)


class Limits(ProgramTest):

    def test_a_run_that_needs_more_memory_than_allowed_ends_in_one_sentence_and_leaves_nothing(self):
        for limit in ("64MB", "100MB"):
            done = self.vantage("view", MODELS / "mannequin.ply", "-o", "out", "--max-memory", limit, *FAST, exit_code=None)
            self.assertIn(done.returncode, (1, 3), (limit, done.err))
            self.assertEqual(len(done.err.strip().splitlines()), 1, (limit, done.err))
            self.assertRegex(done.err, "memory", limit)
            self.assertFalse((self.dir / "out").exists(), limit)

    def test_a_batch_that_needs_more_memory_says_so_and_does_not_wait_for_its_time_limit(self):
        for limit in ("64MB", "100MB"):  # the library for rays could wait for itself for ever
            done = self.vantage("batch", MODELS / "mannequin.ply", "-o", f"out{limit}", "--max-memory", limit, "--timeout", "60",
                                "--attempts", "1", *FAST, exit_code=None)
            self.assertEqual(done.returncode, 4, (limit, done.err))
            self.assertIn("memory", done.err, limit)
            self.assertNotIn("time limit", done.err, limit)

    def test_enough_memory_changes_no_byte(self):
        self.write("m.off", box(1))
        for out, limit in (("a", ()), ("b", ("--max-memory", "4GB", "--timeout", "600"))):
            self.vantage("view", "m.off", "-o", out, "--no-images", *FAST, *limit)
        self.assertEqual((self.dir / "a/view.json").read_bytes(), (self.dir / "b/view.json").read_bytes())

    def test_a_small_file_of_many_instances_takes_little_memory(self):
        points = b"".join(struct.pack("<3f", i % 10, i // 10 % 10, i // 100) for i in range(1000))
        corners = b"".join(struct.pack("<3H", i, (i + 1) % 1000, (i + 7) % 1000) for i in range(1000))
        for count, exit_code in ((480, 0), (2000, 3)):
            self.write("m.gltf", json.dumps({
                "asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(count))}], "nodes": [{"mesh": 0}] * count,
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1000, "type": "VEC3"},
                              {"bufferView": 1, "componentType": 5123, "count": 3000, "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteLength": 12000},
                                {"buffer": 0, "byteOffset": 12000, "byteLength": 6000}],
                "buffers": [{"byteLength": 18000, "uri": "data:application/octet-stream;base64," +
                             base64.b64encode(points + corners).decode()}]}))
            self.assertLess((self.dir / "m.gltf").stat().st_size, 70_000)
            self.vantage("info", "m.gltf", "--max-memory", "200MB", exit_code=exit_code)

    def test_more_faces_than_allowed_are_refused_in_one_sentence_by_every_command(self):
        self.write("m.off", box(1))
        self.write("eyes.csv", "dx,dy,dz\n0,0,1\n")
        commands = (("info", "m.off"), ("view", "m.off", "-o", "out"), ("thumb", "m.off", "m.png"),
                    ("render", "m.off", "-o", "m.png", "--view", "best"), ("map", "m.off", "-o", "m.ply"),
                    ("skeleton", "m.off", "-o", "m.json"), ("score", "m.off", "--directions", "eyes.csv"),
                    ("compare", "m.off", "-o", "out"), ("figures", "m.off", "-o", "out"), ("orient", "m.off"))
        for command in commands:
            done = self.vantage(*command, "--max-faces", "11", exit_code=3)
            self.assertEqual(done.err, "vantage: m.off: has more than 11 faces, the most that --max-faces allows; "
                                       "decimate it, or allow more if there is the memory\n", command)
        self.assertEqual({p.name for p in self.dir.iterdir()}, {"m.off", "eyes.csv"})
        self.vantage("info", "m.off", "--max-faces", "12")
        self.vantage("batch", "m.off", "-o", "out", "--max-faces", "11", "-q", exit_code=4)
        self.assertIn("has more than 11 faces", self.vantage("results", "export", "out", "--format", "jsonl").out)

    def test_instances_are_counted_before_they_are_made(self):
        triangle = b"".join(struct.pack("<3f", *p) for p in ((0, 0, 0), (1, 0, 0), (0, 1, 0)))
        self.write("m.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(300))}], "nodes": [{"mesh": 0}] * 300,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5121, "count": 3000, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3000}],
            "buffers": [{"byteLength": 3036, "uri": "data:application/octet-stream;base64," +
                         base64.b64encode(triangle + b"\0\1\2" * 1000).decode()}]}))
        self.vantage("info", "m.gltf", "--max-faces", "300000")
        self.vantage("info", "m.gltf", "--max-faces", "299999", exit_code=3)
        with zipfile.ZipFile(self.dir / "m.3mf", "w") as archive:
            mesh = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>'
                    '</vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>')
            objects = f'<object id="1">{mesh}</object>' + "".join(
                f'<object id="{i + 2}"><components>' + f'<component objectid="{i + 1}"/>' * 2 + "</components></object>"
                for i in range(10))
            archive.writestr("3D/3dmodel.model", f'<model><resources>{objects}</resources><build><item objectid="11"/></build></model>')
        self.vantage("info", "m.3mf", "--max-faces", "1024")
        self.vantage("info", "m.3mf", "--max-faces", "1023", exit_code=3)

    def test_a_file_that_thousands_of_buffers_name_is_read_once(self):
        self.write("two.bin", TRIANGLE + bytes(2_000_000))
        scene = json.loads(gltf("two.bin"))
        scene["buffers"] = [{"byteLength": 36, "uri": "./" * (i % 3) + "two.bin"} for i in range(2000)]
        self.write("m.gltf", json.dumps(scene))
        self.vantage("info", "m.gltf", "--max-memory", "200MB")

    def test_nested_elements_and_empty_items_of_a_small_3mf_take_little_memory(self):
        for resources, items in (("<a>" * 8_000_000 + "</a>" * 8_000_000, ""), ("", '<item objectid="1"/>' * 2_000_000)):
            with zipfile.ZipFile(self.dir / "m.3mf", "w", zipfile.ZIP_DEFLATED) as archive:
                archive.writestr("3D/3dmodel.model", f"<model><resources>{resources}</resources><build>{items}</build></model>")
            self.assertLess((self.dir / "m.3mf").stat().st_size, 100_000)
            done = self.vantage("info", "m.3mf", "--max-memory", "150MB", exit_code=3)
            self.assertRegex(done.err, "nested deeper|than the size of the file allows")

    def test_a_run_that_takes_longer_than_allowed_ends_in_one_sentence_and_leaves_nothing(self):
        done = self.vantage("view", MODELS / "mannequin.ply", "-o", "out", "--search", "exhaustive", "--subdivisions",
                            "5", "--timeout", "0.5", exit_code=1)
        self.assertEqual(done.err.strip(), "vantage: stopped: it took longer than --timeout allows; give it more, or a smaller model")
        self.assertFalse((self.dir / "out").exists())

    def test_standard_input_that_never_ends_is_cut_off_too(self):
        process = subprocess.Popen([PROGRAM, "info", "-", "--timeout", "0.5"], stdin=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        self.addCleanup(process.stdin.close)
        self.addCleanup(process.stderr.close)
        self.assertEqual(process.wait(timeout=60), 1)

    def test_limits_that_make_no_sense_are_wrong_usage(self):
        for flags in (("--max-memory", "1"), ("--max-memory", "much"), ("--max-memory", "-5GB"), ("--timeout", "0")):
            done = self.vantage("info", "m.off", *flags, exit_code=2)
            self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)


def processor_seconds(process):
    """What a running process has computed so far."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def total(usage):
    return usage.ru_utime + usage.ru_stime


class Interrupts(ProgramTest):
    """Each command that computes, interrupted where it is busy."""

    def test_every_command_ends_with_130_and_leaves_nothing(self):
        model = str(MODELS / "mannequin.ply")
        for command in (("thumb", model, "t.png", "--size", "4096", "--quality", "fine"),
                        ("score", model, "--sphere", "7", "-o", "s.csv"),
                        ("compare", model, "-o", "c"),
                        ("figures", model, "-o", "f", "--search", "exhaustive", "--subdivisions", "5")):
            with self.subTest(command=command[0]):
                process = subprocess.Popen([PROGRAM, *command], cwd=self.dir, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE)
                time.sleep(0.3)  # into the work, which takes far longer
                ended = resource.getrusage(resource.RUSAGE_CHILDREN)
                before = processor_seconds(process)
                process.send_signal(signal.SIGINT)
                _, err = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 130, err)
                # A second of every core: seconds by the clock would measure what else the machine does.
                spent = total(resource.getrusage(resource.RUSAGE_CHILDREN)) - total(ended) - before
                self.assertLess(spent, 1.0 * os.cpu_count())
                self.assertEqual(len(err.decode().strip().splitlines()), 1, err)
                self.assertEqual(list(self.dir.iterdir()), [])


class Paths(ProgramTest):

    def setUp(self):
        super().setUp()
        self.write("secret.bin", TRIANGLE)
        (self.dir / "model").mkdir()
        self.write("model/own.bin", TRIANGLE)

    def read(self, text, exit_code):
        self.write("model/m.gltf", text)
        return self.vantage("info", "model/m.gltf", "--timeout", "60", exit_code=exit_code)

    def test_a_buffer_of_the_models_own_folder_is_read(self):
        self.read(gltf("own.bin"), 0)

    def test_buffers_elsewhere_are_refused(self):
        os.symlink(self.dir / "secret.bin", self.dir / "model/link.bin")
        os.symlink("/dev/zero", self.dir / "model/zero.bin")
        os.symlink(self.dir, self.dir / "model/up")
        os.mkfifo(self.dir / "model/pipe.bin")
        for uri in ("../secret.bin", "%2e%2e/secret.bin", "x/../../secret.bin", str(self.dir / "secret.bin"),
                    "/dev/zero", "file:///dev/zero", "link.bin", "zero.bin", "up/secret.bin", "pipe.bin",
                    "http://127.0.0.1:9/a.bin", "//127.0.0.1/a.bin", "own.bin%00.png", "missing.bin"):
            done = self.read(gltf(uri), 3)
            self.assertEqual(len(done.err.strip().splitlines()), 1, (uri, done.err))

    def drawn_with(self, image):
        """Whether a picture of the model shows a red one that its file names, and what is said."""
        self.write("model/m.gltf", gltf("own.bin", image))
        done = self.vantage("render", "model/m.gltf", "-o", "r.png", "--force", "--direction", "0,0,1", "--size", "32",
                            "--style", "asset", "--timeout", "60")
        row = read_png((self.dir / "r.png").read_bytes())[2][20]
        shown = [row[i:i + 4] for i in range(0, len(row), 4) if row[i + 3] == 255]
        self.assertGreater(len(shown), 5)
        return any(red > 2 * green for red, green, _, _ in shown), done.err

    def test_pictures_elsewhere_are_left_out(self):
        for name in ("secret.png", "model/own.png"):
            self.write(name, png((255, 0, 0, 255)))
        self.assertEqual(self.drawn_with("own.png"), (True, ""))
        os.symlink("/dev/zero", self.dir / "model/zero.png")
        os.symlink(self.dir / "secret.png", self.dir / "model/link.png")
        for uri in ("../secret.png", "%2e%2e/secret.png", str(self.dir / "secret.png"), "link.png", "/dev/zero", "zero.png",
                    "http://127.0.0.1:9/a.png"):
            red, said = self.drawn_with(uri)
            self.assertFalse(red, uri)
            self.assertRegex(said, r"^note: the texture .* was left out: .+\n$", uri)

    def test_no_server_is_asked_for_what_a_file_names(self):
        asked = []

        class Handler(http.server.BaseHTTPRequestHandler):

            def do_GET(self):
                asked.append(self.path)
                self.send_error(404)

        server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
        self.addCleanup(server.server_close)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.shutdown)
        address = f"http://127.0.0.1:{server.server_port}"
        self.read(gltf(f"{address}/a.bin"), 3)
        self.write("model/m.gltf", gltf("own.bin", f"{address}/a.png"))
        self.vantage("render", "model/m.gltf", "-o", "r.png", "--direction", "0,0,1", "--size", "32", "--style", "asset")
        self.write("model/m.obj", f"mtllib {address}/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.vantage("render", "model/m.obj", "-o", "r.png", "--direction", "0,0,1", "--size", "32", "--style", "asset")
        self.assertEqual(asked, [])

    def test_nothing_in_a_3mf_archive_is_ever_written(self):
        (self.dir / "inner").mkdir()
        with zipfile.ZipFile(self.dir / "inner/m.3mf", "w") as archive:
            archive.writestr("../evil.model", "<model/>")
            archive.writestr("/tmp/vantage-evil.model", "<model/>")
            archive.writestr("3D/3dmodel.model",
                             "<model><resources><object id='1'><mesh><vertices><vertex x='0' y='0' z='0'/>"
                             "<vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/></vertices><triangles>"
                             "<triangle v1='0' v2='1' v3='2'/></triangles></mesh></object></resources>"
                             "<build><item objectid='1'/></build></model>")
        before = sorted(self.dir.rglob("*"))
        done = subprocess.run([PROGRAM, "info", "m.3mf", "--json"], cwd=self.dir / "inner", capture_output=True, timeout=60,
                              check=True)
        self.assertEqual(json.loads(done.stdout)["faces"], 1)
        self.assertEqual(sorted(self.dir.rglob("*")), before)
        self.assertFalse(os.path.exists("/tmp/vantage-evil.model"))


EVIL = "<img src=x onerror=alert(1)>&\"'\x1b]0;owned\x07\x1b[31m"
EVIL_PART = "</script><script>alert(2)</script><svg onload=alert(3)>\x1b[2J\x9b31m"


class Names(ProgramTest):
    """Names from files and of files, in everything that is written for people."""

    def setUp(self):
        super().setUp()
        (self.dir / "in").mkdir()
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        quads = "1 3 4 2,5 6 8 7,1 2 6 5,3 7 8 4,1 5 7 3,2 4 8 6".split(",")
        text = "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
        text += f"o {EVIL_PART}\n" + "".join(f"f {q}\n" for q in quads)
        text += "".join(f"v {x + 3} {y} {z}\n" for x, y, z in corners)
        text += f"o {EVIL_PART} 2\n" + "".join("f " + " ".join(str(int(i) + 8) for i in q.split()) + "\n" for q in quads)
        self.model = self.dir / "in" / f"{EVIL}.obj"
        self.model.write_text(text)

    def assert_harmless(self, done):
        for stream in (done.out, done.err):
            self.assertNotRegex(stream, "[\x00-\x08\x0b-\x1f\x7f\x80-\x9f]")

    def assert_no_markup(self, page):
        text = page.read_text(errors="replace")
        for part in ("<img src=x", "</script><script>alert", "<svg onload"):
            self.assertNotIn(part, text, page)

    def test_report_and_terminal_after_view(self):
        done = self.vantage("view", self.model, "-o", "out", "--size", "64x48", *FAST, "-v")
        self.assert_harmless(done)
        pages = sorted((self.dir / "out").glob("*.html"))
        cameras = ["camera-best.model-viewer.html", "camera-worst.model-viewer.html"]
        self.assertEqual([p.name for p in pages], [*cameras, "report.html"])
        for page in pages:
            self.assert_no_markup(page)
        json.loads((self.dir / "out/view.json").read_text())

    def test_terminal_and_json_of_info(self):
        self.assert_harmless(self.vantage("info", self.model))
        report = json.loads(self.vantage("info", self.model, "--json").out)
        self.assertEqual(report["name"], EVIL)

    def test_index_page_of_compare(self):
        done = self.vantage("compare", self.model, "-o", "out", "--method", "silhouette-length")
        self.assert_harmless(done)
        self.assert_no_markup(self.dir / "out/index.html")

    def test_index_page_and_contact_sheet_of_batch(self):
        done = self.vantage("batch", "in", "-o", "out", "--write", "best", "--size", "64", *FAST)
        self.assert_harmless(done)
        self.assert_no_markup(self.dir / "out/index.html")
        self.assert_harmless(self.vantage("results", "query", "out"))

    def test_errors_that_quote_a_file(self):
        bad = self.dir / "in" / "bad.off"
        bad.write_bytes(b"OFF\n3 1 0\n0 0 \x1b[31m\x07\n")
        self.assert_harmless(self.vantage("info", bad, exit_code=3))

    def test_no_shell_is_called_anywhere(self):
        pattern = re.compile(r"\b(?:std::)?(?:system|popen)\s*\(")
        self.assertTrue(pattern.search("  return std::system(command);") and pattern.search("pipe = popen (line"))
        for folder, least in (("src", 200), ("apps", 60), ("python/bindings", 5)):
            sources = list((ROOT / folder).rglob("*.cpp"))
            self.assertGreater(len(sources), least, folder)
            for source in sources:
                for line in source.read_text(encoding="utf-8").splitlines():
                    self.assertFalse(pattern.search(line) and "Matrix" not in line, (source, line))


class Writing(ProgramTest):

    def assert_whole(self, path):
        data = path.read_bytes()
        if path.suffix == ".png":
            self.assertTrue(data.endswith(b"IEND\xaeB`\x82"), path)
        elif path.suffix in (".json", ".gltf"):
            json.loads(data)
        elif path.suffix == ".html":
            ending = b"</model-viewer>" if ".model-viewer." in path.name else b"</html>"
            self.assertTrue(data.rstrip().endswith(ending), path)
        elif path.suffix == ".ply":
            self.assertIn(b"end_header\n", data)
        self.assertGreater(len(data), 0, path)

    def test_a_file_larger_than_allowed_is_not_left_half_written(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        done = subprocess.run([PROGRAM, "view", str(MODELS / "cat_lowpoly.ply"), "-o", "out", *FAST], cwd=self.dir,
                              capture_output=True, preexec_fn=limit, timeout=300, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.decode().strip().splitlines()), 1, done.stderr)
        self.assertFalse((self.dir / "out").exists())

    def test_a_full_disk_asks_to_try_again_and_leaves_nothing(self):
        disk = self.dir / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=40k", "tmpfs", str(disk)], capture_output=True,
                                 check=False)
        if mounted.returncode != 0:
            self.skipTest("NOTHING WAS TESTED: no small disk can be mounted here: " + mounted.stderr.decode())
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=True)
        # What may be there afterwards: outputs that were whole before another one was begun.
        for command, earlier in ((("view", "-o", "disk/out", "--size", "64x48", *FAST), []),
                                 (("skeleton", "-o", "disk/levels.json", "--levels", "disk/levels"), ["levels.json"]),
                                 (("thumb", "disk/t.png", "--size", "512"), [])):
            with self.subTest(command=command[0]):
                model = MODELS / "cat_lowpoly.ply"
                done = self.vantage(command[0], model, *command[1:], exit_code=75)
                self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                left = [path for path in disk.rglob("*") if path.is_file()]
                self.assertEqual([str(path.relative_to(disk)) for path in left], earlier)
                for path in left:
                    self.assert_whole(path)
                    path.unlink()

    def test_a_run_killed_while_it_writes_leaves_whole_files_and_the_next_run_goes_through(self):
        out = self.dir / "out"
        command = [PROGRAM, "view", str(MODELS / "cat_lowpoly.ply"), "-o", "out", "--size", "64x48", *FAST]
        killed = 0
        for wanted in (1, 5):  # how many files there may be when it is killed
            process = subprocess.Popen(command, cwd=self.dir, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None:
                names = os.listdir(out) if out.exists() else []
                if len(names) >= wanted:
                    process.kill()
                    break
            process.wait()
            killed += process.returncode == -signal.SIGKILL
            for path in out.iterdir():
                if ".part." not in path.name:
                    self.assert_whole(path)
            subprocess.run(command, cwd=self.dir, capture_output=True, timeout=300, check=True)
            self.assertEqual([name for name in os.listdir(out) if ".part." in name], [])
            for path in out.iterdir():
                self.assert_whole(path)
                path.unlink()
            out.rmdir()
        self.assertGreater(killed, 0)


class Network(ProgramTest):

    def test_serve_listens_on_loopback_only(self):
        self.write("m.off", box(1))
        self.vantage("view", "m.off", "-o", "one", "--no-images", *FAST)
        process = subprocess.Popen([PROGRAM, "serve", "."], cwd=self.dir, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        port = int(process.stdout.readline().decode().strip().rstrip("/").rsplit(":", 1)[1])
        listening = [line.split()[1] for table in ("/proc/net/tcp", "/proc/net/tcp6")
                     for line in pathlib.Path(table).read_text().splitlines()[1:] if line.split()[3] == "0A"]
        self.assertEqual([at for at in listening if at.endswith(f":{port:04X}")], [f"0100007F:{port:04X}"])


if __name__ == "__main__":
    unittest.main()
