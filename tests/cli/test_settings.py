"""Options from the environment and from files; completions and manual pages, written from the same tables."""

import json
import os
import re
import shutil
import subprocess
import unittest

from program import ProgramTest
from shapes import TETRAHEDRON, obj

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"  # drawn as quickly as anything


class Settings(ProgramTest):

    def setUp(self):
        super().setUp()
        clean = {name: value for name, value in os.environ.items() if not name.startswith("VANTAGE")}
        self.addCleanup(os.environ.update, dict(os.environ))
        self.addCleanup(os.environ.clear)
        os.environ.clear()
        os.environ.update(clean)
        self.write("t.obj", TRIANGLE)

    def thumbnail_width(self, *arguments):
        self.vantage("thumb", "t.obj", "t.png", "--quality", "draft", *arguments)
        return int.from_bytes((self.dir / "t.png").read_bytes()[16:20], "big")

    def test_an_option_comes_from_the_command_line_then_its_commands_variable_then_the_common_one_then_the_file(self):
        self.write("c.json", '{"size": 41}')
        self.assertEqual(self.thumbnail_width("--config", "c.json"), 41)
        os.environ["VANTAGE_SIZE"] = "42"
        self.assertEqual(self.thumbnail_width("--config", "c.json"), 42)
        os.environ["VANTAGE_THUMB_SIZE"] = "43"
        self.assertEqual(self.thumbnail_width("--config", "c.json"), 43)
        self.assertEqual(self.thumbnail_width("--config", "c.json", "--size", "44"), 44)

    def test_a_commands_own_table_goes_before_the_common_one(self):
        self.write("c.json", '{"size": 41, /* for file managers */ "thumb": {"size": 45}, "view": {"size": "9x9"}}')
        os.environ["VANTAGE_CONFIG"] = "c.json"
        self.assertEqual(self.thumbnail_width(), 45)

    def test_a_list_is_one_value_each_where_an_option_takes_several(self):
        (self.dir / "models").mkdir()
        for name in ("a.off", "b.ply", "c.obj"):
            self.write(f"models/{name}", "no model")
        self.write("c.json", '{"include": ["*.off", "*.obj"], "up": ["y"]}')
        self.vantage("batch", "models", "-o", "out", "--config", "c.json", "-q", exit_code=4)
        keys = self.vantage("results", "query", "out", "--columns", "key").out
        self.assertEqual(keys.split(), ["key", "models/a.off", "models/c.obj"])

    def test_config_none_leaves_all_settings_out(self):
        os.environ["VANTAGE_SIZE"] = "42"
        self.assertEqual(self.thumbnail_width("--config", "none"), 256)

    def test_a_flag_can_be_set_and_left_unset(self):
        for value, written in (("true", True), ("1", True), ("false", False), ("0", False)):
            os.environ["VANTAGE_JSON"] = value
            self.assertEqual(self.vantage("info", "t.obj").out.startswith("{"), written, value)

    def test_a_variable_does_not_contradict_what_the_command_line_excludes(self):
        os.environ["VANTAGE_OUTPUT"] = "other.png"  # FILE and --output exclude each other
        self.vantage("thumb", "t.obj", "t.png", "--size", "32")
        self.assertEqual({path.name for path in self.dir.iterdir()}, {"t.obj", "t.png"})

    def test_a_variable_of_a_commands_that_sets_nothing_is_told(self):
        os.environ.update({"VANTAGE_THUMB_SIZEE": "64", "VANTAGE_VIEW_SIZEE": "64", "VANTAGE_DATA": "x"})
        thumb = ("thumb", "t.obj", "t.png", "--size", "32")
        self.assertEqual(self.vantage(*thumb).err, "warning: VANTAGE_THUMB_SIZEE is the name of no option of vantage thumb; "
                                                   "did you mean VANTAGE_THUMB_SIZE?\n")
        for flag in (("-q",), ("--config", "none")):
            self.assertEqual(self.vantage(*thumb, *flag).err, "")
        os.environ["VANTAGE_THUMB_VIEWS"] = "1"
        self.assertNotIn("HELP", self.vantage(*thumb).err)
        os.environ["VANTAGE_VIEW_SET"] = "1"  # of --view-set
        told = self.vantage("view", "absent.ply", exit_code=3).err
        self.assertIn("VANTAGE_VIEW_SIZEE", told)
        self.assertNotIn("VIEW_SET", told)

    def test_what_is_wrong_is_said_in_one_sentence_that_names_where(self):
        cases = (('{"sise": 3}', "c.json: 'sise' is not an option of any command"),
                 ('{"thumb": {"directions": "a.csv"}}', "c.json: 'directions' is not an option of thumb"),
                 ('{"help": true}', "c.json: 'help' is not an option of any command"),
                 ('{"thumb": {"config": "d.json"}}', "c.json: 'config' is not an option of thumb"),
                 ('{"ground": "yes"}', "c.json: ground: is a flag; say true or false"),
                 ('{"thumbnail": {}}', "c.json: 'thumbnail' is not a command"),
                 ('{"size": null}', "c.json: size: has no value"),
                 ('{"size": "big"}', "c.json: size: --size"),
                 ('{"size": ', "c.json: not JSON at byte 10"),
                 ('{"size": 1e999}', "c.json: has a number that is too large"),
                 ('{"size": -1e999}', "c.json: has a number that is too large"),
                 ('{"margin": "nan"}', "c.json: margin: --margin: must be a finite number"),
                 ('{"size": 41, "up": "y", "size": 42}', "c.json: names 'size' twice"),
                 ('{"thumb": {"up": "x", "up": "x"}}', "c.json: names 'up' twice"),
                 ("[1]", "c.json: holds no JSON object"))
        for text, message in cases:
            self.write("c.json", text)
            done = self.vantage("thumb", "t.obj", "t.png", "--config", "c.json", exit_code=2)
            self.assertIn(f"vantage: {message}", done.err)
            self.assertEqual(done.err.count("\n"), 1)
        self.assertIn("absent.json: cannot be read",
                      self.vantage("thumb", "t.obj", "t.png", "--config", "absent.json", exit_code=2).err)
        os.environ["VANTAGE_GROUND"] = "maybe"
        self.assertIn("VANTAGE_GROUND: is a flag",
                      self.vantage("thumb", "t.obj", "t.png", exit_code=2).err)
        self.assertFalse((self.dir / "t.png").exists())

    def test_a_flag_that_may_be_given_a_word_is_set_by_that_or_by_true(self):
        for value in ('"blocks"', "true"):
            self.write("c.json", f'{{"preview": {value}}}')
            self.assertIn("▀", self.vantage("thumb", "t.obj", "t.png", "-s", "32", "--config", "c.json").out, value)

    def test_what_has_no_effect_is_refused_if_typed_and_passed_over_if_set(self):
        self.write("t.obj", obj(*TETRAHEDRON))
        self.write("c.json", '{"base": "cube", "subdivisions": 2, "starts": 16, "epsilon": 1, "min-separation": 20, '
                             '"select": "vazquez", "information": 0.1, "tour-path": "explore", "fps": 5, "partition": "x"}')
        self.vantage("view", "t.obj", "--starts", "16", exit_code=2)
        os.environ["VANTAGE_CONFIG"] = "c.json"
        self.vantage("view", "t.obj", "--starts", "16", exit_code=2)
        self.vantage("view", "t.obj", "--tour-path", "explore", "--select", "kssm", exit_code=2)
        self.vantage("render", "t.obj", "-o", "a.png", "--direction", "0,0,1", "--size", "32")
        self.vantage("batch", "t.obj", "-o", "b", "--write", "json", "-q")
        said = [json.loads(self.vantage("view", "t.obj", "-o", "v", "--no-images", "--json", "--force", *flags).out)
                for flags in ((), ("--config", "none"))]
        self.assertEqual(said[0]["options_hash"], said[1]["options_hash"])
        self.assertNotIn("views", said[0])

    def test_a_batch_hands_settings_to_its_workers(self):
        os.environ["VANTAGE_BATCH_SIZE"] = "40x30"
        self.vantage("batch", "t.obj", "-o", "out", "--write", "best", "--jobs", "1", "--contraction", "exact", "-q")
        picture = next((self.dir / "out").rglob("best.png")).read_bytes()
        self.assertEqual(picture[16:24], bytes([0, 0, 0, 40, 0, 0, 0, 30]))


