#!/bin/sh
# What two promises cost, in instructions (callgrind counts them, so a busy machine changes nothing): asking whether a
# call was cancelled, at most 1 % of every long call; the guards of HF_HARDEN, less than 1 % of all.
# Builds reliability_cancel with and without the guards and runs each of its calls once, small form, one thread.
# Needs valgrind; exits with 77 (skipped) without it.
# Usage: costs.sh [FOLDER_TO_BUILD_IN]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build/costs}
if ! command -v valgrind >/dev/null; then
  echo "no valgrind here (Debian package valgrind): costs are skipped"
  exit 77
fi
mkdir -p "$build"
for guards in ON OFF; do
  cmake -S "$root" -B "$build/$guards" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DHF_WITH_GPL=OFF \
    -DHF_BUILD_SAMPLES=OFF -DHF_BUILD_TESTS=ON -DHF_BUILD_UNIT_TESTS=OFF -DHF_HARDEN=$guards >"$build/$guards.log"
  cmake --build "$build/$guards" --target reliability_cancel
done
status=0
for name in $("$build/ON/bin/reliability_cancel" --names); do
  for guards in ON OFF; do
    valgrind --tool=callgrind --callgrind-out-file="$build/$guards.$name.callgrind" --toggle-collect=watched_call \
      "$build/$guards/bin/reliability_cancel" --once "$name" >"$build/$guards.$name.log" 2>&1 || { cat "$build/$guards.$name.log"; exit 1; }
  done
  python3 "$root/tests/reliability/costs.py" "$name" "$build/ON.$name.callgrind" "$build/OFF.$name.callgrind" || status=1
done
exit $status
