# SPDX-License-Identifier: MIT
"""The package gives what the program writes, to the last bit."""

import csv
import io
import json

import numpy as np
import pytest

from png import read_png
from program import read_ply

from conftest import torus
import vantage

EXACT = ["--contraction", "exact"]  # where it does not matter what a refined surface has otherwise


@pytest.mark.parametrize("flags, keywords", [
    ([], {}),
    (["--preset", "paper"], {"preset": "paper"}),
    (["--weight", "area", "--search", "exhaustive", "--subdivisions", "1", "--prior", "none", *EXACT],
     {"weight": "area", "search": "exhaustive", "subdivisions": 1, "prior": "none", "contraction": "exact"}),
    (["--views", "3", "--min-separation", "20", "--up", "-z", "--fov", "45", *EXACT],
     {"views": 3, "min_separation": 20, "up": "-z", "fov": 45, "contraction": "exact"}),
    (["--no-prune", "--no-centre", "--contraction", "exact", "--suppression", "local-maxima",
      "--kinematics", "velocity", "--graph", "finished", "--projection", "orthographic",
      "--search", "rapid", "--epsilon", "1%", "--size", "300x200"],
     {"prune": False, "centre": False, "contraction": "exact", "suppression": "local-maxima",
      "kinematics": "velocity", "graph": "finished", "projection": "orthographic",
      "search": "rapid", "epsilon": "1%", "size": (300, 200)}),
])
def test_best_view_is_view_json(program, tmp_path, models, flags, keywords):
    model = models / "cat_lowpoly.ply"
    size = [] if "--size" in flags else ["--size", "800x600"]  # what Python begins with
    program("view", model, "-o", "out", "--no-images", *flags, *size)
    assert vantage.best_view(model, **keywords).json == (tmp_path / "out/view.json").read_text()


def test_a_sidecar_beside_a_path_is_obeyed_and_keywords_come_first(program, tmp_path, models):
    model = tmp_path / "cat.ply"
    model.write_bytes((models / "cat_lowpoly.ply").read_bytes())
    (tmp_path / "cat.vantage.json").write_text('{"up": "z", "front": "-y", "view": [1, -1, 0.5]}')
    program("view", model, "-o", "out", "--no-images", "--size", "800x600", *EXACT)
    written = (tmp_path / "out/view.json").read_text()
    assert json.loads(written)["up"] == "z"
    assert vantage.best_view(model, contraction="exact").json == written
    assert json.loads(vantage.best_view(model, up="-y", contraction="exact").json)["up"] == "-y"
    quick = {"contraction": "exact", "search": "rapid"}
    assert json.loads(vantage.best_view(model, up="auto", front="auto", **quick).json)["up"] == "y"
    assert json.loads(vantage.best_view(model, up=None, **quick).json)["up"] == "z"


def test_up_any_is_refused_for_arrays_stay_where_they_are(models):
    with pytest.raises(vantage.InvalidInput, match="vantage orient MODEL --up=any -o OUT"):
        vantage.best_view(models / "cat_lowpoly.ply", up="any")


def test_arrays_and_another_method_give_what_a_file_does(program, tmp_path):
    V, F = torus(8, 6, bump=0.1)
    lines = ["OFF", f"{len(V)} {len(F)} 0", *(" ".join(map(repr, p)) for p in V.tolist()),
             *("3 " + " ".join(map(str, f)) for f in F.tolist())]
    (tmp_path / "torus.off").write_text("\n".join(lines) + "\n")
    program("view", "torus.off", "-o", "out", "--no-images", "--method", "mesh-saliency", "--size", "800x600")
    written = json.loads((tmp_path / "out/view.json").read_text())
    ours = json.loads(vantage.best_view(V, F, method="mesh-saliency").json)
    by_analysis = json.loads(vantage.best_view(vantage.analyse(V, F), method="mesh-saliency").json)
    assert by_analysis["best"]["direction"] == ours["best"]["direction"]
    assert by_analysis["total"] == ours["total"]
    ours["model"]["name"], ours["model"]["format"] = "torus", "off"
    assert ours == written


def test_fields_of_the_result_are_those_of_view_json(models):
    result = vantage.best_view(models / "cat_lowpoly.ply", views=2, contraction="exact")
    written = json.loads(result.json)
    assert result.best.direction.tolist() == written["best"]["direction"]
    assert result.best.score == written["best"]["score"]
    assert result.worst.eye.tolist() == written["worst"]["eye"]
    assert result.total == written["total"]
    assert result.best.camera.fov_y_deg == written["best"]["frame"]["fov_y_deg"]
    assert list(result.best.size) == written["best"]["size"]
    assert [v.coverage for v in result.views] == [v["coverage"] for v in written["views"]]


def test_skeleton_is_skeleton_json(program, tmp_path, fan, models):
    program("skeleton", models / "fan.ply", "-o", "fan.json")
    written = json.loads((tmp_path / "fan.json").read_text())
    ours = vantage.skeleton(fan)
    assert ours.nodes.tolist() == written["nodes"]
    assert ours.edges.tolist() == written["edges"]
    assert ours.radius.tolist() == written["radius"]
    assert ours.vertex_node.tolist() == written["vertex_node"]
    assert [b.tolist() for b in ours.branches] == written["branches"]


