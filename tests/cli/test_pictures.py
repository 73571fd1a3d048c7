"""How pictures look: against golden ones, and what the flags for them promise."""

import json
import pathlib
import sys
import unittest

from png import borders, read_png
from program import MODELS, ProgramTest, read_ply
from shapes import angle_bar, box

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from update_goldens import GOLDENS, picture_arguments  # noqa: E402

# The ladder: what a difference means, as root mean square over all bytes, of 255; 0: equal.
INDISTINGUISHABLE = 1.0  # another compiler or processor: rounding moves a few samples across edges
SMALL = 8.0              # a light or a line has changed: nobody may do that by accident


def difference(a, b):
    """Root mean square over all bytes of two PNGs of one size."""
    (width, height, rows), (other_width, other_height, other_rows) = read_png(a), read_png(b)
    assert (width, height) == (other_width, other_height)
    squares = sum((p - q) ** 2 for row, other in zip(rows, other_rows) for p, q in zip(row, other))
    return (squares / (4 * width * height)) ** 0.5


class Goldens(ProgramTest):

    def test_pictures_are_those_of_the_goldens(self):
        wanted = json.loads((GOLDENS / "pictures.json").read_text())
        self.assertEqual({p.stem for p in GOLDENS.glob("*.png")}, set(wanted))
        for name, flags in wanted.items():
            with self.subTest(name):
                self.vantage(*picture_arguments(flags, self.dir / "new.png"))
                self.assertLessEqual(difference((self.dir / "new.png").read_bytes(),
                                                (GOLDENS / f"{name}.png").read_bytes()), INDISTINGUISHABLE)

    def test_the_ladder_tells_one_look_from_another(self):
        clay, drawing = ((GOLDENS / f"{name}.png").read_bytes() for name in ("clay", "drawing"))
        self.assertGreater(difference(clay, drawing), SMALL)


