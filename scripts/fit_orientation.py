#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits src/orientation/orientation_table.txt, and measures it on models left out of the fit (numpy).

    scripts/fit_orientation.py VANTAGE LABELS.csv [LABELS.csv …] [-o TABLE] [--cache FILE]

VANTAGE is the program: `vantage orient MODEL --features` gives each model's features. LABELS.csv has
the columns file,group,kind,up,front,fold: axes as --up takes them, front empty where nobody knows it,
models of one fold are left out together, and the kind is what accuracies are listed by. Groups
that begin with "catalogue" are what witness and threshold are chosen on.

The model is a sum of small regression trees over features of each candidate direction, those less the
opposite candidate's, and those less the mean of all: gradient boosting (Friedman 2001) of the softmax
over the candidates. Witness and threshold are then chosen on models left out: the most turned models
right with at most 1 % harm.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np

AXES = ["x", "-x", "y", "-y", "z", "-z"]
OPPOSITE = np.array([1, 0, 3, 2, 5, 4])
ALIKE = 0.1  # kAlike of src/orientation/orientation.cpp
HARM = 0.01
FOLDS = 5


def features_of(program, file):
    done = subprocess.run([program, "orient", file, "--features"], capture_output=True, text=True, check=False)
    if done.returncode:
        print(f"left out: {done.stderr.strip()}", file=sys.stderr)
        return None
    return json.loads(done.stdout)


def load(program, label_files, cache):
    cached = json.loads(cache.read_text()) if cache and cache.exists() else {}
    rows = []
    for name in label_files:
        with open(name, newline="", encoding="utf-8") as stream:
            rows += list(csv.DictReader(stream))
    for row in rows:
        if row["file"] not in cached:
            cached[row["file"]] = features_of(program, row["file"])
        row["features"] = cached[row["file"]]
    if cache:
        cache.write_text(json.dumps(cached))
    return [row for row in rows if row["features"]]


def widened(values):
    """Features, less those of the opposite candidate, less the mean: models x candidates x 3 features."""
    opposite = OPPOSITE[: values.shape[1]]
    return np.concatenate([values, values - values[:, opposite], values - values.mean(1, keepdims=True)], 2)


def softmax(scores):
    odds = np.exp(scores - scores.max(1, keepdims=True))
    return odds / odds.sum(1, keepdims=True)


class Boosting:
    """Trees of few leaves, each split where it gains most, fitted one after the other."""

    def __init__(self, rounds, leaves, rate=0.25, ridge=3.0, fewest=30, bins=24, share=0.4, seed=1):
        self.rounds, self.leaves, self.rate, self.ridge = rounds, leaves, rate, ridge
        self.fewest, self.bins, self.share, self.seed = fewest, bins, share, seed
        self.trees = []

    def fit(self, inputs, target, weight):
        models, candidates, width = inputs.shape
        flat = inputs.reshape(-1, width)
        quantiles = np.linspace(0, 1, self.bins + 1)[1:-1]
        edges = [np.unique(np.round(np.quantile(flat[:, j], quantiles), 4)) for j in range(width)]
        bins = np.stack([np.searchsorted(edges[j], flat[:, j], side="right") for j in range(width)], 1)
        scores = np.zeros(models * candidates)
        random = np.random.default_rng(self.seed)
        for _ in range(self.rounds):
            odds = softmax(scores.reshape(models, candidates))
            self.slope = ((target - odds) * weight[:, None]).ravel()
            self.bend = (odds * (1 - odds) * weight[:, None]).ravel() + 1e-6
            columns = np.sort(random.choice(width, max(1, int(width * self.share)), replace=False))
            tree, values = self.grow(bins, edges, columns)
            scores += values
            self.trees.append(tree)
        return self

    def best_split(self, rows, bins, edges, columns):
        slope, bend = self.slope[rows], self.bend[rows]
        whole = slope.sum() ** 2 / (bend.sum() + self.ridge)
        best = (1e-3, None, None)
        for j in columns:
            count = len(edges[j]) + 1
            if count < 2:
                continue
            at = bins[rows, j]
            below = np.cumsum(np.bincount(at, slope, count))[:-1]
            bend_below = np.cumsum(np.bincount(at, bend, count))[:-1]
            number = np.cumsum(np.bincount(at, minlength=count))[:-1]
            gain = (below**2 / (bend_below + self.ridge)
                    + (slope.sum() - below) ** 2 / (bend.sum() - bend_below + self.ridge) - whole)
            gain[(number < self.fewest) | (len(rows) - number < self.fewest)] = -1
            k = int(np.argmax(gain))
            if gain[k] > best[0]:
                best = (gain[k], int(j), k)
        return best

    def grow(self, bins, edges, columns):
        root = {"rows": np.arange(len(bins))}
        leaves = [root]
        root["split"] = self.best_split(root["rows"], bins, edges, columns)
        while len(leaves) < self.leaves:
            leaf = max(leaves, key=lambda one: one["split"][0])
            _, column, k = leaf["split"]
            if column is None:
                break
            above = bins[leaf["rows"], column] > k
            leaf["column"], leaf["limit"] = column, float(edges[column][k])
            leaf["below"], leaf["above"] = {"rows": leaf["rows"][~above]}, {"rows": leaf["rows"][above]}
            leaves.remove(leaf)
            for part in (leaf["below"], leaf["above"]):
                part["split"] = self.best_split(part["rows"], bins, edges, columns)
                leaves.append(part)
        values = np.zeros(len(bins))
        for leaf in leaves:
            rows = leaf["rows"]
            leaf["value"] = round(self.rate * self.slope[rows].sum() / (self.bend[rows].sum() + self.ridge), 3)
            values[rows] = leaf["value"]
        return self.plain(root), values

    def plain(self, node):
        if "column" not in node:
            return node["value"]
        return (node["column"], node["limit"], self.plain(node["below"]), self.plain(node["above"]))

    def scores(self, inputs):
        flat = inputs.reshape(-1, inputs.shape[2])

        def value(tree):
            if not isinstance(tree, tuple):
                return np.full(len(flat), tree)
            column, limit, below, above = tree
            return np.where(flat[:, column] < limit, value(below), value(above))

        return sum(value(tree) for tree in self.trees).reshape(inputs.shape[:2])

    def text(self, names):
        columns = list(names) + [f"{name}-opposite" for name in names] + [f"{name}-mean" for name in names]

        def words(tree):
            if not isinstance(tree, tuple):
                return f"{tree:g}"
            return f"{columns[tree[0]]} {tree[1]:g} {words(tree[2])} {words(tree[3])}"

        return [words(tree) for tree in self.trees]


