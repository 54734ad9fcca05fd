#!/usr/bin/env bash
# run_node.sh LIBRARY WASM_FOLDER SCRIPT ARGS...: a test in node; 77 (skipped) without node.
set -u
here=$(cd "$(dirname "$0")" && pwd)
export HF_LIBRARY=$1 HF_WASM=$2 HF_NODE_MODULES=${HF_NODE_MODULES:-$here/../../build/npm/node_modules}
shift 2
command -v node >/dev/null || { echo "skipped: no node here"; exit 77; }
exec node --expose-gc "$@"
