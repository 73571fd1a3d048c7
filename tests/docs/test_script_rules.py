"""What scripts decide by rules of their own: which inputs a fuzzer keeps, and how many tests a run was made of."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import choose_inputs  # noqa: E402
import count_tests  # noqa: E402

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


if __name__ == "__main__":
    unittest.main()
