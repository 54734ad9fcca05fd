#!/usr/bin/env bash
# check_exports.sh LIBHF_GLTF.SO HEADER_FOLDER NM: the exported symbols are exactly those of exports.txt, and exactly the
# HF_GLTF_API functions of the header; the library calls nothing of hf.
set -u
library=$1 headers=$2 nm=$3
here=$(cd "$(dirname "$0")" && pwd)
export LC_ALL=C
status=0
complain() { printf 'error: %s\n' "$1"; status=1; }
exported=$("$nm" -D --defined-only "$library" | awk '{print $NF}' | sed 's/@.*//' | sort -u)
[ -n "$exported" ] || complain "nm lists no exported symbol of $library"
changes=$(diff <(sort -u "$here/exports.txt") <(printf '%s\n' "$exported")) || {
  complain "the exported symbols differ from tests/gltf/exports.txt (< expected, > in the library):"
  printf '%s\n' "$changes"
}
declared=$(cat "$headers"/*.h | grep -E '^HF_GLTF_API ' | grep -oE 'hf_gltf_[a-z0-9_]+\(' | tr -d '(' | sort -u)
changes=$(diff <(printf '%s\n' "$declared") <(printf '%s\n' "$exported")) || {
  complain "the exported symbols are not those the header declares (< declared, > exported):"
  printf '%s\n' "$changes"
}
if found=$("$nm" -D --undefined-only "$library" | awk '{print $NF}' | grep -E '^hf_'); then
  complain "the library calls hf:"
  printf '%s\n' "$found"
fi
[ "$status" -eq 0 ] && printf '%s exported symbols\n' "$(printf '%s\n' "$exported" | wc -l)"
exit "$status"
