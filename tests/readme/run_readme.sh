#!/usr/bin/env bash
# Every C block of README.md compiles. The first, inside a main, poses the built-in leg. The one with a main of its own is
# samples/minimal/minimal.c and prints the block of text.
# usage: run_readme.sh SOURCE_DIR WORK_DIR LIBRARY COMPILER
set -eu
source=$1 work=$2 library=$3 compiler=$4
mkdir -p "$work"
cd "$work"
rm -f block*.c posed.obj
fail() { echo "$1"; exit 1; }
awk '$0 == "```c" {name = "block" ++count ".c"; printf "" > name; next} /^```/ {name = ""} name {print > name}' "$source/README.md"
awk '$0 == "```text" {on = 1; next} /^```/ {on = 0} on' "$source/README.md" >expected.txt

compile() {
  "$compiler" -std=c99 -Wall -Wextra -Wpedantic -Wno-unused-function -Werror -I"$source/include" -I"$source/samples/examples" \
    "$1.c" -o "$1" "$library" -lm -Wl,-rpath,"$(dirname "$library")"
}

whole=
for file in block*.c; do
  block=${file%.c}
  if grep -q '^int main' "$file"; then
    whole=$block
  else
    { printf '#include "mesh.h"\nint main(int argc, char** argv) {\n'; cat "$file"; printf '}\n'; } >"inside_$file"
    compile "inside_$block"
  fi
done
[ -n "$whole" ] && [ -f inside_block1.c ] || fail "README.md has lost a block of C"
[ "$(wc -l <block1.c)" -le 18 ] || fail "the first block of README.md has grown beyond 18 lines"
[ "$(wc -l <"$whole.c")" -le 40 ] || fail "the program in README.md has grown beyond 40 lines"

# the foot stays, the hip arrives: first and last vertex of the leg, (0.35, 0, 0) and around (0, 4, 0)
./inside_block1 >/dev/null
awk '$1 == "v" {if (!n++) stays = $2 > 0.349 && $2 < 0.351 && $3 < 1e-5 && $3 > -1e-5; x = $2} END {exit !(stays && n == 2592 && x > 0.5)}' posed.obj ||
  fail "the first block of README.md does not pose the leg"

compile "$whole"
"./$whole" >printed.txt
diff expected.txt printed.txt
diff "$whole.c" "$source/samples/minimal/minimal.c"
echo "the README's blocks compile, pose and print what the README says"
