#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits the upright prior to views that people chose, cross-validates it by model, prints the table.

    fit_prior.py FOLDER --vantage PROGRAM [--cache FOLDER] [--sphere 4] [--page docs/lab/YYYY-MM-prior.md] [--check]
                 [--beside METHOD...]

FOLDER holds views.csv (model,subject,status,vx,vy,vz,…), mirror_planes.csv (model,nx,ny,nz) and the
models in models/, y up. Score fields come from `PROGRAM score MODEL --sphere N` and are kept in the
cache. docs/lab/2026-11-prior.md explains the method; --page writes the tables into that page, between its marks;
--check fails when the claims of the page do not hold; --beside tries further measures, each with a fitted
exponent, as factors beside KSSM and in its place, and says so on the page. Needs numpy (Debian: python3-numpy).
"""
import argparse
import csv
import hashlib
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("NOTHING WAS TESTED: this script needs numpy (Debian: python3-numpy)", file=sys.stderr)
    sys.exit(77)

# Exponents of the front and the side term, see docs/lab/2026-11-prior.md; chosen, not fitted.
FRONT_SHARE = 0.08
SIDE_SHARE = 0.04
STRENGTHS = (1.0, 1.5, 2.0, 3.0, 4.0)  # candidates, chosen by the training models
BESIDE = ("visibility-ratio", "projected-area", "mesh-saliency")  # what the page tries beside KSSM
START = np.array([3.0, 5.0, 8.0, 1.0])  # of the likelihood's ascent; the result does not hang on it
RIDGE = 1e-2  # keeps a weight finite that no row speaks about
FLOOR = 1e-3  # a score below this share of the largest counts as this share: its logarithm is taken
BEGIN, END = "<!-- fit_prior.py begins -->", "<!-- fit_prior.py ends -->"
FIXED = {"three-quarter (1, 0.6, 1)": (1, 0.6, 1), "isometric (1, 1, 1)": (1, 1, 1),
         "f3d's default (1, 0.5, 1)": (1, 0.5, 1), "straight front (+Z)": (0, 0, 1)}


class People:
    """What people chose for one model."""

    def __init__(self, name):
        self.name = name
        self.rows = []  # (moved, unit direction)
        self.planes = []

    def views(self, moved_only):
        return np.array([v for moved, v in self.rows if moved or not moved_only])

    def copies(self, directions, fold):
        """Each direction and, when folding, its images in the mirror planes: copies × n × 3."""
        images = [np.asarray(directions, float)]
        for n in self.planes if fold else []:
            images += [d - 2 * (d @ n)[:, None] * n for d in images]
        return np.stack(images)

    def angles(self, directions, fold, moved_only=True):
        """Angle from each direction to each chosen view: n × views, as a share of 180 degrees."""
        cosines = np.clip(self.copies(directions, fold) @ self.views(moved_only).T, -1, 1)
        return np.arccos(cosines.max(0)) / np.pi


def unit(v):
    v = np.asarray(v, float)
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def read_people(folder):
    people = {}
    with open(folder / "views.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            one = people.setdefault(row["model"], People(row["model"]))
            one.rows.append((row["status"] == "moved", unit([row["vx"], row["vy"], row["vz"]])))
    with open(folder / "mirror_planes.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            people[row["model"]].planes.append(unit([row["nx"], row["ny"], row["nz"]]))
    return [people[name] for name in sorted(people)]


def score_field(program, model, level, cache, method="kssm"):
    """Directions and scores as shares of the largest; the key is the program and the model."""
    key = hashlib.sha256(pathlib.Path(program).read_bytes() + model.read_bytes()).hexdigest()[:16]
    path = cache / f"{model.name}-{method}-{level}-{key}.csv"
    if not path.exists():
        subprocess.run([program, "score", str(model), "--method", method, "--sphere", str(level), "-o", str(path),
                        "-q"], check=True)
    with open(path, newline="", encoding="utf-8") as file:
        table = np.array([[row["dx"], row["dy"], row["dz"], row["score"]]
                          for row in csv.DictReader(file)], float)
    return table[:, :3], table[:, 3] / table[:, 3].max()


class Study:
    """Score fields and people together, on one set of directions."""

    def __init__(self, people, fields):
        """:param fields: of each measure, of each of the people's models."""
        self.people = people
        self.directions = fields[0][0][0]
        side, up, front = self.directions.T
        # Near-ties fall toward the front, then toward the right.
        self.tie = FRONT_SHARE * front + SIDE_SHARE * side
        self.shape = np.stack([up, -up * up, 4 * side**2 * front**2], 1)
        self.log_scores = [np.stack([np.log(np.maximum(field[1], FLOOR)) for field in of_model], 1)
                           for of_model in zip(*fields)]
        self.features = [np.column_stack([logs, self.shape]) for logs in self.log_scores]
        self.measures = len(fields)
        # The set's direction nearest to each chosen view and to its mirror images: views × copies.
        self.near = [(one.copies(one.views(True), True) @ self.directions.T).argmax(2).T
                     for one in people]
        self.error = [one.angles(self.directions, True).mean(1) for one in people]

    def fit(self, models):
        """Weights of log score and shape under which the chosen views, folded, are likeliest."""
        w = np.concatenate([np.full(self.measures, START[0]), START[1:]])
        for _ in range(200):
            slope, bend = -RIDGE * w, -RIDGE * np.eye(len(w))
            for m in models:
                x, near = self.features[m], self.near[m]
                p = self.chance(m, w)
                r = p[near] / p[near].sum(1, keepdims=True)
                mean = p @ x
                slope = slope + (r[:, :, None] * x[near]).sum(1).mean(0) - mean
                bend = bend - ((x * p[:, None]).T @ x - np.outer(mean, mean))
            step = np.linalg.solve(bend, -slope)
            w = w + step * min(1.0, 2.0 / np.abs(step).max())
            if np.abs(step).max() < 1e-9:
                break
        return w

    def chance(self, m, w):
        z = self.features[m] @ w
        p = np.exp(z - z.max())
        return p / p.sum()

    def likelihood(self, m, w):
        """Mean log likelihood of the chosen views over a uniform choice, folded, nats a row."""
        p = self.chance(m, w)
        return np.log(p[self.near[m]].mean(1) * len(p)).mean()

    def pick(self, m, w, strength):
        k = self.measures
        bent = self.log_scores[m] @ w[:k] + strength * (self.shape @ w[k:])
        return int((bent / w[:k].sum() + self.tie).argmax())

    def choose_strength(self, models, w):
        risk = [np.mean([self.error[m][self.pick(m, w, s)] for m in models]) for s in STRENGTHS]
        return STRENGTHS[int(np.argmin(risk))]


