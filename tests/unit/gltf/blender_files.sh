#!/usr/bin/env bash
# blender_files.sh POSED_POINTS FOLDER: rigged shared models that Blender writes as .fbx, .dae and .bvh, read by Blender and by
# us. 77 (skipped) without Blender or the shared data, or where the build has no assimp.
set -u
program=$1 folder=$2
here=$(cd "$(dirname "$0")" && pwd)
data=${HF_SHARED_DATA:-$here/../../../../shared/data}/gltf
blender=${HF_BLENDER:-blender}
command -v "$blender" >/dev/null || { echo "skipped: no Blender here (Debian: blender)"; exit 77; }
[ -d "$data" ] || { echo "skipped: the optional shared data is not there (HF_SHARED_DATA)"; exit 77; }
mkdir -p "$folder"
printf 'HIERARCHY\n' >"$folder/none.bvh"
if "$program" "$folder/none.bvh" - 0 2>&1 | grep -q HF_WITH_ASSIMP; then
  echo "skipped: this build has no assimp (Debian: libassimp-dev)"
  exit 77
fi
export BLENDER_USER_SCRIPTS=/nonexistent PATH=/usr/bin:$PATH  # the first python3 on the path is the home of Blender's own
unset PYTHONPATH PYTHONHOME
"$blender" -b --factory-startup --python-exit-code 3 --python "$here/blender_files.py" -- "$program" "$folder" \
  "$data/CesiumMan.glb" "$data/khr_Fox.glb" "$data/kk_Knight.glb" | grep -E '^(read|Traceback|  File|[A-Za-z]*Error)'
exit "${PIPESTATUS[0]}"
