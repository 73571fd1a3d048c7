#!/usr/bin/env bash
# From a bare Debian 12 and a clone to the best and worst view of a shipped model.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_dependencies.sh build
cmake --preset release -DVANTAGE_BUILD_TESTS=OFF -DVANTAGE_BUILD_BENCH=OFF -B build/demo >/dev/null
cmake --build build/demo -j "$(nproc)"
build/demo/apps/vantage/vantage view models/horse.ply -o build/horse.vantage
echo
echo "Look at build/horse.vantage/best.png and build/horse.vantage/worst.png;"
echo "the program is build/demo/apps/vantage/vantage."
