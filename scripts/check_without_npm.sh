#!/usr/bin/env bash
# A build without npm makes everything but the 3D page, and says so: builds one beside the usual
# ones and runs it. check_without_npm.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/without-npm}
cmake --preset release -B "$build" -DVANTAGE_BUILD_TESTS=OFF -DVANTAGE_BUILD_BENCH=OFF -DNPM_PROGRAM=OFF \
  | grep 'npm not found'
cmake --build "$build" --target vantage_program >/dev/null
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
"$build/apps/vantage/vantage" view models/cat_lowpoly.ply -o "$scratch/out" --search rapid --size 160x120 2>"$scratch/notes" >/dev/null
grep 'built without npm' "$scratch/notes"
for file in best.png worst-kssm.png view.json map.ply skeleton.json camera-best.gltf; do
  test -s "$scratch/out/$file"
done
test ! -e "$scratch/out/report.html"
echo "without npm: everything but report.html"
