# SPDX-License-Identifier: MIT
"""Cameras of a catalogue's icons, from a library made here to vantage eval (needs numpy and PIL)."""
import csv
import json
import math
import pathlib
import subprocess
import unittest
import zipfile

from program import ProgramTest
from program import contract_quickly as setUpModule

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
PYTHON = "/usr/bin/python3"  # python3-numpy and python3-pil are packages of that one
MATERIALS = """newmtl wood
Kd 0.6 0.4 0.2
newmtl front
Kd 0.9 0.1 0.1
newmtl back
Kd 0.1 0.3 0.9
"""


def can_run():
    try:
        return subprocess.run([PYTHON, "-c", "import numpy, PIL"], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def block(low, high, material, at):
    """A box of an OBJ, whose first vertex has the number \\p at."""
    points = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    return "".join("v %g %g %g\n" % tuple(p) for p in points) + f"usemtl {material}\n" + "".join(
        "f " + " ".join(str(at + i - 1) for i in face) + "\n" for face in faces)


# A cupboard of which only the colours tell front from back, with drawers on one side of the front.
CUPBOARD = ("mtllib cupboard.mtl\n" + block((-1, 0, -0.5), (1, 2.4, 0.5), "wood", 1)
            + block((-0.9, 0.1, 0.5), (0.9, 2.3, 0.52), "front", 9) + block((-0.9, 0.1, -0.52), (0.9, 2.3, -0.5), "back", 17)
            + block((0.2, 1.2, 0.52), (0.8, 2.1, 0.54), "wood", 25) + block((0.2, 1.2, -0.54), (0.8, 2.1, -0.52), "wood", 33))


@unittest.skipUnless(can_run(), "NOTHING WAS TESTED: python3-numpy or python3-pil is not installed")
class Catalogue(ProgramTest):
    def library(self, views, turn="1 0 0 0 1 0 0 0 1"):
        """A library with one cupboard a view, each with the icon that vantage draws from there."""
        self.write("cupboard.obj", CUPBOARD)
        self.write("cupboard.mtl", MATERIALS)
        lines = []
        with zipfile.ZipFile(self.dir / "Made.sh3f", "w") as archive:
            for i, (azimuth, elevation) in enumerate(views, 1):
                a, e = math.radians(azimuth), math.radians(elevation)
                d = (math.sin(a) * math.cos(e), math.sin(e), math.cos(a) * math.cos(e))
                self.vantage("render", "cupboard.obj", "-o", f"{i}.png", "--direction", ",".join(f"{x:.6f}" for x in d),
                             "--size", "128x128", "--up", "y", "--front", "z")
                archive.write(self.dir / f"{i}.png", f"icons/{i}.png")
                archive.writestr(f"cupboard{i}/cupboard{i}.obj", CUPBOARD)
                archive.writestr(f"cupboard{i}/cupboard.mtl", MATERIALS)
                lines += [f"name#{i}=Cupboard", f"category#{i}=Made", f"icon#{i}=/icons/{i}.png",
                          f"model#{i}=/cupboard{i}/cupboard{i}.obj", f"modelRotation#{i}={turn}"]
            archive.writestr("PluginFurnitureCatalog.properties", "\n".join(lines) + "\n")

    def rebuild(self, *options):
        done = subprocess.run([PYTHON, SCRIPTS / "rebuild_catalogue.py", ".", *options], cwd=self.dir,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def rows(self, name):
        with open(self.dir / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_colours_tell_front_from_back_and_eval_takes_what_was_found(self):
        views = [(30, 20), (150, 20), (-40, 10)]
        self.library(views)
        self.assertIn("3 of 3", self.rebuild("-o", "out", "--dataset").stderr)
        rows = self.rows("out/views.csv")
        self.assertEqual(len(rows), 3)
        for row, (azimuth, elevation) in zip(rows, views):
            self.assertAlmostEqual(float(row["azimuth_deg"]), azimuth, delta=5)
            self.assertAlmostEqual(float(row["elevation_deg"]), elevation, delta=5)
            self.assertGreater(float(row["confidence"]), 0.5)
        people = json.loads((self.dir / "out/people.json").read_text(encoding="utf-8"))
        self.assertEqual(people["models"][0]["up"], "y")
        self.vantage("eval", "out/people.json", "--method", "projected-area", "-o", "evaluated")
        found = {(r["model"], r["method"]): r for r in self.rows("evaluated/views.csv")}
        # The back mirrors the front, so the two others are from 30°, 20° and 40°, 10°: their camera is as near to this one.
        constant = found["models/Made__cupboard1.obj", "best constant camera, model left out"]
        self.assertLess(float(constant["mean_folded_deg"]), 20)
        self.assertGreater(float(constant["mean_deg"]), 0)

    def test_a_rotation_of_the_model_is_a_part_of_its_frame_whatever_the_number_of_processes(self):
        self.library([(30, 20), (-60, 35)], "0 0 1 0 1 0 -1 0 0")  # +z becomes +x
        for jobs in ("1", "2"):
            self.rebuild("-o", jobs, "--jobs", jobs)
        for row, azimuth in zip(self.rows("1/views.csv"), (120, 30), strict=True):
            self.assertAlmostEqual(float(row["azimuth_deg"]), azimuth, delta=5)
        self.assertEqual((self.dir / "1/views.csv").read_bytes(), (self.dir / "2/views.csv").read_bytes())

    def test_an_icon_of_another_thing_is_refused(self):
        self.library([(30, 20), (40, 20)])
        self.write("ring.obj", "".join(f"v {math.cos(i)} {math.sin(i)} 0\n" for i in range(6)) + "f 1 2 3\nf 4 5 6\n")
        with zipfile.ZipFile(self.dir / "Made.sh3f", "a") as archive:
            self.vantage("render", "ring.obj", "-o", "ring.png", "--direction", "0,0,1", "--size", "128x128")
            archive.write(self.dir / "ring.png", "icons/ring.png")
            text = archive.read("PluginFurnitureCatalog.properties").decode().replace("icons/2.png", "icons/ring.png")
            archive.writestr("PluginFurnitureCatalog.properties", text)
        self.rebuild("-o", "out")
        self.assertEqual([r["model"] for r in self.rows("out/views.csv")], ["/cupboard1/cupboard1.obj"])
        refused = self.rows("out/refused.csv")
        self.assertEqual([r["reason"] for r in refused], ["the silhouettes do not fit"])


if __name__ == "__main__":
    unittest.main()
