"""A folder of results is always of one run: nothing stale in it, and nothing mixed after a kill."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import unittest

from program import PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box

FAST = ("--search", "rapid", "--size", "48")
SHIM = os.environ.get("VANTAGE_KILL_SHIM", "")


def visible(folder):
    """Names and bytes of the files of a folder and of those below it."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(pathlib.Path(folder).rglob("*"))
            if p.is_file() and not p.name.startswith(".")}


class Stale(ProgramTest):
    """What an earlier run wrote and this one did not has gone."""

    def setUp(self):
        super().setUp()
        self.write("horse.off", box(1.0))
        self.write("cup.off", box(2.0, 1.0))

    def names(self, folder):
        return {p.name for p in (self.dir / folder).iterdir()}

    def assert_as_alone(self, first, second, folder):
        """The second command leaves what it leaves in an empty folder; \\return its names."""
        self.vantage(*first, "-o", folder)
        self.vantage(*second, "-o", folder)
        self.vantage(*second, "-o", "alone")
        both, alone = visible(self.dir / folder), visible(self.dir / "alone")
        for files in (both, alone):
            for name in ("timings.json", "timings.csv", "table-1-times.csv", "table-1-times.md"):
                files.pop(name, None)
        self.assertEqual(both, alone)
        shutil.rmtree(self.dir / "alone")

    def test_an_index_that_is_out_of_date_goes(self):
        batch = ("batch", "a.off", "-o", "out", "--search", "rapid", "--write", "best", "--size", "64")
        names = ("index.html", "contact-sheet-0001.png")
        self.write("a.off", box(1))
        self.vantage(*batch)
        self.vantage(*batch, "--no-overview")  # nothing is done, so the page is true
        self.assertTrue(all((self.dir / "out" / name).exists() for name in names))
        self.write("a.off", box(2))
        self.vantage(*batch, "--no-overview")
        self.assertFalse(any((self.dir / "out" / name).exists() for name in names))

    def test_a_view_without_pictures_or_report_after_one_with_all(self):
        full = ("view", "horse.off", *FAST, "--views", "3", "--weight", "area", "--tour", "v/tour.webp", "--tour-seconds", "1",
                "--tour-size", "32")
        self.assert_as_alone(full, ("view", "cup.off", *FAST, "--no-report"), "v")
        self.assert_as_alone(full, ("view", "cup.off", *FAST, "--no-images"), "v")
        self.assert_as_alone(full, ("view", "cup.off", *FAST, "--views", "2", "--weight", "area", "--no-report"), "v")

    def test_an_orthographic_view_after_one_in_perspective(self):
        self.assert_as_alone(("view", "horse.off", *FAST, "--no-images"),
                             ("view", "cup.off", *FAST, "--no-images", "--projection", "orthographic"), "v")

    def test_a_comparison_without_its_page_after_one_with_it(self):
        self.assert_as_alone(("compare", "horse.off", "--method", "silhouette-length"),
                             ("compare", "cup.off", "--method", "silhouette-length", "--no-images"), "c")

    def test_figures_of_one_model_after_those_of_two(self):
        self.assert_as_alone(("figures", "horse.off", "cup.off", *FAST), ("figures", "cup.off", *FAST), "f")

    def test_levels_of_a_shorter_contraction_after_a_longer_one(self):
        for command in (("skeleton", "horse.off", "-o", "s.json"), ("map", "horse.off", "-o", "m.ply")):
            folder = command[0]
            self.vantage(*command, "--levels", folder)
            self.assertGreater(len(self.names(folder)), 3)
            self.vantage(*command, "--levels", folder, "--max-steps", "1")
            self.assertEqual(self.names(folder), {"level-00.ply", "level-01.ply"})

    def test_files_of_others_stay(self):
        self.vantage("view", "horse.off", "-o", "v", *FAST)
        for name in ("notes.txt", "best.jpg", "view-of-mine.png", "level-00.ply", "sheet.png"):
            self.write(f"v/{name}", "mine")
        self.vantage("view", "cup.off", "-o", "v", "--no-images", *FAST)
        for name in ("notes.txt", "best.jpg", "view-of-mine.png", "level-00.ply", "sheet.png"):
            self.assertEqual((self.dir / "v" / name).read_text(), "mine")
        os.mkdir(self.dir / "theirs")
        for name in ("worst.png", "report.html"):
            self.write(f"theirs/{name}", "mine")
        self.vantage("view", "cup.off", "-o", "theirs", "--no-images", "--force", *FAST)
        self.assertEqual((self.dir / "theirs/report.html").read_text(), "mine")

    def test_a_run_that_cannot_write_leaves_the_former_results(self):
        self.vantage("view", "horse.off", "-o", "v", *FAST)
        before = visible(self.dir / "v")
        (self.dir / "v/map.ply").unlink()
        os.mkdir(self.dir / "v/map.ply")
        self.vantage("view", "cup.off", "-o", "v", *FAST, exit_code=1)
        before.pop("map.ply")
        self.assertEqual(visible(self.dir / "v"), before)

    def test_results_make_their_folders(self):
        self.write("a.off", box(1))
        for command in (("render", "a.off", "-o", "1/deep/a.png", "--direction", "1,0,0", "--size", "32"), ("map", "a.off", "-o", "2/a.ply"),
                        ("skeleton", "a.off", "-o", "3/a.obj"), ("thumb", "a.off", "4/a.png", "--size", "32")):
            self.vantage(*command)
            self.assertTrue((self.dir / next(w for w in command if "/" in w)).is_file(), command)

    def test_tours_and_traces_make_their_folders(self):
        self.vantage("view", "horse.off", "-o", "v", *FAST, "--no-images", "--views", "3", "--weight", "area",
                     "--tour", "new/deep/x.webp", "--tour-seconds", "1", "--tour-size", "32", "--trace", "traces/t.csv")
        self.assertTrue((self.dir / "new/deep/x.webp").read_bytes().startswith(b"RIFF"))
        self.assertTrue((self.dir / "traces/t.csv").read_text().startswith("goal,"))


