#!/usr/bin/env python3
"""Measures hf beside the libraries of Python's index: the first field, a site more, new values, memory, distances,
poses.

    peers.py [--quick] [--threads 1,2] [MESH ...]

`run` beside this file installs what it needs and calls it. Every peer works in a process of its own, on the same mesh
and, where it takes a matrix, on the same matrix: libigl's cotangents of the intrinsic Delaunay triangulation, which hf
makes by default. The matrix costs such a peer nothing; hf and libigl's own call make theirs within the first field.
Prints one table per mesh: medians in milliseconds, and the largest difference to hf's field."""
import argparse
import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

SITES = 10


# --- meshes -----------------------------------------------------------------------------------------------------------
def torus(rings, sides):
    """A jittered torus of rings x sides vertices, as hf_bench's."""
    random = np.random.default_rng(1)
    u = (np.arange(rings)[:, None] + random.uniform(-0.3, 0.3, (rings, sides))) * (2 * np.pi / rings)
    v = (np.arange(sides)[None, :] + random.uniform(-0.3, 0.3, (rings, sides))) * (2 * np.pi / sides)
    radius = 1 + 0.4 * np.cos(v)
    positions = np.stack([radius * np.cos(u), radius * np.sin(u), 0.4 * np.sin(v)], -1).reshape(-1, 3)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij"))
    at = lambda di, dj: (i + di) % rings * sides + (j + dj) % sides
    a, b, c, d = at(0, 0), at(1, 0), at(1, 1), at(0, 1)
    return positions, np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])


def creature(path):
    """The first triangles of a .glb whose buffer is inside: what hf_make_assets writes."""
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    document, start = json.loads(data[20:20 + length]), 28 + length
    part = document["meshes"][0]["primitives"][0]

    def read(index, width):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        kind = {5123: np.uint16, 5125: np.uint32, 5126: np.float32}[accessor["componentType"]]
        offset = start + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(data, kind, accessor["count"] * width, offset).reshape(-1, width)

    positions = read(part["attributes"]["POSITION"], 3).astype(np.float64)
    triangles = read(part["indices"], 1).astype(np.int64).reshape(-1, 3)
    positions, place = np.unique(positions, axis=0, return_inverse=True)  # seams are welded for all peers
    return positions, place.reshape(-1)[triangles]


def load(name):
    if name.startswith("torus"):
        rings = int(round((int(name[5:]) * 2.5) ** 0.5))
        return torus(rings, int(round(int(name[5:]) / rings)))
    if name.endswith(".glb"):
        return creature(name)
    import potpourri3d
    return potpourri3d.read_mesh(name)


# --- the questions: sites, values, a site more --------------------------------------------------------------------------
class Questions:
    def __init__(self, count, rounds):
        random = np.random.default_rng(7)
        order = random.permutation(count)
        self.sites, self.more = order[:SITES].astype(np.int64), order[SITES:SITES + rounds].astype(np.int64)
        self.values = random.uniform(0, 1, SITES)
        self.others = random.uniform(0, 1, (rounds, SITES))


def timed(action):
    begin = time.perf_counter()
    result = action()
    return (time.perf_counter() - begin) * 1e3, result


def high_water():
    """The most memory that this process has held, in MB."""
    for line in open("/proc/self/status"):
        if line.startswith("VmHWM"):
            return int(line.split()[1]) / 1024
    return 0.0


def measure(make, field, add, remove, ask):
    """The figures of one peer. make() gives the first field; field(values) one with new values; add(vertex) a site more
    and its field; remove(vertex) takes it away, untimed."""
    held = high_water()
    first, start = timed(make)
    memory = high_water() - held
    fields = [timed(lambda: field(values))[0] for values in ask.others]
    field(ask.values)
    changes = []
    for vertex in ask.more:
        changes.append(timed(lambda: add(vertex))[0])
        remove(vertex)
    return {"first": first, "field": statistics.median(fields), "change": statistics.median(changes), "memory": memory,
            "start": start}


