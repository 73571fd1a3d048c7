"""What may be replaced by a result, and under which names results can be written."""

import json
import os
import pathlib
import signal
import subprocess
import time
import unittest

from program import MODELS, PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import angle_bar, box

FAST = ("--search", "rapid")
THEIRS = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
PEOPLE = "model,subject,status,vx,vy,vz\nhorse.off,A,moved,0,0,1\n"


class Foreign(ProgramTest):
    """Files that somebody else made."""

    def setUp(self):
        super().setUp()
        self.write("a.off", angle_bar())  # of which a thumbnail takes less than of a box

    def assert_kept(self, file, content, *command):
        path = self.write(file, content)
        done = self.vantage(*command, exit_code=1)
        self.assertEqual(path.read_text(), content, command)
        self.assertIn("--force", done.err)
        self.assertIn(file.split("/")[0], done.err)
        self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
        self.vantage(*command, "--force")
        self.assertNotEqual(path.read_bytes(), content.encode(), command)

    def test_a_model_is_not_replaced_by_a_picture_a_map_or_a_skeleton(self):
        for command in (("thumb", "a.off", "b.ply"), ("thumb", "a.off", "-o", "b.ply"),
                        ("render", "a.off", "-o", "b.ply", "--direction", "0,0,1", "--size", "32"),
                        ("map", "a.off", "-o", "b.ply"), ("skeleton", "a.off", "-o", "b.ply"),
                        ("skeleton", "a.off", "-o", "s.json", "--meso", "b.ply")):
            with self.subTest(command=command):
                self.assert_kept("b.ply", THEIRS, *command)
        self.assert_kept("b.obj", "v 0 0 0\n", "skeleton", "a.off", "-o", "b.obj")
        os.mkdir(self.dir / "l")
        for command in (("map", "a.off", "-o", "m.ply"), ("skeleton", "a.off", "-o", "s.json")):
            self.assert_kept("l/level-00.ply", THEIRS, *command, "--levels", "l")

    def test_a_map_of_ours_is_not_replaced_by_a_picture(self):
        self.vantage("map", "a.off", "-o", "map.ply")
        before = (self.dir / "map.ply").read_bytes()
        self.vantage("thumb", "a.off", "map.ply", exit_code=1)
        self.assertEqual((self.dir / "map.ply").read_bytes(), before)

    def test_a_table_of_choices_or_directions_is_not_replaced_by_ours(self):
        self.assert_kept("d.csv", "dx,dy,dz\n0,0,1\n", "score", "a.off", "--sphere", "0", "-o", "d.csv")
        self.assert_kept("d.csv", PEOPLE, "view", "a.off", "-o", "v", "--no-images", *FAST, "--trace", "d.csv")
        os.mkdir(self.dir / "f")
        self.assert_kept("f/table-1-times.csv", PEOPLE, "figures", "a.off", "-o", "f", "--size", "32", *FAST)

    def test_what_is_ours_or_only_ever_output_or_empty_is_replaced(self):
        for command in (("thumb", "a.off", "t.tmp"), ("map", "a.off", "-o", "m.ply"),
                        ("skeleton", "a.off", "-o", "s.obj"), ("skeleton", "a.off", "-o", "s.ply"),
                        ("score", "a.off", "--sphere", "0", "-o", "s.csv"),
                        ("view", "a.off", "-o", "v", "--no-images", *FAST, "--trace", "t.csv"),
                        ("figures", "a.off", "-o", "f", "--size", "32", *FAST)):
            with self.subTest(command=command):
                self.vantage(*command)
                self.vantage(*command)
        for name in ("x.png", "x.webp"):
            self.write(name, "theirs, but only a picture has such a name")
            self.vantage("thumb", "a.off", name)
        self.write("empty.tmp", "")  # as file managers make one
        self.vantage("thumb", "a.off", "empty.tmp")
        for name, begin in (("x.png", b"\x89PNG"), ("x.webp", b"RIFF"), ("empty.tmp", b"\x89PNG")):
            self.assertTrue((self.dir / name).read_bytes().startswith(begin), name)

    def test_no_output_replaces_what_is_read_whatever_the_flags(self):
        self.vantage("map", "a.off", "-o", "map.ply")
        os.symlink("map.ply", self.dir / "link.ply")
        os.link(self.dir / "map.ply", self.dir / "hard.ply")
        self.write("d.csv", "dx,dy,dz\n0,0,1\n")
        self.vantage("view", "a.off", "-o", "v", "--no-images", *FAST)
        mapped = self.dir / "v/map.ply"
        before = (self.dir / "map.ply").read_bytes(), (self.dir / "d.csv").read_bytes(), mapped.read_bytes()
        for command in (("thumb", "map.ply", "link.ply", "--force"), ("map", "map.ply", "-o", "map.ply"),
                        ("map", "link.ply", "-o", "hard.ply", "--force"),
                        ("skeleton", "map.ply", "-o", "s.json", "--meso", "map.ply"),
                        ("score", "a.off", "--directions", "d.csv", "-o", "d.csv", "--force"),
                        ("view", "v/map.ply", "-o", "v", "--no-images", *FAST)):
            with self.subTest(command=command):
                self.assertRegex(self.vantage(*command, exit_code=2).err, "^vantage: [^ ]*: is .*read.*another")
        self.assertEqual(before, ((self.dir / "map.ply").read_bytes(), (self.dir / "d.csv").read_bytes(), mapped.read_bytes()))

    def test_arguments_in_the_wrong_order_are_no_reason_for_force(self):
        self.assertRegex(self.vantage("thumb", "out.png", "a.off", exit_code=3).err, "^vantage: out.png: cannot be opened: ")
        self.write("out.png", "theirs")
        self.assertRegex(self.vantage("thumb", "out.png", "a.off", exit_code=1).err,
                         "^vantage: a.off: is a model, and out.png is none; are the arguments swapped")

    def test_json_that_may_be_an_input_is_not_replaced_by_a_skeleton(self):
        for theirs in ('{"camera_angle_x": 1, "frames": []}\n', '{\n  "nodes": [\n    {"mesh": 0}\n  ],\n  "asset": {}\n}\n'):
            (self.dir / "x.json").unlink(missing_ok=True)
            self.assert_kept("x.json", theirs, "skeleton", "a.off", "-o", "x.json")
        self.vantage("skeleton", "a.off", "-o", "x.json")  # ours by now

    def test_an_export_replaces_exports_only(self):
        self.vantage("batch", "a.off", "-o", "out", "--search", "rapid", "--write", "json")
        export = ("results", "export", "out", "-o")
        self.assert_kept("notes.csv", PEOPLE, *export, "notes.csv")
        self.assert_kept("b.ply", THEIRS, *export, "b.ply", "--format", "csv")
        for name, form in (("rows.csv", "csv"), ("rows.jsonl", "jsonl")):
            self.vantage(*export, name, "--format", form)
            before = (self.dir / name).read_bytes()
            self.vantage(*export, name, "--format", form)
            self.assertEqual((self.dir / name).read_bytes(), before)
        os.symlink("rows.csv", self.dir / "link.csv")
        self.vantage(*export, "link.csv", "--format", "jsonl")
        self.assertTrue((self.dir / "link.csv").is_symlink())
        self.assertEqual((self.dir / "rows.csv").read_bytes(), (self.dir / "rows.jsonl").read_bytes())

    def test_no_output_replaces_the_results_of_a_batch(self):
        self.vantage("batch", "a.off", "-o", "r", "--search", "rapid", "--write", "json")
        store = self.dir / "r/results.sqlite"
        before = store.read_bytes()
        os.symlink("r/results.sqlite", self.dir / "link.csv")
        for name in ("r/results.sqlite", "link.csv"):
            for force in ([], ["--force"]):
                done = self.vantage("results", "export", "r", "-o", name, "--format", "csv", *force, exit_code=1)
                self.assertIn("holds the results of a batch", done.err)
                self.assertEqual(store.read_bytes(), before)

    def test_a_folder_of_somebody_else_is_written_to_by_force_only(self):
        os.mkdir(self.dir / "theirs")
        self.assert_kept("theirs/view.json", '{"holiday": 1}', "view", "a.off", "-o", "theirs", "--no-images", *FAST)

    def test_two_models_of_one_name_do_not_share_a_folder_of_figures(self):
        os.mkdir(self.dir / "other")
        self.write("other/a.off", box(2.0))
        done = self.vantage("figures", "a.off", "other/a.off", "-o", "f", "--size", "32", *FAST, exit_code=1)
        self.assertIn("'a'", done.err)

    def test_a_model_that_cannot_be_read_costs_no_other_ones_figures(self):
        self.write("bad.off", "no OFF")
        self.write("c.off", box(2.0))
        done = self.vantage("figures", "a.off", "bad.off", "c.off", "-o", "f", "--size", "32", *FAST, exit_code=4)
        self.assertIn("bad.off", done.err)
        self.assertTrue((self.dir / "f/a").is_dir() and (self.dir / "f/c").is_dir())
        self.assertEqual(len((self.dir / "f/table-1-times.csv").read_text().splitlines()), 3)
        self.vantage("figures", "bad.off", "bad.off", "-o", "g", "--size", "32", *FAST, exit_code=1)
        self.vantage("figures", "bad.off", "-o", "g", "--size", "32", *FAST, exit_code=3)

    def test_a_name_of_dots_does_not_lead_out_of_the_folder_of_figures(self):
        self.write("...off", box(2.0))
        self.vantage("figures", "a.off", "...off", "-o", "f", "--size", "32", *FAST)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["...off", "a.off", "f"])

    def eval_dataset(self):
        os.mkdir(self.dir / "people")
        os.mkdir(self.dir / "people/models")
        self.write("people/models/horse.off", box(1.0))
        self.write("people/views.csv", PEOPLE)

    def test_eval_does_not_replace_the_choices_it_reads_nor_a_foreign_journal(self):
        self.eval_dataset()
        people = (self.dir / "people/views.csv").read_text()
        for flags in (("-o", "people"), ("--views-csv", "people/views.csv"), ("--gaze-csv", "people/views.csv")):
            done = self.vantage("eval", "people", "--method", "silhouette-length", *flags, exit_code=1)
            self.assertIn("--force", done.err)
            self.vantage("eval", "people", "--method", "silhouette-length", *flags, "--force", exit_code=2)
            self.assertEqual((self.dir / "people/views.csv").read_text(), people)
        os.mkdir(self.dir / "mine")
        for text in ("my notes\nmore of them\n", '{"key": 1}\n'):
            journal = self.write("mine/rows.jsonl", text)
            self.vantage("eval", "people", "--method", "silhouette-length", "-o", "mine", exit_code=3)
            self.assertEqual(journal.read_text(), text)

    def test_two_outputs_of_a_run_need_two_names(self):
        os.mkdir(self.dir / "l")
        os.symlink("l", self.dir / "link")
        self.eval_dataset()
        for words in (("skeleton", "a.off", "-o", "s.ply", "--meso", "l/../s.ply"),
                      ("skeleton", "a.off", "-o", "l/s.ply", "--meso", "link/s.ply"),
                      ("skeleton", "a.off", "-o", "l/level-01.ply", "--levels", "link"),
                      ("map", "a.off", "-o", "l/level-00.ply", "--levels", "l"),
                      ("score", "a.off", "--sphere", "0", "-o", "q.csv", "--visible", "./q.csv"),
                      ("view", "a.off", "-o", "r", "--views", "2", "--tour", "q.png", "--trace", "l/../q.png"),
                      ("eval", "people", "--views-csv", "q.csv", "--gaze-csv", "q.csv"),
                      ("eval", "people", "-o", "l", "--gaze-csv", "l/views.csv")):
            with self.subTest(words=words):
                before = sorted(self.dir.rglob("*"))
                done = self.vantage(*words, exit_code=2)
                self.assertRegex(done.err, r"give each its own name|is the name of one of the results")
                self.assertEqual(sorted(self.dir.rglob("*")), before)
        self.vantage("score", "a.off", "--sphere", "0", "-o", "/dev/null", "--visible", "/dev/null")


