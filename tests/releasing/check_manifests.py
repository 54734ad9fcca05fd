#!/usr/bin/env python3
"""check_manifests.py [--release]: every manifest has the project's version, licence, addresses and keywords.

--release: what a tag needs besides: addresses that are not reserved names, a date in CHANGELOG.md, and the tag on a clean tree.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
faults = []


def text(path):
    return (ROOT / path).read_text()


def toml(path):
    """Keys of the tables of a manifest, without tomllib: Debian's python3 may be older than 3.11."""
    found, table = {}, ""
    for line in text(path).splitlines():
        if line.startswith("["):
            table = line.strip("[]") + "."
        elif re.match(r"[\w-]+ = ", line):
            key, value = line.split(" = ", 1)
            found[table + key] = json.loads(value.split(" #")[0]) if value[0] in "\"[" and "@" not in value else value
    return found


def npm(path):
    found = json.loads(text(path))
    repository = found["repository"]["url"].removeprefix("git+")
    return found["version"], found["license"], found.get("homepage") or found["documentationUrl"], repository, found["keywords"]


def shown(path, *patterns):
    """What each pattern finds in a file that is no manifest by itself."""
    return [(re.search(pattern, text(path)) or [None, f"nothing like {pattern}"])[1] for pattern in patterns]


def manifests():
    """path: version, licence, homepage, repository, keywords; None: the format has none, or the version is filled in when it is packed."""
    for path in ("bindings/js/package.json", "bindings/js/studio/package.json", "bindings/unity/package.json"):
        yield path, npm(path)
    python = toml("bindings/python/pyproject.toml")
    yield "bindings/python/pyproject.toml", (python["project.version"], re.search(r'"(.*)"', python["project.license"])[1],
                                             python["project.urls.Homepage"], python["project.urls.Repository"], python["project.keywords"])
    for path in ("bindings/rust/Cargo.toml", "bindings/bevy/Cargo.toml"):
        yield path, tuple(toml(path)[f"package.{key}"] for key in ("version", "license", "homepage", "repository", "keywords"))
    blender = toml("bindings/blender/hf_blender/blender_manifest.toml")
    yield "bindings/blender/hf_blender/blender_manifest.toml", (None, blender["license"][0].removeprefix("SPDX:"), blender["website"], None, blender["tags"])
    licence, homepage, repository, tags = shown("cmake/packages/nupkg.sh", r'"expression">(.*)</license', "<projectUrl>(.*)</projectUrl", r'<repository type="git" url="(.*)" />', "<tags>(.*)</tags>")
    yield "cmake/packages/nupkg.sh", (None, licence, homepage, repository, tags.split())
    licence, homepage, repository, tags = shown("cmake/packages/conan/conanfile.py", 'license = "(.*)"', 'homepage = "(.*)"', ' url = "(.*)"', r"topics = \((.*)\)")
    yield "cmake/packages/conan/conanfile.py", (None, licence, homepage, repository, tags.split(", "))
    port = json.loads(text("cmake/packages/vcpkg/vcpkg.json"))
    yield "cmake/packages/vcpkg/vcpkg.json", (None, port["license"], port["homepage"], None, None)
    yield "cmake/packages/deb.sh", (None, None, shown("cmake/packages/deb.sh", r"Homepage: (\S+?)\\n")[0], None, None)


version = shown("CMakeLists.txt", r"project\(hf VERSION (\d+\.\d+\.\d+)")[0]
all_of_them = dict(manifests())
_, _, homepage, repository, _ = all_of_them["bindings/js/package.json"]
for path, found in all_of_them.items():
    for what, has, wanted in zip(("version", "licence", "homepage", "repository"), found, (version, "MIT", homepage, repository)):
        if has is not None and has != wanted:
            faults.append(f"{path}: its {what} is {has}, not {wanted}")
    if found[4] is not None and not 3 <= len(found[4]) <= 5:
        faults.append(f"{path}: {len(found[4])} keywords; Cargo takes 5 at most, and a search finds a package with 3")

# versions that stand elsewhere
others = {
    "samples/studio/package.json": r'"version": "(.*)"',
    "bindings/rust/Cargo.lock": r'name = "hf"\nversion = "(.*)"',
    "bindings/js/src/raw.js": r'headerVersion = "(.*)"',
    "CHANGELOG.md": r"\n## (\d+\.\d+\.\d+)",
    "docs/platforms.md": r"`hf-(\d+\.\d+\.\d+)-linux-x64",
}
for path, pattern in others.items():
    if (has := shown(path, pattern)[0]) != version:
        faults.append(f"{path}: its version is {has}, not {version}")

if "--release" in sys.argv[1:]:
    for address in (homepage, repository):
        if re.search(r"example\.(org|com|net)", address):
            faults.append(f"{address} is a reserved name: docs/releasing.md says how to put the project's own in its place")
    if not re.search(rf"\n## {re.escape(version)} \(\d{{4}}-\d\d-\d\d\)", text("CHANGELOG.md")):
        faults.append(f'CHANGELOG.md: write "## {version} (YEAR-MONTH-DAY)"')

    def git(*given):
        return subprocess.run(["git", "-C", str(ROOT), *given], capture_output=True, text=True).stdout.strip()

    if git("status", "--porcelain"):
        faults.append("the working tree holds changes that are not committed")
    if f"v{version}" not in git("tag", "--points-at", "HEAD").splitlines():
        faults.append(f"the tag v{version} is not on this commit")

for fault in faults:
    print("error:", fault)
print(f"{len(all_of_them)} manifests and {len(others)} other places, version {version}")
sys.exit(1 if faults else 0)
