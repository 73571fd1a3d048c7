#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the fuzzers, one after the other, and prints a table of what they did.
#
#   scripts/fuzz.sh SECONDS [TARGET…]     each target (default: all) for so many seconds
#   scripts/fuzz.sh --spread SECONDS [TARGET…]  so many seconds in all: a turn each, then mostly to the target whose last
#                                         turn found most new edges in a second
#   scripts/fuzz.sh --table               what all such runs did so far (build/fuzz/totals/)
#   scripts/fuzz.sh --leaks [TARGET…]     everything learnt once more, with leak detection
#   scripts/fuzz.sh --minimise [TARGET…]  then: the fewest small inputs that reach the same code, into fuzz/corpus/
#
# Seeds are fuzz/corpus/TARGET/ and, where VANTAGE_DATA names a folder of models, its small files. What is learnt stays
# in build/fuzz/learnt/; inputs that break something go to build/fuzz/found/ and end the script with exit code 1.
# FUZZ_BUILD=no takes the programs as they are, FUZZ_JOBS=2 spreads over two targets at a time, FUZZ_TURN=60 is a turn,
# FUZZ_BYTES=200 the longest input (8000).
#
# Fuzzing keeps short call stacks of allocations, a small quarantine of what was freed, and looks for no leaks: a fifth more
# inputs. What breaks is run again by hand with the usual settings, and --leaks asks once for all that is kept.
set -euo pipefail
cd "$(dirname "$0")/.."

seed_bytes=${FUZZ_BYTES:-8000}  # larger seeds are slow to mutate
corpus_files=60      # of each target, at most, when minimising
corpus_bytes=4000    # of each of them

