#!/usr/bin/env bash
# Everything too slow for every commit: full lint, sanitizers over all tests, fuzzers, pages.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}  # a fuzzer
scripts/install_dependencies.sh check
scripts/check_format.sh
scripts/check_tidy.sh
cmake --preset asan >/dev/null && cmake --build --preset asan
ctest --test-dir build/asan -j "$(nproc)" --output-on-failure
scripts/fuzz.sh "$seconds"
scripts/check_symbols.sh  # of the build with the preset release
scripts/check_without_npm.sh
scripts/build_docs.sh
scripts/check_reproducible.sh
if [[ $(id -u) -eq 0 ]] && command -v debootstrap >/dev/null; then
  scripts/test_packages.sh
else
  echo "packages are not tested: needs root and debootstrap"
fi
(cd tests/docs && VANTAGE=$PWD/../../build/release/apps/vantage/vantage python3 -m unittest test_docs)
