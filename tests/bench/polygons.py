#!/usr/bin/env python3
"""Operators on faces of many corners beside triangulations: the figures of docs/studies/polygons.md.

    HF_LIBRARY=build/release/src/libhf.so PYTHONPATH=bindings/python python3 tests/bench/polygons.py [--quick]

Sheets over the unit square carry a field with given values on their border. The truth is the field of the same surface
sampled eight times as finely. The error is the root mean square over the inner vertices, over the range of the values.
"""

import sys
import time

import numpy as np

import hf

REFINED = 8


def jitter(u, v, amount, n):
    """Moves inner points by a hash of their place, the same on every machine."""
    inside = (u > 0) & (u < 1) & (v > 0) & (v < 1)
    i, j = np.round(u * n), np.round(v * n)
    a, b = np.sin(12.9898 * i + 78.233 * j) * 43758.5453, np.sin(39.346 * i + 11.135 * j) * 24634.6345
    return u + inside * amount / n * (a - np.floor(a) - 0.5), v + inside * amount / n * (b - np.floor(b) - 0.5)


SURFACES = {  # name: (map of the unit square into space, jitter of the coarse vertices)
    "flat squares": (lambda u, v: (u, v, 0 * u), 0),
    "flat, jittered": (lambda u, v: (u, v, 0 * u), 0.6),
    "flat, skewed": (lambda u, v: (u + 0.9 * v, v, 0 * u), 0),
    "flat, 6 times as long": (lambda u, v: (6 * u + 0.5 * v, v, 0 * u), 0),
    "bumps": (lambda u, v: (u, v, 0.15 * np.sin(7 * u) * np.cos(6 * v)), 0),
    "bumps, jittered": (lambda u, v: (u, v, 0.15 * np.sin(7 * u) * np.cos(6 * v)), 0.6),
    "bumps, 4 times as long": (lambda u, v: (4 * u, v, 0.15 * np.sin(7 * u) * np.cos(6 * v)), 0),
    "saddle": (lambda u, v: (u, v, 1.5 * (u - 0.5) * (v - 0.5)), 0),
    "saddle, jittered": (lambda u, v: (u, v, 1.5 * (u - 0.5) * (v - 0.5)), 0.6),
    "twisted strip": (lambda u, v: (4 * u, (v - 0.5) * np.cos(3 * u), (v - 0.5) * np.sin(3 * u)), 0),
    "sphere": (lambda u, v: (np.cos(1.8 * v - 0.9) * np.cos(3 * u), np.cos(1.8 * v - 0.9) * np.sin(3 * u),
                             np.sin(1.8 * v - 0.9)), 0),
    "torus": (lambda u, v: ((2 + np.cos(4 * v)) * np.cos(3 * u), (2 + np.cos(4 * v)) * np.sin(3 * u), np.sin(4 * v)), 0),
}


def border_values(u, v):
    return np.sin(3 * u + 1) * np.cosh(2 * v - 1) + u * v


def grid(n):
    v, u = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    return u.ravel(), v.ravel()


def quads(n):
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    return np.stack([a, a + 1, a + n + 2, a + n + 1], 1).astype(np.uint32)


def bricks(n):
    """Hexagons and, at the sides, pentagons and quads: (sizes, corners) over the same grid; n is even."""
    sizes, corners = [], []
    for j in range(n):
        for left in range(-(j % 2), n, 2):
            columns = [i for i in (left, left + 1, left + 2) if 0 <= i <= n]
            face = [j * (n + 1) + i for i in columns] + [(j + 1) * (n + 1) + i for i in reversed(columns)]
            sizes.append(len(face))
            corners += face
    return np.array(sizes, np.uint32), np.array(corners, np.uint32)


def cuts(q, first):
    return q[:, [0, 1, 2, 2, 3, 0] if first == 0 else [1, 2, 3, 3, 0, 1]].reshape(-1, 3)


