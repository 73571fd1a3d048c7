"""Lists of models and tables of results: what is wrong with them is said once, and where."""

import json
import os
import shlex
import subprocess
import unittest

from program import PROGRAM
from program import contract_quickly as setUpModule
from shapes import box
from test_batch import FAST, BatchTest


class Lists(BatchTest):

    def run_list(self, text, *flags, exit_code=0):
        return self.vantage("batch", "--manifest", self.write("list", text), "-o", "out", *FAST, *flags,
                            exit_code=exit_code)

    def test_a_model_with_a_key_that_fails_is_named_by_its_path_too(self):
        (self.dir / "m").mkdir()
        self.write("m/bad.off", "OFF\nnonsense")
        self.write("m/worse.off", "OFF\nworse")
        lines = [{"path": "m/gone.off", "key": "k1"}, {"path": "m/bad.off", "key": "k2"},
                 {"path": "m/bad.off", "key": "k3", "up": "q"}, {"path": "m/worse.off"}]
        done = self.run_list("".join(json.dumps(line) + "\n" for line in lines), exit_code=4)
        rows = self.rows()
        self.assertEqual(sorted(rows), ["k1", "k2", "k3", "m/worse.off"])
        for key, path in (("k1", "m/gone.off"), ("k2", "m/bad.off"), ("k3", "m/bad.off")):
            self.assertIn(path, rows[key]["error"])
            [said] = [line for line in done.err.splitlines() if line.startswith((f"{key}:", f"{key} ("))]
            self.assertIn(path, said)
        self.assertTrue(rows["k2"]["error"].startswith("k2 ("), rows["k2"])
        self.assertTrue(rows["m/worse.off"]["error"].startswith("m/worse.off, line"), rows["m/worse.off"])

    def test_a_manifest_that_can_be_read_once_is_read_once_on_a_terminal_too(self):
        paths = [f"{self.dir}/{'n' * 150}_{i}.off" for i in range(700)]  # more than a pipe and a buffer hold
        os.mkfifo(self.dir / "list")
        command = shlex.join([PROGRAM, "batch", "--manifest", "list", "-o", "out", *FAST])
        with subprocess.Popen(["script", "-qec", command, "/dev/null"], cwd=self.dir, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL) as batch:
            self.addCleanup(batch.kill)
            with open(self.dir / "list", "w", encoding="utf-8") as manifest:
                manifest.write("\n".join(paths))
            self.assertEqual(batch.wait(timeout=100), 4)
        self.assertEqual(len(self.rows()), len(paths))

    def test_rows_of_one_key_are_counted_apart(self):
        self.write("a.off", box(1))
        self.write("b.off", box(2))
        for before in (0, 1):
            done = self.run_list("path,key\na.off,k\nb.off,k\n")
            self.assertIn(f"{before} done before, 1 left out with a key that came before (k)", done.out + done.err)

    def test_columns_and_members_that_are_not_read_are_told_once(self):
        self.write("a.off", box(1))
        known = "; those that are: path, key, name, up, front"
        done = self.run_list("path,Nmae,id\na.off,x,1\na.off,x,2\n")
        self.assertEqual(done.err.count(f"list: line 1 has columns that are not read: nmae, id{known}"), 1, done.err)
        done = self.run_list('{"path": "a.off"}\n{"path": "a.off", "upp": "x"}\n{"path": "a.off", "upp": "y"}\n')
        self.assertEqual(done.err.count(f"list: line 2 has members that are not read: upp{known}"), 1, done.err)
        self.assertNotIn("not read", self.run_list("path,key,name,up,front\na.off,,,,\n").err)

    def test_what_is_no_manifest_is_an_unreadable_input_and_nothing_is_written(self):
        self.write("list.json", '[{"path": "a.off"}]')
        for manifest in (".", "list.json", "absent.txt"):
            self.vantage("batch", "--manifest", manifest, "-o", "out", exit_code=3)
            self.assertFalse((self.dir / "out").exists(), manifest)

    def test_blank_rows_and_lines_are_no_models(self):
        self.write("a.off", box(1))
        for text in ('path,key\na.off,\n,\n , ""\n', '{"path": "a.off"}\n  \n\t\n\n', "a.off\n \t\n"):
            self.run_list(text)
            self.assertEqual(list(self.rows()), ["a.off"])

    def test_what_a_folder_of_results_lacks_is_made_anew_as_verify_says(self):
        self.write("a.off", box(1))
        self.vantage("batch", "a.off", "-o", "out", "--search", "rapid", "--write", "best", "--size", "64")
        folder = self.dir / "out/models" / self.rows()["a.off"]["folder"]
        whole = (folder / "best.png").read_bytes()
        again = ["batch", "a.off", "-o", "out", "--search", "rapid", "--write", "best", "--size", "64", "--verify"]
        for spoil in ((folder / "best.png").unlink, lambda: (folder / "best.png").write_bytes(whole[:50])):
            spoil()
            said = self.vantage("results", "verify", "out", exit_code=1).out
            self.assertIn("best.png", said)
            self.assertIn("; run the batch again with --verify", said)
            self.vantage(*again)
            self.assertEqual((folder / "best.png").read_bytes(), whole)
        (folder / "best.png").write_bytes(bytes(len(whole)))  # of this only what is in it tells
        said = self.vantage("results", "verify", "out", exit_code=1).out
        self.assertIn("; remove models/", said)


class Tables(BatchTest):

    def setUp(self):
        super().setUp()
        for name in ("a", "b"):
            self.write(f"{name}.off", box(1))
        self.batch("a.off", "b.off")

    def query(self, condition, exit_code=0):
        return self.vantage("results", "query", "out", "--where", condition, "--columns", "key", exit_code=exit_code)

    def test_signs_that_are_none_are_refused(self):
        for condition in ("name>>1", "name==a", "vertices=<5", "name<>a", "name!a", "vertices<<=5"):
            self.assertIn("is none of = != < <= > >= ~", self.query(condition, exit_code=2).err)
        for condition in ("vertices >= 8", "name~a", "error~<", "name= =x"):
            self.query(condition)

    def test_duplicates_are_asked_for_as_is_said(self):
        for condition in ("status=duplicate", "status=duplicates"):
            self.assertIn("--where 'duplicate_of!='", self.query(condition, exit_code=2).err)
        self.assertEqual(self.query("duplicate_of!=").out.split(), ["key", "b.off"])

    def test_formats_that_there_are_not_are_not_written(self):
        for name in ("x.json", "x.tsv"):
            said = self.vantage("results", "export", "out", "-o", name, exit_code=2).err
            self.assertIn("is to be .csv or .jsonl", said)
            self.assertFalse((self.dir / name).exists())
        self.vantage("results", "export", "out", "-o", "x.txt", "--format", "csv")
        self.vantage("results", "export", "out", "-o", "table")
        self.assertTrue((self.dir / "table").read_text().startswith("key,"))

    def test_one_model_is_told_of_as_one(self):
        (self.dir / "a.off").unlink()
        self.assertIn("forgotten: 1 model that is not among the inputs",
                      self.vantage("batch", "b.off", "-o", "out", "--forget", *FAST).err)


if __name__ == "__main__":
    unittest.main()
