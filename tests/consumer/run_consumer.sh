#!/usr/bin/env bash
# Builds and runs one consumer project the way its author would.
# usage: run_consumer.sh find_package|pkg_config|fetch_content SOURCE_DIR BUILD_DIR
set -eu
kind=$1 source=$2 build=$3
work="$build/consumer/$kind"
rm -rf "$work"
mkdir -p "$work"
here="$source/tests/consumer"
quiet() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; echo "failed: $*"; exit 1; }; }
gpl=$(sed -n 's/^HF_WITH_GPL:BOOL=//p' "$build/CMakeCache.txt")

case "$kind" in
  find_package)
    quiet cmake --install "$build" --prefix "$work/prefix"
    quiet cmake -S "$here/find_package" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release
    quiet cmake --build "$work/build"
    if grep -rn "$source\|$build" "$work/prefix/lib"*/cmake "$work"/prefix/lib/*/cmake 2>/dev/null; then echo "the installed package names the build machine's folders"; exit 1; fi
    "$work/build/shared_consumer"
    "$work/build/static_consumer"
    ;;
  pkg_config)
    quiet cmake --install "$build" --prefix "$work/prefix"
    pc=$(find "$work/prefix" -name hf.pc)
    # CHOLMOD's own needs (BLAS, METIS) are not in hf.pc: a static program is made of what ships
    targets=("$work/consumer")
    [ "$gpl" = ON ] || targets+=("$work/consumer_static" "$work/consumer_archive")
    PKG_CONFIG_PATH=$(dirname "$pc") quiet make -C "$here/pkg_config" OUT="$work/consumer" "${targets[@]}"
    for program in "${targets[@]}"; do "$program"; done
    if [ "$gpl" != ON ] && readelf -d "$work/consumer_archive" | grep -q 'libhf'; then echo "hf_static.pc links the shared library"; exit 1; fi
    for file in LICENSE licences.txt; do [ -s "$work/prefix/share/doc/hf/$file" ] || { echo "no $file is installed"; exit 1; }; done
    for program in "$work"/prefix/bin/hf_*; do "$program" --help | grep -q '^usage: ' || { echo "$program does not start"; exit 1; }; done
    ;;
  fetch_content)
    # the files of a room compiled together: names of two files must not meet
    quiet cmake -S "$here/fetch_content" -B "$work/build" -G Ninja -DHF_SOURCE_DIR="$source" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=ON
    # it compiles the whole library once more: the quick form sees what would be compiled
    if [ -z "${HF_FULL_TESTS:-}" ]; then
      quiet ninja -C "$work/build" -n static_consumer shared_consumer
      grep -q 'Linking C executable shared_consumer' "$work/log" || { cat "$work/log"; exit 1; }
      echo "configured; --full builds and runs it"
      exit 0
    fi
    quiet cmake --build "$work/build" -j 2 --target static_consumer shared_consumer
    "$work/build/static_consumer"
    "$work/build/shared_consumer"
    ;;
  *) echo "unknown kind $kind"; exit 1 ;;
esac
