#!/usr/bin/env bash
# libhf0 and libhf-dev for the Debian and the processor that build them, without debhelper. Tried: lintian; the package and
# what it depends on, unpacked into an empty root, run the golden scenes there.
. "$(dirname "$0")/common.sh"
command -v dpkg-deb >/dev/null || hf_skip "no dpkg-deb here"
arch=$(dpkg --print-architecture)
triple=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
maintainer='The hf authors <hf@example.org>'

# The same objects, installed as Debian lays libraries out; the C++ runtime is that of the system.
deb_tree() {
  local tree="$hf_work/linux-x64/debian" build="$hf_work/linux-x64/build"
  rm -rf "$tree"
  {
    cmake -S "$hf_root" -B "$build" -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR="lib/$triple" &&
      cmake --build "$build" -j "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" && DESTDIR="$tree" cmake --install "$build" --strip
  } >"$hf_work/linux-x64/debian.log" 2>&1 || hf_fail "the installation for Debian failed; see $hf_work/linux-x64/debian.log"
  strip --strip-debug --remove-section=.comment --remove-section=.note --enable-deterministic-archives "$tree/usr/lib/$triple/libhf.a" || exit 1
}

# deb_docs FOLDER PACKAGE
deb_docs() {
  local doc="$1/usr/share/doc/$2" date
  mkdir -p "$doc"
  date=$(date -u -R -d "@$SOURCE_DATE_EPOCH")
  printf 'hf (%s-1) unstable; urgency=medium\n\n  * See the CHANGELOG of the project.\n\n -- %s  %s\n' "$hf_version" "$maintainer" "$date" |
    gzip -9n >"$doc/changelog.Debian.gz"
  gzip -9nc "$hf_root/CHANGELOG.md" >"$doc/changelog.gz"
  {
    printf 'hf, dynamic harmonic fields.\n\n'
    cat "$hf_root/LICENSE"
    printf '\nThe library contains code of the headers of Eigen, copyright 2008-2021 by its authors, under the Mozilla Public\n'
    printf 'License 2.0. Its text is in /usr/share/common-licenses/MPL-2.0 on Debian systems.\n'
  } >"$doc/copyright"
}

# deb_build FOLDER OUT
deb_build() {
  local name
  (cd "$1" && find . -path ./DEBIAN -prune -o -type f -printf '%P\0' | sort -z | xargs -0 md5sum >DEBIAN/md5sums)
  chmod -R u=rwX,go=rX "$1"
  name=$(sed -n 's/^Package: //p' "$1/DEBIAN/control")
  hf_quiet dpkg-deb --root-owner-group -Zxz --build "$1" "$2/${name}_$hf_version-1_$arch.deb"
}

