#!/usr/bin/env bash
# The paper's figures and Table 1 for any models, and each model's best view in three styles:
#   make_figures.sh PROGRAM FOLDER MODEL...
# Without models: those of models/ that may be shipped, as docs/figures.md shows them.
set -euo pipefail
program=$(realpath "${1:?usage: make_figures.sh PROGRAM FOLDER [MODEL...]}")
folder=${2:?usage: make_figures.sh PROGRAM FOLDER [MODEL...]}
shift 2
cd "$(dirname "$0")/.."
if (($# == 0)); then set -- models/horse.ply models/deer.ply; fi
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
