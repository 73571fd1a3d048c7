#!/usr/bin/env bash
# Runs an image of make_container.sh on a mounted folder, as its own user and without a network, and compares what it
# writes with VANTAGE=PROGRAM, if that is set. Needs root, umoci, and runc or crun.
#   test_container.sh IMAGE.tar
set -euo pipefail
image=$(realpath "$1")
models=$(realpath "$(dirname "$0")/../models")
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
mkdir "$place/oci" "$place/folder"
tar -C "$place/oci" -xf "$image"
version=$(sed -n 's/.*"org.opencontainers.image.ref.name":"\([^"]*\)".*/\1/p' "$place/oci/index.json")
umoci unpack --image "$place/oci:$version" "$place/bundle"
cp "$models/fan.ply" "$place/folder/"
chmod 0777 "$place/folder"

python3 - "$place" <<'PYTHON'
import json, pathlib, sys
place = pathlib.Path(sys.argv[1])
file = place / "bundle/config.json"
config = json.loads(file.read_text())
process = config["process"]
assert process["user"]["uid"] == 65532, process["user"]
assert process["args"] == ["/usr/bin/vantage"], process["args"]
process["args"] += ["view", "fan.ply", "-o", "out", "-q"]
process["terminal"] = False
config["root"]["readonly"] = True
config["mounts"].append({"destination": "/work", "type": "none", "source": str(place / "folder"),
                         "options": ["rbind", "rw"]})
file.write_text(json.dumps(config))
PYTHON
[[ -z $(find "$place/bundle/rootfs" -perm /6000) ]] || { echo "test_container.sh: a file runs as its owner" >&2; exit 1; }

by=
for runtime in runc crun; do  # Debian's crun does not run where both versions of cgroups are mounted
  if command -v $runtime >/dev/null && $runtime run --bundle "$place/bundle" "vantage-$$" 2>"$place/said"; then
    by=$runtime
    break
  fi
done
[[ -n $by ]] || { echo "test_container.sh: neither runc nor crun runs it: $(tail -1 "$place/said")" >&2; exit 1; }
test -s "$place/folder/out/best.png"
test -s "$place/folder/out/view.json"
[[ $(stat -c %u "$place/folder/out/view.json") == 65532 ]] || { echo "test_container.sh: not its own user" >&2; exit 1; }
if [[ -n ${VANTAGE:-} ]]; then
  "$VANTAGE" view "$models/fan.ply" -o "$place/here" -q
  cmp "$place/here/view.json" "$place/folder/out/view.json"
  cmp "$place/here/best.png" "$place/folder/out/best.png"
fi
size=$(du -sb "$place/bundle/rootfs" | cut -f1)
((size <= 120000000)) || { echo "test_container.sh: $size bytes unpacked" >&2; exit 1; }
echo "$(basename "$image"): $size bytes unpacked; ran by $by, user 65532, $(find "$place/bundle/rootfs" -type f -perm /111 -path '*/bin/*' | wc -l) program in bin"
