# SPDX-License-Identifier: MIT
"""Labelled models as what fit_orientation.py fits and measures: inputs, what is right, rules (numpy)."""
import numpy as np

from boosting import softmax

AXES = ["x", "-x", "y", "-y", "z", "-z"]
OPPOSITE = np.array([1, 0, 3, 2, 5, 4])
ALIKE = 0.1  # kAlike of src/orientation/orientation.cpp
HARM = 0.01
FOLDS = 5
COPIES = 2
SERIES = 0.25  # mean difference of the features of two models of one series, in standard deviations
SCALES = np.arange(0.7, 1.51, 0.05)
LOG_ODDS = np.arange(0.0, 5.01, 0.25)
THRESHOLDS = np.arange(0.3, 0.96, 0.05)


def mean(values, counts):
    """Mean of what is known, by what each counts."""
    known = ~np.isnan(values)
    total = (counts * known).sum()
    return float((np.nan_to_num(values) * counts).sum() / total) if total > 0 else np.nan


def interval(values, counts, series, times=1000):
    """95 % of the means of series drawn with replacement (bootstrap)."""
    random = np.random.default_rng(1)
    known = ~np.isnan(values)
    sums = np.bincount(series, np.nan_to_num(values) * counts)
    totals = np.bincount(series, counts * known)
    sums, totals = sums[totals > 0], totals[totals > 0]
    if not len(sums):
        return np.nan, np.nan
    drawn = random.integers(len(sums), size=(times, len(sums)))
    return np.quantile(sums[drawn].sum(1) / totals[drawn].sum(1), [0.025, 0.975])


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
    for far in (0.0, 0.6 if of_front else 1.2):  # kFar of src/orientation/measured_sides.h
        copy = plain.copy()
        copy[:, :, height], copy[:, :, aside] = 0.5, far
        if far == 0.0:
            copy[:, :, pictures] = 0.0
        copies.append(copy)
    return copies


def origin_at_walls(plain, names, up_axis):
    """As if the origin were in the middle of a side that is neither ground nor top, as of things hung on walls."""
    height, aside = names.index("origin_height"), names.index("origin_aside")
    random = np.random.default_rng(5)
    copy = plain.copy()
    for model, axis in zip(copy, up_axis):
        origin = np.full(3, 0.5)
        origin[random.choice([k for k in range(3) if k != axis])] = random.integers(2)
        off = np.abs(origin - 0.5)
        for candidate in range(6):
            k = candidate // 2
            model[candidate, height] = origin[k] if candidate % 2 == 0 else 1.0 - origin[k]
            model[candidate, aside] = off.sum() - off[k]
    return copy


def series_of(rows):
    """A number for each model, the same for near copies within one archive."""
    plain = np.array([ups_of(row["features"]) for row in rows])
    scaled = (plain / (plain.reshape(-1, plain.shape[2]).std(0) + 1e-9)).reshape(len(plain), -1)
    group = np.array([row["group"] for row in rows])
    series = np.arange(len(rows))
    for i in range(len(rows)):
        for j in np.nonzero((group == group[i]) & (np.abs(scaled - scaled[i]).mean(1) < SERIES))[0]:
            series[series == series[j]] = series[i]
    return series


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


