#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits the objective `people` to the views that a furniture catalogue shows its things from (numpy).

    apt-get download sweethome3d-furniture; dpkg -x sweethome3d-furniture*.deb packages
    scripts/fit_choices.py packages --views views.csv --vantage PROGRAM --cache FOLDER [--page PAGE] [--write | --check]

views.csv has archive, model, overlap, azimuth_deg, elevation_deg, dx, dy, dz and second_* of each entry: the
direction from the model's centre to the eye of its icon, y up and +z in front after the catalogue's rotation.
Overlaps below 0.88 are left out, and overlaps of 1 in two directions: such an icon has no silhouette, it is opaque all
over. Where another direction within 0.02 of the overlap is not from below, or else is in front, it is taken. A
table of rebuild_catalogue.py, with a column confidence, is taken as it is: it has told front from back by colours,
and the shipped table is made from it.
--write replaces src/choice/choice_table.txt, --check compares it with what it would be, --page puts the table
of errors on models left out between the marks of a page. docs/people.md explains the model. What --cache keeps counts
for the very program and model that it was measured with; what failed or took too long is tried anew the next time.
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import number_cache  # noqa: E402
import orientation_data  # noqa: E402

TABLE = pathlib.Path(__file__).resolve().parents[1] / "src/choice/choice_table.txt"
BEGIN, END = "<!-- fit_choices.py begins -->", "<!-- fit_choices.py ends -->"
LEAST_OVERLAP = 0.88   # of the icon's silhouette with the model's
OPAQUE = 0.9995        # overlaps of icons that are opaque all over
FROM_BELOW = -0.1      # what is lower is seldom meant
AMBIGUOUS = 0.02       # overlaps so near do not tell front from back, nor above from below
OUTLIERS = 0.05        # share of choices that the likelihood lets come from anywhere
KERNEL = np.radians(10)  # a choice is as good as its neighbourhood
LEAST_WEIGHT = 1e-4    # as src/choice/view_habit.cpp has it, and the next two
WIDEN = 1.1
LEAST_CHOICES = 2
LEAST_SHARE = 1e-3     # as src/pipeline/preference.cpp has it
BANDWIDTHS, MIRRORS = (0.35, 0.5, 0.7), (0.1, 0.2, 0.3)
FOLDS = 10
SPLITS = 3             # into such folds
SIGNIFICANCE = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3)  # times the habit's weight, tried beside the likelihood's
FIXED = {"three-quarter (1, 0.6, 1)": (1, 0.6, 1), "f3d's default (1, 0.5, 1)": (1, 0.5, 1),
         "isometric (1, 1, 1)": (1, 1, 1), "straight front": (0, 0, 1)}


def unit(v):
    v = np.asarray(v, float)
    return v / np.linalg.norm(v)


def chosen(row):
    """The direction of an icon's view."""
    direction = unit([float(row[k]) for k in ("dx", "dy", "dz")])
    if "confidence" in row:
        return direction
    if float(row["second_overlap"]) > float(row["overlap"]) - AMBIGUOUS:
        a, e = (np.radians(float(row[k])) for k in ("second_azimuth_deg", "second_elevation_deg"))
        second = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
        return max(direction, second, key=lambda d: (d[1] > FROM_BELOW, d[2] > 0))  # the first of equals
    return direction


def tells_a_pose(row):
    """Whether the icon's silhouette says from where it shows the model."""
    if "confidence" in row:
        return True
    return float(row["overlap"]) >= LEAST_OVERLAP and float(row["second_overlap"]) < OPAQUE


