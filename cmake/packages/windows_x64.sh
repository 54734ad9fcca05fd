#!/usr/bin/env bash
# hf-VERSION-windows-x64.zip: hf.dll, import libraries for MinGW (libhf.dll.a) and for others (hf.lib), MinGW's archive;
# tried under Wine.
. "$(dirname "$0")/common.sh"
. "$hf_here/archive.sh"
[ "$1" = make ] || command -v wine >/dev/null || hf_skip "no Wine here (Debian: wine wine64)"
case "$1" in
  make) archive_make windows-x64 "$2" zip ;;
  try) hf_wine && archive_try windows-x64 "$2" "$3" ;;
esac