def cotangent(p, a, b):
    x, y = a - p, b - p
    return (x * y).sum(1) / np.linalg.norm(np.cross(x, y), axis=1)


def rule_cut(q, xyz):
    """One cut of each quad: its Delaunay diagonal, of equal ones that at the lowest vertex."""
    p = [xyz[q[:, k]] for k in range(4)]
    first = cotangent(p[1], p[0], p[2]) + cotangent(p[3], p[2], p[0])
    other = cotangent(p[0], p[3], p[1]) + cotangent(p[2], p[1], p[3])
    lowest = q.argmin(1) % 2 == 0
    tie = np.abs(first - other) <= 1e-9 * (1 + np.abs(first) + np.abs(other))
    take = np.where(tie, lowest, first > other)
    return np.where(take[:, None], q[:, [0, 1, 2, 2, 3, 0]], q[:, [1, 2, 3, 3, 0, 1]]).reshape(-1, 3)


def fans(faces, shift):
    sizes, corners = faces
    out, at = [], 0
    for s in sizes:
        f = np.roll(corners[at:at + s], -(shift * int(s) // 2))
        out += [[f[0], f[k], f[k + 1]] for k in range(1, s - 1)]
        at += s
    return np.array(out, np.uint32)


def add_triangles(matrix, xyz, triangles, share):
    for k in range(3):
        i, j, apex = triangles[:, k], triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]
        weight = 0.5 * share * cotangent(xyz[apex], xyz[i], xyz[j])
        for row, column, sign in ((i, j, -1), (j, i, -1), (i, i, 1), (j, j, 1)):
            np.add.at(matrix, (row, column), sign * weight)


def polygon_matrix(xyz, faces):
    """The polygon Laplacian, as the paper writes it."""
    matrix = np.zeros((len(xyz), len(xyz)))
    for face in faces:
        p, n = xyz[face] - xyz[face].mean(0), len(face)
        sides, crosses = np.roll(p, -1, 0) - p, np.cross(p, np.roll(p, -1, 0))
        normal = (sides ** 2).sum() * np.eye(3) - sides.T @ sides
        point = np.linalg.lstsq(normal, np.cross(sides, crosses).sum(0), rcond=1e-10)[0]
        weights = 1 / n + p @ np.linalg.pinv(p.T @ p, rcond=1e-10, hermitian=True) @ point
        fan, local = np.array([[i, (i + 1) % n, n] for i in range(n)]), np.zeros((n + 1, n + 1))
        add_triangles(local, np.vstack([p, weights @ p]), fan, 1)
        spread = np.vstack([np.eye(n), weights])
        matrix[np.ix_(face, face)] += spread.T @ local @ spread
    return matrix


def solve(surface, sites, values):
    with hf.Solver(surface) as solver:
        solver.add_sites(sites, values)
        return solver.solve()


def truth(name, n):
    shape, _ = SURFACES[name]
    u, v = grid(n * REFINED)
    xyz = np.stack(shape(u, v), 1)
    edge = np.flatnonzero((u == 0) | (u == 1) | (v == 0) | (v == 1))
    return u, v, xyz, edge


def candidates(q, hexagons, xyz):
    kinds = hf.Operator
    if hexagons is None:
        a, b = cuts(q, 0), cuts(q, 1)
        return {"cut 1": dict(triangles=a), "cut 2": dict(triangles=b),
                "cut 1, cotangents": dict(triangles=a, operator_kind=kinds.COTANGENT),
                "cut 2, cotangents": dict(triangles=b, operator_kind=kinds.COTANGENT),
                "one cut by rule": dict(triangles=rule_cut(q, xyz)), "faces": dict(faces=q),
                "polygon Laplacian": dict(faces=q, operator_kind=kinds.COTANGENT)}
    faces = (None, *hexagons)
    return {"cut 1": dict(triangles=fans(hexagons, 0)), "cut 2": dict(triangles=fans(hexagons, 1)),
            "faces": dict(faces=faces), "polygon Laplacian": dict(faces=faces, operator_kind=kinds.COTANGENT)}


def sample(name, n, hexagonal=False):
    """A coarse sheet and the true field at its vertices: (u, v, xyz, border, inner, exact)."""
    shape, amount = SURFACES[name]
    u, v = grid(n)
    if hexagonal:  # every second corner moves, so that bricks become hexagons
        inside = (v > 0) & (v < 1)
        i, j = np.round(u * n).astype(int), np.round(v * n).astype(int)
        v = v + inside * np.where((i + j) % 2 == 0, 0.2, -0.2) / n
    u, v = jitter(u, v, amount, n)
    edge = np.flatnonzero((u == 0) | (u == 1) | (v == 0) | (v == 1))
    # the truth: a fine sheet whose lines pass through the coarse vertices
    fu, fv = grid(n * REFINED)
    cu, cv = u.reshape(n + 1, n + 1), v.reshape(n + 1, n + 1)
    x, y = fu * n, fv * n
    i, j = np.minimum(x.astype(int), n - 1), np.minimum(y.astype(int), n - 1)
    s, t = x - i, y - j
    bilinear = lambda c: ((1 - s) * (1 - t) * c[j, i] + s * (1 - t) * c[j, i + 1] + (1 - s) * t * c[j + 1, i]
                          + s * t * c[j + 1, i + 1])
    mu, mv = bilinear(cu), bilinear(cv)
    border = np.flatnonzero((fu == 0) | (fu == 1) | (fv == 0) | (fv == 1))
    with hf.Surface(np.stack(shape(mu, mv), 1), triangles=cuts(quads(n * REFINED), 0)) as surface:
        exact = solve(surface, border, border_values(mu[border], mv[border]))
    exact = exact.reshape(n * REFINED + 1, -1)[::REFINED, ::REFINED].ravel()
    return u, v, np.stack(shape(u, v), 1), edge, np.setdiff1d(np.arange(len(u)), edge), exact


def errors(name, n, hexagonal):
    """RMS errors by candidate, as shares of the range."""
    u, v, xyz, edge, inner, exact = sample(name, n, hexagonal)
    out = {}
    for label, mesh in candidates(quads(n), bricks(n) if hexagonal else None, xyz).items():
        with hf.Surface(xyz, **mesh) as surface:
            field = solve(surface, edge, border_values(u[edge], v[edge]))
        out[label] = np.sqrt(np.mean((field - exact)[inner] ** 2)) / np.ptp(exact)
    return out


def blends(name, n):
    """RMS errors of the mean of both cuts, moved towards the polygon Laplacian by a part; negative weights or not."""
    u, v, xyz, edge, inner, exact = sample(name, n)
    q, mean = quads(n), np.zeros((len(u), len(u)))
    add_triangles(mean, xyz, cuts(q, 0), 0.5), add_triangles(mean, xyz, cuts(q, 1), 0.5)
    polygon, out = polygon_matrix(xyz, q), {}
    for part in (0, 1 / 3, 1 / 2, 2 / 3, 5 / 6, 1):
        k = (1 - part) * mean + part * polygon
        field = np.linalg.solve(k[np.ix_(inner, inner)], -k[np.ix_(inner, edge)] @ border_values(u[edge], v[edge]))
        out[f"{part:.2f}"] = np.sqrt(np.mean((field - exact[inner]) ** 2)) / np.ptp(exact)
    return out


def overshoot(name, n, repeats):
    """Largest value outside the range of ten sites, over the range, by candidate."""
    shape, amount = SURFACES[name]
    u, v = jitter(*grid(n), amount, n)
    xyz = np.stack(shape(u, v), 1)
    out = {}
    for label, mesh in candidates(quads(n), None, xyz).items():
        worst = 0
        with hf.Surface(xyz, **mesh) as surface:
            for seed in range(repeats):
                random = np.random.default_rng(seed)
                field = solve(surface, random.choice(len(u), 10, replace=False), random.integers(0, 2, 10).astype(float))
                worst = max(worst, field.max() - 1, -field.min())
        out[label] = worst
    return out


def mirrored(name, n):
    """Largest difference between the field of a mesh and that of its mirror image, over the range."""
    shape, amount = SURFACES[name]
    u, v = jitter(*grid(n), amount, n)
    xyz = np.stack(shape(u, v), 1)
    q, flip = quads(n), np.array([-1.0, 1, 1])
    edge = np.flatnonzero((u == 0) | (u == 1))
    values = border_values(u[edge], v[edge])
    out = {}
    for label, kind in (("faces", hf.Operator.INTRINSIC_DELAUNAY), ("polygon Laplacian", hf.Operator.COTANGENT)):
        fields = []
        for points, faces in ((xyz, q), (xyz * flip, q[:, ::-1])):
            with hf.Surface(points, faces=np.ascontiguousarray(faces), operator_kind=kind) as surface:
                fields.append(solve(surface, edge, values))
        out[label] = np.abs(fields[0] - fields[1]).max() / np.ptp(values)
    return out


def costs(n):
    """Entries of the factor, times and weights of a torus of n x n quads."""
    a = np.arange(n) * 2 * np.pi / n
    v, u = (x.ravel() for x in np.meshgrid(a, a, indexing="ij"))
    xyz = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], 1)
    j, i = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    at = lambda i, j: (j % n) * n + i % n
    q = np.stack([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], 1).astype(np.uint32)
    rows = {}
    for label, mesh in candidates(q, None, xyz).items():
        if "cotangents" in label or label == "cut 2":
            continue
        times = []
        for _ in range(3):
            begin = time.process_time()
            with hf.Surface(xyz, **mesh) as surface:
                s = surface.statistics
                with hf.Solver(surface) as solver:
                    solver.add_sites([0, n * n // 2], [0.0, 1.0])
                    solver.solve()
                    create = 1e3 * (time.process_time() - begin)
                    begin = time.process_time()
                    for _ in range(5):
                        solver.solve()
                    sweep = 200 * (time.process_time() - begin)
            times.append((create, sweep, s.weld_ms, s.operator_ms, s.ordering_ms, s.numeric_ms))
        rows[label] = (s.factor_entries, *np.min(times, 0))
    return rows


def table(title, names, rows, form="{:.2e}"):
    labels = list(rows[0])
    print(f"\n{title}\n| | " + " | ".join(labels) + " |\n|---" * 1 + "|---" * len(labels) + "|")
    for name, row in zip(names, rows):
        print(f"| {name} | " + " | ".join(form.format(row[label]) for label in labels) + " |")


def main():
    quick = "--quick" in sys.argv
    n, names = (8 if quick else 24), list(SURFACES)
    rows = [errors(name, n, False) for name in names]
    table(f"RMS error, {n} x {n} quads", names, rows)
    table("RMS error, 8 x 8 quads: mean of both cuts moved towards the polygon Laplacian by", names,
          [blends(name, 8) for name in names])
    table(f"RMS error, hexagons over {n} x {n}", names, [errors(name, n, True) for name in names])
    table("overshoot beyond the sites, share of the range", names, [overshoot(m, n, 5 if quick else 50) for m in names])
    table("difference to the mirrored mesh", names, [mirrored(name, n) for name in names])
    size = 50 if quick else 400
    print(f"\n{size} x {size} torus: factor entries; least of 3, ms of the processor: first field, sweep; of the clock: weld, operator, ordering, numeric")
    for label, row in costs(size).items():
        print(f"| {label} | " + " | ".join(f"{x:,.1f}" for x in row) + " |")
    worse = [name for name, row in zip(names, rows) if row["faces"] > 1.000001 * min(row["cut 1"], row["cut 2"])]
    print("\nworse than the better triangulation:", worse or "none")


if __name__ == "__main__":
    main()
