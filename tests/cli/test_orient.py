"""vantage orient, --front, and sidecars."""

import base64
import json
import math
import re
import struct
import unittest

from png import read_png
from program import MODELS, ProgramTest
from program import contract_quickly as setUpModule

# A chair that stands on y = 0 and faces +z: boxes as low and high corners.
CHAIR = [((0, .9, 0), (1, 1, 1)), ((0, 1, 0), (1, 2, .1)), ((0, 0, 0), (.1, .9, .1)), ((.9, 0, 0), (1, .9, .1)),
         ((0, 0, .9), (.1, .9, 1)), ((.9, 0, .9), (1, .9, 1))]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
         (1, 5, 7), (1, 7, 3)]


def obj(turn=lambda p: p):
    lines = ["# a chair"]
    for low, high in CHAIR:
        for i in range(8):
            corner = [(low, high)[i >> (2 - k) & 1][k] for k in range(3)]
            lines.append("v " + " ".join(f"{x:g}" for x in turn(corner)))
    for n in range(len(CHAIR)):
        lines += ["f " + " ".join(str(8 * n + i + 1) for i in face) for face in FACES]
    return "\n".join(lines) + "\n"


def vertices(text):
    return [[float(x) for x in line.split()[1:4]] for line in text.splitlines() if line.startswith("v ")]


