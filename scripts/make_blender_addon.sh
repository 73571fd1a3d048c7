#!/usr/bin/env bash
# Packs the add-on for Blender, which Edit > Preferences > Add-ons > Install takes: the same bytes for the same files.
#   make_blender_addon.sh [FILE=build/vantage_best_view.zip]
set -euo pipefail
file=$(realpath -m "${1:-$(dirname "$0")/../build/vantage_best_view.zip}")
cd "$(dirname "$0")/.."
mkdir -p "$(dirname "$file")"
python3 - "$file" <<'PYTHON'
import pathlib, sys, zipfile
package = pathlib.Path("integrations/blender/vantage_best_view")
files = {path.name: path for path in package.glob("*.py")} | {"LICENSE": pathlib.Path("LICENSE")}
with zipfile.ZipFile(sys.argv[1], "w") as archive:
    for name in sorted(files):
        entry = zipfile.ZipInfo(f"{package.name}/{name}", (1980, 1, 1, 0, 0, 0))  # the first that a zip knows
        entry.external_attr = 0o644 << 16
        archive.writestr(entry, files[name].read_bytes(), zipfile.ZIP_DEFLATED)
PYTHON
echo "$file"
