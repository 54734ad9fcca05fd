"""check_lock.py: the lock file of the npm packages that tests install, and the scripts that install them.

Every package has one version and a hash; no address of a registry stands in a file; no install script runs."""

import json
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
faults = []

packages = 0
# the list with a reason for each; those of tests/web are there to be tried
table = [line for line in (ROOT / "samples" / "studio" / "README.md").read_text().splitlines() if line.startswith("| ")]
for folder in (HERE, ROOT / "tests" / "web", ROOT / "samples" / "studio"):
    at = folder.relative_to(ROOT)
    wanted = json.loads((folder / "package.json").read_text())["dependencies"]
    lock = json.loads((folder / "package-lock.json").read_text())["packages"]
    packages += len(lock) - 1
    for name, version in wanted.items():
        if not re.fullmatch(r"\d+\.\d+\.\d+(-[\w.]+)?", version):
            faults.append(f"{at}/package.json: {name} is {version}, which is no single version")
        if folder.name != "web" and not any(name in row and version in row for row in table):
            faults.append(f"samples/studio/README.md: its table has no row of {name} {version}")
        if lock.get(f"node_modules/{name}", {}).get("version") != version:
            faults.append(f"{at}/package-lock.json: {name} is not {version}")
    for path, entry in lock.items():
        if path and not re.fullmatch(r"sha512-[A-Za-z0-9+/]{86}==", entry.get("integrity", "")):
            faults.append(f"{at}/package-lock.json: {path} has no sha512")
        if "link" in entry or not entry.get("version", "") and path:
            faults.append(f"{at}/package-lock.json: {path} has no version")
    if "://" in (folder / "package-lock.json").read_text():
        faults.append(f"{at}/package-lock.json: holds an address; npm ci finds a package by version and hash (remove resolved and funding)")

# every call of a package manager in scripts: pinned, and nothing of a package runs
scripts = [path for folder in ("cmake", "tests", "samples", "bindings", ".ci") for path in (ROOT / folder).rglob("*")
           if path.is_file() and (path.suffix == ".sh" or path.name == "run")]
calls = 0
for path in scripts:
    for number, line in enumerate(path.read_text().splitlines(), 1):
        where = f"{path.relative_to(ROOT)}:{number}"
        if re.search(r"\b(npm (ci|i|install|exec|add)|npx|yarn|pnpm)\b", line) and not line.lstrip().startswith("#"):
            calls += 1
            if "npm ci --ignore-scripts" not in line and "npm install --offline --ignore-scripts" not in line:
                faults.append(f"{where}: installs npm packages otherwise than by npm ci --ignore-scripts, or offline")
        if re.search(r"\bpip3? install\b", line) and "--no-index" not in line and "\\" not in line:
            faults.append(f"{where}: pip may download")
if not calls:
    faults.append("no script installs the packages of the lock files")
for fault in faults:
    print("error:", fault)
print(f"{packages} packages with version and hash, {calls} calls")
sys.exit(1 if faults else 0)
