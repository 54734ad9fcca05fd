#!/usr/bin/env bash
# run_blender.sh [--window] LIBRARY SCRATCH SCRIPT ARGS...: installs the add-on's zip into a scratch profile and runs a
# script in Blender without a display, or with a window under Xvfb; 77 (skipped) without Blender or Xvfb.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
window=0
if [ "$1" = --window ]; then
  window=1
  shift
  command -v xvfb-run >/dev/null || { echo "skipped: no Xvfb here (Debian: xvfb xauth libgl1-mesa-dri)"; exit 77; }
fi
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
if [ "$window" = 1 ]; then
  LIBGL_ALWAYS_SOFTWARE=1 exec timeout 280 xvfb-run -a -s "-screen 0 1280x800x24" "$blender" --factory-startup \
    --enable-event-simulate -p 0 0 1280 800 --python "$script" -- "$@"
fi
exec "$blender" -b --factory-startup --python-exit-code 3 --python "$script" -- "$@"
