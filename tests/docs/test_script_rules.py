"""What scripts decide by rules of their own: which inputs a fuzzer keeps, how many tests a run was made of, and that what
checks something fails where nothing was checked."""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
import choose_inputs  # noqa: E402
import count_tests  # noqa: E402
import mutate  # noqa: E402

HAS_NUMPY = importlib.util.find_spec("numpy") is not None

# As ctest writes build/…/Testing/Temporary/LastTest.log.
LOG = """1/4 Testing: unit.core.0
[  SKIPPED ] Sandbox.Confines (0 ms)
[==========] 7 tests from 2 test suites ran. (3 ms total)
2/4 Testing: cli.test_view
Ran 21 tests in 3.1s
3/4 Testing: python.other
SKIPPED [2] test_other.py:38: SKIPPED: open3d is not installed
4 passed, 2 skipped in 1.2s
4/4 Testing: replay.inputs.obj
nothing that is counted
"""


def module_of(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Examples(unittest.TestCase):
    EXAMPLES = SCRIPTS.parent / "examples"

    def test_the_page_of_a_collection_names_files_as_addresses(self):
        figure = module_of(self.EXAMPLES / "web/collection_page.py").figure

        def shown(key):
            return figure({"key": key, "name": "n", "folder": "n #1", "format": "gltf",
                           "best": {"model_viewer": {"camera-orbit": "0deg"}}}, "models")

        self.assertIn('src="in/part%20%231%2050%25.gltf"', shown("in/part #1 50%.gltf"))
        self.assertIn('poster="models/n%20%231/best.png"', shown("a.gltf"))
        for key in ("a.zip//x.gltf", "b\\xff.gltf"):  # which no browser can ask for
            self.assertIn('<img src="models/n%20%231/best.png"', shown(key))

    def test_a_broken_shard_goes_before_failed_models(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "ray.py").write_text(
                "def remote(**_):\n    def plain(function):\n        function.remote = function\n"
                "        return function\n    return plain\ninit, get = lambda: None, list\n")
            program = pathlib.Path(folder, "vantage")
            program.write_text('#!/bin/sh\ncase "$*" in *0/2*) exit 4;; *1/2*) exit 2;; esac\n')
            program.chmod(0o755)
            done = subprocess.run([sys.executable, self.EXAMPLES / "engines/ray_shards.py", "in", "out", "2"], check=False,
                                  env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "PYTHONPATH": folder})
            self.assertEqual(done.returncode, 2)


