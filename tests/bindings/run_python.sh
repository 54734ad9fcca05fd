#!/usr/bin/env bash
# run_python.sh LIBRARY SCRIPT ARGS...: a test of the Python package with a Python that has numpy; 77 (skipped) without
# one.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
export HF_LIBRARY=$1 PYTHONPATH="$root/bindings/python:$root/tests/bindings" PYTHONDONTWRITEBYTECODE=1
shift
for python in "${HF_PYTHON:-/usr/bin/python3}" python3; do
  if "$python" -c 'import numpy' 2>/dev/null; then exec "$python" "$@"; fi
done
echo "skipped: no Python with numpy here (Debian: python3-numpy)"
exit 77
