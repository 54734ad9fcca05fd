#!/usr/bin/env bash
# python_install.sh LIBRARY SCRATCH: the Python package built and installed by pip (nothing is downloaded), with the
# library inside, then imported without any help. 77 (skipped) where pip, setuptools or numpy are missing.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
library=$(readlink -f "$1") scratch=$2
builder=
for python in /usr/bin/python3 python3; do
  "$python" -c 'import setuptools, pip, sys; sys.exit(int(setuptools.__version__.split(".")[0]) < 61)' 2>/dev/null &&
    builder=$python && break
done
[ -n "$builder" ] || { echo "skipped: no Python with pip and setuptools >= 61 here"; exit 77; }
user=
for python in /usr/bin/python3 python3; do
  "$python" -c 'import numpy' 2>/dev/null && user=$python && break
done
[ -n "$user" ] || { echo "skipped: no Python with numpy here (Debian: python3-numpy)"; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch"
cp -r "$root/bindings/python" "$scratch/source"
cp "$library" "$scratch/source/hf/libhf.so"
unset PYTHONPATH HF_LIBRARY
"$builder" -m pip install --quiet --no-deps --no-build-isolation --no-index --disable-pip-version-check \
  --target "$scratch/site" "$scratch/source" || exit 1
cd "$scratch"
PYTHONPATH="$scratch/site" exec "$user" -c '
import hf, sys
assert hf.__file__.startswith(sys.argv[1]), hf.__file__
s = hf.Solver(hf.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
s.add_sites([0], [1.0])
assert abs(s.solve() - 1).max() < 1e-6
print("installed", hf.__file__, hf.version())' "$scratch/site"
