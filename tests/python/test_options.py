# SPDX-License-Identifier: MIT
"""Every row of the table of options is a flag, a keyword, in the echo of results and in their hash."""

import functools
import inspect
import json
import math
import os
import re

import numpy as np
import pytest

from conftest import torus
import vantage

V, F = torus(8, 6)
CAMERA = vantage.Camera("perspective", np.array([0.0, 0.0, 9.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]))

# Flags that are no part of the method: files, how it runs, what is printed, moving pictures.
NO_OPTIONS = {"help", "help-all", "output", "force", "trace", "no-images", "no-report", "preview", "tour", "tour-seconds", "fps",
              "tour-size", "json", "quiet", "verbose", "config", "threads", "max-memory", "timeout",
              "depth", "max-faces", "strict", "levels", "meso", "measure", "visible", "method", "show", "direction",
              "directions", "eyes", "sphere", "view-set", "camera", "view",
              "seed"}  # of every command; the row of that name is the keyword
ROWS = vantage.options()
LOOKS = {row["flag"].removeprefix("--") for row in ROWS if row["group"] == "look"}  # of pictures, which render() makes
COMMANDS = {  # what offers which groups of the table
    "view": (vantage.best_view, {"method", "map", "saliency", "camera", "search", "set", "size"}),
    "skeleton": (vantage.skeleton, {"method"}),
    "map": (vantage.vertex_map, {"method", "map", "saliency", "camera"}),
    "score": (vantage.score, {"method", "map", "saliency", "camera"}),
    "render": (vantage.render, {"method", "map", "camera", "search", "size", "look"}),
}
NO_KEYWORDS = {"map": {"up", "front"}, "score": {"up", "front"}}  # flags that only "any" up makes a difference of
TEXTS = {"focus": "0", "epsilon": "2%", "prior": "none", "size": (40, 30), "background": "#102030"}
OF_PROGRAM = {("view", "size"): "auto", ("render", "size"): "800x600"}  # other defaults
WITH = {"base": {"search": "exhaustive"}, "subdivisions": {"search": "exhaustive"}, "epsilon": {"search": "rapid"}, "starts": {"search": "gradient"}, "seed": {"search": "gradient"}, "refine": {"views": 2},
        "min_separation": {"views": 2}, "information": {"select": "feixas", "views": 2}, "select": {"views": 2},
        "tour_path": {"views": 2}, **{row["name"]: {"method": "mesh-saliency"} for row in ROWS if row["group"] == "saliency"}}


def flags_of(help_text):
    """Of each flag in a command's help: kind (N, X, a word or choices), range and default, None where it has none."""
    pattern = r"^ +(?:-\w,)?--([\w-]+)(?:\{\w+\})?(?: (\S+))?(.*(?:\n {30}.*)*)"
    flags = {}
    for name, kind, rest in re.findall(pattern, help_text, re.MULTILINE):
        says = re.search(r"\((?:(\S+) to (\S+?))?(?:; )?(?:default: (.+))?\)$", re.sub(r"\s+", " ", rest).strip())
        flags[name] = (kind, *(says.groups() if says else (None, None, None)))
    return flags


def another(row):
    """A valid value that is not the default."""
    if row["choices"]:
        return next(word for word in row["choices"] if word != row["default"])
    if row["type"] == "bool":
        return not row["default"]
    if row["low"] is None:
        return TEXTS[row["name"]]
    for value in (row["low"], row["low"] + 1, row["high"]):  # of small numbers the fast ones
        if value not in (row["default"], 0):
            return int(value) if row["type"] == "int" else value
    raise AssertionError(row)


@pytest.mark.parametrize("command", COMMANDS)
def test_flags_are_the_rows_of_the_table(program, command):
    _, groups = COMMANDS[command]
    flags = flags_of(program(command, "--help-all").decode())
    rows = {row["flag"].removeprefix("--"): row for row in ROWS if row["group"] in groups and row["name"] != "seed"}
    assert len(rows) > 10
    assert flags.keys() - NO_OPTIONS - (LOOKS - rows.keys()) == rows.keys()
    for name, row in rows.items():
        kind, low, high, default = flags[name]
        if row["type"] == "bool":
            assert kind == "", name
            continue
        words = "|".join(row["choices"]).replace("auto", "any|auto") if name == "up" else "|".join(row["choices"])
        assert {"int": "N", "float": "X"}.get(row["type"], words or "TEXT") == kind, name
        assert (row["low"], row["high"]) == (low and float(low), high and float(high)), name
        if row["default"] is None:
            assert default is None, name
        elif row["low"] is not None:
            assert math.isclose(float(default), row["default"], rel_tol=1e-12), name
        else:
            assert default == OF_PROGRAM.get((command, name), row["default"]), name


