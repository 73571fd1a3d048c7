#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Chooses the fewest inputs of a fuzzer that reach all that its corpus reaches, as far as so many can.

    choose_inputs.py CONTROL_FILE [--files 60] [--bytes 4000]

CONTROL_FILE is what `-merge=1 -merge_control_file=…` of libFuzzer leaves. Takes again and again the input that reaches most
new edges, then most new counts of edges; the smaller of two. Prints paths, and on standard error how many edges those have
of how many.
"""
import argparse
import pathlib
import sys

COUNTS = 8  # features of an edge: how often it was taken, in eight classes


def read_control(path):
    """The files, and the features that each of them has."""
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    count = int(lines[0])
    files = [pathlib.Path(line) for line in lines[2:2 + count]]
    features = {}
    for line in lines[2 + count:]:
        kind, number, *words = line.split()
        if kind == "FT":
            features[files[int(number)]] = {int(word) for word in words}
    return features


def chosen(candidates, most):
    """Files in the order in which they reach most that is new, until nothing is. \\p candidates: file → what it reaches"""
    left = {file: set(reached) for file, reached in candidates.items()}
    order = []
    while left and len(order) < most:
        best = min(left, key=lambda file: (-len(left[file]), file.stat().st_size, file.name))
        new = left.pop(best)
        if not new:
            break
        order.append(best)
        for reached in left.values():
            reached -= new
    return order


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("control")
    parser.add_argument("--files", type=int, default=60)
    parser.add_argument("--bytes", type=int, default=4000)
    options = parser.parse_args()
    features = read_control(options.control)
    edges = {file: {feature // COUNTS for feature in reached} for file, reached in features.items()}
    small = [file for file in features if file.stat().st_size <= options.bytes]
    order = chosen({file: edges[file] for file in small}, options.files)
    taken = set().union(*(features[file] for file in order))
    order += chosen({file: features[file] - taken for file in small if file not in order}, options.files - len(order))
    for file in order:
        print(file)
    reached = len(set().union(*(edges[file] for file in order)))
    print(f"{len(order)} files, {reached} of {len(set().union(*edges.values()))} edges", file=sys.stderr)


if __name__ == "__main__":
    main()
