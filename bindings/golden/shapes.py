"""The meshes of the golden scenes: points and triangles."""

import math

import numpy as np


def strip(nx=12, ny=4):
    points = [(x * 0.5, y * 0.5, 0.0) for y in range(ny + 1) for x in range(nx + 1)]
    inside = lambda x, y: 0 < x < nx and 0 < y < ny
    jitter = np.random.default_rng(3)
    points = [(px + 0.1 * jitter.uniform(-1, 1), py + 0.1 * jitter.uniform(-1, 1), 0.0) if inside(i % (nx + 1),
        i // (nx + 1)) else (px, py, 0.0)
              for i, (px, py, _) in enumerate(points)]
    quads = [(y * (nx + 1) + x, y * (nx + 1) + x + 1, (y + 1) * (nx + 1) + x + 1, (y + 1) * (nx + 1) + x)
        for y in range(ny) for x in range(nx)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def torus(nu=24, nv=12):
    points = []
    for i in range(nu):
        for j in range(nv):
            u, v = 2 * math.pi * i / nu, 2 * math.pi * j / nv
            r = 3 + math.cos(v)
            points.append((r * math.cos(u), r * math.sin(u), math.sin(v)))
    at = lambda i, j: (i % nu) * nv + j % nv
    return points, [t for i in range(nu) for j in range(nv) for t in
                    ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]


def bar(length, radius, rings, around):
    """A round bar along z with closed ends, uneven so that nothing is decided by ties that platforms break differently."""
    draw = np.random.default_rng(rings)
    turn = lambda j: 2 * math.pi * (j + draw.uniform(-0.2, 0.2)) / around
    uneven = lambda angle: (radius * draw.uniform(0.9, 1.1) * math.cos(angle), radius * draw.uniform(0.9, 1.1)
        * math.sin(angle))
    points = [(*uneven(turn(j)), length * i / (rings - 1)) for i in range(rings) for j in range(around)]
    at = lambda i, j: i * around + j % around
    triangles = [t for i in range(rings - 1) for j in range(around) for t in
                 ((at(i, j), at(i, j + 1), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i + 1, j)))]
    first, last = len(points), len(points) + 1
    points += [(0, 0, 0), (0, 0, length)]
    triangles += [t for j in range(around) for t in ((first, at(0, j + 1), at(0, j)),
        (last, at(rings - 1, j), at(rings - 1, j + 1)))]
    return points, triangles


def pair(n):
    """Two square plates of n x n vertices side by side, 0.01 apart."""
    points = [(x / (n - 1) + shift, y / (n - 1), 0.0) for shift in (0.0, 1.01) for y in range(n) for x in range(n)]
    triangles = []
    for base in (0, n * n):
        for y in range(n - 1):
            for x in range(n - 1):
                a = base + y * n + x
                triangles += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    return points, triangles
