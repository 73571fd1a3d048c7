"""Equal models whose shared results are replaced: each row that is done has its results, or those of an equal one."""

import shutil
import sqlite3
import unittest

from program import contract_quickly as setUpModule
from shapes import box
from test_batch import FAST, BatchTest


class SharedResults(BatchTest):

    def setUp(self):
        super().setUp()
        (self.dir / "m").mkdir()

    def states(self):
        """Of each key how many vertices it has, and whose results it has; all of them are there."""
        self.assertIn("all sound", self.vantage("results", "verify", "out").out)
        rows = self.rows()
        for row in rows.values():
            self.assertEqual(row["status"], "done", row)
            self.assertTrue((self.dir / "out/models" / row["folder"] / "view.json").is_file(), row)
        return {key: (row["vertices"], row["duplicate_of"]) for key, row in rows.items()}

    def fresh(self, *flags):
        """Folders and contents as a batch makes them that has no earlier one."""
        self.vantage("batch", "m", "-o", "fresh", *FAST, *flags)
        return {key: (row["content"], row["folder"]) for key, row in self.rows("fresh").items()}

    def test_a_model_that_got_the_content_of_one_that_is_replaced(self):
        for jobs in (1, 3):
            for names in (("model", "model_old"), ("model", "a_old")):
                for name in (self.dir / "m").iterdir():
                    name.unlink()
                first, second = (self.dir / "m" / f"{name}.off" for name in names)
                first.write_text(box(1))
                flags = [*FAST[:-1], jobs, "--name", f"{{stem}}-{{hash8}}-{jobs}"]
                self.vantage("batch", "m", "-o", "out", *flags, "--forget")
                first.rename(second)
                first.write_text(box(2))
                self.vantage("batch", "m", "-o", "out", *flags)
                self.assertEqual({key: twin for key, (_, twin) in self.states().items()},
                                 {f"m/{name}.off": "" for name in names})
                again = self.vantage("batch", "m", "-o", "out", *flags)
                self.assertIn("0 done, 0 failed, 0 with the content of another, 2 done before", again.out + again.err)

    def test_each_of_equal_models_that_fail_is_named_in_its_own_error(self):
        for name in ("a", "b"):
            self.write(f"m/{name}.off", "")
            self.write(f"m/flat-{name}.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 1\n")
        errors = [self.vantage("batch", "m", "-o", "out", *FAST, exit_code=4).err]
        names = ("m/a.off", "m/b.off", "m/flat-a.off", "m/flat-b.off")
        self.assertEqual(sorted(line.split(": ")[0] for line in errors[0].splitlines()), list(names))
        rows = self.rows()
        for key in names:
            self.assertTrue(rows[key]["error"].startswith(key + ": "), rows[key])
        self.assertEqual(rows["m/b.off"]["duplicate_of"], "m/a.off")
        self.assertEqual(rows["m/a.off"]["error"].split(": ", 1)[1], rows["m/b.off"]["error"].split(": ", 1)[1])

    def test_names_of_another_folder_are_told(self):
        self.write("m/a.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST)
        said = self.vantage("batch", self.dir / "m", "-o", "out", *FAST).err
        self.assertIn("note: 1 model stored under another name before; --forget", said)
        self.assertEqual(self.vantage("batch", self.dir / "m", "-o", "out", *FAST).err, "")

    def test_two_models_that_swap_their_names(self):
        for flags in ([], ["--name", "{stem}"]):
            self.write("m/a.off", box(1))
            self.write("m/b.off", box(2))
            self.vantage("batch", "m", "-o", "out", *FAST, *flags)
            self.write("m/a.off", box(2))
            self.write("m/b.off", box(1))
            self.vantage("batch", "m", "-o", "out", *FAST, *flags)
            self.states()
            rows = self.rows()
            self.assertEqual({key: (row["content"], row["folder"]) for key, row in rows.items()}, self.fresh(*flags))
            for folder in ("out", "fresh"):
                shutil.rmtree(self.dir / folder)

    def test_a_model_that_gets_a_file_of_settings_together_with_a_copy(self):
        self.write("m/a.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST)
        self.write("m/a.off.vantage.json", '{"up": "x"}')
        self.write("m/b.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST)
        self.states()
        rows = self.rows()
        self.assertNotEqual(rows["m/a.off"]["options"], rows["m/b.off"]["options"])
        self.assertNotEqual(rows["m/a.off"]["folder"], rows["m/b.off"]["folder"])

    def test_models_that_are_no_inputs_any_more_keep_the_results_they_share(self):
        for flags in ([], ["--name", "{stem}"]):
            self.write("m/a.off", box(1))
            self.write("m/gone.off", box(1))
            self.write("m/late.off", box(1))
            self.vantage("batch", "m", "-o", "out", *FAST, *flags)
            self.assertEqual(self.rows()["m/gone.off"]["duplicate_of"], "m/a.off")
            (self.dir / "m/gone.off").unlink()
            self.write("m/a.off", box(3))
            self.vantage("batch", "m", "-o", "out", *FAST, *flags)
            states = self.states()
            self.assertEqual([states[f"m/{key}.off"][1] for key in ("a", "gone", "late")], ["", "", "m/gone.off"])
            self.vantage("batch", "m", "-o", "out", *FAST, *flags, "--up", "x")  # replaces again, in place
            self.states()
            self.vantage("batch", "m", "-o", "out", *FAST, *flags, "--up", "x", "--forget")
            self.assertEqual(sorted(self.states()), ["m/a.off", "m/late.off"])
            shutil.rmtree(self.dir / "out")

    def test_shards_keep_them_too(self):
        self.write("m/a.off", box(1))
        self.write("m/b.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST, "--shard", "0/1")
        self.write("m/a.off", box(2))
        self.vantage("batch", "m", "-o", "out", *FAST, "--shard", "0/1")
        self.vantage("results", "merge", "out")
        self.assertEqual(len({row["content"] for row in self.rows().values()}), 2)
        self.states()

    def test_a_merge_keeps_what_it_would_replace(self):
        for folder, size in (("x", 1), ("y", 1)):
            (self.dir / folder).mkdir()
            self.write(f"{folder}/m.off", box(size))
            self.vantage("batch", folder, "-o", f"of-{folder}", *FAST, "--name", "{stem}")
        self.vantage("results", "merge", "out", "of-x", "of-y")
        self.states()
        self.write("x/m.off", box(2))
        self.vantage("batch", "x", "-o", "of-x", *FAST, "--name", "{stem}")
        self.vantage("results", "merge", "out", "of-x")
        self.assertEqual(len({row["content"] for row in self.rows().values()}), 2)
        self.states()

    def test_a_shard_that_replaces_a_model_leaves_its_results_to_its_equals(self):
        self.write("m/a.off", box(1))
        self.write("m/b.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST)
        self.write("m/a.off", box(2))
        self.vantage("batch", "m/a.off", "-o", "out", *FAST, "--shard", "0/1")
        self.vantage("results", "merge", "out")
        self.assertEqual(self.states(), {"m/a.off": (8, ""), "m/b.off": (8, "")})
        self.assertIn("0 new", self.vantage("results", "merge", "out").out)
        self.write("m/b.off", box(2))  # and what nobody has any more goes
        self.vantage("batch", "m/b.off", "-o", "out", *FAST, "--shard", "0/1")
        self.vantage("results", "merge", "out")
        self.assertIn("1 folder of results: all sound", self.vantage("results", "verify", "out").out)

    def test_a_further_batch_in_which_a_model_is_broken_leaves_its_results_to_its_equals(self):
        self.write("m/a.off", box(1))
        self.write("m/b.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST)
        self.write("m/a.off", "")
        self.vantage("batch", "m/a.off", "-o", "part", *FAST, exit_code=4)
        self.assertIn("1 done, 1 failed", self.vantage("results", "merge", "out", "part").out)
        self.assertIn("all sound", self.vantage("results", "verify", "out").out)
        self.assertEqual(self.rows()["m/b.off"]["vertices"], 8)

    def test_a_further_batch_in_which_a_model_equals_another_leaves_no_results_behind(self):
        for folder, size in (("x", 1), ("y", 2)):
            (self.dir / folder).mkdir()
            self.write(f"{folder}/m.off", box(size))
        self.vantage("batch", "x", "y", "-o", "out", *FAST)
        self.write("x/m.off", box(2))
        self.vantage("batch", "x", "-o", "part", *FAST)
        self.vantage("results", "merge", "out", "part")
        self.assertEqual(self.states(), {"x/m.off": (8, "y/m.off"), "y/m.off": (8, "")})

    def test_a_model_that_another_order_makes_a_copy_hands_its_results_over(self):
        self.write("m/a.off", box(1))
        (self.dir / "z").mkdir()
        self.write("z/a.off", box(1))
        self.vantage("batch", "z", "-o", "out", *FAST)
        self.vantage("batch", "m", "z", "-o", "part", *FAST)
        self.vantage("results", "merge", "out", "part")
        self.assertIn("1 folder of results", self.vantage("results", "verify", "out").out)
        self.assertEqual(len(self.states()), 2)

    def test_a_row_that_is_done_without_results_is_no_sound_one(self):
        self.write("m/a.off", box(1))
        self.write("m/b.off", box(1))
        self.vantage("batch", "m", "-o", "out", *FAST)
        store = sqlite3.connect(self.dir / "out/results.sqlite")
        store.execute("UPDATE models SET options = 'other' WHERE key = 'm/b.off'")
        store.commit()
        store.close()
        done = self.vantage("results", "verify", "out", exit_code=1)
        self.assertIn("m/b.off: has the results of m/a.off, which has none of its content", done.out)


if __name__ == "__main__":
    unittest.main()
