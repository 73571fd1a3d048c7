#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds oneTBB from Debian's source with the thread sanitizer, and the program with both, and runs commands over models
# with as many threads as there are cores, at least four.
#
#   scripts/check_threads.sh [MODEL…]     default: models/*
#
# Exit code 1 if there was a report, or a run that did not end with 0: what does not run has no races.
#
# Without a oneTBB of its own the sanitizer does not see how its tasks wait for each other, and reports races that are
# none. Embree is the distribution's, not instrumented; its tasks run in that oneTBB. Needs dpkg-dev and the network.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$PWD/build/tsan-tbb

if [[ ! -d $folder/installed ]]; then
  mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" \
    >"$folder/sources.list"
  apt=(-o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$folder/lists"
    -o Dir::Cache="$folder/cache" -o APT::Sandbox::User=root)
  apt-get "${apt[@]}" update -qq
  (cd "$folder" && apt-get "${apt[@]}" source -qq --download-only onetbb && tar xf onetbb_*.orig.tar.xz)
  cmake -S "$folder"/oneTBB-* -B "$folder/build" -G Ninja -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF \
    -DTBBMALLOC_BUILD=OFF -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_INSTALL_PREFIX="$folder/installed" >/dev/null
  nice cmake --build "$folder/build" --target install >/dev/null
fi
cmake --preset tsan -DVANTAGE_QUICK_BUILD=ON -DTBB_DIR="$folder/installed/lib/cmake/TBB" >/dev/null
nice cmake --build build/tsan --target vantage_program >/dev/null

models=("$@")
if ((${#models[@]} == 0)); then
  shopt -s nullglob
  models=(models/*.ply models/*.obj models/*.off)
  shopt -u nullglob
fi
threads=$(($(nproc) > 4 ? $(nproc) : 4))
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
export LD_LIBRARY_PATH=$folder/installed/lib
export TSAN_OPTIONS="halt_on_error=0 exitcode=66 log_path=$out/report suppressions=$PWD/scripts/tsan_suppressions.txt"
runs=0 failed=0
for model in "${models[@]}"; do
  # Pictures of few pixels: their stages are the same, and the sanitizer takes fifteen times as long.
  for words in "info --json" "view -o $out/view --size 120x90 --force -q" "map -o $out/map.ply --force -q" \
    "skeleton -o $out/graph.obj --force -q" "thumb -o $out/thumb.png --size 64 --force -q" \
    "compare -o $out/compare --method kssm,viewpoint-entropy,mesh-saliency --force -q"; do
    read -r -a command <<<"$words"
    code=0 started=$SECONDS
    build/tsan/apps/vantage/vantage "${command[0]}" "$model" "${command[@]:1}" --threads "$threads" >/dev/null || code=$?
    ((runs += 1))
    ((code == 0)) || ((failed += 1))
    echo "${command[0]} $model: exit code $code, $((SECONDS - started)) s"
  done
done
races=$(cat "$out"/report* 2>/dev/null | grep -c "WARNING: ThreadSanitizer" || true)
echo "$runs runs with $threads threads, $failed failed, $races reports"
[[ -z $(ls "$out"/report* 2>/dev/null) ]] || cat "$out"/report* | head -200
((runs > 0 && failed == 0 && races == 0))
