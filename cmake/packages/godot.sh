#!/usr/bin/env bash
# hf_godot3-VERSION.zip: the add-on for Godot 3 (folder hf of a project) with GDNative libraries for Linux and Windows.
. "$(dirname "$0")/common.sh"

godot_make() {
  local out=$1 folder platform
  folder=$(mktemp -d) || exit 1
  for platform in $(hf_platforms); do
    case "$platform" in linux-x64 | windows-x64) ;; *) continue ;; esac
    hf_toolchain "$platform"
    GODOT_SOURCE=${GODOT_SOURCE:-$(godot_headers)} CXX=$hf_cxx "$hf_root/bindings/godot/build.sh" "$(godot_library "$platform")" "$folder/$platform" >"$hf_work/godot.log" 2>&1 || {
      local code=$?
      [ "$code" != 77 ] || hf_skip "no headers of Godot 3 here; see $hf_work/godot.log"
      tail -5 "$hf_work/godot.log" >&2
      hf_fail "the library for Godot on $platform"
    }
    mkdir -p "$folder/all/hf"
    cp -R "$folder/$platform/hf/." "$folder/all/hf/"
  done
  find "$folder/all" -type f -exec chmod 644 {} +
  strip --strip-all "$folder/all/hf/libhf_godot.so" || exit 1
  [ ! -e "$folder/all/hf/hf_godot.dll" ] || x86_64-w64-mingw32-strip --strip-all "$folder/all/hf/hf_godot.dll" || exit 1
  hf_licences "$folder/all/hf/licences" "linux-x64,windows-x64"
  hf_bom "$folder/all/hf/bom.cdx.json" "linux-x64,windows-x64" "$folder/all/hf"
  hf_pack zip "$out/hf_godot3-$hf_version.zip" "$folder/all" .
  rm -rf "$folder"
}

# Debian's source package, unpacked once
godot_headers() {
  (. "$hf_root/bindings/debian_source.sh" && hf_debian_source godot "$hf_work/godot_source" godot '*/modules/gdnative/include/*' \
    '*/modules/gdnative/*.py' '*/modules/gdnative/*.json') 2>/dev/null
}
godot_library() { case "$1" in linux-x64) printf '%s/linux-x64/tree/lib/libhf.so' "$hf_work" ;; *) hf_library "$1" ;; esac; }

godot_try() {
  local out=$1 scratch=$2 filled
  command -v godot3-server >/dev/null || hf_skip "no Godot 3 here (Debian: godot3-server)"
  filled=$(hf_filled) || exit 1
  mkdir -p "$scratch/project" "$scratch/home"
  (cd "$scratch/project" && python3 -m zipfile -e "$out/hf_godot3-$hf_version.zip" .) || exit 1
  cp "$hf_tests/godot_test.gd" "$scratch/project/test.gd"
  printf 'config_version=4\n[application]\nconfig/name="hf"\n' >"$scratch/project/project.godot"
  (cd "$scratch" && "${hf_clean_env[@]}" PATH="$PATH" HOME="$scratch/home" LANG=en_US.UTF-8 HF_GOLDEN="$hf_golden" HF_SCENES="$filled" \
    timeout 200 godot3-server --path "$scratch/project" -s test.gd) >"$scratch/godot.log" 2>&1 || {
    tail -20 "$scratch/godot.log" >&2
    hf_fail "the golden scenes in Godot"
  }
  hf_ran "unpacked into a project of Godot $(godot3-server --version 2>/dev/null | head -1): $(grep -m1 'steps run' "$scratch/godot.log"); the Windows library never ran in Godot"
}

case "$1" in
  make) godot_make "$2" ;;
  try) godot_try "$2" "$3" ;;
esac