def constants(w, strength):
    """The constants of include/vantage/view/prior.h."""
    return {"elevation_sine": w[1] / (2 * w[2]), "elevation_strength": strength * w[2] / w[0],
            "corner_strength": strength * w[3] / w[0], "front_strength": FRONT_SHARE,
            "side_strength": SIDE_SHARE}


def left_out(study):
    """For each model: it, the others, and what they fit."""
    everyone = range(len(study.people))
    for m in everyone:
        rest = [k for k in everyone if k != m]
        w = study.fit(rest)
        yield m, rest, w, study.choose_strength(rest, w)


def beside(study):
    """Error and likelihood of left-out models, with every measure of the study; and the first one's share."""
    trials = [(study.error[m][study.pick(m, w, strength)], study.likelihood(m, w))
              for m, _, w, strength in left_out(study)]
    w = study.fit(range(len(study.people)))
    return *np.mean(trials, axis=0), w[0] / w[:study.measures].sum()


def beside_table(people, kssm, others):
    """:param others: of each further measure, its fields by the measure's name."""
    lines = ["", "Other measures beside KSSM, as score^a · other^(1 − a), and in its place, with a fitted as all else is:", "",
             "| factors of the objective | error of left-out models | likelihood, nats a row | a |", "| --- | --- | --- | --- |"]
    trials = {"KSSM": [kssm]}
    for name, fields in others.items():
        trials[f"KSSM and {name}"] = [kssm, fields]
        trials[name] = [fields]
    for name, fields in trials.items():
        error, likelihood, share = beside(Study(people, fields))
        lines.append(f"| {name} | {error:.3f} | {likelihood:.3f} | {share:.2f} |")
    return "\n".join(lines) + "\n"


