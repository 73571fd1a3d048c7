"""Shards of a batch, and merging them and further batches."""

import json
import os
import shutil
import unittest
import unittest.mock

from program import contract_quickly as setUpModule
from shapes import box
from test_batch import FAST, BatchTest


class Shards(BatchTest):

    def setUp(self):
        super().setUp()
        for i in range(12):
            self.write(f"{i:02}.off", box(1 + i // 2))  # pairs of equal models, apart or together
        self.write("bad.off", "no OFF")
        self.names = [f"{i:02}.off" for i in range(12)] + ["bad.off"]

    def test_merged_shards_export_the_same_bytes_as_one_run(self):
        self.batch(*self.names, exit_code=4, out="one")
        for count in (1, 3, 64):
            out = f"shards-{count}"
            for i in range(count):
                done = self.vantage("batch", *self.names, "-o", out, *FAST, "--shard", f"{i}/{count}",
                                    exit_code=None)
                self.assertIn(done.returncode, (0, 4))
                if i == count // 2:
                    self.vantage("results", "merge", out)  # at any time, as often as wanted
            self.vantage("results", "merge", out)
            self.assertEqual(self.export(out), self.export("one"))
            self.assertIn("0 new", self.vantage("results", "merge", out).out)

    def test_a_shard_alone_says_what_is_to_be_done_with_it(self):
        merge = "vantage results merge out"
        self.assertIn(merge, self.vantage("batch", "00.off", "-o", "out", *FAST, "--shard", "0/1").out)
        self.assertIn(merge, self.vantage("results", "query", "out", exit_code=3).err)
        self.vantage("results", "merge", "out")
        self.assertIn("00", self.vantage("results", "query", "out").out)

    def test_nothing_is_merged_into_a_folder_that_has_nothing(self):
        (self.dir / "empty").mkdir()
        for folder in ("nosuch", "empty"):
            wanted = self.vantage("results", "query", folder, exit_code=3).err
            self.assertEqual(self.vantage("results", "merge", folder, exit_code=3).err, wanted)
        self.assertFalse((self.dir / "nosuch").exists())
        self.assertEqual(list((self.dir / "empty").iterdir()), [])

    def test_further_batches_bring_their_results(self):
        for folder in "pq":
            (self.dir / folder).mkdir()
        self.write("p/a.off", box(30))
        self.write("q/b.off", box(31))
        self.write("q/a.off", box(30))  # the same name and bytes as p's
        self.batch("p", out="all")
        self.batch("q", out="part")
        self.vantage("results", "merge", "all", "part")
        self.assertIn("all sound", self.vantage("results", "verify", "all").out)
        self.assertEqual(len(self.export("all").splitlines()), 3)
        for view in (self.dir / "part").glob("models/b-*/view.json"):
            self.assertEqual((self.dir / "all/models" / view.parent.name / "view.json").read_bytes(), view.read_bytes())
        self.assertEqual(len(list((self.dir / "all").glob("models/*"))), 2)
        self.assertIn("0 new", self.vantage("results", "merge", "all", "part").out)

    def test_a_further_batch_replaces_results_of_its_models_made_before(self):
        (self.dir / "p").mkdir()
        self.write("p/a.off", box(30))
        self.batch("p", out="all")
        self.write("p/a.off", box(31))
        self.batch("p", out="part")
        self.vantage("results", "merge", "all", "part")
        self.assertIn("1 folder of results: all sound", self.vantage("results", "verify", "all").out)

    def test_a_merge_that_cannot_read_something_changes_nothing(self):
        words = ("00.off", "02.off")
        self.batch(*words, out="all")
        self.batch(*words, "--objective", "significance", out="part")
        os.truncate(next((self.dir / "part/models").glob("02-*/view.json")), 1 << 32)  # more than is ever read
        before = {path: path.read_bytes() for path in (self.dir / "all/models").rglob("*.json")}
        self.assertIn("02-", self.vantage("results", "merge", "all", "part", exit_code=3).err)
        self.assertEqual({path: path.read_bytes() for path in (self.dir / "all/models").rglob("*.json")}, before)
        self.assertFalse((self.dir / "all/.work/merge").exists())
        self.assertEqual(self.batch(*words, out="all")["skipped"], 2)

    def test_a_further_batch_without_its_folders_takes_no_results_away(self):
        self.batch("00.off", "01.off", out="all")  # equal ones
        before = self.export("all")
        self.batch("00.off", "01.off", "--objective", "significance", out="part")
        shutil.rmtree(self.dir / "part/models")
        for _ in range(2):
            self.assertIn("2 records came without results", self.vantage("results", "merge", "all", "part").err)
            self.assertIn("1 folder of results: all sound", self.vantage("results", "verify", "all").out)
            self.assertEqual(self.export("all"), before)

    def test_a_record_without_its_folder_gets_none_of_another_answer(self):
        self.batch("00.off", out="all")
        shutil.rmtree(self.dir / "all/models")
        self.batch("00.off", "--objective", "significance", out="part")
        shutil.rmtree(self.dir / "part/models")
        self.vantage("results", "merge", "all", "part")
        self.assertIn("has no results; run the batch again", self.vantage("results", "verify", "all", exit_code=1).out)
        self.assertEqual(self.batch("00.off", "--objective", "significance", out="all")["done"], 1)
        self.assertIn("all sound", self.vantage("results", "verify", "all").out)

    def test_a_model_that_crashed_in_one_shard_has_the_results_of_its_equal_in_another(self):
        pair = ("00.off", "01.off")
        shards = [("batch", *pair, "-o", "out", *FAST, "--shard", f"{i}/2") for i in range(2)]
        with unittest.mock.patch.dict(os.environ, VANTAGE_TEST_FAULT="crash:00.off"):
            for shard in shards:
                self.vantage(*shard, exit_code=None)
        self.assertIn("1 done, 0 failed, 1 with the content of another", self.vantage("results", "merge", "out").out)
        twins = {key: (row["status"], row["duplicate_of"], row["error"]) for key, row in self.rows().items()}
        self.assertEqual(twins, {"00.off": ("done", "01.off", ""), "01.off": ("done", "", "")})
        self.assertIn("all sound", self.vantage("results", "verify", "out").out)
        self.assertEqual(self.batch(*pair)["duplicates"], 1)  # and its record says so, too
        self.assertEqual(self.batch(*pair)["skipped"], 2)

    def test_a_merge_leaves_an_overview_of_what_it_stored_or_none(self):
        self.batch("01.off", out="all")
        self.batch("04.off", out="part")
        self.vantage("results", "merge", "all", "part")
        self.assertIn("04", (self.dir / "all/index.html").read_text())
        self.batch("06.off", out="part")
        self.vantage("results", "merge", "all", "part", "--no-overview")
        self.assertFalse((self.dir / "all/index.html").exists())
        self.assertFalse(list((self.dir / "all").glob("contact-sheet-*")))

    def test_a_model_that_is_broken_since_replaces_its_result(self):
        self.write("m.off", box(40))
        self.batch("m.off", out="out")
        self.write("m.off", "no OFF")
        self.vantage("batch", "m.off", "-o", "out", *FAST, "--shard", "0/1", exit_code=4)
        self.assertIn("1 failed", self.vantage("results", "merge", "out").out)

    def test_a_touched_model_is_read_once_by_shards(self):
        self.write("m.off", box(40))
        shard = ("batch", "m.off", "-o", "out", *FAST, "--shard", "0/1")
        self.vantage(*shard)
        self.vantage("results", "merge", "out")
        before = self.export("out")
        os.utime(self.dir / "m.off", ns=(1, 1))
        self.vantage(*shard)
        self.assertIn("1 new", self.vantage("results", "merge", "out").out)  # its new time is stored
        self.assertEqual(self.export("out"), before)

    def test_of_two_models_with_one_folder_name_the_further_one_is_left_out_and_said(self):
        for folder in "pq":
            (self.dir / folder).mkdir()
        self.write("p/a.off", box(30))
        self.write("q/a.off", box(31))
        for folder, out in (("p", "all"), ("q", "part")):
            self.batch(folder, "--name", "{stem}", out=out)
        done = self.vantage("results", "merge", "all", "part")
        self.assertIn("1 record left out", done.err)
        counts = json.loads(self.vantage("results", "merge", "all", "part", "--json", "-q").out)
        self.assertEqual([counts[lost] for lost in ("torn", "clashes", "missing")], [0, 1, 0])
        self.assertIn("all sound", self.vantage("results", "verify", "all").out)

    def test_a_new_model_moves_no_other_one(self):
        def keys(out):
            return {path.name: {json.loads(line)["key"] for line in path.read_text().splitlines()}
                    for path in (self.dir / out / "shards").iterdir()}
        for i in range(3):
            self.vantage("batch", *self.names, "-o", "a", *FAST, "--shard", f"{i}/3", exit_code=None)
        self.write("new.off", box(99))
        for i in range(3):
            self.vantage("batch", "new.off", *self.names, "-o", "b", *FAST, "--shard", f"{i}/3", exit_code=None)
        before, after = keys("a"), keys("b")
        self.assertEqual({name: after[name] - {"new.off"} for name in after}, before)

    def test_a_finished_shard_does_nothing_again(self):
        self.vantage("batch", *self.names, "-o", "out", *FAST, "--shard", "1/3", exit_code=None)
        file = self.dir / "out/shards/shard-00001-of-00003.jsonl"
        before = file.read_bytes()
        counts = json.loads(self.vantage("batch", *self.names, "-o", "out", *FAST, "--shard", "1/3", "--json",
                                         exit_code=None).out)
        self.assertEqual(counts["done"] + counts["duplicates"], 0)
        self.assertEqual(file.read_bytes(), before)

    def test_shards_need_names_that_cannot_meet(self):
        self.vantage("batch", *self.names, "-o", "out", "--shard", "0/2", "--name", "{stem}", exit_code=2)
        for shard in ("2/2", "a/b", "1", "-1/2", "0/0"):
            self.vantage("batch", *self.names, "-o", "out", f"--shard={shard}", exit_code=2)


if __name__ == "__main__":
    unittest.main()
