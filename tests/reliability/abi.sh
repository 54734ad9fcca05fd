#!/usr/bin/env bash
# The binary interface against the one that was accepted last: abi.sh LIBHF.SO HEADER_FOLDER [--accept]
#   Compares functions, structs and enums by abidiff (Debian package abigail-tools) with abi/libhf.abi; new functions are no
#   change, anything else is. --accept writes the present interface there. Skipped (77) without abidiff, or when the
#   library has no debug information to read the interface from.
set -u
library=$1 headers=$2 accept=${3:-}
here=$(cd "$(dirname "$0")" && pwd)
command -v abidiff >/dev/null && command -v abidw >/dev/null || {
  echo "skipped: no abidiff here; the Debian package is abigail-tools"
  exit 77
}
readelf -S "$library" | grep -q '\.debug_info' || {
  echo "skipped: $library has no debug information; build it as Debug or RelWithDebInfo"
  exit 77
}
dump() { abidw --headers-dir "$headers" --drop-private-types --no-corpus-path --no-comp-dir-path --no-show-locs "$library"; }
if [ "$accept" = --accept ]; then
  dump >"$here/abi/libhf.abi"
  exit
fi
[ -f "$here/abi/libhf.abi" ] || {
  echo "skipped: no interface was accepted yet; --accept writes this one"
  exit 77
}
changes=$(abidiff --headers-dir1 "$headers" --headers-dir2 "$headers" --drop-private-types --no-added-syms --no-show-locs "$here/abi/libhf.abi" "$library")
code=$?
count=0
[ "$code" -eq 0 ] || count=$(printf '%s\n' "$changes" | grep -cE "^ *\[[CD]\]|^ *'?(function|struct|enum|type)")
[ "$code" -eq 0 ] || [ "$count" -gt 0 ] || count=1
printf 'ABI_CHANGES %s <=0\n' "$count"
[ "$code" -eq 0 ] && exit 0
printf '%s\n' "$changes"
echo "if this is meant: tests/reliability/abi.sh $library $headers --accept, and a new soname when old programs break"
exit 1
