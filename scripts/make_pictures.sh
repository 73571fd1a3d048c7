#!/usr/bin/env bash
# Makes the pictures of README.md and docs/ with the program itself: make_pictures.sh PROGRAM
set -euo pipefail
program=$(realpath "${1:?usage: make_pictures.sh PROGRAM}")
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
for model in horse deer; do
  "$program" view "models/$model.ply" -o "$scratch/$model" --size 400x320 -q
  for picture in best best-kssm best-skeleton worst; do
    cp "$scratch/$model/$picture.png" "docs/pictures/$model-$picture.png"
  done
done
