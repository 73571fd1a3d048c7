#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks for values that are no numbers in what the program says of broken models and of blind views.

    scripts/check_finite.py FOLDER [--vantage PROGRAM] [--seconds S] [--quick] [--page PAGE]

Every file below FOLDER whose format the program reads is scored by all measures: over the 42 views of
icosahedron level 1, and from eyes inside, far away and at odd places; and compared without pictures. Checked
are: how the program ends (done, or one sentence and exit code 1 or 3), that no file holds nan or inf in any
spelling, and that a value is null only where less is better and the view sees no face. Exits with 1 if a model
fails or there is none. With --quick there are 12 views instead of 42, and nothing is compared: for a whole collection.
"""

import argparse
import csv
import io
import json
import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

SUFFIXES = {".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".xyz", ".pcd", ".gz", ".drc", ".3mf", ".amf"}
EYES = [(0, 0, 0), (1e-3, 1e-3, 1e-3), (0.5, 0.5, 0.5), (1e3, -1e3, 10), (-1e12, 1e12, 1e12), (1e-300, 0, 0)]
BYTES = 8 << 30
BEGIN, END = "<!-- check_finite begins -->\n", "<!-- check_finite ends -->"


class Failure(Exception):
    pass


class Program:
    def __init__(self, path, seconds):
        self.path, self.seconds = path, seconds
        listed = json.loads(subprocess.run([path, "measures", "--json"], capture_output=True, text=True,
                                           check=True).stdout)
        self.falling = {m["name"] for m in listed if m["best"] == "min"}

    def run(self, *arguments):
        """Output, or None if the program refuses in a sentence."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        try:
            done = subprocess.run([self.path, *map(str, arguments)], capture_output=True, timeout=self.seconds,
                                  preexec_fn=limit, check=False)
        except subprocess.TimeoutExpired:
            raise Failure(f"{arguments[0]} takes more than {self.seconds} s") from None
        said = done.stderr.decode(errors="replace").strip()
        if done.returncode in (1, 3):
            if said.count("\n") > 0 or not said:
                raise Failure(f"{arguments[0]} refuses in {said.count(chr(10)) + 1} lines: {said[:200]}")
            return None
        if done.returncode != 0:
            raise Failure(f"{arguments[0]} ends with {done.returncode}: {said[:200]}")
        return done.stdout.decode()

    def check_scores(self, text):
        views = {}
        for row in csv.DictReader(io.StringIO(text)):
            place = tuple(v for k, v in row.items() if k not in ("method", "score"))
            if row["score"] != "null" and not math.isfinite(float(row["score"])):
                raise Failure(f"{row['method']} is {row['score']}")
            views.setdefault(place, {})[row["method"]] = row["score"]
        blind = 0
        for values in views.values():
            sees = float(values["visible-triangles"]) > 0
            blind += not sees
            wrong = [m for m, v in values.items() if v == "null" and (sees or m not in self.falling)]
            if wrong:
                raise Failure(f"{', '.join(wrong)}: no value for a view that sees faces")
        return len(views), blind


def refuse_nonfinite(text):
    raise Failure(f"compare.json holds {text}")


def check_comparison(program, model, results):
    if program.run("compare", model, "-o", results, "--no-images", "-q", "--method",
                   "kssm,mesh-saliency,vmi,skeleton-visibility,silhouette-entropy,depth-distribution") is None:
        raise Failure("compare refuses what score does not")
    json.loads((results / "compare.json").read_text(), parse_constant=refuse_nonfinite)
    for table in ("compare.csv", "agreement.csv", "sphere.csv"):
        for row in csv.reader(io.StringIO((results / table).read_text())):
            if any(cell.lower().lstrip("+-") in ("nan", "inf", "infinity") for cell in row):
                raise Failure(f"{table} holds {row}")


def check(program, model, folder, quick):
    """(views, blind views) of the model; None if it is refused."""
    level = 0 if quick else 1
    text = program.run("score", model, "--method", "all", "--sphere", level, "--view-set", level, "-q")
    if text is None:
        return None
    views, blind = program.check_scores(text)
    eyes = folder / "eyes.csv"
    eyes.write_text("x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, y, z in EYES))
    text = program.run("score", model, "--method", "all", "--eyes", eyes, "--view-set", 0, "-q")
    if text is None:
        raise Failure("eyes are refused where directions are not")
    more, dark = program.check_scores(text)
    if not quick:
        check_comparison(program, model, folder / "compared")
    return views + more, blind + dark


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--vantage", default="build/release/apps/vantage/vantage")
    parser.add_argument("--seconds", type=float, default=120.0, help="that one run may take")
    parser.add_argument("--part", default="0/1", help="K/N: every Nth file from the Kth on")
    parser.add_argument("--quick", action="store_true", help="12 views, and no comparison")
    parser.add_argument("--page", type=Path, help="also put the table into this page, between its marks")
    options = parser.parse_args()
    program = Program(options.vantage, options.seconds)
    files = sorted(p for p in options.folder.rglob("*") if p.is_file() and p.suffix.lower() in SUFFIXES)
    if not files:
        sys.exit(f"{options.folder}: holds no model to check")
    part, parts = map(int, options.part.split("/"))
    done, refused, views, blind, failures = 0, 0, 0, 0, []
    for model in files[part::parts]:
        with tempfile.TemporaryDirectory() as folder:
            try:
                found = check(program, model, Path(folder), options.quick)
            except Failure as failure:
                failures.append(f"{model.relative_to(options.folder)}: {failure}")
                print(failures[-1], file=sys.stderr, flush=True)
                continue
        if found is None:
            refused += 1
        else:
            done, views, blind = done + 1, views + found[0], blind + found[1]
    lines = ["| | |", "| --- | ---: |", f"| models measured | {done} |",
             f"| refused in a sentence | {refused} |", f"| views | {views} |",
             f"| of these blind | {blind} |", f"| models with a value that is no number | {len(failures)} |"]
    lines += [f"- {failure}" for failure in failures]
    table = "\n".join(lines) + "\n"
    print(table)
    if options.page:
        page = options.page.read_text()
        options.page.write_text(page[:page.index(BEGIN) + len(BEGIN)] + table + page[page.index(END):])
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
