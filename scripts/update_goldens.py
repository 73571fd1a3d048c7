#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the golden pictures of tests/golden/pictures anew: update_goldens.py PROGRAM.

A commit that changes them says why; tests/cli/test_pictures.py compares them.
"""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
GOLDENS = ROOT / "tests/golden/pictures"
SIZE = "120x96"


def picture_arguments(flags, file):
    """The command line of one golden picture."""
    return ["render", str(ROOT / "models/fan.ply"), "-o", str(file), "--size", SIZE, "--quality", "draft", *flags]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for name, flags in json.loads((GOLDENS / "pictures.json").read_text()).items():
        subprocess.run([sys.argv[1], *picture_arguments(flags, GOLDENS / f"{name}.png")], check=True)


if __name__ == "__main__":
    main()
