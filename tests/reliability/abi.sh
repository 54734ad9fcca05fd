#!/usr/bin/env bash
# Compares the binary interface with the accepted one: abi.sh INCLUDE_FOLDER [--accept]
#   The interface is that of the headers. Every function of hf/hf.h and hf_gltf/gltf.h gets an empty body, and abidiff
#   (Debian package abigail-tools) compares functions and structs of each with abi/libhf.abi and abi/libhf_gltf.abi. bindings/api.json pins constants.
#   Dumps of the whole library do not work: they hold its inner types, and abidiff 2.2 cannot read them. New functions
#   are no change; anything else is. The test api_exports checks that the library exports the functions. --accept
#   writes the present interface. Exits with 77 (skipped) without abidiff.
set -u
include=$1 accept=${2:-}
here=$(cd "$(dirname "$0")" && pwd)
command -v abidiff >/dev/null && command -v abidw >/dev/null || {
  echo "skipped: no abidiff here; the Debian package is abigail-tools"
  exit 77
}
[ "$accept" = --accept ] || [ -e "$here/abi/libhf.abi" ] || {
  echo "skipped: no interface was accepted yet, since nothing is released; --accept writes the present one"
  exit 77
}
mkdir -p "$here/abi"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compiler=${CC:-cc}
count=0
for of in hf:hf/hf.h hf_gltf:hf_gltf/gltf.h; do
  library=lib${of%%:*} header=${of#*:}
  "$compiler" -E -P -x c -std=c99 -I"$include" -DHF_STATIC -DHF_GLTF_STATIC "$include/$header" |
    python3 -c 'import re, sys
print(re.sub(r"(?m)^((?!typedef)[^;{}#]*?\bhf_\w+\([^;{}]*\));", r"\1 { __builtin_trap(); }", sys.stdin.read()))' >"$scratch/interface.c"
  (cd "$scratch" && "$compiler" -std=gnu99 -g -w -shared -fPIC -fdebug-prefix-map="$scratch"=. -o "$library.so" interface.c) || exit 1
  if [ "$accept" = --accept ]; then
    abidw --no-corpus-path --no-comp-dir-path --no-show-locs "$scratch/$library.so" >"$here/abi/$library.abi"
    continue
  fi
  changes=$(abidiff --no-added-syms --no-show-locs "$here/abi/$library.abi" "$scratch/$library.so" 2>&1) && continue
  found=$(printf '%s\n' "$changes" | grep -cE "^ *\[[CD]\]|^ *'?(function|struct|enum|type)")
  [ "$found" -gt 0 ] || found=1
  count=$((count + found))
  printf '%s:\n%s\n' "$library" "$changes"
done
[ "$accept" = --accept ] && exit
printf 'ABI_CHANGES %s <=0\n' "$count"
[ "$count" -eq 0 ] && exit 0
echo "if this is meant: tests/reliability/abi.sh $include --accept, and a new soname when old programs break"
exit 1
