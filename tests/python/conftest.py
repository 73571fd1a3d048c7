# SPDX-License-Identifier: MIT
"""What the tests of the Python package share: the program to compare with, models, small shapes."""

import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import vantage

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))  # readers of what the program writes


@pytest.fixture(scope="session", name="models")
def shipped_models():
    """The folder of models in the repository."""
    return ROOT / "models"


@pytest.fixture(scope="session", name="fan")
def loaded_fan(models):
    """820 vertices, several components."""
    return vantage.load(models / "fan.ply")


@pytest.fixture(scope="session", name="cat")
def loaded_cat(models):
    """641 vertices in one piece."""
    return vantage.load(models / "cat_lowpoly.ply")


@pytest.fixture(name="program")
def vantage_program(tmp_path):
    """Runs the program in a scratch folder and gives what it printed."""
    def run(*arguments):
        done = subprocess.run([os.environ["VANTAGE"], *map(str, arguments)], cwd=tmp_path,
                              capture_output=True, timeout=300, check=True)
        return done.stdout
    return run


def torus(rings=24, sides=12, bump=0.0):
    """V and F of a closed surface of genus 1; `bump` makes it uneven."""
    u = np.repeat(np.arange(rings), sides) * (2 * np.pi / rings)
    v = np.tile(np.arange(sides), rings) * (2 * np.pi / sides)
    tube = 0.35 + bump * np.cos(u)
    V = np.stack([(1 + tube * np.cos(v)) * np.cos(u), (1 + tube * np.cos(v)) * np.sin(u),
                  tube * np.sin(v)], axis=1)
    i = np.arange(rings * sides)
    right = (i + sides) % (rings * sides)
    up = i - i % sides + (i + 1) % sides
    across = right - right % sides + (right + 1) % sides
    return V, np.concatenate([np.stack([i, right, across], 1), np.stack([i, across, up], 1)])
