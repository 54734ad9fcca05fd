# Sourced by make and by the scripts of the packages.
#
# A script is called as `NAME.sh make OUT`, which writes the package's files into OUT, and as `NAME.sh try OUT SCRATCH`, which
# installs them into something empty, runs what it can there, and says what ran in one line that begins with "ran:". 77 is
# "skipped", with a line that says what is missing.
set -u
. "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"
hf_here="$hf_root/cmake/packages"
hf_work=${HF_PACKAGES_WORK:-$hf_root/build/packages}
hf_version=$(sed -n 's/^project(hf VERSION \([0-9.]*\).*/\1/p' "$hf_root/CMakeLists.txt")
hf_tests="$hf_root/tests/bindings"
hf_golden="$hf_root/bindings/golden"
mkdir -p "$hf_work"

# The date of everything in a package: that of the last commit.
: "${SOURCE_DATE_EPOCH:=$(git -C "$hf_root" log -1 --format=%ct 2>/dev/null || stat -c %Y "$hf_root/CHANGELOG.md")}"
export SOURCE_DATE_EPOCH LC_ALL=C.UTF-8
umask 022

hf_pack() { python3 "$hf_here/pack.py" "$@"; }
hf_skip() {
  printf 'skipped: %s\n' "$*"
  exit 77
}
hf_ran() { printf 'ran: %s\n' "$*"; }
# runs a command; its output is shown only when it fails
hf_quiet() {
  local said
  said=$("$@" 2>&1) || {
    printf '%s\n' "$said" | tail -40 >&2
    hf_fail "failed: $*"
  }
}

# What is known of a platform: compiler, runner, name of the shared library.
hf_toolchain() {
  hf_cxx=c++ hf_cc=cc hf_runner=() hf_cmake=() hf_shared=libhf.so
  case "$1" in
    linux-x64) hf_cmake=(-DHF_PORTABLE=ON) ;;
    linux-arm64)
      hf_cxx=aarch64-linux-gnu-g++ hf_cc=aarch64-linux-gnu-gcc hf_runner=(qemu-aarch64 -L /usr/aarch64-linux-gnu)
      hf_cmake=(-DHF_PORTABLE=ON -DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/arm64.cmake")
      ;;
    windows-x64)
      hf_cxx=x86_64-w64-mingw32-g++-posix hf_cc=x86_64-w64-mingw32-gcc-posix hf_runner=(wine) hf_shared=hf.dll
      hf_cmake=(-DCMAKE_TOOLCHAIN_FILE="$hf_root/cmake/cross/windows.cmake")
      ;;
    *) hf_fail "no such platform: $1" ;;
  esac
}

# The platforms of this run: HF_PLATFORMS, else those whose compilers are here.
hf_platforms() {
  local platform
  for platform in ${HF_PLATFORMS:-linux-x64 windows-x64 linux-arm64}; do
    hf_toolchain "$platform"
    command -v "$hf_cxx" >/dev/null && printf '%s\n' "$platform"
  done
}

# Builds the library of a platform once and installs it into $hf_work/PLATFORM/tree: include, lib, bin. On Linux the shared
# library there is the one for glibc 2.17.
hf_stage() {
  local platform=$1 source=${2:-$hf_root} folder=${3:-$hf_work}/$1
  hf_toolchain "$platform"
  mkdir -p "$folder"
  {
    cmake -S "$source" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_INSTALL_LIBDIR=lib \
      -DHF_WARNINGS_AS_ERRORS=ON "${hf_cmake[@]+"${hf_cmake[@]}"}" &&
      cmake --build "$folder/build" -j "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" &&
      rm -rf "$folder/tree" && cmake --install "$folder/build" --strip --prefix "$folder/tree"
  } >"$folder/build.log" 2>&1 || {
    grep -E 'error|FAILED' "$folder/build.log" | head -20 >&2
    hf_fail "the library of $platform could not be built; the log is $folder/build.log"
  }
  local strip=strip
  [ "$platform" = linux-arm64 ] && strip=aarch64-linux-gnu-strip
  [ "$platform" = windows-x64 ] && strip=x86_64-w64-mingw32-strip
  "$strip" --strip-debug --enable-deterministic-archives "$folder"/tree/lib/libhf.a || exit 1
  if [ -e "$folder/build/portable/libhf.so.$hf_version" ]; then
    "$strip" -o "$folder/tree/lib/libhf.so.$hf_version" "$folder/build/portable/libhf.so.$hf_version" || exit 1
  fi
}

# The shared library of a platform, as packages of one file carry it.
hf_library() {
  case "$1" in
    windows-x64) printf '%s/%s/tree/bin/hf.dll' "$hf_work" "$1" ;;
    *) printf '%s/%s/tree/lib/libhf.so.%s' "$hf_work" "$1" "$hf_version" ;;
  esac
}
# hf_same_library PLATFORM FILE: a package carries the library that ran in its archive.
hf_same_library() { cmp -s "$(hf_library "$1")" "$2" || hf_fail "another library than that of $1: $2"; }
hf_library_name() { case "$1" in windows-x64) printf hf.dll ;; *) printf libhf.so ;; esac; }