def measured(program, made_by, file, cache):
    """Proportions and KSSM shares of 642 views, by the program of that fingerprint; None where it cannot."""
    kept = cache / (file.stem + ".json")
    made_from = [made_by, number_cache.fingerprint(file)]
    if kept.exists():
        result = json.loads(kept.read_text(encoding="utf-8"))
        if result.get("made_from") == made_from:
            return result
    try:
        with tempfile.TemporaryDirectory() as folder:
            flags = ["--up", "y", "--front", "z", "--search", "exhaustive", "--subdivisions", "0"]
            view = json.loads(subprocess.run([program, "view", file, "-o", folder, "--no-images", "--json", *flags],
                                             capture_output=True, check=True, timeout=120).stdout)
        lines = subprocess.run([program, "score", file, "--sphere", "3"], capture_output=True, check=True,
                               text=True, timeout=120).stdout.splitlines()
        rows = [[float(x) for x in line.split(",")[-4:]] for line in lines if line.startswith("kssm,")]
        result = {"made_from": made_from, "proportions": view["proportions"], "total": view["total"], "rows": rows}
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired, json.JSONDecodeError, KeyError) as error:
        print(f"{file.stem}: {error}", file=sys.stderr)  # not kept: a busy machine is no property of the model
        return None
    kept.write_text(json.dumps(result), encoding="utf-8")
    return result


class Entry:
    """One thing of the catalogue, its recorded view, and what the program says of it."""

    def __init__(self, name, archive, direction, result, directions):
        p = result["proportions"]
        self.name, self.archive, self.direction = name, archive, direction
        self.shape = np.array([p["height"], p["width"], *[float(p["mirrors_" + k]) for k in ("side", "front", "up")]])
        scores = np.array(result["rows"])[:, 3]
        self.share = np.log(np.maximum(scores / max(result["total"], 1e-300), LEAST_SHARE))
        self.angles = self.angles_from(directions)
        near = np.exp((np.cos(self.angles) - 1) / KERNEL ** 2)
        self.near = near / near.mean()

    def angles_from(self, directions):
        """Angles in radians to the recorded view or its mirror images: left and right, front and back if alike."""
        x, y, z = np.abs(directions[:, 0] * self.direction[0]), directions[:, 1] * self.direction[1], \
            directions[:, 2] * self.direction[2]
        return np.arccos(np.clip(x + y + (np.abs(z) if self.shape[3] else z), -1, 1))

    def line(self):
        flags = "".join(str(int(f)) for f in self.shape[2:])
        return "view %.3f %.3f %s %.3f %.3f %.3f" % (*self.shape[:2], flags, *self.direction)


def read_entries(arguments, folder):
    with open(arguments.views, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if tells_a_pose(row)]
    listed = {row["model"].lstrip("/"): row for row in rows}
    files = []
    for path in sorted(arguments.packages.rglob("*.sh3f")):
        with zipfile.ZipFile(path) as archive:
            models = orientation_data.catalogue(archive, "PluginFurnitureCatalog.properties", set(listed))
            for stem, _, shape in models:
                file = folder / f"{path.stem}__{stem}.obj"
                orientation_data.Shape(shape.points, shape.faces).write(file)
                files.append((file, path.stem))
    by_stem = {(row["archive"], pathlib.Path(row["model"]).stem): row for row in rows}
    arguments.cache.mkdir(parents=True, exist_ok=True)
    made_by = number_cache.fingerprint(shutil.which(arguments.vantage) or arguments.vantage)
    with ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda f: measured(arguments.vantage, made_by, f[0], arguments.cache), files))
    entries, directions = [], None
    for (file, archive), result in sorted(zip(files, results), key=lambda pair: pair[0][0].name):
        row = by_stem.get((archive, file.stem.split("__", 1)[1]))
        if row is None or result is None:
            print("left out:", file.stem, file=sys.stderr)
            continue
        if directions is None:
            directions = np.array(result["rows"])[:, :3]
        entries.append(Entry(file.stem, archive, chosen(row), result, directions))
    return entries, directions


def habits(entries, train, bandwidth, mirror):
    """Mean angle from each direction to the views recorded of like shapes, each entry itself left out."""
    shapes = np.stack([e.shape for e in entries])
    angles = np.stack([entries[j].angles for j in train])
    scale = np.array([1, 1, mirror, mirror, mirror])
    result = []
    for i, entry in enumerate(entries):
        unlike = (shapes[train] - entry.shape) ** 2 @ scale
        unlike[np.asarray(train) == i] = np.inf
        weights, width = np.exp(-unlike / (2 * bandwidth ** 2)), bandwidth
        while weights.sum() < min(LEAST_CHOICES, np.isfinite(unlike).sum() / 2):
            width *= WIDEN
            weights = np.exp(-unlike / (2 * width ** 2))
        weights += LEAST_WEIGHT * np.isfinite(unlike)
        result.append(weights @ angles / weights.sum())
    return result


