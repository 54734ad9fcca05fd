#!/usr/bin/env python3
"""Tries every constant of the search for links at half and at double on models, through hf_link_trials.

    link_constants.py HF_LINK_TRIALS FOLDER [--models a,b,...] [--constants x,y,...] [--values 0.5,2] [--each]

Prints one line per value: sums and worst figures over the models. --each adds a line per model that changes. FOLDER
holds MODEL.glb. The models named here are the choosing half of docs/studies/links.md. Nothing is timed."""
import argparse
import os
import re
import subprocess
import sys

CHOOSING = "q_CyberCharacter,q_Man_Casual,q_PlatformerCharacter,q_Spider,q_Frog,morph-stress-test"
HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src", "mesh", "link_constants.h")


def constants():
    found = re.findall(r"^constexpr (\S+) (\w+) = ([^;]+);", open(HEADER).read(), re.M)
    return [(name, kind, float(value)) for kind, name, value in found]


def row(line):
    """The columns of hf_link_figures that links decide."""
    cell = [c.strip() for c in line.strip().strip("|").split("|")]
    pair = lambda text: [float(x) for x in text.split("/")]
    return {
        "model": cell[0], "pieces": int(cell[2]), "groups": int(cell[3]), "links": int(cell[4]), "light": int(cell[5]),
        "tree": float(cell[6]), "gap": pair(cell[8])[0], "worst": pair(cell[8])[1], "entries": float(cell[9]),
        "false": None if cell[14] == "-" else float(cell[14].rstrip("% ")),
        "itself": None if cell[15] == "-" else pair(cell[15])[1], "body": float(cell[16]), "hash": cell[17]}


def run(program, folder, models, setting):
    environment = dict(os.environ, **setting)
    files = [os.path.join(folder, m + ".glb") for m in models]
    out = subprocess.run([program, "--quick"] + files, env=environment, capture_output=True, text=True)
    if out.returncode != 0:
        return out.stderr.strip()
    return [row(line) for line in out.stdout.splitlines() if ".glb" in line]


def mean(values):
    values = [v for v in values if v is not None]
    return sum(values) / len(values) if values else 0.0


def line_of(name, rows):
    if isinstance(rows, str):
        return "| %s | %s |" % (name, rows)
    return "| %s | %d | %d | %.2f | %.3f / %.2f | %.2f | %.3f | %.1f | %.2f | %.3f |" % (
        name, sum(r["links"] for r in rows), sum(r["light"] for r in rows), max(r["tree"] for r in rows),
        mean(r["gap"] for r in rows), mean(r["worst"] for r in rows), max(r["worst"] for r in rows),
        mean(r["entries"] for r in rows), mean(r["false"] for r in rows), mean(r["itself"] for r in rows),
        max(r["body"] for r in rows))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--models", default=CHOOSING)
    parser.add_argument("--constants")
    parser.add_argument("--values", default="0.5,2", help="factors")
    parser.add_argument("--each", action="store_true")
    options = parser.parse_args()
    models = options.models.split(",")
    wanted = options.constants.split(",") if options.constants else None
    print("| constant | links | light | longest of the tree | gap 95 % / worst, mean | worst gap | entries | false % "
          "| on itself | body |\n|---|---|---|---|---|---|---|---|---|---|")
    base = run(options.program, options.folder, models, {})
    print(line_of("as chosen", base), flush=True)
    if isinstance(base, str):
        return 1
    for name, kind, value in constants():
        if wanted and name not in wanted:
            continue
        for factor in options.values.split(","):
            tried = value * float(factor)
            if kind != "double":
                tried = max(1, int(tried))
            rows = run(options.program, options.folder, models, {"HF_LINK_" + name: repr(tried)})
            same = rows == base
            print(line_of("%s %g%s" % (name, tried, " (all the same)" if same else ""), rows), flush=True)
            if options.each and not same and not isinstance(rows, str):
                for new, old in zip(rows, base):
                    if new != old:
                        print("|   " + new["model"] + " | " + " ".join(
                            "%s %s->%s" % (k, old[k], new[k]) for k in new if new[k] != old[k]) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
