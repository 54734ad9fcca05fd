#!/usr/bin/env bash
# install.sh SOURCE_DIR BUILD_DIR: hf_walk built against an installation of hf and hf_gltf, by CMake and by pkg-config.
set -eu
source=$1 build=$2
work="$build/consumer/gltf"
rm -rf "$work"
mkdir -p "$work/project"
quiet() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; echo "failed: $*"; exit 1; }; }
says() { # the program starts: it asks for its files
  "$@" 2>&1 | grep -q '^usage: hf_walk' || { echo "error: $* did not start"; exit 1; }
}
quiet cmake --install "$build" --prefix "$work/prefix"
cat >"$work/project/CMakeLists.txt" <<TEXT
cmake_minimum_required(VERSION 3.22)
project(walk C)
find_package(hf REQUIRED)
find_package(hf_gltf 0.1 REQUIRED)
add_executable(walk "$source/samples/walk/hf_walk.c")
target_link_libraries(walk hf::hf hf::hf_gltf m)
TEXT
quiet cmake -S "$work/project" -B "$work/by_cmake" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix"
quiet cmake --build "$work/by_cmake"
says "$work/by_cmake/walk"
if grep -rln "$source\|$build" "$work/prefix/lib"*/cmake "$work"/prefix/lib/*/cmake 2>/dev/null; then echo "error: the installed package names the build machine's folders"; exit 1; fi
found=$(find "$work/prefix" -name hf_gltf.pc)
flags=$(PKG_CONFIG_PATH=$(dirname "$found") pkg-config --cflags --libs hf hf_gltf)
# shellcheck disable=SC2086
quiet cc -std=c99 "$source/samples/walk/hf_walk.c" $flags -lm -o "$work/by_pkg_config"
LD_LIBRARY_PATH=$(dirname "$(dirname "$found")") says "$work/by_pkg_config"
# the block of docs/files.md compiles and poses a model
{ printf '#include <hf_gltf/gltf.h>\n#include <stdlib.h>\nint main() {\n'; awk '$0 == "```c++" {on = 1; next} /^```/ {on = 0} on' "$source/docs/files.md"; printf 'free(posed);\nhf_gltf_model_destroy(model);\nreturn 0;\n}\n'; } >"$work/files.cpp"
# shellcheck disable=SC2086
quiet c++ -std=c++17 -Wall -Wextra -Werror "$work/files.cpp" $flags -o "$work/files"
echo "hf_walk and the block of docs/files.md: built by CMake and by pkg-config"
