#!/usr/bin/env bash
# run_mono.sh LIBRARY SCRATCH PROGRAM.cs ARGS...: compiles the C# classes and PROGRAM*.cs and runs it under Mono;
# 77 (skipped) without Mono.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
library=$1 scratch=$2 program=$3
shift 3
command -v mcs >/dev/null && command -v mono >/dev/null || {
  echo "skipped: no Mono here (Debian: mono-mcs mono-runtime libmono-system-core4.0-cil)"
  exit 77
}
mkdir -p "$scratch"
mcs -langversion:latest -unsafe -target:library -out:"$scratch/Hf.dll" "$root"/bindings/csharp/Hf/*.cs
mcs -langversion:latest -unsafe -r:"$scratch/Hf.dll" -r:System.Core -out:"$scratch/program.exe" \
  "${program%.cs}"*.cs "$root/tests/bindings/Json.cs"
ln -sf "$library" "$scratch/libhf.so"  # beside the assembly
exec mono "$scratch/program.exe" "$@"
