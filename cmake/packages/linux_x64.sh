#!/usr/bin/env bash
# hf-VERSION-linux-x64.tar.gz: runs on any Linux with glibc 2.17 or later.
. "$(dirname "$0")/common.sh"
. "$hf_here/archive.sh"
archive_linux linux-x64 "$@"
