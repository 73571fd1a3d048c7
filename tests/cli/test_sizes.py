"""Pictures as wide or tall as what is seen, and pictures of the size that is asked for."""

import json
import unittest

from png import borders, read_png
from program import MODELS, ProgramTest
from program import contract_quickly as setUpModule
from shapes import angle_bar, box

FAST = ("--search", "rapid", "--no-report", "-q", "--force")


class Sizes(ProgramTest):

    def size_of(self, name):
        return read_png((self.dir / name).read_bytes())[:2]

    def test_a_view_fills_its_pictures_on_all_four_sides_unless_a_size_is_given(self):
        self.vantage("view", MODELS / "fan.ply", "-o", "v", *FAST)
        view = json.loads((self.dir / "v/view.json").read_text())
        self.assertEqual(view["options"]["size"], "auto")
        inside_limits = []
        for which in ("best", "worst"):
            for suffix in ("", "-kssm", "-skeleton"):
                self.assertEqual(list(self.size_of(f"v/{which}{suffix}.png")), view[which]["size"])
            width, height = view[which]["size"]
            self.assertLess(abs(width * height - 800 * 600), 500)
            margin = 0.04 * min(width, height)
            if 0.51 < width / height < 1.96:  # not at a limit
                inside_limits.append(which)
                for border in borders(read_png((self.dir / f"v/{which}.png").read_bytes())):
                    self.assertLess(abs(border - margin), 2.5, which)
        self.assertTrue(inside_limits, "no picture had borders on all four sides to check")
        self.assertNotEqual(view["best"]["size"], view["worst"]["size"])
        self.vantage("view", MODELS / "fan.ply", "-o", "v", "--size", "80x60", *FAST)
        self.assertEqual(self.size_of("v/best.png"), (80, 60))

    def test_cameras_are_of_the_aspect_of_their_picture(self):
        self.vantage("view", MODELS / "fan.ply", "-o", "v", "--size", "auto:60", "--views", 3, *FAST)
        view = json.loads((self.dir / "v/view.json").read_text())
        for which in ("best", "worst"):
            width, height = view[which]["size"]
            lens = json.loads((self.dir / f"v/camera-{which}.gltf").read_text())["cameras"][0]["perspective"]
            self.assertAlmostEqual(lens["aspectRatio"], width / height)
            nerf = json.loads((self.dir / f"v/camera-{which}.transforms.json").read_text())
            self.assertEqual([nerf["w"], nerf["h"]], [width, height])
            self.assertIn(f"--resolution={width},{height}", (self.dir / f"v/camera-{which}.f3d.txt").read_text())
        frames = json.loads((self.dir / "v/views.transforms.json").read_text())["frames"]
        for i, (of_set, frame) in enumerate(zip(view["views"], frames)):
            self.assertEqual([frame["w"], frame["h"]], of_set["size"])
            self.assertEqual(list(self.size_of(f"v/view-0{i + 1}.png")), of_set["size"])
        self.assertGreater(len({tuple(of_set["size"]) for of_set in view["views"]}), 1)

    def test_a_batch_makes_the_pictures_that_view_makes(self):
        self.vantage("batch", MODELS / "fan.ply", "-o", "b", "--write", "best,json", "--size", "auto:60", "-q")
        self.vantage("view", MODELS / "fan.ply", "-o", "v", "--size", "auto:60", *FAST[2:])
        best = next((self.dir / "b").rglob("best.png"))
        self.assertEqual(best.read_bytes(), (self.dir / "v/best.png").read_bytes())
        self.write("tall.off", box(1.0, 6.0))
        self.vantage("batch", "tall.off", "-o", "c", "--write", "best", "-q")
        width, height = read_png(next((self.dir / "c").rglob("best.png")).read_bytes())[:2]
        self.assertGreater(height, 1.9 * width)

    def test_a_picture_from_the_camera_of_a_view_is_that_of_the_view(self):
        self.write("bar.off", angle_bar())  # of few faces: contracted as a finer surface, drawn as it is
        small = ("--size", "auto:60")
        self.vantage("view", "bar.off", "-o", "v", "--up", "z", "--contraction", "auto", *small, *FAST)
        best = (self.dir / "v/best.png").read_bytes()
        width, height = self.size_of("v/best.png")
        self.assertNotEqual(width, height)
        for camera in ("view.json", "camera-best.gltf", "camera-best.transforms.json"):
            self.vantage("render", "bar.off", "-o", f"{camera}.png", "--camera", f"v/{camera}", *small)
            self.assertEqual((self.dir / f"{camera}.png").read_bytes(), best, camera)
        # Of the usual size, where none is given.
        self.vantage("render", "bar.off", "-o", "r.png", "--camera", "v/view.json", "--quality", "draft")
        usual_width, usual_height = self.size_of("r.png")
        self.assertLess(abs(usual_width * usual_height - 800 * 600), 500)
        self.assertLess(abs(usual_width / usual_height - width / height), 0.05)
        said = json.loads(self.vantage("render", "bar.off", "-o", "d.png", "--direction", "0,0,1", *small,
                                       "--json").out)
        self.assertEqual((said["width"], said["height"]), self.size_of("d.png"))

    def test_a_thumbnail_is_square_unless_auto_is_asked_for(self):
        self.write("tall.off", box(1.0, 6.0))
        self.vantage("thumb", "tall.off", "a.png", "-s", "40")
        self.assertEqual(self.size_of("a.png"), (40, 40))
        said = json.loads(self.vantage("thumb", "tall.off", "b.png", "-s", "auto:40", "--json").out)
        self.assertEqual(self.size_of("b.png"), (said["width"], said["height"]))
        self.assertGreater(said["height"], 1.9 * said["width"])
        self.assertEqual(said["size"], said["height"])
        for size in ("5000", "auto:5000", "0", "wide"):
            done = self.vantage("thumb", "tall.off", "c.png", "-s", size, exit_code=2)
            self.assertIn("--size", done.err)

    def test_tours_and_panels_are_of_one_size(self):
        for words in (("figures", MODELS / "fan.ply", "-o", "f", "--size", "auto"),
                      ("view", MODELS / "fan.ply", "-o", "v", "--views", "3", "--tour-size", "auto")):
            self.assertIn("must be WIDTHxHEIGHT", self.vantage(*words, exit_code=2).err)
        self.assertFalse((self.dir / "f").exists())


if __name__ == "__main__":
    unittest.main()