class Orient(ProgramTest):
    def said(self, *arguments):
        return json.loads(self.vantage("orient", *arguments, "--json").out)

    def test_what_is_given_is_turned_to_the_formats_habit_and_all_else_stays(self):
        self.write("z.obj", obj(lambda p: (p[0], -p[2], p[1])) + "# the end\n")
        said = self.vantage("orient", "z.obj", "-o", "up.obj", "--up", "z", "--front=-y").out
        self.assertIn("; turned from z up, front -y, to y up, front z → up.obj\n", said)
        text = (self.dir / "up.obj").read_text()
        self.assertEqual(vertices(text), vertices(obj()))
        self.assertTrue(text.startswith("# a chair\n") and text.endswith("# the end\n"))
        self.assertEqual(text.count("\nf "), 72)

    def test_the_same_again_is_no_loss_and_anything_else_is(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for _ in range(2):
            self.vantage("orient", "a.obj", "-o", "b.obj", "--up", "z")
        self.assertNotIn("-0", (self.dir / "b.obj").read_text())
        self.assertIn("does not say that vantage wrote it",
                      self.vantage("orient", "a.obj", "-o", "b.obj", "--up", "x", exit_code=1).err)
        self.vantage("orient", "a.obj", "-o", "b.obj", "--up", "x", "--force")

    def test_a_turned_file_needs_no_turning(self):
        self.write("x.obj", obj(lambda p: (p[1], p[2], p[0])))
        self.vantage("orient", "x.obj", "-o", "up.obj", "--up", "x", "--front", "y")
        self.assertFalse(self.said("up.obj", "--up", "y", "--front", "z")["turned"])

    def test_the_rotation_is_a_quaternion(self):
        self.write("a.obj", obj())
        self.assertEqual(self.said("a.obj", "--up", "y", "--front", "z")["rotation"], [0, 0, 0, 1])
        q = self.vantage("orient", "a.obj", "--up", "z", "--front=-y", "--print").out.split()
        self.assertEqual(len(q), 4)
        self.assertAlmostEqual(abs(float(q[0])), 0.5 ** 0.5)  # a quarter turn about x
        self.assertAlmostEqual(sum(float(x) ** 2 for x in q), 1.0)

    def test_a_gltf_gets_a_node_that_turns_it(self):
        data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 2, 0)
        gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                               "max": [1, 2, 0]}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]}
        text = json.dumps(gltf).encode()
        text += b" " * (-len(text) % 4)
        glb = struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + 36)
        glb += struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", 36, 0x004E4942) + data
        (self.dir / "t.glb").write_bytes(glb)
        self.vantage("orient", "t.glb", "-o", "u.glb", "--up", "x", "--front", "z")
        before = json.loads(self.vantage("info", "t.glb", "--json").out)["box"]
        after = json.loads(self.vantage("info", "u.glb", "--json").out)["box"]
        self.assertEqual(before["high"], [1, 2, 0])
        # x becomes y, so that y becomes -x.
        for found, wanted in zip(after["low"] + after["high"], [-2, 0, 0, 0, 1, 0]):
            self.assertAlmostEqual(found, wanted, 6)
        # A .gltf that names no file stands anywhere, another beside what it names only.
        for uri, exit_code in (("data:application/octet-stream;base64," + base64.b64encode(data).decode(), 0), ("t.bin", 1)):
            (self.dir / "t.bin").write_bytes(data)
            gltf["buffers"][0]["uri"] = uri
            self.write("t.gltf", json.dumps(gltf))
            done = self.vantage("orient", "t.gltf", "-o", "other/t.gltf", "--up", "x", "--front", "z", "--force", exit_code=exit_code)
        self.assertIn("must be beside the model", done.err)
        gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        gltf["images"] = [{"uri": "gone.png"}]  # that it is not there does not change what the file names
        self.write("t.gltf", json.dumps(gltf))
        self.vantage("orient", "t.gltf", "-o", "other/t.gltf", "--up", "x", "--front", "z", "--force", exit_code=1)

    def test_materials_that_stay_beside_the_model_are_noted(self):
        (self.dir / "mats").mkdir()
        (self.dir / "other").mkdir()
        self.write("a.obj", "mtllib mats/a.mtl\nusemtl m\n" + obj())
        self.write("mats/a.mtl", "newmtl m\nKd 1 0 0\nmap_Kd t.png\n")
        self.write("mats/t.png", "x")
        note = "materials are in mats/a.mtl and 1 more file beside the model; copy them beside other/a.obj"
        orient = ("orient", "a.obj", "--up", "y", "--front", "z", "-o")
        self.assertIn("note: " + note, self.vantage(*orient, "other/a.obj").err)
        self.assertIn(note, json.loads(self.vantage(*orient, "other/a.obj", "--force", "--json").out)["warnings"])
        self.assertNotIn("materials", self.vantage(*orient, "./b.obj").err)
        (self.dir / "mats").rename(self.dir / "other/mats")
        self.assertNotIn("materials", self.vantage(*orient, "other/a.obj", "--force").err)

    def test_binary_stl_is_turned_with_its_normals(self):
        facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 7)
        (self.dir / "t.stl").write_bytes(b"made by hand".ljust(80) + struct.pack("<I", 1) + facet)
        self.vantage("orient", "t.stl", "-o", "u.stl", "--up", "y", "--front", "z")
        found = struct.unpack("<12fH", (self.dir / "u.stl").read_bytes()[84:])
        self.assertEqual(found[:3], (0, -1, 0))  # the front, z, becomes -y
        self.assertEqual(found[9:12], (0, 0, 2))
        self.assertEqual(found[12], 7)

    def test_other_formats_are_written_as_ply(self):
        self.vantage("orient", MODELS / "fan.ply", "-o", "up.ply", "--up", "z", "--front=-y")
        self.assertTrue((self.dir / "up.ply").read_bytes().startswith(b"ply"))
        done = self.vantage("orient", MODELS / "fan.ply", "-o", "up.obj", exit_code=2)
        self.assertIn(".ply", done.err)

    def test_the_flags_that_overrule_a_note_work(self):
        boxes = [(x, y, 0, .1, .1, 1) for x in (0, .9) for y in (0, .9)] + [(0, 0, 1, 1, 1, .1), (0, 0, 1.1, .1, 1, 1)]
        self.write("chair.obj", "".join(
            f"v {x + i * a} {y + j * b} {z + k * c}\n"
            for x, y, z, a, b, c in boxes for i in (0, 1) for j in (0, 1) for k in (0, 1)) + "".join(
            "f " + " ".join(str(8 * n + i + 1) for i in quad) + "\n" for n in range(len(boxes))
            for quad in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))))
        notes = self.vantage("orient", "chair.obj").err
        advised = re.findall("; (--.*) overrules this", notes)
        self.assertEqual(advised, ["--up y", "--up z --front -y"])
        self.assertIn("not -y, the usual one for this up;", notes)
        self.assertNotIn("% sure", notes)  # which the line of the result says
        for flags in advised:
            self.vantage("orient", "chair.obj", *flags.split())

    def test_features_are_json_of_six_ups_and_twenty_four_fronts(self):
        self.write("a.obj", obj())
        found = json.loads(self.vantage("orient", "a.obj", "--features").out)
        self.assertEqual((len(found["ups"]), len(found["fronts"])), (6, 24))
        self.assertEqual(len(found["ups"][0]["values"]), len(found["up_features"]))
        self.assertEqual(len(found["fronts"][0]["values"]), len(found["front_features"]))

    def test_up_and_front_along_one_axis_are_wrong_usage(self):
        self.write("a.obj", obj())
        for command in (("orient", "a.obj"), ("view", "a.obj", "-o", "r")):
            said = self.vantage(*command, "--front=-y", exit_code=2).err
            self.assertIn("-y is along the up axis, y, which the format gives; --up", said)
        done = self.vantage("orient", "a.obj", "--up", "y", "--front=-y", exit_code=2)
        self.assertIn("-y is along the up axis, y: give", done.err)
        # A sidecar is no command line.
        self.write("vantage.json", '{"front": "y"}')
        self.assertIn("along the up axis", self.vantage("orient", "a.obj", exit_code=1).err)


