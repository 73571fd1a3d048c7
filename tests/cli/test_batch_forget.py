"""What a batch does about models that are gone, results that are damaged and tables that are none."""

import unittest

from program import contract_quickly as setUpModule
from shapes import box
from test_batch import FAST, BatchTest


class Forgetting(BatchTest):

    def setUp(self):
        super().setUp()
        (self.dir / "m").mkdir()
        for i in range(3):
            self.write(f"m/{i}.off", box(1 + i))

    def keys(self, out="out"):
        return self.vantage("results", "query", out, "--columns", "key").out.split()[1:]

    def test_models_that_are_gone_stay_until_they_are_to_be_forgotten(self):
        self.batch("m", out="out")
        (self.dir / "m/1.off").unlink()
        self.write("m/bad.off", "no OFF")
        self.batch("m", out="out", exit_code=4)
        (self.dir / "m/bad.off").unlink()
        self.batch("m", out="out")
        self.assertEqual(self.keys(), ["m/0.off", "m/1.off", "m/2.off", "m/bad.off"])
        done = self.vantage("batch", "m", "-o", "out", "--forget", *FAST)
        self.assertIn("forgotten: 2 models", done.err)
        self.assertEqual(self.keys(), ["m/0.off", "m/2.off"])
        self.assertEqual(len(list((self.dir / "out/models").iterdir())), 2)
        self.assertNotIn("1.off", (self.dir / "out/index.html").read_text())
        self.assertIn("all sound", self.vantage("results", "verify", "out").out)

    def test_a_renamed_model_keeps_its_results_when_its_former_name_is_forgotten(self):
        self.batch("m", out="out")
        (self.dir / "m/1.off").rename(self.dir / "m/x.off")
        self.write("m/y.off", box(2))  # equal to it
        self.vantage("batch", "m", "-o", "out", "--forget", *FAST)
        self.assertEqual(self.keys(), ["m/0.off", "m/2.off", "m/x.off", "m/y.off"])
        status = self.vantage("results", "query", "out", "--columns", "key,status,duplicate_of").out
        self.assertIn("m/y.off  done    m/x.off", status)
        self.assertIn("all sound", self.vantage("results", "verify", "out").out)
        self.batch("m", out="out")
        self.assertEqual(len(list((self.dir / "out/models").iterdir())), 3)

    def test_where_an_input_is_not_there_nothing_is_forgotten(self):
        self.batch("m", out="out")
        (self.dir / "m").rename(self.dir / "elsewhere")
        done = self.vantage("batch", "m", "-o", "out", "--forget", *FAST, exit_code=4)
        self.assertIn("warning: --forget removed nothing: m could not be found or listed", done.err)
        (self.dir / "m").mkdir()
        done = self.vantage("batch", "m", "-o", "out", "--forget", *FAST)
        self.assertIn("warning: --forget removed nothing: no models were found", done.err)
        self.assertEqual(len(list((self.dir / "out/models").iterdir())), 3)

    def test_shards_forget_nothing(self):
        done = self.vantage("batch", "m", "-o", "out", "--forget", "--shard", "0/2", exit_code=2)
        self.assertIn("--forget", done.err)

    def test_verify_does_again_what_lacks_a_file_of_its_results(self):
        self.batch("m", out="out")
        lost = sorted((self.dir / "out/models").glob("*/view.json"))[0]
        camera = next(lost.parent.glob("*.gltf"), lost)
        before = camera.read_bytes()
        camera.unlink()
        self.vantage("results", "verify", "out", exit_code=1)
        self.vantage("batch", "m", "-o", "out", "--verify", *FAST)
        self.assertEqual(camera.read_bytes(), before)
        self.assertIn("all sound", self.vantage("results", "verify", "out").out)

    def test_a_table_without_a_column_path_is_no_list_of_paths(self):
        self.write("list.csv", "file,name\nm/0.off,a\n")
        done = self.vantage("batch", "--manifest", "list.csv", "-o", "out", exit_code=3)
        self.assertIn("line 1: is the header of a table without a column called path", done.err)

    def test_an_export_is_of_the_kind_that_its_file_says(self):
        self.batch("m", out="out")
        self.vantage("results", "export", "out", "-o", "all.jsonl")
        self.assertTrue((self.dir / "all.jsonl").read_text().startswith("{"))
        self.vantage("results", "export", "out", "-o", "all.csv")
        self.assertTrue((self.dir / "all.csv").read_text().startswith("key,"))

    def test_conditions_may_have_blanks(self):
        self.batch("m", out="out")
        rows = self.vantage("results", "query", "out", "--where", "vertices > 5", "--columns", "key").out.split()
        self.assertEqual(len(rows), 4)
        self.assertIn("must be a whole number from 0",
                      self.vantage("results", "query", "out", "--limit", "-1", exit_code=2).err)


if __name__ == "__main__":
    unittest.main()
