#!/usr/bin/env bash
# build4.sh STATIC_LIBRARY OUTDIR: the add-on folder OUTDIR/addons/hf for Godot 4 (4.3 or newer): hf.gdextension, scripts and
# the library for the platform of the compiler CXX, with libhf.a inside. Run it once for each platform; Godot is not needed.
# HF_PORTABLE_DIR: the folder `portable` of a build with HF_PORTABLE; then glibc 2.17 and libgcc_s are enough on Linux.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
library=$1
out="$2/addons/hf"
mkdir -p "$out"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
CXX=${CXX:-c++}
machine=$("$CXX" -dumpmachine)
# nothing in the file tells the time or the folder of the build
# shellcheck disable=SC2206  # CXXFLAGS are words
compile=("$CXX" -std=c++17 -O2 ${CXXFLAGS:-} -shared -s -fvisibility=hidden -fstack-protector-strong -DHF_STATIC -I"$here/../../include"
  "$scratch/all.cpp")
# all files as one: their headers are most of what the compiler reads
printf '#include "%s"\n' "$here"/src/gdextension.cpp "$here"/src/surface*.cpp >"$scratch/all.cpp"
case "$machine" in
  x86_64*mingw*)
    # the objects of libhf.a ask to export the whole C interface
    cp -L "$library" "$scratch/libhf.a"
    "${OBJCOPY:-${CXX%%-g++*}-objcopy}" --remove-section .drectve "$scratch/libhf.a"
    "${compile[@]}" -o "$out/hf_godot4.windows.x86_64.dll" "$scratch/libhf.a" -static \
      -Wl,--exclude-all-symbols,--no-insert-timestamp,--image-base,0x180000000
    ;;
  x86_64*linux* | aarch64*linux*)
    case "$machine" in x86_64*) name=hf_godot4.linux.x86_64.so ;; *) name=hf_godot4.linux.arm64.so ;; esac
    printf '{ global: hf_godot_init; local: *; };\n' >"$scratch/exports.map"
    runtime=(-static-libgcc)
    [ -z "${HF_PORTABLE_DIR:-}" ] || runtime=("$HF_PORTABLE_DIR/single.c" "-Wl,--push-state,--no-as-needed"
      "$HF_PORTABLE_DIR/stand_in/libpthread.so.0" "-Wl,--pop-state")
    "${compile[@]}" -fPIC -pthread -o "$out/$name" "$library" "${runtime[@]}" -static-libstdc++ -Wl,--no-undefined,--gc-sections \
      -Wl,-z,relro,-z,now,--build-id=none,--version-script="$scratch/exports.map"
    ;;
  *)
    echo "error: hf.gdextension names no library for $machine" >&2
    exit 1
    ;;
esac
cp "$here/addon/hf_deformer.gd" "$here/addon/hf_retarget.gd" "$here/addon/hf_blended.gd" "$here/../shaders/hf_blend.gdshaderinc" "$out/"
# the lines of libraries that are there
while IFS= read -r line; do
  file=${line##*/}
  case "$line" in *res://*) [ -e "$out/${file%\"}" ] || continue ;; esac
  printf '%s\n' "$line"
done <"$here/addon/hf.gdextension" >"$out/hf.gdextension"