@unittest.skipUnless(SHIM, "NOTHING WAS TESTED: VANTAGE_KILL_SHIM is not set: run this by ctest")
class Killed(ProgramTest):
    """Whenever the program is killed, what is there is of one run, and known as unfinished or whole."""

    def setUp(self):
        super().setUp()
        self.write("horse.off", box(1.0))
        self.write("cup.off", box(2.0, 1.0))

    def killed(self, command, call):
        """\\return whether the program was killed before that call."""
        done = subprocess.run([PROGRAM, *command], cwd=self.dir, capture_output=True, timeout=300, check=False,
                              env={**os.environ, "LD_PRELOAD": SHIM, "KILL_AT": str(call)})
        self.assertIn(done.returncode, (0, -signal.SIGKILL), done.stderr)
        return done.returncode != 0

    def assert_never_mixed(self, first, second, folder, marker, timings, every=1):
        """Kills the second command before each `every`th call that changes the folder of the first."""
        self.vantage(*first, "-o", "a")
        self.vantage(*second, "-o", "b")
        runs = [visible(self.dir / name) for name in ("a", "b")]
        for files in runs:
            for name in timings:
                files[name] = None  # differs from run to run
        call = 1 - every
        while True:
            call += every
            shutil.rmtree(self.dir / folder, ignore_errors=True)
            shutil.copytree(self.dir / "a", self.dir / folder)
            if not self.killed([*second, "-o", folder], call):
                break
            found = visible(self.dir / folder)
            times = {name: found[name] for name in timings if name in found}
            found.update({name: None for name in times})
            with self.subTest(call=call):
                whole = [files for files in runs if found == files]
                part = [files for files in runs if found.items() <= files.items()]
                self.assertTrue(part, sorted(found))
                self.assertEqual(bool(whole), marker in found)
        self.assertGreater(call, len(runs[1]))
        self.assertEqual(set(visible(self.dir / folder)), set(runs[1]))
        return call

    def test_views(self):
        calls = self.assert_never_mixed(("view", "horse.off", *FAST, "--views", "2", "--weight", "area"),
                                        ("view", "cup.off", *FAST, "--no-report"), "v", "view.json", ("timings.json",))
        # What a killed run left is known as ours, and goes with the next run.
        left = 0
        for call in range(calls // 6, calls, max(1, calls // 6)):
            shutil.rmtree(self.dir / "v", ignore_errors=True)
            if not self.killed(["view", "horse.off", *FAST, "-o", "v"], call):
                break
            left += not (self.dir / "v/view.json").exists() and any((self.dir / "v").iterdir())
            self.vantage("view", "cup.off", *FAST, "--no-images", "-o", "v")
            self.assertFalse([p.name for p in (self.dir / "v").iterdir() if p.name.startswith(".")])
            self.assertEqual(json.loads((self.dir / "v/view.json").read_text())["model"]["name"], "cup")
            self.assertFalse((self.dir / "v/best.png").exists())
        self.assertGreater(left, 0, "no run was killed that had begun to write")

    def test_comparisons(self):
        method = ("--method", "silhouette-length")
        self.assert_never_mixed(("compare", "horse.off", *method), ("compare", "cup.off", *method, "--no-images"), "c",
                                "compare.json", ("timings.csv",), every=2)

    def test_figures(self):
        self.assert_never_mixed(("figures", "horse.off", *FAST), ("figures", "cup.off", *FAST), "f",
                                "table-1-times.csv", ("table-1-times.csv", "table-1-times.md"), every=5)


if __name__ == "__main__":
    unittest.main()