class Scripts(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.dir = pathlib.Path(scratch.name)

    def test_inputs_are_chosen_by_what_is_new_and_the_smaller_of_two(self):
        reached = {}
        for name, size, edges in (("large", 9, {1, 2, 3}), ("small", 2, {1, 2, 3}), ("other", 5, {3, 4}), ("old", 1, {2})):
            (self.dir / name).write_bytes(b"x" * size)
            reached[self.dir / name] = edges
        self.assertEqual([file.name for file in choose_inputs.chosen(reached, 9)], ["small", "other"])
        self.assertEqual([file.name for file in choose_inputs.chosen(reached, 1)], ["small"])

    def test_what_sanitizers_leave_out_is_there(self):
        tests = SCRIPTS.parent / "tests"
        sources = "".join(file.read_text() for file in (tests / "unit").rglob("*.cpp"))
        names = (tests / "left_out_under_sanitizers.txt").read_text().split()
        self.assertTrue(names)
        for name in names:
            suite, test = re.fullmatch(r"(?:\w+/)?(\w+)\.(\w+)(?:/\w+)?", name).groups()
            self.assertRegex(sources, rf"TEST(_F|_P)?\({suite},\s+{test}\)", name)

    def test_tests_of_every_runner_are_counted_and_skips_are_said(self):
        log = self.dir / "Testing/Temporary/LastTest.log"
        log.parent.mkdir(parents=True)
        log.write_text(LOG)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            count_tests.main(self.dir)
        lines = said.getvalue().splitlines()
        self.assertEqual(lines[0], "33 tests in 4 processes, 2 of them skipped")
        self.assertEqual(len(lines), 3)
        self.assertIn("Sandbox.Confines", lines[1])
        self.assertIn("open3d", lines[2])

    def program(self, text, name="vantage"):
        """A program that does what the lines of shell say."""
        file = self.dir / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("#!/bin/sh\n" + text)
        file.chmod(0o755)
        return file

    def test_what_checks_a_folder_says_that_it_is_empty(self):
        program = self.program("echo '[]'\n")
        flags = {"check_hostile.py": "--program", "check_finite.py": "--vantage"}
        if HAS_NUMPY:
            flags["check_measures.py"] = "--vantage"
        (self.dir / "empty").mkdir()
        for script, flag in flags.items():
            for folder in ("empty", "mistyped"):
                with self.subTest(script=script, folder=folder):
                    done = subprocess.run([sys.executable, SCRIPTS / script, self.dir / folder, flag, program],
                                          capture_output=True, text=True, check=False)
                    self.assertEqual(done.returncode, 1)
                    self.assertRegex(done.stderr, rf"^\S+/{folder}: holds no \w+ to check\n$")

    @unittest.skipUnless(HAS_NUMPY, "NOTHING WAS TESTED: numpy is not installed")
    def test_an_identity_that_is_no_number_is_not_held(self):
        import check_measures
        import numpy

        class Program:
            def scores(self, model, methods, *_):
                values = {name: numpy.ones(2) for name in methods.split(",")}
                values["visible-triangles"] *= 4  # of which the entropy is at most 2
                values["i2"][1] = 1 if model.stem == "good" else numpy.nan
                return None, values
        good, bad = pathlib.Path("good.off"), pathlib.Path("bad.off")
        for models, holds in (([good], True), ([bad], False), ([good, bad], False), ([bad, good], False)):
            worst = check_measures.identities(Program(), models)[1]
            self.assertEqual(worst <= check_measures.IDENTITY_BAR, holds)

    def test_mutants_are_made_of_a_tree_whose_tests_pass_only(self):
        (self.dir / "tests/unit/view").mkdir(parents=True)
        (self.dir / "tests/unit/view/CMakeLists.txt").touch()
        for build, tests, said in ((0, 0, None), (1, 0, "does not compile"), (0, 1, "fails its"), (0, None, "fails its")):
            def run(command, *_):
                return build if command[0] == "cmake" else tests
            with unittest.mock.patch.object(mutate, "run", run):
                with self.assertRaisesRegex(SystemExit, said) if said else contextlib.nullcontext():
                    mutate.refuse_broken(self.dir, self.dir, ["view"], 1)

    def threads(self, text, *models):
        """check_threads.sh in a tree whose build is there, with a program of such lines."""
        for name in ("scripts", "models", "bin", "build/tsan-tbb/installed"):
            (self.dir / name).mkdir(parents=True, exist_ok=True)
        shutil.copy(SCRIPTS / "check_threads.sh", self.dir / "scripts")
        self.program("", "bin/cmake")
        self.program(text, "build/tsan/apps/vantage/vantage")
        return subprocess.run([self.dir / "scripts/check_threads.sh", *models], capture_output=True, text=True, check=False,
                              env={"PATH": f"{self.dir / 'bin'}:/usr/bin:/bin"})

    def test_runs_that_fail_or_are_none_do_not_count_as_free_of_races(self):
        self.assertEqual(self.threads("exit 0").returncode, 1)  # no models
        (self.dir / "models/a.ply").touch()
        self.assertEqual(self.threads("exit 0").returncode, 0)
        done = self.threads('[ "$1" != thumb ] || exit 127')
        self.assertEqual(done.returncode, 1)
        self.assertIn("6 runs", done.stdout)
        self.assertIn("1 failed, 0 reports", done.stdout)
        self.assertEqual(self.threads('[ -f "$2" ] || exit 3', "models/mistyped.ply").returncode, 1)
        report = self.threads('echo "WARNING: ThreadSanitizer" >"$(echo "$TSAN_OPTIONS" | sed "s/.*log_path=//; s/ .*//").1"')
        self.assertEqual(report.returncode, 1)
        self.assertIn("0 failed, 1 reports", report.stdout)

    @unittest.skipUnless(HAS_NUMPY, "NOTHING WAS TESTED: numpy is not installed")
    def test_what_is_measured_for_a_fit_is_kept_for_its_program_and_model_and_failures_are_not(self):
        import fit_choices
        program, model = self.dir / "vantage", self.dir / "chair.obj"
        view = json.dumps({"proportions": {}, "total": 1})
        works = f"[ $1 = score ] && echo kssm,0,0,1,2 || echo '{view}'\n"
        model.write_text("v 0 0 0\n")

        def measure(text, made_by):
            self.program(text)
            with contextlib.redirect_stderr(io.StringIO()):
                return fit_choices.measured(program, made_by, model, self.dir)
        self.assertIsNone(measure("exit 1", "a"))
        self.assertEqual(measure(works, "a")["rows"], [[0, 0, 1, 2]])  # that it failed was not kept
        self.assertEqual(measure("exit 1", "a")["rows"], [[0, 0, 1, 2]])
        self.assertIsNone(measure("exit 1", "b"))
        model.write_text("v 0 0 1\n")
        self.assertIsNone(measure("exit 1", "a"))
        (self.dir / "chair.json").write_text('{"failed": "timed out"}')  # of an older form
        self.assertEqual(measure(works, "a")["total"], 1)

    @unittest.skipUnless(HAS_NUMPY, "NOTHING WAS TESTED: numpy is not installed")
    def test_the_habit_weighs_less_until_that_costs_more_than_a_standard_error(self):
        import fit_choices
        import numpy as np
        angles = np.linspace(0, 1, 21)  # of 21 directions to what was recorded, the same for all

        def weights(share):
            entries = [types.SimpleNamespace(shape=np.zeros(5), angles=angles + 1e-3 * i, share=share) for i in range(40)]
            return fit_choices.most_significance(entries, list(range(40)), 0.5, 0.1, np.array([100.0, 1.0])).tolist()
        self.assertEqual(weights(np.zeros(21)), [1 / max(fit_choices.SIGNIFICANCE), 1.0])  # it costs nothing
        self.assertEqual(weights(12 * angles), [1 / 0.05, 1.0])  # the next would take the other end


if __name__ == "__main__":
    unittest.main()
