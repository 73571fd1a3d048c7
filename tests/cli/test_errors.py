"""Wrong usage, bad input, full disks, signals: one sentence, the right exit code, nothing left."""

import itertools
import json
import os
import re
import signal
import subprocess
import time
import unittest

from program import MODELS, PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box, boxes

CUBE = boxes((0, 0, 0, 1, 1, 1))


class Usage(ProgramTest):

    def check_usage(self, *arguments):
        done = self.vantage(*arguments, exit_code=2)
        self.assertEqual(done.out, "")
        self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)

    def test_no_command(self):
        self.check_usage()
        self.assertIn("vantage view MODEL", self.vantage(exit_code=2).err)
        self.check_usage("results")
        self.assertRegex(self.vantage("results", exit_code=2).err, r"a command: \w+, .*; see vantage results --help")

    def test_a_flag_before_the_command(self):
        self.check_usage("--up", "z", "view", "a.off")
        self.assertIn("--up follows none", self.vantage("--up=z", "view", "a.off", exit_code=2).err)
        self.assertIn("no flag --versio; did you mean --version?", self.vantage("--versio", exit_code=2).err)

    def test_unknown_command(self):
        self.check_usage("veiw", "a.off")

    def test_unknown_flag(self):
        self.check_usage("view", "a.off", "--fast")

    def test_number_out_of_range(self):
        self.check_usage("view", "a.off", "--subdivisions", "99")
        self.check_usage("view", "a.off", "--fov", "0")
        self.check_usage("view", "a.off", "--size", "0x10")
        self.check_usage("view", "a.off", "--epsilon", "much")
        self.check_usage("view", "a.off", "--max-steps", "0")

    def test_no_number_is_a_nan_or_infinite(self):
        self.write("a.off", box(1.0))
        # Every option that takes a number has one and the same check (check_values in value_checks.cpp). One spelling
        # tells whether the option of a command has it; each spelling is tried on many.
        spellings, seen, real = itertools.cycle(("nan", "-nan", "inf", "-inf", "1e999", "infinity", "nan(1)")), set(), 0
        for command in ("view", "thumb", "render", "map", "skeleton", "score", "compare", "figures", "eval", "info", "serve",
                        "batch"):
            text = self.vantage(command, "--help-all").out
            for option in re.findall(r"^ +(?:-\w,)?(--[a-z-]+) X\b", text, re.MULTILINE):
                real += 1
                numbers = {next(spellings)} | (set() if option in seen else {"nan", "inf"})
                seen.add(option)
                for number in numbers:
                    done = self.vantage(command, "a.off", f"{option}={number}", exit_code=2)
                    self.assertIn(option, done.err, (command, option, number))
                    self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
        self.assertGreater(real, 50)
        for command in (("view", "a.off", "--epsilon=nan"), ("view", "a.off", "--epsilon=inf"), ("view", "a.off", "--epsilon=inf%"),
                        ("render", "a.off", "-o", "r.png", "--direction=nan,0,1"),
                        ("render", "a.off", "-o", "r.png", "--direction=inf,0,1")):
            self.vantage(*command, exit_code=2)
        for numbers in ("nan,0,1", "inf,0,1", "1e999,0,1"):
            self.write("d.csv", f"dx,dy,dz\n{numbers}\n")
            self.vantage("score", "a.off", "--directions", "d.csv", exit_code=3)

    def test_word_that_is_no_choice(self):
        self.check_usage("view", "a.off", "--search", "psychic")
        self.check_usage("view", "a.off", "--up", "w")


class Input(ProgramTest):

    def check_unreadable(self, name, *words):
        done = self.vantage("view", name, exit_code=3)
        self.assertEqual(done.out, "")
        lines = done.err.strip().splitlines()
        self.assertEqual(len(lines), 1, done.err)
        for word in (name, *words):
            self.assertIn(word, lines[0])
        self.assertEqual([p for p in self.dir.iterdir() if p.name != name], [])

    def test_missing_file(self):
        self.check_unreadable("missing.off", "No such file")

    def test_prior_file_that_is_none(self):
        self.write("cube.off", CUBE)
        self.write("my.json", '{"vantage_prior": 1, "upright": {"corner_strength": "much"}}')
        for prior, words in (("missing.json", "No such file"), ("my.json", "upright.corner_strength")):
            done = self.vantage("view", "cube.off", "--prior", prior, "-o", "out", exit_code=3)
            self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
            self.assertIn(prior, done.err)
            self.assertIn(words, done.err)
            self.assertFalse((self.dir / "out").exists())

    def test_folder_instead_of_a_file(self):
        os.mkdir(self.dir / "folder.off")
        self.check_unreadable("folder.off")

    def test_place_of_the_mistake_is_named(self):
        self.write("bad.off", CUBE.replace("1 1 1", "1 one 1"))
        self.check_unreadable("bad.off", "line 10")

    def test_index_past_the_last_vertex(self):
        self.write("bad.off", CUBE.replace("4 1 5 7 3", "4 1 5 7 8"))
        self.check_unreadable("bad.off", "line 16")

    def test_truncated_file(self):
        self.write("cut.ply", (MODELS / "fan.ply").read_bytes()[:3000])
        self.check_unreadable("cut.ply")

    def test_empty_file(self):
        self.write("empty.obj", "")
        self.check_unreadable("empty.obj")

    def test_format_that_is_not_read_names_a_converter(self):
        self.write("part.vtk", "# vtk DataFile Version 3.0\n")
        self.check_unreadable("part.vtk", "convert")

    def test_points_on_a_line_have_no_shape(self):
        self.write("p.off", "OFF\n4 0 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n")
        done = self.vantage("view", "p.off", exit_code=1)
        self.assertIn("line", done.err)
        self.assertIn("4", self.vantage("info", "p.off").out)

    def test_no_extent(self):
        self.write("dot.off", "OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n")
        self.vantage("view", "dot.off", exit_code=1)


