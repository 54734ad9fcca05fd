#!/usr/bin/env bash
# Compares the bits of builds: same_builds.sh PROGRAM PROGRAM... (reliability_same_bits of each build)
#   Every program must print the same with --hash. The promise is for one kind of processor. Kernels for AVX2 and AVX-512
#   give the same bits; plain kernels round differently (docs/promises.md).
set -u
different=0 first=
for program in "$@"; do
  hash=$("$program" --hash) || { echo "error: $program failed"; exit 1; }
  printf '%s  %s\n' "$hash" "$program"
  [ -n "$first" ] || first=$hash
  [ "$hash" = "$first" ] || different=$((different + 1))
done
printf 'SAME_BITS_BUILDS %s >=2\nSAME_BITS_BUILDS_THAT_DIFFER %s <=0\n' "$#" "$different"
[ "$#" -ge 2 ] && [ "$different" -eq 0 ]
