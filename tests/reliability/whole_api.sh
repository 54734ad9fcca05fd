#!/usr/bin/env bash
# whole_api.cpp calls what it says: whole_api.sh EXPORTS.TXT SOURCE... Every exported function stands in them as a call.
set -u
exports=$1 missing=0 count=0
shift
while read -r name; do
  count=$((count + 1))
  [ "$name" = hf_init_desc ] && name=HF_INIT
  grep -qE "\b$name\(" "$@" && continue
  echo "not called: $name"
  missing=$((missing + 1))
done <"$exports"
printf 'WHOLE_API_FUNCTIONS %s >=80\nWHOLE_API_FUNCTIONS_NOT_CALLED %s <=0\n' "$count" "$missing"
[ "$missing" -eq 0 ]