@pytest.mark.parametrize("command", COMMANDS)
def test_keywords_are_the_rows_of_the_table(command):
    function, groups = COMMANDS[command]
    keywords = inspect.signature(function).parameters
    for row in ROWS:
        is_keyword = row["group"] in groups and row["name"] not in NO_KEYWORDS.get(command, ())
        assert (row["name"] in keywords) == is_keyword, row["name"]
        if is_keyword:
            assert row["help"].split()[0] in function.__doc__, row["name"]


@functools.cache
def result_with(**given):
    """What view.json says with these options and the quickest contraction."""
    return json.loads(vantage.best_view(V, F, **{"contraction": "exact", **given}).json)


def echoed(row, value):
    """As JSON has a value that Python gives."""
    return "x".join(map(str, value)) if isinstance(value, tuple) else value


@pytest.mark.parametrize("row", [row for row in ROWS if row["group"] != "look"], ids=lambda row: row["name"])
def test_results_name_each_option_and_their_hash_tells_it(row):
    given = WITH.get(row["name"], {})
    value = another(row)
    if row["name"] == "contraction":
        with_default, changed = result_with(contraction=row["default"]), result_with(contraction=value)
    else:
        with_default, changed = result_with(**given), result_with(**{**given, row["name"]: value})
    name = row["flag"].removeprefix("--").removeprefix("no-")
    assert changed["options"][name] == echoed(row, value)
    assert with_default["options"][name] != changed["options"][name]
    assert with_default["options_hash"] != changed["options_hash"]


@pytest.mark.parametrize("row", [row for row in ROWS if row["group"] == "look"], ids=lambda row: row["name"])
def test_pictures_name_how_they_look(program, tmp_path, models, row):
    value = another(row)
    flags = [row["flag"]] if row["type"] == "bool" else [row["flag"], str(value)]
    out = program("render", models / "fan.ply", "-o", tmp_path / "p.png", "--direction", "1,1,1", "--size", "16",
                  "--json", *flags)
    assert json.loads(out)["options"][row["flag"].removeprefix("--")] == value


def test_there_is_no_keyword_without_a_row():
    for function, _ in COMMANDS.values():
        names = {row["name"] for row in ROWS}
        own = {"model", "F", "progress", "threads", "method", "levels", "measure", "directions", "eyes", "sphere",
               "view_set", "direction", "camera", "view", "show", "colours"}
        assert inspect.signature(function).parameters.keys() - own <= names


def test_all_defaults_given_are_the_same_as_none():
    given = vantage.defaults()
    takes = inspect.signature(vantage.best_view).parameters
    keywords = {name: value for name, value in given.items() if name in takes}
    assert vantage.best_view(V, F, **keywords).json == vantage.best_view(V, F).json


def test_all_defaults_of_the_paper_are_its_preset():
    takes = inspect.signature(vantage.best_view).parameters
    keywords = {n: v for n, v in vantage.defaults("paper").items() if n in takes}
    assert vantage.best_view(V, F, **keywords).json == vantage.best_view(V, F, preset="paper").json


@pytest.mark.parametrize("keywords, message", [
    ({"weight": "areas"}, "must be one of vertex, area"),
    ({"fov": 500}, "option fov is 500 but must be between 1 and 170"),
    ({"fov": math.nan}, "option fov is nan"),
    ({"subdivisions": 9}, "between 0 and 8"),
    ({"distance": 1.0}, "option distance"),
    ({"epsilon": -1}, "must not be negative"),
    ({"epsilon": "much"}, "a number"),
    ({"size": (0, 5)}, "between 1 and 16384"),
    ({"size": "8x8x8"}, "option size must be"),
    ({"coverage": 0.0}, "must be above 0"),
    ({"select": "feixas"}, "say how many views"),
    ({"tour_path": "explore"}, "say how many views"),
    ({"select": "feixas", "views": 2, "coverage": 0.5}, "goes with select"),
    ({"method": "beauty"}, "beauty"),
    ({"focus": "nothing"}, "nothing"),
    ({"seed": 2**64}, "option seed must be between 0 and 18446744073709551615"),
    ({"seed": -10**400}, "option seed must be between 0 and 18446744073709551615"),
    ({"seed": -1}, "option seed is -1 but must be between 0 and 18446744073709551615$"),
    ({"threads": 2**40}, "threads is 1099511627776 but must be between 0 and 1024"),
    ({"method": "viewpoint-entropy", "views": 3}, "leave out views and coverage, or method viewpoint-entropy$"),
])
def test_values_out_of_range_are_refused_with_a_sentence(keywords, message):
    with pytest.raises(vantage.InvalidInput, match=message):
        vantage.best_view(V, F, **keywords)


@pytest.mark.parametrize("keywords", [{"fov": "wide"}, {"max_steps": 2.5}, {"prune": 1},
                                      {"weight": 3}, {"weigth": "area"}, {"fov": True}, {"fov": np.bool_(True)},
                                      {"max_steps": True}, {"epsilon": True}, {"threads": True}])
