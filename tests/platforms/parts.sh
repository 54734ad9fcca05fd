# Sourced by tests/run: the parts windows, arm64, small, clang, macos, wasm, web, bevy, godot4, alone and packages. Each builds in build/NAME, runs its tests and
# prints `NAME: N passed, N failed, N skipped`. CMAKE_BUILD_PARALLEL_LEVEL and CTEST_PARALLEL_LEVEL: jobs, else all cores.

# hf_configure NAME CMAKE_ARGUMENTS... and hf_make NAME TARGETS...: the log is build/NAME.log.
hf_configure() {
  local name=$1 log="$hf_root/build/$1.log"
  shift
  mkdir -p "$hf_root/build"
  hf_say "building ($name)"
  cmake -S "$hf_root" -B "$hf_root/build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
    -DHF_WARNINGS_AS_ERRORS=ON -DHF_BUILD_TESTS=ON "$@" >"$log" 2>&1 || {
    tail -30 "$log" >&2
    hf_say "cmake could not configure $name; the log is build/$name.log"
    return 1
  }
}
hf_make() {
  local name=$1 log="$hf_root/build/$1.log"
  shift
  (set -o pipefail && NINJA_STATUS='[%f/%t] ' cmake --build "$hf_root/build/$name" -j "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" --target "$@" 2>&1 | hf_progress "$log") || {
    grep -E 'error|FAILED' "$log" | head -30 >&2
    hf_say "the build of $name failed; the log is build/$name.log"
    return 1
  }
}

# hf_count NAME REGEX: runs the tests of build/NAME whose names match, and counts them.
hf_count() {
  local name=$1 log="$hf_root/build/$1.tests" passed failed skipped
  hf_say "testing ($name)"
  (cd "$hf_root/build/$name" && ctest --output-on-failure -j "${CTEST_PARALLEL_LEVEL:-$(nproc)}" -R "$2" 2>&1) | tee "$log" | grep -E '^ *[0-9]+/[0-9]+ |^error'
  passed=$(grep -cE '^ *[0-9]+/[0-9]+ .* Passed ' "$log")
  skipped=$(grep -cE '^ *[0-9]+/[0-9]+ .*\*\*\*Skipped' "$log")
  failed=$(($(grep -cE '^ *[0-9]+/[0-9]+ ' "$log") - passed - skipped))
  printf '%s: %s passed, %s failed, %s skipped\n' "$name" "$passed" "$failed" "$skipped"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ] || {
    hf_say "what failed is in build/$name.tests"
    return 1
  }
}

# Windows: the DLL by MinGW, the tests of the public ABI, the golden hashes and the sample programs under Wine.
test_windows() {
  hf_configure windows -DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/windows.cmake" -DHF_BUILD_SAMPLES=ON &&
    hf_make windows hf hf_api_tests reliability_golden reliability_refuse platform_throwing_host hf_field hf_transfer hf_make_assets || return 1
  # Wine has its settings in the build folder, no window, and ends with the tests
  export WINEPREFIX="$hf_root/build/windows/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml=' LC_ALL=C.UTF-8
  wine wineboot -i >/dev/null 2>&1
  local code=0
  hf_count windows '^(api_|platform_|reliability_(golden|refuse)$)' || code=1
  "$(command -v wineserver || echo /usr/lib/wine/wineserver)" -k >/dev/null 2>&1
  return "$code"
}

# 64-bit ARM under qemu: the tests of the public ABI, the golden hashes, and the instructions of the kernels for NEON.
test_arm64() {
  hf_configure arm64 -DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/arm64.cmake" &&
    hf_make arm64 hf hf_api_tests reliability_golden reliability_refuse platform_throwing_host kernel_work &&
    hf_count arm64 '^(api_|platform_|reliability_(golden|refuse)$)'
}

# Processors without kernels of their own, 32 bits and big-endian, under qemu: quick forms.
test_small() {
  local system code=0
  for system in i686 armhf riscv64 s390x; do
    { hf_configure "$system" -DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/$system.cmake" &&
      hf_make "$system" hf hf_api_tests reliability_golden reliability_refuse &&
      hf_count "$system" '^(api_|reliability_(golden|refuse)$)'; } || code=1
  done
  return "$code"
}

