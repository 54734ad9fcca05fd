#!/usr/bin/env bash
# run_blender.sh LIBRARY SCRATCH SCRIPT ARGS...: installs the add-on's zip into a scratch profile and runs a script in
# Blender without a display; 77 (skipped) without Blender.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
library=$1 scratch=$2 script=$3
shift 3
blender=${HF_BLENDER:-blender}
command -v "$blender" >/dev/null || { echo "skipped: no Blender here (Debian: blender)"; exit 77; }
mkdir -p "$scratch"
python3 "$root/bindings/blender/make_zip.py" "$library" "$scratch/hf_blender.zip" || exit 1
rm -rf "$scratch/scripts" "$scratch/config"
mkdir -p "$scratch/scripts" "$scratch/config"
export BLENDER_USER_SCRIPTS="$scratch/scripts" BLENDER_USER_CONFIG="$scratch/config"
export HF_ADDON_ZIP="$scratch/hf_blender.zip" HF_TESTS="$root/tests/bindings"
unset PYTHONPATH PYTHONHOME HF_LIBRARY
export PATH=/usr/bin:$PATH  # an embedded Python looks for its home by the first python3 on the path
exec "$blender" -b --factory-startup --python-exit-code 3 --python "$script" -- "$@"
