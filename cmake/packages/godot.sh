#!/usr/bin/env bash
# hf_godot3-VERSION.zip: the add-on for Godot 3 (folder hf of a project) with GDNative libraries for Linux and Windows.
# hf_godot4-VERSION.zip: the add-on for Godot 4 (addons/hf) with a .gdextension, of finished libraries. HF_GODOT4 is the full
# path of their folder: one hf_godot4.* for each platform, named as in bindings/godot/addon4/hf.gdextension, and
# godot-cpp-MIT.txt, the licence of the godot-cpp inside. Without it there is no such zip.
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
  godot4_make "$out"
}

godot4_library() {
  case "$1" in
    linux-x64) printf hf_godot4.linux.x86_64.so ;;
    linux-arm64) printf hf_godot4.linux.arm64.so ;;
    windows-x64) printf hf_godot4.windows.x86_64.dll ;;
  esac
}

godot4_make() {
  local out=$1 folder platform platforms name inside
  [ -n "${HF_GODOT4:-}" ] || return 0
  folder=$(mktemp -d) || exit 1
  inside="$folder/addons/hf" platforms=$(hf_platforms | paste -sd,)
  mkdir -p "$inside"
  cp "$hf_root/bindings/godot/addon4/hf.gdextension" "$inside/hf.gdextension"
  for platform in linux-x64 linux-arm64 windows-x64; do
    name=$(godot4_library "$platform")
    case ",$platforms," in
      *",$platform,"*) cp -L "$HF_GODOT4/$name" "$inside/$name" || hf_fail "no $name in HF_GODOT4" ;;
      *) sed -i "/\/${name//./\\.}\"/d" "$inside/hf.gdextension" ;;
    esac
  done
  hf_licences "$inside/licences" "$platforms"
  cp -L "$HF_GODOT4/godot-cpp-MIT.txt" "$inside/licences/godot-cpp-MIT.txt" || hf_fail "no godot-cpp-MIT.txt in HF_GODOT4"
  printf '  godot-cpp, MIT (godot-cpp-MIT.txt)\n' >>"$inside/licences/README.txt"
  hf_bom "$inside/bom.cdx.json" "$platforms,godot4" "$inside"
  find "$folder" -type f -exec chmod 644 {} +
  hf_pack zip "$out/hf_godot4-$hf_version.zip" "$folder" .
  rm -rf "$folder"
}

# Debian's source package, unpacked once
godot_headers() {
  (. "$hf_root/bindings/debian_source.sh" && hf_debian_source godot "$hf_work/godot_source" godot '*/modules/gdnative/include/*' \
    '*/modules/gdnative/*.py' '*/modules/gdnative/*.json') 2>/dev/null
}
godot_library() { case "$1" in linux-x64) printf '%s/linux-x64/tree/lib/libhf.so' "$hf_work" ;; *) hf_library "$1" ;; esac; }

# What can be seen without Godot 4: the .gdextension names libraries that are there, of the right format and processor, with
# the entry symbol as their only export, that need the system's libraries alone.
godot4_try() {
  local zip="$1/hf_godot4-$hf_version.zip" project="$2/godot4" inside symbol feature file exports needs count=0
  [ -e "$zip" ] || {
    hf_ran "the add-on for Godot 4 is skipped: HF_GODOT4 is not set"
    return 0
  }
  mkdir -p "$project"
  (cd "$project" && python3 -m zipfile -e "$zip" .) || exit 1
  inside="$project/addons/hf"
  symbol=$(sed -n 's/^entry_symbol = "\(.*\)"$/\1/p' "$inside/hf.gdextension")
  [ -n "$symbol" ] || hf_fail "no entry symbol in hf.gdextension"
  for file in hf-MIT.txt godot-cpp-MIT.txt; do
    grep -q 'Permission is hereby granted' "$inside/licences/$file" || hf_fail "the licence $file"
  done
  while read -r feature file; do
    [ -s "$project/$file" ] || hf_fail "hf.gdextension names $file, which is not in the zip"
    file="$project/$file"
    case "$feature" in
      linux.*)
        case "$feature" in *.x86_64) exports=X86-64 ;; *.arm64) exports=AArch64 ;; *) hf_fail "$feature" ;; esac
        readelf -hW "$file" | grep -qE "Class: +ELF64" && readelf -hW "$file" | grep -qE "Type: +DYN" &&
          readelf -hW "$file" | grep -qE "Machine: .*$exports" || hf_fail "$file is not for $feature"
        exports=$(readelf --dyn-syms -W "$file" | awk '$7 ~ /^[0-9]+$/ && $5 != "LOCAL" { print $8 }')
        needs=$(readelf -dW "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -vE '^(lib(c|m|pthread|dl|gcc_s)\.so\.[0-9]|ld-linux.*)$')
        ;;
      windows.*.x86_64)
        x86_64-w64-mingw32-objdump -f "$file" | grep -q 'file format pei-x86-64' || hf_fail "$file is not for $feature"
        exports=$(x86_64-w64-mingw32-objdump -p "$file" | awk '/^\[Ordinal\/Name Pointer\] Table/ { on = 1; next } on && !NF { exit } on { print $NF }')
        needs=$(x86_64-w64-mingw32-objdump -p "$file" | sed -n 's/.*DLL Name: //p' | grep -viE '^(kernel32|msvcrt|user32|advapi32)\.dll$')
        ;;
      *) hf_fail "an unknown platform: $feature" ;;
    esac
    [ "$exports" = "$symbol" ] || hf_fail "$file exports $(printf '%s' "$exports" | head -5 | paste -sd' ')"
    [ -z "$needs" ] || hf_fail "$file needs $(printf '%s' "$needs" | paste -sd' ')"
    count=$((count + 1))
  done < <(sed -n '/^\[libraries\]/,$s/^\([a-z0-9_.]*\) = "res:\/\/\(.*\)"$/\1 \2/p' "$inside/hf.gdextension")
  [ "$count" -gt 0 ] || hf_fail "hf.gdextension names no library"
  hf_ran "Godot 4: hf.gdextension of $count lines, each with a library of its processor that exports $symbol alone; never in Godot 4"
}

godot_try() {
  local out=$1 scratch=$2 filled
  godot4_try "$out" "$scratch"
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
