#!/usr/bin/env bash
# Every public header alone, as C99 and as C++17, without a warning: check_headers.sh HEADER_FOLDER CC CXX
set -u
include=$1 cc=$2 cxx=$3
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
warnings='-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror'
status=0
try() { # label, command...
  local label=$1
  shift
  if "$@" >"$folder/log" 2>&1; then printf 'ok     %s\n' "$label"; else printf 'error  %s\n' "$label" && cat "$folder/log" && status=1; fi
}
for header in "$include"/hf*/*.h; do
  name=${header#"$include"/}
  printf '#include "%s"\n#include "%s"\nint main(void) { return 0; }\n' "$name" "$name" >"$folder/alone.c"
  cp "$folder/alone.c" "$folder/alone.cpp"
  try "$name as C99" "$cc" -std=c99 $warnings -Wstrict-prototypes -Wold-style-definition -fsyntax-only -I"$include" "$folder/alone.c"
  try "$name as C11" "$cc" -std=c11 $warnings -Wstrict-prototypes -fsyntax-only -I"$include" "$folder/alone.c"
  try "$name as C++17" "$cxx" -std=c++17 $warnings -fsyntax-only -I"$include" "$folder/alone.cpp"
  if grep -nE '^[^/*]*\binline\b|\(\);' "$header"; then printf 'error  %s: inline, or () without void\n' "$name" && status=1; fi
done
# a host does not see the baselines of hf/peers.h
printf '#include "hf/hf.h"\nvoid* baseline(void) { return (void*)hf_peer_refactor_create; }\n' >"$folder/host.c"
printf '#include "hf/hf.hpp"\nvoid* baseline() { return (void*)hf_peer_refactor_create; }\n' >"$folder/host.cpp"
for host in "$cc -std=c99 $folder/host.c" "$cxx -std=c++17 $folder/host.cpp"; do
  if $host -fsyntax-only -I"$include" 2>"$folder/log" || ! grep -q 'hf_peer_refactor_create' "$folder/log"; then
    printf 'error  a host that includes hf/hf.h can name a baseline\n' && cat "$folder/log" && status=1
  fi
done
for header in "$include"/hf/*.hpp; do
  [ -e "$header" ] || continue
  name=$(basename "$header")
  printf '#include "hf/%s"\n#include "hf/%s"\nint main() { return 0; }\n' "$name" "$name" >"$folder/alone.cpp"
  try "$name as C++17" "$cxx" -std=c++17 $warnings -fsyntax-only -I"$include" "$folder/alone.cpp"
  try "$name as C++20" "$cxx" -std=c++20 $warnings -fsyntax-only -I"$include" "$folder/alone.cpp"
done
exit "$status"
