#!/usr/bin/env bash
# build.sh OUTDIR: hf.mjs, hf.wasm, hf_slim.mjs and hf_slim.wasm in OUTDIR (bindings/js/dist for the package); prints their sizes.
# Needs emscripten (with node), cmake, ninja, Eigen. HF_WASM_SLIM=OFF: without the small build. HF_WASM_THREADS=ON: with threads, for pages that are isolated; hf.worker.js besides.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 1 ] || { echo "usage: build.sh OUTDIR" >&2; exit 2; }
command -v emcmake >/dev/null || { echo "skipped: no emscripten here (Debian: emscripten)"; exit 77; }
. "$here/../../../cmake/setup.sh" # for its bar
mkdir -p "$1"
out=$(cd "$1" && pwd)
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
emcmake cmake -S "$here" -B "$out" -G Ninja -DCMAKE_BUILD_TYPE=None \
  "-DHF_WASM_THREADS=${HF_WASM_THREADS:-OFF}" "-DHF_WASM_SLIM=${HF_WASM_SLIM:-ON}" \
  >"$out/cmake.log" 2>&1 || {
  tail -20 "$out/cmake.log"
  exit 1
}
rm -f "$out/build.log"
NINJA_STATUS='[%f/%t] ' cmake --build "$out" ${HF_JOBS:+-j "$HF_JOBS"} 2>&1 | hf_progress "$out/build.log" || {
  grep -E 'error' "$out/build.log" | head -20
  exit 1
}
for file in "$out"/hf.wasm "$out"/hf_slim.wasm; do
  [ ! -e "$file" ] || node -e 'const bytes = fs.readFileSync(process.argv[1]); const [gzip, brotli] = [zlib.gzipSync(bytes, { level: 9 }), zlib.brotliCompressSync(bytes)];
    console.log(`${path.basename(process.argv[1])}: ${bytes.length} bytes, ${gzip.length} with gzip, ${brotli.length} with brotli`)' "$file"
done
