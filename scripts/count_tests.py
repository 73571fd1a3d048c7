#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many tests the last run of ctest in a build folder was made of, and which of them were skipped: in a build from
nothing one process runs many.

    scripts/count_tests.py build/release
"""

import pathlib
import re
import sys

COUNTS = (r"^\[==========\] (\d+) tests? from .* ran",  # GoogleTest
          r"^Ran (\d+) tests? in ",  # unittest
          r"^(\d+) passed",  # pytest
          r"^(?:#|\u2139) tests (\d+)$")  # node
SKIPPED = (r"^\[  SKIPPED \] (\S+) \(", r"^(SKIPPED \[\d+\] .*)$", r"^(\w+) \(.* skipped ")


def runs_of(log):
    """Name and output of each process."""
    parts = re.split(r"^\d+/\d+ Testing: (.*)$", log, flags=re.MULTILINE)
    return zip(parts[1::2], parts[2::2])


def main(folder):
    log = (pathlib.Path(folder) / "Testing/Temporary/LastTest.log").read_text(errors="replace")
    processes = tests = 0
    skipped = []
    for name, output in runs_of(log):
        processes += 1
        counts = [int(n) for pattern in COUNTS for n in re.findall(pattern, output, re.MULTILINE)]
        tests += sum(counts) if counts else 1
        skipped += [f"{name}: {one}" for pattern in SKIPPED for one in re.findall(pattern, output, re.MULTILINE)]
    print(f"{tests} tests in {processes} processes, {len(skipped)} of them skipped")
    for one in skipped:
        print(f"  skipped: {one}")


if __name__ == "__main__":
    main(*sys.argv[1:])
