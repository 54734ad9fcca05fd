#!/bin/sh
# Counts the rows of the bad-argument tables, the programs that fail, and the exported functions without a row.
# Usage: arguments.sh FOLDER_OF_THE_PROGRAMS EXPORTS_LIST
set -eu
programs=$1
exports=$2
rows=$(mktemp)
trap 'rm -f "$rows" "$rows.out"' EXIT
failed=0
for name in handles descs mesh places sites pose quads graph; do set -- "$@" "bad_${name}_test"; done
shift 2
for name in "$@" analysis_test certificate_test detail_test direction_test picking_test protocol_test retarget_test weights_test weights_carry_test links_test; do
  if ! HF_ROWS_LOG=$rows "$programs/api_$name" >"$rows.out" 2>&1; then
    failed=$((failed + 1))
    cat "$rows.out" >&2
  fi
done
# a function without arguments has nothing to refuse
missing=$(grep -vx hf_version_get "$exports" | while read -r function; do
  grep -qx "$function" "$rows" || echo "$function"
done)
[ -z "$missing" ] || printf 'no row for:\n%s\n' "$missing" >&2
count=$(wc -l <"$rows")
meshes=$(grep -cx hf_surface_create "$rows" || true)
without=$(printf '%s' "$missing" | grep -c . || true)
echo "arguments_rows $count >=600"
echo "arguments_of_hf_surface_create $meshes >=60"
echo "arguments_programs_failed $failed <=0"
echo "arguments_functions_without_row $without <=0"
[ "$count" -ge 600 ] && [ "$meshes" -ge 60 ] && [ "$failed" -eq 0 ] && [ "$without" -eq 0 ]
