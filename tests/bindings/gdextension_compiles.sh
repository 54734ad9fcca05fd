#!/usr/bin/env bash
# gdextension_compiles.sh COMPILER SCRATCH: the GDExtension source compiles against stand-ins for godot-cpp.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$2/godot_cpp/classes" "$2/godot_cpp/core" "$2/godot_cpp/variant"
for header in classes/ref_counted core/class_db godot variant/variant; do
  printf '#include "%s/tests/bindings/godot_cpp_stubs.h"\n' "$root" >"$2/godot_cpp/$header.hpp"
done
exec "$1" -std=c++17 -Wall -Wextra -fsyntax-only -I"$2" -I"$root/include" "$root/bindings/godot/src/gdextension.cpp"
