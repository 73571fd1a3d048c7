"""CAD and game formats by vantage-import: read as they are, by every command, and a broken one harms nobody."""

import json
import os
import pathlib
import shutil
import stat
import struct
import subprocess
import unittest

import program
from blend_file import blend_file
from program import PROGRAM, ProgramTest
from program import contract_quickly as setUpModule

DATA = pathlib.Path(__file__).resolve().parents[1] / "data/import"
CORNERS = ((0, 0, 0), (4, 0, 0), (0, 3, 0), (0, 0, 2))
SIDES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
IMPORT = pathlib.Path(PROGRAM).parent / "vantage-import"




def source(name, values, width, kind="float"):
    array = "Name_array" if kind == "name" else "float_array"
    count = len(values.split())
    names = {1: ("JOINT" if kind == "name" else "WEIGHT",), 3: ("X", "Y", "Z"), 16: ("TRANSFORM",)}[width]
    param = "".join(f'<param name="{n}" type="{kind}"/>' for n in names)
    return (f'<source id="{name}"><{array} id="{name}a" count="{count}">{values}</{array}><technique_common>'
            f'<accessor source="#{name}a" count="{count // width}" stride="{width}">{param}</accessor>'
            "</technique_common></source>")


def collada(nodes, controller=""):
    """A tetrahedron with the legs of CORNERS, geometry g."""
    return ('<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
            '<unit meter="1" name="m"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>'
            + source("p", " ".join(str(x) for corner in CORNERS for x in corner), 3)
            + '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="4">'
            '<input semantic="VERTEX" source="#v" offset="0"/><p>'
            + " ".join(str(v) for side in SIDES for v in side)
            + f"</p></triangles></mesh></geometry></library_geometries>{controller}<library_visual_scenes>"
            f'<visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>'
            '<scene><instance_visual_scene url="#s"/></scene></COLLADA>')


