"""vantage batch: what it takes, what it writes, what it skips, how its shards add up."""

import contextlib
import csv
import io
import json
import os
import pathlib
import shutil
import sqlite3
import tarfile
import unittest
import unittest.mock
import zipfile

from program import MODELS, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box

FAST = ["--search", "rapid", "--write", "json", "--jobs", "2"]


class BatchTest(ProgramTest):

    def batch(self, *arguments, exit_code=0, stdin=None, out="out"):
        """Runs a batch into `out` and returns its counts."""
        done = self.vantage("batch", *arguments, "-o", out, *FAST, "--json", exit_code=exit_code, stdin=stdin)
        return json.loads(done.out)

    def rows(self, out="out"):
        """The export as a dictionary by key."""
        text = self.vantage("results", "export", out, "--format", "jsonl").out
        rows = [json.loads(line) for line in text.splitlines()]
        return {row["key"]: row for row in rows}

    def export(self, out="out"):
        return self.vantage("results", "export", out, "--format", "jsonl").out


class Inputs(BatchTest):

    def test_folders_are_walked_in_the_order_of_names_and_other_files_are_passed_over(self):
        (self.dir / "in" / "b").mkdir(parents=True)
        self.write("in/b/1.off", box(1))
        self.write("in/a.off", box(2))
        self.write("in/notes.txt", "no model")
        self.batch("in")
        with_position = self.vantage("results", "query", "out", "--columns", "key", "--json").out
        self.assertEqual([row["key"] for row in json.loads(with_position)], ["in/a.off", "in/b/1.off"])

    def test_patterns_choose_and_leave_out(self):
        (self.dir / "in" / "old").mkdir(parents=True)
        for name in ("in/a.off", "in/b.OFF", "in/old/c.off", "in/d.model"):
            self.write(name, box(1))
        self.batch("in", "--include", "*.off", "--include", "*.model", "--exclude", "old/*")
        self.assertEqual(sorted(self.rows()), ["in/a.off", "in/b.OFF", "in/d.model"])

    def test_the_output_inside_the_input_is_not_an_input(self):
        self.write("a.off", box(1))
        self.batch(".", out="out")
        self.write("out/models/stray.off", box(3))
        self.assertEqual(self.batch(".", out="out")["skipped"], 1)
        self.assertEqual(list(self.rows()), ["./a.off"])

    def test_manifests_say_the_same_as_lines_csv_and_json(self):
        self.write("a.off", box(1))
        self.write("b.off", box(2))
        lines = "# chosen by hand\na.off\n\nb.off\n"
        table = 'id,path\n1,a.off\n2,"b.off"\n'
        objects = '{"path": "a.off"}\n{"path": "b.off", "weight": 3}\n'
        exports = []
        for i, text in enumerate((lines, table, objects, "a.off\0b.off\0", lines.replace("\n", "\r\n"))):
            self.batch("--manifest", self.write(f"m{i}", text), out=f"out{i}")
            exports.append(self.export(f"out{i}"))
        self.assertEqual(len(exports[0].splitlines()), 2)
        self.assertEqual(exports, [exports[0]] * 5)

    def test_tables_are_known_however_their_header_is_written(self):
        self.write("a b.off", box(1))
        for i, text in enumerate(("Path,Name\na b.off,chair\n", "path;name\na b.off;chair\n", "name\tPATH\nchair\ta b.off\n",
                                  ' "path" , Name\n a b.off ,"chair" \n', 'PATH, name\n"a b.off", chair\n')):
            self.batch("--manifest", self.write(f"m{i}", text), out=f"out{i}")
            row = self.rows(f"out{i}")["a b.off"]
            self.assertEqual((row["status"], row["name"]), ("done", "chair"), text)
        self.write("spaces", 'path,name\n"a b.off"," chair "\n')
        self.batch("--manifest", "spaces", out="spaced")
        self.assertEqual(self.rows("spaced")["a b.off"]["name"], " chair ")

    def test_a_list_in_json_is_refused_in_one_sentence(self):
        self.write("a.off", box(1))
        self.write("[1] b.off", box(2))
        for text in ('[{"path": "a.off"}]\n', '[\n  {"path": "a.off"}\n]\n', '["a.off"]\n'):
            done = self.vantage("batch", "--manifest", self.write("m.json", text), "-o", "out", *FAST, exit_code=3)
            self.assertIn("line 1: is the begin of a JSON list; write one object a line", done.err)
            self.assertEqual(len(done.err.splitlines()), 1, done.err)
        self.batch("--manifest", self.write("paths", "[1] b.off\n"))
        self.assertEqual(self.rows()["[1] b.off"]["status"], "done")

    def test_a_manifest_on_standard_input_may_name_and_turn_models(self):
        self.write("a.off", box(1))
        objects = '{"path": "a.off", "key": "first", "name": "A/../B", "up": "x"}\n{"path": "a.off", "key": "second"}\n'
        self.batch("--manifest", "-", "--name", "{name}-{key8}", stdin=objects.encode())
        rows = self.rows()
        self.assertEqual(rows["first"]["name"], "A/../B")
        self.assertEqual([rows["first"]["up"], rows["second"]["up"]], ["x", "y"])
        self.assertTrue(rows["first"]["folder"].startswith("A_.._B-"), rows["first"]["folder"])
        view = json.loads((self.dir / "out/models" / rows["first"]["folder"] / "view.json").read_text())
        self.assertEqual(view["model"]["name"], "A/../B")

    def test_lines_of_a_manifest_that_make_no_sense_fail_alone(self):
        self.write("a.off", box(1))
        objects = '{"path": "a.off"}\n{"up": "x"}\n{"path": "a.off", "up": "north"}\n{"path": 5}\nfree text\n'
        counts = self.batch("--manifest", "-", stdin=objects.encode(), exit_code=4)
        # the third names a.off again, which is done already
        self.assertEqual((counts["done"], counts["failed"]), (1, 3))
        self.assertIn("line 4", self.rows()["line 4 of the manifest"]["error"])

    def test_inputs_and_a_manifest_together_are_wrong_usage(self):
        self.vantage("batch", "a.off", "--manifest", "m", "-o", "out", exit_code=2)
        self.vantage("batch", "-o", "out", exit_code=2)

    def test_kinds_of_output_that_do_not_exist_are_refused_by_name(self):
        done = self.vantage("batch", "a.off", "-o", "out", "--write", "best,nonsense", exit_code=2)
        self.assertIn("nonsense", done.err)

    def test_point_clouds_are_models_too(self):
        (self.dir / "in").mkdir()
        grid = [(x / 9, y / 9, z / 9) for x in range(10) for y in range(10) for z in range(10)
                if 0 in (x, y, z) or 9 in (x, y, z)]
        self.write("in/shell.xyz", "".join(f"{x} {y} {z}\n" for x, y, z in grid))
        self.batch("in")
        self.assertEqual(self.rows()["in/shell.xyz"]["status"], "done")


