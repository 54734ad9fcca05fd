#!/usr/bin/env bash
# Doxygen reads include/hf without a warning, and every function of the C headers has a comment. Skipped (77) without doxygen.
# usage: check_reference.sh SOURCE_DIR WORK_DIR
set -u
command -v doxygen >/dev/null || { echo "doxygen is not here (Debian package doxygen): the reference is not checked"; exit 77; }
cd "$1" || exit 1
rm -rf "$2" && mkdir -p "$2" || exit 1
HF_REFERENCE=$2 doxygen docs/Doxyfile || { echo "doxygen warns"; exit 1; }
awk '/<memberdef kind="function"/ {on = 1} on && /<name>/ {gsub(/ *<\/?name>/, ""); name = $0}
     on && /<briefdescription>/ {getline; ++count; if (/<\/briefdescription>/) {print name " has no comment"; status = 1} on = 0}
     END {if (count < 100) {print "only " count " functions found"; status = 1} else print count " functions in the reference"; exit status}' \
  "$2"/xml/*_8h.xml
