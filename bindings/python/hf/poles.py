"""Poles of quad meshes: guides that put an irregular vertex where the user wants it."""

from __future__ import annotations

from typing import Optional, Tuple

import numpy as np

from ._library import (ArrayLike, EmptyError, InvalidArgumentError, NonFiniteError, OutOfRangeError, corners, doubles, real,
                       whole)

_TINY = np.finfo(float).tiny
# A direction whose part in the surface is a smaller share of it says little: it is measured from the normal's noise.
_LEAST_SHARE = 0.1


def pole_guides(positions: ArrayLike, triangles: ArrayLike, place: ArrayLike, quad_count: int, radius: float, *,
                direction: Optional[ArrayLike] = None) -> Tuple[np.ndarray, np.ndarray]:
    """Guides for a pole: an irregular vertex where 3 or 5 quads meet, at a place that the user chooses and drags.

    Returns guide_vertices and guide_vectors for Quads: a ring of vertices around the place. The vectors make a quarter
    turn along the ring, so a singularity of the crosses lies inside.

    positions (n, 3), triangles (m, 3): the surface as given. place: a point at the surface. quad_count: 3 or 5. radius:
    of the ring, in the unit of the mesh; an edge of the quads is a good one. The ring is a triangle wide at least, so the
    pole is not nearer to the place than that. direction: an edge of the pole runs along its part in the surface; None
    chooses one."""
    xyz, at = doubles(positions, "positions"), doubles(place, "place", 3)
    faces, _stride = corners(triangles, "triangles")
    given = doubles(direction, "direction", 3)
    if xyz is None or at is None or faces is None or not len(faces):
        raise EmptyError("positions, triangles and place are needed")
    if whole(quad_count, "quad_count") not in (3, 5):
        raise InvalidArgumentError(f"quad_count must be 3 or 5, not {quad_count}")
    radius = real(radius, "radius")
    if not 0 < radius < float("inf"):
        raise InvalidArgumentError(f"radius must be above 0, not {radius}")
    xyz, at = xyz.reshape(-1, 3), at.ravel()
    if not np.isfinite(at).all() or given is not None and not np.isfinite(given).all():
        raise NonFiniteError("place or direction is not finite")
    if faces.max() >= len(xyz):
        raise OutOfRangeError(f"triangles holds vertex {faces.max()}; there are {len(xyz)}")
    away = np.linalg.norm(xyz - at, axis=1)
    loose = np.ones(len(xyz), bool)
    loose[faces] = False
    away[loose] = np.inf
    start = (xyz == xyz[away.argmin()]).all(1)  # with its copies, as along seams of textures
    at = _onto(xyz, faces[start[faces].any(1)], at)
    inside, vertices, touching = _ring(xyz, faces, start, np.linalg.norm(xyz - at, axis=1) <= radius)
    normals = _normals(xyz, touching)
    up = normals[inside].sum(0)
    if not np.linalg.norm(up) > 0:
        raise InvalidArgumentError("the surface has no normal at the place")
    up /= np.linalg.norm(up)
    x = _in_plane(up, None if given is None else given.ravel())
    arms = xyz[vertices] - at
    turn = np.arctan2(arms @ np.cross(up, x), arms @ x) * (4 - quad_count) / 4
    vectors = np.cos(turn)[:, None] * x + np.sin(turn)[:, None] * np.cross(up, x)
    return vertices.astype(np.uint32), _turned(vectors, up, normals[vertices])


def _ring(xyz: np.ndarray, faces: np.ndarray, start: np.ndarray,
          near: np.ndarray) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The near vertices that are connected with the first ones (a mask), those beside them, and the triangles of both.
    Copies of a vertex are connected."""
    near, inside = near | start, start.copy()
    candidates = np.flatnonzero(near)
    names = np.unique(xyz[candidates], axis=0, return_inverse=True)[1].ravel()
    faces = faces[near[faces].any(1)]
    while True:
        reached = np.zeros(len(candidates), bool)
        reached[names[inside[candidates]]] = True
        inside[candidates] = reached[names]
        touching = faces[inside[faces].any(1)]
        beside = np.zeros(len(near), bool)
        beside[touching] = True
        beside &= ~inside
        if not (beside & near).any():
            return inside, np.flatnonzero(beside), touching
        inside |= beside & near


def _flat(xyz: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Normals of triangles, as long as twice their areas."""
    a, b, c = xyz[faces].transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def _normals(xyz: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Normals of vertices; the larger a triangle, the more it counts."""
    normals, flat = np.zeros((len(xyz), 3)), _flat(xyz, faces)
    for k in range(3):
        np.add.at(normals, faces[:, k], flat)
    return normals


def _onto(xyz: np.ndarray, faces: np.ndarray, at: np.ndarray) -> np.ndarray:
    """A point of these triangles near another point, which may hover beside them."""
    flat = _flat(xyz, faces)
    shares = np.stack([np.einsum("ij,ij->i", np.cross(xyz[faces[:, k - 2]] - at, xyz[faces[:, k - 1]] - at), flat)
                       for k in range(3)], 1)
    shares = np.maximum(shares, 0)
    shares[~(shares.sum(1) > 0)] = 1  # a triangle without an area
    places = np.einsum("ij,ijk->ik", shares / shares.sum(1, keepdims=True), xyz[faces])
    return places[np.linalg.norm(places - at, axis=1).argmin()]


def _in_plane(up: np.ndarray, given: Optional[np.ndarray]) -> np.ndarray:
    """The part of a direction across `up`, of length 1; without one, that of an axis of space."""
    part = np.zeros(3) if given is None else given - (given @ up) * up
    if given is None or not np.linalg.norm(part) > _LEAST_SHARE * np.linalg.norm(given):
        part = np.eye(3)[abs(up).argmin()]
        part = part - (part @ up) * up
    return part / np.linalg.norm(part)


def _turned(vectors: np.ndarray, up: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Vectors across `up`, each turned by the smallest turn from `up` to the normal of its vertex."""
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1), _TINY)[:, None]
    axes, cosines = np.cross(up, normals), np.maximum(normals @ up, -0.9)  # -0.9: the turn to -1 has no axis
    first = np.cross(axes, vectors)
    return vectors + first + np.cross(axes, first) / (1 + cosines)[:, None]
