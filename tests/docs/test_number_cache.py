"""What a script measured counts only for the very program, scripts and model that it was measured with."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from number_cache import Cache, fingerprint  # noqa: E402


class NumberCache(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.dir = pathlib.Path(scratch.name)
        for name in ("program", "model"):
            (self.dir / name).write_text(name)

    def made_from(self):
        return fingerprint(self.dir / "program", self.dir / "model")

    def test_gives_back_what_the_same_program_measured(self):
        Cache(self.dir / "numbers.json").put("cow", self.made_from(), {"views": 3})
        again = Cache(self.dir / "numbers.json")
        self.assertEqual(again.find("cow", self.made_from()), {"views": 3})
        self.assertIsNone(again.find("horse", self.made_from()))

    def test_forgets_what_another_program_measured_or_of_another_model(self):
        for name in ("program", "model"):
            Cache(self.dir / "numbers.json").put("cow", self.made_from(), {"views": 3})
            (self.dir / name).write_text("changed")
            self.assertIsNone(Cache(self.dir / "numbers.json").find("cow", self.made_from()))

    def test_tells_files_apart_that_share_their_bytes_in_another_way(self):
        first = self.made_from()
        (self.dir / "program").write_text("programm")
        (self.dir / "model").write_text("odel")
        self.assertNotEqual(self.made_from(), first)

    def test_takes_a_file_of_an_older_form_for_nothing(self):
        (self.dir / "numbers.json").write_text('{"cow": {"views": 3}}')
        self.assertIsNone(Cache(self.dir / "numbers.json").find("cow", self.made_from()))


if __name__ == "__main__":
    unittest.main()
