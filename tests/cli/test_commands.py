"""Every command other than view."""

import base64
import json
import math
import os
import struct
import unittest

from program import MODELS, ProgramTest, read_ply
from program import contract_quickly as setUpModule
from shapes import TETRAHEDRON, off

REFINED = ("--contraction", "auto")  # for what a refined surface might have otherwise


class Skeleton(ProgramTest):

    def test_json_maps_every_vertex_to_a_node(self):
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json", *REFINED)
        skeleton = json.loads((self.dir / "s.json").read_text())
        self.assertEqual(set(skeleton), {"nodes", "edges", "radius", "vertex_node", "degree", "branches",
                                         "length"})
        self.assertEqual(len(skeleton["radius"]), len(skeleton["nodes"]))
        self.assertEqual(len(skeleton["vertex_node"]), 820)
        # a node that only leads the curve round a corner stands for no vertex
        self.assertLessEqual(set(skeleton["vertex_node"]), set(range(len(skeleton["nodes"]))))
        self.assertGreater(len(set(skeleton["vertex_node"])), len(skeleton["nodes"]) / 2)
        self.assertTrue(all(radius > 0 for radius in skeleton["radius"]))

    def test_skeleton_and_map_say_what_view_doubts_of_the_skeleton(self):
        fan = MODELS / "fan.ply"
        for command, file in (("skeleton", "s.json"), ("map", "m.ply")):
            done = self.vantage(command, fan, "-o", file, "--no-centre")
            self.assertRegex(done.err, r"warning: \d+ % of the skeleton's length is outside the surface")
            report = json.loads(self.vantage(command, fan, "-o", file, "--no-centre", "--json").out)
            self.assertEqual(len(report["doubts"]), 1)
            report = json.loads(self.vantage(command, fan, "-o", file, "--json", *REFINED).out)
            self.assertEqual(report["doubts"], [])

    def test_steps_of_the_contraction_are_told_one_by_one_with_v_only(self):
        done = self.vantage("skeleton", MODELS / "cat_lowpoly.ply", "-o", "s.json")
        self.assertEqual(done.err, "note: some steps of the contraction were taken with more care; -v lists them\n")
        done = self.vantage("skeleton", MODELS / "cat_lowpoly.ply", "-o", "s.json", "-v")
        self.assertRegex(done.err, r"note: contraction: step \d+ would ")

    def test_obj_and_ply_hold_the_same_graph(self):
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json")
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.obj")
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.ply")
        graph = json.loads((self.dir / "s.json").read_text())
        lines = (self.dir / "s.obj").read_text().splitlines()
        nodes = [[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")]
        edges = [[int(i) - 1 for i in line.split()[1:]] for line in lines if line.startswith("l ")]
        self.assertEqual(nodes, graph["nodes"])
        self.assertEqual(edges, graph["edges"])
        header = (self.dir / "s.ply").read_bytes().split(b"end_header")[0].decode()
        self.assertIn(f"element vertex {len(nodes)}", header)
        self.assertIn(f"element edge {len(edges)}", header)

    def test_json_branches_cover_every_edge_once(self):
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json")
        graph = json.loads((self.dir / "s.json").read_text())
        steps = [sorted(step) for run in graph["branches"] for step in zip(run, run[1:])]
        self.assertEqual(sorted(steps), graph["edges"])
        self.assertEqual(sum(graph["degree"]), 2 * len(graph["edges"]))

    def test_swc_is_a_tree_and_the_cut_loop_is_reported(self):
        done = self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.swc")
        self.assertIn("1 loop cut", done.err)
        lines = (self.dir / "s.swc").read_text().splitlines()
        self.assertIn("# loops cut: 1", lines)
        rows = [line.split() for line in lines if not line.startswith("#")]
        self.assertEqual([int(row[0]) for row in rows], list(range(1, len(rows) + 1)))
        self.assertTrue(all(int(row[6]) < int(row[0]) for row in rows))

    def test_graphml_holds_the_same_graph(self):
        import xml.etree.ElementTree
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json")
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.graphml")
        graph = json.loads((self.dir / "s.json").read_text())
        root = xml.etree.ElementTree.parse(self.dir / "s.graphml").getroot()
        space = "{http://graphml.graphdrawing.org/xmlns}"
        edges = [[int(e.get("source")[1:]), int(e.get("target")[1:])] for e in root.iter(space + "edge")]
        self.assertEqual(edges, graph["edges"])
        self.assertEqual(len(list(root.iter(space + "node"))), len(graph["nodes"]))

    def test_meso_is_the_last_level(self):
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json", "--levels", "levels", "--meso", "m.ply")
        last = max((self.dir / "levels").iterdir())
        self.assertEqual((self.dir / "m.ply").read_bytes(), last.read_bytes())

    def test_meso_of_a_sheet_is_what_it_was_thinned_to(self):
        around, along = 120, 180  # small models are not thinned
        rings = [(4 * math.cos(math.pi * i / (along + 1)), math.sin(math.pi * i / (along + 1)))
                 for i in range(1, along + 1)]
        points = [(x, r * math.cos(math.tau * j / around), r * math.sin(math.tau * j / around))
                  for x, r in rings for j in range(around)] + [(4, 0, 0), (-4, 0, 0)]
        faces = []
        for j in range(around):
            k = (j + 1) % around
            faces += [(along * around, j, k), (along * around + 1, (along - 1) * around + k, (along - 1) * around + j)]
            for i in range(0, (along - 1) * around, around):
                faces += [(i + j, i + around + j, i + around + k), (i + j, i + around + k, i + k)]
        self.write("egg.off", off(points, faces))
        self.vantage("skeleton", "egg.off", "-o", "s.json", "--levels", "levels", "--meso", "m.ply",
                     "--contraction-limit", "7", "--shrinkage-tolerance", "0.03")

        def thickness(file):
            vertices = read_ply(file)[1]
            return sum(math.hypot(v["y"], v["z"]) for v in vertices) / len(vertices)
        last = thickness(max((self.dir / "levels").iterdir()))
        self.assertLess(thickness(self.dir / "m.ply"), 0.1 * last)

    def test_render_says_how_high_an_orthographic_picture_is(self):
        command = ("render", MODELS / "fan.ply", "-o", "p.png", "--direction", "1,1,1", "--size", "24x16", "--json", "--force")
        self.assertNotIn("orthographic_height", json.loads(self.vantage(*command).out))
        flat = json.loads(self.vantage(*command, "--projection", "orthographic").out)
        self.assertEqual((flat["width"], flat["height"]), (24, 16))
        self.assertGreater(flat["orthographic_height"], 0)

    def test_figures_name_their_files_where_a_folder_is_no_utf8(self):
        folder = os.fsdecode(b"f\xff")
        done = self.vantage("figures", MODELS / "cat_lowpoly.ply", "-o", folder, "--size", "32", "--contraction", "exact", "--json")
        self.assertTrue(json.loads(done.out)["files"])

    def test_measure_says_how_much_is_outside(self):
        done = self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json", "--measure", "--json", *REFINED)
        quality = json.loads(done.out)["quality"]
        self.assertEqual(quality["outside_fraction"], 0)
        self.assertGreater(quality["seen_fraction"], 0.5)

    def test_levels_start_with_the_model_itself(self):
        self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.json", "--levels", "levels", *REFINED)
        levels = sorted(p.name for p in (self.dir / "levels").iterdir())
        self.assertEqual(levels, [f"level-{j:02}.ply" for j in range(len(levels))])
        self.assertGreater(len(levels), 1)
        self.vantage("map", MODELS / "fan.ply", "-o", "map.ply")
        _, first, _ = read_ply(self.dir / "levels" / "level-00.ply")
        _, model, _ = read_ply(self.dir / "map.ply")
        self.assertEqual([(v["x"], v["y"], v["z"]) for v in first],
                         [(v["x"], v["y"], v["z"]) for v in model])

    def test_other_endings_are_wrong_usage(self):
        done = self.vantage("skeleton", MODELS / "fan.ply", "-o", "s.xyz", exit_code=2)
        self.assertIn(".json", done.err)


class Map(ProgramTest):

    def test_thickness_is_the_displacement_of_level_zero(self):
        self.vantage("map", MODELS / "fan.ply", "-o", "t.ply", "--method", "thickness", *REFINED)
        self.vantage("map", MODELS / "fan.ply", "-o", "k.ply", "--levels", "levels", *REFINED)
        _, thickness, _ = read_ply(self.dir / "t.ply")
        _, level, _ = read_ply(self.dir / "levels" / "level-00.ply")
        self.assertEqual([v["quality"] for v in thickness], [v["quality"] for v in level])

    def test_warm_colours_stand_for_high_values(self):
        self.vantage("map", MODELS / "fan.ply", "-o", "k.ply")
        _, vertices, _ = read_ply(self.dir / "k.ply")
        ordered = sorted(vertices, key=lambda v: v["quality"])
        self.assertGreater(ordered[-1]["red"], ordered[-1]["blue"])
        self.assertGreater(ordered[0]["blue"], ordered[0]["red"])

    def test_other_endings_than_ply_are_wrong_usage(self):
        for name in ("map.json", "map.csv", "map"):
            done = self.vantage("map", MODELS / "fan.ply", "-o", name, exit_code=2)
            self.assertIn("must end in .ply", done.err)
            self.assertFalse((self.dir / name).exists())

    def test_every_choice_of_method_gives_another_map(self):
        maps = set()
        choices = ((), ("--suppression", "local-maxima"), ("--kinematics", "velocity"), ("--graph", "finished"),
                   ("--no-fit",), ("--flat-level", "0.06"))
        for flags in choices:
            self.vantage("map", MODELS / "deer.ply", "-o", "map.ply", *flags, *REFINED)
            maps.add((self.dir / "map.ply").read_bytes())
        self.assertEqual(len(maps), len(choices))


class Score(ProgramTest):

    def test_sphere_scores_one_row_a_direction(self):
        out = self.vantage("score", MODELS / "fan.ply", "--sphere", 1).out.splitlines()
        self.assertEqual(out[0], "method,dx,dy,dz,score")
        self.assertEqual(len(out), 1 + 42)

    def test_a_file_of_scores_holds_what_standard_output_gets(self):
        out = self.vantage("score", MODELS / "fan.ply", "--sphere", 0).out
        self.assertEqual(self.vantage("score", MODELS / "fan.ply", "--sphere", 0, "-o", "s.csv").out, "")
        self.assertEqual((self.dir / "s.csv").read_text(), out)

    def test_weight_area_integrates_the_map_over_the_surface_seen(self):
        # Of a convex surface an eye sees the faces whose planes it is before.
        corners, faces = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0, 0, 1)], TETRAHEDRON[1]
        self.write("m.off", off(corners, faces))
        self.vantage("map", "m.off", "--weight", "area", "-o", "map.ply")
        values = [vertex["quality"] for vertex in read_ply(self.dir / "map.ply")[1]]
        self.assertEqual(len(set(values)), 4)
        planes = []  # a corner, the normal as long as the area, and the integral of the map
        for a, b, c in faces:
            (x, y, z), (u, v, w) = ([q - p for p, q in zip(corners[a], corners[end])] for end in (b, c))
            normal = [(y * w - z * v) / 2, (z * u - x * w) / 2, (x * v - y * u) / 2]
            planes.append((corners[a], normal, math.hypot(*normal) * (values[a] + values[b] + values[c]) / 3))
        area = sum(math.hypot(*normal) for _, normal, _ in planes)
        eyes = [(50, 40, 60), (-30, 1, 0.2), (-20, -30, 1), (1, -40, -50), (-20, -30, -40), (40, -20, 30)]
        seen = [[sum(n * (e - p) for n, e, p in zip(normal, eye, point)) > 0 for point, normal, _ in planes] for eye in eyes]
        self.assertEqual({sum(of_eye) for of_eye in seen}, {1, 2, 3})
        self.write("eyes.csv", "".join(f"{x},{y},{z}\n" for x, y, z in eyes))
        out = self.vantage("score", "m.off", "--weight", "area", "--eyes", "eyes.csv").out
        for row, of_eye in zip(out.splitlines()[1:], seen, strict=True):
            expected = sum(integral for (_, _, integral), is_seen in zip(planes, of_eye) if is_seen) / area
            self.assertAlmostEqual(float(row.split(",")[-1]) / expected, 1, places=6)  # values of maps are floats

    def test_an_eye_at_the_scoring_distance_scores_as_its_direction(self):
        self.vantage("view", MODELS / "fan.ply", "-o", "out", "--no-images", "--search", "rapid")
        best = json.loads((self.dir / "out" / "view.json").read_text())["best"]
        self.write("eyes.csv", "x,y,z\n" + ",".join(repr(x) for x in best["eye"]) + "\n")
        out = self.vantage("score", MODELS / "fan.ply", "--eyes", "eyes.csv").out.splitlines()
        self.assertEqual(out[0], "method,x,y,z,score")
        self.assertAlmostEqual(float(out[1].split(",")[-1]) / best["score"], 1.0, places=3)

    def test_lengths_of_directions_do_not_matter(self):
        self.write("a.csv", "dx,dy,dz\n1,2,3\n")
        self.write("b.csv", "10,20,30\n")
        rows = [self.vantage("score", MODELS / "fan.ply", "--directions", name).out.splitlines()[1]
                for name in ("a.csv", "b.csv")]
        self.assertEqual(rows[0], rows[1])
        direction = [float(x) for x in rows[0].split(",")[1:4]]
        self.assertAlmostEqual(math.hypot(*direction), 1.0, places=15)


