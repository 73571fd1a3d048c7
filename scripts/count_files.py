#!/usr/bin/env python3
"""How many files one opens to understand a part: the sources and headers that are reached from one of its sources
by including headers of the project, and from each header to the source of the same name.

    scripts/count_files.py            the parts of the table below
    scripts/count_files.py FILE...    the parts that begin at these files, with the names of what is reached

What lies in core, mesh and spatial counts as known: one reads that the functions exist.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PARTS = {
    "global search": "src/view/global_search.cpp",
    "areas of faces": "src/visibility/face_query.cpp",
    "visible vertices": "src/visibility/vertex_visibility.cpp",
    "skeleton": "src/skeleton/skeleton.cpp",
}
KNOWN = ("core", "mesh", "spatial")
INCLUDE = re.compile(r'^\s*#include "([^"]+)"', re.MULTILINE)


def module(name):
    return name.removeprefix("vantage/").split("/")[0]


def reached_from(path):
    """Paths of all files that are reached, the first among them."""
    reached, waiting = set(), [ROOT / path]
    while waiting:
        file = waiting.pop()
        if file in reached:
            continue
        reached.add(file)
        for name in INCLUDE.findall(file.read_text()):
            header = ROOT / ("include" if name.startswith("vantage/") else "src") / name
            if module(name) in KNOWN or not header.exists():
                continue
            waiting.append(header)
            source = ROOT / "src" / module(name) / (header.stem + ".cpp")
            if source.exists():
                waiting.append(source)
    return reached


def main(files):
    for name, path in PARTS.items() if not files else ((file, file) for file in files):
        reached = reached_from(path)
        print(f"{len(reached):3} files, {sum(len(f.read_text().splitlines()) for f in reached):5} lines: {name}")
        for file in sorted(reached) if files else ():
            print("   ", file.relative_to(ROOT))


if __name__ == "__main__":
    main(sys.argv[1:])
