#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits src/orientation/orientation_table.txt, and measures it on models left out of the fit (numpy).

    scripts/fit_orientation.py VANTAGE LABELS.csv [LABELS.csv …] [-o TABLE] [--cache FILE]

VANTAGE is the program: `vantage orient MODEL --features` gives each model's features. LABELS.csv has
the columns file,group,kind,up,front,fold,copy_of: axes as --up takes them, front empty where nobody knows
it, models of one fold are left out together, and the kind is what accuracies are listed by. Groups
that begin with "catalogue" are what witness and threshold are chosen on. Rows with copy_of are stretched
copies of that file: learnt from, never judged.

The model is a sum of small regression trees over features of each candidate direction, those less the
opposite candidate's, and those less the mean of all: gradient boosting (Friedman 2001) of the softmax
over the candidates. Witness and threshold are then chosen on models left out: the most turned models
right with at most 1 % harm. A format's convention is an up with a front: how well its front suits the
shape, if its up is right, speaks for that up, too, as far as files face so (the share of the scans that do).
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np

from boosting import Boosting, numbers_in, softmax

AXES = ["x", "-x", "y", "-y", "z", "-z"]
OPPOSITE = np.array([1, 0, 3, 2, 5, 4])
ALIKE = 0.1  # kAlike of src/orientation/orientation.cpp
HARM = 0.01
FOLDS = 5
COPIES = 2


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
    is_new = False
    for row in rows:
        if row["file"] not in cached:
            cached[row["file"]] = features_of(program, row["file"])
            is_new = True
        row["features"] = cached[row["file"]]
    if cache and is_new:
        cache.write_text(json.dumps(cached))
    rows = [row for row in rows if row["features"]]
    copies = {}
    for row in rows:
        if row.get("copy_of"):
            copies.setdefault(row["copy_of"], []).append(row["features"])
    rows = [row for row in rows if not row.get("copy_of")]
    for row in rows:
        row["copies"] = (copies.get(row["file"], []) + [row["features"]] * COPIES)[:COPIES]
    return rows


def widened(values):
    """Features, less those of the opposite candidate, less the mean: models x candidates x 3 features."""
    opposite = OPPOSITE[: values.shape[1]]
    return np.concatenate([values, values - values[:, opposite], values - values.mean(1, keepdims=True)], 2)


def as_files_come(plain, names, of_front):
    """As if the origin were in the middle and there were no pictures; and as if the origin were far away."""
    height = names.index("origin_ahead" if of_front else "origin_height")
    aside = names.index("origin_aside")
    pictures = [i for i, name in enumerate(names) if "texture" in name]
    copies = []
    for far in (0.0, 0.6 if of_front else 1.2):  # kFar of src/orientation/evidence.cpp
        copy = plain.copy()
        copy[:, :, height], copy[:, :, aside] = 0.5, far
        if far == 0.0:
            copy[:, :, pictures] = 0.0
        copies.append(copy)
    return copies


def ring_around(up):
    return [a for a in AXES if a.lstrip("-") != up.lstrip("-")]


def ups_of(features):
    by_axis = {c["up"]: c["values"] for c in features["ups"]}
    return [by_axis[a] for a in AXES]


def fronts_of(features, up):
    by_axis = {c["front"]: c for c in features["fronts"] if c["up"] == up}
    return [by_axis[a] for a in ring_around(up)]


def alike_fronts(fronts):
    same = np.eye(4, dtype=bool)
    for a, front in enumerate(fronts):
        same[a, a ^ 1] = front["back_difference"] < ALIKE
        for b in range(4):
            if b // 2 != a // 2:
                same[a, b] = front["side_difference"] < ALIKE
    return same