class StandardOutput(ProgramTest):
    """What goes there is one thing: a file, or JSON, or a summary."""

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1, 2, 3))

    def test_a_file_that_goes_there_is_all_that_does(self):
        self.vantage("map", "a.off", "-o", "map.ply", "--force")
        self.vantage("skeleton", "a.off", "-o", "skeleton.json", "--force")
        self.vantage("view", "a.off", "-o", "r", "--no-images", "--search", "rapid", "--trace", "trace.csv")
        for words, file in ((("map", "a.off", "-o"), "map.ply"), (("skeleton", "a.off", "-o"), "skeleton.json"),
                            (("view", "a.off", "-o", "r2", "--no-images", "--search", "rapid", "--trace"), "trace.csv")):
            done = subprocess.run([os.environ["VANTAGE"], *words, "-"], cwd=self.dir, capture_output=True, check=True)
            self.assertEqual(done.stdout, (self.dir / file).read_bytes())

    def test_json_does_not_share_it_with_a_file(self):
        for words in (("map", "a.off", "-o", "-"), ("render", "a.off", "--direction", "0,0,1", "-o", "-"), ("thumb", "a.off", "-"),
                      ("view", "a.off", "--no-images", "--trace", "-"),
                      ("score", "a.off", "--sphere", 0, "-o", "s.csv", "--visible", "-")):
            done = self.vantage(*words, "--json", exit_code=2)
            self.assertIn("standard output, where --json writes", done.err)
        scores = self.vantage("score", "a.off", "--sphere", "0", "-o", "scores.csv", "--json").out
        self.assertEqual(len(json.loads(scores)), 12)
        self.assertEqual(len((self.dir / "scores.csv").read_text().splitlines()), 13)

    def test_no_file_that_the_user_names_replaces_one_of_the_same_results(self):
        for flags in (("--trace", "r/view.json"), ("--views", "2", "--tour", "r/best.png")):
            done = self.vantage("view", "a.off", "-o", "r", "--no-images", *flags, exit_code=2)
            self.assertIn("is the name of one of the results", done.err)
        self.assertFalse((self.dir / "r").exists())