# hf_licences FOLDER PLATFORMS: the licences of what is inside, as the machine that builds has them.
hf_licences() {
  local folder=$1 platforms=$2
  mkdir -p "$folder"
  cp "$hf_root/LICENSE" "$folder/hf-MIT.txt"
  cp /usr/share/common-licenses/MPL-2.0 "$folder/Eigen-MPL-2.0.txt"
  {
    printf 'hf is under the MIT licence (hf-MIT.txt). The library contains code of:\n\n'
    printf '  Eigen, MPL-2.0 (Eigen-MPL-2.0.txt); the source is at https://eigen.tuxfamily.org\n'
    case "$platforms" in *linux* | *windows*)
      printf '  the C++ runtime of GCC, GPL-3 with the Runtime Library Exception, which sets programs free (gcc-runtime.txt)\n' ;;
    esac
    case "$platforms" in *windows*) printf '  mingw-w64 and its winpthreads, ZPL-2.1, MIT and BSD (mingw-w64.txt)\n' ;; esac
    case "$platforms" in *wasm*) printf '  Emscripten and LLVM'"'"'s C++ runtime, MIT and Apache-2.0 with the LLVM exception (emscripten.txt)\n' ;; esac
  } >"$folder/README.txt"
  case "$platforms" in *linux* | *windows*) cp /usr/share/doc/gcc-12-base/copyright "$folder/gcc-runtime.txt" ;; esac
  case "$platforms" in *windows*) cp /usr/share/doc/mingw-w64-common/copyright "$folder/mingw-w64.txt" ;; esac
  case "$platforms" in *wasm*) cp /usr/share/doc/emscripten/copyright "$folder/emscripten.txt" ;; esac
  return 0
}
hf_bom() { python3 "$hf_here/bom.py" "$@" || hf_fail "no bill of materials"; }

# hf_golden_program PLATFORM OUT LINK_ARGUMENTS...: the golden scenes as a program. Its objects are compiled once for each
# platform, with the headers of the tree.
hf_golden_program() {
  local platform=$1 out=$2 source object objects=()
  shift 2
  hf_toolchain "$platform"
  mkdir -p "$hf_work/$platform/golden"
  for source in "$hf_tests"/golden*.cpp; do
    object="$hf_work/$platform/golden/$(basename "$source" .cpp).o"
    objects+=("$object")
    [ "$object" -nt "$source" ] && [ "$object" -nt "$hf_tests/golden_scene.h" ] && continue
    hf_quiet ${CMAKE_CXX_COMPILER_LAUNCHER:-} "$hf_cxx" -std=c++17 -O1 -idirafter /usr/include -I"$hf_work/$platform/tree/include" \
      -c "$source" -o "$object"
  done
  hf_quiet "$hf_cxx" -o "$out" "${objects[@]}" "$@"
}

# The scenes with the figures of the C++ run filled in: every package must come to them.
hf_filled() {
  local filled="$hf_work/scenes.json" program="$hf_work/linux-x64/golden/fill" tree="$hf_work/linux-x64/tree"
  [ "$filled" -nt "$tree/lib/libhf.so.$hf_version" ] && [ "$filled" -nt "$hf_golden/scenes.json" ] || {
    hf_golden_program linux-x64 "$program" -L"$tree/lib" -lhf -Wl,-rpath,"$tree/lib"
    hf_quiet "$program" "$hf_golden/meshes" "$hf_golden/scenes.json" --fill "$filled"
  }
  printf '%s' "$filled"
}
# what `env -i` leaves out and programs need
hf_clean_env=(env -i PATH=/usr/bin:/bin HOME="$hf_work/home" LC_ALL=C.UTF-8)
mkdir -p "$hf_work/home"

# Wine with its settings in the work folder, without a window.
hf_wine() {
  export WINEPREFIX="$hf_work/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml='
  [ -d "$WINEPREFIX/drive_c" ] || wine wineboot -i >/dev/null 2>&1
}

# What a shared library of Linux asks for: names no newer than glibc 2.17, libraries that every system has.
hf_symbol_versions() {
  local versions newest needed
  versions=$(readelf -VW "$1" | grep -oE '\b(GLIBC|GLIBCXX|CXXABI|GCC)_[0-9.]+' | sort -Vu)
  newest=$(printf '%s\n' "$versions" | grep '^GLIBC_' | tail -1)
  [ "$(printf '%s\nGLIBC_2.17\n' "$newest" | sort -V | tail -1)" = GLIBC_2.17 ] || hf_fail "$1 asks for $newest"
  if printf '%s\n' "$versions" | grep -E '^(GLIBCXX|CXXABI)_'; then hf_fail "$1 asks for the C++ runtime of the system"; fi
  needed=$(readelf -dW "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | paste -sd' ')
  hf_ran "symbols up to $newest; needs $needed"
}

# The tools of Python's index, pinned; prints their folder. 77 where the index is not to be had.
hf_python_tools() {
  local tools="$hf_work/tools"
  if ! cmp -s "$hf_here/requirements.txt" "$tools/installed.txt"; then
    python3 -m venv "$tools" >/dev/null 2>&1 && "$tools/bin/pip" install -q --disable-pip-version-check -r "$hf_here/requirements.txt" >"$hf_work/pip.log" 2>&1 &&
      "$tools/bin/pip" download -q --disable-pip-version-check --only-binary :all: -d "$hf_work/wheels" -r "$hf_here/requirements-try.txt" >>"$hf_work/pip.log" 2>&1 || {
      printf 'skipped: the tools of cmake/packages/requirements.txt could not be installed; see %s\n' "$hf_work/pip.log" >&2
      return 77
    }
    cp "$hf_here/requirements.txt" "$tools/installed.txt"
  fi
  printf '%s' "$tools"
}