class Task:
    """Up, or the front if up is known: inputs, what is right, and which candidates look alike."""

    def __init__(self, rows, of_front):
        self.rows = [r for r in rows if r["up"] and (r["front"] or not of_front)]
        self.of_front = of_front
        names = rows[0]["features"][("front" if of_front else "up") + "_features"]

        def values(features, up):
            return [f["values"] for f in fronts_of(features, up)] if of_front else ups_of(features)

        plain = np.array([values(row["features"], row["up"]) for row in self.rows])
        self.inputs = widened(plain)
        self.more = [widened(copy) for copy in as_files_come(plain, names, of_front)]
        self.more += [widened(np.array([values(row["copies"][k], row["up"]) for row in self.rows]))
                      for k in range(COPIES)]
        directions = [ring_around(row["up"]) if of_front else AXES for row in self.rows]
        self.truth = np.array([d.index(row["front" if of_front else "up"]) for d, row in zip(directions, self.rows)])
        self.alike = np.array([alike_fronts(fronts_of(row["features"], row["up"])) if of_front
                               else np.eye(6, dtype=bool) for row in self.rows])
        # Of up also the front that the convention has, and the odds of each if that up is right.
        self.front = np.array([ring_around(row["up"]).index(row["front"]) if row["front"] else -1 for row in self.rows])
        self.front_odds = None
        self.known_models = {}
        self.right = self.alike[np.arange(len(self.truth)), self.truth]  # models x candidates
        self.target = self.right / self.right.sum(1, keepdims=True)
        counts = {g: sum(r["group"] == g for r in self.rows) for g in {r["group"] for r in self.rows}}
        # A hundred airliners are not a hundred kinds of thing.
        self.weight = np.array([1.0 if r["group"].startswith("catalogue") else min(1.0, 30 / counts[r["group"]])
                                for r in self.rows])
        self.catalogue = np.array([r["group"].startswith("catalogue") for r in self.rows])
        self.fold = np.array([int(r["fold"]) % FOLDS for r in self.rows])

    def left_out_scores(self, make, parts):
        """Scores of each model by one fitted without the part it is in (NaN: it is in none)."""
        scores = np.full(self.inputs.shape[:2], np.nan)
        for part in parts:
            scores[part] = self.fitted(make, ~part).scores(self.inputs[part])
        return scores

    def folds(self):
        return [self.fold == fold for fold in range(FOLDS)]

    def archives(self):
        names = np.array([row["group"] for row in self.rows])
        return [names == name for name in sorted(set(names[self.catalogue]))]

    def fitted(self, make, mask):
        if mask.tobytes() not in self.known_models:
            self.known_models[mask.tobytes()] = self.newly_fitted(make, mask)
        return self.known_models[mask.tobytes()]

    def newly_fitted(self, make, mask):
        inputs = np.concatenate([self.inputs[mask]] + [copy[mask] for copy in self.more])
        count = len(self.more)
        return make().fit(inputs, np.tile(self.target[mask], (1 + count, 1)),
                          np.concatenate([self.weight[mask] / 2] + [self.weight[mask] / 2 / count] * count))

    def conventions(self, witness, share):
        """(convention's candidate, models that it has right, what it adds to the odds) of each convention."""
        rows = np.arange(len(self.rows))
        count = self.inputs.shape[1]
        for usual in range(count):
            if self.of_front:
                yield usual, self.right[:, usual], witness * np.eye(count)[usual]
                continue
            for front in range(4):
                facing = np.log(1 - share + share * 4 * self.front_odds[rows, usual, front])
                yield (usual, (self.truth == usual) & (self.front == front),
                       (witness + facing)[:, None] * np.eye(count)[usual])

    def decided(self, scores, witness, threshold, share=0.0):
        """For each convention: the models it has right, and the candidates taken."""
        rows = np.arange(len(scores))
        for usual, has_right, added in self.conventions(witness, share):
            odds = softmax(scores + added)
            if self.of_front:
                odds = np.einsum("mab,mb->ma", self.alike, odds)
            best = odds.argmax(1)
            best = np.where(odds[:, usual] >= odds.max(1) - 1e-9, usual, best)
            yield has_right, np.where(odds[rows, best] >= threshold, best, usual)

    def rates(self, scores, witness, threshold, mask, share=0.0):
        """Share right of models turned at random, and of those that the convention has right."""
        turned, right_by_convention = [], []
        rows = np.arange(len(scores))
        for has_right, taken in self.decided(scores, witness, threshold, share):
            ok = self.right[rows, taken]
            turned.append(ok[mask])
            right_by_convention.append(ok[mask & has_right])
        kept = np.concatenate(right_by_convention)
        return np.concatenate(turned).mean(), kept.mean() if len(kept) else 1.0

    def choose_rule(self, scores, share, mask=None, harm=HARM):
        """Witness and threshold that get the most turned models right at no more harm, and the rate."""
        mask = self.catalogue if mask is None else mask
        best = (-1.0, 8.0, 0.99)
        for witness in np.arange(0.0, 5.01, 0.25):
            for threshold in np.arange(0.3, 0.996, 0.06):
                turned, kept = self.rates(scores, witness, threshold, mask, share)
                if 1.0 - kept <= harm and turned > best[0] + 1e-12:
                    best = (turned, float(witness), round(float(threshold), 2))
        return best[1:] + best[:1]

    def rule_left_out(self, scores, share):
        """Turned right, and harm, by rules chosen on the catalogue's other folds."""
        turned, harmed, count = 0.0, 0.0, 0
        for part in self.folds():
            witness, threshold, _ = self.choose_rule(scores, share, self.catalogue & ~part)
            mask = self.catalogue & part
            right, kept = self.rates(scores, witness, threshold, mask, share)
            turned, harmed, count = turned + right * mask.sum(), harmed + (1 - kept) * mask.sum(), count + mask.sum()
        return turned / count, harmed / count

    def given_up(self, scores, witness, threshold, share, mask):
        """Share with the right front of models turned at random whose up is given."""
        rows = np.arange(len(scores))
        # One in six has its format's up; y and z have a usual front then, too; four have none.
        own = self.rates(scores, witness, threshold, mask, share)[0]
        usual = self.rates(scores, np.log(3 * share / (1 - share)), 0.0, mask, share)[0]
        alone = self.right[rows, np.einsum("mab,mb->ma", self.alike, softmax(scores)).argmax(1)][mask].mean()
        return own / 6 + usual / 6 + 4 * alone / 6


