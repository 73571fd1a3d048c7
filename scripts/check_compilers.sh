#!/usr/bin/env bash
# Builds the program with GCC and with Clang and compares what they write of a view of each shipped model: map, pictures and
# view.json are the same bytes. An order of evaluation or a contracted product that a compiler chooses in its own way would show.
set -euo pipefail
cd "$(dirname "$0")/.."
place=build/compilers
mkdir -p "$place"
for compiler in g++ clang++-14; do
  cmake --preset release -B "$place/$compiler" -DCMAKE_CXX_COMPILER="$compiler" -DVANTAGE_WERROR=OFF \
    -DVANTAGE_BUILD_TESTS=OFF -DVANTAGE_BUILD_BENCH=OFF >"$place.log"
  cmake --build "$place/$compiler" -j "$(nproc)" --target vantage_program >"$place.log" || { tail -20 "$place.log" >&2; exit 1; }
  for model in models/*.ply; do
    "$place/$compiler/apps/vantage/vantage" view "$model" -o "$place/$compiler.views/$(basename "$model")" --force -q --no-report
  done
done
diff -rq -x timings.json "$place/g++.views" "$place/clang++-14.views"
echo "$(ls models/*.ply | wc -l) models: the same bytes by g++ and clang++-14"
