#!/usr/bin/env bash
# Each page of an ability has its parts: a picture, code, how it works, cost, limits, and a link to its header.
# The list is the sidebar of the site. usage: check_abilities.sh SOURCE_DIR
set -u
cd "$1/docs" || exit 1
status=0 count=0
for page in $(sed -n '/- Abilities:/,/^  - /s/.*docs\/\(.*\.md\)/\1/p' site/mkdocs.yml); do
  count=$((count + 1))
  parts=('^!\[.*](.*)' '^## Code' '^## How it works$' '^## Limits$' '](\.\./include/')
  [ "$page" = files.md ] || parts+=('^## Cost$') # a file is read once
  for part in "${parts[@]}"; do
    grep -q -- "$part" "$page" || { echo "docs/$page has no line $part"; status=1; }
  done
done
[ "$count" -ge 13 ] || { echo "only $count pages of abilities found"; status=1; }
[ "$status" -eq 0 ] && echo "$count pages have their parts"
exit "$status"
