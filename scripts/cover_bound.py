#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How far the greedy choice of views is from the fewest that cover as much.

usage: cover_bound.py [--program VANTAGE] [--coverage 0.95] [--level 4] [--seconds 120] MODEL...

For each model, on the directions of the icosahedron split LEVEL times: greedy N (the program's, off
the candidates and refined, and greedy on the candidates alone), the program's own bound, and a bound
from linear programming: no N views whatsoever of the candidates cover more than the optimum of the
relaxation, which is solved in its Lagrangian form
    max over sets of N views of coverage <= sum over vertices (w - l) + the N largest column sums of l,
for any multipliers 0 <= l <= w; subgradient steps make it small. Every step gives a valid bound,
whether it has converged or not. Where vertices fall into few classes that the same views see, the
relaxation is also solved exactly by HiGHS. Needs NumPy and SciPy (Debian: python3-scipy).
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy
import scipy.optimize
import scipy.sparse

LARGEST_EXACT = 300_000  # nonzeros that HiGHS solves within about a minute
MOST_CLASSES = 12_000    # classes of vertices kept apart; more are merged, which loosens the bound


def load(path, directions):
    """Weights and a 0/1 matrix, classes of equally seen vertices x directions."""
    table = numpy.load(path)
    seen, index = numpy.unique(table["seen"], axis=0, return_inverse=True)
    weight = numpy.bincount(index, weights=table["significance"], minlength=len(seen))
    bits = numpy.unpackbits(seen, axis=1, bitorder="little")[:, :directions]
    useful = (bits.any(axis=1)) & (weight > 0)
    weight, bits = weight[useful], bits[useful]
    if len(weight) > MOST_CLASSES:
        weight, bits = merged(weight, bits)
    return weight / weight.sum(), bits


def merged(weight, bits):
    """Fewer classes, each seen by whoever sees one of its members: a relaxation, so bounds hold."""
    rank = numpy.argsort(bits.astype(numpy.float32) @ numpy.linspace(0, 1, bits.shape[1], dtype=numpy.float32))
    groups = numpy.array_split(rank, MOST_CLASSES)
    return (numpy.array([weight[g].sum() for g in groups]),
            numpy.array([bits[g].max(axis=0) for g in groups]))


def greedy(weight, bits, coverage):
    """Number of candidates that the plain greedy choice needs."""
    unseen, count = weight.astype(numpy.float64).copy(), 0
    matrix = bits.astype(numpy.float32)
    while unseen.sum() > (1 - coverage) + 1e-12:
        best = int(numpy.argmax(unseen.astype(numpy.float32) @ matrix))
        unseen[bits[:, best] != 0] = 0
        count += 1
    return count


def lagrangian_least(weight, bits, coverage, upper, deadline):
    """Largest N such that N - 1 views cannot cover `coverage`, and the bound on what N - 1 cover."""
    matrix = numpy.ascontiguousarray(bits.astype(numpy.float32))
    least, shown = 1, 0.0
    for count in range(1, upper):
        bound = most_covered(weight, matrix, count, coverage, deadline)
        if bound >= coverage:
            break
        least, shown = count + 1, bound
    return least, shown


def most_covered(weight, matrix, count, target, deadline):
    """Upper bound on what `count` columns cover: projected subgradient with Polyak steps."""
    multipliers = weight * 0.5
    best, goal, waited = math.inf, target * 0.98, 0
    for _ in range(3000):
        sums = multipliers.astype(numpy.float32) @ matrix
        columns = numpy.argpartition(sums, -count)[-count:]
        value = (weight - multipliers).sum() + float(sums[columns].sum(dtype=numpy.float64))
        if value < best - 1e-5:
            best, waited = value, 0
        else:
            waited += 1
        if best < target - 1e-4 or waited > 250 or time.monotonic() > deadline:
            break
        slope = matrix[:, columns].sum(axis=1) - 1.0
        # in units of the weights: vertices of little weight need small steps
        step = 0.7 * max(value - goal, 1e-4) / float((slope * slope * weight).sum())
        multipliers = numpy.clip(multipliers - step * slope * weight, 0.0, weight)
    return best + 1e-6  # single-precision sums


def exact_relaxation(weight, bits, coverage, seconds):
    """Optimum of min sum x, y <= A x, w y >= coverage, 0 <= x, y <= 1; None if not solved in time."""
    rows, columns = bits.shape
    cover = scipy.sparse.hstack([-scipy.sparse.csr_matrix(bits, dtype=float),
                                 scipy.sparse.identity(rows)])
    wanted = scipy.sparse.hstack([scipy.sparse.csr_matrix((1, columns)),
                                  scipy.sparse.csr_matrix(-weight[None, :])])
    done = scipy.optimize.linprog(
        numpy.r_[numpy.ones(columns), numpy.zeros(rows)],
        A_ub=scipy.sparse.vstack([cover, wanted]).tocsr(),
        b_ub=numpy.r_[numpy.zeros(rows), -coverage], bounds=(0, 1), method="highs",
        options={"time_limit": seconds})
    return done.fun if done.status == 0 else None


def measure(arguments, model, scratch):
    """One row of the table."""
    program = [arguments.program]
    subprocess.run([*program, "view", model, "-o", scratch / "out", "--no-images", "-q",
                    "--coverage", str(arguments.coverage)], check=True)
    found = json.loads((scratch / "out" / "view.json").read_text())
    subprocess.run([*program, "score", model, "--sphere", str(arguments.level), "--visible",
                    scratch / "seen.npy", "-o", scratch / "scores.csv"], check=True)
    directions = 10 * 4 ** arguments.level + 2
    weight, bits = load(scratch / "seen.npy", directions)
    on_candidates = greedy(weight, bits, arguments.coverage)
    relaxed = None
    if bits.sum() <= LARGEST_EXACT:
        relaxed = exact_relaxation(weight, bits, arguments.coverage, arguments.seconds)
    if relaxed is not None:
        least, how = math.ceil(relaxed - 1e-7), f"HiGHS {relaxed:.2f}"
    else:
        least, shown = lagrangian_least(weight, bits, arguments.coverage, on_candidates,
                                        time.monotonic() + arguments.seconds)
        how = f"{least - 1} cover at most {100 * shown:.2f} %" if least > 1 else "one may cover it"
    return (model.stem, found["model"]["vertices"], len(weight), len(found["views"]), on_candidates,
            found["view_set"]["least_views"], least, how)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/apps/vantage/vantage")
    parser.add_argument("--coverage", type=float, default=0.95)
    parser.add_argument("--level", type=int, default=4)
    parser.add_argument("--seconds", type=float, default=120.0, help="at most, for the bound of one model")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    print("| model | vertices | classes | greedy | on candidates | own bound | LP bound | how |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as scratch:
            row = measure(arguments, model.resolve(), pathlib.Path(scratch))
        print("| " + " | ".join(str(cell) for cell in row) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
