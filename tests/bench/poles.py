"""How near irregular vertices are to where poles want them: poles.py MESH... [--count N] [--faces N] [--relax].

At N random places of each mesh, OBJ or OFF, quads are made with a pole of 3 and with one of 5. A row says how far the
nearest such vertex is from its place in edges of quads, without the pole and with it: the median, the 90 % quantile and
the share within one edge; how many irregular vertices come on top; and how far the pole's nearest edge is from the
direction that was given.
"""

import argparse
import pathlib

import numpy as np

import hf



def fans(faces):
    return np.array([(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)], np.uint32)


def read(path):
    rows = [words for words in (line.split("#")[0].split() for line in open(path, encoding="utf-8")) if words]
    if path.suffix == ".obj":
        points = [row[1:4] for row in rows if row[0] == "v"]
        faces = [[int(word.split("/")[0]) - 1 for word in row[1:]] for row in rows if row[0] == "f"]
    else:
        count, size = int(rows[1][0]), int(rows[1][1])
        points = [row[:3] for row in rows[2:2 + count]]
        faces = [[int(word) for word in row[1:1 + int(row[0])]] for row in rows[2 + count:2 + count + size]]
    return np.array(points, float), fans(faces)


class Seen:
    """A quad mesh and its irregular vertices."""

    def __init__(self, mesh):
        self.points, self.faces = mesh.positions, mesh.faces
        edges = np.sort(np.stack([self.faces, np.roll(self.faces, -1, 1)], -1).reshape(-1, 2), 1)
        edges, uses = np.unique(edges, axis=0, return_counts=True)
        self.valences = np.bincount(edges.ravel(), minlength=len(self.points))
        self.valences[edges[uses == 1]] = 4  # borders do not count
        self.irregular = np.count_nonzero(self.valences != 4)

    def nearest(self, place, count):
        found = np.flatnonzero(self.valences == count)
        away = np.linalg.norm(self.points[found] - place, axis=1)
        return (found[away.argmin()], away.min()) if len(found) else (None, np.inf)

    def off(self, vertex, normal, direction):
        """Degrees between a direction and the nearest edge of a vertex, seen along the normal."""
        around = self.faces[(self.faces == vertex).any(1)]
        ends = np.array([face[(list(face).index(vertex) + 1) % 4] for face in around])
        ways = np.vstack([self.points[ends] - self.points[vertex], direction])
        ways -= np.outer(ways @ normal, normal)
        ways /= np.linalg.norm(ways, axis=1)[:, None]
        return np.degrees(np.arccos(np.clip(ways[:-1] @ ways[-1], -1, 1).max()))


def measure(path, count, wanted, relax):
    points, triangles = read(path)
    options = {"face_count": wanted, **({} if relax else {"relax_count": hf.NO_INDEX})}
    quads = hf.Quads(hf.Surface(points, triangles), **options)
    plain = Seen(quads.mesh())
    a, b, c = points[triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    edge, random = np.sqrt(areas.sum() / 2 / wanted), np.random.default_rng(2)
    sides = np.median(np.linalg.norm(a - b, axis=1)) / edge
    picked = random.choice(len(triangles), count, p=areas / areas.sum())
    for quad_count in (3, 5):
        rows = []
        for triangle in picked:
            place, direction = random.dirichlet([1, 1, 1]) @ points[triangles[triangle]], random.normal(size=3)
            quads.update(pole_points=[place], pole_quads=[quad_count], pole_directions=[direction], **options)
            seen = Seen(quads.mesh())
            vertex, away = seen.nearest(place, quad_count)
            turn = np.nan if away > edge else seen.off(vertex, normals[triangle] / areas[triangle], direction)
            rows.append((plain.nearest(place, quad_count)[1] / edge, away / edge, seen.irregular - plain.irregular, turn))
        before, away, more, turn = np.array(rows).T
        print(f"| {path.stem} | {len(points)} | {sides:.2f} | {quad_count} | {np.median(before):.1f} | {np.median(away):.2f} | "
              f"{np.sort(away)[int(0.9 * len(away))]:.2f} | {100 * np.mean(away <= 1):.0f} % | {more.mean():+.1f} | {np.nanmedian(turn):.0f} |",
              flush=True)
        yield quad_count, np.mean(away <= 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=25)
    parser.add_argument("--faces", type=int, default=5000)
    parser.add_argument("--relax", action="store_true")
    given = parser.parse_args()
    print("| mesh | vertices | its edges / those of quads | pole | off without | off | 90 % | within 1 | irregular | degrees |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    found = [row for path in given.meshes for row in measure(path, given.count, given.faces, given.relax)]
    for quad_count in (3, 5):
        print(f"pole of {quad_count}: {100 * np.mean([share for k, share in found if k == quad_count]):.1f} % within an edge")


if __name__ == "__main__":
    main()
