#!/usr/bin/env bash
# org.hf.fields-VERSION.tgz: the Unity package (UPM) with every platform's library and .meta files. Unity is not to be had
# here: its classes run under Mono, its components compile against stand-ins.
. "$(dirname "$0")/common.sh"

unity_make() {
  local out=$1 folder platform libraries=()
  folder=$(mktemp -d) || exit 1
  for platform in $(hf_platforms); do libraries+=("$platform=$(hf_library "$platform")"); done
  python3 "$hf_root/bindings/unity/make_package.py" "$folder" "${libraries[@]}" || exit 1
  # a folder whose name ends in ~ is not imported: no .meta
  hf_licences "$folder/org.hf.fields/Licences~" "$(hf_platforms | paste -sd,)"
  hf_bom "$folder/org.hf.fields/Licences~/bom.cdx.json" "$(hf_platforms | paste -sd,)" "$folder/org.hf.fields"
  find "$folder" -type f -exec chmod 644 {} +
  hf_pack tar "$out/org.hf.fields-$hf_version.tgz" "$folder/org.hf.fields" package
  rm -rf "$folder"
}

unity_try() {
  local out=$1 scratch=$2 filled platform library
  command -v mono >/dev/null && command -v mcs >/dev/null || hf_skip "no Mono here (Debian: mono-mcs mono-runtime)"
  filled=$(hf_filled) || exit 1
  tar xzf "$out/org.hf.fields-$hf_version.tgz" -C "$scratch"
  python3 - "$scratch/package" <<'PY' || hf_fail ".meta files"
import json, pathlib, re, sys
folder = pathlib.Path(sys.argv[1])
json.load(open(folder / "package.json"))
paths = [path for path in folder.rglob("*") if path.suffix != ".meta" and not any(part.endswith("~") for part in path.parts)]
guids = [re.search(r"guid: ([0-9a-f]{32})\n", path.with_name(path.name + ".meta").read_text()).group(1) for path in paths]
assert len(set(guids)) == len(paths) > 20, "two files with one identifier"
assert len(list(folder.rglob("*.meta"))) == len(paths), "a .meta without its file"
PY
  hf_quiet mcs -langversion:latest -unsafe -nowarn:649,169 -target:library -out:"$scratch/unity.dll" "$hf_tests/UnityStubs.cs" $(find "$scratch/package" -name '*.cs')
  mkdir "$scratch/app"
  hf_quiet mcs -langversion:latest -unsafe -target:library -out:"$scratch/app/Hf.dll" "$scratch"/package/Runtime/Hf/*.cs
  hf_quiet mcs -langversion:latest -unsafe -r:"$scratch/app/Hf.dll" -r:System.Core -out:"$scratch/app/golden.exe" "$hf_tests"/Golden*.cs "$hf_tests/Json.cs"
  cp "$scratch/package/Plugins/linux-x64/libhf.so" "$scratch/app/"
  (cd "$scratch" && "${hf_clean_env[@]}" mono "$scratch/app/golden.exe" "$hf_golden/meshes" "$filled" "$hf_golden/bad_input.json") >"$scratch/golden.log" 2>&1 || {
    tail -10 "$scratch/golden.log" >&2
    hf_fail "golden scenes of the classes"
  }
  for platform in $(hf_platforms); do
    library="$scratch/package/Plugins/$platform/$(hf_library_name "$platform")"
    cmp -s "$(hf_library "$platform")" "$library" && [ -s "$library.meta" ] || hf_fail "Plugins/$platform"
  done
  hf_ran "its classes and library under Mono: golden scenes, bad calls; components compile against stand-ins; a .meta for each file; never in Unity"
}

case "$1" in
  make) unity_make "$2" ;;
  try) unity_try "$2" "$3" ;;
esac
