#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the Python package costs beside the program, and how soon Ctrl-C is answered.

    PYTHONPATH=build/release/python scripts/measure_python.py PROGRAM MODEL…   prints Markdown tables

Times are medians of alternating runs; CPU seconds are the user's, of the calls alone or of the whole
program.
"""
import os
import pathlib
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import vantage

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "tests/python"))
from heap import bytes_in_use  # noqa: E402

RUNS = 3
MOMENTS = (0.2, 0.7, 1.5, 3.0, 5.0)  # seconds after the start

INTERRUPTED = """
import sys, time
import vantage
stage = ["load"]
print("ready", flush=True)
try:
    model = vantage.load(sys.argv[1])
    while True:
        vantage.best_view(model, contraction=sys.argv[2],
                          progress=lambda name, fraction: stage.__setitem__(0, name))
except KeyboardInterrupt:
    print(time.monotonic(), stage[0], flush=True)
"""


def cpu(who):
    """User seconds so far."""
    return resource.getrusage(who).ru_utime


def by_program(program, model):
    """Wall and CPU seconds of `view --no-images`."""
    with tempfile.TemporaryDirectory() as folder:
        start, before = time.monotonic(), cpu(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "view", model, "--no-images", "-q", "-o", folder + "/out"], check=True)
        return time.monotonic() - start, cpu(resource.RUSAGE_CHILDREN) - before


def by_package(model):
    """Wall and CPU seconds of best_view()."""
    start, before = time.monotonic(), cpu(resource.RUSAGE_SELF)
    vantage.best_view(model)
    return time.monotonic() - start, cpu(resource.RUSAGE_SELF) - before


def compare(program, models):
    print("| model | vertices | program, wall s | package, wall s | program, CPU s | package, CPU s |\n"
          "| --- | --- | --- | --- | --- | --- |")
    for model in models:
        runs = [(by_program(program, model), by_package(model)) for _ in range(RUNS)]
        ours = [statistics.median(run[k][t] for run in runs) for t in (0, 1) for k in (0, 1)]
        print(f"| {pathlib.Path(model).stem} | {len(vantage.load(model).vertices)} | " +
              " | ".join(f"{seconds:.2f}" for seconds in ours) + " |", flush=True)


def interrupt(model, method, moment):
    """Seconds from the signal to the end of the call, and the stage it was in."""
    with subprocess.Popen([sys.executable, "-c", INTERRUPTED, model, method],
                          stdout=subprocess.PIPE, text=True) as child:
        child.stdout.readline()
        time.sleep(moment)
        pressed = time.monotonic()
        child.send_signal(signal.SIGINT)
        words = child.communicate()[0].split()
    return float(words[0]) - pressed, " ".join(words[1:])


def measure_interrupts(models):
    print("\n| model | contraction | Ctrl-C answered after s, at most | in the stage |\n"
          "| --- | --- | --- | --- |")
    for model in models:
        for method in ("auto", "exact"):
            slowest = max(interrupt(model, method, moment) for moment in MOMENTS)
            print(f"| {pathlib.Path(model).stem} | {method} | {slowest[0]:.2f} | {slowest[1]} |", flush=True)


def measure_arrays():
    """Seconds to take a million vertices and two million faces, by type and layout."""
    V = np.random.default_rng(1).random((1_000_000, 3))
    F = np.random.default_rng(2).integers(0, len(V), (2_000_000, 3))
    print("\n| a million vertices, two million faces | s to take them |\n| --- | --- |")
    for name, vertices, faces in (
            ("float64, int64", V, F), ("float64, int32", V, F.astype(np.int32)),
            ("float32, uint32", V.astype(np.float32), F.astype(np.uint32)),
            ("float64 in Fortran order, int64", np.asfortranarray(V), F),
            ("big-endian float64, int64", V.astype(">f8"), F)):
        seconds = []
        for _ in range(RUNS):
            start = time.monotonic()
            vantage.Model(vertices, faces)
            seconds.append(time.monotonic() - start)
        print(f"| {name} | {statistics.median(seconds):.3f} |", flush=True)


def measure_growth():
    """Bytes that malloc has not got back after a thousand calls."""
    ball = vantage.directions(1)
    V, F = ball.directions, ball.triangles
    for _ in range(20):
        vantage.visible_vertices(V, F, sphere=0)
    before = bytes_in_use()
    for _ in range(1000):
        vantage.visible_vertices(V, F, sphere=0)
    print(f"\nA thousand calls of visible_vertices() on {len(V)} vertices left {bytes_in_use() - before} bytes.")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, models = os.path.abspath(sys.argv[1]), sys.argv[2:]
    compare(program, models)
    measure_interrupts(models)
    measure_arrays()
    measure_growth()


if __name__ == "__main__":
    main()
