#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the significance maps taken to the raw and to the finished skeleton.

    compare_graphs.py PROGRAM MODEL...

One row a model, as Markdown: Spearman's correlation of the two maps, and what the best view of one scores
under the other's map, against that map's own best view. Best is what scores most, whatever people would take
(--objective significance); a ratio above 1 is by how much the search missed.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

GRAPHS = ("raw", "finished")


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=True)
    return done.stdout


def quality(path):
    """The map's values from a binary PLY of ours."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    codes = {"float": "f", "double": "d", "uchar": "B"}
    count, names, layout = 0, [], "<"
    for line in head.decode().splitlines():
        word = line.split()
        if word[:2] == ["element", "vertex"]:
            count = int(word[2])
        elif word[0] == "property" and word[1] in codes:
            names.append(word[2])
            layout += codes[word[1]]
    row = struct.Struct(layout)
    column = names.index("quality")
    return [row.unpack_from(body, i * row.size)[column] for i in range(count)]


def ranks(values):
    """Ranks, the mean one where values are equal."""
    order = sorted(range(len(values)), key=values.__getitem__)
    result = [0.0] * len(values)
    start = 0
    for end in range(1, len(order) + 1):
        if end == len(order) or values[order[end]] != values[order[start]]:
            for i in order[start:end]:
                result[i] = 0.5 * (start + end - 1)
            start = end
    return result


def spearman(a, b):
    a, b = ranks(a), ranks(b)
    mean = 0.5 * (len(a) - 1)
    covariance = sum((x - mean) * (y - mean) for x, y in zip(a, b))
    spread = sum((x - mean) ** 2 for x in a) * sum((y - mean) ** 2 for y in b)
    return covariance / spread ** 0.5


def row(program, model, folder):
    maps, best = {}, {}
    for graph in GRAPHS:
        run(program, "map", model, "-o", folder / f"{graph}.ply", "--graph", graph)
        maps[graph] = quality(folder / f"{graph}.ply")
        report = run(program, "view", model, "-o", folder / "view", "--no-images", "--json",
                     "--objective", "significance", "--graph", graph)
        best[graph] = json.loads(report)["best"]["direction"]
    (folder / "directions.csv").write_text(
        "dx,dy,dz\n" + "".join(",".join(map(repr, best[graph])) + "\n" for graph in GRAPHS))
    ratios = []
    for graph in GRAPHS:
        lines = run(program, "score", model, "--directions", folder / "directions.csv",
                    "--graph", graph).split()[1:]
        raw, finished = (float(line.split(",")[-1]) for line in lines)
        ratios.append(finished / raw if graph == "raw" else raw / finished)
    return (pathlib.Path(model).name, f"{spearman(maps['raw'], maps['finished']):.3f}",
            f"{ratios[0]:.3f}", f"{ratios[1]:.3f}")


def main(program, *models):
    print("| model | Spearman | finished's best view under raw | raw's best view under finished |")
    print("| --- | --- | --- | --- |")
    for model in models:
        with tempfile.TemporaryDirectory() as folder:
            print("| " + " | ".join(row(program, model, pathlib.Path(folder))) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
