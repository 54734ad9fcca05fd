"""Quad meshes of surfaces, and streamlines of fields (hf/quads.h)."""

from __future__ import annotations

import ctypes
from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _raw
from ._library import (ArrayLike, InvalidArgumentError, Object, TooSmallError, address, call, doubles, handle_of, integers,
                       make, options_into, scalars, whole)
from .surface import Progress, Surface


class QuadMesh(NamedTuple):
    """Quads over a surface."""

    positions: np.ndarray  # (vertices, 3) float64
    faces: np.ndarray  # (faces, 4) uint32: the vertices of each, counter-clockwise
    triangles: np.ndarray  # (vertices,) uint32: or faces, of the mesh as given, that the vertex lies in
    barycentrics: np.ndarray  # (vertices, 3) float64
    corners: np.ndarray  # (vertices, 3) uint32: the vertices that barycentrics belong to


def _desc_of(*, crease_edges: Optional[ArrayLike] = None, guide_vertices: Optional[ArrayLike] = None,
             guide_vectors: Optional[ArrayLike] = None, guide_weights: Optional[ArrayLike] = None,
             irregular_points: Optional[ArrayLike] = None, irregular_valences: Optional[ArrayLike] = None,
             irregular_directions: Optional[ArrayLike] = None, symmetry_plane: Optional[ArrayLike] = None, progress: Optional[Progress] = None,
             **options: Any) -> Tuple[_raw.hf_quads_desc, tuple]:
    """The desc, and the arrays it points into: hold them until the call is over."""
    desc = make(_raw.hf_quads_desc)
    options_into(desc, options)
    edges = integers(crease_edges, "crease_edges")
    if edges is not None and edges.size % 2:
        raise InvalidArgumentError(f"crease_edges must hold two vertices each, not {edges.size} numbers")
    desc.crease_count, desc.crease_edges = 0 if edges is None else edges.size // 2, address(edges)
    guided = integers(guide_vertices, "guide_vertices")
    desc.guide_count, desc.guide_vertices = 0 if guided is None else guided.size, address(guided)
    vectors = doubles(guide_vectors, "guide_vectors", 3 * desc.guide_count)
    weights = doubles(guide_weights, "guide_weights", desc.guide_count)
    weights = None if weights is None else weights.astype(np.float32)
    desc.guide_vectors, desc.guide_weights = address(vectors), address(weights)
    counts = integers(irregular_valences, "irregular_valences")
    desc.irregular_count, desc.irregular_valences = 0 if counts is None else counts.size, address(counts)
    places = doubles(irregular_points, "irregular_points", 3 * desc.irregular_count)
    ways = doubles(irregular_directions, "irregular_directions", 3 * desc.irregular_count)
    desc.irregular_points, desc.irregular_directions = address(places), address(ways)
    if symmetry_plane is not None:
        desc.symmetry_plane[:] = doubles(symmetry_plane, "symmetry_plane", 4).ravel()
    desc.progress = handle_of(progress, Progress, "progress")
    return desc, (edges, guided, vectors, weights, counts, places, ways, progress)


class Quads(Object):
    """A quad mesh of a surface. Options: face_count, edge_length, crease_angle, relax_count; crease_edges (n, 2),
    guide_vertices (n,), guide_vectors (n, 3), guide_weights (n,), irregular_points (n, 3), irregular_valences (n,) of 3 or 5,
    irregular_directions (n, 3), progress, and symmetry_plane: a, b, c, d of the plane a x + b y + c z = d."""

    _destroy = "hf_quads_destroy"

    def __init__(self, surface: Surface, **options: Any) -> None:
        desc, _held = _desc_of(**options)
        handle = ctypes.c_void_p()
        call("hf_quads_create", handle_of(surface, Surface, "surface"), ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)

    def update(self, **options: Any) -> None:
        """Makes the mesh again: for strokes and creases that the user drags. The same options as for a new one; those
        that are left out are the defaults. After an error the mesh is what it was."""
        desc, _held = _desc_of(**options)
        call("hf_quads_update", self._raw_handle, ctypes.byref(desc))

    @property
    def info(self) -> _raw.hf_quads_info:
        """Sizes and counts."""
        return self._read("hf_quads_get_info", _raw.hf_quads_info)

    def mesh(self) -> QuadMesh:
        info = self.info
        v, f = info.vertex_count, info.face_count
        mesh = QuadMesh(np.empty((v, 3)), np.empty((f, 4), np.uint32), np.empty(v, np.uint32), np.empty((v, 3)),
                        np.empty((v, 3), np.uint32))
        out = make(_raw.hf_quads_mesh, vertex_capacity=v, face_capacity=f,
                   **{name: address(getattr(mesh, name)) for name in QuadMesh._fields})
        call("hf_quads_get_mesh", self._raw_handle, ctypes.byref(out))
        return mesh


class Streamlines(NamedTuple):
    """Line i holds the points line_starts[i] to line_starts[i + 1] - 1; values rise along it."""

    positions: np.ndarray  # (points, 3) float64
    values: np.ndarray  # (points,) float64
    line_starts: np.ndarray  # (lines + 1,) uint32
    line_ends: np.ndarray  # (lines, 2) uint32: vertices where it starts and ends

    def lines(self) -> List[np.ndarray]:
        """Each line's points, (k, 3)."""
        return [self.positions[a:b] for a, b in zip(self.line_starts[:-1], self.line_starts[1:])]


class Flow(Object):
    """A surface prepared for tracing streamlines, again and again."""

    _destroy = "hf_flow_destroy"

    def __init__(self, surface: Surface) -> None:
        handle = ctypes.c_void_p()
        call("hf_flow_create", handle_of(surface, Surface, "surface"), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = surface.vertex_count
        self._room = (4096, 64)  # points and lines that the last trace needed

    def trace(self, field: ArrayLike, wanted_count: int = 0, *, seeds: Optional[ArrayLike] = None) -> Streamlines:
        """Lines of equal flux from the minima of a field, wanted_count of them, or one through every seed vertex."""
        desc, _held = scalars(field, self.vertex_count)
        at = integers(seeds, "seeds")
        wanted_count = whole(wanted_count, "wanted_count", 0, 1000000)
        while True:
            p, k = self._room
            found = Streamlines(np.empty((p, 3)), np.empty(p), np.zeros(k + 1, np.uint32), np.empty((k, 2), np.uint32))
            out = make(_raw.hf_streamlines, wanted_count=wanted_count, seed_count=0 if at is None else at.size,
                       seeds=address(at), point_capacity=p, line_capacity=k,
                       **{name: address(getattr(found, name)) for name in Streamlines._fields})
            try:
                call("hf_flow_trace", self._raw_handle, None if desc is None else ctypes.byref(desc), ctypes.byref(out))
            except TooSmallError:
                self._room = (out.point_count + out.point_count // 4, out.line_count)
                continue
            p, k = out.point_count, out.line_count
            return Streamlines(found.positions[:p], found.values[:p], found.line_starts[:k + 1], found.line_ends[:k])
