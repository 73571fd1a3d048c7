"""How models look: the file's own materials everywhere, the flags of pictures everywhere, never an empty picture."""

import base64
import json
import os
import struct
import unittest

from png import png, read_png
from program import ProgramTest, read_ply
from program import contract_quickly as setUpModule
from shapes import box

SMALL = ("--size", "48")
FAST = ("--search", "rapid", *SMALL)
RED = "newmtl red\nKd 0.9 0.05 0.05\n"


def obj_box(material):
    """A box as OBJ with a material library."""
    rows = box(1.0, 1.2, 0.8).splitlines()
    text = "mtllib m.mtl\n" + "".join(f"v {row}\n" for row in rows[2:10]) + f"usemtl {material}\n"
    return text + "".join("f " + " ".join(str(int(i) + 1) for i in row.split()[1:]) + "\n" for row in rows[10:])


def gltf_box(material, textures=()):
    """A box as glTF with a material and pictures; every corner looks at the middle of a picture."""
    rows = box(1.0, 1.2, 0.8).splitlines()
    points = struct.pack("<24f", *[float(x) for row in rows[2:10] for x in row.split()])
    uvs = struct.pack("<16f", *([0.5] * 16))
    corners = [int(i) for row in rows[10:] for i in row.split()[1:]]
    data = points + uvs + struct.pack(f"<{len(corners)}H", *corners)
    return json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [material],
        "textures": [{"source": i} for i in range(len(textures))],
        "images": [{"uri": "data:image/png;base64," + base64.b64encode(t).decode()} for t in textures],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1.2, 0.8]},
                      {"bufferView": 1, "componentType": 5126, "count": 8, "type": "VEC2"},
                      {"bufferView": 2, "componentType": 5123, "count": len(corners), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96},
                        {"buffer": 0, "byteOffset": 96, "byteLength": 64},
                        {"buffer": 0, "byteOffset": 160, "byteLength": 2 * len(corners)}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data).decode()}]})


def shown(path):
    """Pixels of a picture that are neither transparent nor white."""
    rows = read_png(path.read_bytes())[2]
    pixels = [row[i:i + 4] for row in rows for i in range(0, len(row), 4)]
    return [p for p in pixels if p[3] > 8 and min(p[:3]) < 250]


def redness(path):
    pixels = shown(path)
    return sum(p[0] > 2 * max(p[1], p[2]) for p in pixels) / max(1, len(pixels))


