"""Runs the programs of samples on models and on changed copies of them (gltf_copy.py): the results must be the same.

usage: programs.py BIN_FOLDER WORK_FOLDER [--full] [--page FILE]

Prints the largest difference of every change and program. With --full (or HF_FULL_TESTS in the environment) also models
of ../shared/data/gltf, where they are. --page appends the table to docs/invariance.md. Exit code 1: a difference above
its tolerance.
"""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys

import gltf_copy

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
INFINITY = float("inf")


class Refused(Exception):
    pass


def run(*words):
    done = subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
    if done.returncode != 0:
        raise Refused(done.stderr.decode("utf-8", "replace").strip().splitlines()[-1])
    return done.stdout.decode("utf-8", "replace")


def read_ply(file):
    """Positions of a binary .ply as hf writes it: doubles first."""
    data = open(file, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    count = int(re.search(r"element vertex (\d+)", header).group(1))
    kinds = re.findall(r"property (\w+) ", header.split("element face")[0])
    size = sum({"double": 8, "float": 4, "uchar": 1}[k] for k in kinds)
    return [struct.unpack_from("<3d", data, end + i * size) for i in range(count)]


def read_obj(file):
    with open(file) as lines:
        return [tuple(float(x) for x in line.split()[1:4]) for line in lines if line.startswith("v ")]


def in_body(copy, points):
    """Places of the copy's vertices in the frame of the model, in the model's order."""
    if len(points) < len(copy.vertex):
        raise Refused("wrote %d vertices" % len(points))
    return [tuple((x - s) / copy.scale for x, s in zip(points[v], copy.shift)) for v in copy.vertex]


class Rig:
    """Skin weights by the names of their joints, a dictionary for each vertex."""

    def __init__(self, model, names):
        self.rows = []
        j = model.json
        for node in model.mesh_nodes():
            for primitive in j["meshes"][j["nodes"][node]["mesh"]]["primitives"]:
                a = primitive["attributes"]
                if "JOINTS_0" not in a:
                    self.rows += [{}] * j["accessors"][a["POSITION"]]["count"]
                    continue
                joints = [j["nodes"][n].get("name", "node %d" % n)
                          for n in j["skins"][j["nodes"][node]["skin"]]["joints"]]
                for numbers, weights in zip(model.rows(a["JOINTS_0"]), model.rows(a["WEIGHTS_0"])):
                    row = {}
                    for n, w in zip(numbers, weights):
                        if w > 0:
                            row[names.get(joints[n], joints[n])] = row.get(names.get(joints[n], joints[n]), 0) + w
                    self.rows.append(row)


# ---- the programs: each gives lists of numbers of the model's vertices, in the model's frame and in boxes ----

class Run:
    """One model, or one changed copy, in a folder of its own."""

    def __init__(self, bins, folder, model_file, copy, other_file):
        self.bins, self.folder, self.copy, self.other = bins, folder, copy, other_file
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        self.file = os.path.join(folder, "model.glb")
        copy.model.write(self.file)
        self.original = gltf_copy.Model(model_file)

    def program(self, name):
        return os.path.join(self.bins, name)

    def path(self, name):
        return os.path.join(self.folder, name)


def field(r):
    step = len(r.copy.vertex) // 7
    sites = []
    for i, value in enumerate((0, 1, 0.3, 0.6)):
        sites += ["--site", "%d=%g" % (r.copy.vertex[(i + 1) * step], value)]
    run(r.program("hf_field"), r.file, *sites, "--out", r.path("field.txt"))
    rows = [float(line.split()[-1]) for line in open(r.path("field.txt")) if not line.startswith("#")]
    return [(rows[v],) for v in r.copy.vertex]


def played(r, name):
    """A script of samples with all its steps in fewer frames, which take a third of the time."""
    steps = json.load(open(os.path.join(ROOT, "samples/deform/scripts", name)))
    steps["fps"] = 10
    json.dump(steps, open(r.path(name), "w"))
    return r.path(name)


def script(r):
    run(r.program("hf_deform_script"), r.file, "--script", played(r, "horse.json"), "--frames-obj",
        r.path("frames"), "--keys", 1, "--quiet")
    frames = sorted(os.listdir(r.path("frames")))
    return [p for f in frames[-2:] for p in in_body(r.copy, read_obj(os.path.join(r.path("frames"), f)))]


def propose(r):
    out = run(r.program("hf_deform_script"), r.file, "--propose", "--frames-obj", r.path("proposed"), "--keys", 1,
              "--quiet")
    kinds = [(float(len(re.findall(r"(?m)^  %s \d" % kind, out))),) for kind in ("foot", "tip", "joint", "middle")]
    frames = sorted(os.listdir(r.path("proposed")))
    return kinds + in_body(r.copy, read_obj(os.path.join(r.path("proposed"), frames[len(frames) // 2])))


def rig(r):
    run(r.program("hf_rig"), r.file, "--handles", played(r, "horse_rig.json"), "-o", r.path("rig.glb"),
        "--json", r.path("rig.json"), "--quiet")
    made = json.load(open(r.path("rig.json")))
    width = made["weights_per_vertex"]
    # clusters have numbers, which may change; handles have names, and so have weights
    handles = [h["joint"] for h in made["handles"]]
    out = []
    for v in r.copy.vertex:
        row = dict.fromkeys(handles, 0.0)
        for k in range(v * width, v * width + width):
            if made["vertex_joints"][k] in row:
                row[made["vertex_joints"][k]] += made["vertex_weights"][k]
        out.append(tuple(row[h] for h in handles))
    return out


def weights(r):
    run(r.program("hf_weights"), r.file, "-o", r.path("weights.glb"))
    made = Rig(gltf_copy.Model(r.path("weights.glb")), r.copy.joint)
    return [made.rows[v] for v in r.copy.vertex]


def detail(r):
    curve = json.load(open(os.path.join(ROOT, "samples/detail/curves/horse_head.json")))
    for point in curve["points"]:
        point["near"] = [r.copy.scale * x + s for x, s in zip(point["near"], r.copy.shift)]
    json.dump(curve, open(r.path("curve.json"), "w"))
    run(r.program("hf_detail"), r.file, "--curve", r.path("curve.json"), "-o", r.path("detail.ply"))
    return in_body(r.copy, read_ply(r.path("detail.ply")))


def quads(r):
    run(r.program("hf_quads"), r.file, "--edge", "5%", "-o", r.path("quads.obj"))
    count = sum(line.startswith("f ") for line in open(r.path("quads.obj")))
    points = read_obj(r.path("quads.obj"))
    low, high = ([f(c) for c in zip(*points)] for f in (min, max))
    box = [tuple((x - s) / r.copy.scale for x, s in zip(p, r.copy.shift)) for p in (low, high)]
    return [(math.log(count),)] + box


def transfer(source, target, folder, r):
    run(r.program("hf_transfer"), source, target, "--as", "frames", "--fps", 2, "--out-poses", folder, "--quiet")
    return [read_ply(os.path.join(folder, f)) for f in sorted(os.listdir(folder))]


def transfer_from(r):
    return [p for frame in transfer(r.file, r.other, r.path("from"), r) for p in frame]


def transfer_to(r):
    return [p for frame in transfer(r.other, r.file, r.path("to"), r) for p in in_body(r.copy, frame)]


# name, function, tolerance in boxes (or shares of a weight), where: "horse" has the script's places, "full" is the long form's
PROGRAMS = [
    ("hf_field", field, 1e-9, ""),
    ("hf_deform_script", script, 1e-6, "horse"),
    ("hf_deform_script --propose", propose, 1e-6, ""),
    ("hf_rig", rig, 1e-6, "horse"),
    ("hf_weights", weights, 1e-5, ""),
    ("hf_detail", detail, 1e-6, "horse"),
    ("hf_quads", quads, 0.5, "full"),
    ("hf_transfer from", transfer_from, 1e-6, ""),
    ("hf_transfer to", transfer_to, 1e-6, "full"),  # invariance_nouns has it
]

# (change, program, tolerance, reason); None: all. The first that fits a cell counts. "until ROW: ..." is a fault that is
# being mended; the entry goes with its row.
EXCEPTIONS = [
    ("vertex order", "hf_field", 0.1, "where pieces touch at places of one distance, rounding chooses the links"),
    ("face order", "hf_field", 0.1, "where pieces touch at places of one distance, rounding chooses the links"),
    ("node order", "hf_field", 0.1, "meshes come in another order, and so do their vertices"),
    ("node order", "hf_transfer from", 1e-2, "meshes come in another order, and so do their vertices"),
    ("node order", "hf_transfer to", 1e-2, "meshes come in another order, and so do their vertices"),
    ("moved parent", "hf_transfer to", 1e-3, "where pieces touch at places of one distance, rounding chooses the links"),
    ("unit 0.01", "hf_field", 0.1, "where pieces touch at places of one distance, rounding chooses the links"),
    ("unit 0.01", "hf_transfer from", 1e-2, "where pieces touch at places of one distance, rounding chooses the links"),
    ("unit 0.01", "hf_transfer to", 1e-2, "where pieces touch at places of one distance, rounding chooses the links"),
    ("unit 100", "hf_field", 0.1, "where pieces touch at places of one distance, rounding chooses the links"),
    ("unit 100", "hf_transfer from", 1e-2, "where pieces touch at places of one distance, rounding chooses the links"),
    ("unit 100", "hf_transfer to", 1e-2, "where pieces touch at places of one distance, rounding chooses the links"),
    ("moved parent", "hf_field", 0.1, "where pieces touch at places of one distance, rounding chooses the links"),
    ("face order", "hf_transfer to", 1e-3, "where pieces touch at places of one distance, rounding chooses the links"),
    ("joint order", "hf_weights", INFINITY, "of bones at one place, the first has the weights"),
    ("vertex order", "hf_deform_script", 3e-2, "groups of one rotation begin at the first vertex"),
    ("vertex order", "hf_deform_script --propose", 3e-2, "groups of one rotation begin at the first vertex"),
    ("vertex order", "hf_transfer from", 1e-2, "clusters begin at the first vertex"),
    ("vertex order", "hf_transfer to", 1e-2, "clusters begin at the first vertex"),
    ("renamed joints", "hf_transfer from", INFINITY, "names of joints say which parts correspond"),
    ("renamed joints", "hf_transfer to", INFINITY, "names of joints say which parts correspond"),
    ("renamed joints", "hf_deform_script --propose", INFINITY, "names of joints say which joint is a head that is pulled"),
    ("renamed joints", "hf_weights", INFINITY, "names of nodes say where last joints end"),
]


def exception_of(change, program):
    for c, p, tolerance, reason in EXCEPTIONS:
        if (c is None or c == change) and (p is None or p == program):
            return tolerance, reason
    return None


def difference(a, b, size):
    """The largest difference of two results; INFINITY where they have other lengths."""
    if len(a) != len(b):
        return INFINITY
    worst = 0.0
    for x, y in zip(a, b):
        if isinstance(x, dict):
            worst = max([worst] + [abs(x.get(k, 0) - y.get(k, 0)) for k in set(x) | set(y)])
        else:
            worst = max([worst] + [abs(p - q) / (size if len(x) == 3 else 1.0) for p, q in zip(x, y)])
    return worst


def diagonal(bins, work, file):
    """Of the box at rest, in the frame of the scene."""
    folder = os.path.join(work, "rest", os.path.basename(file))
    shutil.rmtree(folder, ignore_errors=True)
    run(os.path.join(bins, "hf_deform_script"), file, "--propose", "--frames-obj", folder, "--keys", 1, "--quiet")
    points = read_obj(os.path.join(folder, sorted(os.listdir(folder))[0]))
    return math.dist([min(c) for c in zip(*points)], [max(c) for c in zip(*points)])


def outcome(program, r):
    try:
        return program[1](r), None
    except Refused as refused:
        return None, str(refused)


def check(bins, work, name, model_file, other_file, cells, full):
    model = gltf_copy.Model(model_file)
    size, other_size = diagonal(bins, work, model_file), diagonal(bins, work, other_file)
    plain = Run(bins, os.path.join(work, name, "plain"), model_file, gltf_copy.Copy(model), other_file)
    programs = [p for p in PROGRAMS if p[3] == "" or (name == "horse" if p[3] == "horse" else full)]
    base = [outcome(p, plain) for p in programs]
    for change, _, make in gltf_copy.CHANGES:
        r = Run(bins, os.path.join(work, name, change.replace(" ", "_")), model_file, make(model), other_file)
        results = [outcome(p, r) for p in programs]
        for program, (expected, unfit), (found, refused) in zip(programs, base, results):
            if unfit:
                continue
            here = INFINITY if refused else difference(
                expected, found, other_size if program[1] == transfer_from else size)
            cell = cells.setdefault((change, program[0]), [-1.0, ""])
            if "--all" in sys.argv:
                print("%s, %s, %s: %.2g %s" % (name, change, program[0], here, refused or ""), flush=True)
            if here > cell[0]:
                cell[:] = [here, name + (": " + refused if refused else "")]


def text_of(value):
    return "0" if value == 0 else "other" if value == INFINITY else re.sub("e-0", "e-", "%.0e" % value)


def judge(cells):
    missed = 0
    for change, _, _ in gltf_copy.CHANGES:
        for program, _, tolerance, _ in PROGRAMS:
            if (change, program) not in cells:
                continue
            value, where = cells[change, program]
            excuse = exception_of(change, program)
            bound = excuse[0] if excuse else tolerance
            if value > bound:
                missed += 1
                print("MISSED %s, %s: %.2g > %.2g at %s" % (change, program, value, bound, where))
    print("invariance_program_cells %d >=100" % len(cells))
    print("invariance_program_cells_missed %d <=0" % missed)
    return missed == 0 and len(cells) >= 100


def write_page(file, cells):
    with open(file, "a") as out:
        out.write("\n## Programs\n\n`tests/invariance/programs.py` gives the programs models and changed copies of them. d: it differs by "
                  "design.\n\n| | " + " | ".join(c for c, _, _ in gltf_copy.CHANGES) + " |\n")
        out.write("|---" * (len(gltf_copy.CHANGES) + 1) + "|\n")
        for program, _, tolerance, _ in PROGRAMS:
            row = []
            for change, _, _ in gltf_copy.CHANGES:
                value = cells.get((change, program), [None])[0]
                excuse = exception_of(change, program)
                mark = ""
                if value is not None and excuse and value > tolerance:
                    mark = " " + (excuse[1].split(":")[0].replace("until ", "") if excuse[1].startswith("until ") else "d")
                row.append("" if value is None else text_of(value) + mark)
            out.write("| %s | %s |\n" % (program, " | ".join(row)))
        out.write("\n| change | what it is |\n|---|---|\n")
        for change, what, _ in gltf_copy.CHANGES:
            out.write("| %s | %s |\n" % (change, what))
        out.write("\n| change | program | at most | reason |\n|---|---|---|---|\n")
        for change, program, tolerance, reason in EXCEPTIONS:
            out.write("| %s | %s | %s | %s |\n" % (change or "every change", program or "every program",
                                                 "any" if tolerance == INFINITY else "%g" % tolerance, reason))


def main(words):
    full = "--full" in words or "HF_FULL_TESTS" in os.environ
    bins, work = words[0], words[1]
    os.makedirs(work, exist_ok=True)
    run(os.path.join(bins, "hf_make_assets"), work, "--vertices", 600, "--creature", "horse", "--creature", "bull")
    horse, bull = (os.path.join(work, n + ".glb") for n in ("horse", "bull"))
    cells = {}
    check(bins, work, "horse", horse, bull, cells, full)
    if full:
        shared = os.path.join(ROOT, "..", "shared", "data", "gltf")
        for name in ("khr_Fox", "q_Cow", "q_Trex", "CesiumMan", "RobotExpressive"):
            file = os.path.join(shared, name + ".glb")
            if os.path.exists(file):
                check(bins, work, name, file, horse, cells, full)
            else:
                print("skipped: %s is not here" % file)
    if "--page" in words:
        write_page(words[words.index("--page") + 1], cells)
    return 0 if judge(cells) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
