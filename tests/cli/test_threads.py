"""The same bytes for any number of threads, end to end: by area with a certificate, and on a real large model."""

import collections
import os
import pathlib
import subprocess
import unittest

from program import MODELS, PROGRAM, ProgramTest
from shapes import angle_bar

THREADS = (1, 3)  # two: test_view, test_view_sets and test_thumb. Of two cores, three threads are two.
DATA = os.environ.get("VANTAGE_DATA")


class Threads(ProgramTest):
    def threads_used(self, *arguments):
        """Runs `view`; how many threads the process had most of the time."""
        seen = collections.Counter()
        with subprocess.Popen([PROGRAM, "view", *map(str, arguments)], cwd=self.dir, stderr=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL) as process:
            while process.poll() is None:
                seen[len(os.listdir(f"/proc/{process.pid}/task"))] += 1
                try:
                    process.wait(timeout=0.01)
                except subprocess.TimeoutExpired:
                    pass
        self.assertEqual(process.returncode, 0)
        return seen.most_common(1)[0][0]

    def expect_same_files(self, *arguments):
        """Runs `view` on each number of threads; every file but the times must be the same."""
        one, several = (self.dir / f"of-{threads}" for threads in THREADS)
        used = [self.threads_used(*arguments, "-o", folder, "--threads", threads)
                for folder, threads in zip((one, several), THREADS)]
        # A helper that waits for signals is one of either number.
        self.assertEqual(used[1] - used[0], min(THREADS[1], len(os.sched_getaffinity(0))) - 1)
        names = {file.name for file in one.iterdir()} - {"timings.json"}
        self.assertTrue({"view.json", "map.ply", "skeleton.json"} <= names)
        self.assertEqual({file.name for file in several.iterdir()} - {"timings.json"}, names)
        for name in sorted(names):
            # Not assertEqual, which would print megabytes.
            self.assertTrue((one / name).read_bytes() == (several / name).read_bytes(), name)

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