# --- hf ---------------------------------------------------------------------------------------------------------------
def run_hf(positions, triangles, ask, threads):
    import hf
    state = {}

    def make():
        surface = hf.Surface(positions, triangles.astype(np.uint32), thread_count=threads)
        state["solver"] = hf.Solver(surface)
        state["ids"] = state["solver"].add_sites(ask.sites, ask.values)
        return state["solver"].solve(dtype=np.float64)

    def field(values):
        state["solver"].set_values(state["ids"], values)
        return state["solver"].solve(dtype=np.float64)

    def add(vertex):
        state["extra"] = state["solver"].add_site(int(vertex), 0.5)
        return state["solver"].solve(dtype=np.float64)

    return measure(make, field, add, lambda vertex: state["solver"].remove_sites([state["extra"]]), ask)


# --- peers that take a matrix -----------------------------------------------------------------------------------------
def laplacian(positions, triangles):
    import igl
    lengths = igl.edge_lengths(positions, triangles)
    flat_lengths, flat = igl.intrinsic_delaunay_triangulation(lengths, triangles)[:2]
    return (-igl.cotmatrix_intrinsic(flat_lengths, flat)).tocsr().astype(np.float64)


class FixedRows:
    """The system with sites as rows of the identity: positive definite, and the pattern never changes."""

    def __init__(self, matrix):
        self.full = matrix
        self.row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))

    def system(self, sites):
        fixed = np.zeros(self.full.shape[0], bool)
        fixed[sites] = True
        out = self.full.copy()
        out.data[fixed[self.row] | fixed[out.indices]] = 0
        out.data[(self.row == out.indices) & fixed[self.row]] = 1
        return out

    def right(self, sites, values):
        spread = np.zeros(self.full.shape[0])
        spread[sites] = values
        out = -(self.full @ spread)
        out[sites] = values
        return out


def run_matrix(positions, triangles, ask, factorise, refactorise, solve):
    """factorise(system) for the first time, refactorise(system) when numbers have changed and the pattern has not."""
    rows = FixedRows(laplacian(positions, triangles))
    state = {"sites": ask.sites, "values": ask.values}
    first, right = rows.system(ask.sites), rows.right(ask.sites, ask.values)
    systems = {v: rows.system(np.append(ask.sites, v)) for v in ask.more[:3]}  # prepared, so that only peers are timed

    def make():
        state["factor"] = factorise(first)
        return solve(state["factor"], right)

    def add(vertex):
        state["factor"] = refactorise(state["factor"], systems[vertex])
        return solve(state["factor"], rights[vertex])

    rights = {v: rows.right(np.append(ask.sites, v), np.append(ask.values, 0.5)) for v in systems}
    right_of = [rows.right(ask.sites, values) for values in ask.others]
    place = iter(right_of)
    ask.more = ask.more[:3]
    return measure(make, lambda values: solve(state["factor"], next(place, right)), add, lambda vertex: None, ask)


def run_pardiso(positions, triangles, ask, threads):
    import pypardiso
    import scipy.sparse
    solver = pypardiso.PyPardisoSolver(mtype=2)  # symmetric positive definite: the upper triangle

    def factorise(system, phase=12):
        upper = scipy.sparse.triu(system, format="csr")
        solver.set_phase(phase)
        solver._call_pardiso(upper, np.zeros(system.shape[0]))
        return upper

    def solve(upper, right):
        solver.set_phase(33)
        return solver._call_pardiso(upper, right)

    return run_matrix(positions, triangles, ask, factorise, lambda factor, system: factorise(system, 22), solve)


def run_cholespy(positions, triangles, ask, threads):
    import cholespy

    def factorise(system):
        columns = system.tocsc()
        return cholespy.CholeskySolverD(system.shape[0], columns.indptr, columns.indices, columns.data,
                                        cholespy.MatrixType.CSC)

    def solve(factor, right):
        out = np.zeros_like(right)
        factor.solve(right, out)
        return out

    return run_matrix(positions, triangles, ask, factorise, lambda factor, system: factorise(system), solve)


