#!/usr/bin/env bash
# unity_plays.sh LIBRARY SCRATCH: the assembled UPM package compiles against stand-ins for Unity's API, and plays there.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
command -v mcs >/dev/null && command -v mono >/dev/null || { echo "skipped: no Mono here (Debian: mono-mcs mono-runtime libmono-system-core4.0-cil)"; exit 77; }
python3 "$here/../../bindings/unity/make_package.py" "$2"
awk '/^```/ { on = 0 } on; /^```csharp/ && ++block == 2 { on = 1 }' "$here/../../bindings/unity/README.md" >"$2/Readme.cs"
mcs -langversion:latest -unsafe -nowarn:649,169 -r:System.Core -out:"$2/unity.exe" "$here/UnityStubs.cs" "$here/UnityPlays.cs" "$2/Readme.cs" \
  $(find "$2/org.hf.fields" -name '*.cs')
ln -sf "$1" "$2/libhf.so"  # beside the assembly
exec mono "$2/unity.exe"