# The newest clang here: with libstdc++, with libc++, and the headers of the library in every language and in MSVC mode.
test_clang() {
  local version code=0 language
  for version in 19 18 17 16; do command -v "clang++-$version" >/dev/null && break; done
  command -v "clang++-$version" >/dev/null || { hf_say "no clang from 16 on here"; return 77; }
  local compilers=(-DCMAKE_C_COMPILER="clang-$version" -DCMAKE_CXX_COMPILER="clang++-$version" -DHF_BUILD_UNIT_TESTS=OFF)
  { hf_configure clang "${compilers[@]}" &&
    hf_make clang hf hf_api_tests reliability_golden reliability_refuse &&
    hf_count clang '^(api_|reliability_(golden|refuse)$)'; } || code=1
  { hf_configure clang-libc++ "${compilers[@]}" -DCMAKE_CXX_FLAGS=-stdlib=libc++ &&
    hf_make clang-libc++ hf hf_api_tests reliability_golden reliability_refuse &&
    hf_count clang-libc++ '^(api_test|api_.*_test|reliability_(golden|refuse)$)'; } || code=1
  "$hf_root/tests/platforms/languages.sh" "$hf_root" "clang-$version" "clang++-$version" || code=1
  return "$code"
}

# macOS: the library, the tests of the public ABI and two programs are compiled and linked for both processors, by Zig's
# clang with the system's headers. Nothing runs.
test_macos() {
  local tools="$hf_root/build/macos-tools" list="$hf_root/cmake/cross/requirements-macos.txt" processor name passed=0 failed=0
  if ! cmp -s "$list" "$tools/installed.txt"; then
    mkdir -p "$hf_root/build"
    python3 -m venv "$tools" >/dev/null 2>&1 && "$tools/bin/pip" install -q --disable-pip-version-check -r "$list" >"$hf_root/build/macos-tools.log" 2>&1 ||
      { hf_say "skipped: Zig could not be installed; the log is build/macos-tools.log"; return 77; }
    cp "$list" "$tools/installed.txt"
  fi
  # the compiler keeps what it makes of the system's libraries in the build folder too
  export ZIG_GLOBAL_CACHE_DIR="$hf_root/build/macos-cache" ZIG_LOCAL_CACHE_DIR="$hf_root/build/macos-cache"
  local zig
  zig=$("$tools/bin/python" -c 'import os, ziglang; print(os.path.join(os.path.dirname(ziglang.__file__), "zig"))')
  for processor in arm64 x86_64; do
    name=macos-$processor
    if hf_configure "$name" -DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/macos.cmake" -DHF_ZIG="$zig" \
      -DHF_MACOS_PROCESSOR="$processor" -DHF_BUILD_SAMPLES=ON &&
      hf_make "$name" hf hf_static hf_api_tests reliability_golden platform_throwing_host hf_field hf_transfer; then
      passed=$((passed + 1))
    else
      failed=$((failed + 1))
      continue
    fi
    if "$hf_root/tests/platforms/dylib.sh" "$hf_root/build/$name/without_peers/libhf.dylib" "$hf_root/bindings/functions.txt" "$processor"; then
      passed=$((passed + 1))
    else
      failed=$((failed + 1))
    fi
  done
  printf 'macos: %s passed, %s failed (built, never run)\n' "$passed" "$failed"
  [ "$failed" -eq 0 ]
}

# Every package: made twice, installed into something empty, tried there (cmake/packages/make).
test_packages() {
  local log="$hf_root/build/packages.log" code rows failed skipped
  "$hf_root/cmake/packages/make" --again 2>&1 | tee "$log"
  code=${PIPESTATUS[0]}
  rows=$(grep -cE '^\| [^|]*\| [0-9.-]+ ?[kM]?B? \|' "$log")
  failed=$(grep -cE '^\|.*\| (no \||.*FAILED)|^== .*: a second build gives other bytes' "$log")
  skipped=$(grep -cE '^\|.*\| skipped' "$log")
  printf 'packages: %s passed, %s failed, %s skipped\n' "$((rows - failed - skipped))" "$failed" "$skipped"
  [ "$code" = 77 ] && [ "$rows" -gt "$skipped" ] && code=0
  return "$code"
}

