#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The functions of the public headers, as the linker knows them, and the sizes of their classes, as the compiler lays them
# out, against the committed lists: what has gone or has changed breaks programs that are linked to an older library.
#
#   scripts/check_symbols.sh [BUILD]             compares; exit code 1 where something has gone
#   scripts/check_symbols.sh --update [BUILD]    writes the lists anew: a decision, which the changelog names
set -euo pipefail
cd "$(dirname "$0")/.."
update=
if [[ ${1:-} == --update ]]; then update=yes; shift; fi
build=${1:-build/release}
list=cmake/public_symbols.txt
layouts=cmake/public_layout.txt

# Functions and classes that the public headers declare: what only src/ knows, as a class's State, may come and go.
classes=$(grep -rhv '^ *friend ' include | grep -oE '\b(class|struct|namespace) [A-Za-z_][A-Za-z0-9_]*' | cut -d' ' -f2 | sort -u)
declared=$(grep -rhoE '\b[A-Za-z_][A-Za-z0-9_]*\s*\(' include | tr -d ' (' | sort -u)
symbols() {
  nm -C --defined-only "$build"/libvantage.* 2>/dev/null | awk '$2 == "T"' | cut -d' ' -f3- |
    sed 's/\[abi:cxx11\]//' | grep -E '^vantage::' | grep -vE '\(anonymous namespace\)|::State::|\{lambda|\[clone' |
    awk -v names="$declared" -v classes="$classes" 'BEGIN {
        n = split(names, list, "\n"); for (i = 1; i <= n; ++i) known[list[i]] = 1
        n = split(classes, list, "\n"); for (i = 1; i <= n; ++i) owner[list[i]] = 1 }
      { plain = $0; gsub(/<[^<>]*>/, "", plain); gsub(/<[^<>]*>/, "", plain); gsub(/<[^<>]*>/, "", plain)
        sub(/\(.*/, "", plain); n = split(plain, parts, "::"); name = parts[n]; sub(/^~/, "", name)
        if (known[name] && owner[parts[n - 1]]) print }' | LC_ALL=C sort -u
}
# "vantage::Camera size=112 align=16" of every class that a header shows the inside of.
layout() {
  local place
  place=$(mktemp -d)
  (cd include && find vantage -name '*.h' | LC_ALL=C sort | sed 's/.*/#include "&"/') >"$place/all.cpp"
  g++ -std=c++20 -Iinclude -isystem /usr/include/eigen3 -fdump-lang-class="$place/classes" -c "$place/all.cpp" \
    -o /dev/null
  awk '/^Class vantage::/ { name = $2; getline; print name, $1, $2 }' "$place/classes" | grep -v '<lambda\|<unnamed' |
    LC_ALL=C sort -u
  rm -r "$place"
}
if [[ -n $update ]]; then
  symbols >"$list"
  layout >"$layouts"
  echo "$list: $(wc -l <"$list") functions; $layouts: $(wc -l <"$layouts") classes"
  exit 0
fi
now=$(symbols)
changed=$(LC_ALL=C comm -23 "$layouts" <(layout))
if [[ -n $changed ]]; then
  printf 'of another size, which breaks programs compiled with older headers:\n%s\n' "$changed"
  exit 1
fi
gone=$(LC_ALL=C comm -23 "$list" - <<<"$now")
new=$(LC_ALL=C comm -13 "$list" - <<<"$now" | wc -l)
if [[ -n $gone ]]; then
  printf 'gone or changed, which breaks programs linked to an older library:\n%s\n' "$gone"
  exit 1
fi
echo "every function of $list is there, $new new ones; the $(wc -l <"$layouts") classes of $layouts are as large as they were"