def front_odds(rows, make, task, parts):
    """Odds of each front, for each up, by models fitted without the part: models x 6 x 4."""
    plain = np.array([[[f["values"] for f in fronts_of(row["features"], up)] for up in AXES] for row in rows])
    odds = np.full(plain.shape[:3], 0.25)
    known = np.array([bool(row["front"]) for row in rows])
    for part in parts:
        model = task.fitted(make, ~part[known])
        odds[part] = softmax(model.scores(widened(plain[part].reshape(-1, 4, plain.shape[3])))).reshape(-1, 6, 4)
    return odds


def describe(task, scores, witness, threshold, share):
    every = np.ones(len(task.rows), bool)
    plain = task.right[np.arange(len(task.rows)), scores.argmax(1)]
    print(f"  the shape alone: catalogue {plain[task.catalogue].mean():.3f}, all {plain.mean():.3f}")
    for name, mask in (("catalogue", task.catalogue), ("all", every)):
        turned, kept = task.rates(scores, witness, threshold, mask, share)
        print(f"  {name} ({mask.sum()}): turned {turned:.3f} right, harm {1 - kept:.4f}")
        if task.of_front:
            print(f"    if up is given: {task.given_up(scores, witness, threshold, share, mask):.3f}")
    as_they_come(task, scores, witness, threshold, share)
    turned, harm = task.rule_left_out(scores, share)
    print(f"  rules chosen on the other folds: turned {turned:.3f} right, harm {harm:.4f}")
    for kind in sorted({row["kind"] for row in task.rows}):
        mask = np.array([row["kind"] == kind for row in task.rows])
        turned, kept = task.rates(scores, witness, threshold, mask, share)
        print(f"    {kind:20} {mask.sum():4}  shape alone {plain[mask].mean():.2f}  turned {turned:.2f}  "
              f"right by convention {kept:.2f}")
    confusion(task, scores)


