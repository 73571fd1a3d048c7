# SPDX-License-Identifier: MIT
"""The add-on in the real Blender, without a display: what its buttons do to the scene, and its pictures beside ours."""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
PROGRAM = os.environ.get("VANTAGE", "")
BLENDER = shutil.which("blender")


def alpha_of(path):
    """Rows of booleans: where a picture shows something. By Debian's own reader, for Blender's filters."""
    import matplotlib.image
    return matplotlib.image.imread(path)[..., 3] > 0.5


def shared(first, second):
    """Intersection over union."""
    return (first & second).sum() / (first | second).sum()


@unittest.skipIf(BLENDER is None, "NOTHING WAS TESTED: blender is not installed")
class Addon(unittest.TestCase):
    """One run of Blender; each test looks at a part of what it left."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.out = pathlib.Path(os.environ.get("VANTAGE_KEEP", scratch.name))
        cls.zip = pathlib.Path(scratch.name, "addon.zip")
        subprocess.run([ROOT / "scripts/make_blender_addon.sh", cls.zip], check=True, capture_output=True)
        home = pathlib.Path(scratch.name, "home")
        done = subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "9", "--python",
                               ROOT / "tests/blender/in_blender.py", "--", cls.zip, PROGRAM, ROOT / "models", cls.out],
                              env={**os.environ, "HOME": str(home), "BLENDER_USER_SCRIPTS": str(home)},
                              capture_output=True, text=True, timeout=900, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.result = json.loads((cls.out / "result.json").read_text())

    def silhouette_of_ours(self, name):
        folder = self.out / f"{name} ours"
        subprocess.run([PROGRAM, "view", self.out / f"{name}.ply", "-o", folder, "-q", "--up=z", "--front=-y", "--size",
                        "400x300", "--no-report", "--force"], check=True)
        return json.loads((folder / "view.json").read_text()), alpha_of(folder / "best.png")

    def test_pictures_have_the_silhouette_of_ours(self):
        for name in ("horse", "cat and teddies"):
            with self.subTest(name):
                self.assertEqual(self.result[name]["answer"], ["FINISHED"])
                view, ours = self.silhouette_of_ours(name)
                # Blender's exporter rounds to floats, and the best view of a flat optimum moves with it: within 1°.
                for theirs, wanted in zip(self.result[name]["eye"], view["best"]["eye"]):
                    self.assertAlmostEqual(theirs, wanted, delta=math.radians(1) * view["camera"]["distance"])
                self.assertAlmostEqual(self.result[name]["fov_y_deg"], view["best"]["frame"]["fov_y_deg"], delta=0.2)
                # A row of pixels round the outline of small objects, and that degree.
                self.assertGreater(shared(alpha_of(self.out / f"{name}.png"), ours), 0.97)

    def test_next_views_follow_and_the_worst_is_another(self):
        self.assertEqual([self.result[key] for key in ("NEXT 0", "NEXT 1", "NEXT 2", "WORST 3")], [["FINISHED"]] * 4)
        eyes = [self.result["cat and teddies"]["eye"], *self.result["eyes"]]
        for i, first in enumerate(eyes):
            for second in eyes[:i]:
                self.assertGreater(math.dist(first, second), 0.1)

    def test_a_tour_goes_round_at_one_distance_and_closes(self):
        self.assertEqual(self.result["tour"], ["FINISHED"])
        eyes = self.result["tour_eyes"]
        self.assertEqual(len(eyes), 2 * 24 + 1)
        self.assertLess(math.dist(eyes[0], eyes[-1]), 1e-3 * math.dist(eyes[0], eyes[24]))
        steps = [math.dist(first, second) for first, second in zip(eyes, eyes[1:])]
        self.assertLess(max(steps), 1.5 * min(steps))
        middle = [sum(eye[k] for eye in eyes[:-1]) / (len(eyes) - 1) for k in range(3)]
        for eye, turn in zip(eyes, self.result["tour_turns"]):
            back = [row[2] for row in turn]
            inward = sum(b * (e - m) for b, e, m in zip(back, eye, middle))
            self.assertGreater(inward, 0.0, "looks at the objects")
        self.assertTrue(alpha_of(self.out / "tour.png").any())

    def test_instances_of_collections_are_looked_at_where_they_stand(self):
        self.assertEqual(self.result["instance"], ["FINISHED"])
        self.assertLess(math.dist(self.result["instance_eye"], (10, 0, 0)), 8.0)

    def test_errors_are_shown(self):
        self.assertIn("poll() failed", self.result["errors"]["nothing selected"])
        self.assertIn("Select an object that has faces", self.result["errors"]["no faces"])
        self.assertIn("There is no program /nonexistent/vantage: install vantage, or set its path",
                      self.result["errors"]["no program"])


class Program(unittest.TestCase):

    def test_a_file_that_is_no_program_ends_in_one_sentence(self):
        sys.path.insert(0, str(ROOT / "integrations/blender/vantage_best_view"))
        import program
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "vantage")
            file.write_bytes(b"\0")
            file.chmod(0o755)
            with self.assertRaisesRegex(program.Failed, "cannot be run: Exec format error"):
                program.output_of([str(file)], folder, 10)


class Zip(unittest.TestCase):

    def test_it_holds_the_package_and_its_licence_and_is_the_same_twice(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder, name) for name in ("a.zip", "b.zip")]
            for file in files:
                subprocess.run([ROOT / "scripts/make_blender_addon.sh", file], check=True, capture_output=True)
            self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
            names = zipfile.ZipFile(files[0]).namelist()
        self.assertEqual(names, [f"vantage_best_view/{name}" for name in
                                 ("LICENSE", "__init__.py", "camera.py", "program.py", "surface.py")])


if __name__ == "__main__":
    unittest.main()
