#!/usr/bin/env bash
# The program in README.md compiles alone, is samples/minimal/minimal.c, and prints the block of text.
# usage: run_readme.sh SOURCE_DIR WORK_DIR LIBRARY COMPILER
set -eu
source=$1 work=$2 library=$3 compiler=$4
mkdir -p "$work"
cd "$work"
fail() { echo "$1"; exit 1; }
awk '$0 == "```c" {if (count++) exit; on = 1; next} /^```/ {on = 0} on' "$source/README.md" >program.c
awk '$0 == "```text" {on = 1; next} /^```/ {on = 0} on' "$source/README.md" >expected.txt
grep -q '^int main' program.c || fail "README.md has lost its program"
[ "$(wc -l <program.c)" -le 25 ] || fail "the program in README.md has grown beyond 25 lines"
[ "$(wc -l <"$source/README.md")" -le 110 ] || fail "README.md has grown beyond 110 lines: abilities and platforms have pages of their own"

"$compiler" -std=c99 -Wall -Wextra -Wpedantic -Werror -I"$source/include" program.c -o program "$library" -Wl,-rpath,"$(dirname "$library")"
./program >printed.txt
diff expected.txt printed.txt
diff program.c "$source/samples/minimal/minimal.c"
echo "the program of the README compiles and prints what the README says"
