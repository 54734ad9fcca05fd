"""make_zip.py LIBRARY OUT.zip: the add-on with the Python package and the shared library inside, to be installed."""

import pathlib
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent


def main(library, out):
    library = pathlib.Path(library).resolve()
    pathlib.Path(out).parent.mkdir(parents=True, exist_ok=True)
    name = {".dll": "hf.dll", ".dylib": "libhf.dylib"}.get(library.suffix, "libhf.so")
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted((HERE / "hf_blender").glob("*.py")):
            archive.write(path, f"hf_blender/{path.name}")
        for path in sorted((HERE.parent / "python" / "hf").glob("*.py")):
            archive.write(path, f"hf_blender/vendor/hf/{path.name}")
        archive.write(library, f"hf_blender/vendor/hf/{name}")
        archive.write(HERE.parents[1] / "LICENSE", "hf_blender/LICENSE")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
