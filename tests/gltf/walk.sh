#!/usr/bin/env bash
# walk.sh HF_WALK HF_PLAY HF_MAKE_ASSETS FOLDER: the walk of the horse on the bull, with hf and hf_gltf from C.
set -eu
walk=$1 play=$2 assets=$3 folder=$4
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
# the joints alone: as good as the pair of the two skeletons is, and a clip of its own on itself
"$play" "$folder/horse.glb" "$folder/bull.glb" "$folder/play.glb" | tee "$folder/said"
awk '{ for (i = 1; i <= NF; ++i) if ($i == "degrees") off = $(i - 1); exit !(off < 10) }' "$folder/said" || { echo "error: limbs do not follow"; exit 1; }
"$play" "$folder/play.glb" "$folder/bull.glb" "$folder/again.glb" | grep -q 'limbs to 0.0 degrees' || { echo "error: a skeleton does not follow itself"; exit 1; }
# a model without a skin has no joints to turn
printf '%s' '{"asset":{"version":"2.0"}}' >"$folder/empty.gltf"
if "$walk" "$folder/empty.gltf" "$folder/bull.glb" "$folder/none.glb" 2>"$folder/error"; then echo "error: an empty model was taken"; exit 1; fi
grep -q 'hf_gltf_model_get_surface: the model has no triangles' "$folder/error" || { cat "$folder/error"; exit 1; }
