#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks each claim of the paper on the paper's models and writes a page of docs/lab.

    scripts/paper_claims.py MODELS [--vantage PROGRAM] [-o docs/lab/YYYY-MM-paper-claims.md] [--only NAME …]

MODELS is a folder with the paper's models (the names are in MODEL_FILES). Needs NumPy. The measured
numbers are kept in a JSON file (--cache) so that an interrupted run goes on. They count for the same
program, scripts and model file only: what another program measured is measured again. Takes some ten
minutes on two cores.
"""

import argparse
import csv
import datetime
import io
import itertools
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from number_cache import Cache, fingerprint  # noqa: E402
from paper_page import page  # noqa: E402
from paper_shapes import LIMBS, belly, hidden_by, limb, read_ply  # noqa: E402

MODEL_FILES = {
    "dinosaur 5K": "dinosaur_5026_qem.ply",
    "dinosaur 56K": "dinosaur_56194_loop.ply",
    "rocker-arm": "rocker-arm_10044.off",
    "cow": "cow_29000_loop2_qem.ply",
    "venus": "venus_33066_loop.ply",
    "horse": "horse_48485.obj",
    "armadillo": "armadillo_172966_loop.ply",
}
CERTIFIED = ("dinosaur 5K", "rocker-arm", "venus")  # a dense search is slow
TIMED_ONLY = ("armadillo",)
METHODS = ("kssm", "mesh-saliency")


class Program:
    def __init__(self, path, folder, models):
        self.path, self.folder, self.models = path, folder, models

    def run(self, *arguments):
        done = subprocess.run([self.path, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return done.stdout

    def view(self, model, *arguments):
        return json.loads(self.run("view", model, "-o", self.folder / "view", "--no-images", "--json",
                                   *arguments))

    def scores(self, model, methods, *arguments):
        rows = csv.DictReader(io.StringIO(self.run("score", model, "--method", methods, *arguments)))
        by_method = {}
        for row in rows:
            by_method.setdefault(row["method"], []).append(float(row["score"]))
        return {name: np.array(values) for name, values in by_method.items()}

    def map(self, model, method):
        file = self.folder / "map.ply"
        self.run("map", model, "-o", file, "--method", method, "-q")
        return read_ply(file)


def rank_correlation(a, b):
    """Spearman's; ties by order, which does not matter for maps of reals."""
    ranks = [np.argsort(np.argsort(x, kind="stable"), kind="stable") for x in (a, b)]
    return float(np.corrcoef(*ranks)[0, 1])


def neighbours(directions, triangles_apart):
    """Pairs of directions of a set that are as near as neighbours are."""
    cosines = directions @ directions.T
    np.fill_diagonal(cosines, -1.0)
    limit = np.cos(1.25 * triangles_apart)
    return np.argwhere(np.triu(cosines > limit))


def jumps(program, model):
    """Largest change of the share of KSSM between neighbouring views over its range, by spacing."""
    result = {}
    for level in (2, 3, 4):
        text = program.run("score", model, "--sphere", level)
        rows = np.array([[float(x) for x in line.split(",")[1:]] for line in text.splitlines()[1:]])
        directions, scores = rows[:, :3], rows[:, 3]
        spacing = np.radians(63.435) / 2**level
        pairs = neighbours(directions, spacing)
        change = np.abs(scores[pairs[:, 0]] - scores[pairs[:, 1]])
        span = scores.max() - scores.min()
        result[str(level)] = {"degrees": float(np.degrees(spacing)),
                              "largest": float(change.max() / span),
                              "mean": float(change.mean() / span)}
    return result


def degrees_between(a, b):
    return float(np.degrees(np.arccos(np.clip(np.dot(a, b), -1, 1))))


def from_best_initial(program, model):
    """Degrees from the best of the paper's initial views, the corners of a cube, to the best view."""
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=3))) / np.sqrt(3.0)
    file = program.folder / "corners.csv"
    file.write_text("dx,dy,dz\n" + "".join(",".join(map(repr, map(float, d))) + "\n" for d in corners))
    scores = program.scores(model, "kssm", "--preset", "paper", "--directions", file)["kssm"]
    best = program.view(model, "--preset", "paper", "--search", "global")["best"]["direction"]
    return degrees_between(corners[scores.argmax()], best)


def topology(program, model, views):
    """Skeleton visibility and entropy at the extreme views, and over the sphere."""
    sphere = json.loads(program.run("score", model, "--sphere", 2, "--method", "projected-area", "--json"))
    directions = [views[m][end]["direction"] for m in METHODS for end in ("best", "worst")]
    directions += [row["direction"] for row in sphere]
    file = program.folder / "directions.csv"
    file.write_text("dx,dy,dz\n" + "".join(",".join(map(repr, d)) + "\n" for d in directions))
    found = program.scores(model, "skeleton-visibility,viewpoint-entropy", "--directions", file)
    result = {}
    for name, values in found.items():
        ends, of_sphere = values[:4], values[4:]
        result[name] = {"random": float(of_sphere.mean())}
        for k, (method, end) in enumerate((m, e) for m in METHODS for e in ("best", "worst")):
            result[name][f"{method} {end}"] = float(ends[k])
            result[name][f"{method} {end} percentile"] = float((of_sphere < ends[k]).mean())
    return result


