#!/usr/bin/env bash
# The C blocks of a page, in their order, are one program: it compiles without a warning and runs.
# usage: run_guide.sh SOURCE_DIR WORK_DIR LIBRARY COMPILER PAGE
set -eu
source=$1 work=$2 library=$3 compiler=$4 page=$5
mkdir -p "$work"
blocks=$(awk '$0 == "```c" {on = 1; next} /^```/ {on = 0} on' "$source/docs/$page.md")
[ "$(printf '%s\n' "$blocks" | wc -l)" -ge 8 ] || { echo "docs/$page.md has lost its C"; exit 1; }
# the lines before a page: the guide makes the surface itself, the others begin after its first lines
begin='Mesh mesh = mesh_leg();' end='mesh_free(&mesh);'
if [ "$page" != guide ]; then
  begin="$begin hf_surface surface = mesh_surface(&mesh);"
  end="hf_surface_destroy(surface); $end"
fi
if [ "$page" = renderer ]; then
  begin="$begin hf_pose pose; uint32_t low_handle, high; mesh_pose(&mesh, surface, &pose, &low_handle, &high);"
  end="hf_pose_destroy(pose); $end"
fi
{
  printf '#include "mesh.h"\nstatic void upload(const char* name, const void* data, size_t bytes) { printf("%%s %%p %%zu\\n", name, data, bytes); }\n'
  printf 'int main(void) {\n(void)upload;\n%s\n%s\n%s\nreturn 0;\n}\n' "$begin" "$blocks" "$end"
} >"$work/$page.c"
"$compiler" -std=c99 -Wall -Wextra -Wpedantic -Wno-unused-function -Werror -I"$source/include" -I"$source/samples/examples" \
  "$work/$page.c" -o "$work/$page" "$library" -lm -Wl,-rpath,"$(dirname "$library")"
"$work/$page"
