"""The same bytes for any number of threads, end to end: by area with a certificate, and on a real large model."""

import os
import pathlib
import unittest

from program import MODELS, ProgramTest
from shapes import angle_bar

THREADS = (1, 2, 3)
DATA = os.environ.get("VANTAGE_DATA")


class Threads(ProgramTest):
    def expect_same_files(self, *arguments):
        """Runs `view` on each number of threads; every file but the times must be the same."""
        folders = [self.dir / f"of-{threads}" for threads in THREADS]
        for folder, threads in zip(folders, THREADS):
            self.vantage("view", *arguments, "-o", folder, "--threads", threads)
        first, *others = folders
        names = {file.name for file in first.iterdir()} - {"timings.json"}
        self.assertTrue({"view.json", "map.ply", "skeleton.json"} <= names)
        for other in others:
            self.assertEqual({file.name for file in other.iterdir()} - {"timings.json"}, names)
            for name in sorted(names):
                # Not assertEqual, which would print megabytes.
                self.assertTrue((first / name).read_bytes() == (other / name).read_bytes(), f"{other.name}: {name}")

    def test_scores_by_area_with_a_certificate(self):
        # A thin shape: its samples are few, and a certificate takes more than ten thousand scores.
        bar = self.write("bar.off", angle_bar())
        self.expect_same_files(bar, "--weight", "area", "--certify", "--views", 2, "--size", "64x48")

    def test_scores_by_area(self):
        self.expect_same_files(MODELS / "fan.ply", "--weight", "area", "--no-images")

    @unittest.skipUnless(DATA, "NOTHING WAS TESTED: set VANTAGE_DATA to the folder of the data pack")
    def test_a_scan_of_43_243_vertices(self):
        # By proxy, by thousands of blocks, and with a search that looks for long: where orders of sums might differ.
        self.expect_same_files(pathlib.Path(DATA, "paper", "armadillo_43243.obj"), "--no-images")


if __name__ == "__main__":
    unittest.main()