class Words(ProgramTest):
    """Completions and manual pages."""

    def commands(self):
        listed = self.vantage("--help").out.split("Subcommands:")[1].split("\n\n")[0]
        names = re.findall(r"^  (\w+)", listed, re.MULTILINE)
        self.assertGreater(len(names), 10)
        return [name for name in names if name != "results"] + ["results query", "results diff"]

    def complete(self, *words):
        """What bash offers for a command line that ends with the last word."""
        script = self.write("completion.bash", self.vantage("completion", "bash").out)
        line = " ".join(f"'{word}'" for word in ("vantage", *words))
        done = subprocess.run(
            ["bash", "-c", f"source {script}; COMP_WORDS=({line}); COMP_CWORD={len(words)}; _vantage; "
                           "printf '%s\\n' \"${COMPREPLY[@]}\""],
            cwd=self.dir, capture_output=True, check=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_commands_options_values_and_files(self):
        self.assertEqual(self.complete("th"), ["thumb"])
        self.assertEqual(self.complete("results", ""), ["query", "export", "diff", "merge", "verify"])
        self.assertEqual(self.complete("thumb", "--cre"), ["--crease"])
        self.assertEqual(self.complete("results", "query", "--stat"), ["--status"])
        self.assertEqual(self.complete("view", "--weight", ""), ["vertex", "area"])
        for words, offered in ((("view", "--style", "="), ["clay", "asset", "technical"]),
                               (("view", "--style", "=", "c"), ["clay"]), (("view", "--preview", "=", "b"), ["blocks"]),
                               (("score", "--method", "kssm,vm"), ["kssm,vmi"]),
                               (("batch", "--write", "map,worst-s"), ["map,worst-skeleton"]),
                               (("batch", "--write", "j"), ["json"])):
            self.assertEqual(self.complete(*words), offered)
        self.write("horse.ply", "")
        self.assertEqual(self.complete("view", "hor"), ["horse.ply"])
        self.assertEqual(self.complete("view", "--preview", "hor"), ["horse.ply"])
        self.assertEqual(self.complete("completion", ""), ["bash", "zsh", "fish"])
        self.assertIn("--help", self.complete("completion", "--"))

    def test_bash_offers_every_option_that_help_lists(self):
        for call in self.commands():
            words = call.split()
            listed = set(re.findall(r"^ +(?:-\w,)?(--[\w-]+)", self.vantage(*words, "--help-all").out, re.MULTILINE))
            self.assertGreaterEqual(len(listed), 1)
            self.assertLessEqual(listed, set(self.complete(*words, "--")), call)

    def test_zsh_and_fish_accept_their_scripts(self):
        for shell, flag in (("zsh", "-n"), ("fish", "--no-execute")):
            with self.subTest(shell):
                if shutil.which(shell) is None:
                    self.skipTest(f"NOTHING WAS TESTED: {shell} is not installed")
                script = self.write(f"completion.{shell}", self.vantage("completion", shell).out)
                done = subprocess.run([shell, flag, script], capture_output=True, check=False, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_fish_completes_options_and_values(self):
        if shutil.which("fish") is None:
            self.skipTest("NOTHING WAS TESTED: fish is not installed")
        script = self.write("vantage.fish", self.vantage("completion", "fish").out)
        for line, offered in (("vantage thumb --crea", "--crease"), ("vantage view --weight ar", "area"),
                              ("vantage comp", "compare"), ("vantage completion ", "zsh")):
            done = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C '{line}'"],
                                  cwd=self.dir, capture_output=True, check=True, text=True,
                                  env={**os.environ, "HOME": str(self.dir)})
            rows = [row.split("\t")[0] for row in done.stdout.splitlines()]
            self.assertIn(offered, rows, done.stderr)
            self.assertNotIn("vantage.fish", rows)

    def test_every_command_has_a_manual_page_with_every_option(self):
        (self.dir / "man").mkdir()
        self.vantage("manual", "man")
        for call in self.commands():
            words = call.split()
            page = (self.dir / "man" / f"vantage-{'-'.join(words)}.1").read_text()
            listed = re.findall(r"^ +(?:-\w,)?(--[\w-]+)", self.vantage(*words, "--help-all").out, re.MULTILINE)
            for option in listed:
                self.assertIn(option.replace("-", "\\-"), page, call)

    def test_manual_pages_are_well_formed(self):
        if shutil.which("groff") is None:
            self.skipTest("NOTHING WAS TESTED: groff is not installed")
        (self.dir / "man").mkdir()
        self.vantage("manual", "man")
        for page in sorted((self.dir / "man").iterdir()):
            done = subprocess.run(["groff", "-man", "-Kutf8", "-Tutf8", "-wmac", "-wsyntax", page], capture_output=True,
                                  check=True, text=True)
            self.assertEqual(done.stderr, "", page.name)
            self.assertIn("SYNOPSIS", re.sub(".\b|\x1b\\[\\d+m", "", done.stdout))


if __name__ == "__main__":
    unittest.main()
