#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits src/orientation/orientation_table.txt, and measures it on models left out of the fit (numpy).

    scripts/fit_orientation.py VANTAGE LABELS.csv [LABELS.csv …] [-o TABLE] [--keep-front] [--cache FILE]

VANTAGE is the program: `vantage orient MODEL --features` gives each model's features. LABELS.csv has
the columns file,group,kind,up,front,fold,copy_of: axes as --up takes them, front empty where nobody knows
it, models of one fold are left out together, and the kind is what accuracies are listed by. Groups
are the archives that models come from; "catalogue" begins those of furniture. Rows with copy_of are stretched
copies of that file: learnt from, never judged.

The model is a sum of small regression trees over features of each candidate direction, those less the
opposite candidate's, and those less the mean of all: gradient boosting (Friedman 2001) of the softmax
over the candidates. What files of one archive share (its makers' habits) is no help with other files: so whole
archives are left out, one by one, and on what is then said of them the scale of the log odds (the least log loss),
the log odds of the convention and the threshold are chosen: the most turned models right with at most 1 % harm. A series of near
copies (twenty wall sockets) counts as one model, and is left out of the folds together. A format's convention
is an up with a front: how well its front suits the shape, if its up is right, speaks for that up, too, as far
as files face so (the share of the scans that do).
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np

from boosting import Boosting, numbers_in, softmax
from orientation_task import AXES, COPIES, HARM, Task, fronts_of, interval, mean, ring_around, series_of, widened


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
    for row, series in zip(rows, series_of(rows)):
        row["series"] = series
    for row in rows:
        row["copies"] = (copies.get(row["file"], []) + [row["features"]] * COPIES)[:COPIES]
    return rows


def front_odds(rows, make, task, parts, scale):
    """Odds of each front, for each up, by models fitted without the part: models x 6 x 4."""
    plain = np.array([[[f["values"] for f in fronts_of(row["features"], up)] for up in AXES] for row in rows])
    odds = np.full(plain.shape[:3], 0.25)
    known = np.array([bool(row["front"]) for row in rows])
    for part in parts:
        model = task.fitted(make, ~part[known])
        scores = scale * model.scores(widened(plain[part].reshape(-1, 4, plain.shape[3])))
        odds[part] = softmax(scores).reshape(-1, 6, 4)
    return odds


def describe(task, scores, log_odds, threshold, share):
    one = np.ones(len(task.rows))
    plain = task.right[np.arange(len(task.rows)), scores.argmax(1)].astype(float)
    turned, kept = task.outcomes(scores, log_odds, threshold, share)
    rates = [("shape alone", plain), ("turned", turned), ("harm", 1 - kept)]
    if task.of_front:
        rates.append(("if up is given", task.given_up(scores, log_odds, threshold, share)))
    for name, counts in (("catalogue", one * task.catalogue), ("all", one)):
        print(f"  {name}: " + ", ".join(printed(what, values, counts, task.series) for what, values in rates))
    as_they_come(task, scores, log_odds, threshold, share)
    for kind in sorted({row["kind"] for row in task.rows}):
        mask = np.array([row["kind"] == kind for row in task.rows])
        print(f"    {kind:20} {mask.sum():4}  shape alone {plain[mask].mean():.2f}  turned {turned[mask].mean():.2f}  "
              f"right by convention {mean(kept, one * mask):.2f}")
    confusion(task, scores)


def as_they_come(task, scores, log_odds, threshold, share):
    """Right of the scans, whose formats have y up and z in front (given the up that is right, of fronts)."""
    scans = [i for i, row in enumerate(task.rows) if row["group"] == "scans"]
    if not scans:
        return
    candidates = [("z" if row["up"] == "y" else "-y") if task.of_front else "y" for row in task.rows]
    right = by_habit = 0
    decisions = [taken for _, taken in task.decided(scores, log_odds, threshold, share)]
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


def printed(name, values, counts, series):
    low, high = interval(values, counts, series)
    if np.isnan(low):
        return f"{name} unknown"
    return f"{name} {mean(values, counts):.3f} ({low:.3f} to {high:.3f})"


def describe_archives(task, scores, rule, share, grid):
    """What is said of archives that the fit knows nothing of."""
    turned, kept = task.outcomes(scores, *rule, share)
    right = task.right[np.arange(len(scores)), scores.argmax(1)].astype(float)
    one = np.ones(len(scores))

    def line(name, counts):
        print(f"    {name:24} {int((counts > 0).sum()):4}  " + ", ".join(
            printed(what, values, counts, task.series)
            for what, values in (("shape alone", right), ("turned", turned), ("harm", 1 - kept))))

    print("  archives left out whole (95 % intervals, series drawn)")
    for part in task.archives():
        line(task.rows[int(np.argmax(part))]["group"], one * part)
    line("catalogue", one * task.catalogue)
    line("catalogue, series as one", task.counts * task.catalogue)
    line("all, as chosen on", task.counts)
    turned, kept = task.rule_left_out(grid)
    print("    rules chosen on the other archives: " + printed("turned", turned, task.counts, task.series) + ", "
          + printed("harm", 1 - kept, task.counts, task.series))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("labels", nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--cache", type=pathlib.Path, help="file that keeps the features")
    parser.add_argument("--figure", type=pathlib.Path, help="SVG of calibration and harm to write")
    parser.add_argument("--keep-front", action="store_true", help="let the lines of the front in TABLE as they are")
    given = parser.parse_args()
    kept = [line for line in given.output.read_text(encoding="utf-8").splitlines() if line.startswith("front ")] \
        if given.keep_front else []
    rows = load(given.program, given.labels, given.cache)
    lines = ["# Which direction is up, and which the front: docs/orientation.md. Written by",
             "# scripts/fit_orientation.py. tree: FEATURE LIMIT BELOW ABOVE; leaves are added up."]
    scans = [row for row in rows if row["group"] == "scans" and row["up"] == "y" and row["front"]]
    share = round(sum(row["front"] == "z" for row in scans) / len(scans), 2) if scans else 0.25
    print(f"of {len(scans)} scans with y up, {share:.2f} face z")
    tasks = {subject: Task(rows, subject == "front") for subject in ("front", "up")}

    def left_out(parts_of, scales=None):
        """Left-out scores of both, and their scales; those of up know the odds of the fronts."""
        scores = {s: task.left_out_scores(MAKE[s], parts_of(task)) for s, task in tasks.items()}
        scales = scales or {s: 1.0 if s == "front" and kept else task.choose_scale(scores[s])
                            for s, task in tasks.items()}
        tasks["up"].front_odds = front_odds(tasks["up"].rows, MAKE["front"], tasks["front"], parts_of(tasks["up"]),
                                            scales["front"])
        return {s: scales[s] * scores[s] for s in tasks}, scales

    curves, rules = {}, {}
    scores, scales = left_out(Task.archives)
    for subject in ("up", "front"):
        task = tasks[subject]
        grid = task.grid(scores[subject], share)
        log_odds, threshold, _ = task.choose_rule(grid)
        rules[subject] = log_odds, threshold
        print(f"{subject}: {len(task.rows)} models, scale {scales[subject]:g}, convention {log_odds:g}, "
              f"threshold {threshold:g}")
        describe_archives(task, scores[subject], rules[subject], share, grid)
        stated = calibration(task, scores[subject])
        gained = [(harm, task.choose_rule(grid, harm=harm)[2]) for harm in (.005, .01, .02, .03, .05, .08, .12)]
        curves[subject] = stated, gained
        print("  stated -> right (models): " + ", ".join(f"{x:.2f} -> {y:.2f} ({n})" for x, y, n in stated))
        print("  harm allowed -> turned right: " + ", ".join(f"{x:.3f} -> {y:.2f}" for x, y in gained))
    scores, _ = left_out(Task.folds, scales)
    for subject in ("up", "front"):
        task = tasks[subject]
        model = task.fitted(MAKE[subject], np.ones(len(task.rows), bool)).scaled(scales[subject])
        print(f"{subject}, {sum(numbers_in(tree) for tree in model.trees)} numbers, in folds")
        describe(task, scores[subject], *rules[subject], share)
        if subject == "front" and kept:
            lines += kept
            continue
        names = rows[0]["features"][f"{subject}_features"]
        lines += [f"{subject} convention_log_odds {rules[subject][0]:g}", f"{subject} threshold {rules[subject][1]:g}"]
        lines += [f"{subject} share {share:g}"] if subject == "front" else []
        lines += [f"{subject} tree {text}" for text in model.text(names)]
    if given.figure:
        draw(given.figure, curves)
    if given.output:
        given.output.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
