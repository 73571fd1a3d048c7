"""Files beside models: each that is read belongs to the content, whatever the model is called."""

import pathlib
import time
import unittest
import zipfile

from hostile import gltf
from png import png
from program import PROGRAM
from program import contract_quickly as setUpModule
from test_batch import BatchTest

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
RED, BLUE = (200, 0, 0, 255), (0, 0, 200, 255)
COLLADA = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Z_UP</up_axis></asset>
<library_images><image id="im"><init_from>t.png</init_from></image></library_images>
<library_effects><effect id="fx"><profile_COMMON><newparam sid="s">
<surface type="2D"><init_from>im</init_from></surface>
</newparam><newparam sid="sm"><sampler2D><source>s</source></sampler2D></newparam><technique sid="c"><lambert><diffuse>
<texture texture="sm" texcoord="UV"/></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><source id="u"><float_array id="ua" count="6">
0 0 1 0 0 1</float_array><technique_common><accessor source="#ua" count="3" stride="2"><param name="S" type="float"/>
<param name="T" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 1 1 2 2</p></triangles></mesh></geometry>
</library_geometries>
<library_visual_scenes><visual_scene id="vs"><node><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>
"""


class FilesBeside(BatchTest):

    def colours(self, name, model, library=None):
        """The same model in three folders, beside a red picture and two blue ones."""
        for folder, colour in (("red", RED), ("blue", BLUE), ("same", BLUE)):
            (self.dir / folder).mkdir(exist_ok=True)
            self.write(f"{folder}/{name}", model)
            if library:
                self.write(f"{folder}/m.mtl", library)
            self.write(f"{folder}/t.png", png(colour))
        return [f"{folder}/{name}" for folder in ("red", "blue", "same")]

    def check_colours(self, names, out):
        self.assertEqual(self.batch(*names, out=out)["duplicates"], 1)
        self.assertEqual([self.rows(out)[name]["duplicate_of"] for name in names], ["", "", names[1]])
        self.write(names[0].split("/", maxsplit=1)[0] + "/t.png", png(BLUE))
        self.assertEqual(self.batch(*names, out=out)["duplicates"], 1)
        self.assertEqual(len({row["content"] for row in self.rows(out).values()}), 1)

    def test_an_obj_is_known_by_its_bytes_whatever_its_name(self):
        library = "newmtl m\nmap_Kd t.png\n"
        for i, name in enumerate(("model", "m.txt", "m.stl")):
            names = self.colours(name, f"mtllib m.mtl\nusemtl m\n{TRIANGLE}f 1/1 2/1 3/1\n", library)
            self.check_colours(names, f"out{i}")

    @unittest.skipUnless((pathlib.Path(PROGRAM).parent / "vantage-import").exists(), "NOTHING WAS TESTED: vantage-import is not there")
    def test_pictures_of_imported_models_belong_to_their_content(self):
        self.check_colours(self.colours("m.dae", COLLADA), "out")
        (self.dir / "red/t.png").unlink()
        for done in (1, 0):
            self.assertEqual(self.batch("red/m.dae")["done"], done)
        self.write("red/t.png", png(RED))
        self.assertEqual(self.batch("red/m.dae")["done"], 1)

    def test_what_was_missing_and_is_there_now_is_read(self):
        (self.dir / "in").mkdir()
        self.write("in/m.obj", f"mtllib m.mtl\nusemtl m\n{TRIANGLE}f 1/1 2/1 3/1\n")
        contents = set()
        for name, content in ((None, b""), ("m.mtl", b"newmtl m\nmap_Kd maps/t.png\n"), ("t.png", png(RED)),
                              ("maps/t.png", png(BLUE))):
            if name:
                (self.dir / "in" / name).parent.mkdir(exist_ok=True)
                self.write(f"in/{name}", content)
            for done in (1, 0):
                self.assertEqual(self.batch("in")["done"], done, name)
            contents.add(self.rows()["in/m.obj"]["content"])
        self.assertEqual(len(contents), 4)

    def test_pictures_of_many_materials_are_not_read_for_each(self):
        self.write("m.mtl", "".join(f"newmtl m{i}\nmap_Kd t.png\n" for i in range(3000)))
        self.write("t.png", png(RED) + bytes(20_000_000))
        self.write("m.obj", f"mtllib m.mtl\nusemtl m1\n{TRIANGLE}f 1/1 2/1 3/1\n")
        began = time.monotonic()
        self.batch("m.obj")
        self.assertLess(time.monotonic() - began, 10)  # 60 GB were read

    def test_files_beside_models_in_archives_are_missed_aloud(self):
        self.write("m.mtl", "newmtl m\nKd 1 0 0\n")  # beside the archive: none of it
        with zipfile.ZipFile(self.dir / "m.zip", "w") as archive:
            archive.writestr("m.obj", f"mtllib m.mtl\nusemtl m\n{TRIANGLE}f 1/1 2/1 3/1\n")
            archive.writestr("m.mtl", "newmtl m\nKd 1 0 0\n")
            archive.writestr("m.gltf", gltf("b.bin"))
            archive.writestr("b.bin", bytes(36))
        self.batch("m.zip", exit_code=4)
        rows = self.rows()
        view = (self.dir / "out/models" / rows["m.zip//m.obj"]["folder"] / "view.json").read_text()
        said = "files beside models in archives, as m.mtl, are not read; unpack the archive"
        self.assertIn(said, view)
        self.assertIn(said.replace("m.mtl", "b.bin"), rows["m.zip//m.gltf"]["error"])
        self.assertTrue(rows["m.zip//m.gltf"]["error"].startswith("m.zip//m.gltf: names the buffer b.bin"))
        self.assertEqual(self.batch("m.zip", exit_code=4)["skipped"], 2)


if __name__ == "__main__":
    unittest.main()
