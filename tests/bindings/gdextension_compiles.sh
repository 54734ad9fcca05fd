#!/usr/bin/env bash
# gdextension_compiles.sh COMPILER SCRATCH: the GDExtension source compiles against stand-ins for godot-cpp, and the
# .gdextension names its entry function.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$2/godot_cpp/classes" "$2/godot_cpp/core" "$2/godot_cpp/variant"
for header in classes/ref_counted core/class_db godot variant/variant; do
  printf '#include "%s/tests/bindings/godot_cpp_stubs.h"\n' "$root" >"$2/godot_cpp/$header.hpp"
done
symbol=$(sed -n 's/^entry_symbol = "\(.*\)"$/\1/p' "$root/bindings/godot/addon4/hf.gdextension")
grep -q "GDE_EXPORT $symbol(" "$root/bindings/godot/src/gdextension.cpp"
exec "$1" -std=c++17 -Wall -Wextra -fsyntax-only -I"$2" -I"$root/include" "$root/bindings/godot/src/gdextension.cpp"
