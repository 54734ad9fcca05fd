#!/usr/bin/env bash
# The C blocks of docs/guide.md, in their order, are one program: it compiles without a warning and runs.
# usage: run_guide.sh SOURCE_DIR WORK_DIR LIBRARY COMPILER
set -eu
source=$1 work=$2 library=$3 compiler=$4
mkdir -p "$work"
blocks=$(awk '$0 == "```c" {on = 1; next} /^```/ {on = 0} on' "$source/docs/guide.md")
[ "$(printf '%s\n' "$blocks" | wc -l)" -gt 60 ] || { echo "docs/guide.md has lost its C"; exit 1; }
{ printf '#include "mesh.h"\nint main(void) {\nMesh mesh = mesh_leg();\n'; printf '%s\n' "$blocks"; printf 'mesh_free(&mesh);\nreturn 0;\n}\n'; } >"$work/guide.c"
"$compiler" -std=c99 -Wall -Wextra -Wpedantic -Wno-unused-function -Werror -I"$source/include" -I"$source/samples/examples" \
  "$work/guide.c" -o "$work/guide" "$library" -lm -Wl,-rpath,"$(dirname "$library")"
"$work/guide"