class Render(ProgramTest):

    def test_takes_a_direction_a_camera_or_the_best_view(self):
        size = ("--size", "96x72")
        self.vantage("view", MODELS / "fan.ply", "-o", "out", "--search", "rapid", *size)
        for name, source in (("a.png", ("--view", "best", "--search", "rapid")),
                             ("b.png", ("--camera", "out/view.json")),
                             ("g.png", ("--camera", "out/camera-best.gltf")),
                             ("t.png", ("--camera", "out/camera-best.transforms.json")),
                             ("c.png", ("--direction", "1,0.5,1"))):
            self.vantage("render", MODELS / "fan.ply", "-o", name, *source, *size)
        best = (self.dir / "out" / "best.png").read_bytes()
        self.assertEqual((self.dir / "a.png").read_bytes(), best)
        for name in ("b.png", "g.png", "t.png"):
            self.assertEqual((self.dir / name).read_bytes(), best, name)
        self.assertNotEqual((self.dir / "c.png").read_bytes(), best)

    def test_needs_one_place_to_look_from(self):
        self.vantage("render", MODELS / "fan.ply", "-o", "a.png", exit_code=2)
        self.vantage("render", MODELS / "fan.ply", "-o", "a.png", "--view", "best",
                     "--direction", "1,0,0", exit_code=2)


