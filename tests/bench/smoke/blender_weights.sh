#!/usr/bin/env bash
# blender_weights.sh HF_WEIGHTS: its weights beside Blender's automatic ones on shared models; three of them, or all
# with HF_FULL_TESTS. Fails where a vertex has no weights, or where the poses of the two programs differ. 77 (skipped)
# without Blender or the shared data.
set -u
program=$1
root=$(cd "$(dirname "$0")/../../.." && pwd)
data=${HF_SHARED_DATA:-$root/../shared/data}/gltf
blender=${HF_BLENDER:-blender}
command -v "$blender" >/dev/null || { echo "skipped: no Blender here (Debian: blender)"; exit 77; }
[ -d "$data" ] || { echo "skipped: the optional shared data is not there (HF_SHARED_DATA)"; exit 77; }
models=("$data/CesiumMan.glb" "$data/farm_Sheep.glb" "$data/q_Frog.glb")
if [ -n "${HF_FULL_TESTS:-}" ]; then
  models=()
  for name in CesiumMan RiggedFigure RiggedSimple farm_Cow farm_Llama farm_Pug farm_Sheep khr_Fox; do models+=("$data/$name.glb"); done
  for file in "$data"/q_*.glb; do models+=("$file"); done
fi
export BLENDER_USER_SCRIPTS=/nonexistent PATH=/usr/bin:$PATH  # the first python3 on the path is the home of Blender's own
unset PYTHONPATH PYTHONHOME
exec "$blender" -b --factory-startup --python-exit-code 3 --python "$root/tests/bench/blender_weights.py" -- "$program" "${models[@]}"