class Import(ProgramTest):

    def info(self, name):
        return json.loads(self.vantage("info", "--json", DATA / name).out)

    def test_a_step_assembly_keeps_its_parts_their_places_and_unit(self):
        info = self.info("stand.step")
        self.assertEqual(info["format"], "step")
        self.assertEqual([part["name"] for part in info["parts"]], ["plate", "pin", "pin (2)"])
        self.assertEqual(info["unit_m"], 0.001)
        self.assertEqual(info["up"], "z")
        self.assertEqual(info["welded"]["components"], 3)
        self.assertTrue(info["welded"]["closed"])
        for found, wanted in zip(info["box"]["high"], (60, 40, 25)):
            self.assertAlmostEqual(found, wanted, delta=0.1)

    def test_a_cylinder_is_as_near_as_is_said(self):
        info = self.info("stand.step")
        exact = 60 * 40 * 5 + 2 * 3.141592653589793 * 5 * 5 * 20
        # Chords of 20 degrees lose at most two hundredths of a disc.
        self.assertLess(info["volume"], exact)
        self.assertGreater(info["volume"], exact - 0.0203 * (exact - 12000))

    def test_standard_input_need_not_be_open(self):
        shell = subprocess.run(["sh", "-c", 'exec "$0" info --json "$1" <&-', PROGRAM, DATA / "stand.step"],
                               capture_output=True, timeout=60, check=False)
        self.assertEqual(shell.returncode, 0, shell.stderr)
        self.assertEqual(json.loads(shell.stdout)["format"], "step")

    def box_of(self, name, text):
        self.write(name, text)
        self.vantage("view", name, "--no-images", "--up", "y", "-o", "o", "--force")
        box = json.loads(self.vantage("info", "--json", "o/map.ply").out)["box"]
        return [high - low for low, high in zip(box["low"], box["high"])]

    def test_a_shape_far_from_the_origin_keeps_its_size_to_the_map(self):
        place = '<node id="n"><translate>6000000 0 7000000</translate><instance_geometry url="#g"/></node>'
        wanted = [0.004, 0.003, 0.002]
        for found, side in zip(self.box_of("a.dae", collada(place.replace(
                "<instance", "<scale>0.001 0.001 0.001</scale><instance"))), wanted):
            self.assertAlmostEqual(found, side, delta=1e-6)

    def test_a_node_without_a_name_has_no_made_up_one(self):
        self.write("a.dae", collada('<node id="k"><instance_geometry url="#g"/></node>'))
        self.assertEqual([part["name"] for part in self.info(self.dir / "a.dae")["parts"]], ["g"])

    def test_a_skinned_mesh_is_where_its_joints_hold_it(self):
        one = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
        skin = ('<library_controllers><controller id="c"><skin source="#g"><bind_shape_matrix>10 0 0 0 0 10 0 0 '
                "0 0 10 0 0 0 0 1</bind_shape_matrix>" + source("j", "a b", 1, "name")
                + source("i", f"{one} {one}", 16, "float4x4")
                + source("w", "0.5", 1)  # shares need not sum to one
                + '<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#i"/>'
                '</joints><vertex_weights count="4"><input semantic="JOINT" source="#j" offset="0"/>'
                '<input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 1 1 1</vcount>'
                "<v>0 0 0 0 1 0 0 0</v></vertex_weights></skin></controller></library_controllers>")
        nodes = ('<node id="a" sid="a" name="a" type="JOINT"><node id="b" sid="b" name="b" type="JOINT">'
                 '<translate>0 100 0</translate></node></node><node id="n"><instance_controller url="#c">'
                 "<skeleton>#a</skeleton></instance_controller></node>")
        self.assertEqual(self.box_of("a.dae", collada(nodes, skin)), [40, 130, 20])
        self.assertIn("skinned meshes are shown as their joints stand", self.vantage("info", "a.dae").err)

    def test_what_an_fbx_hides_is_left_out_unless_that_is_all(self):
        numbers = ",".join(str(x) for corner in CORNERS for x in corner)
        sides = ",".join(f"{a},{b},{-c - 1}" for a, b, c in SIDES)

        def fbx(*shown):
            objects = "".join(
                f'Geometry: {k}, "Geometry::g", "Mesh" {{\nVertices: *12 {{\na: {numbers}\n}}\n'
                f'PolygonVertexIndex: *12 {{\na: {sides}\n}}\n}}\nModel: {100 + k}, "Model::m{k}", "Mesh" {{\n'
                f'Properties70:  {{\nP: "Show", "bool", "", "",{int(is_shown)}\n}}\n}}\n'
                for k, is_shown in enumerate(shown, 1))
            ties = "".join(f'C: "OO",{k},{100 + k}\nC: "OO",{100 + k},0\n' for k in range(1, len(shown) + 1))
            return ("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXVersion: 7400\n}\n"
                    f"Objects:  {{\n{objects}}}\nConnections:  {{\n{ties}}}\n")

        for shown, left in (((True, False), 4), ((True, True), 8), ((False, False), 8)):
            self.write("a.fbx", fbx(*shown))
            info = json.loads(self.vantage("info", "--json", "a.fbx").out)
            self.assertEqual(info["faces"], left, shown)
            self.assertEqual([note for note in info["notes"] if "hides" in note],
                             ["nodes that the file hides left out: 1"] if left == 4 else [])

    def test_other_formats_of_solids(self):
        plate, block = self.info("plate.iges"), self.info("block.brep")
        self.assertEqual((plate["format"], plate["faces"], plate["welded"]["closed"]), ("iges", 12, True))
        self.assertEqual((block["format"], block["faces"]), ("brep", 12))
        self.assertAlmostEqual(block["volume"], 6000)

    def test_a_collada_scene_is_placed_in_metres_with_its_parts(self):
        info = self.info("stool.dae")
        self.assertEqual((info["format"], info["vertices"], info["quads"]), ("dae", 120, 30))
        self.assertEqual([part["name"] for part in info["parts"]], ["seat", "leg-a", "leg-b", "leg-c", "leg-d"])
        self.assertEqual(info["unit_m"], 1)
        self.assertEqual(info["up"], "y")  # turned from the file's z, as Assimp does
        self.assertAlmostEqual(info["box"]["high"][1], 0.49, places=5)

    def test_an_fbx_says_its_up_axis_and_unit(self):
        info = self.info("lamp.fbx")
        self.assertEqual((info["format"], info["up"], info["unit_m"]), ("fbx", "z", 0.01))
        self.assertEqual([part["name"] for part in info["parts"]], ["foot", "pole"])
        self.assertEqual(info["box"]["high"][2], 32)

    def test_z_is_up_where_assimp_leaves_it_so(self):
        ogex = """GeometryNode $a {{ObjectRef {{ref {{$b}}}}}}
            GeometryObject $b {{Mesh (primitive = "triangles") {{VertexArray (attrib = "position") {{float[3] {{{}}}}}
            IndexArray {{unsigned_int32[3] {{{}}}}}}}}}""".format(
                *(", ".join(str(row).replace("(", "{").replace(")", "}") for row in rows) for rows in (CORNERS, SIDES)))
        for name, content, up in (("a.blend", blend_file(CORNERS, SIDES), "z"), ("a.ogex", ogex, "z"),
                                  ("y.ogex", 'Metric (key = "up") {string {"y"}}\n' + ogex, "y")):
            info = self.info(self.write(name, content))
            self.assertEqual((info["up"], info["box"]["high"], info["welded"]["closed"]), (up, [4, 3, 2], True), name)
        # Blender knows no other up, and a shape that looks better otherwise changes nothing.
        self.vantage("view", "a.blend", "-o", "v", "--no-images")
        view = json.loads((self.dir / "v/view.json").read_text())
        self.assertEqual((view["up"], view["up_source"], view["up_confidence"]), ("z", "format", 1))

    def test_vertices_come_in_the_order_of_the_file(self):
        self.vantage("map", DATA / "wedge.x", "-o", "m.ply")
        _, vertices, _ = program.read_ply(self.dir / "m.ply")
        # Assimp turns X files to a right hand; their order is the faces'.
        first = [(v["x"], v["y"], abs(v["z"])) for v in vertices[:4]]
        self.assertEqual(first, [(0, 0, 0), (4, 0, 0), (4, 0, 2), (0, 0, 2)])

    def test_focus_takes_the_name_of_a_part(self):
        self.vantage("view", DATA / "stand.step", "-o", "v", "--focus", "pin (2)", "--no-images")
        self.assertEqual(json.loads((self.dir / "v/view.json").read_text())["options"]["focus"], "pin (2)")

    def test_colours_reach_the_picture(self):
        for name in ("stand.step", "stool.dae", "lamp.fbx"):
            self.vantage("thumb", DATA / name, "with.png", "-s", "64", "--force")
            self.vantage("thumb", DATA / name, "without.png", "-s", "64", "--force", "--style", "clay")
            self.assertNotEqual((self.dir / "with.png").read_bytes(), (self.dir / "without.png").read_bytes(), name)

    def test_black_that_cannot_be_seen_is_no_colour(self):
        for colour, is_one in (("0 0 0 0", False), ("0 0 0 1", True)):
            self.write("a.dae", f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
                <library_geometries><geometry id="g"><mesh>
                <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
                <accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
                <param name="Z" type="float"/></accessor></technique_common></source>
                <source id="c"><float_array id="b" count="4">{colour}</float_array><technique_common>
                <accessor source="#b" count="1" stride="4"><param name="R" type="float"/><param name="G" type="float"/>
                <param name="B" type="float"/><param name="A" type="float"/></accessor></technique_common></source>
                <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
                <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/>
                <input semantic="COLOR" source="#c" offset="1" set="0"/><p>0 0 1 0 2 0</p></triangles></mesh></geometry></library_geometries>
                <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
                </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>""")
            self.assertEqual(self.info(self.dir / "a.dae")["vertex_colours"], is_one, colour)

    def test_results_are_the_same_bytes_again(self):
        for folder in ("a", "b"):
            self.vantage("view", DATA / "stand.step", "-o", folder, "--size", "64x64", "--no-report")
        for file in sorted((self.dir / "a").iterdir()):
            if file.name != "timings.json":
                self.assertEqual(file.read_bytes(), (self.dir / "b" / file.name).read_bytes(), file.name)

    def test_a_batch_takes_them_for_models(self):
        shutil.copytree(DATA, self.dir / "models")
        self.vantage("batch", "models", "-o", "out", "--write", "json", "-q")
        rows = self.vantage("results", "export", "out", "--format", "jsonl").out.splitlines()
        self.assertEqual(sorted(json.loads(row)["key"].rpartition("/")[2] for row in rows),
                         sorted(file.name for file in DATA.iterdir() if file.suffix != ".md"))
        self.assertTrue(all(json.loads(row)["status"] == "done" for row in rows), rows)

    def test_standard_input_is_known_by_its_bytes(self):
        info = json.loads(self.vantage("info", "--json", "-", stdin=(DATA / "stand.step").read_bytes()).out)
        self.assertEqual((info["format"], len(info["parts"])), ("step", 3))

    def test_standard_input_may_be_a_3ds(self):

        def chunk(mark, *parts):
            content = b"".join(parts)
            return struct.pack("<HI", mark, 6 + len(content)) + content

        corners = chunk(0x4110, struct.pack("<H12f", 4, *sum(CORNERS, ())))
        faces = chunk(0x4120, struct.pack("<H", 4), *(struct.pack("<4H", *side, 7) for side in SIDES))
        whole = chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"body\0", chunk(0x4100, corners, faces))))
        info = json.loads(self.vantage("info", "--json", "-", stdin=whole).out)
        self.assertEqual((info["format"], info["faces"], info["up"]), ("3ds", 4, "y"))

    def test_version_says_what_is_there_and_what_confines_it(self):
        # The kernel's word on filters of system calls, for any process.
        offered = "\nSeccomp_filters:" in pathlib.Path("/proc/self/status").read_text()
        means = r"(Landlock \d+, )?seccomp" if offered else r"\w.*"
        self.assertRegex(self.vantage("--version").out,
                         rf"vantage-import: Assimp 5\S*, Open CASCADE 7\S*; confined by {means}\n")


class Broken(ProgramTest):

    def fails(self, path, *more, says="cannot be read as", program_path=PROGRAM, env=None):
        done = subprocess.run([program_path, "info", path, *more], cwd=self.dir, capture_output=True, check=False, text=True,
                              timeout=120, env=env)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(says, done.stderr)

    def test_damaged_files_are_one_sentence(self):
        for name in ("stand.step", "plate.iges", "block.brep", "stool.dae", "lamp.fbx", "wedge.x"):
            content = (DATA / name).read_bytes()
            self.write(name, content[:len(content) // 3])
            self.fails(name, says=name)

    def stand_in(self, script):
        """A copy of the program beside a vantage-import that does what `script` says."""
        shutil.copy(PROGRAM, self.dir / "vantage")
        helper = self.write("vantage-import", f"#!/bin/sh\n{script}\n")
        helper.chmod(helper.stat().st_mode | stat.S_IXUSR)
        return self.dir / "vantage"

    def test_a_crash_inside_is_one_sentence(self):
        copy = self.stand_in("kill -SEGV $$")
        self.fails(DATA / "lamp.fbx", program_path=copy, says="the reader broke down on it (signal 11")
        self.write("a.blend", blend_file(CORNERS, SIDES))
        self.fails("a.blend", program_path=copy, says="because of a fault of its own, or because the file is damaged or needs "
                   "more memory than is allowed; export it as GLB from Blender")

    def test_what_to_do_with_a_blender_file_that_is_not_understood(self):
        self.write("a.blend", blend_file(CORNERS, ()))
        self.fails("a.blend", says="at least one object with no parent; export it as GLB from Blender\n")

    def test_lies_of_the_reader_are_not_believed(self):
        copy = self.stand_in("printf 'VNTGIMP1mesh\\377\\377\\377\\377\\377\\377\\377\\377'")
        self.fails(DATA / "lamp.fbx", program_path=copy, says="vantage-import sent less than it announced")
        copy = self.stand_in("exit 2")  # it knows no limit of faces
        self.fails(DATA / "lamp.fbx", program_path=copy, says="another version")
        copy = self.stand_in("exit 0")
        self.fails(DATA / "lamp.fbx", program_path=copy, says="another version")

    def test_more_memory_than_allowed_is_one_sentence(self):
        copy = self.stand_in("exec head -c 200000000 /dev/zero")
        self.fails(DATA / "lamp.fbx", "--max-memory", "100MB", program_path=copy, says="--max-memory")
        # Each node shows the next one twice: a billion nodes of 3 kB.
        below = "".join(f'<node id="n{k}"><instance_node url="#n{k + 1}"/><instance_node url="#n{k + 1}"/></node>'
                        for k in range(30)) + '<node id="n30"><instance_geometry url="#g"/></node>'
        self.write("a.dae", collada('<node><instance_node url="#n0"/></node>',
                                    f"<library_nodes>{below}</library_nodes>"))
        self.fails("a.dae", "--max-memory", "150MB", says="it needs more memory than is allowed")

    def test_faces_are_counted_before_they_are_sent(self):
        says = "has more than 59 faces, the most that --max-faces allows; decimate it, or allow more if there is the memory\n"
        self.vantage("info", DATA / "stool.dae", "--max-faces", "60")
        self.assertEqual(self.vantage("info", DATA / "stool.dae", "--max-faces", "59", exit_code=3).err,
                         f"vantage: {DATA / 'stool.dae'}: {says}")
        # One mesh that a scene shows again and again: 100 kB, of which 130 MB would come.
        triangles, nodes = 1000, 1500
        self.write("many.dae", f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
            <library_geometries><geometry id="g"><mesh>
            <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
            <accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
            <param name="Z" type="float"/></accessor></technique_common></source>
            <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
            <triangles count="{triangles}"><input semantic="VERTEX" source="#v" offset="0"/>
            <p>{"0 1 2 " * triangles}</p></triangles></mesh></geometry></library_geometries>
            <library_visual_scenes><visual_scene id="s">
            {'<node><instance_geometry url="#g"/></node>' * nodes}
            </visual_scene></library_visual_scenes>
            <scene><instance_visual_scene url="#s"/></scene></COLLADA>""")
        self.fails("many.dae", "--max-memory", "100MB", "--max-faces", "59", says=says[:-1])

    def test_a_reader_that_never_ends_is_ended(self):
        copy = self.stand_in("while :; do :; done")
        done = subprocess.run([copy, "info", DATA / "lamp.fbx", "--timeout", "1"], capture_output=True, check=False,
                              text=True, timeout=60)
        self.assertIn(done.returncode, (1, 3))  # whose clock rings first
        self.assertIn("--timeout", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_the_time_that_a_batch_allows_holds_for_the_reader(self):
        copy = self.stand_in("kill -XCPU $$")
        shutil.copy(DATA / "lamp.fbx", self.dir)
        done = subprocess.run([copy, "batch", "lamp.fbx", "-o", "out", "--timeout", "777"], cwd=self.dir, capture_output=True,
                              check=False, text=True, timeout=60)
        self.assertIn("takes more than 777 s", done.stderr)

    def test_a_reader_that_stays_after_its_output_is_ended(self):
        copy = self.stand_in("exec >&-; exec sleep 100")
        done = subprocess.run([copy, "info", DATA / "lamp.fbx"], capture_output=True, check=False, text=True, timeout=60)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (3, 1))
        self.assertIn("broke down", done.stderr)

    def test_without_the_package_the_message_names_it(self):
        shutil.copy(PROGRAM, self.dir / "vantage")
        nowhere = {**os.environ, "PATH": "/usr/bin:/bin"}
        if shutil.which("vantage-import", path=nowhere["PATH"]):
            nowhere["PATH"] = "/nowhere"
        for name, title in (("stand.step", "STEP"), ("lamp.fbx", "FBX"), ("wedge.x", "DirectX X")):
            self.fails(DATA / name, program_path=self.dir / "vantage", env=nowhere,
                       says=f"is a {title} file; install vantage-import to read {title}")
        said = subprocess.run([self.dir / "vantage", "--version"], capture_output=True, check=True, text=True, env=nowhere)
        self.assertIn("vantage-import: not installed", said.stdout)
        shutil.copytree(DATA, self.dir / "models")
        done = subprocess.run([self.dir / "vantage", "batch", "models", "-o", "out", "--dry-run"], cwd=self.dir,
                              capture_output=True, check=False, text=True, env=nowhere)
        self.assertNotIn("stand.step", done.stdout)


class Sandbox(unittest.TestCase):
    """What the confined process can still do, asked of the kernel."""

    def test_a_file_on_standard_input_is_all_that_is_read(self):
        # IGES is opened by its name: of a file in the file system, which Landlock forbids, and not of one without a name.
        with open(DATA / "plate.iges", "rb") as file:
            done = subprocess.run([IMPORT, "iges"], stdin=file, capture_output=True, check=False)
        if b"Landlock" in subprocess.run([IMPORT, "--version"], capture_output=True, check=True).stdout:
            self.assertEqual(done.returncode, 3)
            self.assertIn(b"fail", done.stdout)

    def test_it_refuses_what_is_no_file(self):
        done = subprocess.run([IMPORT, "step"], input=b"ISO-10303-21;", capture_output=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(subprocess.run([IMPORT], capture_output=True, check=False).returncode, 2)


if __name__ == "__main__":
    unittest.main()
