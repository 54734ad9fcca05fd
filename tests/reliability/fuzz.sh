#!/bin/sh
# Runs the fuzzers under libFuzzer with AddressSanitizer and UndefinedBehaviorSanitizer: 1,000,000 sequences of API calls,
# 100,000 glTF files of at most 512 MB and 1 s each, and 20,000 small meshes with quads, regions, transfers, weights and
# links of them. Workers share one folder of inputs and halve the executions.
# Needs clang; exits with 77 (skipped) without it.
# Usage: fuzz.sh [--short] [--workers N] [FOLDER_TO_BUILD_IN [SEQUENCES [FILES [SHAPES]]]]
#   --short      a minute each instead of a number of executions; says how long the long form takes at that rate
#   --workers N  processes at once, 2 without it
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
seconds=0
workers=2
while [ $# -gt 0 ]; do
  case "$1" in
    --short) seconds=60 ;;
    --workers) workers=$2; shift ;;
    -*) sed -n 's/^# //p' "$0"; exit 1 ;;
    *) break ;;
  esac
  shift
done
build=${1:-$root/build/fuzz}
sequences=${2:-1000000}
files=${3:-100000}
shapes=${4:-20000}
if ! command -v clang++ >/dev/null; then
  echo "no clang++ here (Debian package clang): libFuzzer is skipped"
  exit 77
fi
mkdir -p "$build"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang \
  -DCMAKE_CXX_COMPILER=clang++ -DHF_WITH_GPL=ON -DHF_BUILD_SAMPLES=ON -DHF_BUILD_TESTS=ON -DHF_SANITIZE=fuzzer-no-link,address,undefined \
  >"$build.log" || { cat "$build.log"; exit 1; }
cmake --build "$build" --target fuzz_sequences fuzz_gltf fuzz_shapes
status=0
# The sum of a figure that libFuzzer or the fuzzer prints at its end, over the logs of all workers.
sum() { # NAME FIGURE
  cat "$build/$1"/fuzz-*.log 2>/dev/null | awk -v figure="stat::$2:" '$1 == figure { sum += $2 } END { print sum + 0 }'
}
run() { # NAME TARGET OPTIONS...: every worker leaves fuzz-N.log and what it found in the folder NAME
  name=$1 target=$2
  shift 2
  mkdir -p "$build/$name" "$build/inputs_$name"
  rm -f "$build/$name"/fuzz-*.log
  length="-runs=$(((target + workers - 1) / workers))"
  [ "$seconds" -eq 0 ] || length="-max_total_time=$seconds"
  begin=$(date +%s)
  # a fault ends its worker, and libFuzzer's exit code tells of it when the others are done
  (cd "$build/$name" && "../bin/fuzz_$name" "-jobs=$workers" "-workers=$workers" "$length" -print_final_stats=1 "$@" \
    "../inputs_$name" >run.log 2>&1) || { status=1; tail -n 40 "$build/$name"/fuzz-*.log; }
  taken=$(($(date +%s) - begin))
  executed=$(sum "$name" number_of_executed_units)
  rate=$((executed / (taken > 0 ? taken : 1)))
  if [ "$seconds" -eq 0 ]; then
    echo "fuzz_${name}_executed $executed >=$target"
    [ "$executed" -ge "$target" ] || status=1
  else
    echo "fuzz_${name}_executed $executed >=1"
    [ "$executed" -ge 1 ] || status=1
    [ "$rate" -eq 0 ] || echo "  $target take $((target / rate / 60)) min at this rate"
  fi
  echo "  $executed executions in $taken s with $workers workers: $rate a second"
}
# AddressSanitizer's quarantine of freed memory counts against the limit, so it is small. Five frames of each allocation
# are kept, because the library's memory passes through few functions.
export ASAN_OPTIONS="quarantine_size_mb=8:malloc_context_size=5${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
# No entropic schedule: counting how rare each feature is takes more than half of the time, and in equal time it reaches
# fewer edges (10,738 beside 11,428 in 25 s from nothing).
run sequences "$sequences" -max_len=96 -timeout=10 -entropic=0
run shapes "$shapes" -max_len=96 -timeout=30 -entropic=0
# files are long from the start, because short ones are refused at once
run gltf "$files" -max_len=16384 -len_control=0 -timeout=1 -rss_limit_mb=512
solved=$(sum gltf number_of_solved_units)
executed=$(sum gltf number_of_executed_units)
echo "fuzz_gltf_solved $solved >=$((executed / 50))"
[ "$solved" -ge $((executed / 50)) ] || status=1
exit $status
