#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long each command takes to end after Ctrl-C, at moments spread evenly over its run.

    measure_interrupts.py MODEL [--program build/release/apps/vantage/vantage] [--moments 8] [--python PACKAGE_FOLDER]

Prints a table: seconds that the command runs alone, slowest and mean answer. With --python also vantage.load() and the
functions of the package. Exit code 1 if an answer took more than a second.
"""
import argparse
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

COMMANDS = {
    "info": ["info", "MODEL"],
    "view": ["view", "MODEL", "-o", "out"],
    "map": ["map", "MODEL", "-o", "map.ply"],
    "skeleton": ["skeleton", "MODEL", "-o", "s.json"],
    "score": ["score", "MODEL", "--sphere", "3", "-o", "s.csv"],
    "score (measures)": ["score", "MODEL", "--sphere", "3", "--method", "vmi,silhouette-length", "-o", "s.csv"],
    "compare": ["compare", "MODEL", "-o", "c", "--method", "kssm,silhouette-length"],
    "render": ["render", "MODEL", "--view", "best", "-o", "r.png"],
    "thumb": ["thumb", "MODEL", "t.png"],
    "figures": ["figures", "MODEL", "-o", "f"],
}
CALL = """
import sys
sys.path.insert(0, {package!r})
import vantage
model = vantage.load({model!r})
print("ready", flush=True)
try:
    vantage.{function}(model)
except KeyboardInterrupt:
    sys.exit(130)
"""
FUNCTIONS = ("kssm", "skeleton", "best_view", "score")
LIMIT_S = 1.0


def start(command, folder):
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def answers(command, moments, wait_for_line):
    """Seconds alone; seconds from the signal to the end at each moment."""
    with tempfile.TemporaryDirectory() as folder:
        process = start(command, folder)
        if wait_for_line:
            process.stdout.readline()
        begun = time.monotonic()
        process.communicate()
        alone = time.monotonic() - begun
    taken = []
    for i in range(moments):
        with tempfile.TemporaryDirectory() as folder:
            process = start(command, folder)
            if wait_for_line:
                process.stdout.readline()
            time.sleep(alone * (i + 0.5) / moments)
            sent = time.monotonic()
            process.send_signal(signal.SIGINT)
            process.communicate()
            if process.returncode == 130:
                taken.append(time.monotonic() - sent)
    return alone, taken


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/apps/vantage/vantage")
    parser.add_argument("--moments", type=int, default=8)
    parser.add_argument("--only", nargs="*", default=[], help="these rows alone")
    parser.add_argument("--python", default="")
    options = parser.parse_args()
    model = str(options.model.resolve())
    rows = [(name, [str(pathlib.Path(options.program).resolve()), *(model if w == "MODEL" else w for w in words)], False)
            for name, words in COMMANDS.items() if not options.only or name in options.only]
    if options.python:
        package = os.path.abspath(options.python)
        rows += [(f"vantage.{function}()", ["/usr/bin/python3", "-c", CALL.format(package=package, model=model,
                                                                                  function=function)], True)
                 for function in FUNCTIONS]
    late = False
    print("| command | alone, s | slowest answer, s | mean, s | interrupted |\n| --- | ---: | ---: | ---: | ---: |")
    for name, command, waits in rows:
        alone, taken = answers(command, options.moments, waits)
        slowest = max(taken, default=0.0)
        late = late or slowest > LIMIT_S
        mean = sum(taken) / max(len(taken), 1)
        print(f"| `{name}` | {alone:.2f} | {slowest:.2f} | {mean:.2f} | {len(taken)}/{options.moments} |", flush=True)
    sys.exit(1 if late else 0)


if __name__ == "__main__":
    main()
