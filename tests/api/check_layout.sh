#!/usr/bin/env bash
# Sizes, offsets and constants of the public headers against the pinned ones: check_layout.sh PROGRAM LAYOUT.TXT
set -u
# every struct is filled by its fields: no padding that a caller could leave undefined
holes=$(awk '/ size / { if (name && end != size) print name " ends with padding"; name = $1; size = $3; end = 0 }
             / at / { if ($3 + 0 != end) print name ": padding before " $1; end = $3 + $4 }' "$2")
[ -z "$holes" ] || { printf 'error: implicit padding in the ABI:\n%s\n' "$holes"; exit 1; }
if changes=$(diff "$2" <("$1")); then
  printf '%s lines as pinned\n' "$(wc -l <"$2")"
else
  printf 'error: the binary layout of the ABI has changed (< pinned in tests/api/layout.txt, > now):\n%s\n' "$changes"
  exit 1
fi
