#!/usr/bin/env bash
# run_godot.sh LIBRARY SCRATCH MODEL.glb SCRIPT.gd: builds the add-on for Godot 3, makes a project with it and the model,
# imports and runs; 77 (skipped) without Godot 3 or its headers.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
library=$1 scratch=$2 model=$3 script=$4
command -v godot3-server >/dev/null || { echo "skipped: no Godot 3 here (Debian: godot3-server)"; exit 77; }
"$root/bindings/godot/build.sh" "$library" "$scratch" || exit $?
project="$scratch/project"
mkdir -p "$project"
rm -rf "$project/hf"
cp -r "$scratch/hf" "$project/hf"
[ -f "$model" ] && cp "$model" "$project/model.glb"
cp "$root/tests/bindings/godot3_host.gd" "$project/host.gd"
sed -f "$root/bindings/godot/godot3.sed" "$script" >"$project/test.gd"
printf 'config_version=4\n[application]\nconfig/name="hf"\n' >"$project/project.godot"
export LANG=en_US.UTF-8 HOME="$scratch/home" HF_GOLDEN="$root/bindings/golden"
export HF_SCENES="${HF_SCENES:-$root/bindings/golden/scenes.json}"
mkdir -p "$HOME"
if [ -f "$model" ] && ! ls "$project"/.import/model.glb-*.scn >/dev/null 2>&1; then
  # imports, then may hang on its way out
  timeout 15 godot3-server --path "$project" -e --quit >"$scratch/import.log" 2>&1
fi
exec timeout 120 godot3-server --path "$project" -s test.gd