class Terminal(ProgramTest):
    """What names and words from outside may do to the terminal: be read."""

    EVIL = (b"\x1b[31m\x1b]0;owned\x07two\nlines\r\x08\x7f" +
            "\u202eff0.x\u2066x\u200fx\u061cx\u2028x\u009b31m".encode(),
            b"\x9b31m\xff\xfex\xc0\x9bx\xed\xa0\x80x\xf5\x80\x80\x80x\xe2\x80x\xc2")

    def assert_harmless(self, *command):
        """Runs it and looks at both streams."""
        done = subprocess.run([PROGRAM, *command], cwd=self.dir, capture_output=True, timeout=120, check=False)
        self.assertNotEqual(done.stdout + done.stderr, b"", command)
        for stream in (done.stdout, done.stderr):
            text = stream.decode()  # fails if it is no UTF-8
            self.assertNotRegex(text, "[\x00-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]", command)
        if done.returncode in (1, 2, 3):
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, (command, done.stderr))
        return done

    def test_in_errors_of_usage_and_of_files(self):
        self.write("a.off", box(1.0))
        for evil in self.EVIL:
            for command in ((b"--" + evil,), (evil,), (b"view", b"a.off", evil), (b"info", evil + b".off"),
                            (b"info", b"a.off", b"--threads", evil), (b"render", b"a.off", b"--direction", b"0,0,1", b"-o", b"t" + evil + b".jpg"),
                            (b"thumb", b"a.off", b"a.off/" + evil + b".png", b"-s", b"16"), (b"info", b"a.off", b"--config", evil),
                            (b"score", b"a.off", b"--directions", evil), (b"score", b"a.off", b"--method", evil, b"--sphere", b"0"),
                            (b"view", b"a.off", b"-o", b"a.off/" + evil, b"--no-images", b"--search", b"rapid"), (b"view", b"a.off", b"--focus", evil),
                            (b"render", b"a.off", b"-o", b"r.png", b"--direction", evil), (b"serve", evil),
                            (b"eval", evil), (b"batch", b"--manifest", evil, b"-o", b"b"), (b"results", b"query", evil),
                            (b"completion", evil), (b"manual", evil)):
                self.assertNotEqual(self.assert_harmless(*command).returncode, 0, command)

    def test_in_the_environment_and_in_a_file_of_options(self):
        self.write("c.json", json.dumps({"info": {"\x1b[31m\u202e\u009b": 1}}))
        self.assert_harmless(b"info", b"a.off", b"--config", b"c.json")
        self.write("c.json", json.dumps({"threads": "\x1b[31m\u202e\u009b"}))
        self.assert_harmless(b"info", b"a.off", b"--config", b"c.json")

    def test_in_what_is_said_of_a_file_that_is_read(self):
        for i, evil in enumerate(self.EVIL):
            name = evil.replace(b"/", b"") + b".off"
            (self.dir / os.fsdecode(name)).write_text(box(1.0))
            for command in ((b"info", name), (b"map", name, b"-o", name + b".ply"), (b"thumb", name, name + b".png", b"-s", b"16"),
                            (b"skeleton", name, b"-o", name + b".json"), (b"figures", name, b"-o", b"f", b"--size", b"32"),
                            (b"compare", name, b"-o", b"c%d" % i, b"--method", b"silhouette-length", b"--no-images"),
                            (b"view", name, b"-o", b"v%d" % i, b"--no-images", b"--search", b"rapid", b"-v")):
                if command[0] == b"thumb":
                    continue  # says nothing
                self.assertEqual(self.assert_harmless(*command).returncode, 0, command)


class Output(ProgramTest):

    def test_full_disk_asks_to_try_again_and_leaves_nothing(self):
        if not os.path.exists("/dev/full"):
            self.fail("/dev/full is needed to test a full disk")
        for words in (["score", str(MODELS / "fan.ply"), "--sphere", "0"], ["--help"], ["--version"], ["view", "--help-all"]):
            with self.subTest(words=words), open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *words], stdout=full, stderr=subprocess.PIPE, timeout=120, check=False)
                self.assertEqual(done.returncode, 75, done.stderr)

    def test_folder_that_cannot_be_made(self):
        self.write("file", "x")
        done = self.vantage("view", MODELS / "fan.ply", "-o", "file/out", "--no-images",
                            "--search", "rapid", exit_code=1)
        self.assertIn("file/out", done.err)

    def test_quiet_says_nothing(self):
        done = self.vantage("view", MODELS / "fan.ply", "-o", "out", "--no-images", "-q",
                            "--search", "rapid")
        self.assertEqual((done.out, done.err), ("", ""))


class Signals(ProgramTest):

    def interrupt(self, number):
        process = subprocess.Popen(
            [PROGRAM, "view", str(MODELS / "mannequin.ply"), "-o", "out", "--search", "exhaustive",
             "--subdivisions", "5"],
            cwd=self.dir, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.0)  # into the work, which takes far longer
        started = time.monotonic()
        process.send_signal(number)
        _, err = process.communicate(timeout=60)
        self.assertLess(time.monotonic() - started, 5.0)
        self.assertEqual(len(err.decode().strip().splitlines()), 1)
        self.assertFalse((self.dir / "out").exists())
        return process.returncode

    def test_interrupt_ends_with_130(self):
        self.assertEqual(self.interrupt(signal.SIGINT), 130)

    def test_termination_ends_with_75(self):
        self.assertEqual(self.interrupt(signal.SIGTERM), 75)


if __name__ == "__main__":
    unittest.main()
