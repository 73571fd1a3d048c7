"""Thumbnails and the look of pictures: what file managers and catalogues rely on."""

import base64
import configparser
import json
import re
import subprocess
import unittest

from png import borders, read_png
from program import MODELS, PROGRAM, ProgramTest
from shapes import angle_bar, box

FAN = MODELS / "fan.ply"


class Thumb(ProgramTest):

    def bar(self):
        """A model that is quick to draw, for tests of names, formats and words."""
        return self.write("bar.off", angle_bar())

    def test_it_writes_a_square_png_of_256_pixels_with_a_transparent_ground(self):
        done = self.vantage("thumb", FAN, "fan.png")
        self.assertEqual((done.out, done.err), ("", ""))
        width, height, rows = read_png((self.dir / "fan.png").read_bytes())
        self.assertEqual((width, height), (256, 256))
        self.assertEqual(rows[0][3], 0)
        self.assertEqual(max(row[4 * 128 + 3] for row in rows), 255)

    def test_the_model_touches_the_margin_on_two_opposite_sides_and_is_centred(self):
        self.vantage("thumb", FAN, "fan.png", "-s", 200)
        left, right, top, bottom = borders(read_png((self.dir / "fan.png").read_bytes()), above=8)
        margin = 0.04 * 200
        touches = [all(abs(border - margin) <= 1 for border in sides) for sides in ((left, right), (top, bottom))]
        self.assertIn(True, touches, (left, right, top, bottom))
        self.assertLessEqual(abs(left - right), 2)
        self.assertLessEqual(abs(top - bottom), 2)

    def test_the_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 3):
            self.vantage("thumb", FAN, "-o", f"{threads}.png", "--threads", threads)
        pictures = {(self.dir / f"{threads}.png").read_bytes() for threads in (1, 3)}
        self.assertEqual(len(pictures), 1)

    def test_a_name_of_any_kind_becomes_a_png_as_file_managers_need(self):
        self.vantage("thumb", self.bar(), "-o", ".thumbnail.A1B2C3", "-s", 64)
        self.assertEqual(read_png((self.dir / ".thumbnail.A1B2C3").read_bytes())[:2], (64, 64))

    def test_webp_is_written_by_its_name(self):
        self.vantage("thumb", self.bar(), "-o", "fan.WebP", "-s", 64)
        data = (self.dir / "fan.WebP").read_bytes()
        self.assertEqual((data[:4], data[8:12]), (b"RIFF", b"WEBP"))

    def test_a_format_that_is_not_written_is_refused_before_any_work(self):
        done = self.vantage("thumb", FAN, "fan.jpg", exit_code=2)
        self.assertIn("FILE: pictures are written as .png or .webp", done.err)
        self.assertFalse((self.dir / "fan.jpg").exists())

    def test_a_picture_must_be_named_once(self):
        self.vantage("thumb", FAN, exit_code=2)
        self.vantage("thumb", FAN, "a.png", "-o", "b.png", exit_code=2)

    def test_sizes_out_of_range_are_wrong_usage(self):
        for size in (0, -1, 4097, "big"):
            self.vantage("thumb", FAN, "a.png", "-s", size, exit_code=2)

    def test_what_cannot_be_read_leaves_no_file_and_one_sentence(self):
        broken = self.write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n")
        for model in (broken, self.dir / "missing.stl", self.dir):
            done = self.vantage("thumb", model, "t.png", exit_code=3)
            self.assertEqual(len(done.err.splitlines()), 1, done.err)
            self.assertEqual([p.name for p in self.dir.iterdir()], ["broken.ply"])

    def test_a_failed_run_leaves_an_older_thumbnail_alone(self):
        old = self.write("t.png", "old")
        self.vantage("thumb", self.dir / "missing.stl", "t.png", exit_code=3)
        self.assertEqual(old.read_text(), "old")

    def test_a_shape_without_extent_fails(self):
        point = self.write("point.off", "OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n")
        self.vantage("thumb", point, "t.png", exit_code=1)
        self.assertFalse((self.dir / "t.png").exists())

    def test_flat_open_and_broken_shapes_have_thumbnails(self):
        flat = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
        isolated = box(1.0).replace("8 12 0", "9 12 0", 1).replace("\n3 0 1 3", "\n5 5 5\n3 0 1 3", 1)
        cloud = "\n".join(f"{x} {y} {x * y * 0.1}" for x in range(12) for y in range(12))
        for name, text in (("flat.off", flat), ("isolated.off", isolated), ("cloud.xyz", cloud)):
            self.vantage("thumb", self.write(name, text), name + ".png", "-s", 64)
            rows = read_png((self.dir / (name + ".png")).read_bytes())[2]
            self.assertGreater(sum(a > 128 for row in rows for a in row[3::4]), 200, name)

    def test_what_shows_next_to_nothing_says_so(self):
        self.write("needle.off", box(2e-5, 2e-5))
        done = self.vantage("thumb", "needle.off", "needle.png", "--json")
        self.assertRegex(done.err, "warning: the picture shows .*--size")
        self.assertIn("warning: " + json.loads(done.out)["warnings"][0], done.err)
        done = self.vantage("view", "needle.off", "-o", "v", "--size", "64x64", "--no-report")
        self.assertTrue(any("the picture shows" in d for d in
                            json.loads((self.dir / "v/view.json").read_text())["doubts"]), done.err)

    def test_points_have_their_own_colours(self):
        rows = [f"{x / 9} {y / 9} {0.1 * x * y / 81} 255 {10 * x} 0" for x in range(10) for y in range(10)]
        names = "".join(f"property {t} {n}\n" for t, n in (("float", "x"), ("float", "y"), ("float", "z"), ("uchar", "red"),
                                                          ("uchar", "green"), ("uchar", "blue")))
        self.write("points.ply", f"ply\nformat ascii 1.0\nelement vertex 100\n{names}end_header\n" + "\n".join(rows) + "\n")
        for style, coloured in (("asset", True), ("clay", False)):
            self.vantage("thumb", "points.ply", "points.png", "--style", style, "--force")
            pixels = [row[4 * x:4 * x + 4] for row in read_png((self.dir / "points.png").read_bytes())[2] for x in range(256)]
            opaque = [p for p in pixels if p[3] == 255]
            self.assertGreater(len(opaque), 1000)
            red = sum(p[0] > p[2] + 60 for p in opaque)
            self.assertEqual(red > 0.9 * len(opaque), coloured, style)

    def test_json_says_from_where(self):
        done = self.vantage("thumb", self.bar(), "bar.png", "--json", "--up", "z")
        said = json.loads(done.out)
        self.assertAlmostEqual(sum(x * x for x in said["direction"]), 1.0, 9)
        self.assertEqual((said["size"], said["up"]), (256, "z"))

    def test_it_tells_what_it_is_unsure_of(self):
        deer = MODELS / "deer.ply"
        said = json.loads(self.vantage("thumb", deer, "t.png", "-s", 32, "--json").out)["warnings"]
        self.assertTrue(any(note.startswith("front is unsure: ") for note in said), said)
        self.assertIn("note: " + said[0], self.vantage("thumb", deer, "t.png", "-s", 32, "-v").err)
        self.assertNotIn("front is unsure", self.vantage("thumb", deer, "t.png", "-s", 32).err)

    def test_its_view_is_about_as_good_as_the_best(self):
        best = json.loads(self.vantage("view", FAN, "--no-images", "-o", "r", "--json").out)["best"]
        said = json.loads(self.vantage("thumb", FAN, "fan.png", "--json").out)
        self.write("d.csv", "dx,dy,dz\n" + ",".join(map(str, said["direction"])) + "\n")
        row = self.vantage("score", FAN, "--directions", "d.csv").out.splitlines()[1]
        self.assertGreater(float(row.split(",")[-1]), 0.9 * best["score"])

    def test_from_standard_input_to_standard_output(self):
        import os
        import subprocess
        with open(self.bar(), "rb") as model:
            done = subprocess.run([os.environ["VANTAGE"], "thumb", "-", "-o", "-", "-s", "32"],
                                  stdin=model, capture_output=True, timeout=300, check=True)
        self.assertEqual(read_png(done.stdout)[:2], (32, 32))


