"""Measures of a view through the real program: measures, score, view, map, compare, eval."""

import csv
import io
import json
import os
import pathlib
import subprocess
import unittest

from program import MODELS, PROGRAM, ProgramTest, read_ply
from program import contract_quickly as setUpModule
from shapes import angle_bar, box

FAN = MODELS / "fan.ply"


class Measures(ProgramTest):
    def scores(self, *arguments):
        rows = list(csv.DictReader(io.StringIO(self.vantage("score", *arguments).out)))
        by_method = {}
        for row in rows:
            by_method.setdefault(row["method"], []).append(float(row["score"]))
        return by_method

    def test_every_listed_measure_scores_every_view_with_a_finite_number(self):
        listed = json.loads(self.vantage("measures", "--json").out)
        scores = self.scores(FAN, "--sphere", 1, "--method", "all")
        self.assertEqual([m["name"] for m in listed], list(scores))
        for values in scores.values():
            self.assertEqual(len(values), 42)
            self.assertTrue(all(abs(v) < 1e9 for v in values))
        self.assertEqual({m["best"] for m in listed}, {"max", "min"})

    def test_a_cube_from_a_corner_shows_three_sides(self):
        self.write("cube.off", box(1))
        self.write("views.csv", "dx,dy,dz\n1,1,1\n")
        scores = self.scores("cube.off", "--directions", "views.csv", "--projection", "orthographic",
                             "--method", "visible-triangles,visibility-ratio")
        self.assertEqual(scores["visible-triangles"], [6.0])
        self.assertAlmostEqual(scores["visibility-ratio"][0], 0.5, places=12)

    def test_kssm_among_others_is_kssm_alone(self):
        alone = self.scores(FAN, "--sphere", 1)
        among = self.scores(FAN, "--sphere", 1, "--method", "kssm,projected-area")
        self.assertEqual(alone["kssm"], among["kssm"])

    def test_weight_by_area_is_that_of_kssm_alone(self):
        alone = self.scores(FAN, "--sphere", 0, "--weight", "area")["kssm"]
        among = self.scores(FAN, "--sphere", 0, "--weight", "area", "--method", "kssm,plemenos")["kssm"]
        for a, b in zip(alone, among):
            self.assertAlmostEqual(a, b, delta=1e-12 * abs(a))

    def test_an_alias_is_the_measure(self):
        self.assertEqual(list(self.scores(FAN, "--sphere", 0, "--method", "i1")), ["vmi"])

    def test_an_eye_inside_a_closed_shell_sees_nothing_and_scores_worst(self):
        self.write("cube.off", box(1))
        self.write("eyes.csv", "x,y,z\n0.4,0.5,0.6\n")
        out = self.vantage("score", "cube.off", "--eyes", "eyes.csv", "--method", "vmi,max-depth").out
        self.assertEqual([line.split(",")[-1] for line in out.splitlines()[1:]], ["null", "0"])

    def test_an_unknown_method_is_named_with_what_there_is(self):
        for command in (["score", FAN, "--sphere", 0], ["view", FAN], ["compare", FAN]):
            error = self.vantage(*command, "--method", "beauty", exit_code=2).err
            self.assertIn("beauty", error)
            self.assertIn("viewpoint-entropy", error)
            self.assertEqual(len(error.strip().splitlines()), 1)

    def test_a_method_named_twice_is_refused(self):
        self.assertIn("twice", self.vantage("score", FAN, "--sphere", 0, "--method", "vmi,i1",
                                            exit_code=2).err)

    def test_view_finds_what_score_calls_best(self):
        self.vantage("view", FAN, "-o", "out", "--method", "vmi", "--prior", "none", "--no-images")
        report = json.loads((self.dir / "out" / "view.json").read_text())
        self.assertEqual(report["method"], "vmi")
        self.assertIsNone(report["total"])
        of_set = self.scores(FAN, "--sphere", 3, "--method", "vmi")["vmi"]
        self.assertLessEqual(report["best"]["score"], min(of_set) + 1e-12)
        self.assertGreaterEqual(report["worst"]["score"], max(of_set) - 1e-12)

    def test_view_by_mesh_saliency_sums_that_map(self):
        self.vantage("view", FAN, "-o", "out", "--method", "mesh-saliency", "--no-images")
        report = json.loads((self.dir / "out" / "view.json").read_text())
        self.vantage("map", FAN, "-o", "map.ply", "--method", "mesh-saliency")
        _, vertices, _ = read_ply(self.dir / "map.ply")
        self.assertAlmostEqual(report["total"], sum(v["quality"] for v in vertices), delta=1e-4 * report["total"])

    def test_several_views_by_a_measure_without_a_map_are_refused(self):
        self.assertIn("--views", self.vantage("view", FAN, "-o", "out", "--method", "vmi", "--views", 3,
                                              exit_code=2).err)

    def test_the_map_of_polygonal_mutual_information_is_not_negative(self):
        self.vantage("map", FAN, "-o", "map.ply", "--method", "pmi-saliency")
        _, vertices, _ = read_ply(self.dir / "map.ply")
        values = [v["quality"] for v in vertices]
        self.assertGreaterEqual(min(values), 0.0)
        self.assertGreater(max(values), 0.0)

    def test_view_by_pmi_saliency_shows_its_own_map(self):
        bar = self.write("bar.off", angle_bar())
        self.vantage("map", bar, "-o", "map.ply", "--method", "pmi-saliency")
        own = (self.dir / "map.ply").read_bytes()
        self.vantage("view", bar, "-o", "out", "--method", "pmi-saliency", "--no-report", "--size", 64)
        self.assertEqual((self.dir / "out" / "map.ply").read_bytes(), own)
        self.vantage("view", bar, "-o", "vmi", "--method", "vmi", "--no-images")  # has none: KSSM's
        self.assertNotEqual((self.dir / "vmi" / "map.ply").read_bytes(), own)

    def test_measures_lists_what_is_dearest(self):
        cost = {m["name"]: m["cost"] for m in json.loads(self.vantage("measures", "--json").out)}
        self.assertEqual([cost[n] for n in ("kssm", "mesh-saliency", "skeleton-limbs", "projected-area", "i3")],
                         ["kssm map", "saliency map", "skeleton", "faces", "set of views"])

    def test_levels_go_with_the_skeletons_maps_only(self):
        self.vantage("map", FAN, "-o", "map.ply", "--method", "mesh-saliency", "--levels", "l", exit_code=2)

    def test_compare_writes_sheet_tables_and_the_same_bytes_again(self):
        for folder, threads in (("a", 1), ("b", 2)):
            self.vantage("compare", FAN, "-o", folder, "--method", "kssm,mesh-saliency,i2",
                         "--threads", threads)
        names = {"sheet.png", "index.html", "compare.csv", "agreement.csv", "sphere.csv", "compare.json"}
        self.assertEqual({p.name for p in (self.dir / "a").iterdir()}, names | {"timings.csv"})
        for name in names:
            self.assertEqual((self.dir / "a" / name).read_bytes(), (self.dir / "b" / name).read_bytes(), name)
        report = json.loads((self.dir / "a" / "compare.json").read_text())
        self.assertEqual(report["search"], "rings")
        self.assertEqual(len(report["agreement"]), 3)
        for pair in report["agreement"]:
            self.assertLessEqual(pair["best_folded_deg"], pair["best_deg"])
        views = list(csv.DictReader(io.StringIO((self.dir / "a" / "sphere.csv").read_text())))
        self.assertEqual(len(views), 642)
        for method in report["methods"]:  # the search climbs from the best of these
            chosen = max if method["better"] == "max" else min
            best = chosen(float(view[method["method"]]) for view in views)
            self.assertEqual(chosen(best, method["best"]["score"]), method["best"]["score"], method["method"])

    def test_compare_prints_seconds_only_where_bytes_may_differ(self):
        self.write("bar.off", angle_bar())
        printed = json.loads(self.vantage("compare", "bar.off", "-o", "out", "--method", "plemenos,vmi",
                                          "--no-images", "--json").out)
        self.assertTrue(all(m["seconds"] >= 0 for m in printed["methods"]))
        self.assertNotIn("seconds", (self.dir / "out" / "compare.json").read_text())

    def test_gradient_search_from_one_seed_finds_the_same_and_no_more_than_there_is(self):
        found = []
        for folder, seed in (("a", 3), ("b", 3), ("c", 4)):
            self.vantage("view", FAN, "-o", folder, "--method", "mesh-saliency", "--search", "gradient",
                         "--starts", 2, "--seed", seed, "--prior", "none", "--no-images")
            found.append(json.loads((self.dir / folder / "view.json").read_text()))
        self.assertEqual(found[0]["best"], found[1]["best"])
        self.assertNotEqual(found[0]["best"]["direction"], found[2]["best"]["direction"])
        self.assertEqual(found[0]["search"]["seed"], 3)
        self.vantage("view", FAN, "-o", "d", "--method", "mesh-saliency", "--prior", "none", "--no-images")
        best = json.loads((self.dir / "d" / "view.json").read_text())["best"]["score"]
        for report in found:
            self.assertLessEqual(report["best"]["score"], 1.001 * best)
            self.assertGreater(report["best"]["score"], report["worst"]["score"])

    def test_eval_tells_which_columns_a_table_needs(self):
        (self.dir / "people/models").mkdir(parents=True)
        self.write("people/views.csv", "model,dx,dy,dz\na.off,0,0,1\n")
        self.assertIn("views.csv, line 1: has no column 'vx'; needed are model,vx,vy,vz,status",
                      self.vantage("eval", "people", exit_code=3).err)

    def test_compare_by_gradient_counts_its_own_views(self):
        report = json.loads(self.vantage("compare", FAN, "-o", "out", "--method", "mesh-saliency,vmi", "--search",
                                         "gradient", "--starts", 1, "--no-images", "--json").out)
        self.assertEqual(report["search"], "gradient")
        self.assertTrue(all(0 < m["evaluations"] < 642 for m in report["methods"]))

    def test_a_count_has_no_gradient_to_follow(self):
        for command in ("view", "compare"):
            error = self.vantage(command, FAN, "-o", "out", "--method", "visible-triangles", "--search",
                                 "gradient", exit_code=2).err
            self.assertIn("visible-triangles counts", error)

    def test_starts_go_with_the_gradient_search_only(self):
        for command in ("view", "compare"):
            self.assertIn("--starts", self.vantage(command, FAN, "-o", "out", "--starts", 3, exit_code=2).err)

    def test_epsilon_goes_with_the_rapid_search_only(self):
        self.assertIn("--epsilon", self.vantage("view", FAN, "-o", "out", "--epsilon", "0.5", exit_code=2).err)
        self.vantage("view", FAN, "-o", "out", "--epsilon", "0.5", "--search", "rapid", "--no-images")

    def test_flags_that_nothing_would_use_are_refused(self):
        for flag, *words in (("--signed", "view", FAN), ("--saliency-scale", "view", FAN, "--saliency-scale", 0.01, "--method", "vmi"),
                             ("--signed", "map", FAN, "-o", "m.ply"), ("--signed", "score", FAN, "--sphere", 0),
                             ("--signed", "compare", FAN, "--method", "kssm"),
                             ("--kinematics", "map", FAN, "-o", "m.ply", "--method", "pmi-saliency", "--kinematics", "velocity"),
                             ("--fps", "view", FAN, "--views", 2, "--fps", 4), ("--tour-seconds", "view", FAN, "--tour-seconds", 4)):
            words += [flag] if flag not in words else []
            self.assertIn(flag, self.vantage(*words, exit_code=2).err)
        self.write("eyes.csv", "x,y,z\n1,2,3\n")
        for flag, *words in (("--fov", "score", FAN, "--eyes", "eyes.csv", "--fov", 20), ("--up", "score", FAN, "--sphere", 0, "--up", "any"),
                             ("--up", "map", FAN, "-o", "m.ply", "--up", "any"), ("--focus", "compare", FAN, "--method", "kssm,vmi", "--focus", 0),
                             ("--fov", "view", FAN, "--projection", "orthographic", "--fov", 20),
                             ("--starts", "view", FAN, "--starts", 8),  # the default value, too
                             ("--forget", "batch", FAN, "-o", "b", "--forget", "--engine", "slurm"),
                             ("--partition", "batch", FAN, "-o", "b", "--partition", "p"), 
                             ("--meso", "skeleton", FAN, "-o", "s.json", "--meso", "m.obj"), ("--camera", "render", FAN, "-o", "a.png", "--camera", ""),
                             ("--focus", "view", FAN, "--focus", ""), ("--limit", "results", "query", "x", "--limit", -1), ("--seed", "view", FAN, "--seed", -1),
                             ("--json", "results", "export", "x", "--json"), ("--json", "eval", "x", "--json")):
            self.assertIn(flag, self.vantage(*words, exit_code=2).err)
        os.remove(self.dir / "eyes.csv")
        self.write("none.csv", "dx,dy,dz\n")
        self.assertIn("holds no directions", self.vantage("score", FAN, "--directions", "none.csv", exit_code=3).err)
        os.remove(self.dir / "none.csv")
        self.assertIn("say how many views", self.vantage("view", FAN, "--no-refine", exit_code=2).err)
        self.assertIn("no-refine", self.vantage("view", FAN, "--views", 2, "--select", "vazquez", "--no-refine", exit_code=2).err)
        self.assertEqual(os.listdir(self.dir), [])
        self.vantage("score", FAN, "--sphere", 0, "--method", "kssm,mesh-saliency", "--signed")

    def test_a_surface_without_area_is_named(self):
        self.write("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        for command in (["score", "line.off", "--sphere", 0], ["view", "line.off", "-o", "v"],
                        ["compare", "line.off", "-o", "c"]):
            self.assertIn("line.off: ", self.vantage(*command, "--method", "vmi", exit_code=3).err)

    def test_compare_replaces_its_own_folder_but_no_other(self):
        self.write("bar.off", angle_bar())
        self.vantage("compare", "bar.off", "-o", "out", "--method", "plemenos", "--no-images")
        self.vantage("compare", "bar.off", "-o", "out", "--method", "plemenos", "--no-images")
        (self.dir / "mine").mkdir()
        self.write("mine/notes.txt", "mine")
        self.vantage("compare", "bar.off", "-o", "mine", "--method", "plemenos", exit_code=1)
        self.assertEqual([p.name for p in (self.dir / "mine").iterdir()], ["notes.txt"])

    def test_eval_scores_a_camera_that_people_chose_with_no_error(self):
        (self.dir / "set" / "models").mkdir(parents=True)
        self.write("set/models/box.off", box(2))
        self.write("set/views.csv", "model,subject,status,vx,vy,vz\n" +
                   "".join(f"box.off,S{i},moved,0,0,5\n" for i in range(3)))
        self.vantage("eval", "set", "--method", "projected-area", "--views-csv", "rows.csv")
        text = (self.dir / "rows.csv").read_text()
        rows = {r["method"]: r for r in csv.DictReader(io.StringIO(text))}
        self.assertEqual(float(rows["straight front"]["mean_deg"]), 0.0)
        self.assertEqual(float(rows["another person"]["mean_deg"]), 0.0)
        # Over the sphere the mean angle to a fixed direction is a right one.
        self.assertAlmostEqual(float(rows["random"]["mean_deg"]), 90.0, delta=0.5)

    def test_eval_writes_its_tables_between_the_marks_of_a_page(self):
        (self.dir / "set" / "models").mkdir(parents=True)
        self.write("set/models/box.off", box(2))
        self.write("set/views.csv", "model,subject,status,vx,vy,vz\nbox.off,A,moved,1,1,1\nbox.off,B,moved,0,1,1\n")
        self.write("page.md", "before\n<!-- vantage eval begins -->\nstale\n<!-- vantage eval ends -->\nafter\n")
        self.vantage("eval", "set", "--method", "plemenos", "--page", "page.md")
        page = (self.dir / "page.md").read_text()
        self.assertTrue(page.startswith("before\n") and page.endswith("after\n"))
        self.assertNotIn("stale", page)
        self.assertIn("| plemenos |", page)
        self.assertRegex(page, "Made by vantage [0-9.]+ with Eigen .*, options_hash [0-9a-f]+, 1 method of 642 views")

    def test_eval_says_what_is_wrong_with_a_data_set(self):
        (self.dir / "empty").mkdir()
        self.vantage("eval", "empty", exit_code=3)
        (self.dir / "bad").mkdir()
        for view in ("1,1,up", "0,0,0", "1.7e308,1.7e308,1.7e308"):
            self.write("bad/views.csv", f"model,subject,status,vx,vy,vz\nbox.off,A,moved,{view}\n")
            self.assertIn("line 2", self.vantage("eval", "bad", exit_code=3).err)
        self.vantage("eval", "nowhere", exit_code=3)

    def people(self):
        """A manifest of two boxes with two people's views each, and gaze on one of them."""
        for name, size in (("small.off", 1), ("large.off", 2)):
            self.write(name, box(size))
        views = [{"direction": [1, 1, 1], "subject": "A"},
                 {"direction": [0, 0.2, 1], "subject": "B", "status": "kept"}]
        entries = [{"model": "small.off", "views": views, "mirror_planes": [[1, 0, 0]]},
                   {"model": "large.off", "up": "z", "views": views, "gaze": [0, 1, 2, 3, 4, 5, 6, 7]}]
        self.write("people.json", json.dumps({"models": entries}))

    def test_eval_takes_a_manifest_with_views_and_gaze(self):
        self.people()
        self.vantage("eval", "people.json", "--method", "plemenos", "-o", "out")
        rows = list(csv.DictReader(io.StringIO((self.dir / "out" / "views.csv").read_text())))
        self.assertEqual({r["model"] for r in rows}, {"small.off", "large.off"})
        gaze = list(csv.DictReader(io.StringIO((self.dir / "out" / "gaze.csv").read_text())))
        self.assertEqual({r["model"] for r in gaze}, {"large.off"})
        self.assertIn("| plemenos |", (self.dir / "out" / "tables.md").read_text())
        # Only large.off, whose up is z, is left to choose small.off's camera by, and the other way round: (1, 1, 1)
        # in x, y, z is up in part in both, but from behind where z is up.
        constant = [r for r in rows if r["method"] == "best constant camera, model left out"]
        self.assertEqual({r["model"] for r in constant}, {"small.off", "large.off"})
        self.assertTrue(all(float(r["mean_folded_deg"]) > 30 for r in constant), constant)

    def test_eval_goes_on_where_a_killed_run_stopped(self):
        self.people()
        self.vantage("eval", "people.json", "--method", "plemenos", "-o", "whole")
        journal = (self.dir / "whole" / "rows.jsonl").read_text()
        first, second = journal.splitlines()
        (self.dir / "half").mkdir()
        self.write("half/rows.jsonl", first + "\n" + second[:40])  # killed in the middle of a line
        again = self.vantage("eval", "people.json", "--method", "plemenos", "-o", "half")
        self.assertIn("1 of 2 models", again.err)
        for name in ("tables.md", "views.csv", "gaze.csv"):
            self.assertEqual((self.dir / "half" / name).read_bytes(), (self.dir / "whole" / name).read_bytes())
        other = self.vantage("eval", "people.json", "--method", "plemenos,vmi", "-o", "half")
        self.assertNotIn("earlier run", other.err)

    def test_eval_measures_anew_where_the_program_is_another(self):
        self.people()
        run = ["eval", "people.json", "--method", "plemenos", "-o", "out"]
        self.vantage(*run)
        self.assertIn("2 of 2 models", self.vantage(*run).err)
        code = pathlib.Path(PROGRAM).read_bytes()
        word = b"score methods against recorded choices"
        self.assertIn(word, code)
        for name, other, known in (("same", code, True), ("changed", code.replace(word, word.upper()), False)):
            (self.dir / name).write_bytes(other)
            (self.dir / name).chmod(0o755)
            done = subprocess.run([self.dir / name, *run], cwd=self.dir, capture_output=True, text=True, check=True)
            self.assertEqual("earlier run" in done.stderr, known, name)

    def test_eval_tells_models_of_one_file_name_apart(self):
        for folder, size in (("a", 1), ("b, too", 2)):
            (self.dir / folder).mkdir()
            self.write(f"{folder}/box.off", box(size))
        views = [{"direction": [1, 1, 1]}, {"direction": [0, 0.2, 1]}]
        entries = [{"model": name, "views": views} for name in ("a/box.off", "./b, too/box.off")]
        self.write("people.json", json.dumps({"models": entries}))
        self.vantage("eval", "people.json", "--method", "plemenos", "-o", "out")
        self.assertIn("\n2 models.", (self.dir / "out" / "tables.md").read_text())
        rows = list(csv.DictReader(io.StringIO((self.dir / "out" / "views.csv").read_text())))
        self.assertEqual({r["model"] for r in rows}, {"a/box.off", "b, too/box.off"})
        self.assertTrue(all(None not in r for r in rows), "a cell too many")
        self.write("people.json", json.dumps({"models": [entries[0], {**entries[0], "model": "./a/box.off"}]}))
        self.assertIn("again", self.vantage("eval", "people.json", exit_code=3).err)

    def test_eval_tells_models_of_one_name_in_two_folders_apart(self):
        for part, size in (("one", 1), ("two", 2)):
            (self.dir / "set" / part / "models").mkdir(parents=True)
            self.write(f"set/{part}/models/box.off", box(size))
            self.write(f"set/{part}/views.csv", "model,subject,status,vx,vy,vz\nbox.off,A,moved,1,1,1\n")
        self.vantage("eval", "set", "--method", "plemenos", "--views-csv", "rows.csv")
        rows = csv.DictReader(io.StringIO((self.dir / "rows.csv").read_text()))
        self.assertEqual({r["model"] for r in rows}, {"one/box.off", "two/box.off"})

    def test_eval_gives_nobody_a_perfect_score_where_all_kept_the_start(self):
        self.write("box.off", box(2))
        kept = [{"direction": [0, 0, 1], "status": "kept"}] * 3
        self.write("people.json", json.dumps({"models": [{"model": "box.off", "views": kept}]}))
        self.vantage("eval", "people.json", "--method", "plemenos", "-o", "out")
        rows = list(csv.DictReader(io.StringIO((self.dir / "out" / "views.csv").read_text())))
        self.assertEqual({r["model"] for r in rows}, {"box.off"})
        self.assertEqual({r["mean_deg"] for r in rows}, {"null"})
        self.assertNotIn("another person", {r["method"] for r in rows})

    def test_eval_gives_the_same_rows_side_by_side_and_one_by_one(self):
        self.people()
        for folder, threads in (("a", 1), ("b", 2)):
            self.vantage("eval", "people.json", "--method", "plemenos", "-o", folder, "--threads", threads)
        self.assertEqual((self.dir / "a" / "views.csv").read_bytes(), (self.dir / "b" / "views.csv").read_bytes())

    def test_eval_names_what_is_wrong_in_a_manifest(self):
        self.write("box.off", box(1))
        for entry, words in (({"model": "box.off"}, "neither"), ({"model": "gone.off", "gaze": [1]}, "gone.off"),
                             ({"model": "box.off", "gaze": [1], "glance": 1}, "glance"),
                             ({"model": "box.off", "views": [{"direction": [0, 0, 0]}]}, "direction"),
                             ({"model": "box.off", "gaze": [1], "up": "w"}, "up")):
            self.write("people.json", json.dumps({"models": [entry]}))
            self.assertIn(words, self.vantage("eval", "people.json", exit_code=3).err)
        self.write("people.json", "{")
        self.assertIn("people.json", self.vantage("eval", "people.json", exit_code=3).err)

    def test_eval_refuses_gaze_of_another_mesh(self):
        (self.dir / "set" / "gaze").mkdir(parents=True)
        (self.dir / "set" / "meshes").mkdir()
        self.write("set/meshes/box.off", box(2))
        self.write("set/gaze/box.vertex", "1\n2\n")
        self.assertIn("8 vertices", self.vantage("eval", "set", exit_code=1).err)


if __name__ == "__main__":
    unittest.main()