def test_kssm_is_the_quality_of_map_ply(program, tmp_path, cat, models):
    program("map", models / "cat_lowpoly.ply", "-o", "map.ply")
    _, rows, _ = read_ply(tmp_path / "map.ply")
    written = np.array([row["quality"] for row in rows], dtype=np.float32)
    assert np.array_equal(vantage.kssm(cat).of_vertex.astype(np.float32), written)


def test_kssm_and_visible_vertices_are_those_of_the_visible_table(program, tmp_path, cat, models):
    program("score", models / "cat_lowpoly.ply", "--sphere", "1", "--visible", "seen.npy",
            "-o", "scores.csv", *EXACT)
    table = np.load(tmp_path / "seen.npy")
    seen = np.unpackbits(table["seen"], axis=1, bitorder="little")[:, :42].T.astype(bool)
    assert np.array_equal(vantage.kssm(cat, contraction="exact").of_vertex, table["significance"])
    assert np.array_equal(vantage.visible_vertices(cat, sphere=1), seen)


def score_column(text):
    """The last column of a table of scores, one list a method."""
    methods = {}
    for row in csv.DictReader(io.StringIO(text.decode())):
        methods.setdefault(row["method"], []).append(float(row["score"]))
    return methods


def test_scores_are_those_of_the_table(program, cat, models):
    printed = score_column(program("score", models / "cat_lowpoly.ply", "--sphere", "2"))
    assert vantage.score(cat, sphere=2).tolist() == printed["kssm"]


def test_scores_of_several_methods_are_those_of_the_table(program, cat, models):
    names = ["silhouette-length", "viewpoint-entropy", "vmi"]
    printed = score_column(program("score", models / "cat_lowpoly.ply", "--sphere", "0",
                                   "--view-set", "1", "--method", ",".join(names)))
    ours = vantage.score(cat, sphere=0, method=names, view_set=1)
    assert [row.tolist() for row in ours] == [printed[name] for name in names]


def test_scores_from_eyes_are_those_of_the_table(program, tmp_path, cat, models):
    eyes = cat.vertices.mean(axis=0) + [[0.0, 0.0, 3.0], [2.0, 1.0, -1.0]]
    rows = ["x,y,z", *(",".join(map(repr, eye)) for eye in eyes.tolist())]
    (tmp_path / "eyes.csv").write_text("\n".join(rows) + "\n")
    printed = score_column(program("score", models / "cat_lowpoly.ply", "--eyes", "eyes.csv", *EXACT))
    assert vantage.score(cat, eyes=eyes, contraction="exact").tolist() == printed["kssm"]


@pytest.mark.parametrize("flags, keywords", [
    (["--direction", "1,0.5,1"], {"direction": (1, 0.5, 1)}),
    (["--direction", "0,0,-2", "--style", "technical", "--background", "gradient", "--ground"],
     {"direction": (0, 0, -2), "style": "technical", "background": "gradient", "ground": True}),
    (["--view", "worst", "--show", "kssm", "--margin", "10", "--crease", "0"],
     {"view": "worst", "show": "kssm", "margin": 10, "crease": 0}),
    (["--view", "best", "--show", "skeleton", "--background", "white:#102030", *EXACT],
     {"show": "skeleton", "background": "white:#102030", "contraction": "exact"}),
])
def test_pictures_are_those_of_the_program(program, tmp_path, cat, models, flags, keywords):
    size = ["--size", "40x30", "--quality", "draft"]
    program("render", models / "cat_lowpoly.ply", "-o", "cat.png", *size, *flags)
    width, height, rows = read_png((tmp_path / "cat.png").read_bytes())
    written = np.frombuffer(b"".join(rows), np.uint8).reshape(height, width, 4)
    assert np.array_equal(vantage.render(cat, size=(40, 30), quality="draft", **keywords), written)


def test_pictures_of_files_are_in_their_own_materials_as_the_programs(program, tmp_path):
    (tmp_path / "flag.obj").write_text("mtllib flag.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n")
    (tmp_path / "flag.mtl").write_text("newmtl red\nKd 0.9 0.05 0.05\n")
    program("render", tmp_path / "flag.obj", "-o", "flag.png", "--size", "40x30", "--quality", "draft", "--direction", "0,0,1")
    width, height, rows = read_png((tmp_path / "flag.png").read_bytes())
    written = np.frombuffer(b"".join(rows), np.uint8).reshape(height, width, 4)
    drawn = {style: vantage.render(tmp_path / "flag.obj", size=(40, 30), quality="draft", direction=(0, 0, 1), **style_of)
             for style, style_of in (("none", {}), ("clay", {"style": "clay"}))}
    assert np.array_equal(drawn["none"], written)
    red, green, _, alpha = drawn["none"][15, 20]
    assert alpha == 255 and red > 2 * int(green)
    assert not np.array_equal(drawn["clay"], written)


def test_measures_are_those_that_the_program_lists(program):
    listed = json.loads(program("measures", "--json"))
    rows = listed if isinstance(listed, list) else listed["measures"]
    assert [(m.name, m.alias) for m in vantage.measures()] == [(row["name"], row["alias"]) for row in rows]
