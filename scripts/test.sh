#!/usr/bin/env bash
# From a bare Debian 12 and a clone to all tests passing: but the slow ones, or with `all` these too.
# Set VANTAGE_DATA to a folder of real meshes to run the tests that need them too.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_dependencies.sh test
cmake --preset release -DVANTAGE_BUILD_BENCH=OFF >/dev/null
cmake --build --preset release -j "$(nproc)"
code=0
log=$PWD/build/release/tests.log
left_out=(-LE slow)
if [[ ${1:-} == all ]]; then left_out=(); fi
ctest --preset release "${left_out[@]}" -j "$(($(nproc) + 2))" --output-log "$log" || code=$?  # the tests of Slurm mostly wait
scripts/count_tests.py build/release
if [[ ${#left_out[@]} -gt 0 ]]; then
  ctest --preset release -L slow -N | sed -n 's/^ *Test *#[0-9]*: /left out as slow (scripts\/test.sh all runs it): /p'
fi
sed -n '/ tests passed, /,$p' "$log"  # the runner's own summary comes last
exit $code