def as_they_come(task, scores, witness, threshold, share):
    """Right of the scans, whose formats have y up and z in front (given the up that is right, of fronts)."""
    scans = [i for i, row in enumerate(task.rows) if row["group"] == "scans"]
    if not scans:
        return
    candidates = [("z" if row["up"] == "y" else "-y") if task.of_front else "y" for row in task.rows]
    right = by_habit = 0
    decisions = [taken for _, taken in task.decided(scores, witness, threshold, share)]
    for i in scans:
        directions = ring_around(task.rows[i]["up"]) if task.of_front else AXES
        usual = directions.index(candidates[i])
        convention = usual if task.of_front else 4 * usual + ring_around("y").index("z")
        right += task.right[i, decisions[convention][i]]
        by_habit += task.right[i, usual]
    print(f"  {len(scans)} scans as they come: {right} right, {by_habit} by habit")


def confusion(task, scores):
    """Upside down (or back to front) and on its side, by kind, of what the shape alone says."""
    chosen = scores.argmax(1)
    right = task.right[np.arange(len(chosen)), chosen]
    print("  confusion of the shape alone: kind, models, right, opposite, aside")
    kinds = [("all", np.ones(len(chosen), bool))]
    kinds += [(kind, np.array([row["kind"] == kind for row in task.rows]))
              for kind in sorted({row["kind"] for row in task.rows})]
    for kind, mask in kinds:
        opposite = (chosen // 2 == task.truth // 2) & ~right
        print(f"    {kind:20} {mask.sum():4} {right[mask].mean():.2f} {opposite[mask].mean():.2f} "
              f"{(~right & ~opposite)[mask].mean():.2f}")


def calibration(task, scores):
    """(stated, right, models) by what the shape alone states."""
    chosen = scores.argmax(1)
    right = task.right[np.arange(len(chosen)), chosen]
    odds = np.einsum("mab,mb->ma", task.alike, softmax(scores))
    sure = odds[np.arange(len(odds)), chosen]
    rows = []
    for low, high in ((0, .4), (.4, .6), (.6, .8), (.8, .9), (.9, .95), (.95, 1.01)):
        here = (sure >= low) & (sure < high)
        if here.any():
            rows.append((float(sure[here].mean()), float(right[here].mean()), int(here.sum())))
    return rows


def trade(task, scores, share):
    """(harm allowed, turned right) of the catalogue by the best rule for each."""
    return [(harm, task.choose_rule(scores, share, harm=harm)[2]) for harm in (.005, .01, .02, .03, .05, .08, .12)]


def draw(file, curves):
    """Calibration, and what is gained for harm, as an SVG of two diagrams."""
    colours = {"up": "#1f5fa8", "front": "#b5532a"}
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 620 290" font-family="sans-serif" font-size="11">',
             '<rect width="620" height="290" fill="#fff"/>']

    def axes(left, title, below, aside, most, ticks):
        parts.append(f'<rect x="{left}" y="30" width="220" height="220" fill="none" stroke="#999"/>'
                     f'<text x="{left + 110}" y="20" text-anchor="middle">{title}</text>'
                     f'<text x="{left + 110}" y="282" text-anchor="middle">{below}</text>'
                     f'<text transform="translate({left - 34} 140) rotate(-90)" text-anchor="middle">{aside}</text>')
        for tick in ticks:
            parts.append(f'<text x="{left + 220 * tick / most:.0f}" y="264" text-anchor="middle">{tick:g}</text>')
        for tick in (0, .5, 1):
            parts.append(f'<text x="{left - 6}" y="{254 - 220 * tick:.0f}" text-anchor="end">{tick:g}</text>')

    axes(50, "what the shape alone states", "stated", "share right", 1, (0, .5, 1))
    axes(370, "files turned to a random axis", "harm: files turned though right", "share right", .12, (0, .04, .08, .12))
    parts.append('<path d="M50 250 270 30" stroke="#bbb"/>'
                 f'<path d="M{370 + 220 * HARM / .12:.1f} 30V250" stroke="#bbb"/>')
    for i, (subject, (stated, gained)) in enumerate(curves.items()):
        colour = colours[subject]
        for x, y, count in stated:
            parts.append(f'<circle cx="{50 + 220 * x:.1f}" cy="{250 - 220 * y:.1f}" r="{1.5 + count ** .5 / 3:.1f}" '
                         f'fill="{colour}" fill-opacity=".6"/>')
        line = " ".join(f"{370 + 220 * x / .12:.1f},{250 - 220 * y:.1f}" for x, y in gained)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>'
                     f'<text x="560" y="{226 + 14 * i}" fill="{colour}">{subject}</text>')
    file.write_text("\n".join(parts + ["</svg>"]) + "\n", encoding="utf-8")


