#!/usr/bin/env bash
# usage: run_readme.sh SOURCE_DIR WORK_DIR LIBRARY COMPILER
set -eu
source=$1 work=$2 library=$3 compiler=$4
mkdir -p "$work"
block() { awk -v fence="\`\`\`$1" '$0 == fence {on = 1; next} /^```/ {if (on) exit} on' "$source/README.md"; }
block c >"$work/program.c"
block text >"$work/expected.txt"
[ -s "$work/program.c" ] || { echo "README.md has no block of C"; exit 1; }
[ "$(wc -l <"$work/program.c")" -le 40 ] || { echo "the program in README.md has grown beyond 40 lines"; exit 1; }
"$compiler" -std=c99 -Wall -Wextra -Wpedantic -Werror -I"$source/include" "$work/program.c" -o "$work/program" "$library" -Wl,-rpath,"$(dirname "$library")"
"$work/program" >"$work/printed.txt"
diff "$work/expected.txt" "$work/printed.txt"
diff "$work/program.c" "$source/samples/minimal/minimal.c"
echo "the README's program prints what the README says"