def cross_validate(study):
    """Leaving out each model: the directions of ours and of the prior alone, and likelihoods."""
    ours, alone, likelihood = [], [], []
    bare = Study.__new__(Study)
    bare.__dict__.update(study.__dict__)
    bare.features = [np.column_stack([np.zeros(len(x)), x[:, 1:]]) for x in study.features]
    for m, rest, w, strength in left_out(study):
        ours.append(study.directions[study.pick(m, w, strength)])
        without = bare.fit(rest)
        alone.append(study.directions[int((study.shape @ without[1:] + study.tie).argmax())])
        likelihood.append((study.likelihood(m, w), bare.likelihood(m, without)))
    return np.array(ours), np.array(alone), np.array(likelihood)


def rows_of(one, fold, moved_only, directions, measure):
    return measure(one.angles(np.atleast_2d(directions), fold, moved_only))


def another_human(one, fold, moved_only, measure):
    views = one.views(moved_only)
    angles = one.angles(views, fold, moved_only)
    return np.mean([measure(np.delete(angles[i], i)[None]) for i in range(len(views))])


def consensus(one, fold, moved_only, measure, directions):
    """The direction nearest to all others' views, judged by the one left out."""
    angles = one.angles(directions, fold, moved_only)
    total = angles.sum(1)
    columns = range(angles.shape[1])
    best = [int((total - angles[:, i]).argmin()) for i in columns]
    return np.mean([measure(angles[b, i][None, None]) for i, b in zip(columns, best)])


def mean_angle(angles):
    return float(angles.mean())


def within_45(angles):
    return float((angles <= 0.25).mean())


COLUMNS = {"moved, folded": (True, True, mean_angle), "moved": (False, True, mean_angle),
           "all, folded": (True, False, mean_angle), "all": (False, False, mean_angle),
           "within 45°": (True, True, within_45)}


def table(study, ours, alone):
    """name -> column -> one figure a model."""
    d = study.directions

    def chosen(which):
        return lambda m, one, f, mv, me: rows_of(one, f, mv, which[m], me)

    def best_possible(m, one, fold, moved_only, measure):
        angles = one.angles(d, fold, moved_only)
        return measure(angles[int(angles.mean(1).argmin())][None])

    kssm = np.array([d[int(logs[:, 0].argmax())] for logs in study.log_scores])
    rows = {
        "**ours: prior × KSSM**, left-out models": chosen(ours),
        "prior alone, left-out models": chosen(alone),
        "KSSM alone": chosen(kssm),
        "best possible single view": best_possible,
        "consensus of the other people": lambda m, one, f, mv, me: consensus(one, f, mv, me, d),
        "another human": lambda m, one, f, mv, me: another_human(one, f, mv, me)}
    for name, v in FIXED.items():
        rows[name] = chosen([unit(v)] * len(study.people))
    rows["random"] = lambda m, one, f, mv, me: rows_of(one, f, mv, d, me)
    return {name: {column: np.array([row(m, one, *how) for m, one in enumerate(study.people)])
                   for column, how in COLUMNS.items()} for name, row in rows.items()}


def interval(values, draws):
    """95 % bootstrap interval of the mean over models."""
    return np.percentile(values[draws].mean(1), [2.5, 97.5])


