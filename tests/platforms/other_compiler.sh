#!/usr/bin/env bash
# A host built by another compiler against the import library of hf.dll: other_compiler.sh HF.DLL IMPORT_LIBRARY ROOT
# SCRATCH EMULATOR...
#   Clang for MinGW builds samples/minimal as C, and a C++ host whose allocator throws through the DLL. Clang in MSVC mode
#   builds a program without a C library, against an import library made of the names of the DLL.
set -u
dll=$1 import=$2 root=$3 scratch=$4
shift 4
clang=
for version in 19 18 17 16 ''; do
  command -v "clang++${version:+-$version}" >/dev/null && { clang=$version; break; }
  clang=none
done
[ "$clang" != none ] || { printf 'skipped: no clang here\n'; exit 77; }
tool() { printf '%s%s' "$1" "${clang:+-$clang}"; }
rm -rf "$scratch"
mkdir -p "$scratch" && cp "$dll" "$scratch/" || exit 1
cd "$scratch" || exit 1
must() { "$@" || { printf 'error: %s failed\n' "$*"; exit 1; }; }
gcc=$(dirname "$(x86_64-w64-mingw32-g++-posix -print-libgcc-file-name)")
mingw=(--target=x86_64-w64-windows-gnu -static -L "$gcc" -B "$gcc" -I "$root/include")
must "$(tool clang)" "${mingw[@]}" -std=c99 -o minimal.exe "$root/samples/minimal/minimal.c" "$import"
said=$("$@" ./minimal.exe | tr -d '\r' | paste -sd' ')
[ "$said" = "0.000 0.000 0.500 0.500 1.000 1.000" ] || { printf 'error: samples/minimal printed: %s\n' "$said"; exit 1; }
cxx=("${mingw[@]}" -std=c++17 -pthread -isystem "$gcc/include/c++" -isystem "$gcc/include/c++/x86_64-w64-mingw32")
must "$(tool clang++)" "${cxx[@]}" -o throws.exe "$root/tests/platforms/throwing_host.cpp" "$import"
must "$@" ./throws.exe
if command -v "$(tool llvm-dlltool)" >/dev/null && command -v "$(tool lld-link)" >/dev/null; then
  { printf 'LIBRARY hf.dll\nEXPORTS\n'; cat "$root/bindings/functions.txt"; } >hf.def
  must "$(tool llvm-dlltool)" -m i386:x86-64 -d hf.def -l hf.lib
  printf 'LIBRARY kernel32.dll\nEXPORTS\nExitProcess\n' >kernel32.def
  must "$(tool llvm-dlltool)" -m i386:x86-64 -d kernel32.def -l kernel32.lib
  must "$(tool clang)" --target=x86_64-pc-windows-msvc -std=c99 -ffreestanding -O1 -c -I "$root/include" -o bare.obj "$root/tests/platforms/bare_host.c"
  must "$(tool lld-link)" /subsystem:console /entry:start /out:bare.exe bare.obj hf.lib kernel32.lib
  must "$@" ./bare.exe
  printf 'MinGW and MSVC hosts by %s\n' "$(tool clang)"
else
  printf 'MinGW hosts by %s; no lld-link here for one in MSVC mode\n' "$(tool clang)"
fi
