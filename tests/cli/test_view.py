"""`vantage view`: the main job."""

import base64
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

from program import MODELS, PROGRAM, ProgramTest, read_ply
from program import contract_quickly as setUpModule
from shapes import ball_with_pole

REFINED = ("--contraction", "auto")  # for what a refined surface might have otherwise
PNG = b"\x89PNG\r\n\x1a\n"


class View(ProgramTest):

    @classmethod
    def setUpClass(cls):
        """The fan's view of a refined surface, which several tests read."""
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.fan = pathlib.Path(scratch.name, "fan")
        subprocess.run([PROGRAM, "view", MODELS / "fan.ply", "-o", cls.fan, "--no-images", "-q", *REFINED], check=True)

    def test_a_measure_without_a_map_says_that_it_has_no_report(self):
        done = self.vantage("view", MODELS / "fan.ply", "--method", "silhouette-length", "--size", "32", "-o", "measure")
        self.assertIn("there is none for this --method", done.err)
        self.assertFalse((self.dir / "measure" / "report.html").exists())

    def test_writes_pictures_cameras_map_skeleton_and_report(self):
        shutil.copy(MODELS / "cat_lowpoly.ply", self.dir)
        done = self.vantage("view", "cat_lowpoly.ply", "--size", "160x120", "--search", "rapid")
        folder = self.dir / "cat_lowpoly.vantage"
        self.assertEqual(sorted(p.name for p in folder.iterdir()), sorted([
            "best.png", "worst.png", "best-kssm.png", "worst-kssm.png", "best-skeleton.png",
            "worst-skeleton.png", "map.ply", "skeleton.json", "report.html", "view.json", "timings.json",
            "camera-best.gltf", "camera-best.transforms.json", "camera-best.f3d.txt", "camera-best.model-viewer.html",
            "camera-worst.gltf", "camera-worst.transforms.json", "camera-worst.f3d.txt", "camera-worst.model-viewer.html"]))
        self.assertTrue((folder / "best.png").read_bytes().startswith(PNG))
        self.assertIn("cat_lowpoly.vantage/", done.out)

    def test_no_level_has_more_area_than_the_one_before(self):
        for name, flags in (("refined", REFINED), ("paper", ("--preset", "paper"))):
            self.vantage("view", MODELS / "cat_lowpoly.ply", "-o", name, "--no-images", *flags)
        for folder in (self.dir / "refined", self.dir / "paper", self.fan):
            contraction = json.loads((folder / "view.json").read_text())["contraction"]
            areas = contraction["shrinkage"]
            self.assertEqual(areas, sorted(areas, reverse=True), folder.name)
            self.assertLess(areas[-1], 0.2, folder.name)
            self.assertEqual(contraction["levels_used"][0], 0)
            self.assertLessEqual(contraction["levels_used"][-1], contraction["levels"])

    def test_view_json_holds_what_the_manual_lists(self):
        report = json.loads((self.fan / "view.json").read_text())
        self.assertEqual(report["schema"], 1)
        self.assertEqual(report["model"]["vertices"], 820)
        self.assertEqual(report["model"]["genus"], 1)
        self.assertEqual(report["skeleton"]["cycles"], 1)
        self.assertEqual(len(report["contraction"]["shrinkage"]), report["contraction"]["levels"] + 1)
        self.assertLessEqual(report["worst"]["score"], report["best"]["score"])
        best = report["best"]
        self.assertAlmostEqual(math.hypot(*best["direction"]), 1.0, places=12)
        self.assertAlmostEqual(best["score_fraction"], best["score"] / report["total"], places=12)
        camera = report["camera"]
        for axis in range(3):  # the eye stands at centre + R · direction
            self.assertAlmostEqual(
                best["eye"][axis],
                camera["target"][axis] + camera["distance"] * best["direction"][axis], places=6)
        self.assertNotIn("seconds", report)

    def test_prior_is_reported_and_leaves_score_and_worst_view_pure(self):
        reports = {}
        self.write("even.json", '{"vantage_prior": 1}')
        for name, flags in (("default", []), ("none", ["--prior", "none"]),
                            ("even.json", ["--prior", "even.json"]), ("paper", ["--preset", "paper"])):
            self.vantage("view", MODELS / "deer.ply", "-o", "of-" + name, "--no-images", *flags)
            reports[name] = json.loads((self.dir / ("of-" + name) / "view.json").read_text())
        self.assertEqual([r["prior"] for r in reports.values()], ["people", "none", "even.json", "none"])
        self.assertEqual([r["objective"] for r in reports.values()], ["people"] + 3 * ["significance"])
        self.assertLess(reports["default"]["best"]["objective"], reports["default"]["best"]["score"])
        self.assertEqual(reports["none"]["best"]["objective"], reports["none"]["best"]["score"])
        # Under a prior, even one that is 1 everywhere, near-ties between mirror views go to the front.
        even, none = reports["even.json"]["best"], reports["none"]["best"]
        self.assertEqual(even["objective"], even["score"])
        equals = [none, *reports["none"]["twins"]]  # mirror images of the best view, which see as much
        self.assertIn((even["direction"], even["score"]), [(v["direction"], v["score"]) for v in equals])
        # A mirror image may be off by the search's last ring, 0.01°.
        self.assertGreater(even["direction"][2], max(v["direction"][2] for v in equals) - 2e-4)
        self.assertLessEqual(reports["default"]["best"]["score"], reports["none"]["best"]["score"])
        for name in ("default", "none"):  # what the score alone would take is said in both
            self.assertAlmostEqual(reports[name]["highest_score"]["score"], reports["none"]["best"]["score"], places=9)
            for view in (reports[name]["best"], reports[name]["worst"]):
                self.assertAlmostEqual(view["score_of_attainable"], view["score"] / reports[name]["highest_score"]["score"],
                                       places=12)
        self.assertEqual(reports["default"]["worst"], reports["none"]["worst"])
        self.assertEqual(reports["default"]["total"], reports["none"]["total"])
        self.assertGreater(reports["default"]["best"]["direction"][1], 0.0)  # not from below

    def test_pictures_and_the_page_are_left_out_when_not_wanted(self):
        both = {"report.html", "best.png", "worst.png", "best-kssm.png", "worst-kssm.png", "best-skeleton.png",
                "worst-skeleton.png"}
        for flag, left_out in (("--no-report", {"report.html"}), ("--no-images", both)):
            self.vantage("view", MODELS / "fan.ply", "-o", "of" + flag, "--search", "rapid", "--size", "64x48", flag)
            names = {p.name for p in (self.dir / ("of" + flag)).iterdir()}
            self.assertEqual(names & both, both - left_out)
            self.assertIn("view.json", names)

    def report(self, *flags, model=MODELS / "fan.ply", stdin=None):
        """The result, of a rapid search unless another is asked for."""
        search = () if "--search" in flags else ("--search", "rapid")
        done = self.vantage("view", model, "-o", "report", "--no-images", "--json", *search, *flags, stdin=stdin)
        return json.loads(done.out)

    def test_the_scoring_eye_stands_where_the_sphere_fills_the_view_or_as_many_radii_away_as_given(self):
        far = self.report("--distance", "4")["camera"]
        radius = far["distance"] / 4
        self.assertEqual(far["fov_y_deg"], 30)
        for flags, fov in (((), 30), (("--fov", "60"), 60)):
            camera = self.report(*flags)["camera"]
            self.assertEqual(camera["fov_y_deg"], fov)
            self.assertAlmostEqual(camera["distance"] / (radius / math.sin(math.radians(fov / 2))), 1.0, places=12)
        self.assertEqual(self.report("--projection", "orthographic")["camera"]["projection"], "orthographic")

    def test_exhaustive_search_takes_the_highest_and_the_lowest_row_of_the_score_table(self):
        found = self.report("--search", "exhaustive", "--subdivisions", "2", "--prior", "none")
        rows = self.vantage("score", MODELS / "fan.ply", "--sphere", "2").out.splitlines()[1:]
        scores = [float(row.split(",")[-1]) for row in rows]
        self.assertEqual(len(scores), 10 * 4 ** 2 + 2)
        self.assertEqual(found["search"]["evaluations"], len(scores))
        self.assertEqual((found["best"]["score"], found["worst"]["score"]), (max(scores), min(scores)))

    def test_a_certificate_compares_both_views_with_a_dense_search(self):
        flags = ("view", MODELS / "fan.ply", "-o", "out", "--no-images", "--json", "--prior", "none")
        dense = json.loads(self.vantage(*flags, "--search", "dense").out)
        rapid = json.loads(self.vantage(*flags, "--search", "rapid", "--certify").out)
        gap = rapid["search"]["dense"]
        self.assertEqual(gap["evaluations"],
                         dense["search"]["evaluations"] + dense["search"]["worst_evaluations"])
        self.assertAlmostEqual(gap["best_ratio"], rapid["best"]["score"] / dense["best"]["score"], places=12)
        # the range is that of the directions scored, which ends at or just below the refined best
        span = dense["best"]["score"] - dense["worst"]["score"]
        self.assertAlmostEqual(gap["worst_above"],
                               (rapid["worst"]["score"] - dense["worst"]["score"]) / span, places=12)
        self.assertNotIn("dense", json.loads(self.vantage(*flags, "--search", "rapid").out)["search"])

    def test_an_epsilon_that_ends_the_search_at_once_is_noted(self):
        def notes(*flags):
            return [w for w in self.report("--search", "rapid", *flags)["warnings"] if "epsilon" in w]
        self.assertEqual(notes(), [])
        self.assertEqual(notes("--epsilon", "0.0001"), [])
        self.assertIn("100 % of the total", notes("--epsilon", str(self.report()["total"]))[0])

    def test_epsilon_is_a_raw_sum_or_a_share_of_the_total(self):
        share = self.report("--epsilon", "2%")
        self.assertAlmostEqual(share["search"]["epsilon"] / share["total"], 0.02, places=15)
        self.assertEqual(self.report("--epsilon", "2")["search"]["epsilon"], 2)

    def test_options_hash_changes_with_what_shapes_the_result_and_with_nothing_else(self):
        plain = self.report()["options_hash"]
        self.assertEqual(self.report("--threads", "1", "-v")["options_hash"], plain)
        hashes = [self.report(*flags)["options_hash"] for flags in (
            ("--max-steps", "3"), ("--fov", "40"), ("--weight", "area"), ("--prior", "none"), ("--epsilon", "1%"))]
        self.assertEqual(len({plain, *hashes}), 1 + len(hashes))

    def test_no_more_levels_than_steps_allowed(self):
        self.assertEqual(self.report("--max-steps", "2")["contraction"]["levels"], 2)

    def test_standard_input_gives_what_the_file_gives(self):
        piped, read = self.report(model="-", stdin=(MODELS / "fan.ply").read_bytes()), self.report()
        for key in ("best", "worst", "total", "skeleton"):
            self.assertEqual(piped[key], read[key], key)

    def test_a_cloud_of_points_has_a_best_view(self):
        # A cylinder of radius 1 and height 8, points 0.2 apart.
        points = [(math.cos(i * math.pi / 16), math.sin(i * math.pi / 16), 0.2 * k)
                  for k in range(41) for i in range(32)]
        self.write("tube.xyz", "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points))
        found = self.report("--prior", "none", model="tube.xyz")
        self.assertEqual((found["model"]["vertices"], found["model"]["faces"]), (len(points), 0))
        self.assertLess(found["worst"]["score"], found["best"]["score"])
        # The tube has no caps: from an end all of its inner side is seen, from a side half of the outer one.
        self.assertGreater(abs(found["best"]["direction"][2]), abs(found["worst"]["direction"][2]))

    def test_the_page_shows_a_cloud_as_its_pictures_do(self):
        properties = "".join(f"property {kind}\n" for kind in ("float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"))
        self.write("pole.ply", f"ply\nformat ascii 1.0\nelement vertex 230\n{properties}end_header\n"
                   + "".join(f"{x} {y} {z} 220 20 10\n" for x, y, z in ball_with_pole()))
        told = self.vantage("view", "pole.ply", "-o", "out", "--size", "32", "--search", "rapid")
        self.assertIn("pole: 230 points\n", told.out + told.err)
        page = (self.dir / "out" / "report.html").read_text()
        data = json.loads(page.split('id="data">')[1].split("</script>")[0])
        line = (self.dir / "out" / "camera-best.f3d.txt").read_text()
        self.assertTrue(line.endswith(" --point-sprites\n"), line)  # without which f3d shows no points
        self.assertEqual(data["views"][0]["cameras"]["f3d"], line)
        self.assertNotIn("model-viewer", data["views"][0]["cameras"])  # it shows glTF alone
        for part in ("mesh", "asset"):
            places = struct.iter_unpack("<3H", base64.b64decode(data[part]["positions"]))
            heights = [data["frame"]["centre"][1] + data["frame"]["radius"] * 1.25 * (2 * y / 65535 - 1) for _, y, _ in places]
            self.assertEqual(sum(y > 3.55 for y in heights), 30, part)  # an octahedron each
        self.assertEqual(set(struct.iter_unpack("<3B", base64.b64decode(data["asset"]["colours"]))), {(220, 20, 10)})
        self.assertTrue(any("drawn but not counted" in w for w in data["warnings"]), data["warnings"])

    def test_map_keeps_the_order_and_the_digits_of_the_files_vertices(self):
        places = [(0.1, 0.2, 0.3), (4.000000001, 0, 0), (0, 3, 0), (0, 0, 2)]
        self.write("t.off", "OFF\n4 4 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in places)
                   + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
        self.vantage("map", "t.off", "-o", "map.ply")
        _, table, triangles = read_ply(self.dir / "map.ply")
        self.assertEqual([(v["x"], v["y"], v["z"]) for v in table], places)
        self.assertEqual(triangles, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])

    def test_json_goes_alone_to_standard_output_with_seconds(self):
        done = self.vantage("view", MODELS / "fan.ply", "-o", "out", "--no-images", "--json")
        printed = json.loads(done.out)
        seconds = printed.pop("seconds")
        self.assertEqual(set(seconds),
                         {"load", "contract", "skeleton", "map", "search", "render", "total"})
        self.assertEqual(printed, json.loads((self.dir / "out" / "view.json").read_text()))

    def test_files_are_the_same_for_any_thread_count_path_and_time(self):
        self.vantage("view", MODELS / "fan.ply", "-o", "one", "--threads", 1, "--size", "120x90", *REFINED)
        os.mkdir(self.dir / "elsewhere")
        shutil.copy(MODELS / "fan.ply", self.dir / "elsewhere")
        os.utime(self.dir / "elsewhere" / "fan.ply", (1, 1))
        self.vantage("view", "elsewhere/fan.ply", "-o", "two", "--threads", 2, "--size", "120x90", *REFINED)
        for file in (self.dir / "one").iterdir():
            if file.name != "timings.json":
                self.assertEqual(file.read_bytes(), (self.dir / "two" / file.name).read_bytes(),
                                 file.name)

    def test_score_of_the_best_direction_is_the_best_score(self):
        self.vantage("view", MODELS / "fan.ply", "-o", "out", "--no-images")
        report = json.loads((self.dir / "out" / "view.json").read_text())
        views = report["best"], report["worst"]
        self.write("d.csv", "dx,dy,dz\n" + "".join(",".join(map(repr, view["direction"])) + "\n" for view in views))
        scored = self.vantage("score", MODELS / "fan.ply", "--directions", "d.csv").out.splitlines()[1:]
        self.assertEqual([float(row.split(",")[-1]) for row in scored], [view["score"] for view in views])

    def test_total_is_the_sum_of_the_map(self):
        report = json.loads((self.fan / "view.json").read_text())
        names, table, triangles = read_ply(self.fan / "map.ply")
        self.assertEqual(names, ["x", "y", "z", "quality", "red", "green", "blue"])
        self.assertEqual(len(triangles), report["model"]["faces"])
        # quality is stored as float: each value is off by at most 2^-24 of itself
        total = sum(row["quality"] for row in table)
        self.assertAlmostEqual(total / report["total"], 1.0, delta=2.0 ** -24)

    def test_a_zero_of_the_trace_has_no_sign(self):
        self.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
        self.vantage("view", "t.obj", "--no-images", "--contraction", "exact", "--trace", "t.csv")
        self.assertNotIn(",-0,", (self.dir / "t.csv").read_text())

    def test_paper_preset_is_the_papers_search(self):
        self.vantage("view", MODELS / "fan.ply", "-o", "out", "--no-images", "--preset", "paper",
                     "--trace", "trace.csv")
        report = json.loads((self.dir / "out" / "view.json").read_text())
        self.assertEqual(report["preset"], "paper")
        self.assertEqual(report["search"]["strategy"], "rapid")
        self.assertEqual(report["search"]["base"], "cube")
        self.assertEqual(report["search"]["epsilon"], 0.1)
        rows = (self.dir / "trace.csv").read_text().splitlines()
        self.assertEqual(rows[0], "goal,step,level,dx,dy,dz,score")
        start = [row.split(",") for row in rows[1:] if row.startswith("best") and row.split(",")[2] == "0"]
        self.assertEqual(len(start), 8)
        for row in start:
            for value in row[3:6]:
                self.assertAlmostEqual(abs(float(value)), 1 / math.sqrt(3), places=15)
        searched = report["search"]
        self.assertEqual(len(rows) - 1, searched["evaluations"] + searched["worst_evaluations"])

    def test_results_of_ours_are_replaced_and_other_files_never(self):
        arguments = ("view", MODELS / "fan.ply", "-o", "out", "--no-images", "--search", "rapid")
        self.vantage(*arguments)
        self.vantage(*arguments)  # our own results: replaced
        os.mkdir(self.dir / "theirs")
        self.write("theirs/view.json", '{"holiday": "pictures"}')
        done = self.vantage("view", MODELS / "fan.ply", "-o", "theirs", exit_code=1)
        self.assertIn("theirs", done.err)
        self.assertEqual((self.dir / "theirs" / "view.json").read_text(), '{"holiday": "pictures"}')

    def test_up_axis_is_z_for_stl_and_y_otherwise(self):
        stl = "solid t\n"
        for a, b, c in ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)):
            corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
            stl += "facet normal 0 0 0\nouter loop\n"
            stl += "".join(f"vertex {corners[i]}\n" for i in (a, c, b))
            stl += "endloop\nendfacet\n"
        self.write("t.stl", stl + "endsolid t\n")
        self.vantage("view", "t.stl", "--no-images", "--search", "rapid")
        report = json.loads((self.dir / "t.vantage" / "view.json").read_text())
        self.assertEqual(report["up"], "z")
        self.assertEqual(report["model"]["vertices"], 4)
        self.vantage("view", "t.stl", "--no-images", "--search", "rapid", "--up=-x")
        report = json.loads((self.dir / "t.vantage" / "view.json").read_text())
        self.assertEqual(report["up"], "-x")


if __name__ == "__main__":
    unittest.main()
