#!/bin/sh
# Runs the fuzzers under libFuzzer with AddressSanitizer and UndefinedBehaviorSanitizer: 1,000,000 sequences of API calls,
# and 100,000 glTF files of at most 512 MB and 1 s each. Needs clang; exits with 77 (skipped) without it.
# Usage: fuzz.sh [FOLDER_TO_BUILD_IN [SEQUENCES [FILES]]]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build/fuzz}
sequences=${2:-1000000}
files=${3:-100000}
if ! command -v clang++ >/dev/null; then
  echo "no clang++ here (Debian package clang): libFuzzer is skipped"
  exit 77
fi
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang \
  -DCMAKE_CXX_COMPILER=clang++ -DHF_WITH_GPL=ON -DHF_BUILD_SAMPLES=ON -DHF_BUILD_TESTS=ON -DHF_SANITIZE=fuzzer-no-link,address,undefined \
  >"$build.log" || { cat "$build.log"; exit 1; }
cmake --build "$build" --target fuzz_sequences fuzz_gltf
mkdir -p "$build/inputs_sequences" "$build/inputs_gltf"
status=0
run() { # NAME TARGET PROGRAM OPTIONS...
  name=$1 target=$2
  shift 2
  # a fault stops the run, and the number of executions is too small
  "$@" -print_final_stats=1 >"$build/$name.log" 2>&1 || { status=1; tail -40 "$build/$name.log"; }
  done=$(sed -n 's/^stat::number_of_executed_units: *//p' "$build/$name.log")
  echo "$name ${done:-0} >=$target"
  [ "${done:-0}" -ge "$target" ] || status=1
}
cd "$build"
# AddressSanitizer's quarantine of freed memory counts against the limit, so it is small
export ASAN_OPTIONS="quarantine_size_mb=8${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
run fuzz_sequences_executed "$sequences" bin/fuzz_sequences "-runs=$sequences" -max_len=96 -timeout=10 inputs_sequences
# files are long from the start, because short ones are refused at once
run fuzz_gltf_executed "$files" bin/fuzz_gltf "-runs=$files" -max_len=16384 -len_control=0 -timeout=1 -rss_limit_mb=512 inputs_gltf
solved=$(sed -n 's/^stat::number_of_solved_units: *//p' "$build/fuzz_gltf_executed.log")
echo "fuzz_gltf_solved ${solved:-0} >=$((files / 50))"
[ "${solved:-0}" -ge $((files / 50)) ] || status=1
exit $status