def numbers_in(tree):
    return 1 if not isinstance(tree, tuple) else 1 + numbers_in(tree[2]) + numbers_in(tree[3])


def without_origin(task_inputs, names, of_front):
    """Copies as if the origin were in the middle, and as if it were far away: models come moved, too."""
    height = names.index("origin_ahead" if of_front else "origin_height")
    aside = names.index("origin_aside")
    copies = []
    for far in (0.0, 0.6 if of_front else 1.2):  # kFar of src/orientation/evidence.cpp
        copy = task_inputs.copy()
        copy[:, :, height], copy[:, :, aside] = 0.5, far
        copies.append(copy)
    return copies


class Task:
    """Up, or the front if up is known: inputs, what is right, and which candidates look alike."""

    def __init__(self, rows, of_front):
        self.rows = [r for r in rows if r["up"] and (r["front"] or not of_front)]
        inputs, truth, alike = [], [], []
        for row in self.rows:
            found = row["features"]
            if not of_front:
                by_axis = {c["up"]: c for c in found["ups"]}
                inputs.append([by_axis[a]["values"] for a in AXES])
                truth.append(AXES.index(row["up"]))
                alike.append(np.eye(6, dtype=bool))
            else:
                ring = [a for a in AXES if a.lstrip("-") != row["up"].lstrip("-")]
                by_axis = {c["front"]: c for c in found["fronts"] if c["up"] == row["up"]}
                inputs.append([by_axis[a]["values"] for a in ring])
                truth.append(ring.index(row["front"]))
                same = np.eye(4, dtype=bool)
                for a in range(4):
                    same[a, a ^ 1] = by_axis[ring[a]]["back_difference"] < ALIKE
                    for b in range(4):
                        if b // 2 != a // 2:
                            same[a, b] = by_axis[ring[a]]["side_difference"] < ALIKE
                alike.append(same)
        plain = np.array(inputs)
        names = rows[0]["features"][("front" if of_front else "up") + "_features"]
        self.inputs = widened(plain)
        self.moved = [widened(copy) for copy in without_origin(plain, names, of_front)]
        self.truth = np.array(truth)
        self.alike = np.array(alike)
        self.right = self.alike[np.arange(len(truth)), self.truth]  # models x candidates
        self.target = self.right / self.right.sum(1, keepdims=True)
        counts = {g: sum(r["group"] == g for r in self.rows) for g in {r["group"] for r in self.rows}}
        # A hundred airliners are not a hundred kinds of thing.
        self.weight = np.array([1.0 if r["group"].startswith("catalogue") else min(1.0, 30 / counts[r["group"]])
                                for r in self.rows])
        self.catalogue = np.array([r["group"].startswith("catalogue") for r in self.rows])
        self.fold = np.array([int(r["fold"]) % FOLDS for r in self.rows])

    def left_out_scores(self, make):
        scores = np.zeros(self.inputs.shape[:2])
        moved = np.zeros(self.inputs.shape[:2])
        for fold in range(FOLDS):
            fit = self.fold != fold
            model = self.fitted(make, fit)
            scores[~fit] = model.scores(self.inputs[~fit])
            moved[~fit] = model.scores(self.moved[1][~fit])
        print(f"  origin far away: {self.right[np.arange(len(moved)), moved.argmax(1)][self.catalogue].mean():.3f} "
              "of the catalogue by the shape alone")
        return scores

    def fitted(self, make, mask):
        inputs = np.concatenate([self.inputs[mask]] + [copy[mask] for copy in self.moved])
        return make().fit(inputs, np.tile(self.target[mask], (3, 1)),
                          np.concatenate([self.weight[mask] / 2] + [self.weight[mask] / 4] * 2))

    def decided(self, scores, witness, threshold):
        """For each convention (candidate): the candidate taken, and its confidence."""
        count = scores.shape[1]
        for usual in range(count):
            odds = softmax(scores + witness * np.eye(count)[usual])
            odds = np.einsum("mab,mb->ma", self.alike, odds)
            best = odds.argmax(1)
            best = np.where(odds[:, usual] >= odds.max(1) - 1e-9, usual, best)
            sure = odds[np.arange(len(odds)), best] >= threshold
            taken = np.where(sure, best, usual)
            yield usual, taken, odds[np.arange(len(odds)), taken]

    def rates(self, scores, witness, threshold, mask):
        """Share right of models turned at random, and of those that the convention has right."""
        turned, right_by_convention = [], []
        for usual, taken, _ in self.decided(scores, witness, threshold):
            ok = self.right[np.arange(len(taken)), taken]
            turned.append(ok[mask])
            right_by_convention.append(ok[mask & self.right[:, usual]])
        return np.concatenate(turned).mean(), np.concatenate(right_by_convention).mean()

    def choose_rule(self, scores):
        best = (-1.0, 1.0, 0.99)
        for witness in np.arange(0.0, 4.01, 0.5):
            for threshold in np.arange(0.5, 0.996, 0.02):
                turned, kept = self.rates(scores, witness, threshold, self.catalogue)
                if 1.0 - kept <= HARM and turned > best[0] + 1e-12:
                    best = (turned, float(witness), round(float(threshold), 2))
        return best[1:]