class Materials(ProgramTest):

    def setUp(self):
        super().setUp()
        self.write("m.mtl", RED)
        self.write("red.obj", obj_box("red"))

    def test_every_command_shows_the_files_own(self):
        self.vantage("view", "red.obj", "-o", "v", *FAST, "--views", 2, "--weight", "area")
        self.vantage("thumb", "red.obj", "t.png", "-s", 48)
        self.vantage("render", "red.obj", "-o", "r.png", "--direction", "1,1,1", *SMALL)
        self.vantage("compare", "red.obj", "-o", "c", "--method", "silhouette-length")
        self.vantage("batch", "red.obj", "-o", "b", "--name", "{stem}", *FAST)
        for name in ("v/best.png", "v/worst.png", "v/view-02.png", "t.png", "r.png", "b/models/red/best.png",
                     "b/models/red/thumb.png"):
            self.assertGreater(redness(self.dir / name), 0.8, name)
        self.assertGreater(redness(self.dir / "v/views.png"), 0.3)
        self.assertGreater(redness(self.dir / "c/sheet.png"), 0.05)
        # The pictures of the map and the skeleton are of those.
        for name in ("v/best-kssm.png", "v/best-skeleton.png"):
            self.assertLess(redness(self.dir / name), 0.6, name)

    def test_a_library_of_the_authors_disk_or_one_bright_vertex_leaves_it_red(self):
        self.write("disk.obj", obj_box("red").replace("mtllib ", "mtllib C:\\models\\"))
        bright = obj_box("red").replace("mtllib m.mtl\n", "")
        for i, row in enumerate(box(1.0, 1.2, 0.8).splitlines()[2:10]):
            bright = bright.replace(f"v {row}\n", f"v {row} {0.9 if i else 3} 0.05 0.05\n")
        self.write("bright.obj", bright)
        for name in ("disk", "bright"):
            self.vantage("render", f"{name}.obj", "-o", f"{name}.png", "--direction", "1,1,1", *SMALL)
            self.assertGreater(redness(self.dir / f"{name}.png"), 0.8, name)

    def test_every_command_that_draws_knows_the_flags_of_pictures(self):
        flags = ("--style", "clay", "--quality", "draft", "--background", "#0000ff", "--crease", "30", "--margin", "9")
        self.vantage("view", "red.obj", "-o", "v", *FAST, *flags, "--views", 3, "--weight", "area", "--tour",
                     "v/tour.png", "--tour-seconds", 1, "--tour-size", 32)
        self.vantage("thumb", "red.obj", "t.png", "-s", 48, *flags)
        self.vantage("render", "red.obj", "-o", "r.png", "--view", "best", *FAST, *flags)
        self.vantage("batch", "red.obj", "-o", "b", "--name", "{stem}", *FAST, *flags)
        self.vantage("compare", "red.obj", "-o", "c", "--method", "silhouette-length", *flags)
        self.vantage("figures", "red.obj", "-o", "f", *FAST, *flags)
        for name in ("v/best.png", "v/best-kssm.png", "v/view-02.png", "v/tour.png", "t.png", "r.png",
                     "b/models/red/best.png"):
            rows = read_png((self.dir / name).read_bytes())[2]
            self.assertEqual(tuple(rows[0][:4]), (0, 0, 255, 255), name)
            self.assertLess(redness(self.dir / name), 0.3, name)
        for name in ("c/sheet.png", "f/figure-5-skeleton.png"):
            rows = read_png((self.dir / name).read_bytes())[2]
            blue = sum(row[i:i + 3] == b"\0\0\xff" for row in rows for i in range(0, len(row), 4))
            self.assertGreater(blue, 200, name)

    def test_a_sidecar_says_the_style_of_every_command(self):
        self.write("red.vantage.json", '{"style": "clay"}')
        self.vantage("view", "red.obj", "-o", "v", *FAST, "--no-report")
        self.vantage("batch", "red.obj", "-o", "b", "--name", "{stem}", *FAST)
        for name in ("v/best.png", "b/models/red/best.png"):
            self.assertLess(redness(self.dir / name), 0.1, name)

    def test_other_looks_or_materials_are_other_results_of_a_batch(self):
        batch = ("batch", "red.obj", "-o", "b", *FAST, "--json")
        self.vantage(*batch)
        self.assertEqual(json.loads(self.vantage(*batch).out)["skipped"], 1)
        self.assertEqual(json.loads(self.vantage(*batch, "--background", "white").out)["done"], 1)
        for folder, colour in (("one", "1 0 0"), ("two", "0 1 0")):
            os.mkdir(self.dir / folder)
            self.write(f"{folder}/m.mtl", f"newmtl red\nKd {colour}\n")
            self.write(f"{folder}/box.obj", obj_box("red"))
        done = self.vantage("batch", "one", "two", "-o", "c", *FAST, "--name", "{parent}-{stem}", "--json")
        self.assertEqual(json.loads(done.out)["done"], 2)
        self.assertGreater(redness(self.dir / "c/models/one-box/best.png"), 0.8)
        self.assertLess(redness(self.dir / "c/models/two-box/best.png"), 0.1)


