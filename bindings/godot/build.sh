#!/usr/bin/env bash
# build.sh LIBRARY OUTDIR: the add-on folder OUTDIR/hf for Godot 3 (libhf_godot.so, libhf.so, scripts). Godot's headers come from
# GODOT_SOURCE (a folder that holds modules/gdnative) or from Debian's source package.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
library=$1
mkdir -p "$2"
out=$(cd "$2" && pwd)
source=${GODOT_SOURCE:-$(find "$out/source" -maxdepth 1 -name 'godot-*' 2>/dev/null | head -1)}
if [ -z "$source" ]; then
  mkdir -p "$out/source/lists/partial"
  cd "$out/source"
  . /etc/os-release
  # the source archive that belongs to the packages this machine is set up with
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 2>/dev/null | awk -v r="${VERSION_CODENAME:-}" '$2 == r && $3 == "main" { print $1; exit }')
  echo "deb-src ${mirror:-none:} ${VERSION_CODENAME:-stable} main" >source.list
  apt="apt-get -qq -o Dir::Etc::sourcelist=$PWD/source.list -o Dir::Etc::sourceparts=- -o Dir::State::lists=$PWD/lists -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache="
  { $apt update && $apt source --download-only godot; } >apt.log 2>&1 || { echo "skipped: Godot's headers are not to be had here (see $PWD/apt.log)"; exit 77; }
  tar xf godot_*.orig.tar.* --wildcards '*/modules/gdnative/include/*' '*/modules/gdnative/*.py' '*/modules/gdnative/*.json'
  source=$(find "$PWD" -maxdepth 1 -name 'godot-*' | head -1)
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
open(sys.argv[2], "w").write(gdnative_builders._build_gdnative_api_struct_header(json.load(open(sys.argv[1] + "/gdnative_api.json"))))
PY
c++ -std=c++17 -O2 -shared -fPIC -fvisibility=hidden -w -I"$headers/include" -I"$generated" -I"$here/../../include" "$here/src/gdnative.cpp" "$here/src/surface.cpp" \
  -o "$out/hf/libhf_godot.so" -L"$(dirname "$library")" -l:"$(basename "$library")" -Wl,-rpath,'$ORIGIN'
cp -L "$library" "$out/hf/$(objdump -p "$library" | awk '/SONAME/ { print $2 }')"
cp "$here"/addon/* "$out/hf/"
