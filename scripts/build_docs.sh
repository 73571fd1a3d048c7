#!/usr/bin/env bash
# Builds the Doxygen pages into build/docs/docs/html; fails on any undocumented public name.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_dependencies.sh check
cmake -G Ninja -B build/docs -DVANTAGE_BUILD_DOCS=ON -DVANTAGE_BUILD_TESTS=OFF -DVANTAGE_BUILD_APPS=OFF >/dev/null
cmake --build build/docs --target docs
