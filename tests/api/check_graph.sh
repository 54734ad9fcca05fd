#!/usr/bin/env bash
# Every function that takes a surface or a solver is called on one of a graph: check_graph.sh HEADERS BAD_GRAPH_TEST.C
set -u
headers=$1 test=$2
functions=$(cat "$headers"/*.h | tr '\n' ' ' | grep -oE 'HF_API [^;]*;' | grep -E '[(,] *hf_(surface|solver) ' |
  sed -E 's/^[^(]*(hf_[a-z0-9_]+)\(.*/\1/')
[ -n "$functions" ] || { printf 'error: the headers in %s were not understood\n' "$headers"; exit 1; }
missing=$(for name in $functions; do grep -q "$name(" "$test" || printf '%s ' "$name"; done)
[ -z "$missing" ] || { printf 'error: not called on a graph in %s: %s\n' "$test" "$missing"; exit 1; }
printf '%s functions, all called on a graph\n' "$(printf '%s\n' $functions | wc -l)"