usage() { sed -n '3,/^set /p' "$0" | sed '$d; s/^# \{0,1\}//'; exit 2; }
(($# > 0)) || usage
what=$1
shift
[[ $what =~ ^(--minimise|--spread|--table|--leaks|[0-9]+)$ ]] || usage
if [[ $what == --spread ]]; then
  [[ ${1:-} =~ ^[0-9]+$ ]] || usage
  spread_seconds=$1
  shift
fi
turn_seconds=${FUZZ_TURN:-120}  # of a target, of those that are spread: what is learnt is run first
jobs=${FUZZ_JOBS:-1}
export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=8:${ASAN_OPTIONS:-}

build=build/fuzz
if [[ ${FUZZ_BUILD:-yes} == yes && $what != --table ]]; then
  cmake --preset fuzz >/dev/null
  nice cmake --build --preset fuzz --target fuzzers >/dev/null
fi
mkdir -p $build/learnt $build/found

targets=("$@")
if ((${#targets[@]} == 0)); then
  for program in "$build"/fuzz/*_fuzz; do
    name=${program##*/}
    targets+=("${name%_fuzz}")
  done
fi

# The folder of the data pack's files that a target reads, copied once.
seed_from_data() {
  local target=$1 ending=$1 place=$build/seeds/$1
  [[ -n ${VANTAGE_DATA:-} && ! -d $place ]] || return 0
  mkdir -p "$place"
  case $target in
    picture) ending='png -o -iname *.jpg -o -iname *.webp' ;;
    packed) ending='drc' ;;
    built_* | view_* | archive | camera | csv | dataset | manifest | pipeline | prior | record | settings | site | threemf_xml) return 0 ;;
  esac
  set -f  # the pattern is for find
  local words=()
  for word in $ending; do words+=("$word"); done
  find "$VANTAGE_DATA" -type f -size -"$seed_bytes"c \( -iname "*.${words[0]}" "${words[@]:1}" \) -print0 |
    while IFS= read -r -d '' file; do
      cp -n "$file" "$place/$(sha1sum <"$file" | cut -c1-16)"
    done
  set +f
}

minimise() {
  local target=$1 small=$build/small/$1 corpus=fuzz/corpus/$1
  rm -rf "$small"
  mkdir -p "$small/none" "$corpus" "$build/learnt/$target"
  "$build/fuzz/${target}_fuzz" -merge=1 -merge_control_file="$small/control" -max_len=$corpus_bytes -rss_limit_mb=3000 \
    -detect_leaks=0 -timeout=600 "$small/none" "$build/learnt/$target" "$corpus" >"$small/log" 2>&1
  scripts/choose_inputs.py "$small/control" --files $corpus_files --bytes $corpus_bytes >"$small/chosen" 2>"$small/said"
  while read -r file; do cp "$file" "$small/$(sha1sum <"$file" | cut -c1-12)"; done <"$small/chosen"
  # Inputs with a name of their own are kept: they broke something once, or tell what a target reads.
  find "$corpus" -type f -regextype egrep -regex '.*/[0-9a-f]{12}' -delete
  while read -r file; do [[ -e $file ]] && cp "$file" "$corpus"; done < <(find "$small" -maxdepth 1 -regextype egrep -regex '.*/[0-9a-f]{12}')
  printf '%-14s %4d files, chosen: %s\n' "$target" "$(find "$corpus" -type f | wc -l)" "$(cat "$small/said")"
}

if [[ $what == --minimise ]]; then
  for target in "${targets[@]}"; do minimise "$target"; done
  exit 0
fi

if [[ $what == --leaks ]]; then
  leaky=0
  for target in "${targets[@]}"; do
    mkdir -p "$build/learnt/$target"
    nice "$build/fuzz/${target}_fuzz" -runs=0 -timeout=600 -report_slow_units=60 -rss_limit_mb=3000 -detect_leaks=1 \
      -artifact_prefix="$build/found/$target-" "$build/learnt/$target" "fuzz/corpus/$target" \
      >"$build/found/$target.leaks.log" 2>&1 || { echo "$target: see $build/found/$target.leaks.log"; leaky=1; }
  done
  exit $leaky
fi

# Runs a target and sets executions (without what was known and is run first), before and edges (what that reaches, and
# what is reached now), quiet (executions since the last new edge), inputs and found. A starved machine makes inputs slow: time is no finding below ten minutes.
run_target() {
  local target=$1 seconds=$2 learnt=$build/learnt/$1 log=$build/found/$1.log
  mkdir -p "$learnt" "fuzz/corpus/$target"
  seed_from_data "$target"
  local seeds=("fuzz/corpus/$target")
  [[ -d $build/seeds/$target ]] && seeds+=("$build/seeds/$target")
  nice "$build/fuzz/${target}_fuzz" -max_total_time="$seconds" -timeout=600 -report_slow_units=60 -rss_limit_mb=3000 \
    -max_len=$seed_bytes -detect_leaks=0 -entropic=0 -reload=0 -print_final_stats=1 -print_funcs=0 \
    -artifact_prefix="$build/found/$target-" "$learnt" "${seeds[@]}" >"$log" 2>&1 || true
  found=$(find $build/found -name "$target-*" ! -name '*.log' | wc -l)
  executions=$(awk '/INITED/ {known = substr($1, 2)} /number_of_executed_units/ {print $2 - known}' "$log")
  before=$(awk '/INITED/ {for (i = 1; i < NF; ++i) if ($i == "cov:") print $(i + 1)}' "$log" | tail -1)
  edges=$(grep -o 'cov: [0-9]*' "$log" | tail -1 | cut -c6- || true)
  quiet=$(awk '{for (i = 1; i < NF; ++i) if ($i == "cov:" && $(i + 1) > most) {most = $(i + 1); last = substr($1, 2)}}
    /number_of_executed_units/ {print $2 - last}' "$log")
  inputs=$(find "$learnt" -type f | wc -l)
}

print_row() { printf '| %-14s | %10s | %8s | %12s | %8s | %6s | %8s | %14s |\n' "$@"; }

print_head() {
  print_row target executions seconds 'edges before' edges inputs findings 'without an edge'
  print_row --- ---: ---: ---: ---: ---: ---: ---:
}

# One more turn of a target, added to build/fuzz/totals/TARGET: executions, seconds, edges before the first turn and now,
# inputs, findings, the edges that the turn found new in a thousand seconds, and executions since the last new edge.
take_turn() {
  local target=$1 total=$build/totals/$1 started=$SECONDS all=(0 0 0 0 0 0 0 0)
  [[ ! -f $total ]] || read -r -a all <"$total"
  run_target "$target" "$turn_seconds"
  local took=$((SECONDS - started > 0 ? SECONDS - started : 1))
  ((all[2] > 0)) || all[2]=${before:-0}
  edges=${edges:-${all[3]}}
  ((edges > ${before:-$edges})) || quiet=$((all[7] + ${executions:-0}))
  echo "$((all[0] + ${executions:-0})) $((all[1] + took)) ${all[2]} $edges $inputs $found" \
    "$(((edges - ${before:-$edges}) * 1000 / took))" "${quiet:-0}" >"$total"
}

# Three turns of four go where most was new, the fourth, and all where nothing was, to the target that had least time;
# none to one that is having a turn.
next_target() {
  local order=('-k8,8gr' '-k3,3g')
  (($1 % 4 < 3)) || order=('-k3,3g')
  for target in "${targets[@]}"; do
    [[ -n ${busy[$target]:-} ]] || echo "$target $(cat "$build/totals/$target" 2>/dev/null || echo 0 0 0 0 0 0 1000000000)"
  done | sort "${order[@]}" | awk 'NR == 1 {print $1}'
}

print_totals() {
  print_head
  local sum=0 all=()
  for target in "${targets[@]}"; do
    [[ -f $build/totals/$target ]] || continue
    read -r -a all <"$build/totals/$target"
    print_row "$target" "${all[@]:0:6}" "${all[7]:-0}"
    sum=$((sum + all[0]))
  done
  echo "$sum executions"
}

if [[ $what == --spread ]]; then
  mkdir -p $build/totals
  declare -A busy=() target_of=()
  ((jobs <= ${#targets[@]})) || jobs=${#targets[@]}
  for ((turn = 0; SECONDS < spread_seconds; ++turn)); do
    target=$(next_target $turn)
    take_turn "$target" &
    busy[$target]=1
    target_of[$!]=$target
    ((${#busy[@]} >= jobs && ${#busy[@]} > 0)) || continue
    wait -n -p ended || true
    unset "busy[${target_of[$ended]}]"
  done
  wait
fi
if [[ $what == --spread || $what == --table ]]; then
  print_totals
  [[ -z $(find $build/found -type f ! -name '*.log') ]]
  exit
fi

print_head
broken=0
for target in "${targets[@]}"; do
  rm -f "$build/found/$target"-*
  started=$SECONDS
  run_target "$target" "$what"
  print_row "$target" "${executions:-?}" $((SECONDS - started)) "${before:-?}" "${edges:-?}" "$inputs" "$found" "${quiet:-?}"
  ((found == 0)) || broken=1
done
exit $broken