MAKE = {"up": lambda: Boosting(rounds=100, leaves=8, rate=0.12, share=0.1, fewest=60),
        "front": lambda: Boosting(rounds=100, leaves=6, rate=0.1, share=0.1, fewest=60)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("labels", nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--cache", type=pathlib.Path, help="file that keeps the features")
    parser.add_argument("--figure", type=pathlib.Path, help="SVG of calibration and harm to write")
    parser.add_argument("--archives", action="store_true", help="also leave out whole archives, one by one")
    given = parser.parse_args()
    rows = load(given.program, given.labels, given.cache)
    lines = ["# Which direction is up, and which the front: docs/orientation.md. Written by",
             "# scripts/fit_orientation.py. tree: FEATURE LIMIT BELOW ABOVE; leaves are added up."]
    scans = [row for row in rows if row["group"] == "scans" and row["up"] == "y" and row["front"]]
    share = round(sum(row["front"] == "z" for row in scans) / len(scans), 2) if scans else 0.25
    print(f"of {len(scans)} scans with y up, {share:.2f} face z")
    tasks = {subject: Task(rows, subject == "front") for subject in ("front", "up")}

    def left_out(parts_of):
        """Left-out scores of both; those of up know the odds of the fronts."""
        scores = {s: task.left_out_scores(MAKE[s], parts_of(task)) for s, task in tasks.items()}
        tasks["up"].front_odds = front_odds(tasks["up"].rows, MAKE["front"], tasks["front"], parts_of(tasks["up"]))
        return scores

    curves = {}
    left_out_scores = left_out(Task.folds)
    rules = {}
    for subject in ("up", "front"):
        task, scores = tasks[subject], left_out_scores[subject]
        witness, threshold, _ = rules[subject] = task.choose_rule(scores, share)
        model = task.fitted(MAKE[subject], np.ones(len(task.rows), bool))
        size = sum(numbers_in(tree) for tree in model.trees)
        print(f"{subject}: {len(task.rows)} models, {size} numbers, witness {witness:g}, threshold {threshold:g}")
        describe(task, scores, witness, threshold, share)
        stated, gained = calibration(task, scores), trade(task, scores, share)
        curves[subject] = stated, gained
        print("  stated -> right (models): " + ", ".join(f"{x:.2f} -> {y:.2f} ({n})" for x, y, n in stated))
        print("  harm allowed -> turned right: " + ", ".join(f"{x:.3f} -> {y:.2f}" for x, y in gained))
        names = rows[0]["features"][f"{subject}_features"]
        lines += [f"{subject} witness {witness:g}", f"{subject} threshold {threshold:g}"]
        lines += [f"{subject} share {share:g}"] if subject == "front" else []
        lines += [f"{subject} tree {text}" for text in model.text(names)]
    if given.archives:
        left_out_scores = left_out(Task.archives)
        for subject in ("up", "front"):
            task, scores = tasks[subject], left_out_scores[subject]
            for part in [*task.archives(), task.catalogue]:
                right = task.right[part, scores[part].argmax(1)].mean()
                turned, kept = task.rates(np.nan_to_num(scores), *rules[subject][:2], part, share)
                name = task.rows[int(np.argmax(part))]["group"] if not (part == task.catalogue).all() else "each"
                print(f"  {subject}, left out whole: {name} ({part.sum()}): "
                      f"shape alone {right:.3f}, turned {turned:.3f}, harm {1 - kept:.4f}")
    if given.figure:
        draw(given.figure, curves)
    if given.output:
        given.output.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
