"""make_zip.py LIBRARY... OUT.zip: the add-on with the Python package and the shared libraries inside, to be installed.

The zip is an extension for Blender 4.2 and later (blender_manifest.toml) and an add-on for earlier ones (bl_info). One
library for each system: libhf.so, hf.dll, libhf.dylib. EXTRA=FOLDER in the environment puts the files of a folder in.
"""

import os
import pathlib
import re
import sys
import time
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
SYSTEMS = {".dll": ("hf.dll", "windows-x64"), ".dylib": ("libhf.dylib", "macos-arm64")}


def manifest(platforms):
    version = re.search(r"project\(hf VERSION ([0-9.]+)", (HERE.parents[1] / "CMakeLists.txt").read_text()).group(1)
    text = (HERE / "hf_blender" / "blender_manifest.toml").read_text()
    return text.replace("@VERSION@", version).replace("@PLATFORMS@", ", ".join(f'"{name}"' for name in sorted(platforms)))


def main(libraries, out):
    pathlib.Path(out).parent.mkdir(parents=True, exist_ok=True)
    files, platforms = {}, set()
    for path in (HERE / "hf_blender").glob("*.py"):
        files[path.name] = path.read_bytes()
    for path in (HERE.parent / "python" / "hf").glob("*.py"):
        files[f"vendor/hf/{path.name}"] = path.read_bytes()
    for library in map(pathlib.Path, libraries):
        name, platform = SYSTEMS.get(library.resolve().suffix, ("libhf.so", "linux-x64"))
        files[f"vendor/hf/{name}"] = library.read_bytes()
        platforms.add(platform)
    if "EXTRA" in os.environ:
        extra = pathlib.Path(os.environ["EXTRA"])
        files.update({path.relative_to(extra).as_posix(): path.read_bytes() for path in extra.rglob("*") if path.is_file()})
    files["LICENSE"] = (HERE.parents[1] / "LICENSE").read_bytes()
    files["blender_manifest.toml"] = manifest(platforms).encode()
    # the same bytes for the same content: one date, 1980 unless SOURCE_DATE_EPOCH says another
    date = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", 0)), 315532800))[:6]
    with zipfile.ZipFile(out, "w") as archive:
        for name in sorted(files):
            info = zipfile.ZipInfo(f"hf_blender/{name}", date)
            info.compress_type, info.create_system, info.external_attr = zipfile.ZIP_DEFLATED, 3, 0o100644 << 16
            archive.writestr(info, files[name], compresslevel=9)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1:-1], sys.argv[-1])
