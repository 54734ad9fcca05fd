#!/usr/bin/env python3
"""Measures how poses come back to rest, and how far they creep when a drag stops: pose_rest.py [--paper] [--iterations=N] [MESH ...]

MESH: .obj or .off. Without one: a generated plane and tube. Handles are discs of 0.05 of the box at two, three or five
places far from each other; the second one moves, out and back in 30 frames each. Needs the Python binding (HF_LIBRARY)."""
import sys

import numpy as np

import hf

FRAMES, CALLS = 30, 20


def read(path):
    """Positions and triangles of an .obj or .off file; polygons are cut into fans."""
    lines = [line.split() for line in open(path) if line.strip() and not line.startswith("#")]
    if path.endswith(".off"):
        count, faces = int(lines[1][0]), int(lines[1][1])
        points, corners = lines[2:2 + count], [[int(c) for c in l[1:1 + int(l[0])]] for l in lines[2 + count:][:faces]]
    else:
        points = [l[1:4] for l in lines if l[0] == "v"]
        corners = [[int(c.split("/")[0]) - 1 for c in l[1:]] for l in lines if l[0] == "f"]
    triangles = [(f[0], f[i], f[i + 1]) for f in corners for i in range(1, len(f) - 1)]
    return np.array([p[:3] for p in points], float), np.array(triangles)


def sheet(rows, columns, place):
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    positions = np.stack(place(i / (rows - 1), j / (columns - 1)), -1).reshape(-1, 3)
    a = (i[:-1, :-1] * columns + j[:-1, :-1]).ravel()
    b = a + columns
    return positions, np.concatenate([np.stack([a, b, b + 1], -1), np.stack([a, b + 1, a + 1], -1)])


def far_places(positions, count):
    places = [int(np.argmax(positions[:, 1]))]
    nearest = ((positions - positions[places[0]]) ** 2).sum(1)
    while len(places) < count:
        places.append(int(np.argmax(nearest)))
        nearest = np.minimum(nearest, ((positions - positions[places[-1]]) ** 2).sum(1))
    return places


def measure(surface, positions, mode, iterations, count):
    """Creep, distance from rest at once and after more calls: largest over the vertices, over the box."""
    box = np.linalg.norm(np.ptp(positions, axis=0))
    pose = hf.Pose(surface, mode=mode)
    discs = [np.where(np.linalg.norm(positions - positions[p], axis=1) < 0.05 * box)[0]
             for p in far_places(positions, count)]
    handles = pose.add_handles(discs)
    axis = np.array([1, 2, 0.5]) / np.linalg.norm([1, 2, 0.5])

    def frame(share):
        pose.set_transform(handles[1], rotation=np.r_[axis * np.sin(share / 2), np.cos(share / 2)],
                           translation=np.array([0.1, 0.25, -0.1]) * box * share)
        return pose.deform(dtype=np.float64, iteration_count=iterations).copy()

    def again(calls):
        for _ in range(calls):
            out = pose.deform(dtype=np.float64, iteration_count=iterations)
        return out.copy()

    far = lambda a, b: np.linalg.norm(a - b, axis=1).max() / box
    for i in range(1, FRAMES + 1):
        out = frame(i / FRAMES)
    creep = far(again(2 * CALLS), out)
    for i in range(FRAMES - 1, -1, -1):
        back = frame(i / FRAMES)
    return creep, far(back, positions), far(again(CALLS), positions)


def main():
    mode = hf.DeformMode.PAPER if "--paper" in sys.argv else hf.DeformMode.SMOOTH
    iterations = next((int(name[13:]) for name in sys.argv if name.startswith("--iterations=")), 0)
    files = [name for name in sys.argv[1:] if not name.startswith("-")]
    shapes = [(name, read(name)) for name in files] or [
        ("plane", sheet(80, 80, lambda u, v: (u * 2, v * 2, 0.05 * np.sin(9 * u) * np.cos(7 * v)))),
        ("tube", sheet(120, 48, lambda u, v: (u * 4, .4 * np.cos(2 * np.pi * v), .4 * np.sin(2 * np.pi * v))))]
    print("| shape | handles | creeps | off rest at once | after %d calls more |\n|---|---|---|---|---|" % CALLS)
    for name, (positions, triangles) in shapes:
        surface = hf.Surface(positions, triangles.astype(np.uint32))
        for count in (2, 3, 5):
            print("| %s | %d | %.1e | %.1e | %.1e |" % (name.split("/")[-1], count,
                                                       *measure(surface, positions, mode, iterations, count)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
