# SPDX-License-Identifier: MIT
"""The examples for other engines do what a run on this machine does, where the engine is installed."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from test_slurm import write_boxes

VANTAGE = pathlib.Path(os.environ["VANTAGE"])
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "engines"
# The examples name no flags of the method: the shards of four triangles' worth of work need none.
SHARDS = "3"


class EnginesTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vantage-engines-"))
        self.addCleanup(shutil.rmtree, self.folder)
        write_boxes(self.folder / "boxes", 6)
        (self.folder / "boxes" / "broken.obj").write_text("f 1 2 3\n")
        self.environment = dict(os.environ, PATH=f"{VANTAGE.parent}:{os.environ['PATH']}",
                                XDG_CACHE_HOME=str(self.folder / "cache"), HOME=str(self.folder))

    def run_here(self, *command):
        return subprocess.run(command, cwd=self.folder, env=self.environment, check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def check_same_as_local(self, models="boxes", results="out"):
        self.run_here(str(VANTAGE), "batch", models, "-o", "local")
        exports = [self.run_here(str(VANTAGE), "results", "export", out).stdout for out in ("local", results)]
        self.assertEqual(exports[0].count("\n"), 8)  # a header, six boxes, a broken file
        self.assertEqual(exports[0], exports[1])

    @unittest.skipUnless(shutil.which("parallel"), "NOTHING WAS TESTED: GNU parallel is not installed")
    def test_gnu_parallel(self):
        (self.folder / "boxes").rename(self.folder / "my boxes")
        run = self.run_here(str(EXAMPLES / "parallel.sh"), "my boxes", "all of them", SHARDS)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.check_same_as_local("my boxes", "all of them")

    @unittest.skipUnless(shutil.which("snakemake"), "NOTHING WAS TESTED: Snakemake is not installed")
    def test_snakemake(self):
        run = self.run_here("snakemake", "--snakefile", str(EXAMPLES / "Snakefile"), "--cores", "2",
                            "--config", "models=boxes", "results=out", f"shards={SHARDS}")
        self.assertEqual(run.returncode, 0, run.stdout)
        self.check_same_as_local()


if __name__ == "__main__":
    unittest.main()
