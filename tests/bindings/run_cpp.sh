#!/usr/bin/env bash
# run_cpp.sh LIBRARY COMPILER PROGRAM.cpp: compiles a program over hf.hpp and the shared library and runs it.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$2" -std=c++17 -I"$root/include" "$3" -o "$3.out" "$1" -Wl,-rpath,"$(dirname "$1")"
exec "$3.out"
