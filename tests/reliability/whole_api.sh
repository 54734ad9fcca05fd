#!/usr/bin/env bash
# Checks that the sources call every exported function: whole_api.sh EXPORTS.TXT SOURCE...
set -u
exports=$1 missing=0 count=0
shift
while read -r name; do
  count=$((count + 1))
  grep -qE "\b$name\(" "$@" && continue
  echo "not called: $name"
  missing=$((missing + 1))
done <"$exports"
printf 'WHOLE_API_FUNCTIONS %s >=80\nWHOLE_API_FUNCTIONS_NOT_CALLED %s <=0\n' "$count" "$missing"
[ "$missing" -eq 0 ]
