"""Odd but legal surfaces through the whole program; real broken files where VANTAGE_DATA is set."""

import base64
import csv
import json
import math
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import unittest

from png import read_png
from program import PROGRAM, ProgramTest
from shapes import TETRAHEDRON, obj, off

QUICK = ("--no-images", "--search", "rapid")
MEMORY = 4 << 30  # bytes
SECONDS = 60
LEAST_SHARE_OF_VIEWS = 0.53  # it is 0.60 of the sample, and 0.56 of every second file
LARGEST_OF_A_SAMPLE = 200_000  # bytes; what is wrong with a file is seldom its size


def written(form, vertices):
    """The tetrahedron with other coordinates, in a text format."""
    faces = TETRAHEDRON[1]
    if form in ("off", "obj"):
        return {"off": off, "obj": obj}[form](vertices, faces)
    rows = [" ".join(map(str, v)) for v in vertices]
    if form == "ply":
        properties = "".join(f"property double {axis}\n" for axis in "xyz")
        return (f"ply\nformat ascii 1.0\nelement vertex 4\n{properties}element face 4\n"
                "property list uchar int vertex_indices\nend_header\n" + "\n".join(rows) + "\n" +
                "".join("3 %d %d %d\n" % f for f in faces))
    return "solid\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {rows[i]}\n" for i in f) +
                               "endloop\nendfacet\n" for f in faces) + "endsolid\n"


class Extremes(ProgramTest):
    """Numbers and nesting at the ends of what formats allow."""

    def refusal(self, form, vertices):
        name = self.write(f"m.{form}", written(form, vertices))
        done = self.vantage("view", name, "-o", "out", *QUICK, exit_code=3)
        self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
        self.assertFalse((self.dir / "out").exists())
        return done.err

    def measures_and_figures(self, size):
        """Scores of each measure, and the bytes of each figure, of a tetrahedron."""
        self.write("limit.obj", written("obj", [(0, 0, 0), (size, 0, 0), (0, size, 0), (0, 0, size)]))
        self.vantage("compare", "limit.obj", "-o", "compared", "--force", "--no-images")
        with open(self.dir / "compared/compare.csv", encoding="utf-8") as table:
            scores = {row["method"]: [float(row[which]) for which in ("score", "worst_score")] for row in csv.DictReader(table)}
        self.vantage("figures", "limit.obj", "-o", "figures", "--force", "--size", "48x36")
        return scores, {path.name: path.read_bytes() for path in (self.dir / "figures").glob("*.png")}

    def test_measures_and_figures_hold_at_the_limits(self):
        scores, figures = self.measures_and_figures(1.0)
        self.assertTrue(all(math.isfinite(value) for values in scores.values() for value in values), scores)
        self.assertGreater(len(figures), 8)
        for name, figure in figures.items():
            rows = read_png(figure)[2]
            self.assertGreater(len({row[i:i + 4] for row in rows for i in range(0, len(row), 4)}), 9, name)
        for size in (2.0**196, 2.0**-196):  # 1e59 and 1e-59; by powers of two no digit changes
            with self.subTest(size=size):
                there, drawn = self.measures_and_figures(size)
                self.assertEqual([name for name, figure in figures.items() if drawn.get(name) != figure], [])
                self.assertEqual(there.keys(), scores.keys())
                for method, values in scores.items():
                    for value, expected in zip(there[method], values):
                        self.assertAlmostEqual(value, expected, delta=1e-9 * abs(expected), msg=method)
        for command in ("compare", "figures"):
            for size in (1e80, 1e-300):
                self.write("beyond.obj", written("obj", [(0, 0, 0), (size, 0, 0), (0, size, 0), (0, 0, size)]))
                with self.subTest(command=command, size=size):
                    done = self.vantage(command, "beyond.obj", "-o", "refused", exit_code=3)
                    self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                    self.assertFalse((self.dir / "refused").exists())

    def test_coordinates_that_vanish_are_refused_in_a_sentence(self):
        tiny = "5e-324"
        for form in ("obj", "off", "ply", "stl"):
            with self.subTest(form=form):
                self.assertIn("too small", self.refusal(form, [(0, 0, 0), (tiny, 0, 0), (0, tiny, 0), (0, 0, tiny)]))

    def test_coordinates_whose_squares_overflow_are_refused_in_a_sentence(self):
        huge = "1.7e308"
        for form in ("obj", "off", "ply", "stl"):
            with self.subTest(form=form):
                self.assertIn("beyond 1e60", self.refusal(form, [(0, 0, 0), (huge, 0, 0), (0, huge, 0), (0, 0, huge)]))

    def test_a_chain_of_two_hundred_thousand_nodes_is_walked(self):
        count = 200_000
        nodes = [{"children": [i + 1]} for i in range(count - 1)] + [{"mesh": 0}]
        points = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        self.write("deep.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": nodes,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," +
                         base64.b64encode(points).decode()}]}))
        self.assertEqual(json.loads(self.vantage("info", "deep.gltf", "--json").out)["vertices"], 3)


