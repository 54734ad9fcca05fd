#!/usr/bin/env bash
# walk.sh HF_WALK HF_MAKE_ASSETS FOLDER: the walk of the horse on the bull, with hf and hf_gltf from C.
set -eu
walk=$1 assets=$2 folder=$3
mkdir -p "$folder"
"$assets" "$folder" --vertices 3000 --creature horse --creature bull >/dev/null
"$walk" "$folder/horse.glb" "$folder/bull.glb" "$folder/walk.glb" | tee "$folder/said"
for pair in 'front foot left' 'hind foot right' withers rump; do
  grep -q "^pair $pair " "$folder/said" || { echo "error: no pair $pair"; exit 1; }
done
# the bull's own joints follow within a hundredth of its box, and some keys are left out
awk '/^clip/ { for (i = 1; i <= NF; ++i) { if ($i == "keys,") { all = $(i - 1); k = $(i - 3) }; if ($i == "the") off = $(i - 2) }
  exit !(off > 0 && off < 0.01 && k > 0 && k < 0.95 * all) }' "$folder/said" || { echo "error: the clip is not as expected"; exit 1; }
# what was written is read again, with its clip first
"$walk" "$folder/walk.glb" "$folder/horse.glb" "$folder/back.glb" >/dev/null
# a model without a skin has no joints to turn
printf '%s' '{"asset":{"version":"2.0"}}' >"$folder/empty.gltf"
if "$walk" "$folder/empty.gltf" "$folder/bull.glb" "$folder/none.glb" 2>"$folder/error"; then echo "error: an empty model was taken"; exit 1; fi
grep -q 'hf_gltf_model_get_surface: the model has no triangles' "$folder/error" || { cat "$folder/error"; exit 1; }