def likelihood(weights, terms, near):
    """Mean log likelihood of the recorded views over that of a random one, and its gradient."""
    value, gradient = 0.0, np.zeros(len(weights))
    for x, k in zip(terms, near):
        z = x @ weights
        p = np.exp(z - z.max())
        p /= p.sum()
        q = p @ k
        whole = (1 - OUTLIERS) * q + OUTLIERS
        value += np.log(whole)
        gradient += (1 - OUTLIERS) / whole * ((p * k) @ x - q * (p @ x))
    return value / len(terms), gradient / len(terms)


def fitted(terms, near):
    """Weights of largest likelihood, by ascent along the gradient with a step that halves where it does not help."""
    scale = 1 / np.concatenate(terms).std(0)
    weights = 2.0 * scale
    value, gradient = likelihood(weights, terms, near)
    step = 4.0
    for _ in range(200):
        move = step * gradient * scale ** 2
        tried, slope = likelihood(weights + move, terms, near)
        if tried > value:
            if tried - value < 1e-7:
                break
            weights, value, gradient, step = weights + move, tried, slope, step * 1.5
        else:
            step /= 3
    return weights, value


def terms_of(entries, habit, indices, use):
    return [np.stack([-habit[i], entries[i].share][:1 + use], 1) for i in indices]


def choose_shape(entries, train, use):
    """Bandwidth and mirror weight of largest likelihood among those tried; the weights."""
    best = None
    for bandwidth in BANDWIDTHS:
        for mirror in MIRRORS:
            habit = habits(entries, train, bandwidth, mirror)
            weights, value = fitted(terms_of(entries, habit, train, use), [entries[i].near for i in train])
            if best is None or value > best[0]:
                best = value, bandwidth, mirror, weights, habit
    return best


def held_out(entries, directions, groups, use):
    """Angle from each entry's view to what the model takes that was fitted without its group, radians."""
    errors = np.zeros(len(entries))
    for group in sorted(set(groups)):
        train = [i for i in range(len(entries)) if groups[i] != group]
        _, bandwidth, mirror, weights, habit = choose_shape(entries, train, use)
        if use:
            weights = most_significance(entries, train, bandwidth, mirror, weights)
        for i in (i for i in range(len(entries)) if groups[i] == group):
            z = np.stack([-habit[i], entries[i].share][:1 + use], 1) @ weights
            errors[i] = entries[i].angles[z.argmax()]
    return errors


def constant_camera(entries, groups):
    """The same of the one direction that is best on the other groups."""
    angles = np.stack([e.angles for e in entries])
    errors = np.zeros(len(entries))
    for group in sorted(set(groups)):
        inside = np.array([g == group for g in groups])
        errors[inside] = angles[inside][:, angles[~inside].mean(0).argmin()]
    return errors


def row_of(name, errors, null):
    random = np.random.default_rng(0)
    picks = random.integers(0, len(errors), (2000, len(errors)))
    share, less = errors / np.pi, (errors - null) / np.pi
    low, high = np.percentile(share[picks].mean(1), (2.5, 97.5))
    low2, high2 = np.percentile(less[picks].mean(1), (2.5, 97.5))
    return "| %s | %.3f [%.3f, %.3f] | %+.3f [%+.3f, %+.3f] | %.0f° | %.0f %% |" % (
        name, share.mean(), low, high, less.mean(), low2, high2, np.degrees(np.median(errors)),
        100 * (errors < np.radians(20)).mean())


