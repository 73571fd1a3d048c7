"""Answers that should not be trusted say so, and --strict makes them a failure."""

import json
import math
import shutil
import unittest

from png import read_png
from program import MODELS, ProgramTest
from shapes import boxes, off

FAST = ("--search", "rapid", "--size", "64")
DOUBTED = "plates.off"


def needle():
    """A tetrahedron a ten-millionth as thick as it is long."""
    return "OFF\n4 4 0\n0 0 0\n1 0 0\n0.5 1e-7 0\n0.5 0 1e-7\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n"


def plates():
    """Three thin plates: what of their map counts is decided by how they are cut into triangles, and so is the view."""
    return boxes((0, 0, 0, 1, 1, 0.02), (0.2, 0.1, 0.5, 0.7, 0.5, 0.02), (0, 0.4, 1, 0.6, 0.6, 0.02))


def table():
    """A thin plate on four thin legs: its map hangs on its triangles, too, but its best view does not."""
    return boxes((0, 0, 0, 1, 1, 0.02), *((x, y, -0.7, 0.05, 0.05, 0.7) for x in (0.05, 0.9) for y in (0.05, 0.9)))


class Doubts(ProgramTest):

    def view(self, model, *arguments, exit_code=0):
        done = self.vantage("view", model, "-o", "out", *FAST, *arguments, exit_code=exit_code)
        report = json.loads((self.dir / "out/view.json").read_text())
        for doubt in report["doubts"]:
            self.assertIn(doubt, report["warnings"])
            self.assertIn("warning: " + doubt, done.err)
        return done, report

    def test_a_sound_answer_is_not_doubted(self):
        for model in ("horse.ply", "cat_lowpoly.ply"):
            done, report = self.view(MODELS / model, "--no-images", "--strict")
            self.assertEqual(report["doubts"], [])
            self.assertNotIn("warning: ", done.err)

    def test_a_cloud_of_points_is_not_doubted_for_being_one(self):
        points = [(2 + math.cos(v), math.sin(v), u) for u in range(0, 12) for v in [0.5 * i for i in range(13)]]
        self.write("tube.xyz", "".join(f"{x} {y} {z / 2}\n" for x, y, z in points))
        self.assertEqual(self.view("tube.xyz", "--no-images")[1]["doubts"], [])

    def test_a_map_that_hangs_on_the_mesh_is(self):
        self.write(DOUBTED, plates())
        _, report = self.view(DOUBTED, "--no-images")
        self.assertRegex(report["doubts"][0], "hangs on how the surface is cut into triangles.* --method")
        files = {p.name: p.read_bytes() for p in (self.dir / "out").iterdir() if p.name != "timings.json"}
        done, _ = self.view(DOUBTED, "--no-images", "--strict", exit_code=1)
        self.assertEqual(done.err.strip().splitlines()[-1],
                         f"vantage: plates: {report['doubts'][0]} (--strict)")
        self.assertEqual(files, {p.name: p.read_bytes() for p in (self.dir / "out").iterdir() if p.name != "timings.json"})

    def test_a_best_view_that_does_not_hang_on_the_map_is_not(self):
        self.write("table.off", table())
        done = self.vantage("view", "table.off", "-o", "out", "--no-images", "--strict")
        report = json.loads((self.dir / "out/view.json").read_text())
        self.assertEqual(report["doubts"], [])
        self.assertRegex(done.err, "note: the significance map hangs on .* the best view is the same there")

    def test_nor_is_one_whose_mirror_image_is_the_best_of_the_moved_map(self):
        self.write("even.off", boxes(*((0, 0, z, 1, 1, 0.02) for z in (0, 0.5, 1))))
        done, report = self.view("even.off", "--no-images", "--strict")
        self.assertEqual(report["doubts"], [])
        self.assertRegex(done.err, "note: the significance map hangs on .* the best view is the same there")

    def test_other_methods_do_not_answer_for_the_map(self):
        self.write(DOUBTED, plates())
        _, report = self.view(DOUBTED, "--no-images", "--method", "viewpoint-entropy", "--strict")
        self.assertEqual(report["doubts"], [])

    def test_a_picture_that_shows_nothing_is(self):
        self.write("needle.off", needle())
        done, report = self.view("needle.off", "--strict", exit_code=1)
        self.assertRegex(report["doubts"][-1], "the picture shows nothing")
        self.assertTrue((self.dir / "out/best.png").exists(), done.err)

    def test_an_empty_picture_of_the_worst_view_is_noted(self):
        side = range(9)
        corners = [(x, y, 0) for x in side for y in side]
        faces = [(9 * x + y, 9 * x + y + 9, 9 * x + y + 10, 9 * x + y + 1) for x in side[:-1] for y in side[:-1]]
        self.write("flat.off", off(corners, faces))
        done, report = self.view("flat.off", "--strict")
        self.assertEqual(report["doubts"], [])
        self.assertIn("worst.png is next to empty: the model is too thin to show from there", report["warnings"])
        self.assertIn("note: worst.png is next to empty", done.err)

    def test_a_picture_of_specks_is_told(self):
        self.write("far.off", boxes((0, 0, 0, 1, 1, 1), (50, 0, 0, 1, 1, 1)))
        done = self.vantage("render", "far.off", "-o", "far.png", "--direction", "0,0,1", "--size", "400x300", "--json")
        self.assertRegex(done.err, "the picture shows hardly anything: the model is in [0-9]+ of 120000 pixels")
        self.assertIn("warning: " + json.loads(done.out)["warnings"][0], done.err)
        # As it says, --focus helps.
        done = self.vantage("render", "far.off", "-o", "one.png", "--direction", "0,0,1", "--size", "400x300", "--focus", 1)
        self.assertEqual(done.err, "")
        rows = read_png((self.dir / "one.png").read_bytes())[2]
        self.assertGreater(sum(a > 128 for row in rows for a in row[3::4]), 0.2 * 400 * 300)

    def test_a_focus_that_nothing_shows_is(self):
        self.write("inside.off", boxes((0, 0, 0, 5, 5, 5), (2, 2, 2, 1, 1, 1)))
        done, report = self.view("inside.off", "--focus", 1, "--no-images", "--strict", exit_code=1)
        self.assertRegex(report["doubts"][0], "^nothing significant is seen from the best view")
        self.assertNotIn("no view shows more than", done.err)
        drawn = self.vantage("render", "inside.off", "-o", "r.png", "--view", "best", "--focus", 1, "--size", 32, "--json")
        self.assertIn(report["doubts"][0], json.loads(drawn.out)["warnings"])

    def test_a_batch_stores_counts_and_lists_what_is_doubted(self):
        shutil.copy(MODELS / "cat_lowpoly.ply", self.dir / "sound.ply")
        self.write("needle.off", needle())
        self.write("again.off", needle())
        command = ("batch", "sound.ply", "needle.off", "again.off", "-o", "out", *FAST)
        self.assertIn(", 1 not to be trusted;", self.vantage(*command).out)
        self.assertIn("not to be trusted: needle.off; vantage results query out --where 'doubts>0'", self.vantage(*command).out)
        self.assertIn("; vantage results query 'two words' --where", self.vantage("batch", "needle.off", "-o", "two words", *FAST).out)
        texts = self.vantage("results", "query", "out", "--where", "doubt~shows nothing", "--columns", "key,doubt").out
        self.assertRegex(texts, r"^key +doubt\nagain.off +\S.*\nneedle.off +\S.*\n$")
        for _ in range(2):  # also where nothing is left to do
            done = self.vantage(*command, "--strict", exit_code=1)
            self.assertRegex(done.err, "1 of the answers should not be trusted.* --where 'doubts>0'")
        rows = json.loads(self.vantage("results", "query", "out", "--where", "doubts>0", "--json",
                                       "--columns", "name,doubts,status").out)
        self.assertEqual([(row["name"], row["status"]) for row in rows], [("again", "done"), ("needle", "done")])
        page = (self.dir / "out/index.html").read_text()
        table = json.loads(page.split('id="data">')[1].split("</script>")[0])["rows"]
        self.assertEqual({row[1]: bool(row[9] & 8) for row in table}, {"again": True, "needle": True, "sound": False})
        self.vantage("batch", "sound.ply", "-o", "other", *FAST, "--strict")
        self.write("bad.off", "OFF\n1 1 0\n")
        self.vantage(*command, "bad.off", "--strict", exit_code=4)


if __name__ == "__main__":
    unittest.main()
