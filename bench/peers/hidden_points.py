#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Visible points of a cloud by two rules against those of the mesh they came from.

    bench/peers/hidden_points.py build/release/bench/visible_points MODEL…

Ours hides points behind triangles of the local Delaunay rings. The other rule is the hidden point removal of
Katz, Tal, Basri, "Direct Visibility of Point Sets", SIGGRAPH 2007: points are flipped about a sphere around the
eye, and those on the convex hull are seen; the sphere's radius over the farthest point's distance is 10^γ, with
γ = 2 as they suggest, and the best of 1 to 4 for each model, which only the mesh can tell.
Twelve eyes a model; precision: of the points said to be seen, the share that is; recall: of the points seen, the
share that is found. Needs numpy and scipy."""
import subprocess
import sys

import numpy
from scipy.spatial import ConvexHull

GAMMAS = (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0)


def katz(points, eye, gamma):
    rays = points - eye
    length = numpy.linalg.norm(rays, axis=1, keepdims=True)
    flipped = rays + 2 * (length.max() * 10 ** gamma - length) * rays / length
    hull = ConvexHull(numpy.concatenate([flipped, numpy.zeros((1, 3))]))
    seen = numpy.zeros(len(points) + 1, bool)
    seen[hull.vertices] = True
    return seen[:-1]


def agreement(found, truth):
    """Precision, recall, and their harmonic mean."""
    both = (found & truth).sum()
    precision, recall = both / max(1, found.sum()), both / max(1, truth.sum())
    return precision, recall, 2 * precision * recall / max(1e-9, precision + recall)


def text(values):
    return " / ".join(f"{v:.3f}" for v in values)


def main(program, *models):
    print("| model | points | ours: precision / recall / F | Katz, γ = 2 | Katz, best γ | which |")
    print("| --- | --- | --- | --- | --- | --- |")
    for model in models:
        lines = subprocess.run([program, model], capture_output=True, text=True, check=True).stdout.splitlines()
        count = int(lines[0])
        points = numpy.array([line.split() for line in lines[1:count + 1]], float)
        ours, peers = [], {gamma: [] for gamma in GAMMAS}
        for line in lines[count + 1:]:
            *eye, of_mesh, of_cloud = line.split()
            truth, found = (numpy.frombuffer(s.encode(), "u1") == ord("1") for s in (of_mesh, of_cloud))
            ours.append(agreement(found, truth))
            for gamma in GAMMAS:
                peers[gamma].append(agreement(katz(points, numpy.array(eye, float), gamma), truth))
        means = {gamma: numpy.mean(values, axis=0) for gamma, values in peers.items()}
        best = max(means, key=lambda gamma: means[gamma][2])
        print(f"| {model.rsplit('/', 1)[-1]} | {count} | {text(numpy.mean(ours, axis=0))} | {text(means[2.0])} "
              f"| {text(means[best])} | {best} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
