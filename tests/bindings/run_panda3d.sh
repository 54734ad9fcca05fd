#!/usr/bin/env bash
# run_panda3d.sh LIBRARY PICTURE.png: the Panda3D layer; 77 (skipped) without a Python that has Panda3D and numpy
# (HF_PANDA3D).
root=$(cd "$(dirname "$0")/../.." && pwd)
export HF_LIBRARY=$1 PYTHONPATH="$root/bindings/python:$root/bindings/panda3d" PYTHONDONTWRITEBYTECODE=1
exec "${HF_PANDA3D:-python3}" "$root/tests/bindings/panda3d_test.py" "$2"
