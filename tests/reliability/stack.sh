#!/usr/bin/env bash
# Runs the tests of the public ABI with every stack at 256 KiB, the main thread's too: stack.sh BIN_FOLDER
#   Prints STACK_PROGRAMS_THAT_FAIL. The test programs keep large arrays off the stack.
set -u
failed=0 count=0
for program in "$1"/api_*_test; do
  [ -x "$program" ] || continue
  count=$((count + 1))
  (ulimit -s 256 && exec "$program") >/dev/null 2>&1 && continue
  failed=$((failed + 1))
  echo "fails with a stack of 256 KiB: $(basename "$program")"
done
printf 'STACK_PROGRAMS %s >=15\nSTACK_PROGRAMS_THAT_FAIL %s <=0\n' "$count" "$failed"
[ "$failed" -eq 0 ] && [ "$count" -ge 15 ]