class SeveralViews(BatchTest):

    def views_of(self, *arguments):
        """view.json of the one model, and the numbered pictures beside it."""
        # no box: rounding decides whether a second view of a shape that even sees anything new
        self.vantage("batch", MODELS / "cat_lowpoly.ply", "-o", "out", "--search", "rapid", "--size", "64", "-q",
                     *arguments)
        [folder] = (self.dir / "out/models").iterdir()
        return json.loads((folder / "view.json").read_text()), sorted(p.name for p in folder.glob("view-*.png"))

    def test_as_many_as_asked_for_are_drawn_and_named(self):
        view, pictures = self.views_of("--write", "best,views", "--views", "2")
        self.assertEqual(pictures, ["view-01.png", "view-02.png"])
        self.assertEqual([one["image"] for one in view["views"]], pictures)

    def test_without_a_number_there_are_at_most_six(self):
        view, pictures = self.views_of("--write", "views")
        self.assertEqual(pictures, [one["image"] for one in view["views"]])
        # no single view shows a whole cat
        self.assertTrue(2 <= len(pictures) <= 6)
        self.assertIsNone(view["best"]["image"])

    def test_a_set_without_pictures_names_none(self):
        view, pictures = self.views_of("--write", "json", "--views", "2")
        self.assertEqual(pictures, [])
        self.assertEqual([one["image"] for one in view["views"]], [None, None])


