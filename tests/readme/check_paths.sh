#!/usr/bin/env bash
# Every relative link and picture of the pages names a file that exists, every anchor a heading, and so does every path of the project in backticks.
# A path counts from the root or from the folder of its page.
# usage: check_paths.sh SOURCE_DIR
set -u
cd "$1" || exit 1
status=0 checked=0
check() {
  checked=$((checked + 1))
  [ -e "$3" ] || { echo "$1: $2 does not exist"; status=1; }
}
# The anchors of a page, as hosts of repositories make them of headings.
anchors() { grep -E '^#+ ' "$1" | sed -E 's/^#+ +//' | tr 'A-Z' 'a-z' | sed -E 's/[^a-z0-9 _-]//g; s/ /-/g'; }
for page in *.md docs/*.md docs/studies/*.md samples/*/README.md bindings/*.md bindings/*/README.md; do
  folder=$(dirname "$page")
  while read -r link; do
    to=$folder/${link%%#*}
    [ -z "${link%%#*}" ] && to=$page
    check "$page" "$link" "$to"
    case "$link" in *.md\#* | \#*) anchors "$to" | grep -qx -- "${link#*#}" || { echo "$page: $link has no such heading"; status=1; } ;; esac
  done < <(grep -oE '\]\([^):]+\)' "$page" | sed 's/^](//; s/)$//')
  while read -r picture; do
    check "$page" "$picture" "$folder/$picture"
  done < <(grep -oE '<img [^>]*src="[^":]*"' "$page" | sed 's/.*src="//; s/"$//')
  while read -r path; do
    [ -e "$folder/$path" ] || check "$page" "$path" "$path"
  done < <(grep -oE '`(src|include|tests|samples|bindings|docs|cmake)/[A-Za-z0-9_./-]*`' "$page" | tr -d '`')
done
[ "$checked" -gt 100 ] || { echo "only $checked links and paths found"; status=1; }
[ "$status" -eq 0 ] && echo "$checked links and paths name files that exist"
exit "$status"
