#!/usr/bin/env bash
# godot_picture.sh SCRATCH PICTURE.png: a glb posed in the project that run_godot.sh made, drawn by Godot 3 under Xvfb;
# 77 (skipped) without.
set -u
here=$(cd "$(dirname "$0")" && pwd)
command -v godot3-runner >/dev/null && command -v xvfb-run >/dev/null || {
  echo "skipped: no godot3-runner or Xvfb here (Debian: godot3-runner xvfb xauth libgl1-mesa-dri)"
  exit 77
}
[ -f "$1/project/hf/libhf_godot.so" ] && ls "$1"/project/.import/model.glb-*.scn >/dev/null 2>&1 || {
  echo "skipped: the test bindings_godot has made no project"
  exit 77
}
sed -f "$here/../../bindings/godot/godot3.sed" "$here/godot_picture.gd" >"$1/project/picture.gd"
rm -f "$2"
export LANG=en_US.UTF-8 HOME="$1/home" HF_PICTURE=$2
timeout 90 xvfb-run -a -s "-screen 0 1024x600x24" godot3-runner --path "$1/project" -s picture.gd || exit 1
[ "$(stat -c %s "$2")" -gt 15000 ]
