#!/usr/bin/env bash
# The binary gate of macOS: dylib.sh LIBRARY EXPORTS.TXT PROCESSOR
#   the library is of that processor and of macOS 11 or later, exports exactly bindings/functions.txt, and needs the
#   system's own library alone. Zig links its C++ runtime in and cannot hide the operators new and delete of it;
#   Apple's linker can (src/CMakeLists.txt).
set -u
library=$1 exports=$2 processor=$3
export LC_ALL=C
status=0
for version in -19 -18 -17 -16 ""; do command -v "llvm-nm$version" >/dev/null && command -v "llvm-otool$version" >/dev/null && break; done
exported=$("llvm-nm$version" -g --defined-only "$library" | sed -nE 's/^[0-9a-f]+ [A-Z] _//p' | grep -vE '^(_Z(na|nw|da|dl).*|__dso_handle|_mh_dylib_header)$' | sort -u)
if ! changes=$(diff <(sort -u "$exports") <(printf '%s\n' "$exported")); then
  printf 'error: the exports differ from bindings/functions.txt (< expected, > in the library):\n%s\n' "$changes"
  status=1
fi
needed=$("llvm-otool$version" -L "$library" | sed -nE 's/^\t([^ ]+) .*/\1/p' | tail -n +2)
[ "$needed" = /usr/lib/libSystem.B.dylib ] || { printf 'error: the library needs %s\n' "$needed"; status=1; }
found=$("llvm-otool$version" -l "$library" | awk '$1 == "minos" { print $2 }')
[ "$found" = 11.0 ] || { printf 'error: the library is for macOS %s\n' "$found"; status=1; }
"llvm-otool$version" -h -v "$library" | grep -qi "$processor" || { printf 'error: the library is not for %s\n' "$processor"; status=1; }
[ "$status" -eq 0 ] && printf '%s exports; macOS %s on %s\n' "$(printf '%s\n' "$exported" | wc -l)" "$found" "$processor"
exit "$status"