# --- peers that take a mesh -------------------------------------------------------------------------------------------
def run_igl(positions, triangles, ask, threads):
    import igl
    import scipy.sparse
    state = {}
    empty = scipy.sparse.csc_matrix((0, len(positions)))
    zero = np.zeros((len(positions), 1))

    def factorise(sites):
        data = igl.min_quad_with_fixed_data()
        igl.min_quad_with_fixed_precompute(state["matrix"], sites, empty, True, data)
        return data

    def solve(data, values):
        return np.asarray(igl.min_quad_with_fixed_solve(data, zero, values[:, None], np.zeros((0, 1)))).reshape(-1)

    def make():
        state["matrix"] = laplacian(positions, triangles).tocsc()
        state["data"] = factorise(ask.sites)
        return solve(state["data"], ask.values)

    def add(vertex):
        return solve(factorise(np.append(ask.sites, vertex)), np.append(ask.values, 0.5))

    ask.more = ask.more[:3]
    return measure(make, lambda values: solve(state["data"], values), add, lambda vertex: None, ask)


PEERS = {"hf": run_hf, "MKL Pardiso": run_pardiso, "cholespy (CHOLMOD)": run_cholespy, "libigl": run_igl}


# --- distances --------------------------------------------------------------------------------------------------------
def distances(positions, triangles, threads):
    """First call and later calls, in milliseconds, of hf and geometry-central; error against libigl's exact distances."""
    import hf
    import igl
    import potpourri3d
    source = int(np.argmax(positions[:, 0]))
    surface = hf.Surface(positions, triangles.astype(np.uint32), thread_count=threads)
    begin = time.perf_counter()
    ours = hf.Geodesics(surface)
    ours.solve([source])
    first = (time.perf_counter() - begin) * 1e3
    later, hf_field = timed(lambda: ours.solve([source], dtype=np.float64))
    begin = time.perf_counter()
    theirs = potpourri3d.MeshHeatMethodDistanceSolver(positions, triangles)
    theirs.compute_distance(source)
    their_first = (time.perf_counter() - begin) * 1e3
    their_later, their_field = timed(lambda: theirs.compute_distance(source))
    out = {"hf": [first, later], "geometry-central": [their_first, their_later]}
    if len(positions) <= 60000:
        one = lambda value: np.array([value], np.int64)
        none = np.zeros(0, np.int64)
        exact = np.asarray(igl.exact_geodesic(positions, triangles, one(source), none,
                                              np.arange(len(positions)), none)).reshape(-1)
        for name, field in (("hf", hf_field), ("geometry-central", their_field)):
            error = np.abs(np.asarray(field).reshape(-1) - exact) / exact.max()
            out[name] += [error.mean() * 100, error.max() * 100]
    return out


