#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures skeletons against their surfaces and prints the table of docs/lab/2026-11-skeleton.md as Markdown.

    measure_skeleton.py PROGRAM MODEL...

One row a closed model; open ones and files that cannot be read are passed over with a note on stderr.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

COLUMNS = ("model", "nodes", "edges", "components", "cycles / genus", "ends", "outside %", "of it thin %",
           "farthest / radius", "farthest / D %", "off centre", "seen %")


def measure(program, model, folder):
    done = subprocess.run([program, "skeleton", model, "-o", folder + "/s.json", "--measure", "--json"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(f"{model}: {done.stderr.strip()}", file=sys.stderr)
        return None
    return json.loads(done.stdout)


def row(model, r):
    q = r["quality"]
    return (pathlib.Path(model).name, r["nodes"], r["edges"], r["components"],
            f"{r['cycles']} / {r['genus']}", q["ends"], f"{100 * q['outside_fraction']:.2f}",
            f"{100 * q['thin_outside_fraction']:.2f}", f"{q['farthest_over_radius']:.2f}",
            f"{100 * q['farthest_over_diameter']:.1f}", f"{q['off_centre']:.2f}",
            f"{100 * q['seen_fraction']:.1f}")


def main(program, *models):
    print("| " + " | ".join(COLUMNS) + " |")
    print("| --- " * len(COLUMNS) + "|")
    outside, wrong = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            r = measure(program, model, folder)
            if r is None or not r["closed"]:
                print(f"{model}: passed over, not closed", file=sys.stderr)
                continue
            print("| " + " | ".join(map(str, row(model, r))) + " |", flush=True)
            outside.append(r["quality"]["outside_fraction"])
            wrong += r["cycles"] != r["genus"]
    print(f"\n{len(outside)} closed models; nothing outside on {sum(x == 0 for x in outside)}, "
          f"at most 2 % on {sum(x <= 0.02 for x in outside)}; cycles other than the genus on {wrong}.")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
