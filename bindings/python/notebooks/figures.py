"""A small body of voxels with a skeleton, and pictures of meshes: what the notebooks share."""

import numpy as np

NAMES = ["hips", "spine", "head", "left_upper_arm", "left_lower_arm", "left_hand", "right_upper_arm", "right_lower_arm",
    "right_hand", "left_thigh", "left_shin", "left_foot", "right_thigh", "right_shin", "right_foot"]
PARENTS = [-1, 0, 1, 1, 3, 4, 1, 6, 7, 0, 9, 10, 0, 12, 13]


def body(arm=8, leg=10, belly=3):
    """A figure that stands on y = 0 and looks along z: positions (n, 3), triangles (m, 3), places of the joints (15, 3)."""
    hip, neck = leg + 1, leg + 12
    boxes = [((-belly, belly), (leg, neck - 1), (-2, 2)), ((-1, 1), (neck - 1, neck + 1), (-1, 1)),
        ((-3, 3), (neck + 1, neck + 6), (-3, 3))]
    for side in (-1, 1):
        boxes += [(sorted((side * belly, side * (belly + arm))), (neck - 4, neck - 2), (-1, 1)),
            (sorted((side * 1, side * 3)), (1, leg), (-1, 1)), (sorted((side * 1, side * 3)), (0, 1), (-1, 3))]
    filled = np.zeros((4 * arm + 16, leg + 24, 12), bool)
    middle = np.array([filled.shape[0] // 2, 2, 6])
    for box in boxes:
        filled[tuple(slice(low + m, high + m) for (low, high), m in zip(box, middle))] = True
    positions, quads = skin_of(filled)
    positions, quads = subdivide(smooth(positions, quads, 20), quads)
    positions = smooth(positions, quads, 20)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.uint32)
    reach = belly + np.array([0.5, 0.5 * arm, arm - 1.5])
    limb = lambda side: [(side * x, neck - 3, 0) for x in reach]
    foot = lambda side: [(side * 2, hip - 1, 0), (side * 2, leg / 2 + 0.5, 0.2), (side * 2, 1, 0)]
    joints = np.array([(0, hip, 0), (0, hip + 4, 0), (0, neck + 1, 0), *limb(1), *limb(-1), *foot(1), *foot(-1)], float)
    return ((positions - middle) / 10).astype(np.float32), triangles, joints / 10


def skin_of(filled):
    """The quads between filled and empty voxels."""
    corners, quads = {}, []
    number = lambda place: corners.setdefault(tuple(place), len(corners))
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for at in np.argwhere(filled):
            for side in (0, 1):
                beside = at.copy()
                beside[axis] += 2 * side - 1
                if filled[tuple(beside)]:
                    continue
                ring = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    place = at.copy()
                    place[axis] += side
                    place[u] += du
                    place[v] += dv
                    ring.append(number(place))
                quads.append(ring if side else ring[::-1])
    return np.array(list(corners), float), np.array(quads)


def subdivide(positions, quads):
    """Four quads from each."""
    edges = np.sort(np.stack([quads, np.roll(quads, -1, 1)], 2).reshape(-1, 2), 1)
    unique, index = np.unique(edges, axis=0, return_inverse=True)
    middles = index.reshape(-1, 4) + len(positions)
    centres = np.arange(len(quads)) + len(positions) + len(unique)
    before = np.roll(middles, 1, 1)
    parts = np.stack([quads, middles, np.repeat(centres[:, None], 4, 1), before], 2).reshape(-1, 4)
    return np.concatenate([positions, positions[unique].mean(1), positions[quads].mean(1)]), parts


def smooth(positions, quads, count):
    """Each vertex moves half way to the mean of its neighbours, and some of it back: the volume stays."""
    ends = np.concatenate([np.stack([quads, np.roll(quads, s, 1)], 2).reshape(-1, 2) for s in (1, -1)])
    degree = np.bincount(ends[:, 0])[:, None]
    for step in range(2 * count):
        mean = np.stack([np.bincount(ends[:, 0], positions[ends[:, 1], k]) for k in range(3)], 1) / degree
        positions = positions + (0.5 if step % 2 == 0 else -0.48) * (mean - positions)
    return positions


def draw(bodies, values=None, turn=-65, size=2.6):
    """Draws [(positions, triangles), ...] side by side. values: a number per vertex of each, in strips."""
    import matplotlib.pyplot as plt
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    figure = plt.figure(figsize=(size * len(bodies), size * 1.25), dpi=80)
    low = np.min([p.min(0) for p, _ in bodies], 0)
    high = np.max([p.max(0) for p, _ in bodies], 0)
    for i, (positions, triangles) in enumerate(bodies):
        axes = figure.add_subplot(1, len(bodies), i + 1, projection="3d", proj_type="ortho")
        corners = np.asarray(positions)[triangles][:, :, [0, 2, 1]] * (1, -1, 1)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-30
        colour = np.full((len(triangles), 3), (0.85, 0.78, 0.7))
        if values is not None:
            t = np.asarray(values[i])[triangles].mean(1)[:, None]
            colour = (1 - t) * (0.2, 0.35, 0.75) + t * (0.9, 0.45, 0.15)
            colour = np.where(np.floor(t * 16) % 2 == 1, 0.6 * colour + 0.4, colour)
        light = np.clip(0.45 + 0.55 * normals @ np.array([-0.4, -0.7, 0.6]), 0.15, 1)[:, None]
        lit = np.clip(colour * light, 0, 1)
        axes.add_collection3d(Poly3DCollection(corners, facecolors=lit, edgecolors=lit, linewidths=0.3))
        axes.set(xlim=(low[0], high[0]), ylim=(-high[2], -low[2]), zlim=(low[1], high[1]))
        axes.set_box_aspect((high - low)[[0, 2, 1]])
        axes.view_init(12, turn)
        axes.set_axis_off()
    figure.subplots_adjust(0, 0, 1, 1, 0, 0)
    return figure
