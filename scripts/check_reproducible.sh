#!/usr/bin/env bash
# Builds the release of the last commit twice, in folders of other names, with other languages, time zones, masks of
# permissions and numbers of jobs, and compares the checksums of everything that comes out.
set -euo pipefail
cd "$(dirname "$0")/.."
source=$PWD
commit=$(git rev-parse HEAD)  # there may be another one before the second build
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
build() {  # FOLDER LANGUAGE ZONE MASK JOBS
  git clone -q "$source" "$place/$1"
  git -C "$place/$1" checkout -q "$commit"
  (cd "$place/$1" && umask "$4" && LC_ALL=$2 TZ=$3 CMAKE_BUILD_PARALLEL_LEVEL=$5 scripts/make_release.sh >"$place/log" 2>&1) ||
    { tail -20 "$place/log" >&2; exit 1; }
}
build a C UTC 022 "$(nproc)"
build a-longer-name C.UTF-8 Asia/Kathmandu 077 $(($(nproc) + 1))
diff "$place/a/build/dist/packages/SHA256SUMS" "$place/a-longer-name/build/dist/packages/SHA256SUMS"
cat "$place/a/build/dist/packages/SHA256SUMS"
