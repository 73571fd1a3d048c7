#!/usr/bin/env bash
# Tries a release tarball: unpacked in two places, with nothing in the environment and only its own libraries, it makes
# the same picture; nothing in it needs a newer C library than Debian 12 has, and its bill of materials names every library.
#   test_release.sh TARBALL
set -euo pipefail
tarball=$(realpath "$1")
cd "$(dirname "$0")/.."
model=$PWD/models/fan.ply
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
for folder in "$place/one" "$place/another place"; do
  mkdir -p "$folder"
  tar -xzf "$tarball" -C "$folder" --strip-components=1
  (cd "$folder" && env -i bin/vantage view "$model" -o out -q)
  outside=$(env -i ldd "$folder/bin/vantage" | grep '=> /' | grep -v "$folder" |
    grep -vE '/(libc|libm|libdl|libpthread|librt|libresolv)\.so' || true)
  [[ -z $outside ]] || { printf 'not in the tarball:\n%s\n' "$outside" >&2; exit 1; }
done
cmp "$place/one/out/best.png" "$place/another place/out/best.png"

newest=$(objdump -T "$place"/one/bin/vantage "$place"/one/lib/vantage/* | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -1)
[[ $(printf '%s\nGLIBC_2.36\n' "$newest" | sort -V | tail -1) == GLIBC_2.36 ]] ||
  { echo "a library needs $newest" >&2; exit 1; }
libraries=$(find "$place/one/lib/vantage" -type f | wc -l)
licences=$(find "$place/one/share/doc/vantage/licences" -type f | wc -l)
python3 - "$place/one" <<'PYTHON'
import json, pathlib, subprocess, sys
root = pathlib.Path(sys.argv[1])
named = {package["name"] for package in json.loads((root / "vantage.spdx.json").read_text())["packages"]}
for library in (root / "lib/vantage").iterdir():
    owner = subprocess.run(["dpkg", "-S", f"*/{library.name}"], capture_output=True, text=True).stdout
    if not any(line.split(":")[0] in named for line in owner.splitlines()):
        sys.exit(f"{library.name} is not in the bill of materials")
PYTHON
grep -q 'Permission is hereby granted' "$place/one/share/doc/vantage/NOTICES"
echo "$(basename "$tarball"): runs from any folder, $libraries libraries, all in its bill, $licences licences, $newest"
