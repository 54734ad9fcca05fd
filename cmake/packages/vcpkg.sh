#!/usr/bin/env bash
# hf-VERSION-vcpkg.tar.gz: the port for vcpkg (folder ports/hf of an overlay). Tried where VCPKG_ROOT is an installation:
# vcpkg builds it from the source archive by a file URL, static and shared, checks it, and C programs run against it.
# VCPKG_OVERLAY_PORTS can name a port of eigen3 where vcpkg cannot download its own; VCPKG_DOWNLOADS saves downloads.
# Without an installation, the port is read by CMake with stand-ins for vcpkg's functions, which run the same commands: that
# shows that the build and the fix-ups work, not that vcpkg takes the port.
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

# vcpkg_consumer SCRATCH KIND TRIPLET BUILD: a project of tests/consumer, built with vcpkg's toolchain file; its programs run.
vcpkg_consumer() {
  local folder="$1/consumer/$2-$3-$4" program
  hf_quiet cmake -S "$hf_root/tests/consumer/$2" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE="$4" -DVCPKG_MANIFEST_MODE=OFF \
    -DCMAKE_TOOLCHAIN_FILE="$VCPKG_ROOT/scripts/buildsystems/vcpkg.cmake" -DVCPKG_INSTALLED_DIR="$1/installed" -DVCPKG_TARGET_TRIPLET="$3"
  hf_quiet cmake --build "$folder"
  for program in "$folder"/*consumer; do hf_quiet "$program"; done
}

# vcpkg writes into SCRATCH alone: the installation stays as it was, and no cache of binaries answers in place of a build.
vcpkg_try_tool() {
  local scratch=$1 triplet program
  local vcpkg=("$VCPKG_ROOT/vcpkg" --classic --disable-metrics --overlay-ports="$scratch/ports" --binarysource=clear
    --x-buildtrees-root="$scratch/buildtrees" --x-packages-root="$scratch/packages" --x-install-root="$scratch/installed")
  export VCPKG_DOWNLOADS="${VCPKG_DOWNLOADS:-$scratch/downloads}" VCPKG_MAX_CONCURRENCY="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"
  mkdir -p "$VCPKG_DOWNLOADS"
  cp "$scratch/ports/hf/vcpkg.json" "$scratch/formatted.json"
  hf_quiet "${vcpkg[@]}" format-manifest "$scratch/formatted.json"
  cmp -s "$scratch/ports/hf/vcpkg.json" "$scratch/formatted.json" || hf_fail "vcpkg format-manifest would change vcpkg.json"
  for triplet in x64-linux x64-linux-dynamic; do
    hf_quiet "${vcpkg[@]}" install "hf:$triplet" --enforce-port-checks
    vcpkg_consumer "$scratch" add_port "$triplet" Debug
    vcpkg_consumer "$scratch" add_port "$triplet" Release
    program="$scratch/consumer/pkg_config-$triplet"
    PKG_CONFIG_PATH="$scratch/installed/$triplet/lib/pkgconfig" hf_quiet make -C "$hf_root/tests/consumer/pkg_config" OUT="$program" "$program"
    hf_quiet "$program"
  done
  # it asks for hf::hf_static by name too, which a shared package lacks
  vcpkg_consumer "$scratch" find_package x64-linux Release
  hf_ran "vcpkg install from a file URL, static and shared, with its checks as errors; C programs ran, Debug, Release and pkg-config"
}

vcpkg_try() {
  local out=$1 scratch=$2
  export HF_SOURCE_URL="file://$hf_work/first/source/hf-$hf_version-source.tar.gz"
  tar xzf "$out/hf-$hf_version-vcpkg.tar.gz" -C "$scratch"
  python3 -m json.tool "$scratch/ports/hf/vcpkg.json" >/dev/null || hf_fail "vcpkg.json"
  if [ -n "${VCPKG_ROOT:-}" ] && [ -x "$VCPKG_ROOT/vcpkg" ]; then
    vcpkg_try_tool "$scratch"
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
