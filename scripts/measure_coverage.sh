#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Lines of src/ and apps/ that the tests run: builds everything with gcc's counters (build/coverage), runs the tests
# and prints a table by folder.
#
#   scripts/measure_coverage.sh [CTEST ARGUMENTS…]     default: -L "unit|property|replay" -LE data
#   scripts/measure_coverage.sh --table                of what has run so far, such as further tests by hand:
#                                                      ctest --test-dir build/coverage -L cli
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/coverage
if [[ ${1:-} != --table ]]; then
  cmake -G Ninja -B $build -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1 --coverage -fprofile-update=atomic" \
    -DVANTAGE_BUILD_PYTHON=OFF -DVANTAGE_BUILD_BENCH=OFF -DVANTAGE_QUICK_BUILD=ON >/dev/null
  cmake --build $build >/dev/null
  find $build -name '*.gcda' -delete
  if (($# == 0)); then set -- -L 'unit|property|replay' -LE data; fi
  ctest --test-dir $build "$@" -j "$(nproc)" >$build/tests.log 2>&1 || tail -5 $build/tests.log
fi
python3 - "$build" <<'PYTHON'
import collections
import json
import pathlib
import subprocess
import sys

root = pathlib.Path.cwd()
build = pathlib.Path(sys.argv[1]).resolve()
lines = collections.defaultdict(dict)  # of each file: line -> whether it ran
counts = sorted(p for p in build.rglob("*.gcda") if "/vantage.dir/" in str(p) or "/apps/" in str(p))
for start in range(0, len(counts), 20):
    text = subprocess.run(["gcov", "--json-format", "--stdout", *map(str, counts[start:start + 20])], cwd=build,
                          capture_output=True, check=True).stdout.decode(errors="replace")
    for document in filter(None, text.splitlines()):
        for file in json.loads(document)["files"]:
            path = (build / file["file"]).resolve()
            if path.is_relative_to(root / "src") or path.is_relative_to(root / "apps"):
                known = lines[path.relative_to(root)]
                for line in file["lines"]:
                    known[line["line_number"]] = known.get(line["line_number"], False) or line["count"] > 0
table = collections.defaultdict(lambda: [0, 0])
for path, known in lines.items():
    for key in (str(path.parent), str(path.parts[0])):
        table[key][0] += sum(known.values())
        table[key][1] += len(known)
print("| folder | lines | run | share |\n| --- | ---: | ---: | ---: |")
for key, (run, every) in sorted(table.items()):
    print(f"| {key} | {every} | {run} | {100 * run / every:.1f} % |")
low = sorted((sum(known.values()) / len(known), str(path)) for path, known in lines.items() if len(known) > 20)
print("\nleast covered:", ", ".join(f"{path} {100 * share:.0f} %" for share, path in low[:8]))
PYTHON