# WebAssembly with SIMD and one thread: the package's tests in node, the golden scenes in Chromium. The library has no
# threads there.
test_wasm() {
  local tool wasm="$hf_root/build/wasm" scenes="$hf_root/build/wasm_scenes.json" passed=0 failed=0 skipped=0 name code
  for tool in emcc node npm; do
    command -v "$tool" >/dev/null || { hf_say "skipped: $tool is not here"; return 77; }
  done
  hf_install_node_modules || return 77
  export HF_NODE_MODULES="$hf_root/build/npm/node_modules" HF_WASM="$wasm" HF_SCENES="$scenes"
  hf_say "building (wasm)"
  HF_JOBS=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)} "$hf_root/bindings/js/wasm/build.sh" "$wasm" || return 1
  (hf_build dev hf bindings_golden) || return 1
  "$hf_root/build/dev/bin/bindings_golden" "$hf_root/bindings/golden/meshes" "$hf_root/bindings/golden/scenes.json" --fill "$scenes" >/dev/null || return 1
  hf_say "testing (wasm)"
  for name in package races chromium; do
    case "$name" in
      package) node --expose-gc "$hf_root/tests/bindings/js_test.mjs" wasm ;;
      races) node --expose-gc "$hf_root/tests/bindings/races.mjs" wasm ;;
      chromium) node "$hf_root/tests/platforms/chromium_golden.mjs" "$wasm" "$scenes" ;;
    esac
    code=$?
    case "$code" in 0) passed=$((passed + 1)) ;; 77) skipped=$((skipped + 1)) ;; *) failed=$((failed + 1)) && hf_say "failed: $name" ;; esac
  done
  printf 'wasm: %s passed, %s failed, %s skipped\n' "$passed" "$failed" "$skipped"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}

# The npm package as bundlers and runtimes take it, each from its lock file: bindings/js/README.md, part for part. It takes
# the WebAssembly of the part wasm when it is there (HF_WASM: another folder).
test_web() {
  local tool wasm=${HF_WASM:-$hf_root/build/wasm}
  for tool in node npm; do
    command -v "$tool" >/dev/null || { hf_say "skipped: $tool is not here"; return 77; }
  done
  hf_install_node_modules || { hf_say "skipped: no npm packages here"; return 77; }
  hf_install_locked "$hf_root/tests/web" "$hf_root/build/web" || { hf_say "skipped: the bundlers could not be installed"; return 77; }
  if [ ! -e "$wasm/hf_slim.wasm" ]; then
    hf_say "building (wasm)"
    HF_JOBS=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)} "$hf_root/bindings/js/wasm/build.sh" "$wasm" || return $?
  fi
  (hf_build dev hf) || return 1
  hf_say "testing (web)"
  HF_WASM=$wasm HF_LIBRARY="$hf_root/build/dev/src/libhf.so" HF_NODE_MODULES="$hf_root/build/npm/node_modules" \
    HF_WEB_MODULES="$hf_root/build/web/node_modules" node "$hf_root/tests/web/web_test.mjs" all "$hf_root/build/web/apps"
}

