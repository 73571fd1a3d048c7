#!/usr/bin/env bash
# Everything too slow for every commit: full lint, sanitizers over all tests, slow tests, fuzzers, pages.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}  # a fuzzer
scripts/install_dependencies.sh all
scripts/check_format.sh
scripts/check_tidy.sh
cmake --preset asan >/dev/null && cmake --build --preset asan
ctest --test-dir build/asan -LE slow -j "$(nproc)" --output-on-failure
scripts/fuzz.sh "$seconds"
if [[ -n ${VANTAGE_DATA:-} ]]; then
  scripts/check_hostile.py "$VANTAGE_DATA" --command info --most-bytes 200
  scripts/check_hostile.py "$VANTAGE_DATA" --command all --program build/asan/apps/vantage/vantage --seconds 600
fi
scripts/test.sh all
scripts/check_threads.sh
scripts/check_symbols.sh  # of the build with the preset release
scripts/check_without_npm.sh
scripts/check_compilers.sh
scripts/build_docs.sh
scripts/check_reproducible.sh
if [[ $(id -u) -eq 0 ]] && command -v debootstrap >/dev/null; then
  scripts/test_packages.sh
  scripts/test_wheel.sh
  scripts/make_container.sh build/release/packages/vantage_*.deb
  scripts/test_container.sh build/container/vantage-oci.tar
else
  echo "packages, wheel and container are not tested: needs root and debootstrap"
fi
(cd tests/docs && VANTAGE=$PWD/../../build/release/apps/vantage/vantage python3 -m unittest test_docs)
