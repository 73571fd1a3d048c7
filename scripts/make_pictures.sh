#!/usr/bin/env bash
# Makes the pictures of README.md and docs/ with the program itself: make_pictures.sh PROGRAM
set -euo pipefail
program=$(realpath "${1:?usage: make_pictures.sh PROGRAM}")
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
"$program" view models/deer.ply -o "$scratch/deer" --size 400x320 -q
for picture in best best-kssm best-skeleton worst; do
  cp "$scratch/deer/$picture.png" "docs/pictures/deer-$picture.png"
done

# What an eye sees, shown from beside it; a cloud's skeleton.
eye=1,0.3,0.6
"$program" map models/horse.ply -o "$scratch/map.ply" -q
printf 'dx,dy,dz\n%s\n' "$eye" >"$scratch/eye.csv"
"$program" score models/horse.ply --directions "$scratch/eye.csv" --visible "$scratch/seen.npy" -o "$scratch/scores.csv" -q
/usr/bin/python3 scripts/picture_models.py "$scratch/map.ply" "$scratch/seen.npy" "$scratch"
draw() { "$program" render "$scratch/$1.ply" -o "docs/pictures/$2.png" --style asset --direction "$3" --size 400x320 -q; }
draw seen horse-seen-from-beside -0.6,0.3,1
"$program" view "$scratch/cloud.xyz" -o "$scratch/cloud" --size 400x320 --up y -q
cp "$scratch/cloud/best-skeleton.png" docs/pictures/horse-cloud-skeleton.png
