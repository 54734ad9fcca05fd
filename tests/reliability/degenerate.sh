#!/usr/bin/env bash
# Every function of two headers gets degenerate input: degenerate.sh HEADERS DEGENERATE.CPP
set -u
headers=$1 test=$2
functions=$(cat "$headers"/analysis.h "$headers"/direction.h | tr '\n' ' ' | grep -oE 'HF_API [^;]*;' |
  sed -E 's/^[^(]*(hf_[a-z0-9_]+)\(.*/\1/')
[ -n "$functions" ] || { printf 'error: the headers in %s were not understood\n' "$headers"; exit 1; }
missing=$(for name in $functions; do grep -q "$name(" "$test" || printf '%s ' "$name"; done)
[ -z "$missing" ] || { printf 'error: not called in %s: %s\n' "$test" "$missing"; exit 1; }
printf '%s functions, all called with degenerate input\n' "$(printf '%s\n' $functions | wc -l)"
