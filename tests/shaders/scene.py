"""Frames of a posed body, with what a shader gets and what hf_deform writes: the oracle of the shaders."""

import hf
import numpy as np

FRAMES = 6
GRABBED = 3  # in this frame a handle is added in place, so that there are offsets


def body(count):
    """Returns positions and triangles of a closed body with five limbs and bumps."""
    rings = max(8, int(np.sqrt(count / 2)))
    around = max(8, count // rings)
    polar, turn = np.meshgrid(np.pi * (np.arange(rings) + 0.5) / rings, 2 * np.pi * np.arange(around) / around, indexing="ij")
    ways = np.stack([np.sin(polar) * np.cos(turn), np.cos(polar), np.sin(polar) * np.sin(turn)], -1).reshape(-1, 3)
    limbs = np.array([[1, 0.2, 0.1], [-0.9, 0.5, 0.2], [0.2, 1, -0.3], [0.5, -0.9, 0.3], [-0.6, -0.8, -0.2]])
    limbs /= np.linalg.norm(limbs, axis=1)[:, None]
    radius = 1 + sum(1.4 * np.exp(12 * (ways @ limb - 1)) for limb in limbs)
    radius = radius + 0.01 * np.sin(25 * ways[:, 0]) * np.sin(25 * ways[:, 1])
    points = np.concatenate([ways * radius[:, None], [[0, radius[:around].mean(), 0], [0, -radius[-around:].mean(), 0]]])
    ring, place = np.meshgrid(np.arange(rings - 1), np.arange(around), indexing="ij")
    a, b = ring * around + place, ring * around + (place + 1) % around
    sides = np.concatenate([np.stack([a, b, a + around], -1).reshape(-1, 3), np.stack([b, b + around, a + around], -1).reshape(-1, 3)])
    last, edge = (rings - 1) * around, np.arange(around)
    caps = [np.stack([np.full(around, rings * around), (edge + 1) % around, edge], -1),
            np.stack([np.full(around, rings * around + 1), last + edge, last + (edge + 1) % around], -1)]
    return points.astype(np.float32), np.concatenate([sides, *caps]).astype(np.uint32)


def obj(path):
    """Returns positions and triangles of an OBJ file."""
    lines = [line.split() for line in open(path) if line[:2] in ("v ", "f ")]
    points = np.array([line[1:4] for line in lines if line[0] == "v"], np.float32)
    faces = [[int(corner.split("/")[0]) - 1 for corner in line[1:]] for line in lines if line[0] == "f"]
    return points, np.array([[f[0], f[i], f[i + 1]] for f in faces for i in range(1, len(f) - 1)], np.uint32)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-30)


def along(v, normals):
    """Returns the directions of vectors in the tangent planes."""
    return unit(v - (v * normals).sum(1, keepdims=True) * normals)


