#!/usr/bin/env bash
# run_rust.sh LIBRARY SCRATCH ARGS...: cargo in the crate's folder, without a network; 77 (skipped) without cargo 1.70.
command -v cargo >/dev/null || { echo "skipped: no cargo here (Rust 1.70 or newer)"; exit 77; }
version=$(cargo --version | awk '{print $2}')
[ "$(printf '%s\n1.70.0\n' "$version" | sort -V | head -n 1)" = 1.70.0 ] || { echo "skipped: cargo $version is older than 1.70"; exit 77; }
root=$(cd "$(dirname "$0")/../.." && pwd)
HF_LIBRARY_DIR=$(dirname "$1")
export HF_LIBRARY_DIR LD_LIBRARY_PATH="$HF_LIBRARY_DIR" CARGO_TARGET_DIR=$2 CARGO_NET_OFFLINE=true
shift 2
cd "$root/bindings/rust" && exec cargo "$@"