# The Bevy layer: its tests, with a renderer and without, its README, and the examples drawn without a window, by the processor where there is
# no graphics card. The crates of the engine compile once.
test_bevy() {
  local crate="$hf_root/bindings/bevy" log="$hf_root/build/bevy.log" pictures="$hf_root/build/bevy/pictures" version passed failed
  command -v cargo >/dev/null || { hf_say "skipped: no cargo here (Rust 1.95 or newer)"; return 77; }
  version=$(cargo --version | awk '{print $2}')
  [ "$(printf '%s\n1.95.0\n' "$version" | sort -V | head -n 1)" = 1.95.0 ] || { hf_say "skipped: cargo $version is older than 1.95"; return 77; }
  export CARGO_TARGET_DIR="$hf_root/build/bevy" CARGO_BUILD_JOBS=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
  mkdir -p "$pictures"
  # what was fetched before is enough
  (cd "$crate" && { cargo fetch --offline || cargo fetch; }) >"$log" 2>&1 || { hf_say "skipped: the crates of Bevy could not be fetched; the log is build/bevy.log"; return 77; }
  export CARGO_NET_OFFLINE=true
  (hf_build dev hf hf_make_assets) || return 1
  # Mesa asks for the last one
  export HF_LIBRARY_DIR="$hf_root/build/dev/src" XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-$pictures}" LD_LIBRARY_PATH="$hf_root/build/dev/src"
  "$hf_root/build/dev/bin/hf_make_assets" "$pictures" --vertices 20000 --creature horse >/dev/null || return 1
  hf_say "building Bevy (some minutes the first time)"
  (cd "$crate" && cargo build --example demo && cargo build --tests --examples --features gpu) >>"$log" 2>&1 || {
    grep -A8 '^error' "$log" | head -40 >&2
    hf_say "the build of the Bevy layer failed; the log is build/bevy.log"
    return 1
  }
  hf_say "testing (bevy)"
  log="$hf_root/build/bevy.tests"
  (cd "$crate" && HF_PICTURES="$pictures" cargo test --features gpu --no-fail-fast 2>&1) | tee "$log" | grep -E '^test .* FAILED$|panicked at|^error'
  passed=$(grep -cE '^test .* ok$' "$log")
  failed=$(grep -cE '^test .* FAILED$' "$log")
  grep -qE '^test result: ' "$log" || failed=$((failed + 1))
  local example
  for example in "demo -- $pictures/horse.glb $pictures/horse" "crowd -- $pictures/horse.glb 9 $pictures/crowd"; do
    # shellcheck disable=SC2086 # words
    if (cd "$crate" && cargo run --quiet --features gpu --example $example) 2>&1 | tee -a "$log" && [ "${PIPESTATUS[0]}" -eq 0 ]; then
      passed=$((passed + 1))
    else
      failed=$((failed + 1))
      hf_say "failed: the example ${example%% *}"
    fi
  done
  printf 'bevy: %s passed, %s failed\n' "$passed" "$failed"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ] || {
    hf_say "what failed is in build/bevy.tests"
    return 1
  }
}

# Godot 4: one that is here, else that of Debian sid in a folder. The class HfSurface, the deformer, the README, a picture under
# Xvfb, unloading, and our declarations of its C interface against its own.
test_godot4() {
  local folder="$hf_root/build/godot4/test" bindings="$hf_root/tests/bindings" readme="$hf_root/bindings/godot/README.md" compiler=${CXX:-c++}
  local assets="$folder/assets" run skipped=0
  local log="$hf_root/build/godot4/tests.log"
  HF_GODOT4=$("$hf_root/tests/platforms/godot4_program.sh" --make) || return $?
  export HF_GODOT4 HF_SCENES="$folder/scenes.json" HF_PICTURE="$folder/picture.png"
  (hf_build dev hf_static bindings_golden hf_make_assets) || return 1
  rm -rf "$folder"
  mkdir -p "$assets"
  "$hf_root/build/dev/bin/hf_make_assets" "$assets" --vertices 20000 --creature horse >/dev/null &&
    "$hf_root/build/dev/bin/bindings_golden" "$hf_root/bindings/golden/meshes" "$hf_root/bindings/golden/scenes.json" --fill "$HF_SCENES" >/dev/null &&
    CXX="$compiler" "$hf_root/bindings/godot/build4.sh" "$hf_root/build/dev/src/libhf.a" "$folder" || return 1
  hf_say "testing (godot4: $("$HF_GODOT4" --version))"
  run=("$bindings/run_godot4.sh" "$folder/addons" "$folder")
  {
    hf_godot4_case interface 'functions of' "$bindings/godot4_interface.sh" "$HF_GODOT4" "$compiler" "$folder/interface"
    hf_godot4_case golden 'imported glb: .* vertices posed' "${run[@]}" "$assets/horse.glb" "$bindings/godot_test.gd"
    hf_godot4_case unload 'unloaded 3 times' "${run[@]}" none "$bindings/godot4_unload.gd"
    hf_godot4_case readme 'README: HF_ERROR_OUT_OF_RANGE' python3 "$bindings/readme_example.py" "$readme" gdscript "$folder/readme.gd" \
      "${run[@]}" none "$folder/readme.gd"
    hf_godot4_case readme_calls 'README: all calls answered' python3 "$bindings/readme_example.py" --calls "$bindings/godot_readme_calls.gd" \
      "$readme" gdscript "$folder/readme_calls.gd" "${run[@]}" none "$folder/readme_calls.gd"
    hf_godot4_case readme_attach 'README: in the hand again' python3 "$bindings/readme_example.py" --calls "$bindings/godot_readme_attach.gd" \
      "$readme" gdscript "$folder/readme_attach.gd" "${run[@]}" none "$folder/readme_attach.gd"
    if command -v xvfb-run >/dev/null; then
      LIBGL_ALWAYS_SOFTWARE=1 hf_godot4_case picture 'picture: ' xvfb-run -a -s '-screen 0 1024x600x24' "${run[@]}" none "$bindings/godot_picture.gd" \
        --rendering-driver opengl3 --audio-driver Dummy --resolution 1024x600
      LIBGL_ALWAYS_SOFTWARE=1 hf_godot4_case blended 'blended: moved' xvfb-run -a -s '-screen 0 1024x600x24' "${run[@]}" none "$bindings/godot4_blended.gd" \
        --rendering-driver opengl3 --audio-driver Dummy --resolution 800x500
    else
      skipped=2
    fi
  } | tee "$log"
  printf 'godot4: %s passed, %s failed, %s skipped\n' "$(grep -c '^passed: ' "$log")" "$(grep -c '^failed: ' "$log")" "$skipped"
  ! grep -q '^failed: ' "$log"
}

