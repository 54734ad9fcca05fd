#!/usr/bin/env bash
# What a plain configure asks for and what it would make; nothing is compiled.
# usage: run_configure.sh bare|shared_only|static_only|add_subdirectory|presets SOURCE_DIR BUILD_DIR
set -eu
kind=$1 source=$2 build=$3
work="$build/consumer/$kind"
rm -rf "$work"
mkdir -p "$work"
configure() { cmake -S "$source" -B "$work/build" -G Ninja "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }
# the libraries that `cmake --build` (of a target) would make, and those an installation would hold
made() { ninja -C "$work/build" -n "$@" | sed -n 's/.*Linking .* library .*\(libhf\.[a-z]*\).*/\1/p' | sort -u | paste -sd' '; }
installed() { grep -oE 'libhf\.(so|a)"' "$work/build/src/cmake_install.cmake" | sed 's/.*://' | tr -d '"' | sort -u | paste -sd' '; }
expect() { [ "$2" = "$3" ] || { echo "$1: expected \"$3\", got \"$2\""; exit 1; }; }

case "$kind" in
  bare)  # a compiler and Eigen's headers are all it takes
    eigen=$(sed -n 's/^EIGEN3_INCLUDE_DIR:PATH=//p' "$build/CMakeCache.txt")
    [ -n "$eigen" ] || eigen=$(pkg-config --variable=includedir eigen3 2>/dev/null || true)
    [ -d "$eigen/Eigen" ] || eigen=/usr/include/eigen3
    mkdir -p "$work/include"
    ln -s "$eigen/Eigen" "$work/include/Eigen"
    hidden=()
    for package in CHOLMOD GTest benchmark TinyGLTF nlohmann_json glm Eigen3; do hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
    configure "${hidden[@]}" -DEIGEN3_INCLUDE_DIR="$work/include"
    expect "libraries" "$(made)" "libhf.a libhf.so"
    if grep -iE 'cholmod|suitesparse|cmocka|gtest|tinygltf|glm' "$work/build/build.ninja"; then
      echo "a plain configure names what only samples, tests or HF_WITH_GPL use"
      exit 1
    fi
    ;;
  shared_only)
    configure -DBUILD_SHARED_LIBS=ON
    expect "libraries" "$(made)" "libhf.so"
    expect "installed" "$(installed)" "libhf.so"
    ;;
  static_only)
    configure -DBUILD_SHARED_LIBS=OFF
    expect "libraries" "$(made)" "libhf.a"
    expect "installed" "$(installed)" "libhf.a"
    grep -q -- '-lhf .*-lstdc++' "$work/build/hf.pc" || { echo "hf.pc does not name what the archive needs"; exit 1; }
    ;;
  add_subdirectory)  # FetchContent calls it, and run_consumer.sh builds that; so this configures only, in a project with C++
    cmake -S "$source/tests/consumer/add_subdirectory" -B "$work/build" -G Ninja -DHF_SOURCE_DIR="$source" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    expect "libraries of the consumer" "$(made shared_consumer)" "libhf.so"
    # no build type: the library is optimised all the same, the consumer's own code is as it asks, and it is told
    grep -q 'no build type is set' "$work/log" || { echo "nothing is said of the missing build type"; exit 1; }
    ninja -C "$work/build" -t commands hf/src/libhf.so | grep -- ' -c ' | grep -vq -- ' -O2 ' && { echo "a file of the library is compiled without -O2"; exit 1; }
    ninja -C "$work/build" -t commands shared_consumer | grep -- 'use_hf.c.o -c' | grep -q -- ' -O2 ' && { echo "-O2 reaches the consumer's own code"; exit 1; }
    cmake -S "$source/tests/consumer/add_subdirectory" -B "$work/typed" -G Ninja -DHF_SOURCE_DIR="$source" -DCMAKE_BUILD_TYPE=Debug >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    grep -q 'no build type is set' "$work/log" && { echo "a build type is set, and its lack is told"; exit 1; }
    # bytes_hash.cpp has -O2 in every build
    ninja -C "$work/typed" -t commands hf/src/libhf.so | grep -v bytes_hash.cpp | grep -q -- ' -O2 ' && { echo "-O2 stands beside the build type Debug"; exit 1; }
    true
    ;;
  presets)  # a preset without CMAKE_UNITY_BUILD takes other branches of the lists; the long form configures all of them
    presets=(asan)
    [ -n "${HF_FULL_TESTS:-}" ] && presets=(debug asan tsan coverage)
    for preset in "${presets[@]}"; do
      (cd "$source" && cmake --preset "$preset" -B "$work/$preset") >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    done
    ;;
  *) echo "unknown kind $kind"; exit 1 ;;
esac
