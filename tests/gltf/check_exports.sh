#!/usr/bin/env bash
# check_exports.sh LIBHF_GLTF.SO HEADER_FOLDER NM: the exported symbols are exactly the HF_GLTF_API functions of the
# header; the library calls nothing of hf.
set -u
library=$1 headers=$2 nm=$3
here=$(cd "$(dirname "$0")" && pwd)
export LC_ALL=C
status=0
complain() { printf 'error: %s\n' "$1"; status=1; }
. "$here/../support/exports.sh"
check_exported "$library" "$headers" HF_GLTF_API hf_gltf_
if found=$("$nm" -D --undefined-only "$library" | awk '{print $NF}' | grep -E '^hf_'); then
  complain "the library calls hf:"
  printf '%s\n' "$found"
fi
[ "$status" -eq 0 ] && printf '%s exported symbols\n' "$(printf '%s\n' "$exported" | wc -l)"
exit "$status"
