#!/usr/bin/env bash
# Sizes, offsets and constants of the public headers against the pinned ones:
# check_layout.sh PROGRAM LAYOUT.TXT HEADERS [EMULATOR...]
set -u
program=$1 pinned=$2 headers=$3
shift 3
# every struct is filled by its fields: no padding that a caller could leave undefined
holes=$(awk '/ size / { if (name && end != size) print name " ends with padding"; name = $1; size = $3; end = 0 }
             / at / { if ($3 + 0 != end) print name ": padding before " $1; end = $3 + $4 }
             END { if (name && end != size) print name " ends with padding" }' "$pinned")
[ -z "$holes" ] || { printf 'error: implicit padding in the ABI:\n%s\n' "$holes"; exit 1; }
# every struct and every constant of the headers is pinned
named=$(cat "$headers"/*.h | sed -nE 's/^typedef struct (hf_[a-z0-9_]+) \{.*/\1 size/p'
  cat "$headers"/*.h | grep -oE 'HF_[A-Z0-9_]+ = ' | sort -u)
[ "$(printf '%s\n' "$named" | wc -l)" -ge "${HF_LEAST_NAMED:-100}" ] || { printf 'error: the headers in %s were not understood\n' "$headers"; exit 1; }
missing=$(while read -r name sign; do grep -q "^$name $sign " "$pinned" || printf '%s\n' "$name"; done <<<"$named")
[ -z "$missing" ] || { printf 'error: layout_print.c does not print:\n%s\n' "$missing"; exit 1; }
if changes=$(diff "$pinned" <("$@" "$program" | tr -d '\r')); then
  printf '%s lines as pinned\n' "$(wc -l <"$pinned")"
else
  printf 'error: the binary layout of the ABI has changed (< pinned in tests/api/layout.txt, > now):\n%s\n' "$changes"
  exit 1
fi