# hf_godot4_case NAME EXPECTED COMMAND...: passes when the command does and prints what is expected.
hf_godot4_case() {
  local name=$1 expected=$2 said
  shift 2
  if said=$("$@" 2>&1) && grep -q "$expected" <<<"$said"; then
    printf 'passed: %s (%s)\n' "$name" "$(grep -m1 "$expected" <<<"$said")"
  else
    printf '%s\nfailed: %s\n' "$said" "$name"
  fi
}

# The README's first build, in an empty root that holds the packages which the README names and what they depend on.
test_alone() {
  local root="$hf_root/build/alone/root" log="$hf_root/build/alone.log" packages build passed=0 failed=0
  command -v mmdebstrap >/dev/null || { hf_say "skipped: no mmdebstrap here"; return 77; }
  [ "$(id -u)" -eq 0 ] || { hf_say "skipped: chroot needs root"; return 77; }
  packages=$(sed -n 's/.*(Debian: `\([^`]*\)`).*/\1/p' "$hf_root/README.md" | head -1)
  build=$(sed -n '/^## In a program/,/^    cmake/s/^    //p' "$hf_root/README.md" | head -1)
  [ -n "$packages" ] && [ -n "$build" ] || { hf_say "README.md has lost its first build"; return 1; }
  rm -rf "$hf_root/build/alone"
  mkdir -p "$hf_root/build/alone"
  hf_say "an empty root with $packages"
  mmdebstrap --variant=apt --include="${packages// /,}" "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$root" >"$log" 2>&1 ||
    { tail -20 "$log" >&2; hf_say "the root was not made; the log is build/alone.log"; return 1; }
  mkdir "$root/hf" "$root/app"
  (cd "$hf_root" && git ls-files -z | xargs -0 cp --parents -t "$root/hf") || return 1
  cp "$hf_root/samples/minimal/minimal.c" "$root/app/"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.22)' 'project(app C)' 'find_package(hf REQUIRED)' 'add_executable(app minimal.c)' \
    'target_link_libraries(app PRIVATE hf::hf)' >"$root/app/CMakeLists.txt"
  for step in "cd /hf && $build" 'cd /app && cmake -B build && cmake --build build && build/app'; do
    if chroot "$root" /bin/bash -ec "$step" >>"$log" 2>&1; then passed=$((passed + 1)); else failed=$((failed + 1)); tail -20 "$log" >&2; fi
  done
  printf 'alone: %s passed, %s failed\n' "$passed" "$failed"
  [ "$failed" -eq 0 ] || return 1
  rm -rf "$hf_root/build/alone"
}
