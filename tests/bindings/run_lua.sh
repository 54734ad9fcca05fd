#!/usr/bin/env bash
# run_lua.sh LIBRARY SCRIPT ARGS...: a test in LuaJIT; 77 (skipped) without it.
command -v luajit >/dev/null || { echo "skipped: no LuaJIT here (Debian: luajit)"; exit 77; }
root=$(cd "$(dirname "$0")/../.." && pwd)
export HF_LIBRARY=$1 LUA_PATH="$root/bindings/lua/?.lua;;"
shift
exec luajit "$@"
