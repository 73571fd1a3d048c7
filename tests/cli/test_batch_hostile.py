"""vantage batch and results where folders, stores, archives and lists were made to do harm."""

import csv
import io
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import unittest

from hostile import FAST, HostileTest
from png import png
from program import PROGRAM
from program import contract_quickly as setUpModule
from shapes import box


class Folders(HostileTest):
    """Nothing outside the results' folder is written or removed, whatever that holds."""

    def test_a_folder_that_the_store_names_outside_is_not_removed(self):
        for name in ("../../victim", "../victim", str(self.victim), "x/../../../victim", ".", "", ".."):
            with self.subTest(name=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.write("a.off", box(1))
                self.batch("a.off")
                self.change_store(f"UPDATE models SET folder = '{name}'")
                self.write("a.off", box(2))
                self.batch("a.off")
                self.assert_untouched()
                self.assertEqual(self.rows()["a.off"]["status"], "done")

    def test_a_folder_inside_that_holds_no_results_is_not_removed(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        (self.dir / "out/models/mine").mkdir()
        self.write("out/models/mine/thesis.txt", "mine")
        self.change_store("UPDATE models SET folder = 'mine'")
        self.write("a.off", box(2))
        self.batch("a.off")
        self.assertTrue((self.dir / "out/models/mine/thesis.txt").exists())

    def test_a_folder_that_a_shard_names_outside_is_not_removed(self):
        self.write("a.off", box(1))
        for name in (str(self.victim), "../../victim"):
            with self.subTest(name=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.write("b.off", box(3))
                self.batch("a.off", "b.off", "--shard", "0/1")
                [file] = (self.dir / "out/shards").glob("*.jsonl")
                first, second = file.read_text().splitlines()
                file.write_text(first + "\n" + json.dumps({**json.loads(second), "folder": name}) + "\n")
                self.write("b.off", box(2))
                self.batch("a.off", "b.off", "--shard", "0/1")
                self.vantage("results", "merge", "out")
                self.assert_untouched()

    def test_no_link_in_the_folder_is_written_or_removed_through(self):
        self.write("a.off", box(1))
        inside = ("results.sqlite", ".work", "models", "index.html")
        for name in inside:
            with self.subTest(link=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.batch("a.off")
                path = self.dir / "out" / name
                shutil.rmtree(path) if path.is_dir() else path.unlink()
                path.symlink_to(self.victim if name in (".work", "models") else self.victim / "thesis.txt")
                self.write("a.off", box(2))
                done = self.batch("a.off", exit_code=None)
                self.assertIn(done.returncode, (1, 4), name)
                self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                self.assert_untouched()
                self.write("a.off", box(1))

    def test_no_link_in_place_of_a_lock_a_log_or_a_part_is_written_through(self):
        self.write("a.off", box(1))
        target = self.victim / "thesis.txt"
        for name in (".work/shard-0-of-1.lock", "shards/shard-00000-of-00001.jsonl.log",
                     "shards/shard-00000-of-00001.jsonl", ".work/shard-0-of-1.part", ".work/shard-0-of-1"):
            with self.subTest(link=name):
                shutil.rmtree(self.dir / "out", ignore_errors=True)
                self.batch("a.off", "--shard", "0/1")
                path = self.dir / "out" / name
                if path.exists():
                    path.unlink()
                path.symlink_to(self.victim if name.endswith("1") else target)
                self.write("a.off", box(2))
                self.batch("a.off", "--shard", "0/1", exit_code=None)
                self.assert_untouched()

    def test_a_model_whose_place_is_a_link_fails_alone(self):
        self.write("a.off", box(1))
        self.write("b.off", box(2))
        self.batch("a.off", "b.off", "--name", "{stem}/{stem}")
        shutil.rmtree(self.dir / "out/models/a")
        (self.dir / "out/models/a").symlink_to(self.victim)
        self.write("a.off", box(3))
        self.write("b.off", box(4))
        self.batch("a.off", "b.off", "--name", "{stem}/{stem}", exit_code=4)
        self.assertEqual({k: r["status"] for k, r in self.rows().items()}, {"a.off": "failed", "b.off": "done"})
        self.assert_untouched()

    def test_the_folder_itself_may_be_a_link(self):
        (self.dir / "disk").mkdir()
        (self.dir / "out").symlink_to("disk")
        self.write("a.off", box(1))
        self.batch("a.off")
        self.assertTrue((self.dir / "disk/index.html").exists())


class ForeignFiles(HostileTest):
    """A folder is a batch's only if it holds its records; in it only its own files are replaced."""

    def assert_refused(self, *command, pattern="", exit_code=1):
        before = self.state_of(self.dir / "out")
        done = self.vantage(*command, exit_code=exit_code)
        self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
        self.assertRegex(done.err, pattern)
        after = self.state_of(self.dir / "out")
        self.assertEqual({name: after.get(name) for name in before}, before)

    def test_names_that_a_batch_uses_make_no_folder_its_own(self):
        self.write("a.off", box(1))
        for name in ("shards/mine.txt", ".work/mine.txt", "models/mine.txt", "results.sqlite",
                     "shards/shard-00000-of-00001.jsonl"):
            for index in ("index.html", "index-2.html", "contact-sheet-0001.png"):
                with self.subTest(name=name):
                    shutil.rmtree(self.dir / "out", ignore_errors=True)
                    (self.dir / "out" / name).parent.mkdir(parents=True)
                    self.write(f"out/{name}", "mine, not yours\n")
                    self.write(f"out/{index}", "mine")
                    self.assert_refused("batch", "a.off", "-o", "out", *FAST, pattern="choose another folder")
                    self.assert_refused("results", "merge", "out", pattern="choose another folder")

    def test_a_database_of_something_else_is_left_alone(self):
        self.write("a.off", box(1))
        (self.dir / "out").mkdir()
        with sqlite3.connect(self.dir / "out/results.sqlite") as store:
            store.execute("CREATE TABLE exams(grade)")
        store.close()
        for command in (("batch", "a.off", "-o", "out"), ("results", "merge", "out"), ("results", "export", "out")):
            self.assert_refused(*command, pattern="not of results of a batch", exit_code=None)

    def test_a_page_or_a_sheet_of_somebody_else_is_neither_replaced_nor_removed(self):
        self.write("a.off", box(1))
        self.batch("a.off", "--no-overview")
        for name in ("index.html", "contact-sheet-0001.png"):
            self.write(f"out/{name}", "mine")
            self.write("a.off", box(2))
            self.assert_refused("batch", "a.off", "-o", "out", *FAST, pattern="--no-overview")
            self.assert_refused("results", "merge", "out", pattern="--no-overview")
            (self.dir / "out" / name).unlink()
        for width, height in ((176, 500), (177, 194), (8, 194)):  # sheets of one row are 194 high, and 168 wider a tile
            self.write("out/contact-sheet-0001.png", png(b"\1\2\3\4", width, height))
            self.assert_refused("batch", "a.off", "-o", "out", *FAST, pattern="--no-overview")
        (self.dir / "out/contact-sheet-0001.png").unlink()
        for name in ("index-2.html", "contact-sheet-0002.png"):
            self.write(f"out/{name}", "mine")
        self.batch("a.off")
        for name in ("index-2.html", "contact-sheet-0002.png"):
            self.assertEqual((self.dir / "out" / name).read_text(), "mine")

    def test_results_are_not_put_in_the_place_of_somebody_elses_folder(self):
        self.write("a.off", box(1))
        self.batch("a.off", "--name", "{stem}")
        shutil.rmtree(self.dir / "out/models/a")
        (self.dir / "out/models/a").mkdir()
        self.write("out/models/a/thesis.txt", "mine")
        self.write("a.off", box(2))
        self.batch("a.off", "--name", "{stem}", exit_code=4)
        self.assertEqual(self.rows()["a.off"]["reason"], "name")
        self.assertEqual((self.dir / "out/models/a/thesis.txt").read_text(), "mine")

    def test_files_whose_names_end_like_ours_are_kept(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        names = ("e2.csv.part", ".e2.csv.part.77777", "out/.notes.part.77777", "out/.index.html.part.77777")
        for name in names:
            self.write(name, "mine")
        self.vantage("results", "export", "out", "-o", "e2.csv")
        self.write("a.off", box(2))
        self.batch("a.off")
        self.vantage("results", "merge", "out")
        for name in names:
            self.assertEqual((self.dir / name).read_text(), "mine", name)

    def test_what_a_killed_run_left_is_removed_by_the_next_one(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        self.write("out/.work/local.part", "<!doctype")
        (self.dir / "out/.work/local").mkdir()
        self.write("out/.work/local/x", "")
        self.write("a.off", box(2))
        self.batch("a.off")
        self.assertEqual([p.name for p in (self.dir / "out/.work").iterdir()], ["local.lock"])
        self.assertEqual([p.name for p in (self.dir / "out").iterdir() if ".part" in p.name], [])


class StoresOfStrangers(HostileTest):

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1))
        self.write("b.off", box(2))
        self.batch("a.off", "b.off", out="evil")

    def change(self, sql):
        self.change_store(sql, "evil")

    def test_a_row_that_is_no_record_is_left_out_of_a_merge(self):
        for column, value in (("folder", "'../../victim'"), ("folder", "'/etc'"), ("status", "'fine'"),
                              ("result", "'{'"), ("result", f"'{'[' * 100_000}'"), ("folder", "'a//b'")):
            with self.subTest(value=value[:20]):
                shutil.rmtree(self.dir / "all", ignore_errors=True)
                (self.dir / "all").mkdir()
                self.batch("a.off", "b.off", "--verify", out="evil")
                self.change(f"UPDATE models SET {column} = {value} WHERE key = 'a.off'")
                done = self.vantage("results", "merge", "all", "evil")
                self.assertIn("1 line", done.err)
                self.assertEqual(list(self.rows("all")), ["b.off"])
                shutil.rmtree(self.dir / "evil")
        self.assert_untouched()

    def test_text_that_is_no_utf8_is_exported_all_the_same(self):
        self.change("UPDATE models SET name = CAST(x'ff80' AS TEXT) WHERE key = 'a.off'")
        for command in (("export", "--format", "jsonl"), ("export",), ("query", "--json"), ("query",)):
            done = subprocess.run([PROGRAM, "results", command[0], "evil", *command[1:]], cwd=self.dir,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.write("a.off", box(3))
        self.batch("a.off", out="evil")
        self.vantage("results", "merge", "evil")

    def test_nothing_that_the_schema_says_is_run(self):
        self.change("DROP VIEW results; CREATE VIEW results AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 "
                    "FROM n) SELECT i AS key FROM n")
        self.assertEqual(len(self.rows("evil")), 2)
        self.change("CREATE TRIGGER t AFTER INSERT ON models BEGIN DELETE FROM models; END")
        done = self.vantage("results", "merge", "all", "evil", exit_code=3)
        self.assertIn("not of results of a batch", done.err)

    def test_shard_files_may_hold_anything(self):
        self.batch("a.off", "b.off", "--shard", "0/1", out="s")
        file = self.dir / "s/shards/shard-00000-of-00001.jsonl"
        records = file.read_text().splitlines()
        odd = [b"", b"{}", b"[" * 1_000_000, b'{"a":' * 200_000, b"\xff\xfe", b'"' * 17_000_000, b"null", b"1e999",
               json.dumps({**json.loads(records[0]), "key": "", "folder": "x"}).encode(),
               json.dumps({**json.loads(records[0]), "key": "c", "stamp": []}).encode(),
               json.dumps({**json.loads(records[0]), "key": "d", "folder": "../../victim"}).encode(),
               json.dumps({**json.loads(records[0]), "key": "e", "timings": {"seconds": 1e308}}).encode()]
        file.write_bytes(b"\n".join([records[0].encode(), *odd, records[1].encode()]) + b"\n")
        for command in (("results", "merge", "s", "--max-memory", "500MB"),
                        ("batch", "a.off", "b.off", "-o", "s", *FAST, "--shard", "0/1")):
            self.vantage(*command)
        self.vantage("results", "merge", "s")
        self.assertEqual(sorted(self.rows("s")), ["a.off", "b.off"])
        self.assert_untouched()

    def test_a_shard_file_that_is_a_pipe_or_never_ends_is_refused(self):
        for make in (os.mkfifo, lambda path: os.symlink("/dev/zero", path)):
            self.batch("a.off", "--shard", "0/2", exit_code=None, out="p")
            make(self.dir / "p/shards/shard-00001-of-00002.jsonl")
            done = self.vantage("results", "merge", "p", "--timeout", "60", exit_code=3)
            self.assertIn("not a regular file", done.err)
            shutil.rmtree(self.dir / "p")

    def test_small_pictures_that_are_pipes_or_links_do_not_stop_the_page(self):
        folder = self.dir / "evil/models" / self.rows("evil")["a.off"]["folder"]
        os.mkfifo(folder / "thumb.png")
        self.write("b.off", box(5))
        self.batch("a.off", "b.off", "--timeout", "60", out="evil")
        self.assertTrue((self.dir / "evil/index.html").exists())

    def test_an_index_of_more_than_one_page_holds_every_row_once(self):
        rows = 60_001
        with sqlite3.connect(self.dir / "evil/results.sqlite") as store:
            columns = [row[1] for row in store.execute("PRAGMA table_info(models)")]
            # Failures, whose rows are short.
            other = {"key": "'k' || n", "content": "'c' || n", "status": "'failed'", "reason": "'input'", "folder": "''", "result": "'{}'"}
            copied = ", ".join(other.get(column, column) for column in columns)
            store.execute(f"""INSERT INTO models WITH RECURSIVE i(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM i WHERE n < {rows - 2})
                              SELECT {copied} FROM models, i WHERE key = 'a.off'""")
        store.close()
        self.vantage("results", "merge", "evil")
        keys = []
        for page in ("index.html", "index-2.html"):
            text = (self.dir / "evil" / page).read_text()
            data = text.partition('id="data">')[2].partition("</script>")[0]
            keys += [row[0] for row in json.loads(data)["rows"]]
        self.assertEqual(len(keys), rows)
        self.assertEqual(len(set(keys)), rows)
        self.assertFalse((self.dir / "evil/index-3.html").exists())
        self.change(f"DELETE FROM models WHERE key LIKE 'k%'")
        self.vantage("results", "merge", "evil")
        self.assertFalse((self.dir / "evil/index-2.html").exists())


class Output(HostileTest):

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1))
        self.batch("a.off")

    def test_a_full_standard_output_is_no_success(self):
        for command in (("results", "export", "out"), ("results", "export", "out", "--format", "jsonl"),
                        ("results", "export", "out", "-o", "/dev/full"),
                        ("results", "query", "out"), ("results", "query", "out", "--json"),
                        ("results", "diff", "out", "out"), ("results", "merge", "out"),
                        ("results", "merge", "out", "--json"), ("batch", "a.off", "-o", "out", "--json")):
            with self.subTest(command=command), open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *command], cwd=self.dir, stdout=full, stderr=subprocess.PIPE, check=False)
                self.assertEqual(done.returncode, 75, done.stderr)
                self.assertRegex(done.stderr.decode(), "cannot be written.*No space left")
                self.assertTrue(pathlib.Path("/dev/full").is_char_device())

    def test_cells_that_a_spreadsheet_would_compute_are_text_in_csv_and_exact_in_json(self):
        (self.dir / "in").mkdir()
        names = ["=1+1", "+1", "-1", "@sum", "\tx", "plain"]
        lines = "".join(json.dumps({"path": "a.off", "key": name, "name": name}) + "\n" for name in names)
        self.write("list", lines)
        self.batch("--manifest", "list", out="o")
        table = list(csv.DictReader(io.StringIO(self.vantage("results", "export", "o").out, newline="")))
        self.assertEqual(sorted(row["name"] for row in table), sorted("'" + n if n != "plain" else n for n in names))
        for row in table:
            for name, cell in row.items():
                self.assertFalse(cell[:1] in "=@+\t" and cell, (name, cell))
        self.assertTrue(any(float(row[c]) < 0 for row in table for c in ("best_dx", "best_dy", "best_dz", "worst_dx",
                                                                         "worst_dy", "worst_dz")))
        self.assertEqual({row["name"] for row in self.rows("o").values()}, set(names))


if __name__ == "__main__":
    unittest.main()
