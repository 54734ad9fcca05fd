#!/usr/bin/env bash
# unity_compiles.sh SCRATCH: the assembled UPM package compiles against stand-ins for Unity's API.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
command -v mcs >/dev/null || { echo "skipped: no Mono here (Debian: mono-mcs)"; exit 77; }
python3 "$here/../../bindings/unity/make_package.py" "$1"
mcs -langversion:latest -unsafe -nowarn:649,169 -target:library -out:"$1/unity.dll" "$here/UnityStubs.cs" \
  $(find "$1/org.hf.fields" -name '*.cs')
