#!/usr/bin/env bash
# csharp_library.sh LIBRARY SCRATCH: the C# binding finds the library by HF_LIBRARY, then beside the assembly, and says in
# one sentence what is missing; 77 (skipped) without Mono.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
library=$1 scratch=$2
command -v mcs >/dev/null && command -v mono >/dev/null || {
  echo "skipped: no Mono here (Debian: mono-mcs mono-runtime)"
  exit 77
}
rm -rf "$scratch"
mkdir -p "$scratch/elsewhere"
mcs -langversion:latest -unsafe -target:library -out:"$scratch/Hf.dll" "$root"/bindings/csharp/Hf/*.cs
mcs -langversion:latest -r:"$scratch/Hf.dll" -out:"$scratch/program.exe" "$root/tests/bindings/CsharpLibrary.cs"
expect() { # label, expected words, environment...
  local label=$1 words=$2 said
  shift 2
  said=$(env -u HF_LIBRARY "$@" mono "$scratch/program.exe" 2>&1) || true
  case "$said" in *"$words"*) ;; *) echo "error: $label: $said"; exit 1 ;; esac
  [ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ] || { echo "error: $label: more than one line: $said"; exit 1; }
}
cp "$library" "$scratch/elsewhere/a name of its own.so"
expect "nothing" "the hf library was not found; set HF_LIBRARY to libhf.so or hf.dll, or put it beside Hf.dll"
expect "HF_LIBRARY" "found True" HF_LIBRARY="$scratch/elsewhere/a name of its own.so"
expect "a wrong HF_LIBRARY" "the hf library was not found as $scratch/none.so; set HF_LIBRARY" HF_LIBRARY="$scratch/none.so"
cp "$library" "$scratch/libhf.so.0"
expect "beside the assembly" "found True"
expect "HF_LIBRARY comes first" "the hf library was not found as $scratch/none.so" HF_LIBRARY="$scratch/none.so"
echo "found by HF_LIBRARY and beside the assembly; what is missing is said in one sentence"
