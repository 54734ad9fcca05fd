#!/usr/bin/env bash
# Every function of the headers with a capacity stands in the table of protocol_test.c: check_protocol.sh HEADERS PROTOCOL_TEST.C
set -u
headers=$1 test=$2
plain=$(cat "$headers"/*.h | sed 's|/\*.*\*/||' | tr '\n' ' ' | grep -oE 'HF_API hf_result hf_[a-z0-9_]+\([^)]*capacity[^)]*\)' |
  sed -E 's/.* (hf_[a-z0-9_]+)\(.*/\1/')
structs=$(cat "$headers"/*.h | awk '/^typedef struct / { name = $3; has = 0 } /^ .*capacity[,;]/ { has = 1 } /^} / && has { print name; has = 0 }')
[ -n "$plain" ] && [ -n "$structs" ] || { printf 'error: the headers in %s were not understood\n' "$headers"; exit 1; }
by_struct=$(for name in $structs; do
  cat "$headers"/*.h | tr '\n' ' ' | grep -oE "HF_API hf_result hf_[a-z0-9_]+\\([^)]*[ (]$name\\* [^)]*\\)" | sed -E 's/HF_API hf_result (hf_[a-z0-9_]+)\(.*/\1/'
done)
missing=$(for name in $plain $by_struct; do grep -q "{\"$name\"," "$test" || printf '%s ' "$name"; done)
[ -z "$missing" ] || { printf 'error: not in the table of protocol_test.c: %s\n' "$missing"; exit 1; }
printf '%s functions with a capacity, all in the table\n' "$(printf '%s\n' $plain $by_struct | sort -u | wc -l)"
