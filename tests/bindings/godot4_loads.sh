#!/usr/bin/env bash
# godot4_loads.sh COMPILER libhf.a SCRATCH: the add-on for Godot 4 compiles without warnings, exports its entry function alone, and
# loads in a host without Godot. 77 (skipped) elsewhere than on Linux.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
case "$("$1" -dumpmachine)" in *linux*) ;; *) echo "skipped: not Linux"; exit 77 ;; esac
rm -rf "$3/addons"
CXX=$1 CXXFLAGS='-O0 -Wall -Wextra -Wpedantic -Werror' "$root/bindings/godot/build4.sh" "$2" "$3"
library=$(echo "$3"/addons/hf/*.so)
symbol=$(sed -n 's/^entry_symbol = "\(.*\)"$/\1/p' "$3/addons/hf/hf.gdextension")
exports=$(nm -D --defined-only "$library" | awk '{ print $3 }')
[ "$exports" = "$symbol" ] || { echo "exports $exports, not $symbol alone" && exit 1; }
if readelf -dW "$library" | grep -E 'NEEDED.*(libstdc|libgcc)'; then exit 1; fi
grep -q "res://addons/hf/${library##*/}" "$3/addons/hf/hf.gdextension"
"$1" -std=c++17 -Wall -Wextra -Wpedantic -Werror -o "$3/host" "$root/tests/bindings/godot4_host.cpp" -ldl
exec "$3/host" "$library"