class Front(ProgramTest):
    def report(self, *arguments):
        self.vantage("view", "a.obj", "-o", "r", "--no-images", *arguments)
        return json.loads((self.dir / "r" / "view.json").read_text())

    def test_the_best_view_is_from_the_front_that_is_given(self):
        self.write("a.obj", obj())
        for front, sign in (("z", 1), ("-z", -1)):
            found = self.report("--up", "y", f"--front={front}")
            self.assertEqual((found["front"], found["front_source"], found["front_confidence"]), (front, "given", 1.0))
            self.assertEqual((found["up"], found["up_source"], found["up_confidence"]), ("y", "given", 1.0))
            self.assertGreater(sign * found["best"]["direction"][2], 0)

    def test_what_is_sought_has_a_source_and_a_confidence(self):
        self.write("a.obj", obj())
        found = self.report()
        self.assertIn(found["up_source"], ("format", "shape"))
        for part in ("up", "front"):
            self.assertGreaterEqual(found[part + "_confidence"], 0)
            self.assertLessEqual(found[part + "_confidence"], 1)


def leaning(p):
    """Turned by 25 degrees about (2, 6, 3) / 7, the quaternion's double product with the point."""
    s, c = math.sin(math.radians(12.5)), math.cos(math.radians(12.5))
    x, y, z = 2 / 7 * s, 6 / 7 * s, 3 / 7 * s

    def cross(a, b):
        return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]

    t = [2 * v for v in cross((x, y, z), p)]
    u = cross((x, y, z), t)
    return [p[i] + c * t[i] + u[i] for i in range(3)]


