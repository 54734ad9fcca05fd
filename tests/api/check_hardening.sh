#!/usr/bin/env bash
# Reads the flags of cmake/HfHardening.cmake out of what was built: check_hardening.sh READELF NM OBJDUMP LIBRARY PROGRAM...
#   RELRO with immediate binding, a stack that is not executable, guarded stacks and C library calls, marked landing
#   pads (x86), programs at random addresses. Return code 77 (skipped) where the files are not ELF.
set -u
readelf=$1 nm=$2 objdump=$3 library=$4
shift 3
export LC_ALL=C
status=0
only=--disassemble  # GNU's name of the option, and LLVM's
"$objdump" --version | grep -q LLVM && only=--disassemble-symbols
complain() { printf 'error: %s: %s\n' "$file" "$1"; status=1; }

for file in "$@"; do
  header=$("$readelf" -hW "$file" 2>/dev/null) || { echo "skipped: $file is no ELF file"; exit 77; }
  segments=$("$readelf" -lW "$file") dynamic=$("$readelf" -dW "$file")
  grep -q GNU_RELRO <<<"$segments" || complain "has no RELRO segment (-z relro)"
  grep -qE 'BIND_NOW|Flags:.*NOW' <<<"$dynamic" || complain "binds its calls late (-z now)"
  grep -qE 'GNU_STACK.* RW ' <<<"$segments" || complain "has an executable stack (-z noexecstack)"
  grep -qE ' RWE ' <<<"$segments" && complain "has a segment that is writable and executable"
  grep -qE 'Type: +DYN' <<<"$header" || complain "stands at a fixed address (PIE)"
  # the whole file is marked only where the C library's start code is too, so a function is asked
  if grep -q 'Machine:.*X86-64' <<<"$header"; then
    name=main
    [ "$file" = "$library" ] && name=hf_version_get
    "$objdump" -d "$only=$name" "$file" | grep -q endbr64 || complain "has no landing pads (-fcf-protection)"
  fi
done
# what guards stacks and C library calls shows in the library's calls
file=$library
calls=$("$nm" -D --undefined-only "$file")
grep -q '__stack_chk_fail' <<<"$calls" || complain "guards no stack (-fstack-protector-strong)"
grep -qE '__mem(cpy|set|move)_chk|__v?snprintf_chk' <<<"$calls" || complain "checks no call of the C library (_FORTIFY_SOURCE)"
[ "$status" -eq 0 ] && printf '%s files: hardened\n' "$#"
exit "$status"
