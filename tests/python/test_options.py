# SPDX-License-Identifier: MIT
"""Every option of the program's method is a keyword of the same name, range and default."""

import inspect
import math
import re

import pytest

from conftest import torus
import vantage

V, F = torus(8, 6)

# Flags that are no part of the method: files, how it runs, what is printed, moving pictures.
NOT_KEYWORDS = {"help", "output", "trace", "no-images", "no-report", "preview", "tour",
                "tour-seconds", "fps", "tour-size", "json", "quiet", "verbose", "config",
                "depth",  # arrays have 8 bits a channel
                "seed",  # every command has it, but only the gradient search draws
                "max-memory", "timeout",  # limits of a process; Python's own belongs to its user
                "levels",
                "meso"}
# Switches that turn something off are keywords that are on.
RENAMED = {"no-prune": "prune", "no-centre": "centre", "no-refine": "refine"}
FUNCTIONS = {"view": vantage.best_view, "skeleton": vantage.skeleton, "map": vantage.vertex_map,
             "score": vantage.score, "render": vantage.render}


def flags_of(help_text):
    """Name, kind (N, X, a word or choices) and default of each flag in a command's help; None where it has none."""
    pattern = r"^ +(?:-\w,)?--([\w-]+)(?:\{\w+\})?(?: (\S+))?(.*(?:\n {30}.*)*)"
    for name, kind, rest in re.findall(pattern, help_text, re.MULTILINE):
        default = re.search(r"\((?:\S+ to \S+; )?default: ([^)]+)\)$", re.sub(r"\s+", " ", rest).strip())
        yield name, kind, default.group(1).split(";")[0] if default else None


@pytest.mark.parametrize("command", FUNCTIONS)
def test_every_flag_is_a_keyword(program, command):
    keywords = inspect.signature(FUNCTIONS[command]).parameters
    flags = {name for name, _, _ in flags_of(program(command, "--help").decode())}
    assert len(flags) > 12
    missing = {flag for flag in flags - NOT_KEYWORDS
               if RENAMED.get(flag, flag).replace("-", "_") not in keywords
               and not (flag == "visible")}  # visible_vertices() is a function of its own
    assert not missing, f"add them to python/bindings/*_options.cpp: {sorted(missing)}"


@pytest.mark.parametrize("command", ["view", "render"])
def test_defaults_are_those_of_the_help(program, command):
    ours = vantage.defaults()
    compared = 0
    for name, kind, default in flags_of(program(command, "--help").decode()):
        keyword = name.replace("-", "_")
        if default is None or keyword not in ours or name in ("prior", "size"):
            continue
        value = ours[keyword]
        if kind in ("N", "X"):
            assert math.isclose(float(default), value, rel_tol=1e-12), name
        else:
            assert default == value, name
        compared += 1
    assert compared > 15
    assert (ours["prior"], ours["size"]) == ("upright", (800, 600))


def test_ranges_are_those_of_the_help(program):
    text = program("view", "--help").decode()
    rows = {row["name"]: row for row in vantage.options()}
    ranges = re.findall(r"--([\w-]+) [NX]\s[^()]*(?:\([^()]* [^()]*\)\s+)*?\((\S+) to ([^\s;)]+)", text)
    assert len(ranges) > 12
    for name, low, high in ranges:
        row = rows.get(name.replace("-", "_"))
        if row is not None:
            assert (row["low"], row["high"]) == (float(low), float(high)), name


def test_choices_are_those_of_the_help(program):
    text = program("view", "--help").decode() + program("render", "--help").decode()
    rows = {row["name"]: row for row in vantage.options()}
    listed = re.findall(r"--([\w-]+) (\w[\w-]*(?:\|[\w-]+)+)", text)
    assert len(listed) > 8
    for name, choices in listed:
        row = rows.get(name.replace("-", "_"))
        if row is not None:
            assert set(re.findall(r'"([^"]+)"', row["type"])) == set(choices.split("|")), name


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
    ({"fov": 500}, "option fov is 500 but must be between 1.0 and 170.0"),
    ({"fov": math.nan}, "option fov is nan"),
    ({"subdivisions": 9}, "between 0 and 8"),
    ({"distance": 1.0}, "option distance"),
    ({"epsilon": -1}, "must not be negative"),
    ({"epsilon": "much"}, "a number"),
    ({"size": (0, 5)}, "between 1 and 16384"),
    ({"size": "8x8x8"}, "option size must be"),
    ({"coverage": 0.0}, "must be above 0"),
    ({"select": "feixas"}, "say how many views"),
    ({"select": "feixas", "views": 2, "coverage": 0.5}, "go with select"),
    ({"method": "beauty"}, "beauty"),
    ({"focus": "nothing"}, "nothing"),
])
def test_values_out_of_range_are_refused_with_a_sentence(keywords, message):
    with pytest.raises(vantage.InvalidInput, match=message):
        vantage.best_view(V, F, **keywords)


@pytest.mark.parametrize("keywords", [{"fov": "wide"}, {"max_steps": 2.5}, {"prune": 1},
                                      {"weight": 3}, {"weigth": "area"}])
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