def test_values_of_another_type_are_refused(keywords):
    with pytest.raises(TypeError, match=next(iter(keywords))):
        vantage.best_view(V, F, **keywords)


def test_a_prior_may_be_a_file(tmp_path, cat):
    file = tmp_path / "down.json"
    file.write_text('{"vantage_prior": 1, "lobes": '
                    '[{"direction": [0, -1, 0], "weight": 1e6, "width_deg": 5}]}')
    assert vantage.best_view(cat, prior=file, up="y").best.direction[1] < -0.9
    with pytest.raises(vantage.IoError, match="missing.json"):
        vantage.best_view(cat, prior=tmp_path / "missing.json")


@pytest.mark.parametrize("options, message", [
    ({"search": "global", "epsilon": 1}, "option epsilon goes with search rapid only"),
    ({"subdivisions": 5}, "option subdivisions goes with search rapid and exhaustive only"),
    ({"starts": 3}, "option starts goes with search gradient only"),
    ({"seed": 3}, "option seed goes with search gradient only"),
    ({"projection": "orthographic", "fov": 60}, "option fov goes with projection perspective only"),
    ({"objective": "significance", "prior": "upright"}, "option prior says what is maximised"),
    ({"level_agreement": 0.5, "fit": False}, "option level_agreement compares two fitted curves"),
    ({"up": "y", "front": "-y"}, "option front is along the axis of up"),
])
def test_options_that_contradict_each_other_are_refused_as_by_the_program(options, message):
    with pytest.raises(vantage.InvalidInput, match=message):
        vantage.best_view(V, F, **options)


@pytest.mark.parametrize("function, keywords, message", [
    (vantage.render, {"direction": (0, 0, 1), "search": "dense"}, "option search goes with view only"),
    (vantage.render, {"direction": (0, 0, 1), "weight": "area"}, "option weight goes with view, show kssm and"),
    (vantage.render, {"certify": True}, "option certify has no effect on a picture"),
    (vantage.render, {"camera": CAMERA, "fov": 90}, "option fov says what camera says: leave one out"),
    (vantage.render, {"direction": (0, 0, 1), "show": "kssm", "colours": np.zeros((48, 3), np.uint8)},
     "colours goes with show plain only"),
    (vantage.best_view, {"saliency_scale": 0.01}, "option saliency_scale goes with method mesh-saliency only"),
    (vantage.vertex_map, {"method": "thickness", "suppression": "mean", "weight": "area"}, "goes with method kssm only: "),
    (vantage.vertex_map, {"fov": 60}, "option fov goes with method pmi-saliency only"),
    (vantage.score, {"eyes": (0, 0, 9), "fov": 60}, "option fov goes with sphere and directions: eyes says where eyes are"),
    (vantage.score, {"sphere": 0, "view_set": 2}, "view_set goes with measures that are built on a set of views only"),
    (vantage.score, {"sphere": 0, "method": "viewpoint-entropy", "prune": False}, "option prune goes with methods of the"),
    (vantage.visible_vertices, {"eyes": (0, 0, 9), "distance": 4}, "option distance goes with sphere and directions"),
])
def test_options_that_would_do_nothing_are_refused_as_by_the_program(function, keywords, message):
    with pytest.raises(vantage.InvalidInput, match=message):
        function(V, F, **keywords)


def test_defaults_may_be_given_where_they_do_nothing():
    assert vantage.render(V, F, direction=(0, 0, 1), search="global", weight="vertex", size=8).shape == (8, 8, 4)


def test_a_model_of_more_faces_than_allowed_is_refused_by_the_keyword(models):
    with pytest.raises(vantage.Error, match="the most that max_faces allows"):
        vantage.load(models / "fan.ply", max_faces=3)
    with pytest.raises(vantage.InvalidInput, match="max_faces is -1 but must be between 0"):
        vantage.load(models / "fan.ply", max_faces=-1)
    path = os.fsencode(models / "fan.ply")
    assert np.array_equal(vantage.visible_vertices(path, sphere=0),
                          vantage.visible_vertices(vantage.load(path, threads=None, max_faces=None), sphere=0))


def test_a_switch_takes_the_booleans_of_numpy():
    assert result_with(certify=np.bool_(True)) == result_with(certify=True)


def test_up_any_is_in_no_documentation():
    row = next(row for row in ROWS if row["name"] == "up")
    assert "any" not in row["choices"] and "any" not in row["type"] and "any" not in row["help"]
    assert row["help"].endswith("y otherwise") and "any" not in vantage.best_view.__doc__.partition("up:")[2].partition("\n    front:")[0]


def test_up_any_is_refused_of_an_analysis_too():
    with pytest.raises(vantage.InvalidInput, match="option up: any"):
        vantage.best_view(vantage.analyse(V, F), up="any")


