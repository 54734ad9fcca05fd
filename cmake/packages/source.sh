#!/usr/bin/env bash
# hf-VERSION-source.tar.gz: what builds the library; the port for vcpkg and the recipe for Conan take it.
. "$(dirname "$0")/common.sh"

case "$1" in
  make)
    folder=$(mktemp -d) || exit 1
    name="hf-$hf_version"
    mkdir "$folder/$name"
    cp -r "$hf_root"/{CMakeLists.txt,CMakePresets.json,LICENSE,README.md,CHANGELOG.md,cmake,include,src} "$folder/$name/"
    rm -rf "$folder/$name/cmake/packages"
    hf_pack tar "$2/$name-source.tar.gz" "$folder/$name"
    rm -rf "$folder"
    ;;
  try)
    tar xzf "$2/hf-$hf_version-source.tar.gz" -C "$3"
    hf_quiet cmake -S "$3/hf-$hf_version" -B "$3/build" -G Ninja
    hf_ran "cmake configures it; conan and vcpkg build it"
    ;;
esac
