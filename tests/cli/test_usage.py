"""A command line that helps: what was meant, what is needed first, and quiet ends."""

import os
import re
import signal
import subprocess
import unittest
import unittest.mock

from png import read_png
from program import MODELS, PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box

FAN = MODELS / "fan.ply"


class WhatWasMeant(ProgramTest):

    def complaint(self, *words):
        done = self.vantage(*words, exit_code=2)
        self.assertEqual(len(done.err.splitlines()), 1, done.err)
        self.assertEqual(done.out, "")
        return done.err

    def test_commands(self):
        for word, meant in (("veiw", "view"), ("viwe", "view"), ("thum", "thumb"), ("skel", "skeleton"),
                            ("redner", "render"), ("Batch", "batch")):
            self.assertIn(f"did you mean {meant}?", self.complaint(word, "x.ply"))
        self.assertNotIn("did you mean", self.complaint("make-coffee"))
        self.assertIn("did you mean query?", self.complaint("results", "qurey"))
        self.write("a.off", box(1))
        self.assertIn("did you mean vantage view a.off?", self.complaint("a.off"))

    def test_a_folder_that_is_named_like_a_picture_is_refused(self):
        self.write("a.off", box(1))
        self.assertIn("one picture is made by render and thumb", self.complaint("view", "a.off", "-o", "a.png"))

    def test_flags(self):
        for words, wrong, meant in (((FAN, "--sise", "30"), "--sise", "--size"),
                                    ((FAN, "--methd=kssm"), "--methd", "--method"),
                                    (("--objectve", "people", FAN), "--objectve", "--objective"),
                                    ((FAN, "-size", "30"), "-size", "--size"),
                                    ((FAN, "--no-image"), "--no-image", "--no-images")):
            said = self.complaint("view", *words)
            self.assertIn(f"knows no flag {wrong}", said)
            self.assertIn(f"did you mean {meant}?", said)
        self.write("-a.off", box(1))
        self.assertIn("knows no flag -a.off; ./-a.off is the file of this name", self.complaint("view", "-a.off"))
        self.assertIn("did you mean --direction?", self.complaint("render", FAN, "--directoin", "1,2,3", "-o", "b.png"))

    def test_a_flag_of_another_command(self):
        for command, flag, has_it in (("thumb", "--direction", "vantage render has it"), ("info", "--style", "vantage view and others have it")):
            self.assertIn(f"vantage {command} knows no flag {flag}; {has_it}", self.complaint(command, FAN, flag, "1"))

    def test_numbers(self):
        for words, wanted in ((("view", FAN, "--fov", "400"), "--fov: must be a number from 1 to 170, not 400"),
                              (("view", FAN, "--views", "2.5"), "--views: must be a whole number from 1 to 1000, not 2.5"),
                              (("view", FAN, "--seed", "1.5"), "--seed: must be a whole number from 0, not 1.5"),
                              (("batch", FAN, "-o", "out", "--timeout", "5m"), "from 0.001 to 10000000, not 5m"),
                              (("batch", FAN, "-o", "out", "--memory", "100MB"), "from 0.3 to 1000000, not 0.1"),
                              (("info", FAN, "--max-memory", "2 XB"), "with a unit, as in 500MB or 0.5GB, not 2 XB")):
            self.assertIn(wanted, self.complaint(*words))

    def test_sizes_have_units(self):
        self.write("a.off", box(1))
        for memory in ("0.5", "500MB", "0.5 gb", "1GiB"):
            self.vantage("batch", "a.off", "-o", "out", "--memory", memory, "--output-limit", "0.1GB", "--write", "json")
        for memory in ("500000000", "0.5GB", "500 mb"):
            self.vantage("info", "a.off", "--max-memory", memory)

    def test_help_of_a_command_is_asked_for_in_two_ways(self):
        self.assertEqual(self.vantage("help", "view").out, self.vantage("view", "--help").out)
        self.assertEqual(self.vantage("help").out, self.vantage("--help").out)
        self.assertEqual(self.vantage("-V").out, self.vantage("--version").out)

    def test_help_of_no_command_names_the_one_meant(self):
        self.assertIn("has no command 'rendr'; did you mean render?", self.complaint("help", "rendr"))

    def test_words_are_taken_in_any_case(self):
        pictures = []
        for up in ("x", "X"):
            self.vantage("render", FAN, "--up", up, "--direction", "1,2,3", "--size", "60", "-o", f"{up}.png")
            pictures.append((self.dir / f"{up}.png").read_bytes())
        self.assertEqual(*pictures)
        self.assertIn("W not in", self.complaint("render", FAN, "--up", "W", "--direction", "1,2,3", "-o", "w.png"))

    def test_the_first_wrong_word_is_named(self):
        self.assertIn("--sise", self.complaint("view", FAN, "--sise", "30", "--foo"))
        self.assertIn("'b'", self.complaint("view", "a", "b", "c"))
        self.assertIn("'abc'", self.complaint("view", FAN, "--size", "abc", "--foo"))
        self.assertIn("--foo", self.complaint("view", FAN, "--foo", "--size", "abc"))

    def test_values_too_many_or_too_few_are_told_in_plain_words(self):
        self.assertIn("--size is given more than once", self.complaint("thumb", FAN, "t.png", "-s", "64", "-s", "128"))
        self.assertIn("--size needs a value: width and height, pixels", self.complaint("thumb", FAN, "t.png", "--size"))

    def test_a_second_name_is_taken_for_the_output(self):
        for command, name in (("skeleton", "out.json"), ("map", "out.ply"), ("render", "out.png")):
            self.assertIn(f"'{name}' is one argument too many for vantage {command}; did you mean -o {name}?",
                          self.complaint(command, FAN, name))
        self.assertIn("; see --help", self.complaint("map", FAN, FAN))  # is there, to be read
        self.assertIn("; vantage batch takes several models", self.complaint("view", FAN, FAN))

    def test_standard_input_has_a_name(self):
        self.assertIn("/dev/stdin: cannot be read: no such file, or not a plain file; - reads standard input",
                      self.vantage("score", FAN, "--directions", "/dev/stdin", exit_code=3, stdin=b"0,0,1\n").err)

    def test_standard_input_has_no_folder(self):
        mesh = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
        self.assertIn("'a.mtl' was left out: it cannot be found without the model's folder; name the model by its path",
                      self.vantage("render", "-", "-o", "a.png", "--direction", "1,2,3", "--size", "32", stdin=mesh).err)

    def test_flags_that_contradict_each_other_are_refused(self):
        self.write("a.off", box(1))
        for flags, named in ((("--search", "rapid", "--objective", "people"), "--objective"),
                             (("--prior", "none", "--objective", "people"), "--prior"), (("-o", ""), "--output"),
                             (("--distance", 1.003), "--distance puts the eye 1.0030 radii"),
                             (("--distance", 1.1, "--margin", 45), "from 1.3287 radii on"),
                             (("--up", "z", "--front", "z"), "--front"), (("--up", "-y", "--front", "y"), "--front")):
            with self.subTest(flags=flags):
                self.assertIn(named, self.vantage("view", "a.off", *flags, exit_code=2).err)
        self.assertEqual([p.name for p in self.dir.iterdir()], ["a.off"])

    def test_what_a_command_does_not_use_is_refused(self):
        self.write("a.off", box(1))
        for words, named in ((("view", "a.off", "--method", "vmi", "--views", 3), "--views: goes with"),
                             (("view", "a.off", "--method", "vmi", "--coverage", .9), "--coverage: goes with"),
                             (("view", "a.off", "--method", "visible-triangles", "--search", "gradient"), "--search: "),
                             (("figures", "a.off", "-o", "f", "--objective", "people"), "--objective: has no effect"),
                             (("figures", "a.off", "-o", "f", "--certify"), "--certify: has no effect"),
                             (("view", "a.off", "--seed", 2**64), "--seed: is too large"),
                             (("compare", "a.off", "--search", "gradient", "--method", "visible-triangles"), "--search: ")):
            with self.subTest(words=words):
                self.assertIn(named, self.vantage(*words, exit_code=2).err)
        self.assertEqual([p.name for p in self.dir.iterdir()], ["a.off"])

    def test_flags_that_would_do_nothing_are_refused(self):
        self.write("a.off", box(1))
        looks = ("render", "a.off", "-o", "r.png", "--direction", "1,1,1", "--size", 16)
        scores = ("score", "a.off", "--sphere", 0, "--method", "viewpoint-entropy")
        maps = ("map", "a.off", "-o", "m.ply", "--method")
        table = [((*looks[:4], "--view", "best", "--certify"), "--certify"), ((*looks, "--certify"), "--certify"),
                 *(((*looks, *flag), flag[0]) for flag in (
                     ("--suppression", "mean"), ("--contraction", "exact"), ("--search", "rapid"), ("--weight", "area"),
                     ("--search", "exhaustive", "--subdivisions", 1), ("--objective", "people"))),
                 ((*looks, "--show", "kssm", "--search", "rapid"), "--search"),
                 *(((*scores, *flag), flag[0]) for flag in (
                     ("--suppression", "mean"), ("--contraction", "exact"), ("--weight", "area"), ("--view-set", 1))),
                 ((*scores[:4], "--view-set", 1), "--view-set"),
                 *(((*maps, method, *flag), flag[0]) for method in ("kssm", "mesh-saliency", "thickness")
                   for flag in (("--fov", 40), ("--projection", "orthographic"), ("--distance", 3))),
                 *(((*maps, "thickness", *flag), flag[0]) for flag in (("--suppression", "mean"), ("--weight", "area"))),
                 ((*maps, "mesh-saliency", "--contraction", "exact"), "--contraction"),
                 (("orient", "a.off", "--features", "-o", "z.ply"), "--output"),
                 (("orient", "a.off", "--features", "--print"), "--print")]
        for words, flag in table:
            with self.subTest(words=words):
                self.assertRegex(self.vantage(*words, exit_code=2).err, f"^vantage: {flag}: .{{20}}")
        self.assertEqual([p.name for p in self.dir.iterdir()], ["a.off"])

    def test_flags_that_do_something_and_settings_are_taken(self):
        self.write("a.off", box(1))
        looks = ("render", "a.off", "-o", "r.png", "--size", 16)
        for words in ((*looks, "--direction", "1,1,1", "--show", "kssm", "--suppression", "local-maxima"),
                      (*looks, "--direction", "1,1,1", "--focus", 0, "--preset", "paper"),
                      ("score", "a.off", "--sphere", 0, "--method", "vmi", "--view-set", 0),
                      ("map", "a.off", "-o", "m.ply", "--method", "pmi-saliency", "--fov", 40)):
            self.vantage(*words)
        with unittest.mock.patch.dict(os.environ, VANTAGE_SUPPRESSION="mean", VANTAGE_SEARCH="rapid", VANTAGE_FOV="40",
                                      VANTAGE_CERTIFY="true", VANTAGE_VIEW_SET="1", VANTAGE_CONTRACTION="exact"):
            self.vantage(*looks, "--direction", "1,1,1")
            self.vantage("score", "a.off", "--sphere", 0, "--method", "viewpoint-entropy")
            self.vantage("map", "a.off", "-o", "m.ply", "--method", "mesh-saliency")

    def test_a_surface_without_area_is_bad_input(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
        for words in (("view", "--method", "vmi"), ("compare",), ("score", "--sphere", 1, "--method", "vmi")):
            self.assertIn("a.obj: ", self.vantage(words[0], "a.obj", *words[1:], exit_code=3).err, words)

    def test_of_a_surface_without_area_there_is_no_view(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
        for words in (("view", "a.obj"), ("thumb", "a.obj", "a.png")):
            self.assertIn("a: its faces have no area", self.vantage(*words, exit_code=1).err, words)
        self.assertEqual([p.name for p in self.dir.iterdir()], ["a.obj"])

    def test_a_component_too_far_away_for_any_view_is_named(self):
        self.write("a.obj", "".join(f"v {x} {y} {z}\n" for s, d in ((1, 0), (0.01, 1e8))
                                    for x, y, z in ((d, 0, 0), (d + s, 0, 0), (d, s, 0), (d, 0, s)))
                   + "".join(f"f {a + k} {b + k} {c + k}\n" for k in (0, 4)
                             for a, b, c in ((1, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4))))
        self.assertIn("a: it is too small beside how far away a small component of it lies",
                      self.vantage("view", "a.obj", exit_code=1).err)

    def test_what_a_camera_file_says_is_not_said_again(self):
        self.write("a.off", box(1))
        for flag in ("--fov", "--distance"):
            said = self.vantage("render", "a.off", "-o", "a.png", "--camera", "c.json", flag, "40", exit_code=2).err
            self.assertIn(f"{flag}: says what --camera says", said)

    def test_values_that_begin_with_a_dash_are_no_flags(self):
        self.assertIn("--foo", self.complaint("view", FAN, "--up", "-y", "--foo"))
        self.assertIn("--foo", self.complaint("render", FAN, "--direction", "-1,0,0", "-o", "x.png", "--foo"))

    def test_web_addresses_are_refused_as_such(self):
        for command in (("view",), ("info",), ("thumb", "-o", "t.png"), ("batch", "-o", "b")):
            done = self.vantage(command[0], "https://example.org/a.ply", *command[1:], exit_code=None)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("download it first", done.err, command)


class Help(ProgramTest):

    def flags(self, text):
        return set(re.findall(r"^ +(?:-\w,)?(--[\w-]+)", text, re.MULTILINE))

    def test_it_shows_what_people_need_first_and_where_the_rest_is(self):
        for command in ("view", "batch", "render", "score", "compare", "figures", "map", "skeleton", "thumb"):
            brief = self.vantage(command, "--help").out
            full = self.vantage(command, "--help-all").out
            shown, everything = self.flags(brief), self.flags(full)
            self.assertLess(shown, everything, command)
            self.assertLessEqual(len(shown), 14, (command, sorted(shown)))
            self.assertGreaterEqual(len(shown), 5, (command, sorted(shown)))
            self.assertIn(f"vantage {command} --help-all", brief)
            self.assertIn("Examples:", brief)
            self.assertIn("--threads", everything)

    def test_commands_with_few_options_show_all(self):
        self.assertNotIn("lists all", self.vantage("completion", "--help").out)

    def test_all_help_of_the_program_has_that_of_every_command(self):
        everything = self.vantage("--help-all").out
        for command in ("view", "batch", "results query"):
            self.assertIn(self.vantage(*command.split(), "--help-all").out.strip(), everything, command)
        self.assertNotIn("--threads", self.vantage("--help").out)

    def test_methods_are_completed(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.vantage("completion", shell).out
            for name in ("kssm", "mesh-saliency", "viewpoint-entropy"):
                self.assertIn(name, script, shell)
        probe = ("source <(\"$VANTAGE\" completion bash); COMP_WORDS=(vantage view x --method view); COMP_CWORD=4; "
                 "_vantage; printf '%s\\n' \"${COMPREPLY[@]}\"")
        done = subprocess.run(["bash", "-c", probe], capture_output=True, timeout=60, check=True)
        self.assertIn(b"viewpoint-entropy", done.stdout.split())


class QuietEnds(ProgramTest):

    def test_a_reader_that_has_seen_enough_ends_the_program_without_a_word(self):
        for command in (["score", FAN, "--sphere", "4"], ["completion", "bash"], ["view", FAN, "--json", "--no-images",
                                                                                  "--search", "rapid", "-o", "v"]):
            read, write = os.pipe()
            process = subprocess.Popen([PROGRAM, *map(str, command)], cwd=self.dir, stdout=write, stderr=subprocess.PIPE)
            os.close(write)
            os.close(read)
            error = process.communicate(timeout=300)[1]
            self.assertEqual((process.returncode, error), (-signal.SIGPIPE, b""), command)

    def test_a_head_in_a_shell(self):
        done = subprocess.run(["bash", "-c", f"'{PROGRAM}' score '{FAN}' --sphere 5 | head -n 2; echo ${{PIPESTATUS[0]}}"],
                              capture_output=True, timeout=300, check=True)
        self.assertEqual(done.stderr, b"")
        self.assertIn(done.stdout.splitlines()[-1], (b"0", b"141"))


class Tables(ProgramTest):

    def test_results_of_standard_input_are_in_stdin_vantage(self):
        self.vantage("view", "-", "--no-images", "--search", "rapid", stdin=box(1.0).encode())
        self.assertTrue((self.dir / "stdin.vantage/view.json").is_file())

    def test_compare_has_one_value_a_column(self):
        self.write("a.off", box(1.0))
        out = self.vantage("compare", "a.off", "--method", "silhouette-length,kssm", "--no-images").out.splitlines()
        columns = ["method", "best", "x", "y", "z", "worst", "x", "y", "z", "best", "°", "worst", "°", "rank", "views", "s"]
        self.assertEqual(out[0].split(), columns)
        for row in out[1:3]:
            self.assertEqual(len(row.split()), 12, row)
            self.assertEqual(len(row), len(out[0]), row)

    def test_compare_names_no_best_view_where_all_are_alike(self):
        self.write("a.off", box(1.0))
        out = self.vantage("compare", "a.off", "--method", "kssm,mesh-saliency", "--no-images").out
        self.assertEqual(out.splitlines()[2].split()[1:10], 9 * ["–"])
        self.assertNotIn("nan", out)
        self.assertNotIn("-0 ", out)
        self.assertIn("–: all views alike", out)

    def test_models_of_one_name_are_told_apart(self):
        for folder in ("one", "two"):
            os.mkdir(self.dir / folder)
        self.write("one/cup.off", box(1.0))
        self.write("two/cup.off", box(2.0))
        self.write("two/bowl.off", box(3.0))
        self.vantage("batch", "one", "two", "-o", "b", "--search", "rapid", "--size", "64", "--name", "{parent}-{stem}")
        self.assertIn("twins.get(row.name) > 1", (self.dir / "b/index.html").read_text())
        same = self.dir / "b/contact-sheet-0001.png"
        before = same.read_bytes()
        # Without a model of its name, a cup is just a cup.
        self.vantage("batch", "one", "-o", "c", "--search", "rapid", "--size", "64")
        self.assertNotEqual(before, (self.dir / "c/contact-sheet-0001.png").read_bytes())

    def test_models_of_one_name_in_one_folder_are_told_apart_by_their_endings(self):
        os.mkdir(self.dir / "in")
        self.write("in/cup.off", box(1.0))
        self.vantage("orient", "in/cup.off", "--up", "y", "-o", "in/cup.ply")
        self.vantage("batch", "in", "-o", "b", "--search", "rapid", "--size", "64")
        width, _, rows = read_png((self.dir / "b/contact-sheet-0001.png").read_bytes())
        gap, side, caption = 8, 160, 18  # of the sheet's tiles

        def names(tile):
            left = gap + tile * (side + gap)
            return [row[4 * left:4 * (left + side)] for row in rows[gap + side:gap + side + caption]]

        self.assertNotEqual(names(0), names(1))
        for tile in range(2):  # they are where they are looked for
            self.assertGreater(len(set(b"".join(names(tile)))), 2)
        self.assertEqual(width, gap + 2 * (side + gap))

    def test_a_contact_sheet_is_as_wide_as_its_models_need(self):
        names = [self.write(f"{i:02}.off", box(1.0 + i)).name for i in range(11)]
        gap, side, caption = 8, 160, 18
        for count, columns, tiles in ((1, 1, 1), (9, 9, 1), (11, 10, 2), (2, 2, 1)):
            self.vantage("batch", *names[:count], "-o", "b", "--search", "rapid", "--size", "64", "--forget")
            width, height, _ = read_png((self.dir / "b/contact-sheet-0001.png").read_bytes())
            self.assertEqual(width, gap + columns * (side + gap), count)
            self.assertEqual(height, gap + tiles * (side + caption + gap), count)


class StandardInput(ProgramTest):
    def test_it_is_read_by_one_option_at_most(self):
        done = self.vantage("score", "-", "--directions", "-", exit_code=2, stdin=b"")
        self.assertIn("is read once", done.err)


if __name__ == "__main__":
    unittest.main()
