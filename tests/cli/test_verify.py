"""`results verify`: whether all that a batch stored is there, whole, and of its record."""

import json
import sqlite3
import unittest

from program import ProgramTest
from program import contract_quickly as setUpModule
from shapes import box


class Verify(ProgramTest):

    def setUp(self):
        super().setUp()
        for i in range(3):
            self.write(f"m{i}.off", box(1 + i))
        self.write("again.off", box(1))
        self.write("bad.off", "OFF\n1 1 0\n")
        self.words = ("batch", "m0.off", "m1.off", "m2.off", "again.off", "bad.off", "-o", "out", "--search", "rapid",
                      "--size", "48", "--name", "{stem}", "--write", "best,worst,camera", "-q")
        self.vantage(*self.words, exit_code=4)

    def problems(self):
        done = self.vantage("results", "verify", "out", "--json", exit_code=None)
        answer = json.loads(done.out)
        self.assertEqual(done.returncode, 1 if answer["problems"] else 0)
        self.assertEqual((answer["records"], answer["folders"]), (5, 3))
        return answer["problems"]

    def damaged(self, name, content):
        """The problems once a file is replaced, and none after the folder was removed and the batch run again."""
        path = self.dir / "out/models/m1" / name
        path.unlink() if content is None else path.write_bytes(content)
        problems = self.problems()
        for file in (self.dir / "out/models/m1").iterdir():
            file.unlink()
        (self.dir / "out/models/m1").rmdir()
        self.assertEqual(self.problems(), ["m1.off: its results, models/m1, are not there; run the batch again"])
        self.vantage(*self.words, exit_code=4)
        self.assertEqual(self.problems(), [])
        return problems

    def test_a_sound_batch(self):
        self.assertEqual(self.problems(), [])
        self.assertIn("5 records, 3 folders of results: all sound", self.vantage("results", "verify", "out").out)

    def test_files_that_are_gone_cut_off_or_of_something_else(self):
        remedy = "; run the batch again with --verify"
        remove = "; remove models/m1 and run the batch again"
        picture = (self.dir / "out/models/m1/best.png").read_bytes()
        self.assertEqual(self.damaged("best.png", picture[:-7]), [f"m1.off: models/m1/best.png is no whole picture{remedy}"])
        self.assertEqual(self.damaged("worst.png", None), [f"m1.off: models/m1/worst.png is not there{remedy}"])
        self.assertEqual(self.damaged("camera-best.gltf", None), [f"m1.off: models/m1/camera-best.gltf is not there{remedy}"])
        camera = (self.dir / "out/models/m1/camera-best.gltf").read_bytes()
        self.assertEqual(self.damaged("camera-best.gltf", camera[:-7]),
                         [f"m1.off: models/m1/camera-best.gltf has {len(camera) - 7} bytes, not {len(camera)}{remedy}"])
        self.assertEqual(self.damaged("view.json", b'{"vantage": '),
                         [f"m1.off: models/m1/view.json is no JSON{remove}"])
        self.assertEqual(self.damaged("view.json", b""), [f"m1.off: models/m1/view.json is empty{remove}"])
        self.assertEqual(self.damaged("view.json", b"[]"), [f"m1.off: models/m1/view.json is not there or damaged{remove}"])
        other = (self.dir / "out/models/m2/view.json").read_bytes()
        self.assertEqual(self.damaged("view.json", other), [f"m1.off: models/m1/view.json is not what its record says{remedy}"])

    def test_records_and_folders_without_each_other(self):
        (self.dir / "out/models/m2").rename(self.dir / "out/models/m3")
        self.assertEqual(self.problems(), ["m2.off: its results, models/m2, are not there; run the batch again",
                                           "models/m3: results that no record names; remove the folder"])
        with sqlite3.connect(self.dir / "out/results.sqlite") as store:
            store.execute("UPDATE models SET duplicate_of = 'gone.off', content = 'none' WHERE key = 'again.off'")
        store.close()
        self.assertIn("again.off: has the results of gone.off, which has none of its content; run the batch again with again.off", self.problems())

    def test_a_model_that_is_done_without_results_is_done_again(self):
        with sqlite3.connect(self.dir / "out/results.sqlite") as store:
            store.execute("UPDATE models SET folder = '' WHERE key = 'm2.off'")
        store.close()
        done = self.vantage("results", "verify", "out", exit_code=1)
        self.assertIn("m2.off: has no results; run the batch again", done.out + done.err)
        self.vantage(*self.words, exit_code=4)
        self.assertEqual(self.problems(), [])


if __name__ == "__main__":
    unittest.main()
