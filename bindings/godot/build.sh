#!/usr/bin/env bash
# build.sh LIBRARY OUTDIR: the add-on folder OUTDIR/hf for Godot 3 (libhf_godot.so, libhf.so, scripts). Godot's headers
# come from GODOT_SOURCE (a folder that holds modules/gdnative) or from Debian's source package. For Windows: hf.dll as
# LIBRARY and MinGW as CXX.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
library=$1
mkdir -p "$2"
out=$(cd "$2" && pwd)
. "$here/../debian_source.sh"
source=${GODOT_SOURCE:-}
if [ -z "$source" ]; then
  source=$(hf_debian_source godot "$out/source" godot '*/modules/gdnative/include/*' '*/modules/gdnative/*.py' \
    '*/modules/gdnative/*.json') || exit $?
fi
headers="$source/modules/gdnative"
generated="$out/generated"
mkdir -p "$generated" "$out/hf"
python3 - "$headers" "$generated/gdnative_api_struct.gen.h" <<'PY'
import json, sys
sys.path.insert(0, sys.argv[1])
import types
sys.modules["platform_methods"] = types.SimpleNamespace(subprocess_main=None)
import gdnative_builders
api = json.load(open(sys.argv[1] + "/gdnative_api.json"))
open(sys.argv[2], "w").write(gdnative_builders._build_gdnative_api_struct_header(api))
PY
compile=("${CXX:-c++}" -std=c++17 -O2 -shared -fvisibility=hidden -w -I"$headers/include" -I"$generated" -I"$here/../../include"
  "$here"/src/gdnative.cpp "$here"/src/surface*.cpp)
case "$library" in
  *.dll)
    # no date, and an address that is not made of the folder's name: the same bytes anywhere
    "${compile[@]}" -o "$out/hf/hf_godot.dll" "$library" -static -Wl,--no-insert-timestamp,--image-base,0x180000000
    cp -L "$library" "$out/hf/hf.dll"
    ;;
  *)
    "${compile[@]}" -fPIC -Wl,--build-id=none -o "$out/hf/libhf_godot.so" -L"$(dirname "$library")" -l:"$(basename "$library")" -Wl,-rpath,'$ORIGIN'
    cp -L "$library" "$out/hf/$(objdump -p "$library" | awk '/SONAME/ { print $2 }')"
    ;;
esac
cp "$here/addon/hf.gdnlib" "$here/addon/hf_surface.gdns" "$out/hf/"
for script in hf_deformer hf_retarget; do sed -f "$here/godot3.sed" "$here/addon/$script.gd" >"$out/hf/$script.gd"; done