def alike_ups(features):
    """As find_up() of src/orientation/orientation.cpp compares directions."""
    fronts = {(c["up"], c["front"]): c for c in features["fronts"]}
    same = np.eye(6, dtype=bool)
    for a in range(6):
        for b in range(6):
            is_opposite = a // 2 == b // 2
            about = (a // 2 + 1) % 3 if is_opposite else 3 - a // 2 - b // 2
            difference = fronts[AXES[2 * about], AXES[a]]["back_difference" if is_opposite else "side_difference"]
            same[a, b] |= difference < ALIKE
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
        if not of_front:
            self.more.append(widened(origin_at_walls(plain, names, [AXES.index(row["up"]) // 2 for row in self.rows])))
        self.more += [widened(np.array([values(row["copies"][k], row["up"]) for row in self.rows]))
                      for k in range(COPIES)]
        directions = [ring_around(row["up"]) if of_front else AXES for row in self.rows]
        self.truth = np.array([d.index(row["front" if of_front else "up"]) for d, row in zip(directions, self.rows)])
        self.alike = np.array([alike_fronts(fronts_of(row["features"], row["up"])) if of_front
                               else alike_ups(row["features"]) for row in self.rows])
        # Of up also the front that the convention has, and the odds of each if that up is right.
        self.front = np.array([ring_around(row["up"]).index(row["front"]) if row["front"] else -1 for row in self.rows])
        self.front_odds = None
        self.known_models = {}
        # Models x candidates. A box upside down counts as wrong, back to front as right.
        self.right = self.alike[np.arange(len(self.truth)), self.truth] if of_front \
            else np.eye(6, dtype=bool)[self.truth]
        self.target = self.right / self.right.sum(1, keepdims=True)
        counts = {g: sum(r["group"] == g for r in self.rows) for g in {r["group"] for r in self.rows}}
        # A hundred airliners are not a hundred kinds of thing.
        self.weight = np.array([1.0 if r["group"].startswith("catalogue") else min(1.0, 60 / counts[r["group"]])
                                for r in self.rows])
        self.catalogue = np.array([r["group"].startswith("catalogue") for r in self.rows])
        _, first, of_row, count = np.unique([r["series"] for r in self.rows], return_index=True, return_inverse=True,
                                            return_counts=True)
        self.fold = np.array([int(r["fold"]) % FOLDS for r in self.rows])[first][of_row]
        # What a model counts in choosing the rule: nobody knows how the others' conventions would face.
        self.series = of_row
        self.counts = self.weight / count[of_row] * (self.front >= 0)

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
        return [names == name for name in sorted(set(names))]

    def fitted(self, make, mask):
        if mask.tobytes() not in self.known_models:
            self.known_models[mask.tobytes()] = self.newly_fitted(make, mask)
        return self.known_models[mask.tobytes()]

    def newly_fitted(self, make, mask):
        inputs = np.concatenate([self.inputs[mask]] + [copy[mask] for copy in self.more])
        count = len(self.more)
        return make().fit(inputs, np.tile(self.target[mask], (1 + count, 1)),
                          np.concatenate([self.weight[mask] / 2] + [self.weight[mask] / 2 / count] * count))

    def conventions(self, log_odds, share):
        """(convention's candidate, models that it has right, what it adds to the odds) of each convention."""
        rows = np.arange(len(self.rows))
        count = self.inputs.shape[1]
        for usual in range(count):
            if self.of_front:
                yield usual, self.right[:, usual], log_odds * np.eye(count)[usual]
                continue
            for front in range(4):
                facing = np.log(1 - share + share * 4 * self.front_odds[rows, usual, front])
                yield (usual, (self.truth == usual) & (self.front == front),
                       (log_odds + facing)[:, None] * np.eye(count)[usual])

    def decided(self, scores, log_odds, threshold, share=0.0):
        """For each convention: the models it has right, and the candidates taken."""
        rows = np.arange(len(scores))
        for usual, has_right, added in self.conventions(log_odds, share):
            odds = np.minimum(np.einsum("mab,mb->ma", self.alike, softmax(scores + added)), 1.0)
            best = odds.argmax(1)
            best = np.where(odds[:, usual] >= odds.max(1) - 1e-9, usual, best)
            yield has_right, np.where(odds[rows, best] >= threshold, best, usual)

    def outcomes(self, scores, log_odds, threshold, share=0.0):
        """Of each model the share of turns in which it comes out right, and of those that a convention has right
        (NaN: none has)."""
        turned, kept, of, count = (np.zeros(len(scores)) for _ in range(4))
        for has_right, taken in self.decided(scores, log_odds, threshold, share):
            ok = self.right[np.arange(len(scores)), taken]
            turned, count = turned + ok, count + 1
            kept, of = kept + (ok & has_right), of + has_right
        return turned / count, np.where(of > 0, kept / np.maximum(of, 1), np.nan)

    def grid(self, scores, share):
        """(log_odds, threshold, outcomes) of every rule. Of fronts the log odds are what the share of files that face as
        their format's do says: a larger one would call sure what it is not."""
        conventions_log_odds = [round(np.log(3 * share / (1 - share)), 2)] if self.of_front else LOG_ODDS
        return [(float(w), round(float(t), 2), self.outcomes(scores, w, t, share))
                for w in conventions_log_odds for t in THRESHOLDS]

    def choose_scale(self, scores):
        """Factor of the log odds with the least log loss."""
        def loss(scale):
            return -(np.log((softmax(scale * scores) * self.right).sum(1)) * self.weight).sum()

        return round(float(min(SCALES, key=loss)), 2)

    def choose_rule(self, grid, counts=None, harm=HARM):
        """Witness and threshold that get the most turned models right at no more harm, and the rate."""
        counts = self.counts if counts is None else counts
        best = (-1.0, 8.0, 0.99)
        for log_odds, threshold, (turned, kept) in grid:
            rate = mean(turned, counts)
            if 1.0 - mean(kept, counts) <= harm and rate > best[0] + 1e-12:
                best = (rate, log_odds, threshold)
        return best[1:] + best[:1]

    def rule_left_out(self, grid):
        """Turned right, and harm, of each archive by the rule chosen on the others, as models count."""
        turned, kept = (np.full(len(self.rows), np.nan) for _ in range(2))
        for part in self.archives():
            log_odds, threshold, _ = self.choose_rule(grid, self.counts * ~part)
            found = next(o for w, t, o in grid if (w, t) == (log_odds, threshold))
            turned[part], kept[part] = found[0][part], found[1][part]
        return turned, kept

    def given_up(self, scores, log_odds, threshold, share):
        """Of each model the share with the right front, turned at random, its up given."""
        rows = np.arange(len(scores))
        # One in six has its format's up; y and z have a usual front then, too; four have none.
        own = self.outcomes(scores, log_odds, threshold)[0]
        usual = self.outcomes(scores, np.log(3 * share / (1 - share)), 0.0)[0]
        alone = self.right[rows, np.einsum("mab,mb->ma", self.alike, softmax(scores)).argmax(1)]
        return own / 6 + usual / 6 + 4 * alone / 6
