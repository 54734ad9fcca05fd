#!/usr/bin/env bash
# run_godot4.sh ADDONS SCRATCH MODEL.glb SCRIPT.gd [OPTION...]: a project with the folder `addons` of build4.sh and the model
# (`none`: without), imported by the Godot 4 named HF_GODOT4, runs the script; --headless unless there are options. It fails when
# Godot prints an error or says that something was not freed.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
addons=$1 scratch=$2 model=$3 script=$4
shift 4
[ $# -gt 0 ] || set -- --headless
command -v "${HF_GODOT4:-}" >/dev/null || { echo "skipped: HF_GODOT4 names no Godot 4"; exit 77; }
project="$scratch/project" log="$scratch/$(basename "$script" .gd).log"
mkdir -p "$project" "$scratch/home"
export LANG=en_US.UTF-8 HOME="$scratch/home" XDG_RUNTIME_DIR="$scratch/home" HF_GOLDEN="$root/bindings/golden"
export HF_SCENES="${HF_SCENES:-$root/bindings/golden/scenes.json}"
# godot LOG WRONG OPTION...: fails too when a line that it prints matches WRONG.
godot() {
  local out=$1 wrong=$2 code
  shift 2
  timeout 200 "$HF_GODOT4" --path "$project" "$@" >"$out" 2>&1
  code=$?
  ! grep -qE "$wrong" "$out" || code=1
  [ "$code" = 0 ] || grep -E "$wrong|^FAILED" "$out" >&2 || tail -20 "$out" >&2
  return "$code"
}
rm -rf "$project/addons"
cp -R "$addons" "$project/addons"
cp "$root/tests/bindings/godot_host.gd" "$project/host.gd"
cp "$script" "$project/test.gd"
printf 'config_version=5\n[application]\nconfig/name="hf"\n' >"$project/project.godot"
if [ -f "$model" ] && ! cmp -s "$model" "$project/model.glb"; then
  cp "$model" "$project/model.glb"
  rm -rf "$project/.godot"
fi
if [ ! -e "$project/.godot/extension_list.cfg" ]; then
  # without this file any extension can end the first import with a crash: godotengine/godot#111048
  mkdir -p "$project/.godot"
  echo 'res://addons/hf/hf.gdextension' >"$project/.godot/extension_list.cfg"
  godot "$scratch/import.log" 'ERROR:' --headless --import || { rm -rf "$project/.godot" && exit 1; }
fi
# with --verbose Godot names what is left over at its end
godot "$log" 'ERROR:|[Ll]eaked|Orphan|unclaimed' --verbose "$@" -s test.gd || exit 1
sed '1,/^Loaded system CA certificates/d; /^XR: /d; /^Loading resource/d' "$log"
