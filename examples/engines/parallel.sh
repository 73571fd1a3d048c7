#!/usr/bin/env bash
# One collection in N shards under GNU parallel: parallel.sh MODELS RESULTS N [--sshlogin …]
# Exit code 75 asks to be started again; parallel does so up to three times.
set -euo pipefail
printf -v models %q "$1"  # for the shells that parallel starts
printf -v into %q "$2"
results=$2 shards=$3
shift 3
seq 0 $((shards - 1)) |
  parallel --retries 3 --joblog "$results.joblog" "$@" \
    vantage batch "$models" -o "$into" --shard {}/"$shards" --jobs 1 --quiet '||' test '$?' -eq 4
vantage results merge "$results"
