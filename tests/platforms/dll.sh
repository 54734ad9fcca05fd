#!/usr/bin/env bash
# The binary gate of Windows: dll.sh HF.DLL EXPORTS.TXT OBJDUMP
#   the DLL exports exactly bindings/functions.txt, and needs DLLs of the system alone.
set -u
library=$1 exports=$2 objdump=$3
export LC_ALL=C
status=0
exported=$("$objdump" -p "$library" | sed -n '/\[Ordinal\/Name Pointer\] Table/,/^$/s/^\t\[ *[0-9]*\] //p' | sort -u)
[ -n "$exported" ] || { printf 'error: %s exports nothing\n' "$library"; exit 1; }
if ! changes=$(diff <(sort -u "$exports") <(printf '%s\n' "$exported")); then
  printf 'error: the exports differ from bindings/functions.txt (< expected, > in the DLL):\n%s\n' "$changes"
  status=1
fi
needed=$("$objdump" -p "$library" | sed -n 's/^\tDLL Name: //p' | sort -u)
if found=$(printf '%s\n' "$needed" | grep -viE '^(kernel32|msvcrt|ucrtbase|api-ms-win-[a-z0-9-]+|advapi32)\.dll$'); then
  printf 'error: the DLL needs what Windows does not bring along:\n%s\n' "$found"
  status=1
fi
[ "$status" -eq 0 ] && printf '%s exports; needs %s\n' "$(printf '%s\n' "$exported" | wc -l)" "$(printf '%s\n' "$needed" | paste -sd' ')"
exit "$status"