def extreme_views(program, model, *arguments):
    return {method: program.view(model, "--method", method, "--prior", "none", *arguments)
            for method in METHODS}


def of_dinosaur(program, model, views):
    """What the limbs hide of the belly in each method's best view, and how much of it is seen."""
    mesh = read_ply(model)
    on_belly = belly(mesh.positions)
    result = {"vertices": int(on_belly.sum())}
    for name in LIMBS:
        result[name] = int(limb(mesh.positions, name).sum())
    for method, view in views.items():
        eye = np.array(view["best"]["eye"])
        facing, hidden = hidden_by(mesh, on_belly, eye)
        file, directions = program.folder / "seen.npy", program.folder / "one.csv"
        directions.write_text("dx,dy,dz\n" + ",".join(map(repr, view["best"]["direction"])) + "\n")
        program.run("score", model, "--directions", directions, "--visible", file, "-o",
                    program.folder / "score.csv")
        seen = (np.load(file)["seen"][:, 0] & 1).astype(bool)
        result[method] = {"facing": int(facing.sum()), "seen": float(seen[on_belly].mean()),
                          **{name: float(cover[on_belly].sum() / max(1, facing.sum()))
                             for name, cover in hidden.items()},
                          "direction": view["best"]["direction"]}
    return result


def measure(program, name, model):
    found = {}
    paper = program.view(model, "--preset", "paper")
    certified = program.view(model, "--preset", "paper", "--certify") if name in CERTIFIED else None
    found["paper"] = {"evaluations": paper["search"]["evaluations"],
                      "worst_evaluations": paper["search"]["worst_evaluations"],
                      "seconds": paper["seconds"], "vertices": paper["model"]["vertices"],
                      "dense": certified and certified["search"]["dense"]}
    default = program.view(model)
    found["default_seconds"] = default["seconds"]
    if name in TIMED_ONLY:
        return found
    views = extreme_views(program, model)
    found["genus"], found["cycles"] = default["model"]["genus"], default["skeleton"]["cycles"]
    found["topology"] = topology(program, model, views)
    found["from_initial"] = from_best_initial(program, model)
    found["angle"] = {end: degrees_between(*[views[m][end]["direction"] for m in METHODS])
                      for end in ("best", "worst")}
    kssm, thickness = (program.map(model, m) for m in ("kssm", "thickness"))
    saliency = program.map(model, "mesh-saliency")
    found["displacement"] = rank_correlation(kssm.quality, thickness.quality)
    found["locality"] = {"kssm": kssm.smooth_share(), "mesh-saliency": saliency.smooth_share()}
    found["jumps"] = jumps(program, model)
    if name.startswith("dinosaur"):
        found["belly"] = {"vertex": of_dinosaur(program, model, views),
                          "area": of_dinosaur(program, model,
                                              extreme_views(program, model, "--weight", "area"))}
        found["belly"]["paper preset"] = of_dinosaur(program, model, {
            m: program.view(model, "--method", m, "--preset", "paper") for m in METHODS})
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", type=Path)
    parser.add_argument("--vantage", default="build/release/apps/vantage/vantage")
    today = datetime.date.today()
    parser.add_argument("-o", "--output", type=Path, default=Path(f"docs/lab/{today:%Y-%m}-paper-claims.md"))
    parser.add_argument("--cache", type=Path, default=Path("build/paper_claims.json"))
    parser.add_argument("--times", action="store_true", help="with the seconds measured; on a quiet machine")
    parser.add_argument("--only", nargs="*", default=list(MODEL_FILES))
    options = parser.parse_args()
    cache, numbers = Cache(options.cache), {}
    here = Path(__file__).parent
    code = (options.vantage, here / "paper_claims.py", here / "paper_shapes.py")
    with tempfile.TemporaryDirectory() as folder:
        program = Program(options.vantage, Path(folder), options.models)
        for name, file in MODEL_FILES.items():
            made_from = fingerprint(*code, options.models / file)
            found = cache.find(name, made_from)
            if found is None and name in options.only:
                print(name, file=sys.stderr)
                found = measure(program, name, options.models / file)
                cache.put(name, made_from, found)
            if found is not None:
                numbers[name] = found
    commit = subprocess.run(["git", "-C", here, "rev-parse", "--short", "HEAD"], capture_output=True, check=True,
                            text=True).stdout.strip()
    options.output.write_text(page(numbers, MODEL_FILES, f"{today:%B %Y}", commit, options.times))


if __name__ == "__main__":
    main()
