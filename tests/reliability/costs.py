#!/usr/bin/env python3
"""Reads two callgrind profiles of one call: costs.py NAME GUARDED PLAIN

Prints the share of the guarded profile's instructions that asks for a cancel, and how many more it has than the plain
one, in per cent. A poll is a call of current_progress() and at most eight instructions around it, which the compiler
puts into the caller (src/base/progress.h).
"""

import re
import sys

AROUND = 8
ASKS = "current_progress"


def read(path):
    """All instructions of a profile; calls of ASKS; the instructions inside it."""
    names, total, calls, inside = {}, 0, 0, 0
    function, called = "", ""
    skip = False  # the line after "calls=" is the callee's cost, which its own lines hold
    for line in open(path, errors="replace"):
        if found := re.match(r"(c?)fn=\((\d+)\)(?: (.*))?", line):
            if found[3]:
                names[found[2]] = found[3].strip()
            if found[1]:
                called = names[found[2]]
            else:
                function = names[found[2]]
        elif found := re.match(r"calls=(\d+)", line):
            calls += int(found[1]) if ASKS in called else 0
            skip = True
        elif found := re.match(r"[+\-*\d]\S* (\d+)$", line):
            if not skip:
                total += int(found[1])
                inside += int(found[1]) if ASKS in function else 0
            skip = False
    return total, calls, inside


def main():
    name, guarded, plain = sys.argv[1:]
    total, calls, inside = read(guarded)
    asking = 100 * (inside + AROUND * calls) / total
    guards = 100 * (total / read(plain)[0] - 1)
    print(f"cost_of_asking_{name} {asking:.3f} <=1   ({calls} times in {total} instructions)")
    print(f"cost_of_guards_{name} {guards:.2f} <=1")
    sys.exit(asking > 1 or guards > 1)


if __name__ == "__main__":
    main()