class NeverBlank(ProgramTest):
    """No picture of a run that succeeds is empty, whatever a material says."""

    def setUp(self):
        super().setUp()
        for name, material in (("tr", "Tr 1.0\n"), ("d", "d 0\n")):
            os.mkdir(self.dir / name)
            self.write(f"{name}/m.mtl", RED + material)
            self.write(f"{name}/{name}.obj", obj_box("red"))
        clear, grey = png((200, 20, 20, 0)), png((200, 20, 20, 255))
        pbr = "pbrMetallicRoughness"
        texture = {"baseColorTexture": {"index": 0}}
        for name, material, pictures in (
                ("factor", {pbr: {"baseColorFactor": [1, 0, 0, 0]}, "alphaMode": "BLEND"}, ()),
                ("factor-mask", {pbr: {"baseColorFactor": [1, 0, 0, 0]}, "alphaMode": "MASK"}, ()),
                ("faint", {pbr: {"baseColorFactor": [1, 0, 0, 0.001]}, "alphaMode": "BLEND"}, ()),
                ("picture", {pbr: texture, "alphaMode": "BLEND"}, (clear,)),
                ("picture-mask", {pbr: texture, "alphaMode": "MASK"}, (clear,)),
                ("both", {pbr: {**texture, "baseColorFactor": [1, 0, 0, 0]}, "alphaMode": "BLEND"}, (grey,))):
            self.write(f"{name}.gltf", gltf_box(material, pictures))
        self.models = ["tr/tr.obj", "d/d.obj"] + sorted(p.name for p in self.dir.glob("*.gltf"))

    def assert_shown(self, path):
        self.assertGreater(len(shown(path)), 100, path)

    def test_thumb_shows_it_and_says_so(self):
        for model in self.models:
            done = self.vantage("thumb", model, "t.png", "-s", 48)
            self.assertIn("opaque", done.err, model)
            self.assertEqual(len(done.err.splitlines()), 1, done.err)
            self.assert_shown(self.dir / "t.png")

    def test_every_other_command_too(self):
        self.vantage("batch", *self.models, "-o", "b", "--name", "{stem}", *FAST)
        for model in self.models:
            stem = model.split("/")[-1].split(".")[0]
            self.assert_shown(self.dir / f"b/models/{stem}/best.png")
            done = self.vantage("render", model, "-o", "r.png", "--direction", "1,1,1", *SMALL)
            self.assertIn("opaque", done.err, model)
            self.assert_shown(self.dir / "r.png")
        for model in ("tr/tr.obj", "picture.gltf"):
            done = self.vantage("view", model, "-o", "v", *FAST, "--views", 2, "--weight", "area", "--no-report")
            self.assertIn("opaque", done.err)
            self.vantage("compare", model, "-o", "c", "--method", "silhouette-length")
            self.vantage("figures", model, "-o", "f", *FAST, "--style", "asset")
            for path in [*(self.dir / "v").glob("*.png"), *(self.dir / "c").glob("*.png"), *(self.dir / "f").glob("*.png")]:
                self.assert_shown(path)

    def test_what_is_partly_visible_stays_as_the_file_says(self):
        glass = {"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.3]}, "alphaMode": "BLEND"}
        self.write("glass.gltf", gltf_box(glass))
        done = self.vantage("thumb", "glass.gltf", "t.png", "-s", 48)
        self.assertEqual(done.err, "")
        middle = read_png((self.dir / "t.png").read_bytes())[2][24][4 * 24 + 3]
        self.assertLess(middle, 200)


class Legend(ProgramTest):

    def test_pictures_of_maps_say_what_their_colours_mean(self):
        self.write("a.off", box(1.0))
        for size, legend in (("400x300", True), ("120x90", False)):
            self.vantage("render", "a.off", "-o", "m.png", "--view", "best", "--show", "kssm", "--search", "rapid",
                         "--size", size)
            self.vantage("render", "a.off", "-o", "p.png", "--view", "best", "--search", "rapid", "--size", size)
            width, height, map_rows = read_png((self.dir / "m.png").read_bytes())
            plain_rows = read_png((self.dir / "p.png").read_bytes())[2]
            beyond = sum(m[4 * x + 3] > 0 and p[4 * x + 3] == 0 for m, p in zip(map_rows, plain_rows)
                         for x in range(width))
            self.assertEqual(beyond > 300, legend, (size, height, beyond))


class RowsOfPly(ProgramTest):
    """Text PLY whose rows hold more than the header says, as trimesh's fuze_ascii.ply."""

    HEADER = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 4\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
              "property uchar blue\nproperty uchar alpha\nend_header\n")
    POINTS = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))

    def test_each_line_is_a_row_and_a_note_says_so(self):
        faces = "".join(f"3 {a} {b} {c} 9 1 1 1 1 1 1 1 1 1 \n" for a, b, c in self.FACES)
        self.write("fuze.ply", self.HEADER + self.POINTS + faces)
        done = self.vantage("map", "fuze.ply", "-o", "m.ply")
        self.assertIn("24 values more", self.vantage("view", "fuze.ply", "-o", "v", "--no-images").err)
        self.assertEqual(read_ply(self.dir / "m.ply")[2], list(self.FACES), done.err)

    def test_rows_that_break_anywhere_are_still_read(self):
        faces = "".join(f"3 {a}\n{b} {c} 1 1\n1 1 " for a, b, c in self.FACES)
        self.write("broken.ply", self.HEADER + self.POINTS + faces + "\n")
        done = self.vantage("map", "broken.ply", "-o", "m.ply")
        self.assertEqual(read_ply(self.dir / "m.ply")[2], list(self.FACES))
        self.assertNotIn("values more", done.err)

    def test_rows_that_are_too_short_are_refused(self):
        self.write("short.ply", self.HEADER + self.POINTS + "3 0 2 1 9 9 9\n" * 3 + "3 0 2\n")
        self.assertIn("short.ply", self.vantage("map", "short.ply", "-o", "m.ply", exit_code=3).err)


if __name__ == "__main__":
    unittest.main()
