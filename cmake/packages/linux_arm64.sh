#!/usr/bin/env bash
# hf-VERSION-linux-arm64.tar.gz: runs on any Linux with glibc 2.17 or later; tried under qemu.
. "$(dirname "$0")/common.sh"
. "$hf_here/archive.sh"
[ "$1" = make ] || command -v qemu-aarch64 >/dev/null || hf_skip "no qemu-aarch64 here (Debian: qemu-user)"
archive_linux linux-arm64 "$@"
