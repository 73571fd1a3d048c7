#!/usr/bin/env bash
# Runs clang-tidy 14 over all sources, or with --changed over those of the last commit.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(
  if [[ ${1:-} == --changed ]] && git rev-parse -q --verify HEAD~1 >/dev/null; then
    git diff --name-only --diff-filter=d HEAD~1 -- 'src/*.cpp' 'apps/*.cpp'
  else
    git ls-files 'src/*.cpp' 'apps/*.cpp' 'tests/*.cpp' 'bench/*.cpp'
  fi)
if ((${#files[@]} == 0)); then
  exit 0
fi
cmake --preset tidy -DCMAKE_CXX_CLANG_TIDY= >/dev/null
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy-14 -p build/tidy --quiet