@pytest.mark.parametrize("call, message", [
    (lambda: vantage.best_view(V, F, method=3), "method must be str"),
    (lambda: vantage.vertex_map(V, F, method=3), "method must be str"),
    (lambda: vantage.score(V, F, sphere=0, method=3), "method must be str or a list of them"),
    (lambda: vantage.score(V, F, sphere=0, method=["vmi", 3]), "method must be str"),
    (lambda: vantage.kssm(V, F, levels="x"), "levels must be bool"),
    (lambda: vantage.skeleton(V, F, measure=1), "measure must be bool"),
    (lambda: vantage.render(V, F, show=4), "show must be str"),
    (lambda: vantage.render(V, F, view=4), "view must be str"),
    (lambda: vantage.render(V, F, size=True), "option size must be tuple[int, int] | int | str"),
    (lambda: vantage.render(V, F, size=(1.5, 2)), "option size must be tuple[int, int] | int | str"),
    (lambda: vantage.render(V, F, focus=2.5), "option focus must be str | int"),
    (lambda: vantage.best_view(V, F, epsilon=[2]), "option epsilon must be float | str"),
    (lambda: vantage.directions(1.0), "level must be a whole number"),
    (lambda: vantage.directions(True), "level must be a whole number"),
    (lambda: vantage.best_view(V, F, fov=True), "option fov must be float"),
    (lambda: vantage.score(V, F, sphere=0, up="z"), "score() got an unexpected keyword argument 'up'"),
    (lambda: vantage.vertex_map(V, F, front="x"), "vertex_map() got an unexpected keyword argument 'front'"),
    (lambda: vantage.visible_vertices(V, F, sphere=0, up="z"), "visible_vertices() got an unexpected keyword argument 'up'"),
    (lambda: vantage.directions(1, 2), "base must be str"),
    (lambda: vantage.Model(V, F, name=3), "name must be str"),
    (lambda: vantage.defaults(3), 'option preset must be Literal["default", "paper"]'),
])
def test_messages_about_types_are_one_sentence(call, message):
    with pytest.raises(TypeError) as caught:
        call()
    assert str(caught.value) == message


def test_none_is_as_not_given_for_every_keyword():
    none = dict.fromkeys(set(inspect.signature(vantage.best_view).parameters) - {"model", "F"})
    assert vantage.best_view(V, F, **none).json == vantage.best_view(V, F).json
    assert vantage.kssm(V, F, levels=None, threads=None).displacement is None
    assert vantage.score(V, F, sphere=0, method=None, view_set=None).shape == (12,)
    assert vantage.render(V, F, direction=(0, 0, 1), show=None, size=8).shape == (8, 8, 4)
    assert vantage.Model(V, F, name=None).name == "arrays" and vantage.defaults(None) == vantage.defaults()


def test_other_types_are_type_errors():
    with pytest.raises(TypeError, match="sphere must be a whole number"):
        vantage.score(V, F, sphere="3")
    with pytest.raises(TypeError, match="camera must be a vantage.Camera"):
        vantage.render(V, F, camera=42)


def test_warnings_are_those_of_view_json(tmp_path):
    path = tmp_path / "surplus.ply"  # rows of one number more than the header says, which the reader notes
    path.write_text("ply\nformat ascii 1.0\n"
                    f"element vertex {len(V)}\nproperty float x\nproperty float y\nproperty float z\n"
                    f"element face {len(F)}\nproperty list uchar int vertex_indices\nend_header\n"
                    + "".join("%r %r %r 1\n" % tuple(map(float, p)) for p in V)
                    + "".join("3 %d %d %d\n" % tuple(f) for f in F))
    result = vantage.best_view(path)
    assert any("its rows hold" in note for note in result.warnings)
    of_program = json.loads(result.json)["warnings"]
    assert any("; --up z takes it" in text for text in of_program)
    assert list(result.warnings) == [text.replace("--up z", 'up="z"') for text in of_program]


def test_warnings_name_keywords_that_can_be_given(cat):
    result = vantage.best_view(cat)
    assert any('front="z" shows that side' in text for text in result.warnings), result.warnings
    assert not any("--" in text for text in result.warnings)


def test_a_set_of_directions_is_taken_as_its_directions():
    sphere = vantage.directions(0)
    assert (vantage.score(V, F, directions=sphere) == vantage.score(V, F, directions=sphere.directions)).all()
    assert vantage.visible_vertices(V, F, directions=sphere).shape == (12, len(V))


def test_models_and_analyses_say_what_they_are():
    assert repr(vantage.Model(V, F, name="ring")) == f"Model('ring', {len(V)} vertices, {len(F)} faces)"
    assert repr(vantage.analyse(V, F)) == f"Analysis of 'arrays', {len(V)} vertices, {len(F)} faces"
