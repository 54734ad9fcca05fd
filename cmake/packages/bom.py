"""bom.py OUT.json PLATFORM FOLDER...: the bill of materials of a package as CycloneDX 1.5.

PLATFORM: linux-x64, linux-arm64, windows-x64 (the C++ runtime is inside), debian (it is not), none (no
library inside); several with commas. The files below the folders that are libraries are named with their SHA-256.
Versions are those of this machine's Debian packages.
"""

import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import uuid

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARIES = re.compile(r"(\.so(\.[0-9.]+)?|\.a|\.dll|\.lib|\.wasm)$")
# what is compiled or linked into the library: name, Debian packages that tell the version, licence, where
GCC = "GPL-3.0-or-later WITH GCC-exception-3.1"
PARTS = (
    ("Eigen", ("libeigen3-dev",), "MPL-2.0", None),
    ("GCC runtime (libstdc++, libgcc)", ("libstdc++-12-dev",), GCC, "linux-x64"),
    ("GCC runtime (libstdc++)", ("libstdc++-12-dev-arm64-cross",), GCC, "linux-arm64"),
    ("GCC runtime (libstdc++, libgcc, libssp)", ("gcc-mingw-w64-x86-64-posix-runtime",), GCC, "windows-x64"),
    ("mingw-w64 runtime and winpthreads", ("mingw-w64-x86-64-dev",), "ZPL-2.1 AND MIT AND BSD-3-Clause", "windows-x64"),
    ("Emscripten runtime (libc, libc++)", ("emscripten",), "MIT AND (Apache-2.0 WITH LLVM-exception)", "wasm"),
)


def version_of(packages):
    for package in packages:
        found = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True)
        if found.returncode == 0 and found.stdout:
            return package, found.stdout
    return packages[0], None


def main(out, platforms, folders):
    version = re.search(r"project\(hf VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    platforms = platforms.split(",")
    components = []
    for name, packages, licence, platform in PARTS:
        if platforms == ["none"] or (platform and platform not in platforms):
            continue
        package, found = version_of(packages)
        component = {"type": "library", "name": name, "licenses": [{"expression": licence}]}
        if found:
            component |= {"version": found, "purl": f"pkg:deb/debian/{package}@{found}"}
        components.append(component)
    files = sorted({path for folder in folders for path in pathlib.Path(folder).rglob("*")
                    if path.is_file() and not path.is_symlink() and LIBRARIES.search(path.name)})
    for path in files:
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        name = next(path.relative_to(folder) for folder in folders if path.is_relative_to(folder)).as_posix()
        components.append({"type": "file", "name": name, "hashes": [{"alg": "SHA-256", "content": digest}]})
    date = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    bill = {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
        "metadata": {"timestamp": date.strftime("%Y-%m-%dT%H:%M:%SZ"),
                     "component": {"type": "library", "name": "hf", "version": version, "licenses": [{"license": {"id": "MIT"}}]}},
        "components": components,
    }
    # named by its content, so that the same package has the same number
    bill["serialNumber"] = f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(bill, sort_keys=True))}"
    pathlib.Path(out).write_text(json.dumps(bill, indent=2, sort_keys=True) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
