#!/usr/bin/env python3
"""Writes bindings/api.json and the raw layer of every language from include/hf/*.h.

usage: generate.py           writes what has changed
       generate.py --check   writes nothing; fails and names the files that are not as the headers say (a CTest test)
"""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import class_cpp
import class_csharp
import class_godot
import class_js
import class_python
import class_rust
import layer_csharp
import layer_js
import layer_python
import layer_rust
import model
import names
import parse_headers

RAW = (layer_csharp, layer_js, layer_python, layer_rust)  # they show structs as they are
BINDINGS = pathlib.Path(__file__).resolve().parent.parent
ROOT = BINDINGS.parent


def files(include=ROOT / "include"):
    """Name under bindings -> text, from the headers in a folder."""
    api = parse_headers.read_api(include)
    macros = {c["name"]: c["value"] for c in api["constants"]}
    version = re.search(r"project\(hf VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    if version != ".".join(str(macros[f"HF_VERSION_{part}"]) for part in ("MAJOR", "MINOR", "PATCH")):
        raise parse_headers.HeaderError(f"base.h: HF_VERSION_* are not the version of CMakeLists.txt, {version}")
    api = {"version": version, **api}
    result = {"api.json": parse_headers.to_text(api)}
    # the functions by name, one a line: packages and tests read it
    result["functions.txt"] = "".join(f["name"] + "\n" for f in api["functions"])
    for layer in (class_cpp, class_csharp, class_godot, class_js, class_python, class_rust, layer_python, layer_js, layer_csharp, layer_rust, names):
        result.update(layer.write(api if layer in RAW else model.elements(api)))
    return result


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    stale = []
    for name, text in files().items():
        path = BINDINGS / name
        if path.exists() and path.read_text() == text:
            continue
        stale.append(name)
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            print("wrote bindings/" + name)
    if check and stale:
        sys.exit("error: not as the headers say, run bindings/generate/generate.py: " + ", ".join(stale))
    if check:
        print(f"{len(files())} generated files agree with the headers")


if __name__ == "__main__":
    try:
        main()
    except (parse_headers.HeaderError, model.Problems) as error:
        sys.exit(f"error: {error}")
