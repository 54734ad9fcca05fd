#!/usr/bin/env python3
"""Quads over meshes: the figures of docs/quads.md.

    python3 tests/bench/quads.py HF_QUADS OUT.csv MESH... [--faces 500,5000,50000] [--limit SECONDS] [--crease DEG]
                                   [--peer "COMMAND {mesh} {faces} {out}"]
    python3 tests/bench/quads.py --compare OLD.csv NEW.csv

HF_QUADS is the program hf_quads. It runs for one mesh and one number of faces at a time, on one core. A row is
written as soon as it is known, and rows that OUT.csv has are kept, so a run can be stopped and taken up again.
With --peer, COMMAND makes the quads, from an .obj file to an .obj file, and hf_quads measures them.
Status: ok; invalid; refused (the library gave an error, which the row repeats); late (no answer within the limit).
Seconds are those of hf_quads_create on the wall clock, so the load of the machine counts; a peer's are its processor
time, with reading and writing.
Invalid: an edge that more than two faces share or two run through in one direction, a repeated corner, or another Euler
characteristic than the surface's.
"""

import argparse
import csv
import os
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import time

FIELDS = ["mesh", "wanted", "status", "faces", "irregular", "aspect", "angle", "turned", "crossing", "hausdorff",
          "seconds", "message"]
PATTERNS = {
    "faces": r"quads +\d+ vertices, (\d+) faces",
    "seconds": r"faces in ([\d.]+) s",
    "crossing": r"crossing +(\d+|not) ",
    "irregular": r"irregular +([\d.]+) %",
    "turned": r"turned over (\d+) corners",
    "aspect": r"aspect +median [\d.naif]+, 95 %: ([\d.naif]+)",
    "angle": r"angle off +median [\d.]+, 95 %: ([\d.]+)",
    "hausdorff": r"Hausdorff +([\d.naif]+|not) ",
}


def run(command, limit):
    """The finished process and its processor time; None where the limit passed."""
    core = {min(os.sched_getaffinity(0))}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit, errors="replace",
                              preexec_fn=lambda: os.sched_setaffinity(0, core))
    except (subprocess.TimeoutExpired, OSError) as error:
        return None, str(error)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def as_obj(mesh, folder):
    """The file, or the same surface as .obj."""
    if mesh.endswith(".obj"):
        return mesh
    out = os.path.join(folder, os.path.basename(mesh) + ".obj")
    lines = [line.split("#")[0].strip() for line in open(mesh)]
    words = " ".join(lines).split()
    points, faces = int(words[1]), int(words[2])
    with open(out, "w") as file:
        for i in range(points):
            file.write("v " + " ".join(words[4 + 3 * i:7 + 3 * i]) + "\n")
        place = 4 + 3 * points
        for _ in range(faces):
            size = int(words[place])
            file.write("f " + " ".join(str(int(v) + 1) for v in words[place + 1:place + 1 + size]) + "\n")
            place += 1 + size
    return out


def measure(program, mesh, faces, limit, crease, peer, folder):
    row = {"mesh": os.path.basename(mesh), "wanted": faces}
    if peer:
        made = os.path.join(folder, "quads.obj")
        if os.path.exists(made):
            os.remove(made)
        names = {"mesh": as_obj(mesh, folder), "faces": faces, "out": made}
        done, seconds = run([word.format(**names) for word in shlex.split(peer)], limit)
        if done and not os.path.exists(made):
            return {**row, "status": "refused", "message": f"exit code {done.returncode}, nothing written"}
        command, limit = [program, mesh, "--measure", made], None if done else limit
    else:
        command = [program, mesh, "--faces", str(faces)] + (["--crease", str(crease)] if crease else [])
        done = True
    if done:
        done, measured = run(command, limit)
    if not done:
        return {**row, "status": "late", "seconds": "%.0f" % limit}
    for name, pattern in PATTERNS.items():
        found = re.search(pattern, done.stdout)
        row[name] = found.group(1) if found else ""
    if peer:
        row["seconds"] = "%.2f" % seconds
    euler = re.search(r"Euler characteristic (-?\d+) \(surface (-?\d+)\), directed edges once: yes, "
                      r"repeated corners: none", done.stdout)
    if done.returncode == 0 and euler and (euler.group(1) == euler.group(2)):
        row["status"] = "ok"
    elif done.returncode == 0:
        row["status"] = "invalid"
    else:
        row["message"] = " ".join((done.stderr or done.stdout).split())[:200]
        no_valid_mesh = "no valid mesh" in row["message"] or done.returncode < 0 or "INTERNAL" in row["message"]
        row["status"] = "invalid" if no_valid_mesh else "refused"
    return row


def read(path):
    if not os.path.exists(path):
        return {}
    with open(path, newline="") as file:
        return {(row["mesh"], row["wanted"]): row for row in csv.DictReader(file)}


def text(row):
    return " | ".join(str(row.get(name) or "") for name in FIELDS)


def compare(old, new):
    """Prints the rows of both, and for each measure how many got better and worse by more than a twentieth."""
    names = FIELDS[3:11]
    better, worse = dict.fromkeys(names, 0), dict.fromkeys(names, 0)
    for key in sorted(set(old) & set(new)):
        a, b = old[key], new[key]
        print(" ".join(key), a["status"], "->", b["status"])
        if a["status"] != "ok" or b["status"] != "ok":
            continue
        print("   ", ", ".join(f"{n} {a[n]} -> {b[n]}" for n in names))
        for n in names:
            x, y = (abs(float(r[n]) - (float(r["wanted"]) if n == "faces" else 0)) for r in (a, b))
            better[n] += y < 0.95 * x
            worse[n] += x < 0.95 * y
    for n in names:
        print(f"{n}: better {better[n]}, worse {worse[n]}")


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--compare":
        return compare(read(sys.argv[2]), read(sys.argv[3]))
    parser = argparse.ArgumentParser()
    parser.add_argument("program"), parser.add_argument("out"), parser.add_argument("mesh", nargs="+")
    parser.add_argument("--faces", default="500,5000,50000")
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--crease", type=int, default=0)
    parser.add_argument("--peer", default="")
    options = parser.parse_args()
    known = read(options.out)
    with open(options.out, "a", newline="") as file, tempfile.TemporaryDirectory() as folder:
        writer = csv.DictWriter(file, FIELDS, restval="")
        if not known:
            writer.writeheader()
        for faces in map(int, options.faces.split(",")):
            for mesh in options.mesh:
                if (os.path.basename(mesh), str(faces)) in known:
                    continue
                row = measure(options.program, mesh, faces, options.limit, options.crease, options.peer,
                              folder)
                writer.writerow(row)
                file.flush()
                print(text(row), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