def table_of(entries, directions):
    folds = list(np.random.default_rng(0).permutation(len(entries)) % FOLDS)
    archives = [e.archive for e in entries]
    null = constant_camera(entries, folds)
    share = np.array([e.angles[e.share.argmax()] for e in entries])
    lines = ["| view | error [95 %] | less the constant camera's | median | within 20° |", "| --- | --- | --- | --- | --- |",
             row_of("people", held_out(entries, directions, folds, 1), null),
             row_of("people without KSSM", held_out(entries, directions, folds, 0), null),
             row_of("people, archives left out", held_out(entries, directions, archives, 1), null),
             row_of("best constant camera", null, null),
             row_of("best constant camera, archives left out", constant_camera(entries, archives), null)]
    for name, camera in FIXED.items():
        lines.append(row_of(name, np.array([e.angles_from(unit(camera)[None])[0] for e in entries]), null))
    lines.append(row_of("KSSM alone", share, null))
    lines.append(row_of("random", np.array([e.angles.mean() for e in entries]), null))
    return "\n".join([f"{len(entries)} models, {FOLDS} folds.", ""] + lines) + "\n"


def most_significance(entries, train, bandwidth, mirror, weights):
    """The weights with a smaller one of the habit: the least before the error on models left out exceeds that of the
    weights given by more than a standard error of the difference, as errors do not tell more than that (the
    one-standard-error rule: Hastie, Tibshirani, Friedman 2009, 7.10). What people's views leave open the significance
    decides."""
    ratios = [weights[1] / weights[0], *(ratio for ratio in SIGNIFICANCE if ratio > weights[1] / weights[0])]
    errors = np.zeros((len(ratios), len(train)))
    for seed in range(SPLITS):
        fold_of = np.random.default_rng(seed).permutation(len(train)) % FOLDS
        for fold in range(FOLDS):
            habit = habits(entries, [i for i, f in zip(train, fold_of) if f != fold], bandwidth, mirror)
            for n in np.flatnonzero(fold_of == fold):
                entry = entries[train[n]]
                for error, ratio in zip(errors, ratios):
                    error[n] += entry.angles[(ratio * entry.share - habit[train[n]]).argmax()] / SPLITS
    more = errors - errors[0]
    exceeds = more.mean(1) > more.std(1) / np.sqrt(len(train))
    last = exceeds.argmax() - 1 if exceeds.any() else len(ratios) - 1
    return np.array([weights[1] / ratios[last], weights[1]])


def table_text(entries):
    value, bandwidth, mirror, weights, _ = choose_shape(entries, list(range(len(entries))), 1)
    weights = most_significance(entries, list(range(len(entries))), bandwidth, mirror, weights)
    head = ["# Views that the makers of a furniture catalogue (Debian's sweethome3d-furniture: CC BY 3.0, CC0 and",
            "# public domain) show their things from, and the model made of them: docs/people.md. Written by",
            "# scripts/fit_choices.py from what scripts/rebuild_catalogue.py found. view: log(up/sqrt(side*front)),",
            "# log(side/front) of the box, mirror planes of side, front and up, and the direction to the eye along",
            "# side, up and front."]
    return "\n".join(head + ["habit %.2f" % weights[0], "significance %.2f" % weights[1], f"bandwidth {bandwidth}",
                             f"mirror {mirror}"] + [e.line() for e in entries]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("--views", required=True, type=pathlib.Path)
    parser.add_argument("--vantage", required=True)
    parser.add_argument("--cache", required=True, type=pathlib.Path)
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        entries, directions = read_entries(arguments, pathlib.Path(folder))
    text = table_text(entries)
    if arguments.write:
        TABLE.write_text(text, encoding="utf-8")
    if arguments.check:
        same = text == TABLE.read_text(encoding="utf-8")
        print("the shipped table is what this fit gives" if same else "the shipped table differs from this fit")
        sys.exit(0 if same else 1)
    table = table_of(entries, directions)
    print(table)
    if arguments.page:
        page = arguments.page.read_text(encoding="utf-8")
        start, end = page.index(BEGIN) + len(BEGIN), page.index(END)
        arguments.page.write_text(page[:start] + "\n" + table + page[end:], encoding="utf-8")


if __name__ == "__main__":
    main()