class Info(ProgramTest):

    def test_tells_what_the_file_holds(self):
        out = self.vantage("info", MODELS / "dustbin.ply").out
        self.assertIn("1 823", out)
        self.assertIn("genus 9", out)
        self.assertIn("defects", out)

    def test_info_counts_materials_and_notes_what_cannot_be_had_of_them(self):
        self.vantage("render", MODELS / "fan.ply", "--direction", "1,1,1", "--size", 8, "-o", "t.png")
        self.write("m.mtl", "newmtl a\nmap_Kd t.png\nnewmtl b\nmap_Kd gone.png\n")
        self.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n")
        done = self.vantage("info", "m.obj")
        self.assertRegex(done.out, r"materials +2, 1 texture\n")
        self.assertIn("gone.png", done.err)
        info = json.loads(self.vantage("info", "m.obj", "--json").out)
        self.assertEqual((info["materials"], info["textures"]), (2, 1))

    def test_info_tells_colours_of_materials_from_those_of_vertices(self):
        triangle = base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()
        gltf = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "buffers": [{"byteLength": 36, "uri": "data:;base64," + triangle}]}
        for own, says in ((False, "3, with colours of materials"), (True, "3, with colours")):
            if own:
                gltf["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 0
            self.write("a.gltf", json.dumps(gltf))
            self.assertRegex(self.vantage("info", "a.gltf").out, rf"vertices +{says}\n")
            self.assertEqual(json.loads(self.vantage("info", "--json", "a.gltf").out)["vertex_colours"], own)

    def test_json_counts_defects(self):
        self.write("open.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 9 9\n3 0 1 2\n3 1 3 2\n")
        info = json.loads(self.vantage("info", "open.off", "--json").out)
        self.assertEqual(info["isolated_vertices"], 1)
        self.assertEqual(info["welded"]["boundary_loops"], 1)
        self.assertFalse(info["welded"]["closed"])
        self.assertIsNone(info["welded"]["genus"])

    def test_reads_standard_input(self):
        model = (MODELS / "fan.ply").read_bytes()
        self.assertIn("820", self.vantage("info", "-", stdin=model).out)


class Help(ProgramTest):

    def test_every_command_explains_itself_with_an_example(self):
        out = self.vantage("--help").out
        listed = out[out.index("Subcommands:"):].split("\n\n")[0].splitlines()[1:]
        commands = [line.split()[0] for line in listed]
        self.assertEqual(commands, ["view", "skeleton", "map", "score", "compare", "eval", "measures", "render", "thumb",
                                    "info", "orient", "batch", "results", "serve", "figures", "completion"])
        commands.remove("results")
        for command in (*commands, *(f"results {verb}" for verb in ("query", "export", "diff", "merge"))):
            page = self.vantage(*command.split(), "--help").out
            self.assertIn("Examples:", page)
            self.assertIn(f"vantage {command}", page[page.index("Examples:"):])

    def test_version_names_the_program_and_its_libraries(self):
        out = self.vantage("--version").out
        self.assertRegex(out, r"vantage \d+\.\d+\.\d+")
        self.assertIn("Embree", out)


if __name__ == "__main__":
    unittest.main()
