#!/usr/bin/env bash
# CHANGELOG.md: one feature or mended fault a line, at most 120 characters; every release has a version and entries.
# usage: check_changelog.sh CHANGELOG VERSION
set -u
awk -v version="$2" '
  function wrong(text) {print "CHANGELOG.md:" NR ": " text; status = 1}
  length($0) > 120 {wrong(length($0) " characters; a line has at most 120")}
  /^## / {++releases; if (index($0, "## " version) == 1) found = 1; next}
  /^- / {++entries; next}
  /^$/ || /^# / || /^### / {next}
  {wrong("a line is a heading or an entry \"- ...\"")}
  END {
    if (!found) {print "CHANGELOG.md has no heading \"## " version "\""; status = 1}
    if (entries < 10) {print "CHANGELOG.md has only " entries + 0 " entries"; status = 1}
    if (!status) print entries " entries in " releases " releases"
    exit status
  }' "$1"
