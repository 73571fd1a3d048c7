# SPDX-License-Identifier: MIT
"""Gradient boosting of the softmax over the candidates of each model, for fit_orientation.py (numpy)."""
import numpy as np


def softmax(scores):
    odds = np.exp(scores - scores.max(1, keepdims=True))
    return odds / odds.sum(1, keepdims=True)


class Boosting:
    """Trees of few leaves, each split where it gains most, fitted one after the other."""

    def __init__(self, rounds, leaves, rate=0.2, ridge=3.0, fewest=30, bins=24, share=0.2, seed=1):
        self.rounds, self.leaves, self.rate, self.ridge = rounds, leaves, rate, ridge
        self.fewest, self.bins, self.share, self.seed = fewest, bins, share, seed
        self.trees = []

    def fit(self, inputs, target, weight):
        models, candidates, width = inputs.shape
        flat = inputs.reshape(-1, width)
        quantiles = np.linspace(0, 1, self.bins + 1)[1:-1]
        self.edges = [np.unique(np.round(np.quantile(flat[:, j], quantiles), 4)) for j in range(width)]
        self.bin_of = np.stack([np.searchsorted(self.edges[j], flat[:, j], side="right")
                                for j in range(width)], 1).astype(np.int32)
        scores = np.zeros(models * candidates)
        random = np.random.default_rng(self.seed)
        for _ in range(self.rounds):
            odds = softmax(scores.reshape(models, candidates))
            self.slope = ((target - odds) * weight[:, None]).ravel()
            self.bend = (odds * (1 - odds) * weight[:, None]).ravel() + 1e-6
            columns = np.sort(random.choice(width, max(1, int(width * self.share)), replace=False))
            tree, values = self.grow(columns)
            scores += values
            self.trees.append(tree)
        return self

    def best_split(self, rows, columns):
        """Gain, column and bin of the best split; the column is None if none gains."""
        slope, bend = self.slope[rows], self.bend[rows]
        shape = (len(columns), self.bins)
        at = (self.bin_of[np.ix_(rows, columns)] + np.arange(len(columns)) * self.bins).ravel()

        def below(values):
            weights = None if values is None else np.repeat(values, len(columns))
            return np.bincount(at, weights, len(columns) * self.bins).reshape(shape).cumsum(1)[:, :-1]

        low, low_bend, number = below(slope), below(bend), below(None)
        gain = (low**2 / (low_bend + self.ridge)
                + (slope.sum() - low) ** 2 / (bend.sum() - low_bend + self.ridge)
                - slope.sum() ** 2 / (bend.sum() + self.ridge))
        gain[(number < self.fewest) | (len(rows) - number < self.fewest)] = -1
        i, k = divmod(int(gain.argmax()), self.bins - 1)
        if gain[i, k] <= 1e-3 or k >= len(self.edges[columns[i]]):
            return 0.0, None, None
        return gain[i, k], int(columns[i]), k

    def grow(self, columns):
        root = {"rows": np.arange(len(self.bin_of))}
        leaves = [root]
        root["split"] = self.best_split(root["rows"], columns)
        while len(leaves) < self.leaves:
            leaf = max(leaves, key=lambda one: one["split"][0])
            _, column, k = leaf["split"]
            if column is None:
                break
            above = self.bin_of[leaf["rows"], column] > k
            leaf["column"], leaf["limit"] = column, float(self.edges[column][k])
            leaf["below"], leaf["above"] = {"rows": leaf["rows"][~above]}, {"rows": leaf["rows"][above]}
            leaves.remove(leaf)
            for part in (leaf["below"], leaf["above"]):
                part["split"] = self.best_split(part["rows"], columns)
                leaves.append(part)
        values = np.zeros(len(self.bin_of))
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

    def scaled(self, factor):
        """The same with all leaves times a factor."""
        def times(tree):
            if not isinstance(tree, tuple):
                return round(tree * factor, 3)
            return (tree[0], tree[1], times(tree[2]), times(tree[3]))

        self.trees = [times(tree) for tree in self.trees]
        return self

    def text(self, names):
        columns = list(names) + [f"{name}-opposite" for name in names] + [f"{name}-mean" for name in names]

        def words(tree):
            if not isinstance(tree, tuple):
                return f"{tree:g}"
            return f"{columns[tree[0]]} {tree[1]:g} {words(tree[2])} {words(tree[3])}"

        return [words(tree) for tree in self.trees]


def numbers_in(tree):
    return 1 if not isinstance(tree, tuple) else 1 + numbers_in(tree[2]) + numbers_in(tree[3])
