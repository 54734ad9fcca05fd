#!/usr/bin/env bash
# hf-VERSION-vcpkg.tar.gz: the port for vcpkg (folder ports/hf of an overlay). Tried where VCPKG_ROOT is an installation:
# vcpkg builds it from the source archive by a file URL. Without one, the port is read by CMake with stand-ins for vcpkg's
# functions, which run the same commands: that shows that the build and the fix-ups work, not that vcpkg takes the port.
. "$(dirname "$0")/common.sh"

vcpkg_make() {
  local folder archive="$hf_work/first/source/hf-$hf_version-source.tar.gz"
  [ -e "$archive" ] || { mkdir -p "${archive%/*}"; "$hf_here/source.sh" make "${archive%/*}"; } || exit 1
  folder=$(mktemp -d) || exit 1
  mkdir -p "$folder/ports/hf"
  cp "$hf_here/vcpkg/usage" "$folder/ports/hf/"
  sed "s/@VERSION@/$hf_version/" "$hf_here/vcpkg/vcpkg.json" >"$folder/ports/hf/vcpkg.json"
  sed "s/@SHA512@/$(sha512sum "$archive" | cut -d' ' -f1)/" "$hf_here/vcpkg/portfile.cmake" >"$folder/ports/hf/portfile.cmake"
  hf_pack tar "$1/hf-$hf_version-vcpkg.tar.gz" "$folder/ports" ports
  rm -rf "$folder"
}

vcpkg_try() {
  local out=$1 scratch=$2
  export HF_SOURCE_URL="file://$hf_work/first/source/hf-$hf_version-source.tar.gz"
  tar xzf "$out/hf-$hf_version-vcpkg.tar.gz" -C "$scratch"
  python3 -m json.tool "$scratch/ports/hf/vcpkg.json" >/dev/null || hf_fail "vcpkg.json"
  if [ -n "${VCPKG_ROOT:-}" ] && [ -x "$VCPKG_ROOT/vcpkg" ]; then
    VCPKG_KEEP_ENV_VARS=HF_SOURCE_URL hf_quiet "$VCPKG_ROOT/vcpkg" install hf --overlay-ports="$scratch/ports" --x-install-root="$scratch/installed"
    hf_quiet cmake -S "$hf_root/tests/consumer/find_package" -B "$scratch/consumer" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$VCPKG_ROOT/scripts/buildsystems/vcpkg.cmake" -D_VCPKG_INSTALLED_DIR="$scratch/installed"
    hf_ran "vcpkg install from a file URL; CMake finds it"
    return
  fi
  hf_quiet cmake -DPORTS="$scratch/ports/hf" -DVERSION="$hf_version" -DSCRATCH="$scratch" -DJOBS="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" -P "$hf_here/vcpkg/stand_in.cmake"
  hf_quiet cmake -S "$hf_root/tests/consumer/add_port" -B "$scratch/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/packages"
  hf_quiet cmake --build "$scratch/consumer"
  hf_quiet "$scratch/consumer/consumer"
  hf_ran "no vcpkg here: the port's steps ran by CMake with stand-ins for vcpkg's functions, from a file URL; a C program found it"
}

case "$1" in
  make) vcpkg_make "$2" ;;
  try) vcpkg_try "$2" "$3" ;;
esac