class Archives(BatchTest):

    def test_zip_and_tar_hold_the_same_models_as_a_folder(self):
        with zipfile.ZipFile(self.dir / "m.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("d/a.off", box(1))
            archive.writestr("d/b.off", box(2))
            archive.writestr("d/readme.txt", "no model")
        with tarfile.open(self.dir / "m.tar.gz", "w:gz") as archive:
            for name, content in (("a.off", box(1)), ("b.off", box(2))):
                info = tarfile.TarInfo(name)
                info.size = len(content)
                archive.addfile(info, io.BytesIO(content.encode()))
        counts = self.batch("m.zip", "m.tar.gz")
        self.assertEqual((counts["done"], counts["duplicates"]), (2, 2))
        rows = self.rows()
        self.assertEqual(sorted(rows), ["m.tar.gz//a.off", "m.tar.gz//b.off", "m.zip//d/a.off", "m.zip//d/b.off"])
        self.assertEqual(rows["m.tar.gz//a.off"]["duplicate_of"], "m.zip//d/a.off")
        self.assertEqual(self.batch("m.zip", "m.tar.gz")["skipped"], 4)

    def test_names_that_climb_out_of_the_archive_write_nothing_outside(self):
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            archive.writestr("../../evil.off", box(1))
            archive.writestr("/abs.off", box(2))
        before = {p for p in self.dir.parent.glob("*.off")}
        counts = self.batch("m.zip")
        self.assertEqual(counts["done"], 2)
        self.assertEqual({p for p in self.dir.parent.glob("*.off")}, before)
        self.assertFalse(pathlib.Path("/abs.off").exists())
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["m.zip", "out"])

    def test_links_and_repeated_names_are_told_apart(self):
        with tarfile.open(self.dir / "m.tar", "w") as archive:
            link = tarfile.TarInfo("link.off")
            link.type = tarfile.SYMTYPE
            link.linkname = "/etc/passwd"
            archive.addfile(link)
            hard = tarfile.TarInfo("hard.off")
            hard.type = tarfile.LNKTYPE
            hard.linkname = "/etc/passwd"
            archive.addfile(hard)
            for name, content in (("a.off", box(1)), ("a.off", box(2)), ("../../evil.off", box(3)), ("a.off//2", box(4))):
                info = tarfile.TarInfo(name)
                info.size = len(content)
                archive.addfile(info, io.BytesIO(content.encode()))
        self.batch("m.tar", exit_code=4)
        status = {key: row["status"] for key, row in self.rows().items()}
        self.assertEqual(status, {"m.tar//../../evil.off": "done", "m.tar//a.off": "done", "m.tar//a.off\\repeat 2": "done",
                                  "m.tar//hard.off": "failed", "m.tar//link.off": "failed"})
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["m.tar", "out"])

    def test_a_torn_archive_gives_what_can_be_read_and_fails_for_the_rest(self):
        with tarfile.open(self.dir / "m.tar", "w") as archive:
            for i in range(3):
                content = box(1 + i)
                info = tarfile.TarInfo(f"{i}.off")
                info.size = len(content)
                archive.addfile(info, io.BytesIO(content.encode()))
        whole = (self.dir / "m.tar").read_bytes()
        self.write("m.tar", whole[:1024 + 300])  # an entry of two blocks, then a torn header
        counts = self.batch("m.tar", exit_code=4)
        self.assertEqual(counts["done"], 1)
        self.assertIn("cannot be", self.rows()["m.tar"]["error"])

    def test_an_entry_larger_than_the_limit_is_not_unpacked(self):
        with zipfile.ZipFile(self.dir / "m.zip", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            archive.writestr("bomb.off", b"0" * 350_000_000)
            archive.writestr("a.off", box(1))
        counts = self.batch("m.zip", "--memory", "0.3", exit_code=4)
        self.assertEqual((counts["done"], counts["failed"]), (1, 1))
        self.assertIn("larger than 300 MB", self.rows()["m.zip//bomb.off"]["error"])


class Results(BatchTest):

    def test_equal_models_are_done_once_and_the_first_one_stands_for_them(self):
        for name, width in (("c", 1), ("a", 1), ("b", 1), ("d", 2)):
            self.write(f"{name}.off", box(width))
        counts = self.batch("c.off", "a.off", "b.off", "d.off")
        self.assertEqual((counts["done"], counts["duplicates"]), (2, 2))
        rows = self.rows()
        self.assertEqual([rows[f"{k}.off"]["duplicate_of"] for k in "abcd"], ["c.off", "c.off", "", ""])
        self.assertEqual(rows["a.off"]["folder"], rows["c.off"]["folder"])
        self.assertEqual(len(list((self.dir / "out/models").iterdir())), 2)

    def test_a_log_gets_lines_of_progress_now_and_then(self):
        self.write("a.off", box(1))
        batch = ("batch", "a.off", "-o", "out", *FAST)
        with unittest.mock.patch.dict(os.environ, VANTAGE_TEST_PROGRESS_S="0"):
            self.assertRegex(self.vantage(*batch).err, r"^0 of 1 models\n(.*\n)*1 of 1 models, \d+")
            self.assertEqual(self.vantage(*batch, "-q").err, "")
        self.assertEqual(self.vantage(*batch).err, "")

    def test_a_gradient_search_takes_the_seed(self):
        self.write("a.off", box(1))
        rows = {}
        for seed in (0, 7):
            self.vantage("batch", "a.off", "-o", f"out{seed}", "--write", "json", "--search", "gradient", "--starts", "1",
                         "--seed", seed)
            rows[seed] = self.rows(f"out{seed}")["a.off"]
        self.assertNotEqual(rows[0]["options"], rows[7]["options"])
        self.vantage("view", "a.off", "-o", "v", "--no-images", "--search", "gradient", "--starts", "1", "--seed", "7")
        made = json.loads((self.dir / "out7" / "models" / rows[7]["folder"] / "view.json").read_text())
        alone = json.loads((self.dir / "v" / "view.json").read_text())
        self.assertEqual(made["best"]["direction"], alone["best"]["direction"])

    def test_a_second_run_does_nothing_and_changes_no_byte(self):
        for i in range(4):
            self.write(f"{i}.off", box(1 + i))
        self.write("bad.off", "no OFF at all")
        self.batch(*(f"{i}.off" for i in range(4)), "bad.off", exit_code=4)
        before = self.export()
        counts = self.batch(*(f"{i}.off" for i in range(4)), "bad.off", exit_code=4)
        self.assertEqual((counts["done"], counts["skipped"], counts["failed"]), (0, 5, 1))
        self.assertEqual(self.export(), before)

    def test_only_what_has_changed_is_done_again(self):
        for i in range(3):
            self.write(f"{i}.off", box(1 + i))
        names = [f"{i}.off" for i in range(3)]
        self.batch(*names)
        old = self.rows()["1.off"]["folder"]
        self.write("1.off", box(7))  # other content
        self.write("2.off", box(3))  # written again, the same
        counts = self.batch(*names)
        self.assertEqual((counts["done"], counts["skipped"]), (1, 2))
        self.assertFalse((self.dir / "out/models" / old).exists(), "results of the old content stay behind")
        counts = self.batch(*names, "--fov", "40")
        self.assertEqual(counts["done"], 3, "other options are other results")

    def test_results_that_have_vanished_are_made_again(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        folder = self.dir / "out/models" / self.rows()["a.off"]["folder"]
        (folder / "view.json").unlink()
        folder.rmdir()
        self.assertEqual(self.batch("a.off")["done"], 1)
        self.assertTrue((folder / "view.json").exists())

    def test_verify_reads_again_and_believes_only_the_content(self):
        import os
        path = self.write("a.off", box(1.5))
        self.batch("a.off")
        stamp = path.stat()
        with path.open("r+b") as file:  # same size, time and inode: only the bytes tell
            file.write(box(2.5).encode())
        os.utime(path, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
        self.assertEqual(self.batch("a.off")["skipped"], 1)
        self.assertEqual(self.batch("a.off", "--verify")["done"], 1)
        self.assertEqual(self.batch("a.off", "--verify")["skipped"], 1)

    def test_names_that_meet_fail_for_the_later_model_and_say_so(self):
        for folder, width in (("a", 1), ("b", 2)):
            (self.dir / folder).mkdir()
            self.write(f"{folder}/same.off", box(width))
        self.batch("a", "b", "--name", "{stem}", exit_code=4)
        rows = self.rows()
        self.assertEqual(rows["a/same.off"]["status"], "done")
        self.assertIn("a/same.off", rows["b/same.off"]["error"])
        self.assertIn("{hash8}", rows["b/same.off"]["error"])

    def test_one_file_asked_for_in_two_ways_needs_two_names(self):
        self.write("a.off", box(1, 2, 3))
        self.write("list.csv", "path,key,up,front\na.off,k1,z,-y\na.off,k2,y,z\n")
        for _ in range(2):  # nothing changes hands when it runs again
            self.batch("--manifest", "list.csv", exit_code=4)
            rows = self.rows()
            self.assertEqual((rows["k1"]["status"], rows["k2"]["status"]), ("done", "failed"))
            self.assertIn("which holds those of k1; use a --name with {key8}", rows["k2"]["error"])
            self.assertIn("all sound", self.vantage("results", "verify", "out").out)
        self.batch("--manifest", "list.csv", "--name", "{stem}-{key8}", out="both")
        rows = self.rows("both")
        self.assertEqual((rows["k1"]["up"], rows["k2"]["up"]), ("z", "y"))
        self.assertIn("2 folders of results: all sound", self.vantage("results", "verify", "both").out)

    def test_results_that_replace_those_of_an_equal_model_are_its_results(self):
        for folder in ("a", "b"):
            (self.dir / folder).mkdir()
        self.write("a/x.off", box(1, 2, 3))
        self.write("a/y.off", box(1, 2, 3))
        self.batch("a")
        (self.dir / "a/x.off").rename(self.dir / "b/x.off")  # known by another path, and asked for otherwise
        self.batch("b", "--fov", "40")
        rows = self.rows()
        self.assertEqual({row["folder"] for row in rows.values()}, {rows["b/x.off"]["folder"]})
        self.assertEqual(rows["a/y.off"]["best"], rows["b/x.off"]["best"])
        self.assertIn("1 folder of results: all sound", self.vantage("results", "verify", "out").out)
        self.assertEqual(self.batch("b", "--fov", "40")["skipped"], 1)
        self.assertEqual(self.batch("a")["done"], 1)  # as it was asked for at first

    def test_templates_are_checked_before_any_work(self):
        self.write("a.off", box(1))
        for template in ("{nothing}", "../{stem}/", "{stem", "a//b", "/abs"):
            done = self.vantage("batch", "a.off", "-o", "out", "--name", template, exit_code=2)
            self.assertIn("--name", done.err)
        self.batch("a.off", "--name", "../.{stem}")
        self.assertEqual(self.rows()["a.off"]["folder"], "_./_a")

    def test_csv_reads_back_and_timings_are_left_out_unless_asked_for(self):
        self.write('q"u,o\nte.off', box(-5))
        self.batch('q"u,o\nte.off')
        plain = list(csv.DictReader(io.StringIO(self.vantage("results", "export", "out").out)))
        self.assertEqual(plain[0]["key"], 'q"u,o\nte.off')
        self.assertNotIn("seconds", plain[0])
        self.assertTrue(plain[0]["best_camera_target"].startswith("-"))
        view = json.loads(next((self.dir / "out/models").glob("*/view.json")).read_text())
        self.assertEqual(plain[0]["best_camera_target"], view["best"]["model_viewer"]["camera-target"])
        timed = self.vantage("results", "export", "out", "--timings").out
        self.assertEqual(next(csv.DictReader(io.StringIO(timed)))["attempts"], "1")
        self.vantage("results", "export", "out", "-o", "new/x.csv")  # a folder is made, as by other commands
        self.assertEqual((self.dir / "new/x.csv").read_text(), self.vantage("results", "export", "out").out)

    def test_query_chooses_sorts_and_limits(self):
        for i in range(5):
            self.write(f"{i}.off", box(1 + i))
        self.write("bad.off", "no OFF")
        self.batch(".", exit_code=4)
        query = lambda *flags: [row["name"] for row in json.loads(
            self.vantage("results", "query", "out", "--columns", "name", "--json", *flags).out)]
        self.assertEqual(query("--status", "failed"), ["bad"])
        self.assertEqual(query("--where", "name>=3", "--where", "status=done"), ["3", "4"])
        self.assertEqual(query("--where", "name~BA"), ["bad"])
        self.assertEqual(query("--sort", "-name", "--limit", "2"), ["bad", "4"])
        # what has no value is last in both directions
        self.assertEqual(query("--sort", "vertices")[-1], "bad")
        self.assertEqual(query("--sort", "-vertices")[-1], "bad")
        self.vantage("results", "query", "out", "--where", "name;drop table models=1", exit_code=2)

    def test_query_compares_numbers_with_numbers_only(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        query = lambda *where: json.loads(self.vantage("results", "query", "out", "--json", "--where", *where).out)
        for nonsense in ("best_fraction<0,4", "best_fraction<abc", "vertices>5k", "vertices=", "closed=yes", "genus<nan"):
            done = self.vantage("results", "query", "out", "--where", nonsense, exit_code=2)
            self.assertIn("is no number", done.err, nonsense)
        self.assertEqual([len(query(f"closed{sign}")) for sign in ("=true", "=1", "=false", "!=true")], [1, 1, 0, 0])
        self.assertEqual([len(query(f"{where}")) for where in ("vertices=8", "vertices~8", "best_field_of_view~deg")], [1, 1, 1])

    def test_query_sorts_and_limits_the_rows_of_all_folders_together(self):
        for name in ("1", "2", "3", "4"):
            self.write(f"{name}.off", box(1))
        self.write("bad.off", "no OFF")
        self.batch("1.off", "4.off", "bad.off", out="a", exit_code=4)
        self.batch("2.off", "3.off", out="b")
        query = lambda *flags: [row["name"] for row in json.loads(
            self.vantage("results", "query", "a", "b", "--columns", "name", "--json", *flags).out)]
        self.assertEqual(query("--sort", "name", "--limit", "2"), ["1", "2"])
        self.assertEqual(query("--sort", "-name"), ["bad", "4", "3", "2", "1"])
        self.assertEqual([query("--sort", sort)[-1] for sort in ("vertices", "-vertices")], ["bad", "bad"])
        self.assertEqual(query("--limit", "3"), ["1", "4", "bad"])

    def test_columns_of_a_query_stand_below_each_other(self):
        for name in ("größe", "plain"):
            self.write(f"{name}.off", box(1))
        self.batch("größe.off", "plain.off")
        lines = self.vantage("results", "query", "out", "--columns", "name,status").out.splitlines()
        self.assertEqual([line.split()[1] for line in lines], ["status", "done", "done"])
        self.assertEqual({line.index(line.split()[1]) for line in lines}, {7})

    def test_diff_lists_what_came_went_and_changed(self):
        for i in range(3):
            self.write(f"{i}.off", box(1 + i))
        self.batch("0.off", "1.off", out="a")
        self.write("1.off", box(9))
        self.batch("1.off", "2.off", out="b")
        diff = json.loads(self.vantage("results", "diff", "a", "b", "--json").out)
        kinds = {row["key"]: row["kind"] for row in diff["differences"]}
        self.assertEqual(kinds, {"0.off": "removed", "1.off": "changed", "2.off": "added"})
        self.assertEqual([diff[k] for k in ("equal", "changed", "only_in_a", "only_in_b")], [0, 1, 1, 1])
        self.assertEqual(json.loads(self.vantage("results", "diff", "a", "a", "--json").out)["differences"], [])

    def test_diff_compares_all_that_results_hold(self):
        self.write("a.off", box(1))
        self.batch("a.off", out="a")
        orbit = "$.best.model_viewer.camera-orbit"
        for path, column in ((orbit, "best_camera_orbit"), ("$.closed", "closed"), ("$.genus", "genus"), ("$.total", "total"),
                             ("$.components", "components"), ("$.up", "up"), ("$.front", "front"), ("$.doubts[0]", "doubt"),
                             ("$.best.direction[0]", "best_dx"), ("$.worst.direction[2]", "worst_dz")):
            shutil.rmtree(self.dir / "b", ignore_errors=True)
            shutil.copytree(self.dir / "a", self.dir / "b")
            with contextlib.closing(sqlite3.connect(self.dir / "b/results.sqlite")) as store, store:
                path = path.replace("camera-orbit", '"camera-orbit"')
                old, = store.execute("SELECT json_extract(result, ?) FROM models", (path,)).fetchone()
                new = old.replace("deg", "def") if column == "best_camera_orbit" else 7
                store.execute("UPDATE models SET result = json_set(result, ?, ?)", (path, new))
            diff = json.loads(self.vantage("results", "diff", "a", "b", "--json", "--tolerance", "0.02").out)
            self.assertEqual([list(row["changes"]) for row in diff["differences"]], [[column]], path)

    def test_other_cameras_of_equal_scores_are_a_change(self):
        self.write("a.off", box(2, 3))
        for up in "yz":
            self.batch("a.off", "--up", up, out=up)
        diff = json.loads(self.vantage("results", "diff", "y", "z", "--json").out)
        self.assertEqual(diff["changed"], 1)
        self.assertIn("best_camera_orbit", diff["differences"][0]["changes"])

    def test_a_diff_of_batches_from_two_folders_tells_why_no_key_is_in_both(self):
        (self.dir / "m").mkdir()
        self.write("m/a.off", box(1))
        self.batch("m", out="one")
        self.batch(self.dir / "m", out="two")
        done = self.vantage("results", "diff", "one", "two")
        self.assertIn("0 models alike, 0 changed, 1 only in A, 1 only in B", done.out)
        self.assertIn("note: no key is in both, though contents are", done.err)
        self.write("b.off", box(2))
        self.batch("b.off", out="three")
        self.assertEqual(self.vantage("results", "diff", "one", "three").err, "")

    def test_an_export_of_a_folder_that_is_not_there_prints_nothing(self):
        self.write("a.off", box(1))
        self.batch("a.off")
        self.assertEqual(self.vantage("results", "export", "out", "nosuch", exit_code=3).out, "")

    def test_the_index_page_holds_no_markup_from_names(self):
        self.write("<b>&\"' é.off", box(1))
        self.vantage("batch", ".", "-o", "out", "--search", "rapid", "--write", "best", "--size", "64")
        page = (self.dir / "out/index.html").read_text()
        self.assertNotIn("<b>&", page)
        self.assertIn("\\u003cb>&", page)
        self.assertTrue((self.dir / "out/contact-sheet-0001.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_folder_with_foreign_files_is_refused(self):
        (self.dir / "out").mkdir()
        self.write("out/thesis.txt", "mine")
        self.write("a.off", box(1))
        self.vantage("batch", "a.off", "-o", "out", exit_code=1)
        self.assertEqual(len(list((self.dir / "out").iterdir())), 1)


if __name__ == "__main__":
    unittest.main()