class OddSurfaces(ProgramTest):

    def view(self, vertices, faces):
        self.write("m.off", off(vertices, faces))
        self.vantage("view", "m.off", "-o", "out", *QUICK)
        text = (self.dir / "out" / "view.json").read_text()
        self.assertNotIn("NaN", text)
        self.assertNotIn("Infinity", text)
        return json.loads(text)

    def test_single_triangle(self):
        report = self.view([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        self.assertIsNone(report["model"]["genus"])

    def test_tetrahedron(self):
        self.assertEqual(self.view(*TETRAHEDRON)["model"]["genus"], 0)

    def test_isolated_vertices_are_left_out_and_listed(self):
        vertices, faces = TETRAHEDRON
        report = self.view(vertices + [(50, 0, 0)], faces)
        self.assertTrue(any("no face" in w for w in report["warnings"]))
        skeleton = json.loads((self.dir / "out" / "skeleton.json").read_text())
        self.assertEqual(skeleton["vertex_node"][-1], -1)
        self.assertLess(report["camera"]["distance"], 10)

    def test_inside_out_shell_is_turned_and_listed(self):
        vertices, faces = TETRAHEDRON
        right = self.view(vertices, faces)
        turned = self.view(vertices, [f[::-1] for f in faces])
        self.assertTrue(any("inside out" in w for w in turned["warnings"]))
        self.assertEqual(right["best"]["score"], turned["best"]["score"])

    def test_three_faces_on_an_edge(self):
        report = self.view([(0, 0, 0), (0, 0, 1), (1, 0, 0), (-1, 1, 0), (-1, -1, 0)],
                           [(0, 1, 2), (0, 1, 3), (0, 1, 4)])
        self.assertFalse(report["model"]["closed"])
        self.assertEqual(report["model"]["faces"], 3)

    def test_separate_seams_are_welded(self):
        vertices, faces = TETRAHEDRON
        soup = [vertices[i] for f in faces for i in f]
        report = self.view(soup, [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(4)])
        self.assertEqual(report["model"]["vertices"], 4)
        self.assertTrue(report["model"]["closed"])

    def test_hundreds_of_parts(self):
        vertices, faces = [], []
        for i in range(300):
            faces += [[len(vertices) + j for j in f] for f in TETRAHEDRON[1]]
            vertices += [(x + 2 * (i % 20), y + 2 * (i // 20), z) for x, y, z in TETRAHEDRON[0]]
        report = self.view(vertices, faces)
        self.assertEqual(report["model"]["components"], 300)
        self.assertEqual(report["skeleton"]["components"], 300)

    def test_scale_and_place_do_not_change_the_view(self):
        vertices, faces = TETRAHEDRON
        reports = [self.view([[s * x + t for x in v] for v in vertices], faces)
                   for s, t in ((1, 0), (1e-6, 0), (1e6, 0), (1, 1000))]
        for report in reports[1:]:
            for a, b in zip(report["best"]["direction"], reports[0]["best"]["direction"]):
                self.assertAlmostEqual(a, b, places=9)
            self.assertAlmostEqual(report["best"]["score_fraction"],
                                   reports[0]["best"]["score_fraction"], places=9)


class BrokenFiles(ProgramTest):
    """Every file of the pack's nasty/ folder under limits of memory and time."""

    def test_broken_files_end_well_or_with_one_clear_sentence(self):
        data = os.environ.get("VANTAGE_DATA")
        if not data:
            print("\nSKIPPED: VANTAGE_DATA is not set, so no real broken files were tried",
                  file=sys.stderr, flush=True)
            self.skipTest("NOTHING WAS TESTED: VANTAGE_DATA is not set")
        models = {".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".xyz", ".pcd", ".pts", ".pwn", ".gz", ".drc", ".3mf", ".amf"}
        files = sorted(p for p in (pathlib.Path(data) / "nasty").rglob("*")
                       if p.is_file() and p.suffix.lower() in models)
        self.assertGreater(len(files), 200)
        wrong, viewed, tried = [], 0, 0
        stride = int(os.environ.get("VANTAGE_NASTY_STRIDE", "6"))
        for file in files[::stride]:
            if stride > 1 and file.stat().st_size > LARGEST_OF_A_SAMPLE:
                continue
            is_viewed, problem = self.end_of(file)
            tried, viewed = tried + 1, viewed + is_viewed
            if problem:
                wrong.append(f"{file.relative_to(data)}: {problem}")
        self.assertEqual(wrong, [])
        self.assertGreater(viewed, LEAST_SHARE_OF_VIEWS * tried)

    def end_of(self, file):
        """Whether it has a view, and what is wrong with how the run ended, or None."""
        def limit():
            if "VANTAGE_SANITIZED" not in os.environ:  # sanitizers set far more addresses aside
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

        try:
            done = subprocess.run([PROGRAM, "view", str(file), "-o", "out", *QUICK], cwd=self.dir,
                                  capture_output=True, timeout=SECONDS, preexec_fn=limit, check=False)
        except subprocess.TimeoutExpired:
            return False, f"took more than {SECONDS} s"
        if done.returncode == 0:
            return True, self.problem_with_view()
        if done.returncode not in (1, 3):
            return False, f"exit code {done.returncode}: {done.stderr[-300:]!r}"
        if len(done.stderr.decode(errors="replace").strip().splitlines()) != 1:
            return False, f"not one sentence: {done.stderr[-300:]!r}"
        return False, None

    def problem_with_view(self):
        wrong = []
        report = json.loads((self.dir / "out/view.json").read_text(), parse_constant=wrong.append)
        shutil.rmtree(self.dir / "out")
        for which in ("best", "worst"):
            view = report[which]
            numbers = (view["score"], *view["direction"], *view["eye"])
            wrong += [x for x in numbers if not isinstance(x, (int, float)) or not math.isfinite(x)]
        return f"{wrong} in view.json" if wrong else None


if __name__ == "__main__":
    unittest.main()
