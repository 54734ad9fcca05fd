#!/usr/bin/env bash
# run_blender.sh [--window | --module] LIBRARY SCRATCH SCRIPT ARGS...: installs the add-on's zip into a scratch profile and runs
# a script in Blender without a display, with a window under Xvfb, or in Blender as a Python module (HF_BPY: a Python that has
# it); 77 (skipped) without Blender, Xvfb or the module.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
form=background
case "$1" in --*) form=${1#--}; shift ;; esac
if [ "$form" = window ]; then
  command -v xvfb-run >/dev/null || { echo "skipped: no Xvfb here (Debian: xvfb xauth libgl1-mesa-dri)"; exit 77; }
fi
library=$1 scratch=$2 script=$3
shift 3
unset PYTHONPATH PYTHONHOME HF_LIBRARY
blender=${HF_BLENDER:-blender}
module=${HF_BPY:-python3}
if [ "$form" = module ]; then
  "$module" -c "import bpy" 2>/dev/null || { echo "skipped: no Blender as a Python module here (package bpy; HF_BPY=its python)"; exit 77; }
else
  command -v "$blender" >/dev/null || { echo "skipped: no Blender here (Debian: blender)"; exit 77; }
fi
mkdir -p "$scratch"
python3 "$root/bindings/blender/make_zip.py" "$library" "$scratch/hf_blender.zip" || exit 1
rm -rf "$scratch/scripts" "$scratch/config" "$scratch/module"
mkdir -p "$scratch/scripts" "$scratch/config"
export BLENDER_USER_SCRIPTS="$scratch/scripts" BLENDER_USER_CONFIG="$scratch/config"
export HF_ADDON_ZIP="$scratch/hf_blender.zip" HF_TESTS="$root/tests/bindings"
if [ "$form" = module ]; then
  mkdir -p "$scratch/module"
  export BLENDER_USER_RESOURCES="$scratch/module"  # extensions too
  exec "$module" "$script" -- "$@"
fi
export PATH=/usr/bin:$PATH  # an embedded Python looks for its home by the first python3 on the path
if [ "$form" = window ]; then
  LIBGL_ALWAYS_SOFTWARE=1 exec timeout 280 xvfb-run -a -s "-screen 0 1280x800x24" "$blender" --factory-startup \
    --enable-event-simulate -p 0 0 1280 800 --python "$script" -- "$@"
fi
exec "$blender" -b --factory-startup --python-exit-code 3 --python "$script" -- "$@"
