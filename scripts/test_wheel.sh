#!/usr/bin/env bash
# Installs the wheel in a virtual environment of a bare Debian 12 tree that has Python and NumPy but none of the libraries
# that the wheel carries, and compares its answer with the program's. Needs root, mmdebstrap and the network.
#   test_wheel.sh [BUILD=build/release] [TREE=a temporary folder]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
tree=${2:-$(mktemp -d)/debian12}
rm -f "$build"/python/vantage-*.whl
cmake --build "$build" --target vantage_program python_wheel >/dev/null
wheel=$(echo "$build"/python/vantage-*manylinux*.whl)
[[ -d $tree/usr ]] ||
  mmdebstrap --quiet --variant=minbase --include=python3-venv,python3-numpy bookworm "$tree"
for library in libtbb12 libembree3-3 libdraco7 libmetis5 libmeshoptimizer2d libwebp7 libpng16-16; do
  if chroot "$tree" dpkg-query -W "$library" >/dev/null 2>&1; then
    echo "test_wheel.sh: the tree has $library itself" >&2
    exit 1
  fi
done
mkdir -p "$tree/opt/trial"
rm -f "$tree"/opt/trial/vantage-*.whl
cp "$wheel" models/fan.ply "$tree/opt/trial/"
inside() { chroot "$tree" /usr/bin/env -i PATH=/usr/bin:/bin HOME=/opt/trial sh -euc "cd /opt/trial; $1"; }
# NumPy is Debian's, seen from the environment: there is no index here to take another from.
inside 'python3 -m venv --clear --system-site-packages venv && venv/bin/pip install -q --no-index --no-deps vantage-*.whl'
inside 'venv/bin/python -c "
import pathlib, vantage
result = vantage.best_view(\"fan.ply\")
pathlib.Path(\"view.json\").write_text(result.json)
pathlib.Path(\"best.png\").write_bytes(result._repr_png_())"'
"$build/apps/vantage/vantage" view models/fan.ply --no-images --json -q -o "$tree/opt/trial/program" >/dev/null
cmp "$tree/opt/trial/view.json" "$tree/opt/trial/program/view.json"
echo "wheel: $(basename "$wheel"), $(stat -c %s "$wheel") bytes, gives the program's answer on a bare Debian 12"
