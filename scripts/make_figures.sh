#!/usr/bin/env bash
# The paper's figures and Table 1 for any models, and each model's best view in three styles:
#   make_figures.sh PROGRAM FOLDER MODEL...
# Without models: those of models/ that may be shipped, as docs/figures.md shows them.
# SIZE=320x256 is that of a panel; FORMAT=webp turns the PNGs into WebP, a fifth of the bytes (Debian's package webp).
set -euo pipefail
program=$(realpath "${1:?usage: make_figures.sh PROGRAM FOLDER [MODEL...]}")
folder=${2:?usage: make_figures.sh PROGRAM FOLDER [MODEL...]}
shift 2
cd "$(dirname "$0")/.."
if (($# == 0)); then set -- models/horse.ply models/deer.ply; fi
if [[ ${FORMAT:-png} == webp ]]; then
  command -v cwebp >/dev/null || { echo "make_figures.sh: install webp for FORMAT=webp" >&2; exit 1; }
fi
"$program" figures "$@" -o "$folder" --size "${SIZE:-320x256}" -q
for model in "$@"; do
  name=$(basename "${model%.*}")
  place=$folder/$name
  if (($# == 1)); then place=$folder; fi
  for style in clay asset technical; do
    "$program" render "$model" -o "$place/style-$style.png" --view best --style "$style" --quality fine \
      --background white --size "${SIZE:-320x256}" -q
  done
done
if [[ ${FORMAT:-png} == webp ]]; then
  find "$folder" -name '*.png' | while IFS= read -r picture; do
    cwebp -quiet -q 82 "$picture" -o "${picture%.png}.webp" && rm "$picture"
  done
fi
