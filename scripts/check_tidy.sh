#!/usr/bin/env bash
# Runs clang-tidy 14 over all sources, or with --changed over those of the last commit:
# over 12 of them at most, spread evenly, when a large merge was the last.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(
  if [[ ${1:-} == --changed ]] && git rev-parse -q --verify HEAD~1 >/dev/null; then
    git diff --name-only --diff-filter=d HEAD~1 -- 'src/*.cpp' 'apps/*.cpp' 'python/*.cpp'
  else
    git ls-files 'src/*.cpp' 'apps/*.cpp' 'python/*.cpp' 'tests/*.cpp' 'bench/*.cpp'
  fi)
if ((${#files[@]} == 0)); then
  exit 0
fi
most=12
if [[ ${1:-} == --changed ]] && ((${#files[@]} > most)); then
  echo "clang-tidy: $most of the ${#files[@]} files that changed; scripts/check_tidy.sh takes all"
  for ((i = 0; i < most; ++i)); do some+=("${files[i * ${#files[@]} / most]}"); done
  files=("${some[@]}")
fi
cmake --preset tidy -DCMAKE_CXX_CLANG_TIDY= >/dev/null
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy-14 -p build/tidy --quiet