class Looks(ProgramTest):

    def picture(self, *flags, size="90x60"):
        self.vantage("render", MODELS / "fan.ply", "-o", "p.png", "--size", size, "--quality", "draft",
                     "--direction", "1,0.5,1", *flags)
        return None if "--depth" in flags else read_png((self.dir / "p.png").read_bytes())

    def test_the_margin_is_kept_to_a_pixel_on_two_opposite_sides_and_by_all(self):
        for per_cent in (0, 4, 20):
            left, right, top, bottom = borders(self.picture("--margin", per_cent, size="200x150"), above=8)
            margin = per_cent / 100 * 150
            self.assertGreaterEqual(min(left, right, top, bottom), margin - 1.5)
            across = abs(left - margin) <= 1 and abs(right - margin) <= 1
            along = abs(top - margin) <= 1 and abs(bottom - margin) <= 1
            self.assertTrue(across or along, (per_cent, left, right, top, bottom))

    def test_backgrounds(self):
        for text, top, bottom in (("white", (255, 255, 255), (255, 255, 255)),
                                  ("#102030", (16, 32, 48), (16, 32, 48)),
                                  ("#000000:#ffffff", (2, 2, 2), (253, 253, 253)),
                                  ("white:black", (253, 253, 253), (2, 2, 2))):
            rows = self.picture("--background", text)[2]
            self.assertEqual((tuple(rows[0][:4]), tuple(rows[-1][:4])), (top + (255,), bottom + (255,)), text)

    def test_unknown_looks_are_wrong_usage(self):
        for flags in (("--background", "mauve"), ("--background", "white:"), ("--background", "#12345"),
                      ("--style", "baroque"), ("--quality", "best"), ("--margin", "50"), ("--crease", "81")):
            self.vantage("render", MODELS / "fan.ply", "-o", "p.png", "--direction", "1,0,0", *flags, exit_code=2)

    def test_an_asset_shows_the_colours_of_its_file(self):
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" \
               "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n" \
               "property list uchar int vertex_indices\nend_header\n"
        text += "".join(f"{x} {y} {z} 200 20 20\n" for x, y, z in corners) + "4 0 1 2 3\n"
        self.write("red.ply", text)
        for style, red in (("asset", True), ("clay", False)):
            self.vantage("render", "red.ply", "-o", "p.png", "--size", "32x32", "--direction", "0,0,1", "--style", style)
            r, g, _, a = read_png((self.dir / "p.png").read_bytes())[2][16][64:68]
            self.assertEqual((a, r > 3 * g), (255, red), style)

    def test_an_asset_shows_its_texture_and_the_seam_of_two_materials_stays_sharp(self):
        self.write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")
        self.write("two.obj", "mtllib two.mtl\nv -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\n"
                              "usemtl red\nf 1 2 3 4\nusemtl blue\nf 2 5 6 3\n")
        self.vantage("render", "two.obj", "-o", "p.png", "--size", "32x32", "--direction", "0,0,1", "--style", "asset",
                     "--margin", "0")
        row = read_png((self.dir / "p.png").read_bytes())[2][16]
        left, right = row[4 * 12:4 * 12 + 3], row[4 * 20:4 * 20 + 3]
        self.assertGreater(left[0], 3 * left[2])
        self.assertGreater(right[2], 3 * right[0])

    def test_an_empty_picture_is_doubted_at_either_depth_on_every_background(self):
        self.write("flat.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
        for depth in ("8", "16"):
            for background in ("transparent", "white", "gradient"):
                said = self.vantage("render", "flat.off", "-o", "p.png", "--direction", "1,0,0", "--depth", depth, "--size",
                                    "32", "--background", background).err
                self.assertIn("the picture shows nothing", said)

    def test_depth_of_16_bit_is_for_pngs_and_the_same_for_any_number_of_threads(self):
        deep = []
        for threads in (1, 2):
            self.picture("--depth", 16, "--threads", threads)
            deep.append((self.dir / "p.png").read_bytes())
        self.assertEqual((deep[0] == deep[1], deep[0][24]), (True, 16))
        for command in (("render", "--direction", "1,0,0"), ("thumb",)):
            self.vantage(command[0], MODELS / "fan.ply", "-o", "p.webp", "--depth", "16", *command[1:], exit_code=2)

    def test_a_webp_that_is_too_large_is_refused_before_any_work(self):
        for command in (("render", "gone.off", "-o", "p.webp", "--direction", "1,0,0", "--size", "100x16384"),
                        ("view", "gone.off", "--views", "2", "--tour", "t.webp", "--tour-size", "16384x64")):
            self.assertIn("a WebP has sides of at most 16383 pixels, not 16384", self.vantage(*command, exit_code=2).err)
        self.vantage("render", "gone.off", "-o", "p.png", "--direction", "1,0,0", "--size", "100x16384", exit_code=3)

    def test_the_map_can_be_drawn_too(self):
        rows = self.picture("--show", "kssm", "--style", "technical")[2]
        colourful = [p for row in rows for p in zip(row[0::4], row[1::4], row[2::4], row[3::4])
                     if p[3] == 255 and max(p[:3]) - min(p[:3]) > 100]
        self.assertGreater(len(colourful), 100)


class Figures(ProgramTest):

    def test_all_are_written_and_named(self):
        done = self.vantage("figures", MODELS / "fan.ply", "-o", "f", "--size", "40x30", "--json")
        files = json.loads(done.out)["files"]
        self.assertEqual(sorted(pathlib.Path(f).name for f in files), sorted(p.name for p in (self.dir / "f").iterdir()))
        self.assertEqual([pathlib.Path(f).name[:8] for f in files], [f"figure-{n}" for n in "12344567"] + ["figure-8", "views.pn", "table-1-", "table-1-"])
        # Four panels of 40 × 30 with 12 px of text below, and gaps of 8 px.
        self.assertEqual(read_png((self.dir / "f" / "figure-8-worst.png").read_bytes())[:2], (4 * 48 + 8, 30 + 12 + 16))
        rows = (self.dir / "f" / "table-1-times.csv").read_text().splitlines()
        self.assertEqual((len(rows), rows[1].split(",")[:2]), (2, ['"fan"', "820"]))

    def test_several_models_get_a_folder_each_and_one_table(self):
        self.write("bar.off", angle_bar())
        self.write("box.off", box(1))
        self.vantage("figures", "bar.off", "box.off", "-o", "f", "--size", "40x30", "-q", "--search", "rapid", "--views", "2")
        self.assertTrue((self.dir / "f/bar/figure-4-search.svg").exists())
        self.assertTrue((self.dir / "f/box/figure-6-spheres.png").exists())
        self.assertEqual(len((self.dir / "f/table-1-times.csv").read_text().splitlines()), 3)

    def test_points_have_figures_too_without_saliency(self):
        _, points, _ = read_ply(MODELS / "fan.ply")
        self.write("cloud.xyz", "\n".join(f"{p['x']} {p['y']} {p['z']}" for p in points))
        self.vantage("figures", "cloud.xyz", "-o", "f", "--size", "40x30", "-q", "--search", "rapid", "--views", "2")
        names = sorted(p.name for p in (self.dir / "f").iterdir())
        self.assertEqual(len([n for n in names if n.startswith("figure-")]), 9)
        self.assertEqual(read_png((self.dir / "f/figure-8-worst.png").read_bytes())[:2], (2 * 48 + 8, 30 + 12 + 16))
        self.assertEqual(read_png((self.dir / "f/figure-6-spheres.png").read_bytes())[0], 48 + 8)


if __name__ == "__main__":
    unittest.main()