class OffTheAxes(ProgramTest):
    def test_a_leaning_model_is_stood_up(self):
        self.write("a.obj", obj(leaning))
        said = self.vantage("orient", "a.obj", "--up", "any", "-o", "up.ply")
        self.assertIn("quaternion", said.err)
        q = [float(x) for x in self.vantage("orient", "a.obj", "--up", "any", "--print").out.split()]
        self.assertAlmostEqual(math.hypot(*q), 1, 5)
        # The chair's box has the sides 1, 1 and 2 again; before, all were longer.
        self.vantage("orient", "up.ply", "-o", "same.ply", "--up", "y", "--front", "z")
        data = (self.dir / "same.ply").read_bytes()
        body = data.index(b"end_header\n") + 11
        count = int(data[data.index(b"element vertex ") + 15:].split(b"\n")[0])
        stride = 3 * (8 if b"property double x" in data else 4)
        form = "<3d" if stride == 24 else "<3f"
        points = [struct.unpack_from(form, data, body + stride * i) for i in range(count)]
        sides = sorted(max(c) - min(c) for c in zip(*points))
        for side, length in zip(sides, (1, 1, 2)):
            self.assertAlmostEqual(side, length, 4)

    def test_a_ply_says_what_it_has_no_place_for(self):
        self.write("a.obj", "mtllib a.mtl\nusemtl red\n" + obj())
        self.write("a.mtl", "newmtl red\nKd 1 0 0\n")
        self.assertIn("the materials are not in up.ply", self.vantage("orient", "a.obj", "-o", "up.ply").err)
        self.assertNotIn("materials", self.vantage("orient", "a.obj", "-o", "up.obj").err)

    def test_animals_that_stand_are_left_standing_by_any(self):
        for name in ("cat_lowpoly", "horse", "mannequin"):  # the least box around each lies aslant
            said = self.vantage("orient", MODELS / f"{name}.ply", "--up", "any", "--print")
            self.assertNotIn("quaternion", said.err, name)
            self.assertEqual({abs(float(x)) for x in said.out.split()} - {0.0, 0.5, 1.0}, set(), said.out)

    def test_all_commands_that_look_for_up_know_it(self):
        self.write("a.obj", obj(leaning))
        self.vantage("view", "a.obj", "-o", "r", "--no-images", "--up", "any")
        found = json.loads((self.dir / "r" / "view.json").read_text())
        self.assertIn("quaternion", json.dumps(found))
        self.vantage("thumb", "a.obj", "t.png", "-s", 32, "--up", "any")
        self.vantage("render", "a.obj", "-o", "b.png", "--view", "best", "--size", 32, "--up", "any")
        self.write("vantage.json", '{"up": "any"}')
        self.vantage("thumb", "a.obj", "u.png", "-s", 32)
        self.assertEqual((self.dir / "t.png").read_bytes(), (self.dir / "u.png").read_bytes())

    def test_cameras_that_name_the_file_fit_it_as_it_is(self):
        self.write("a.obj", obj(leaning))
        picture = ("--size", "64x48", "--style", "clay")
        self.vantage("view", "a.obj", "-o", "r", "--up", "any", "--no-report", *picture)
        found = json.loads((self.dir / "r/view.json").read_text())
        line = (self.dir / "r/camera-best.f3d.txt").read_text()
        eye, target, up = ([float(x) for x in line.split(f"--camera-{name}=")[1].split()[0].split(",")]
                           for name in ("position", "focal-point", "view-up"))
        found["best"] |= {"eye": eye, "up": up, "frame": found["best"]["frame"] | {"target": target}}
        self.write("cam.json", json.dumps(found))
        self.vantage("render", "a.obj", "-o", "again.png", "--camera", "cam.json", *picture)
        best, again = ([p for row in read_png((self.dir / name).read_bytes())[2] for p in row[3::4]]
                       for name in ("r/best.png", "again.png"))
        self.assertGreater(sum(a > 127 for a in best), 300)
        self.assertLess(max(abs(a - b) for a, b in zip(best, again)), 16)
        # The element for web pages is told how to turn the file.
        html = (self.dir / "r/camera-best.model-viewer.html").read_text()
        self.assertIn(f'orientation="{found["best"]["model_viewer"]["orientation"]}"', html)

    def test_only_a_ply_takes_the_turned_points(self):
        self.write("a.obj", obj(leaning))
        done = self.vantage("orient", "a.obj", "--up", "any", "-o", "up.obj", exit_code=2)
        self.assertIn("must end in .ply", done.err)

    def test_of_an_off_only_a_ply_is_written(self):
        self.write("a.off", "OFF\n4 4 0\n0 0 0\n4 0 0\n0 3 0\n0 0 2\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        done = self.vantage("orient", "a.off", "--up", "z", "-o", "up.obj", exit_code=2)
        self.assertIn("-o: must end in .ply: of a .off, nothing else is written", done.err)


class Sidecars(ProgramTest):
    def up_and_front(self, *arguments):
        found = json.loads(self.vantage("orient", "a.obj", "--json", *arguments).out)
        return found["up"]["axis"], found["front"]["axis"]

    def test_the_models_own_comes_before_the_folders_and_flags_before_both(self):
        self.write("a.obj", obj())
        self.write("vantage.json", '{"up": "x", "front": "y"}')
        self.assertEqual(self.up_and_front(), ("x", "y"))
        self.write("a.vantage.json", '{"up": "-z", "front": "x"}')
        self.assertEqual(self.up_and_front(), ("-z", "x"))
        self.write("a.obj.vantage.json", '{"up": "-y", "front": "x"}')
        self.assertEqual(self.up_and_front(), ("-y", "x"))
        self.assertEqual(self.up_and_front("--up", "z", "--front", "y"), ("z", "y"))

    def test_a_flag_overrules_what_it_leaves_no_room_for(self):
        self.write("a.obj", obj())
        self.write("vantage.json", '{"up": "z", "front": "y"}')
        self.assertEqual(self.up_and_front("--up", "y"), ("y", "z"))
        self.assertEqual(self.up_and_front("--up", "x"), ("x", "y"))
        self.assertEqual(self.up_and_front("--front=-z"), ("y", "-z"))

    def test_a_flag_that_says_auto_is_a_flag(self):
        self.write("a.obj", obj())
        self.assertEqual(self.up_and_front(), ("y", "z"))
        self.write("vantage.json", '{"up": "-x", "front": "-z"}')
        self.assertEqual(self.up_and_front("--up", "auto"), ("y", "-z"))
        self.assertEqual(self.up_and_front("--front", "auto")[0], "-x")
        both = ("--up", "auto", "--front", "auto")
        self.assertEqual(self.up_and_front(*both), ("y", "z"))
        said = json.loads(self.vantage("thumb", "a.obj", "t.png", "-s", 32, "--json", *both).out)
        self.assertEqual((said["up"], said["front"]), ("y", "z"))
        for flags, up in (((), "-x"), (("--up", "auto"), "y")):  # the second is no repetition of the first
            self.vantage("batch", "a.obj", "-o", "out", "--write", "json", *flags)
            found = json.loads(next((self.dir / "out").rglob("view.json")).read_text())
            self.assertEqual(found["up"], up)

    def test_notes_on_a_front_that_is_not_taken_claim_no_search(self):
        fan = self.dir / "fan.ply"
        fan.write_bytes((MODELS / "fan.ply").read_bytes())
        self.write("vantage.json", '{"up": "z", "front": "-y", "view": [1, -1, 0.5]}')
        self.vantage("view", fan, "-o", "r", "--no-images", "--up", "y")
        notes = json.loads((self.dir / "r" / "view.json").read_text())["warnings"]
        self.assertIn("the sidecar's front -y lies along the up that is given and was not taken", notes)
        self.assertTrue(any(note.startswith("front is unsure") for note in notes), notes)
        self.assertFalse(any("weighs all sides" in note for note in notes), notes)

    def test_view_thumb_render_and_batch_obey_it(self):
        self.write("a.obj", obj())
        self.write("vantage.json", '{"up": "-x", "front": "y", "view": [0, 0, -2]}')
        self.vantage("view", "a.obj", "-o", "r", "--no-images")
        report = json.loads((self.dir / "r" / "view.json").read_text())
        self.assertEqual((report["up"], report["front"], report["best"]["direction"]), ("-x", "y", [0, 0, -1]))
        self.assertLess(report["best"]["score_of_attainable"], 1)
        self.assertTrue(any("sidecar" in warning for warning in report["warnings"]), report["warnings"])
        said = json.loads(self.vantage("thumb", "a.obj", "t.png", "-s", 32, "--json").out)
        self.assertEqual((said["up"], said["front"], said["direction"]), ("-x", "y", [0, 0, -1]))
        self.vantage("render", "a.obj", "-o", "b.png", "--view", "best", "--size", 32)
        self.vantage("render", "a.obj", "-o", "d.png", "--direction", "0,0,-1", "--size", 32)
        self.assertEqual((self.dir / "b.png").read_bytes(), (self.dir / "d.png").read_bytes())
        self.vantage("batch", "a.obj", "-o", "out", "--write", "json")
        row = json.loads(self.vantage("results", "export", "out", "--format", "jsonl").out.splitlines()[0])
        self.assertEqual(row["up"], "-x")
        self.assertEqual(row["best"]["direction"], [0, 0, -1])

    def test_figures_obey_it(self):
        (self.dir / "plain").mkdir()
        for folder in (".", "plain"):
            self.write(f"{folder}/a.obj", obj())
        self.write("a.vantage.json", '{"up": "-x", "front": "y"}')
        flags = ("--size", 64, "--contraction", "auto")
        self.vantage("figures", "a.obj", "-o", "by-sidecar", *flags)
        self.vantage("figures", "plain/a.obj", "-o", "by-flags", "--up=-x", "--front", "y", *flags)
        self.vantage("figures", "plain/a.obj", "-o", "neither", *flags)
        pictures = {folder: {path.name: path.read_bytes() for path in (self.dir / folder).glob("figure*.png")}
                    for folder in ("by-sidecar", "by-flags", "neither")}
        self.assertGreater(len(pictures["neither"]), 5)
        self.assertEqual(pictures["by-sidecar"], pictures["by-flags"])
        self.assertNotEqual(pictures["by-sidecar"], pictures["neither"])

    def test_a_manifest_may_name_the_front(self):
        self.write("a.obj", obj())
        self.write("list.jsonl", '{"path": "a.obj", "up": "y", "front": "-z"}\n{"path": "b.obj", "front": "w"}\n')
        self.vantage("batch", "--manifest", "list.jsonl", "-o", "out", "--write", "json", exit_code=4)
        rows = [json.loads(line) for line in
                self.vantage("results", "export", "out", "--format", "jsonl").out.splitlines()]
        errors = {row["key"]: row["error"] for row in rows}
        self.assertEqual(errors["a.obj"], "")
        self.assertIn('has a "front" that is none of', errors["b.obj"])
        found = json.loads(next((self.dir / "out").rglob("view.json")).read_text())
        self.assertEqual((found["front"], found["front_source"]), ("-z", "given"))

    def test_a_sidecar_that_is_not_as_it_should_be_ends_in_one_sentence(self):
        self.write("a.obj", obj())
        for text, words in (("{", "a.vantage.json"), ("[]", "object"), ('{"up": "w"}', '"up" must be one of'),
                            ('{"up": "x", "front": "-x"}', "same axis"), ('{"turn": 1}', '"turn"'),
                            ('{"up": "y", "up": "z"}', 'names "up" twice'),
                            ('{"view": [0, 0, 0]}', '"view"'), ('{"view": [0, "1", 0]}', '"view"'),
                            ('{"style": "oil"}', '"style"'), (" " * 70000 + "{}", "64 KiB")):
            self.write("a.vantage.json", text)
            done = self.vantage("orient", "a.obj", exit_code=3)
            self.assertIn(words, done.err)
            self.assertEqual(done.err.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
