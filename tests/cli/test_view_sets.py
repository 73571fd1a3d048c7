"""Several views, tours, and scenes of several objects, through the real program."""

import json
import struct
import unittest

from png import read_png
from program import MODELS, ProgramTest
from program import contract_quickly as setUpModule
from shapes import angle_bar

FAN = MODELS / "fan.ply"

# Two upright unit squares, two apart along x, that face each other, each one cell of 2 × 2 quads.
# The eye between them sees each wall's inside, and an eye outside sees one of them alone.
WALLS = """
o left
{left}
o right
{right}
"""


def wall(x, first):
    """A 3 × 3 grid of vertices at `x`, and its 4 quads; `first` is the number of its first vertex."""
    lines = [f"v {x} {y} {z}" for y in (0, 0.5, 1) for z in (0, 0.5, 1)]
    for row in range(2):
        for column in range(2):
            a = first + 3 * row + column
            lines.append(f"f {a} {a + 1} {a + 4} {a + 3}")
    return "\n".join(lines)


class ViewSets(ProgramTest):
    def setUp(self):
        super().setUp()
        self.bar = self.write("bar.off", angle_bar())  # of few vertices and samples

    def report(self, folder="out"):
        return json.loads((self.dir / folder / "view.json").read_text())

    def test_views_begin_with_the_best_and_add_up(self):
        self.vantage("view", FAN, "-o", "out", "--views", 3, "--size", "64x48")
        report = self.report()
        views = report["views"]
        self.assertEqual(len(views), 3)
        self.assertEqual(views[0]["direction"], report["best"]["direction"])
        self.assertAlmostEqual(views[0]["gain"], report["best"]["score"], places=9)
        seen = 0.0
        for i, view in enumerate(views):
            seen += view["gain"]
            self.assertAlmostEqual(view["coverage"], seen / report["view_set"]["reachable"], places=12)
            self.assertEqual(view["image"], f"view-0{i + 1}.png")
            self.assertTrue((self.dir / "out" / view["image"]).exists())
            self.assertTrue((self.dir / "out" / f"camera-view-0{i + 1}.gltf").exists())
        transforms = json.loads((self.dir / "out" / "views.transforms.json").read_text())
        self.assertEqual([f["file_path"] for f in transforms["frames"]], [v["image"] for v in views])
        tour = json.loads((self.dir / "out" / "tour.gltf").read_text())
        self.assertEqual(len(tour["animations"]), 1)

    def test_the_first_view_is_the_best_one_in_every_number(self):
        keys = ("direction", "eye", "score", "score_fraction", "objective", "visible_area_fraction", "frame",
                "score_of_attainable")
        for model, *flags in ((FAN,), (self.bar, "--weight", "area"), (self.bar, "--weight", "area", "--prior", "none")):
            with self.subTest(flags=flags):
                self.vantage("view", model, "-o", "out", "--views", 2, "--no-images", *flags)
                report = self.report()
                for key in keys:
                    self.assertEqual(report["views"][0][key], report["best"][key], key)
                self.assertEqual(report["best"]["objective"] < report["best"]["score"], "--prior" not in flags)
                gains = [view["gain"] for view in report["views"]]
                # What is seen of a face counts in eighths.
                within = 1e-3 if "area" in flags else 1e-12
                self.assertAlmostEqual(gains[0] / report["best"]["score"], 1.0, delta=within)
                self.assertAlmostEqual(sum(gains), report["views"][-1]["coverage"] * report["view_set"]["reachable"],
                                       places=9)
                self.assertLessEqual(report["view_set"]["reachable"], report["total"] * (1 + 1e-12))
                # And the second one's score is what `score` gives, in the best one's unit.
                self.write("d.csv", "dx,dy,dz\n" + ",".join(map(repr, report["views"][1]["direction"])) + "\n")
                weight = [f for f in flags if f not in ("--prior", "none")]
                row = self.vantage("score", model, "--directions", "d.csv", *weight).out.splitlines()[1]
                self.assertAlmostEqual(report["views"][1]["score"], float(row.split(",")[-1]), places=9)
                self.assertAlmostEqual(report["views"][1]["score_fraction"],
                                       report["views"][1]["score"] / report["total"], places=12)

    def test_views_of_a_former_run_are_removed_and_other_files_stay(self):
        self.vantage("view", self.bar, "-o", "out", "--views", 3, "--size", "64x48")
        self.write("out/view-of-mine.png", "mine")
        self.vantage("view", self.bar, "-o", "out", "--views", 2, "--size", "64x48")
        names = {path.name for path in (self.dir / "out").iterdir()}
        self.assertTrue({"view-01.png", "view-02.png", "view-of-mine.png"} <= names)
        self.assertFalse({"view-03.png", "camera-view-03.gltf"} & names)
        self.vantage("view", self.bar, "-o", "out", "--no-images")
        names = {path.name for path in (self.dir / "out").iterdir()}
        self.assertFalse({"view-01.png", "views.png", "views.transforms.json", "tour.gltf", "best.png"} & names)
        self.assertIn("view-of-mine.png", names)

    def test_coverage_is_reached_with_no_view_too_many(self):
        self.vantage("view", FAN, "-o", "out", "--coverage", 0.9, "--no-images")
        report = self.report()
        covered = [view["coverage"] for view in report["views"]]
        self.assertGreaterEqual(covered[-1], 0.9)
        self.assertTrue(all(c < 0.9 for c in covered[:-1]))
        self.assertLessEqual(report["view_set"]["least_views"], len(covered))
        self.assertGreaterEqual(report["view_set"]["most_coverage"], covered[-1] - 1e-12)

    def test_fewest_views_by_entropy_reach_the_coverage_asked_for(self):
        self.vantage("view", FAN, "-o", "out", "--select", "vazquez", "--coverage", 0.9, "--no-images", "--search", "rapid")
        report = self.report()
        covered = [view["coverage"] for view in report["views"]]
        self.assertEqual(report["view_set"]["stop"], "coverage")
        self.assertGreaterEqual(covered[-1], 0.9)
        self.assertTrue(all(c < 0.9 for c in covered[:-1]))
        self.vantage("view", FAN, "-o", "same", "--select", "vazquez", "--views", len(covered), "--no-images",
                     "--search", "rapid")
        self.assertEqual([view["direction"] for view in self.report("same")["views"]],
                         [view["direction"] for view in report["views"]])

    def test_no_views_are_reported_unless_asked_for(self):
        self.vantage("view", FAN, "-o", "out", "--no-images")
        self.assertNotIn("views", self.report())

    def test_every_selection_gives_the_number_asked_for(self):
        for name in ("kssm", "vazquez", "feixas"):
            self.vantage("view", FAN, "-o", name, "--views", 3, "--select", name, "--no-images", "--search", "rapid")
            report = self.report(name)
            self.assertEqual(report["view_set"]["selection"], name)
            self.assertEqual(len(report["views"]), 3)
            self.assertEqual(report["view_set"]["candidates"], 2562 if name == "kssm" else 642)

    def test_set_and_tour_are_the_same_for_any_thread_count(self):
        for threads in (1, 2):
            self.vantage("view", FAN, "-o", f"out{threads}", "--views", 3, "--size", "64x48",
                         "--threads", threads, "--tour", f"tour{threads}.webp", "--tour-size", "40x30",
                         "--tour-seconds", 1, "--fps", 5)
        for file in (self.dir / "out1").iterdir():
            if file.name != "timings.json":
                self.assertEqual(file.read_bytes(), (self.dir / "out2" / file.name).read_bytes(), file.name)
        self.assertEqual((self.dir / "tour1.webp").read_bytes(), (self.dir / "tour2.webp").read_bytes())

    def test_a_tour_without_other_pictures_has_the_files_colours_too(self):
        corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 2)]
        faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
        self.write("box.mtl", "newmtl red\nKd 0.8 0 0\n")
        self.write("box.obj", "mtllib box.mtl\nusemtl red\n" + "".join("v %d %d %d\n" % p for p in corners)
                   + "".join(f"f {face}\n" for face in faces))
        for flag in ("--no-images", "--no-report"):
            self.vantage("view", "box.obj", "-o", "out", "--contraction", "exact", "--views", 2, flag, "--size", "32",
                         "--tour", f"tour{flag}.webp", "--tour-size", "32", "--tour-seconds", 1, "--fps", 2)
        self.assertEqual((self.dir / "tour--no-images.webp").read_bytes(), (self.dir / "tour--no-report.webp").read_bytes())

    def test_tour_has_as_many_pictures_as_its_time_takes(self):
        said = self.vantage("view", self.bar, "-o", "out", "--views", 2, "--no-images", "--tour", "tour.png",
                            "--tour-size", "40x30", "--tour-seconds", 2, "--fps", 4).out
        self.assertIn("  results in  out/\n              tour.png\n", said)
        data = (self.dir / "tour.png").read_bytes()
        at = data.index(b"acTL") + 4
        self.assertEqual(struct.unpack(">II", data[at:at + 8]), (8, 0))

    def test_an_exploration_goes_from_the_best_view_until_enough_is_seen(self):
        small = ("--size", "64x48", "--no-report", "-q")
        for threads in (1, 2):
            self.vantage("view", self.bar, "-o", f"out{threads}", "--coverage", 0.99, "--tour-path", "explore", *small,
                         "--threads", threads, "--tour", f"tour{threads}.webp", "--tour-size", "40x30", "--fps", 2)
        report = self.report("out1")
        way = report["view_set"]["way"]
        self.assertGreaterEqual(way["coverage"], 0.99)
        self.assertEqual(way["stops"][0], report["best"]["direction"])
        self.assertEqual((self.dir / "tour1.webp").read_bytes(), (self.dir / "tour2.webp").read_bytes())
        self.assertEqual((self.dir / "out1/tour.gltf").read_bytes(), (self.dir / "out2/tour.gltf").read_bytes())
        self.vantage("view", self.bar, "-o", "round", "--coverage", 0.99, *small)
        self.assertNotIn("way", self.report("round")["view_set"])
        self.assertNotEqual((self.dir / "round/tour.gltf").read_bytes(), (self.dir / "out1/tour.gltf").read_bytes())
        # The set is the same, one view of it has no round but an exploration.
        self.assertEqual(self.report("round")["views"], report["views"])
        self.vantage("view", self.bar, "-o", "one", "--views", 1, "--tour-path", "explore", "--no-images", "-q")
        self.assertGreaterEqual(self.report("one")["view_set"]["way"]["coverage"], 0.95)
        self.assertTrue((self.dir / "one/tour.gltf").exists())
        self.assertIn("--views", self.vantage("view", self.bar, "--tour-path", "explore", exit_code=2).err)

    def test_pictures_of_any_size_fit_on_a_sheet(self):
        self.vantage("view", self.bar, "-o", "out", "--search", "rapid", "--views", 2, "--size", "4x256",
                     "--projection", "orthographic", "--no-report")
        self.assertEqual(read_png((self.dir / "out/view-02.png").read_bytes())[:2], (4, 256))
        self.assertLess(max(read_png((self.dir / "out/views.png").read_bytes())[:2]), 1000)

    def test_a_tour_of_one_view_is_refused_and_leaves_nothing(self):
        done = self.vantage("view", self.bar, "-o", "out", "--coverage", 0.1, "--no-images", "--tour", "t.webp",
                            exit_code=1)
        self.assertIn("no tour", done.err)
        self.assertEqual(list(self.dir.iterdir()), [self.bar])

    def test_flags_that_do_not_fit_together_are_wrong_usage(self):
        for flags, word in (
                (("--tour", "t.webp"), "--views"),
                (("--views", 2, "--tour", "t.gif"), ".webp"),
                (("--coverage", 0), "coverage"),
                (("--views", 0), "views"),
                (("--min-separation", 30), "--views"),
                (("--select", "feixas", "--coverage", 0.5), "--select"),
                (("--select", "vazquez", "--views", 3, "--min-separation", 20), "--select"),
                (("--views", 2, "--information", 0.5), "feixas"),
                (("--views", 2, "--tour-size", "0x9"), "pixels"),
                (("--views", 1, "--tour", "t.webp"), "--views"),
                (("--views", 3, "--tour", "t.webp", "--tour-seconds", 600, "--fps", 60), "36000")):
            done = self.vantage("view", FAN, "-o", "out", *flags, exit_code=2)
            self.assertIn(word, done.err)
            self.assertEqual(len(done.err.splitlines()), 1)

    def test_visible_table_holds_what_the_scores_add_up(self):
        self.vantage("score", FAN, "--sphere", 1, "--visible", "seen.npy", "-o", "scores.csv")
        scores = [float(row.split(",")[-1])
                  for row in (self.dir / "scores.csv").read_text().splitlines()[1:]]
        data = (self.dir / "seen.npy").read_bytes()
        self.assertEqual(data[:8], b"\x93NUMPY\x01\x00")
        size = struct.unpack("<H", data[8:10])[0]
        self.assertEqual((10 + size) % 64, 0)
        self.assertIn("'|u1', (6,)", data[10:10 + size].decode())  # 42 directions
        record = struct.Struct("<d6s")
        rows = list(record.iter_unpack(data[10 + size:]))
        for i, score in enumerate(scores):
            total = 0.0
            for weight, seen in rows:
                total += weight if seen[i // 8] >> (i % 8) & 1 else 0.0
            self.assertEqual(total, score)

    def test_a_direction_without_a_length_is_bad_input(self):
        self.write("d.csv", "dx,dy,dz\n\n0,0,1\n1.7e308,1.7e308,1.7e308\n")
        self.assertIn("d.csv, line 4: ", self.vantage("score", FAN, "--directions", "d.csv", exit_code=3).err)

    def test_visible_table_needs_directions(self):
        self.write("eyes.csv", "x,y,z\n1,2,3\n")
        done = self.vantage("score", FAN, "--eyes", "eyes.csv", "--visible", "seen.npy", exit_code=2)
        self.assertIn("--visible", done.err)


class Scenes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("walls.obj", WALLS.format(left=wall(0, 1), right=wall(2, 10)))

    def score(self, *flags):
        text = self.vantage("score", "walls.obj", "-q", *flags).out
        return [float(row.split(",")[-1]) for row in text.splitlines()[1:]]

    def test_info_lists_the_objects_with_their_numbers(self):
        out = self.vantage("info", "walls.obj").out
        self.assertRegex(out, r"0  8 faces  left\n")
        self.assertRegex(out, r"1  8 faces  right\n")
        listed = json.loads(self.vantage("info", "walls.obj", "--json").out)["objects"]
        self.assertEqual([(o["index"], o["name"], o["faces"]) for o in listed],
                         [(0, "left", 8), (1, "right", 8)])

    def test_an_eye_between_two_walls_sees_both(self):
        # Between the walls; and outside, before the right wall, which is 1 wide and hides the left.
        self.write("eyes.csv", "x,y,z\n1,0.4,0.4\n2.5,0.4,0.4\n")
        both = self.score("--eyes", "eyes.csv")
        left = self.score("--eyes", "eyes.csv", "--focus", "left")
        right = self.score("--eyes", "eyes.csv", "--focus", "right")
        self.assertGreater(left[0], 0.0)
        self.assertGreater(right[0], 0.0)
        for k in range(2):
            self.assertAlmostEqual(left[k] + right[k], both[k], places=9)
        self.assertEqual(left[1], 0.0)
        self.assertGreater(right[1], 0.0)

    def test_focus_takes_a_number_as_well(self):
        self.write("eyes.csv", "x,y,z\n1,0.4,0.4\n")
        self.assertEqual(self.score("--eyes", "eyes.csv", "--focus", "1"),
                         self.score("--eyes", "eyes.csv", "--focus", "right"))

    def test_best_view_in_focus_is_said_in_the_result(self):
        self.vantage("view", "walls.obj", "-o", "out", "--no-images", "--focus", "left", "--views", 2)
        report = json.loads((self.dir / "out" / "view.json").read_text())
        self.assertEqual(report["focus"], "left")
        # the left wall alone is what there is to see, and some view sees all of it
        self.assertAlmostEqual(report["best"]["score_fraction"], 1.0, places=12)

    def test_an_unknown_focus_is_told_what_there_is(self):
        done = self.vantage("view", "walls.obj", "-o", "out", "--focus", "roof", exit_code=1)
        self.assertIn("'left', 'right'", done.err)
        self.assertFalse((self.dir / "out").exists())


if __name__ == "__main__":
    unittest.main()
