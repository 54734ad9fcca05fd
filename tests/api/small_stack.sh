#!/bin/sh
# small_stack.sh PROGRAM...: runs it with every stack at 256 KiB, which is what a call of the library may need at most.
ulimit -s 256 || exit 1
"$@"
code=$?
[ "$code" -lt 128 ] || echo "ended by signal $((code - 128)) with a stack of 256 KiB: $*" >&2
exit "$code"