class FileManagers(ProgramTest):
    """The entry that file managers read."""

    def command(self, model, file, size):
        """What a file manager calls, as a list of words."""
        entry = configparser.ConfigParser(interpolation=None)
        entry.read(MODELS.parent / "apps/vantage/desktop/vantage.thumbnailer")
        words = entry["Thumbnailer Entry"]["Exec"].split()
        self.assertEqual(words[0], entry["Thumbnailer Entry"]["TryExec"])
        return [{"%i": str(model), "%o": str(file), "%s": str(size)}.get(word, word) for word in words[1:]]

    def test_its_command_makes_a_thumbnail(self):
        file = self.write("made-beforehand", "")
        self.vantage(*self.command(self.write("bar.off", angle_bar()), file, 128))
        self.assertEqual(read_png(file.read_bytes())[:2], (128, 128))

    def test_its_command_takes_no_more_than_a_minute_and_4_gb(self):
        words = self.command("-", "t.png", 128)
        seconds = words.index("--timeout") + 1
        self.assertLessEqual(float(words[seconds]), 60)
        self.assertRegex(words[words.index("--max-memory") + 1], "^[1-4]GB$")
        hasty = [*words[:seconds], "0.5", *words[seconds + 1:]]  # not to wait for it
        with subprocess.Popen([PROGRAM, *hasty], cwd=self.dir, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            self.assertEqual(process.wait(timeout=60), 1)
            self.assertIn(b"longer than --timeout", process.stderr.read())
        # Of a model that does not fit, there is a sentence and no file.
        words[words.index("--max-memory") + 1] = "64MB"
        model = str(MODELS / "mannequin.ply")
        done = self.vantage(*[model if word == "-" else word for word in words], exit_code=None)
        self.assertIn(done.returncode, (1, 3), done.err)
        self.assertRegex(done.err, r"^vantage: [^\n]*memory[^\n]*\n$")
        self.assertEqual(list(self.dir.iterdir()), [])


class Preview(ProgramTest):

    def preview(self, *flags, **environment):
        import os
        import subprocess
        clean = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "COLORTERM")}
        model = self.write("bar.off", angle_bar())
        done = subprocess.run([os.environ["VANTAGE"], "thumb", model, "t.png", *flags], cwd=self.dir,
                              env={**clean, **environment}, capture_output=True, timeout=300, check=True)
        return done.stdout.decode()

    def test_half_blocks_fit_a_terminal_of_usual_size(self):
        text = self.preview("--preview", COLORTERM="truecolor")
        lines = re.sub("\033\\[[0-9;]*m", "", text).splitlines()
        self.assertLessEqual(max(map(len, lines)), 80)
        self.assertLessEqual(len(lines), 24)
        self.assertEqual(set("".join(lines)), set(" ▀▄"))
        self.assertIn("\033[38;2;", text)

    def test_every_colour_is_taken_back(self):
        for line in self.preview("--preview", COLORTERM="truecolor").splitlines():
            self.assertTrue(line == "" or line.endswith(("\033[0m", " ")), line[-20:])

    def test_terminals_of_256_colours_and_none(self):
        self.assertIn("\033[38;5;", self.preview("--preview=blocks"))
        self.assertNotIn("\033", self.preview("--preview", NO_COLOR="1"))

    def test_kitty_gets_the_picture_in_chunks_that_are_a_png(self):
        chunks = re.findall("\033_G([^;]*);([^\033]*)\033\\\\", self.preview("--preview=kitty"))
        self.assertIn("f=100", chunks[0][0])
        self.assertEqual([c[0][-3:] for c in chunks], ["m=1"] * (len(chunks) - 1) + ["m=0"])
        self.assertTrue(all(len(c[1]) <= 4096 for c in chunks))
        self.assertEqual(read_png(base64.b64decode("".join(c[1] for c in chunks)))[:2], (480, 480))

    def test_iterm_gets_a_png_of_the_size_that_is_said(self):
        size, data = re.search("File=inline=1;size=([0-9]+);width=480px:([^\a]*)\a",
                               self.preview("--preview=iterm")).groups()
        self.assertEqual(len(base64.b64decode(data, validate=True)), int(size))

    def test_sixels_have_as_many_columns_and_bands_as_the_picture(self):
        text = self.preview("--preview=sixel")
        self.assertTrue(text.startswith("\033P0;1q\"1;1;480;480#0;2;0;0;0"))
        bands = text[text.index("#215;2;100;100;100") + 18:text.rindex("\033\\")].split("-")[:-1]
        self.assertEqual(len(bands), 480 / 6)
        for row in bands[40].split("$")[:-1]:
            runs = re.findall("!([0-9]+)(.)|(.)", re.sub("^#[0-9]+", "", row))
            self.assertEqual(sum(int(count or 1) for count, _, _ in runs), 480)

    def test_json_and_quiet_runs_show_nothing(self):
        json.loads(self.preview("--preview", "--json"))
        self.assertEqual(self.preview("--preview", "-q"), "")


if __name__ == "__main__":
    unittest.main()