class Scene:
    """A body, its rows for each set of handles, and frames: transforms and what they have to give."""

    def __init__(self, source, band_count=0):
        points, triangles = obj(source) if str(source).endswith(".obj") else body(int(source))
        points = points + np.float32(3) * np.ptp(points, axis=0)  # away from 0, as a level of a game
        surface = hf.Surface(points, triangles)
        self.bar = 5 if band_count else 0.5  # degrees in the mean; bands narrower than triangles bend the surface in them
        self.points, self.triangles, self.box = points, triangles, np.ptp(points, axis=0).max()
        pose = hf.Pose(surface, band_count=band_count)
        places = surface.propose_handles()[:6]
        handles = [pose.add_handle_at(place["position"], place["radius"]) for place in places]
        self.neighbour = np.full(len(points), -1)
        self.neighbour[triangles] = np.roll(triangles, 1, 1)
        loose = self.neighbour < 0
        self.neighbour[loose] = np.flatnonzero(loose)
        self.frames, self.sets = [], []
        self.record(pose, True)
        for frame in range(1, FRAMES):
            small = 0.003 if frame == GRABBED + 1 else 0  # the offsets fade: their share is between 0 and 1
            for i, handle in enumerate(handles[1:]) if frame != GRABBED else []:
                time = 0.7 * (GRABBED - 1 if small else frame)
                turn, axis = 0.9 * np.sin(time + i), np.eye(3)[i % 3]
                pose.set_transform(handle, rotation=[*(np.sin(turn / 2) * axis), np.cos(turn / 2)],
                                   translation=self.box * (small + 0.12 * np.sin(time + np.arange(3) + 2 * i)))
            if frame == GRABBED:
                middle = points[np.abs(points - points.mean(0)).sum(1).argmin()]
                pose.add_handles(points=[middle], radii=[0.05 * self.box], in_place=True)
            self.record(pose, frame == GRABBED)

    def record(self, pose, renew):
        normals = np.empty((len(self.points), 3))
        positions = pose.deform(dtype=np.float64, normals=normals)
        info = pose.blend_info
        if renew:
            rows = pose.blend_rows()
            self.sets.append({name: np.array(getattr(rows, name)) for name in
                              ("rows", "clusters", "weights", "gradients", "positions", "normals", "offsets")})
            made = self.sets[-1]
            n = made["normals"].astype(np.float64)
            made["tangents"] = along(self.points[self.neighbour].astype(np.float64) - self.points, n).astype(np.float32)
            made["cluster_count"] = info.cluster_count
        assert info.cluster_count == self.sets[-1]["cluster_count"]
        self.frames.append({"set": len(self.sets) - 1, "share": info.offset_share,
                            "transforms": np.array(pose.blend_transforms()).reshape(-1, 3, 4), "positions": positions - np.array(info.centre), "normals": normals,
                            "tangents": along(positions[self.neighbour] - positions, normals)})


def angles(a, b):
    """Returns degrees between directions; 180 where one is no direction."""
    ok = np.isfinite(a).all(1) & (np.abs(np.linalg.norm(a, axis=1) - 1) < 1e-3)
    return np.where(ok, np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(1))), 180)


def scenes(arguments):
    """Yields the scene of an OBJ file or of a count of vertices, and a small one with more clusters than a byte numbers."""
    for scene in (Scene(*(arguments or [50000])), Scene(5000, 64)):
        made = scene.sets[0]
        print(f"{len(scene.points)} vertices, {made['cluster_count']} clusters, {len(made['weights'])} entries", flush=True)
        yield scene


def draws(scene):
    """Returns what to draw: of each frame (set, frames of two characters, their frames before)."""
    found = []
    for k, frame in enumerate(scene.frames):
        before = k - 1 if k and scene.frames[k - 1]["set"] == frame["set"] else k
        other = before if scene.frames[before]["share"] == frame["share"] else k  # one share for all characters
        found.append((frame["set"], (k, other), (before, before if other == k else k)))
    return found


class Errors:
    """The largest error of positions as a share of the box, and degrees of normals and tangents, over frames."""

    def __init__(self, scene):
        self.scene, self.position, self.before = scene, 0, 0
        self.normal, self.tangent = [], []

    def add(self, now, before, posed):
        """posed: [characters][4][vertices][3], as the shaders write it. now, before: frames of the characters."""
        off = lambda a, b: np.abs(np.nan_to_num(a, nan=np.inf) - b).max() / self.scene.box
        for k, previous, arrays in zip(now, before, posed.astype(np.float64)):
            frame = self.scene.frames[k]
            self.position = max(self.position, off(arrays[0], frame["positions"]))
            self.before = max(self.before, off(arrays[3], self.scene.frames[previous]["positions"]))
            if frame["share"] == 0:  # normals leave offsets out, as hf/pose.h says
                self.normal.append(angles(arrays[1], frame["normals"]))
                self.tangent.append(angles(arrays[2], frame["tangents"]))

    def check(self, name):
        n, t = np.concatenate(self.normal), np.concatenate(self.tangent)
        print(f"{name}: positions {self.position:.1e}, before {self.before:.1e} of the box; normals {n.mean():.3f} mean, "
              f"{np.percentile(n, 99):.2f} 99 %, {n.max():.1f} worst; tangents {t.mean():.3f} mean, degrees")
        assert self.position < 1e-5 and self.before < 1e-5, "positions are off"
        assert n.mean() < self.scene.bar, "normals are off"
        assert t.mean() < 2 * self.scene.bar, "tangents are off"  # an edge of the mesh is no derivative
