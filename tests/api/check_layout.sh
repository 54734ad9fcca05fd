#!/usr/bin/env bash
# Sizes, offsets and constants of the public headers against the pinned ones: check_layout.sh PROGRAM LAYOUT.TXT
set -u
if changes=$(diff "$2" <("$1")); then
  printf '%s lines as pinned\n' "$(wc -l <"$2")"
else
  printf 'error: the binary layout of the ABI has changed (< pinned in tests/api/layout.txt, > now):\n%s\n' "$changes"
  exit 1
fi
