#!/usr/bin/env bash
# Runs clang-tidy 14 over all sources, or with --changed over those of the last 20 commits:
# over 8 of them at most, spread evenly.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(
  if [[ ${1:-} == --changed ]]; then
    base=$(git rev-list --first-parent -n 21 HEAD | tail -1)
    git diff --name-only --diff-filter=d "$base" -- 'src/*.cpp' 'apps/*.cpp' 'python/*.cpp'
  else
    git ls-files 'src/*.cpp' 'apps/*.cpp' 'python/*.cpp' 'tests/*.cpp' 'bench/*.cpp'
  fi)
if ((${#files[@]} == 0)); then
  exit 0
fi
most=8
if [[ ${1:-} == --changed ]] && ((${#files[@]} > most)); then
  echo "clang-tidy: $most of the ${#files[@]} files that changed; scripts/check_tidy.sh takes all"
  for ((i = 0; i < most; ++i)); do some+=("${files[i * ${#files[@]} / most]}"); done
  files=("${some[@]}")
fi
cmake --preset tidy -DCMAKE_CXX_CLANG_TIDY= >/dev/null
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy-14 -p build/tidy --quiet
