#!/usr/bin/env bash
# build.sh OUTDIR: hf.mjs and hf.wasm in OUTDIR (bindings/js/dist for the package).
# Needs emscripten, cmake, ninja, Eigen. HF_WASM_THREADS=ON: with threads, for pages that are isolated; hf.worker.js besides.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 1 ] || { echo "usage: build.sh OUTDIR" >&2; exit 2; }
command -v emcmake >/dev/null || { echo "skipped: no emscripten here (Debian: emscripten)"; exit 77; }
. "$here/../../../cmake/setup.sh" # for its bar
mkdir -p "$1"
out=$(cd "$1" && pwd)
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
emcmake cmake -S "$here" -B "$out" -G Ninja -DCMAKE_BUILD_TYPE=None \
  "-DHF_WASM_THREADS=${HF_WASM_THREADS:-OFF}" \
  >"$out/cmake.log" 2>&1 || {
  tail -20 "$out/cmake.log"
  exit 1
}
rm -f "$out/build.log"
NINJA_STATUS='[%f/%t] ' cmake --build "$out" ${HF_JOBS:+-j "$HF_JOBS"} 2>&1 | hf_progress "$out/build.log" || {
  grep -E 'error' "$out/build.log" | head -20
  exit 1
}
echo "hf.wasm: $(stat -c %s "$out/hf.wasm") bytes, hf.mjs: $(stat -c %s "$out/hf.mjs") bytes"