def describe(task, scores, witness, threshold):
    every = np.ones(len(task.rows), bool)
    plain = task.right[np.arange(len(task.rows)), scores.argmax(1)]
    print(f"  the shape alone: catalogue {plain[task.catalogue].mean():.3f}, all {plain.mean():.3f}")
    for name, mask in (("catalogue", task.catalogue), ("all", every)):
        turned, kept = task.rates(scores, witness, threshold, mask)
        print(f"  {name} ({mask.sum()}): turned {turned:.3f} right, harm {1 - kept:.4f}")
    kinds = sorted({row["kind"] for row in task.rows})
    for kind in kinds:
        mask = np.array([row["kind"] == kind for row in task.rows])
        turned, kept = task.rates(scores, witness, threshold, mask)
        print(f"    {kind:20} {mask.sum():4}  shape alone {plain[mask].mean():.2f}  turned {turned:.2f}  "
              f"right by convention {kept:.2f}")
    chosen = scores.argmax(1)
    taken = [chosen[i] == task.truth[i] for i in range(len(chosen))]
    flips = np.mean([c != t and c // 2 == t // 2 for c, t in zip(chosen, task.truth)])
    print(f"  confusion of the shape alone: right {np.mean(taken):.3f}, upside down or back to front {flips:.3f}, "
          f"on its side {1 - np.mean(taken) - flips:.3f}")
    odds = np.einsum("mab,mb->ma", task.alike, softmax(scores))
    sure = odds[np.arange(len(odds)), chosen]
    print("  calibration of the shape alone: stated -> right (models)")
    for low, high in ((0, .4), (.4, .6), (.6, .8), (.8, .9), (.9, .95), (.95, 1.01)):
        here = (sure >= low) & (sure < high)
        if here.any():
            print(f"    {sure[here].mean():.2f} -> {plain[here].mean():.2f} ({here.sum()})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("labels", nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--cache", type=pathlib.Path)
    given = parser.parse_args()
    rows = load(given.program, given.labels, given.cache)
    lines = ["# Which direction is up, and which the front: docs/orientation.md. Written by",
             "# scripts/fit_orientation.py. tree: FEATURE LIMIT BELOW ABOVE; leaves are added up."]
    sizes = {"up": (36, 8), "front": (24, 6)}  # trees, leaves of each
    for subject, (rounds, leaves) in sizes.items():
        task = Task(rows, subject == "front")

        def make():
            return Boosting(rounds, leaves)

        scores = task.left_out_scores(make)
        witness, threshold = task.choose_rule(scores)
        model = task.fitted(make, np.ones(len(task.rows), bool))
        size = sum(numbers_in(tree) for tree in model.trees)
        print(f"{subject}: {len(task.rows)} models, {size} numbers, witness {witness:g}, threshold {threshold:g}")
        describe(task, scores, witness, threshold)
        names = rows[0]["features"][f"{subject}_features"]
        lines += [f"{subject} witness {witness:g}", f"{subject} threshold {threshold:g}"]
        lines += [f"{subject} tree {text}" for text in model.text(names)]
    if given.output:
        given.output.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
