#!/usr/bin/env bash
# build.sh OUTDIR [SUITESPARSE_SOURCE]: hf.mjs and hf.wasm in OUTDIR (bindings/js/dist for the package).
# Needs emscripten, cmake, ninja, Eigen; AMD's source comes from Debian's source package when no folder is given.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 1 ] || { echo "usage: build.sh OUTDIR [SUITESPARSE_SOURCE]" >&2; exit 2; }
command -v emcmake >/dev/null || { echo "skipped: no emscripten here (Debian: emscripten)"; exit 77; }
mkdir -p "$1"
out=$(cd "$1" && pwd)
source=${2:-}
if [ -z "$source" ]; then
  source=$(find "$out/suitesparse" -maxdepth 1 -name 'SuiteSparse-*' 2>/dev/null | head -1)
  if [ -z "$source" ]; then
    mkdir -p "$out/suitesparse/lists/partial"
    cd "$out/suitesparse"
    . /etc/os-release
    # the source archive that belongs to the packages this machine is set up with
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 2>/dev/null | awk -v r="${VERSION_CODENAME:-}" '$2 == r && $3 == "main" { print $1; exit }')
    echo "deb-src ${mirror:-none:} ${VERSION_CODENAME:-stable} main" >source.list
    apt="apt-get -qq -o Dir::Etc::sourcelist=$PWD/source.list -o Dir::Etc::sourceparts=- -o Dir::State::lists=$PWD/lists -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache="
    { $apt update && $apt source --download-only suitesparse; } >apt.log 2>&1 || { echo "skipped: the source of suitesparse is not to be had here (see $PWD/apt.log)"; exit 77; }
    tar xf suitesparse_*.orig.tar.* --wildcards '*/AMD/*' '*/SuiteSparse_config/*'
    source=$(find "$PWD" -maxdepth 1 -name 'SuiteSparse-*' | head -1)
    cd "$out"
  fi
fi
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
emcmake cmake -S "$here" -B "$out" -G Ninja -DCMAKE_BUILD_TYPE=None -DSUITESPARSE_SOURCE="$source" >"$out/cmake.log" 2>&1 || { tail -20 "$out/cmake.log"; exit 1; }
cmake --build "$out" ${HF_JOBS:+-j "$HF_JOBS"} >"$out/build.log" 2>&1 || { grep -E 'error' "$out/build.log" | head -20; exit 1; }
echo "hf.wasm: $(stat -c %s "$out/hf.wasm") bytes, hf.mjs: $(stat -c %s "$out/hf.mjs") bytes"