class Links(ProgramTest):

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1.0))
        self.victim = self.write("victim", "kept")

    def test_a_result_in_a_folder_replaces_a_link_and_a_pipe_of_its_name(self):
        view = ("view", "a.off", "-o", "v", "--size", "32", "--no-report", *FAST)
        compare = ("compare", "a.off", "-o", "c", "--method", "silhouette-length")
        figures = ("figures", "a.off", "-o", "f", "--size", "32", *FAST)
        levels = ("skeleton", "a.off", "-o", "s.json", "--levels", "l")
        for command, folder in ((view, "v"), (compare, "c"), (figures, "f"), (levels, "l")):
            with self.subTest(command=command[0]):
                self.vantage(*command)
                names = [p.name for p in (self.dir / folder).iterdir() if p.name not in ("view.json", "compare.json")]
                for i, name in enumerate(names):
                    (self.dir / folder / name).unlink()
                    if i % 2:
                        os.mkfifo(self.dir / folder / name)
                    else:
                        os.symlink(self.victim, self.dir / folder / name)
                self.vantage(*command, "--timeout", "60")
                self.assertEqual(self.victim.read_text(), "kept")
                for path in (self.dir / folder).iterdir():
                    self.assertTrue(path.is_file() and not path.is_symlink(), path)

    def test_a_link_that_the_user_names_is_followed(self):
        os.symlink("picture.png", self.dir / "link.png")
        self.write("picture.png", "")
        self.vantage("thumb", "a.off", "link.png", "-s", "16")
        self.assertTrue((self.dir / "link.png").is_symlink())
        self.assertTrue((self.dir / "picture.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_link_named_as_a_picture_to_what_is_none_is_not_written_through(self):
        self.write("notes.txt", "my notes\n")
        os.symlink("notes.txt", self.dir / "link.png")
        self.assertIn("--force", self.vantage("thumb", "a.off", "link.png", "-s", "16", exit_code=1).err)
        self.assertEqual((self.dir / "notes.txt").read_text(), "my notes\n")


class Leftovers(ProgramTest):

    def test_a_program_killed_at_any_moment_leaves_no_temporary_file(self):
        if not hasattr(os, "O_TMPFILE"):
            self.skipTest("NOTHING WAS TESTED: no files without a name on this system")
        try:
            os.close(os.open(self.dir, os.O_TMPFILE | os.O_WRONLY))
        except OSError as error:
            self.skipTest(f"NOTHING WAS TESTED: no files without a name in {self.dir}: {error}")
        self.write("a.off", angle_bar())
        command = [PROGRAM, "thumb", "a.off", "t.png", "-s", "1024", "--quality", "draft"]
        for _ in range(4):
            process = subprocess.Popen(command, cwd=self.dir)
            fds = pathlib.Path(f"/proc/{process.pid}/fd")
            while process.poll() is None:  # until the picture is being written
                try:
                    open_files = [os.readlink(fd) for fd in fds.iterdir()]
                except OSError:
                    continue
                if any(str(self.dir) in name for name in open_files):
                    break
                time.sleep(0.002)  # writing takes longer
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.assertEqual({p.name for p in self.dir.iterdir()} - {"t.png"}, {"a.off"})

    def test_only_temporary_files_of_ours_are_removed(self):
        view = ("view", MODELS / "fan.ply", "-o", "out", "--no-images", *FAST)
        self.vantage(*view)
        process = subprocess.Popen(["true"])
        process.wait()
        ours = self.write(f"out/.map.ply.part.{process.pid}", "half")
        theirs = self.write(f"out/.notes.part.{process.pid}", "mine")
        self.vantage(*view)
        self.assertEqual((ours.exists(), theirs.exists()), (False, True))


class LongNames(ProgramTest):

    def test_any_name_that_the_file_system_takes_can_be_written(self):
        self.write("a.off", angle_bar())
        for name in ("n" * 255, "n" * 240, "ä" * 127, "two\nlines", " ", "-x"):
            with self.subTest(name=name):
                self.vantage("thumb", "a.off", f"--output={name}", "-s", "16")
                self.assertTrue((self.dir / name).read_bytes().startswith(b"\x89PNG"))
                (self.dir / name).unlink()
                for _ in range(2):
                    self.vantage("view", "a.off", f"--output={name}", "--no-images", *FAST)
                self.assertTrue((self.dir / name / "view.json").is_file())

    def test_a_folder_may_be_named_with_slashes_at_its_end(self):
        self.write("a.off", angle_bar())
        for command in (("view", *FAST), ("compare", "--method", "projected-area")):
            said = self.vantage(command[0], "a.off", "--no-images", *command[1:], "-o", f"in/{command[0]}//").stdout.decode()
            self.assertRegex(said, f"results in +in/{command[0]}/\n")

    def test_a_folder_named_after_a_long_name_is_cut(self):
        for stem, folder in (("n" * 251, "n" * 247), ("ä" * 125, "ä" * 123)):
            self.write(f"{stem}.off", box(1.0))
            self.vantage("view", f"{stem}.off", "--no-images", *FAST)
            self.assertTrue((self.dir / f"{folder}.vantage" / "view.json").is_file())


if __name__ == "__main__":
    unittest.main()
