#!/usr/bin/env bash
# godot4_program.sh [--make]: prints the path of a Godot 4.3 or newer: godot4 or godot on PATH, else build/godot4/godot.
# --make puts that one there: Godot of Debian sid and its libraries in a folder, nothing is installed. 77 (skipped) without.
set -u
# shellcheck source=../../cmake/setup.sh
. "$(dirname "$0")/../../cmake/setup.sh"
folder="$hf_root/build/godot4"
for program in "$(command -v godot4)" "$(command -v godot)" "$folder/godot"; do
  [ -x "$program" ] || continue
  case "$("$program" --version 2>/dev/null)" in 4.[3-9]* | 4.[1-9][0-9]*) echo "$program" && exit 0 ;; esac
done
[ "${1:-}" = --make ] || { echo "skipped: no Godot 4.3 or newer here" >&2 && exit 77; }
. /etc/os-release
if [ "${ID:-}" != debian ] || ! command -v mmdebstrap >/dev/null; then
  echo "skipped: no Godot 4.3 or newer here, and no Debian with mmdebstrap to take one of" >&2
  exit 77
fi
mkdir -p "$folder"
# shellcheck disable=SC2016  # words of apt-get
mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' |
  awk -v r="$VERSION_CODENAME" '$2 == r && $3 == "main" { print $1; exit }')
# a mirror of a past day has lists that are out of date
mmdebstrap --variant=extract --aptopt='Acquire::Check-Valid-Until "false"' --include=godot,libgl1,libglx-mesa0,libgl1-mesa-dri \
  --keyring=/usr/share/keyrings/debian-archive-keyring.gpg sid "$folder/root.tar" "deb ${mirror:-none:} sid main" >"$folder/root.log" 2>&1 || {
  echo "skipped: Godot of Debian sid could not be fetched; the log is $folder/root.log" >&2
  exit 77
}
rm -rf "$folder/root"
mkdir "$folder/root" && tar xf "$folder/root.tar" -C "$folder/root" --exclude='./dev/*' --no-same-owner || exit 1
rm "$folder/root.tar"
cat >"$folder/godot" <<'PROGRAM'
#!/bin/sh
# Godot of Debian sid by its own loader, libraries and drivers.
root=$(dirname "$(readlink -f "$0")")/root
for lib in "$root"/usr/lib/*-linux-gnu*; do :; done
for loader in "$lib"/ld-linux*.so.*; do :; done
export LIBGL_DRIVERS_PATH="$lib/dri"
exec "$loader" --library-path "$lib:$lib/pulseaudio" "$root/usr/bin/godot" "$@"
PROGRAM
chmod +x "$folder/godot"
"$folder/godot" --version >/dev/null || {
  echo "error: $folder/godot does not start" >&2
  exit 1
}
echo "$folder/godot"
