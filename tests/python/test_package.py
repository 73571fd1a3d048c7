# SPDX-License-Identifier: MIT
"""Stubs, wheel, cookbook and example."""

import base64
import csv
import hashlib
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import zipfile

import pytest

from conftest import ROOT
import vantage

PACKAGE = pathlib.Path(vantage.__file__).parent

USER = '''
import numpy as np
import vantage

V, F = np.zeros((3, 3)), np.zeros((1, 3), np.int64)
result = vantage.best_view(V, F, weight="area", progress=lambda stage, fraction: None)
score: float = result.best.score
column: float = float(vantage.kssm("model.ply").of_vertex[0])
nodes: int = vantage.skeleton(vantage.load("model.ply"), prune=False).nodes.shape[0]
'''


def has(module):
    return importlib.util.find_spec(module) is not None


def test_stubs_are_those_that_the_table_makes():
    script = ROOT / "scripts/write_python_stubs.py"
    made = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    assert made.stdout == (ROOT / "python/vantage/functions.pyi").read_text()


@pytest.mark.skipif(not has("mypy"), reason="NOTHING WAS TESTED: mypy is not installed")
def test_type_checker_takes_a_users_program_and_refuses_a_wrong_one(tmp_path):
    wrong = ["vantage.kssm(V, F, fov=3)", 'vantage.kssm(V, F, weight="areas")',
             "vantage.kssm(V, F, levels=1)"]
    (tmp_path / "user.py").write_text(USER + "\n".join(wrong) + "\n")
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull,
                           "--no-error-summary", "--hide-error-context", "user.py"], cwd=tmp_path,
                          env={**os.environ, "MYPYPATH": str(PACKAGE.parent)},
                          capture_output=True, text=True, check=False)
    lines = [int(number) for number in re.findall(r"^user.py:(\d+): error", done.stdout, re.MULTILINE)]
    first = USER.count("\n") + 1
    assert sorted(set(lines)) == [first, first + 1, first + 2], done.stdout


@pytest.mark.skipif(not has("mypy"), reason="NOTHING WAS TESTED: mypy is not installed")
def test_stubs_agree_with_the_package(tmp_path):
    # What pybind11 makes of a class, and what mypy 1.0 makes of typing.Mapping.
    (tmp_path / "allowed").write_text("vantage._core.Model\nvantage._core.Analysis(.__init__)?\n"
                                      ".*\\.Mapping\n")
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "vantage", "--allowlist",
                           "allowed", "--ignore-unused-allowlist"], cwd=tmp_path,
                          env={**os.environ, "MYPYPATH": str(PACKAGE.parent)},
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("thing", [vantage, *(getattr(vantage, name) for name in vantage.__all__ if name != "__version__")],
                         ids=lambda thing: thing.__name__)
def test_all_that_is_public_says_what_it_is(thing):
    assert len(thing.__doc__) > 15
    if thing in (vantage.Model, vantage.Analysis):
        members = [member for name, member in vars(thing).items() if not name.startswith("_")]
        assert len(members) >= 7
        assert all(len(member.__doc__) > 10 for member in members), [m for m in members if not m.__doc__]


def make_wheel(folder):
    """The path of a new wheel."""
    folder.mkdir()
    done = subprocess.run(
        [sys.executable, ROOT / "python/make_wheel.py", PACKAGE, folder, "--version",
         vantage.__version__, "--summary", "A test", "--licence", ROOT / "LICENSE",
         "--notices", ROOT / "THIRD_PARTY.md"], capture_output=True, text=True, check=True)
    return pathlib.Path(done.stdout.strip())


def test_wheel_has_the_same_bytes_twice_and_a_true_record(tmp_path):
    first, second = make_wheel(tmp_path / "a"), make_wheel(tmp_path / "b")
    assert first.name == second.name and first.read_bytes() == second.read_bytes()
    with zipfile.ZipFile(first) as wheel:
        record = [n for n in wheel.namelist() if n.endswith("/RECORD")][0]
        rows = list(csv.reader(wheel.read(record).decode().splitlines()))
        assert sorted(row[0] for row in rows) == sorted(wheel.namelist())
        for name, digest, size in rows:
            if name != record:
                sha = hashlib.sha256(wheel.read(name)).digest()
                wanted = "sha256=" + base64.urlsafe_b64encode(sha).rstrip(b"=").decode()
                assert (digest, int(size)) == (wanted, len(wheel.read(name)))


@pytest.mark.skipif(not has("pip"), reason="NOTHING WAS TESTED: pip is not installed")
def test_wheel_installs_without_network_and_runs(tmp_path):
    wheel, target = make_wheel(tmp_path / "wheel"), tmp_path / "site"
    subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet",
                    "--target", target, wheel], check=True, capture_output=True,
                   env={**os.environ, "PIP_ROOT_USER_ACTION": "ignore"})
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-c", "import vantage; print(vantage.__file__);"
         f"print(vantage.load({str(ROOT / 'models/fan.ply')!r}).vertices.shape)"],
        env={**environment, "PYTHONPATH": str(target)}, capture_output=True, text=True, check=True)
    assert done.stdout == f"{target}/vantage/__init__.py\n(820, 3)\n"


def test_the_cookbook_runs(tmp_path, models):
    text = "".join((ROOT / page).read_text() for page in ("README.md", "docs/python.md"))
    blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 9
    names = {}
    before = os.getcwd()
    for name in ("horse.ply", "deer.ply"):
        (tmp_path / name).symlink_to(models / "cat_lowpoly.ply")
    os.chdir(tmp_path)
    try:
        for block in blocks:
            if "matplotlib" in block and not has("matplotlib"):
                continue
            exec(compile(block, "a page", "exec"), names)  # the pages are ours
    finally:
        os.chdir(before)


@pytest.mark.skipif(not has("matplotlib"), reason="NOTHING WAS TESTED: matplotlib is not installed")
def test_the_example_makes_its_figure(tmp_path, models):
    subprocess.run([sys.executable, ROOT / "examples/python/shape_sheet.py",
                    models / "cat_lowpoly.ply", tmp_path / "sheet.png"], check=True,
                   env={**os.environ, "MPLCONFIGDIR": str(tmp_path), "MPLBACKEND": "Agg"})
    assert (tmp_path / "sheet.png").read_bytes().startswith(b"\x89PNG")
