#!/usr/bin/env bash
# Every relative link and picture of the pages names a file that exists, and so does every path of the project in backticks.
# usage: check_paths.sh SOURCE_DIR
set -u
cd "$1" || exit 1
status=0 checked=0
check() {
  checked=$((checked + 1))
  [ -e "$3" ] || { echo "$1: $2 does not exist"; status=1; }
}
for page in *.md docs/*.md docs/studies/*.md; do
  folder=$(dirname "$page")
  while read -r link; do
    check "$page" "$link" "$folder/${link%%#*}"
  done < <(grep -oE '\]\([^)#:][^):]*\)' "$page" | sed 's/^](//; s/)$//')
  while read -r picture; do
    check "$page" "$picture" "$folder/$picture"
  done < <(grep -oE 'src="[^":]*"' "$page" | sed 's/^src="//; s/"$//')
  while read -r path; do
    check "$page" "$path" "$path"
  done < <(grep -oE '`(src|include|tests|samples|bindings|docs|cmake)/[A-Za-z0-9_./-]*`' "$page" | tr -d '`')
done
[ "$checked" -gt 100 ] || { echo "only $checked links and paths found"; status=1; }
[ "$status" -eq 0 ] && echo "$checked links and paths name files that exist"
exit "$status"
