# Sourced by linux_x64.sh, windows_x64.sh and linux_arm64.sh: an archive with headers, shared and static library, CMake and
# pkg-config files, licences, checksums and a bill of materials.

# archive_make PLATFORM OUT KIND: KIND is tar or zip
archive_make() {
  local platform=$1 out=$2 kind=$3 name folder
  name="hf-$hf_version-$platform"
  folder=$(mktemp -d) || exit 1
  cp -a "$hf_work/$platform/tree" "$folder/$name"
  if [ "$platform" = windows-x64 ]; then archive_import_library "$folder/$name"; fi
  cp "$hf_root/README.md" "$hf_root/CHANGELOG.md" "$folder/$name/"
  hf_licences "$folder/$name/licences" "$platform"
  hf_bom "$folder/$name/bom.cdx.json" "$platform" "$folder/$name"
  (cd "$folder/$name" && find . -type f ! -name SHA256SUMS -printf '%P\0' | sort -z | xargs -0 sha256sum >SHA256SUMS)
  if [ "$kind" = tar ]; then
    hf_pack tar "$out/$name.tar.gz" "$folder/$name"
  else
    hf_pack zip "$out/$name.zip" "$folder/$name"
  fi
  rm -rf "$folder"
}

# For compilers other than MinGW: hf.lib, made of the names of the DLL.
archive_import_library() {
  local version
  { printf 'LIBRARY hf.dll\nEXPORTS\n'; cat "$hf_root/bindings/functions.txt"; } >"$1/lib/hf.def"
  for version in 19 18 17 16; do
    command -v "llvm-dlltool-$version" >/dev/null || continue
    hf_quiet "llvm-dlltool-$version" -m i386:x86-64 -d "$1/lib/hf.def" -l "$1/lib/hf.lib"
    return
  done
  hf_fail "no llvm-dlltool here for hf.lib (Debian: llvm-19)"
}

# archive_try PLATFORM OUT SCRATCH: unpacks it and lets newcomers' projects find it: CMake (shared and static), pkg-config.
# Then the golden scenes and bad calls run on the unpacked library, with nothing else on the path.
archive_try() {
  local platform=$1 out=$2 scratch=$3 name prefix filled program consumer=() said folder
  name="hf-$hf_version-$platform"
  prefix="$scratch/$name"
  hf_toolchain "$platform"
  case "$platform" in
    windows-x64) (cd "$scratch" && python3 -m zipfile -e "$out/$name.zip" .) ;;
    *) tar xzf "$out/$name.tar.gz" -C "$scratch" ;;
  esac
  (cd "$prefix" && sha256sum --quiet -c SHA256SUMS) || hf_fail "checksums"
  if grep -rlF "$hf_root" "$prefix"; then hf_fail "the package names folders of the machine that built it"; fi
  filled=$(hf_filled) || exit 1

  # a project of CMake
  [ "$platform" = linux-x64 ] || consumer=(-DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/${platform/*-arm64/arm64}.cmake")
  [ "$platform" != windows-x64 ] || consumer=(-DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/windows.cmake")
  hf_quiet cmake -S "$hf_root/tests/consumer/find_package" -B "$scratch/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -Dhf_DIR="$prefix/lib/cmake/hf" "${consumer[@]+"${consumer[@]}"}"
  hf_quiet cmake --build "$scratch/consumer"
  case "$platform" in windows-x64) cp "$prefix/bin/hf.dll" "$scratch/consumer/" ;; esac
  for program in shared_consumer static_consumer; do
    [ "$platform" = windows-x64 ] && program=$program.exe
    hf_quiet "${hf_clean_env[@]}" ${WINEPREFIX:+WINEPREFIX="$WINEPREFIX"} WINEDEBUG=-all \
      "${hf_runner[@]+"${hf_runner[@]}"}" "$scratch/consumer/$program"
  done

  # pkg-config, both ways
  for program in shared static; do
    local flags=()
    [ "$program" = static ] && flags=(-static)
    # shellcheck disable=SC2046
    hf_quiet "$hf_cc" -std=c99 "$hf_root/tests/consumer/use_hf.c" -o "$scratch/$program.exe" "${flags[@]+"${flags[@]}"}" \
      $([ "$program" = static ] && printf -- '-DHF_STATIC') \
      $(PKG_CONFIG_PATH="$prefix/lib/pkgconfig" pkg-config ${flags:+--static} --cflags --libs hf)
  done
  case "$platform" in windows-x64) cp "$prefix/bin/hf.dll" "$scratch/" ;; esac
  for program in shared static; do
    hf_quiet "${hf_clean_env[@]}" LD_LIBRARY_PATH="$prefix/lib" ${WINEPREFIX:+WINEPREFIX="$WINEPREFIX"} WINEDEBUG=-all \
      "${hf_runner[@]+"${hf_runner[@]}"}" "$scratch/$program.exe"
  done

  # the golden scenes, with the shared library
  case "$platform" in
    windows-x64) hf_golden_program "$platform" "$scratch/golden.exe" -static "$prefix/lib/libhf.dll.a" ;;
    *) hf_golden_program "$platform" "$scratch/golden.exe" -L"$prefix/lib" -lhf -Wl,-rpath,'$ORIGIN/'"$name/lib" ;;
  esac
  said=$("${hf_clean_env[@]}" ${WINEPREFIX:+WINEPREFIX="$WINEPREFIX"} WINEDEBUG=-all "${hf_runner[@]+"${hf_runner[@]}"}" \
    "$scratch/golden.exe" "$hf_golden/meshes" "$filled" "$hf_golden/bad_input.json" 2>&1) || {
    printf '%s\n' "$said" | grep -vE ': [0-9]+ steps' | head -20 >&2
    hf_fail "golden scenes of $name"
  }
  hf_ran "$(printf '%s\n' "$said" | grep -cE ': [0-9]+ steps') golden scenes, $(printf '%s\n' "$said" | sed -n 's/ wrong calls answered.*//p') bad calls; CMake and pkg-config, shared and static"
}

# archive_linux PLATFORM make|try ...: the archive of a Linux, which also says which glibc its library asks for
archive_linux() {
  case "$2" in
    make) archive_make "$1" "$3" tar ;;
    try)
      archive_try "$1" "$3" "$4"
      hf_symbol_versions "$4/hf-$hf_version-$1/lib/libhf.so"
      ;;
  esac
}
