#!/usr/bin/env bash
# hf_godot4-VERSION.zip: the add-on for Godot 4 (folder addons/hf of a project), one library for each platform.
# hf_godot3-VERSION.zip: the add-on for Godot 3 (folder hf of a project) with GDNative libraries for Linux and Windows. It needs
# Godot's headers.
. "$(dirname "$0")/common.sh"

godot4_make() {
  local out=$1 folder platform platforms portable
  folder=$(mktemp -d) || exit 1
  platforms=$(hf_platforms | paste -sd,)
  for platform in $(hf_platforms); do
    hf_toolchain "$platform"
    portable=
    case "$platform" in linux-*) portable="$hf_work/$platform/build/portable" ;; esac
    CXX=$hf_cxx HF_PORTABLE_DIR=$portable hf_quiet "$hf_root/bindings/godot/build4.sh" "$hf_work/$platform/tree/lib/libhf.a" "$folder"
  done
  hf_licences "$folder/addons/hf/licences" "$platforms"
  hf_bom "$folder/addons/hf/bom.cdx.json" "$platforms" "$folder/addons/hf"
  find "$folder" -type f -exec chmod 644 {} +
  hf_pack zip "$out/hf_godot4-$hf_version.zip" "$folder" .
  rm -rf "$folder"
}

godot3_make() {
  local out=$1 folder platform code
  folder=$(mktemp -d) || exit 1
  for platform in $(hf_platforms); do
    case "$platform" in linux-x64 | windows-x64) ;; *) continue ;; esac
    hf_toolchain "$platform"
    GODOT_SOURCE=${GODOT_SOURCE:-$(godot_headers)} CXX=$hf_cxx "$hf_root/bindings/godot/build.sh" "$(godot_library "$platform")" "$folder/$platform" >"$hf_work/godot.log" 2>&1 || {
      code=$?
      [ "$code" != 77 ] || return 0  # the other zip is made all the same; the try says that this one is not
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

# The .gdextension names libraries that are there, of the right format and processor, with the entry symbol as their only export,
# that need the system's libraries alone, and glibc 2.17 at most. Each loads in a host without Godot. The golden scenes run in
# Godot 4 where there is one.
godot4_try() {
  local zip="$1/hf_godot4-$hf_version.zip" scratch="$2/godot4" inside symbol feature file exports needs seen='' said godot
  mkdir -p "$scratch"
  (cd "$scratch" && python3 -m zipfile -e "$zip" .) || exit 1
  inside="$scratch/addons/hf"
  symbol=$(sed -n 's/^entry_symbol = "\(.*\)"$/\1/p' "$inside/hf.gdextension")
  [ -n "$symbol" ] || hf_fail "no entry symbol in hf.gdextension"
  grep -q 'Permission is hereby granted' "$inside/licences/hf-MIT.txt" || hf_fail "the licence hf-MIT.txt"
  while read -r feature file; do
    [ -s "$scratch/$file" ] || hf_fail "hf.gdextension names $file, which is not in the zip"
    file="$scratch/$file"
    case "$feature" in
      linux.*)
        case "$feature" in *.x86_64) exports=X86-64 ;; *.arm64) exports=AArch64 ;; *) hf_fail "$feature" ;; esac
        readelf -hW "$file" | grep -qE "Class: +ELF64" && readelf -hW "$file" | grep -qE "Type: +DYN" &&
          readelf -hW "$file" | grep -qE "Machine: .*$exports" || hf_fail "$file is not for $feature"
        exports=$(readelf --dyn-syms -W "$file" | awk '$7 ~ /^[0-9]+$/ && $5 != "LOCAL" { print $8 }')
        needs=$(readelf -dW "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -vE '^(lib(c|m|pthread|dl|gcc_s)\.so\.[0-9]|ld-linux.*)$')
        (hf_symbol_versions "$file") >/dev/null || exit 1
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
    case "$seen" in *"$file"*) ;; *) seen="$seen $file" && godot4_load "$file" "$2" </dev/null ;; esac
  done < <(sed -n '/^\[libraries\]/,$s/^\([a-z0-9_.]*\) = "res:\/\/\(.*\)"$/\1 \2/p' "$inside/hf.gdextension")
  [ -n "$seen" ] || hf_fail "hf.gdextension names no library"
  said="never in Godot 4 here"
  if godot=$("$hf_root/tests/platforms/godot4_program.sh" 2>/dev/null); then
    HF_GODOT4=$godot HF_SCENES=$(hf_filled) "$hf_tests/run_godot4.sh" "$scratch/addons" "$scratch" none "$hf_tests/godot_test.gd" >"$2/godot4.log" 2>&1 || {
      tail -20 "$2/godot4.log" >&2
      hf_fail "the golden scenes in Godot 4"
    }
    said="in a project of Godot $("$godot" --version): $(grep -m1 'steps run' "$2/godot4.log")"
  fi
  hf_ran "Godot 4: $(wc -w <<<"$seen") libraries that export $symbol alone and load in a host without Godot; $said"
}

# godot4_load LIBRARY SCRATCH: the library in a host without Godot.
godot4_load() {
  local platform host="$2/godot4_host" link=(-ldl)
  case "$1" in *.linux.x86_64.so) platform=linux-x64 ;; *.linux.arm64.so) platform=linux-arm64 ;; *) platform=windows-x64 link=(-static) ;; esac
  hf_toolchain "$platform"
  if [ "$platform" = windows-x64 ]; then hf_wine; fi
  hf_quiet "$hf_cxx" -std=c++17 -o "$host.$platform.exe" "$hf_tests/godot4_host.cpp" "${link[@]}"
  hf_quiet "${hf_runner[@]+"${hf_runner[@]}"}" "$host.$platform.exe" "$1"
}

godot_try() {
  local out=$1 scratch=$2 filled
  godot4_try "$out" "$scratch"
  [ -e "$out/hf_godot3-$hf_version.zip" ] || hf_skip "no headers of Godot 3 here; see $hf_work/godot.log"
  command -v godot3-server >/dev/null || hf_skip "no Godot 3 here (Debian: godot3-server)"
  filled=$(hf_filled) || exit 1
  mkdir -p "$scratch/project" "$scratch/home"
  (cd "$scratch/project" && python3 -m zipfile -e "$out/hf_godot3-$hf_version.zip" .) || exit 1
  sed -f "$hf_root/bindings/godot/godot3.sed" "$hf_tests/godot_test.gd" >"$scratch/project/test.gd"
  cp "$hf_tests/godot3_host.gd" "$scratch/project/host.gd"
  printf 'config_version=4\n[application]\nconfig/name="hf"\n' >"$scratch/project/project.godot"
  (cd "$scratch" && "${hf_clean_env[@]}" PATH="$PATH" HOME="$scratch/home" LANG=en_US.UTF-8 HF_GOLDEN="$hf_golden" HF_SCENES="$filled" \
    timeout 200 godot3-server --path "$scratch/project" -s test.gd) >"$scratch/godot.log" 2>&1 || {
    tail -20 "$scratch/godot.log" >&2
    hf_fail "the golden scenes in Godot"
  }
  hf_ran "unpacked into a project of Godot $(godot3-server --version 2>/dev/null | head -1): $(grep -m1 'steps run' "$scratch/godot.log"); the Windows library never ran in Godot"
}

case "$1" in
  make) godot4_make "$2" && godot3_make "$2" ;;
  try) godot_try "$2" "$3" ;;
esac