deb_make() {
  local out=$1 folder tree="$hf_work/linux-x64/debian" lib="usr/lib/$triple" depends
  deb_tree
  folder=$(mktemp -d) || exit 1
  trap 'rm -rf "$folder"' EXIT
  mkdir -p "$folder/source/debian" "$folder/run/DEBIAN" "$folder/run/$lib" "$folder/dev/DEBIAN" "$folder/dev/$lib"
  cp -a "$tree/$lib"/libhf.so.* "$folder/run/$lib/"
  chmod 644 "$folder/run/$lib/libhf.so.$hf_version"
  cp -a "$tree/usr/include" "$folder/dev/usr/"
  cp -a "$tree/$lib"/libhf.so "$tree/$lib"/libhf.a "$tree/$lib/cmake" "$tree/$lib/pkgconfig" "$folder/dev/$lib/"
  deb_docs "$folder/run" libhf0
  deb_docs "$folder/dev" libhf-dev

  # what the library calls of others, found by Debian's own tools
  printf 'Source: hf\n\nPackage: libhf0\nArchitecture: any\n' >"$folder/source/debian/control"
  depends=$(cd "$folder/source" && dpkg-shlibdeps -O --ignore-missing-info -S"$folder/run" "$folder/run/$lib/libhf.so.$hf_version" 2>/dev/null)
  depends=${depends#shlibs:Depends=}
  [ -n "$depends" ] || hf_fail "dpkg-shlibdeps found nothing"
  printf 'libhf 0 libhf0 (>= %s)\n' "$hf_version" >"$folder/run/DEBIAN/shlibs"
  {
    printf 'libhf.so.0 libhf0 #MINVER#\n* Build-Depends-Package: libhf-dev\n'
    sort "$hf_root/bindings/functions.txt" | sed "s/.*/ &@Base $hf_version/"
  } >"$folder/run/DEBIAN/symbols"
  printf 'activate-noawait ldconfig\n' >"$folder/run/DEBIAN/triggers"
  deb_control "$folder/run" libhf0 libs "$depends" 'dynamic harmonic fields on surfaces (shared library)' ''
  deb_control "$folder/dev" libhf-dev libdevel "libhf0 (= $hf_version-1)" 'dynamic harmonic fields on surfaces (development files)' \
    ' .
 This package has the headers, the static library and the files for CMake and
 pkg-config.'
  deb_build "$folder/run" "$out"
  deb_build "$folder/dev" "$out"
}

deb_control() { # folder, package, section, depends, summary, more
  {
    printf 'Package: %s\nSource: hf\nVersion: %s-1\nArchitecture: %s\nMulti-Arch: same\nMaintainer: %s\n' "$2" "$hf_version" "$arch" "$maintainer"
    printf 'Installed-Size: %s\nDepends: %s\nSection: %s\nPriority: optional\n' "$(du -sk --apparent-size --exclude=DEBIAN "$1" | cut -f1)" "$4" "$3"
    printf 'Homepage: https://hf.example.org\n'
    printf 'Description: %s\n' "$5"
    printf ' hf poses meshes with handles, plays the motion of one surface on another and\n'
    printf ' computes smooth fields over surfaces while sites come and go. It factorises\n'
    printf ' once for each surface and never changes the factor.\n%s' "${6:+$6$'\n'}"
  } >"$1/DEBIAN/control"
}

deb_try() {
  local out=$1 scratch=$2 root="$2/root" said depends filled
  command -v lintian >/dev/null || hf_skip "no lintian here (Debian: lintian)"
  # the sources are no Debian source package, so no bug of an intended package can be closed
  said=$(lintian --allow-root --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$out"/*.deb 2>&1) ||
    { printf '%s\n' "$said" >&2; hf_fail "lintian"; }
  [ -z "$said" ] || { printf '%s\n' "$said" >&2; hf_fail "lintian says more than nothing"; }
  hf_quiet apt-get -s -qq install --no-install-recommends "$out"/*.deb
  # an empty root that holds the packages and what they depend on, and nothing else
  mkdir -p "$root/try" "$scratch/archives"
  depends=$(dpkg-deb -f "$out"/libhf0_*.deb Depends | tr ',' '\n' | sed 's/(.*//; s/|.*//; s/ //g')
  # shellcheck disable=SC2086
  (cd "$scratch/archives" && hf_quiet apt-get -qq download $depends)
  for said in "$scratch"/archives/*.deb "$out"/*.deb; do hf_quiet dpkg-deb -x "$said" "$root"; done
  filled=$(hf_filled) || exit 1
  cp -r "$hf_golden/meshes" "$hf_golden/bad_input.json" "$root/try/" && cp "$filled" "$root/try/scenes.json" || exit 1
  hf_quiet cc -std=c99 -I"$root/usr/include" "$hf_root/tests/consumer/use_hf.c" -o "$root/try/shared" -L"$root/usr/lib/$triple" -lhf
  hf_quiet cc -std=c99 -static -DHF_STATIC "$hf_root/tests/consumer/use_hf.c" -o "$root/try/static" \
    $(PKG_CONFIG_SYSROOT_DIR="$root" PKG_CONFIG_LIBDIR="$root/usr/lib/$triple/pkgconfig" pkg-config --static --cflags --libs hf)
  hf_golden_program linux-x64 "$root/try/golden" -L"$root/usr/lib/$triple" -lhf
  # a name space of its own where it is not root's
  local enter=(chroot "$root")
  [ "$(id -u)" = 0 ] || enter=(unshare -r chroot "$root")
  hf_quiet "${enter[@]}" /try/shared
  hf_quiet "${enter[@]}" /try/static
  said=$("${enter[@]}" /try/golden /try/meshes /try/scenes.json /try/bad_input.json 2>&1) || {
    printf '%s\n' "$said" | grep -vE ': [0-9]+ steps' | head -20 >&2
    hf_fail "golden scenes in the empty root"
  }
  hf_ran "lintian says nothing but that no bug is closed; apt resolves it; in an empty root with its dependencies alone: $(printf '%s\n' "$said" | grep -cE ': [0-9]+ steps') golden scenes, $(printf '%s\n' "$said" | sed -n 's/ wrong calls answered.*//p') bad calls, C programs shared and static"
}

case "$1" in
  make) deb_make "$2" ;;
  try) deb_try "$2" "$3" ;;
esac
