#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the measures on real meshes: identities, similarity. Prints tables in Markdown.

    scripts/check_measures.py FOLDER [--vantage PROGRAM] [--models N] [--page docs/lab/YYYY-MM-measures.md]

FOLDER holds closed meshes (.off .obj .ply .stl .glb), of which the N smallest are taken. Identities are of
the 642 views of the set; similarity moves,
turns and scales the model and its views together, and moves every vertex at random by 1e-15 diameters. Exits
with 1 if an identity is off by more than 1e-9 or is no number, or if the folder holds no mesh.
"""

import argparse
import csv
import io
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

IDENTITY_BAR = 1e-9
BEGIN, END = "<!-- check_measures begins -->\n", "<!-- check_measures ends -->"
SUFFIXES = {".off", ".obj", ".ply", ".stl", ".glb"}
SALIENCY_SCALE = 0.003  # the default of --saliency-scale
SAME_SCALE = "turned, mesh-saliency's scale kept"
# A fifth of a turn about a corner of the icosahedron carries the set of views into itself.
PHI = (1 + 5**0.5) / 2
AXIS = np.array([0.0, 1.0, PHI]) / np.hypot(1.0, PHI)


def rotation(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


class Program:
    def __init__(self, path):
        self.path = path

    def scores(self, model, methods, *arguments):
        """Directions and, for each method, its values; null is infinity."""
        done = subprocess.run([self.path, "score", str(model), "--method", methods, *map(str, arguments)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr.strip())
        directions, values = {}, {}
        for row in csv.DictReader(io.StringIO(done.stdout)):
            name = row["method"]
            directions.setdefault(name, []).append([float(row[k]) for k in ("dx", "dy", "dz")])
            values.setdefault(name, []).append(math.inf if row["score"] == "null" else float(row["score"]))
        first = next(iter(directions.values()))
        return np.array(first), {k: np.array(v) for k, v in values.items()}

    def names(self):
        listed = json.loads(subprocess.run([self.path, "measures", "--json"], capture_output=True,
                                           text=True, check=True).stdout)
        return [m["name"] for m in listed]


def identities(program, models):
    methods = "vmi,i2,i3,viewpoint-entropy,instability,projected-area,visible-triangles"
    lines = ["| model | i2 + entropy = H(Z) | Σ p vmi = Σ p i2 | Σ p i2 = Σ p i3 | vmi ≥ 0 | "
             "entropy ≤ log faces | JS in [0, 1] |", "| --- | --- | --- | --- | --- | --- | --- |"]
    worst = 0.0
    for model in models:
        _, s = program.scores(model, methods, "--sphere", 3)
        p = s["projected-area"] / s["projected-area"].sum()
        total = s["i2"] + s["viewpoint-entropy"]
        means = {name: float(p @ s[name]) for name in ("vmi", "i2", "i3")}
        errors = [float(np.ptp(total)), abs(means["vmi"] - means["i2"]), abs(means["i2"] - means["i3"])]
        worst = float(np.max([worst, *errors]))  # max() would pass over a NaN
        holds = [s["vmi"].min() >= 0, np.all(s["viewpoint-entropy"] <= np.log2(s["visible-triangles"]) + 1e-12),
                 s["instability"].min() >= 0 and s["instability"].max() <= 1]
        worst = worst if all(holds) else math.inf
        lines.append(f"| {model.stem} | " + " | ".join(f"{e:.1e}" for e in errors) + " | " +
                     " | ".join("yes" if h else "NO" for h in holds) + " |")
    return lines, worst


def write_off(path, positions, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(positions)} {len(faces)} 0\n")
        file.writelines(" ".join(repr(float(x)) for x in p) + "\n" for p in positions)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in faces)


def read_off(path):
    words = path.read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    positions = np.array(numbers[:3 * vertices], float).reshape(-1, 3)
    rest = np.array(numbers[3 * vertices:3 * vertices + 4 * faces], int).reshape(-1, 4)
    assert np.all(rest[:, 0] == 3), "triangles only"
    return positions, rest[:, 1:]


def similarity(program, models, folder):
    """Largest change over the range where model and views are turned, moved and scaled together."""
    turn = rotation(AXIS, 2 * math.pi / 5)
    random = np.random.default_rng(1)
    changes = {"scaled by 1e-8": {}, "scaled by 1e8": {}, "moved by 10 diameters": {},
               "turned by 72°": {}, SAME_SCALE: {}, "each vertex by 1e-15": {}}
    for model in models:
        positions, faces = read_off(model)
        span = np.linalg.norm(np.ptp(positions, axis=0))
        moved = {"scaled by 1e-8": positions * 1e-8, "scaled by 1e8": positions * 1e8,
                 "moved by 10 diameters": positions + 10 * span * np.array([1.0, -2.0, 0.5]),
                 "turned by 72°": positions @ turn.T, SAME_SCALE: positions @ turn.T,
                 "each vertex by 1e-15": positions + 1e-15 * span * random.uniform(-1, 1, positions.shape)}
        directions, here = program.scores(model, "all", "--sphere", 2, "--view-set", 2)
        for what, there in moved.items():
            write_off(folder / "moved.off", there, faces)
            turned = directions @ turn.T if what.startswith("turned") else directions
            table = folder / "views.csv"
            table.write_text("dx,dy,dz\n" + "".join(",".join(map(repr, map(float, d))) + "\n" for d in turned))
            # Mesh saliency's scale is a share of the box's diagonal, which turning changes.
            longer = np.linalg.norm(np.ptp(there, axis=0)) / np.linalg.norm(np.ptp(positions, axis=0))
            scale = ["--saliency-scale", SALIENCY_SCALE / longer] if what == SAME_SCALE else []
            _, values = program.scores(folder / "moved.off", "all", "--directions", table, "--view-set", 2,
                                       *scale)
            for name, v in values.items():
                span_of = max(np.ptp(here[name]), 1e-300)
                change = float(np.max(np.abs(v - here[name])) / span_of)
                changes[what][name] = float(np.max([change, changes[what].get(name, 0.0)]))
    names = list(next(iter(changes.values())))
    lines = ["| measure | " + " | ".join(changes) + " |", "| --- |" + " --- |" * len(changes)]
    for name in names:
        lines.append(f"| `{name}` | " + " | ".join(f"{100 * changes[w][name]:.2g} %" for w in changes) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--vantage", default="build/release/apps/vantage/vantage")
    parser.add_argument("--models", type=int, default=20)
    parser.add_argument("--moved", type=int, default=2, help="models of the similarity table")
    parser.add_argument("--page", type=Path, help="also put the tables into this page, between its marks")
    options = parser.parse_args()
    program = Program(options.vantage)
    models = sorted((p for p in options.folder.glob("*") if p.suffix in SUFFIXES),
                    key=lambda p: (p.stat().st_size, p.name))[:options.models]
    if not models:
        sys.exit(f"{options.folder}: holds no mesh to check")
    moved = [m for m in models if m.suffix == ".off"][:options.moved]
    text, worst = identities(program, models)
    lines = [f"### Identities on {len(models)} real meshes", "", *text, "",
             f"The largest difference is {worst:.1e} bits; the bar is {IDENTITY_BAR:.0e}.", "",
             "### Similarity: largest change over the range, of " + ", ".join(m.stem for m in moved), ""]
    with tempfile.TemporaryDirectory() as folder:
        lines += similarity(program, moved, Path(folder))
    tables = "\n".join(lines) + "\n"
    print(tables)
    if options.page:
        page = options.page.read_text()
        options.page.write_text(page[:page.index(BEGIN) + len(BEGIN)] + tables + page[page.index(END):])
    sys.exit(0 if worst <= IDENTITY_BAR else 1)


if __name__ == "__main__":
    main()