# --- poses ------------------------------------------------------------------------------------------------------------
def poses(positions, triangles, threads):
    """The first pose, a frame, a handle more with its frame, in milliseconds, of hf and MeshLib. Handles are discs of 50
    vertices. MeshLib solves one bi-harmonic system; hf also turns clusters, in its default mode."""
    import hf
    from meshlib import mrmeshnumpy, mrmeshpy
    count, rounds = len(positions), 5
    near = lambda centre: np.argsort(((positions - positions[centre]) ** 2).sum(1))[:min(50, count // 60)]
    centres = [0, count // 3, count // 2]
    handles, more = [near(c) for c in centres], [near(count * (2 * i + 1) // 12) for i in range(rounds)]
    moves = [0.1 * (i + 1) * np.ptp(positions[:, 2]) for i in range(rounds)]
    state = {}

    def first():
        state["pose"] = hf.Pose(hf.Surface(positions, triangles.astype(np.uint32), thread_count=threads))
        state["ids"] = state["pose"].add_handles(handles)
        state["pose"].deform()

    def frame(move):
        state["pose"].set_transform(state["ids"][1], translation=[0, 0, move])
        state["pose"].deform()

    def handle(vertices):
        state["pose"].add_handles([vertices])
        state["pose"].deform()

    out = {"hf": [timed(first)[0], statistics.median(timed(lambda: frame(m))[0] for m in moves),
                  statistics.median(timed(lambda: handle(v))[0] for v in more)]}

    mesh = mrmeshnumpy.meshFromFacesVerts(triangles.astype(np.int32), positions.astype(np.float32))
    free = mrmeshpy.VertBitSet()
    free.resize(count, True)
    for vertices in handles:
        for v in vertices:
            free.set(mrmeshpy.VertId(int(v)), False)
    system = mrmeshpy.Laplacian(mesh)

    def begin():
        system.init(free, mrmeshpy.EdgeWeights.Cotan)
        system.apply()

    def place(vertices, move):
        for v in vertices:
            x, y, z = (float(c) for c in positions[v])
            system.fixVertex(mrmeshpy.VertId(int(v)), mrmeshpy.Vector3f(x, y, z + move))

    def their_frame(move):
        place(handles[1], move)
        return timed(system.apply)[0]

    def their_handle(vertices):
        place(vertices, 0)
        return timed(system.apply)[0]

    out["MeshLib"] = [timed(begin)[0], statistics.median(their_frame(m) for m in moves),
                      statistics.median(their_handle(v) for v in more)]
    return out


EXTRA = {"distances": distances, "poses": poses}


# --- the run ----------------------------------------------------------------------------------------------------------
def child(options):
    positions, triangles = load(options.meshes[0])
    positions, triangles = np.ascontiguousarray(positions, np.float64), np.ascontiguousarray(triangles, np.int64)
    warm = torus(30, 12)
    warm = (warm[0], warm[1].astype(np.int64))  # libraries load and start their threads before anything is timed
    if options.child in EXTRA:
        EXTRA[options.child](*warm, options.thread)
        print(json.dumps(EXTRA[options.child](positions, triangles, options.thread)))
        return
    PEERS[options.child](*warm, Questions(len(warm[0]), 20), options.thread)
    result = PEERS[options.child](positions, triangles, Questions(len(positions), 20), options.thread)
    np.save(options.out, np.asarray(result.pop("start")).reshape(-1))
    result["vertices"] = len(positions)
    print(json.dumps(result))


def call(name, mesh, threads, out):
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), MKL_NUM_THREADS=str(threads))
    done = subprocess.run([sys.executable, __file__, "--child", name, "--thread", str(threads), "--out", out, mesh],
                          env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        return (done.stderr.strip().splitlines() or ["no answer"])[-1]
    return json.loads(done.stdout.splitlines()[-1])


COLUMNS = {"distances": ["first, ms", "later, ms", "mean error, %", "largest error, %"],
           "poses": ["first pose, ms", "a frame, ms", "a handle more and its frame, ms"]}


def print_extra(title, rows):
    if isinstance(rows, str):
        print("\n%s: %s" % (title, rows))
        return
    print("\n| %s |\n|%s" % (" | ".join([title] + COLUMNS[title]), "---|" * (1 + len(COLUMNS[title]))))
    for name, row in rows.items():
        cells = ["%.2f" % x for x in row] + ["-"] * (len(COLUMNS[title]) - len(row))
        print("| %s | %s |" % (name, " | ".join(cells)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="small meshes: shows that it runs, says nothing of speed")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--child", help=argparse.SUPPRESS)
    parser.add_argument("--thread", type=int, default=1, help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    parser.add_argument("meshes", nargs="*", help="torusN, or a file: .glb of hf_make_assets, .obj, .ply, .off")
    options = parser.parse_args()
    if options.child:
        return child(options)
    for mesh in options.meshes or (["torus3000"] if options.quick else ["torus42000", "torus304000"]):
        for threads in (int(t) for t in options.threads.split(",")):
            lines, reference = [], None
            for name in PEERS:
                with tempfile.TemporaryDirectory() as folder:
                    out = os.path.join(folder, "field.npy")
                    row = call(name, mesh, threads, out)
                    if isinstance(row, str):
                        lines.append("| %s | %s | | | | |" % (name, row))
                        continue
                    field = np.load(out)
                if reference is None:
                    reference, count = field, row["vertices"]
                lines.append("| %s | %.1f | %.2f | %.2f | %.0f | %.1e |" % (
                    name, row["first"], row["change"], row["field"], row["memory"], np.abs(field - reference).max()))
            print("\n**%s, %d vertices, %d thread%s**\n" % (os.path.basename(mesh), count, threads, "s" * (threads > 1)))
            print("| | first field, ms | a site more and its field, ms | new values, ms | memory, MB | difference |")
            print("|---|---|---|---|---|---|\n" + "\n".join(lines), flush=True)
            for title in EXTRA:
                print_extra(title, call(title, mesh, threads, ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
