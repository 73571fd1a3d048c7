#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lets every call of `view`, `batch`, a shard, the merge and `serve` that writes fail in turn, or kills the process
there, and finishes each run afterwards: what was injected, what came of it, and whether the end was that of an
undisturbed run. Markdown on stdout; exit code 1 if anything was not.

    scripts/inject_faults.py build/release/apps/vantage/vantage build/release/tests/cli/libvantage_fail_at_call.so
                             [--most N] [--only JOB]
"""

import argparse
import collections
import os
import pathlib
import sys
import tempfile


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("shim", type=pathlib.Path)
    parser.add_argument("--most", type=int, default=10**9, help="calls of each job and error that fail, evenly spread")
    parser.add_argument("--only", default="", help="only jobs of this name")
    arguments = parser.parse_args()
    os.environ["VANTAGE"] = str(arguments.program.resolve())
    os.environ["VANTAGE_FAULT_SHIM"] = str(arguments.shim.resolve())
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "cli"))
    import faults  # reads both from the environment
    from shapes import write_fault_models
    problems = []
    print("| job | calls | fault | injected | came of it | finished as undisturbed |\n| --- | ---: | --- | ---: | --- | ---: |")
    for kind in faults.JOBS:
        if arguments.only and kind.name != arguments.only:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            write_fault_models(pathlib.Path(scratch))
            job = kind(scratch)
            whole, usual, calls = job.undisturbed()
            for error, stays in [(error, False) for error in faults.ERRORS] + [("ENOSPC", True)]:
                outcomes = collections.Counter()
                finished = 0
                for call in faults.sampled(calls, arguments.most):
                    try:
                        outcomes[job.disturbed(call, error, whole, usual, stays)] += 1
                        finished += 1
                    except faults.Broken as problem:
                        outcomes["broken"] += 1
                        problems.append(str(problem))
                told = ", ".join(f"{outcome}: {count}" for outcome, count in outcomes.most_common())
                print(f"| {job.name} | {calls} | {error}{' and after' if stays else ''} | {sum(outcomes.values())} | {told} | "
                      f"{finished} |", flush=True)
    for problem in problems:
        print(problem[:2000], file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
