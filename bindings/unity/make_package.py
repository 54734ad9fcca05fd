"""make_package.py OUTDIR [LIBRARY...]: the UPM package, with the C# classes and the shared libraries in it."""

import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent

if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1]) / "org.hf.fields"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    for name in ("package.json", "README.md"):
        shutil.copy(HERE / name, out)
    for name in ("Runtime", "Editor"):
        shutil.copytree(HERE / name, out / name)
    shutil.copytree(HERE.parent / "csharp" / "Hf", out / "Runtime" / "Hf")
    (out / "Plugins").mkdir()
    for library in sys.argv[2:]:
        shutil.copy(library, out / "Plugins")