def page(study, results, likelihood, fitted, level):
    draws = np.random.default_rng(1).integers(0, len(study.people), (10000, len(study.people)))
    first = "moved, folded"
    lines = [f"{len(study.people)} models, {sum(len(n) for n in study.near)} moved rows, directions of "
             f"level {level}. Error is the mean angle / 180°; in brackets the 95 % interval from "
             "drawing models anew 10 000 times.", "",
             "| view | " + " | ".join(COLUMNS) + " |", "| --- |" + " --- |" * len(COLUMNS)]
    for name, row in results.items():
        low, high = interval(row[first], draws)
        cells = [f"{row[c].mean():.3f}" for c in COLUMNS]
        cells[0] += f" [{low:.3f}, {high:.3f}]"
        cells[-1] = f"{100 * row['within 45°'].mean():.0f} %"
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    ours = next(iter(results.values()))[first]
    lines += ["", "Differences on the same models (moved, folded; negative: ours is nearer to people):", "",
              "| ours minus | mean | 95 % interval |", "| --- | --- | --- |"]
    for name in ("three-quarter (1, 0.6, 1)", "another human", "prior alone, left-out models",
                 "KSSM alone", "isometric (1, 1, 1)", "straight front (+Z)"):
        difference = ours - results[name][first]
        low, high = interval(difference, draws)
        lines.append(f"| {name} | {difference.mean():+.3f} | [{low:+.3f}, {high:+.3f}] |")
    low, high = interval(likelihood[:, 0] - likelihood[:, 1], draws)
    lines += ["", f"Log likelihood of a left-out model's rows over a uniform choice, folded: "
              f"{likelihood[:, 0].mean():.3f} nats a row with KSSM, {likelihood[:, 1].mean():.3f} with "
              f"the prior alone (difference in [{low:+.3f}, {high:+.3f}]).", "",
              "| model | ours | prior alone | KSSM alone | three-quarter | another human | best possible |",
              "| --- | --- | --- | --- | --- | --- | --- |"]
    names = ["**ours: prior × KSSM**, left-out models", "prior alone, left-out models", "KSSM alone",
             "three-quarter (1, 0.6, 1)", "another human", "best possible single view"]
    for m, one in enumerate(study.people):
        lines.append(f"| {one.name} | " + " | ".join(f"{results[n][first][m]:.3f}" for n in names) + " |")
    lines += ["", "Constants, fitted on all models:", "", "| constant | value |", "| --- | --- |"]
    lines += [f"| `{name}` | {value:.3f} |" for name, value in fitted.items()]
    return "\n".join(lines) + "\n"


def check(results):
    """The claims of docs/lab/2026-11-prior.md that a change of the method must not break; what fails."""
    mean = {name: row["moved, folded"].mean() for name, row in results.items()}
    ours = mean["**ours: prior × KSSM**, left-out models"]
    rivals = ("three-quarter (1, 0.6, 1)", "prior alone, left-out models", "KSSM alone",
              "isometric (1, 1, 1)", "straight front (+Z)", "random")
    return [f"ours ({ours:.4f}) is not below {name} ({mean[name]:.4f})"
            for name in rivals if not ours < mean[name]]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--vantage", required=True)
    parser.add_argument("--cache", type=pathlib.Path)
    parser.add_argument("--sphere", type=int, default=4)
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--beside", nargs="+", metavar="METHOD", help=f"with --page: {' '.join(BESIDE)}")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        cache = options.cache or pathlib.Path(scratch)
        cache.mkdir(parents=True, exist_ok=True)
        people = read_people(options.folder)

        def fields_of(method):
            return [score_field(options.vantage, options.folder / "models" / one.name, options.sphere, cache, method)
                    for one in people]
        kssm = fields_of("kssm")
        beside_kssm = options.beside or (BESIDE if options.page else [])
        others = {method: fields_of(method) for method in beside_kssm}
    study = Study(people, [kssm])
    everyone = list(range(len(people)))
    ours, alone, likelihood = cross_validate(study)
    results = table(study, ours, alone)
    w = study.fit(everyone)
    fitted = constants(w, study.choose_strength(everyone, w))
    text = page(study, results, likelihood, fitted, options.sphere)
    text += beside_table(people, kssm, others) if others else ""
    print(text)
    if options.page:
        old = options.page.read_text(encoding="utf-8")
        head, rest = old.split(BEGIN)
        options.page.write_text(head + BEGIN + "\n" + text + END + rest.split(END)[1], encoding="utf-8")
    problems = check(results) if options.check else []
    print("\n".join(problems), file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
