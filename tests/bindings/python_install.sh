#!/usr/bin/env bash
# python_install.sh LIBRARY SCRATCH: the Python package built and installed by pip (nothing is downloaded), with the
# library inside, then imported without any help. Without a library the install fails with a sentence. 77 (skipped) where pip, setuptools or numpy are missing.
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
unset PYTHONPATH HF_LIBRARY
install() { # install SITE
  rm -rf "$scratch/source/build"
  "$builder" -m pip install --quiet --no-deps --no-build-isolation --no-index --disable-pip-version-check --target "$scratch/$1" "$scratch/source"
}
refused() { # refused SENTENCE: the install fails, says it, and leaves nothing
  install none >"$scratch/log" 2>&1 && { echo "error: installed without a library"; exit 1; }
  grep -qF "$1" "$scratch/log" || { cat "$scratch/log"; echo "error: it does not say: $1"; exit 1; }
  [ ! -e "$scratch/none/hf" ] || { echo "error: a failed install left files"; exit 1; }
}
refused "error: this package would have no hf library. Build it"
HF_LIBRARY="$scratch/libhf.so" refused "error: HF_LIBRARY names $scratch/libhf.so, which is not there"
HF_LIBRARY=$library install given || exit 1
cmp "$library" "$scratch/given/hf/libhf.so" || exit 1
cp "$library" "$scratch/source/hf/libhf.so"
install site || exit 1
cd "$scratch"
PYTHONPATH="$scratch/site" exec "$user" -c '
import hf, sys
assert hf.__file__.startswith(sys.argv[1]), hf.__file__
s = hf.Solver(hf.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
s.add_sites([0], [1.0])
assert abs(s.solve() - 1).max() < 1e-6
print("installed", hf.__file__, hf.version())' "$scratch/site"
