#!/usr/bin/env bash
# hf-VERSION-linux-x64.tar.gz: runs on any Linux with glibc 2.17 or later.
. "$(dirname "$0")/common.sh"
. "$hf_here/archive.sh"
case "$1" in
  make) archive_make linux-x64 "$2" tar ;;
  try)
    archive_try linux-x64 "$2" "$3"
    hf_symbol_versions "$3/hf-$hf_version-linux-x64/lib/libhf.so"
    ;;
esac
