"""Surfaces: a mesh, its Laplacian and its factor; picking; iso-lines, critical points, distances, tips (hf/surface.h)."""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _raw
from ._library import (ArrayLike, InvalidArgumentError, Object, address, call, corners, count_of, doubles,
                       faces_into, handle_of, integers, make, options_into, output, points, scalars, whole)


class Weld(IntEnum):
    EXACT, NONE, TOLERANCE = _raw.HF_WELD_EXACT, _raw.HF_WELD_NONE, _raw.HF_WELD_TOLERANCE


class Operator(IntEnum):
    COTANGENT, CLAMPED = _raw.HF_OPERATOR_COTANGENT, _raw.HF_OPERATOR_CLAMPED
    UNIFORM, INTRINSIC_DELAUNAY = _raw.HF_OPERATOR_UNIFORM, _raw.HF_OPERATOR_INTRINSIC_DELAUNAY
    GRAPH = _raw.HF_OPERATOR_GRAPH


class FieldKind(IntEnum):
    HARMONIC, BIHARMONIC = _raw.HF_FIELD_HARMONIC, _raw.HF_FIELD_BIHARMONIC
    BIHARMONIC_GRAPH = _raw.HF_FIELD_BIHARMONIC_GRAPH


class Levels(IntEnum):
    VALUE, AREA, LENGTH = _raw.HF_LEVELS_VALUE, _raw.HF_LEVELS_AREA, _raw.HF_LEVELS_LENGTH


class Extremities(IntEnum):
    POISSON, GEODESIC = _raw.HF_EXTREMITIES_POISSON, _raw.HF_EXTREMITIES_GEODESIC


class DistanceMethod(IntEnum):
    AUTO, FRONT = _raw.HF_GEODESICS_AUTO, _raw.HF_GEODESICS_FRONT
    EXACT, HEAT = _raw.HF_GEODESICS_EXACT, _raw.HF_GEODESICS_HEAT


class Progress(Object):
    """Watches and cancels a long call from another thread: fraction, cancel()."""

    _destroy = "hf_progress_destroy"

    def __init__(self) -> None:
        handle = ctypes.c_void_p()
        call("hf_progress_create", ctypes.byref(handle))
        self._own(handle)

    @property
    def fraction(self) -> float:
        value = ctypes.c_double()
        call("hf_progress_get_fraction", self._raw_handle, ctypes.byref(value))
        return value.value

    def cancel(self) -> None:
        call("hf_progress_cancel", self._raw_handle)


class Isolines(NamedTuple):
    """Polylines: line i holds the points line_starts[i] to line_starts[i + 1] - 1."""

    positions: np.ndarray  # (points, 3) float64
    point_edges: np.ndarray  # (points, 2) uint32
    parameters: np.ndarray  # (points,) float64: (1 - t) a + t b
    line_starts: np.ndarray  # (lines + 1,) uint32
    line_levels: np.ndarray  # (lines,) uint32
    line_closed: np.ndarray  # (lines,) bool

    def lines(self) -> List[np.ndarray]:
        """Each line's points, (k, 3)."""
        return [self.positions[a:b] for a, b in zip(self.line_starts[:-1], self.line_starts[1:])]


class Surface(Object):
    """A mesh, welded, checked and factorised once. Everything else is made on it, and may outlive it.

    positions: (n, 3) float32 or float64; triangles: (m, 3) uint32 or uint16. Both may have any stride between rows and
    are borrowed for the call. faces instead of triangles: (m, k) corners; (offsets, corners), m + 1 offsets; or
    (starts, sizes, corners) as Blender's loops, with None for starts where faces follow one another. Options are the
    fields of hf_surface_desc: operator_kind, field_kind, weld, weld_tolerance, ordering, thread_count, vertex_limit, ...
    progress: a Progress. saved_factor: bytes of save().
    link_pieces: True joins the pieces of a character by links. tags: (n,) uint32, with link_pieces: pieces of different
    tags stay apart.
    """

    _destroy = "hf_surface_destroy"

    def __init__(self, positions: ArrayLike, triangles: Optional[ArrayLike] = None, *, faces: Any = None,
                 progress: Optional[Progress] = None, saved_factor: Optional[bytes] = None, link_pieces: bool = False,
                 tags: Optional[ArrayLike] = None, **options: Any) -> None:
        xyz, stride = points(positions, "positions")
        mesh, triangle_stride = corners(triangles, "triangles")
        desc = make(_raw.hf_surface_desc)
        options_into(desc, options)
        desc.vertex_count, desc.position_stride = len(xyz), stride
        setattr(desc, "positions" if xyz.dtype == np.float32 else "positions_f64", address(xyz))
        if mesh is not None:
            desc.triangle_count, desc.triangle_stride = len(mesh), triangle_stride
            setattr(desc, "triangles" if mesh.dtype == np.uint32 else "triangles_u16", address(mesh))
        _held = None if faces is None else faces_into(desc, faces)
        if tags is not None and not link_pieces:
            raise InvalidArgumentError("tags need link_pieces=True")
        if link_pieces:
            links = make(_raw.hf_links_desc, mode=_raw.HF_LINK_PIECES)
            if tags is not None:
                groups = np.ascontiguousarray(tags, np.uint32)
                if groups.shape != (len(xyz),):
                    raise InvalidArgumentError(f"tags must hold one number for each of {len(xyz)} vertices")
                links.tags = address(groups)
            desc.links = ctypes.addressof(links)
        self._create("hf_surface_create", desc, progress, saved_factor)

    def _create(self, function: str, desc: Any, progress: Optional[Progress], saved_factor: Optional[bytes]) -> None:
        desc.progress = handle_of(progress, Progress, "progress")
        if saved_factor is not None:
            try:
                block = np.frombuffer(saved_factor, np.uint8)
            except (TypeError, ValueError, BufferError) as error:
                raise InvalidArgumentError(f"saved_factor must be bytes: {error}") from None
            factor = make(_raw.hf_factor_desc, bytes=address(block), byte_count=block.size)
            desc.saved_factor = ctypes.addressof(factor)
        handle = ctypes.c_void_p()
        call(function, ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count: int = desc.vertex_count

    @classmethod
    def from_graph(cls, vertex_count: int, edges: ArrayLike, weights: ArrayLike, *,
                   masses: Optional[ArrayLike] = None, progress: Optional[Progress] = None,
                   saved_factor: Optional[bytes] = None, **options: Any) -> "Surface":
        """A surface of a graph: fields on tetrahedra, points, a network. What needs triangles raises UnsupportedError.

        edges: (m, 2) vertices; weights: (m,); masses: (n,) for bi-harmonic fields, or None. Options are the fields of
        hf_graph_desc: allow_negative, field_kind, ordering, thread_count, vertex_limit, edge_limit, ...
        """
        desc = make(_raw.hf_graph_desc)
        options_into(desc, options)
        ends, sizes = integers(edges, "edges"), doubles(weights, "weights")
        if ends is None or sizes is None or ends.size != 2 * sizes.size:
            raise InvalidArgumentError("edges must have two vertices for each of the weights")
        desc.vertex_count, desc.edge_count = whole(vertex_count, "vertex_count"), count_of(sizes)
        desc.edges, desc.weights = address(ends), address(sizes)
        if masses is not None:
            held = doubles(masses, "masses", desc.vertex_count)
            desc.masses = address(held)
        surface = cls.__new__(cls)
        surface._create("hf_surface_create_graph", desc, progress, saved_factor)
        return surface

    @property
    def info(self) -> _raw.hf_surface_info:
        """The options the surface was made with, defaults filled in."""
        return self._read("hf_surface_get_info", _raw.hf_surface_info)

    @property
    def report(self) -> _raw.hf_surface_report:
        """What was found in the mesh."""
        return self._read("hf_surface_get_report", _raw.hf_surface_report)

    @property
    def statistics(self) -> _raw.hf_surface_statistics:
        """Times, memory and the size of the factor."""
        return self._read("hf_surface_get_statistics", _raw.hf_surface_statistics)

    @property
    def components(self) -> np.ndarray:
        """(n,) uint32: the component of every vertex, NO_INDEX for isolated ones."""
        out = np.empty(self.vertex_count, np.uint32)
        call("hf_surface_get_components", self._raw_handle, self.vertex_count, address(out), None)
        return out

    @property
    def pieces(self) -> Tuple[np.ndarray, np.ndarray]:
        """(n,) uint32: the piece of every vertex, NO_INDEX for isolated ones; (n,) bool: whether the piece is light."""
        out, light = np.empty(self.vertex_count, np.uint32), np.empty(self.vertex_count, np.int32)
        call("hf_surface_get_pieces", self._raw_handle, self.vertex_count, address(out), address(light), None)
        return out, light != 0

    def measure_gaps(self, positions: ArrayLike) -> _raw.hf_gaps_info:
        """How much farther the ends of links are apart than at rest. positions: (n, 3), posed."""
        xyz, stride = points(positions, "positions")
        if len(xyz) != self.vertex_count:
            raise InvalidArgumentError(f"positions must have the shape ({self.vertex_count}, 3), not {xyz.shape}")
        desc = make(_raw.hf_gaps_desc, position_stride=stride)
        setattr(desc, "positions" if xyz.dtype == np.float32 else "positions_f64", address(xyz))
        info = make(_raw.hf_gaps_info)
        call("hf_surface_measure_gaps", self._raw_handle, ctypes.byref(desc), 0, None, ctypes.byref(info))
        return info

    def save(self, field_kind: int = FieldKind.HARMONIC) -> bytes:
        """The factor of a kind of field as bytes, for Surface(..., saved_factor=...)."""
        field_kind, size = whole(field_kind, "field_kind"), ctypes.c_size_t()
        call("hf_surface_save", self._raw_handle, field_kind, None, 0, None, ctypes.byref(size))
        block = np.empty(size.value, np.uint8)
        call("hf_surface_save", self._raw_handle, field_kind, None, block.size, address(block), ctypes.byref(size))
        return block.tobytes()

    # ---- picking ----

    def _pick(self, positions: Optional[ArrayLike], front_only: int = 0) -> tuple:
        desc, xyz = make(_raw.hf_pick_desc, front_only=front_only), None
        if positions is not None:
            xyz, desc.position_stride = points(positions, "positions")
            if len(xyz) != self.vertex_count:
                raise InvalidArgumentError(f"positions must have the shape ({self.vertex_count}, 3), not {xyz.shape}")
            setattr(desc, "positions" if xyz.dtype == np.float32 else "positions_f64", address(xyz))
        return desc, xyz

    def cast_ray(self, origin: ArrayLike, direction: ArrayLike, *, positions: Optional[ArrayLike] = None,
                 front_only: bool = False) -> Optional[_raw.hf_hit]:
        """What a click hits: the first triangle or face on a ray, or None. Its corners and barycentrics are a site.

        positions: where the surface stands, (n, 3); None: at rest. front_only: pass triangles seen from behind.
        """
        desc, _held = self._pick(positions, front_only)
        start, along = doubles(origin, "origin", 3), doubles(direction, "direction", 3)
        hit = make(_raw.hf_hit)
        call("hf_surface_cast_ray", self._raw_handle, address(start), address(along), ctypes.byref(desc),
             ctypes.byref(hit))
        return hit if hit.found else None

    def find_vertex(self, point: ArrayLike, *, positions: Optional[ArrayLike] = None) -> Tuple[int, float]:
        """The vertex nearest to a point, and its distance. positions: as cast_ray."""
        desc, _held = self._pick(positions)
        at, vertex, distance = doubles(point, "point", 3), ctypes.c_uint32(), ctypes.c_double()
        call("hf_surface_find_vertex", self._raw_handle, address(at), ctypes.byref(desc), ctypes.byref(vertex),
             ctypes.byref(distance))
        return vertex.value, distance.value

    # ---- fields over the surface ----

    def space_levels(self, field: ArrayLike, level_count: int, spacing: int = Levels.VALUE) -> np.ndarray:
        """Levels that divide a field into level_count + 1 strips of equal value steps, areas or widths."""
        desc, _held = scalars(field, self.vertex_count)
        level_count = whole(level_count, "level_count")
        out = np.empty(min(level_count, 1000000))
        call("hf_surface_space_levels", self._raw_handle, None if desc is None else ctypes.byref(desc), whole(spacing, "spacing"),
            level_count, address(out))
        return out

    def trace_isolines(self, field: ArrayLike, levels: ArrayLike) -> Isolines:
        """The lines of the levels as polylines."""
        desc, _held = scalars(field, self.vertex_count)
        desc = None if desc is None else ctypes.byref(desc)
        wanted = doubles(levels, "levels")
        count = count_of(wanted)
        lines = make(_raw.hf_isolines)
        call("hf_surface_trace_isolines", self._raw_handle, desc, count, address(wanted), ctypes.byref(lines))
        p, k = lines.point_count, lines.line_count
        result = Isolines(np.empty((p, 3)), np.empty((p, 2), np.uint32), np.empty(p), np.zeros(k + 1, np.uint32),
            np.empty(k, np.uint32),
                          np.empty(k, np.int32))
        if k:
            lines.point_capacity, lines.line_capacity = p, k
            for name in Isolines._fields:
                setattr(lines, name, address(getattr(result, name)))
            call("hf_surface_trace_isolines", self._raw_handle, desc, count, address(wanted), ctypes.byref(lines))
        return result._replace(line_closed=result.line_closed != 0)

    def find_critical_points(self, field: ArrayLike) -> np.ndarray:
        """Minima, maxima and saddles: an array of records vertex, kind, index, component, value."""
        desc, _held = scalars(field, self.vertex_count)
        info = make(_raw.hf_critical_info)
        desc = None if desc is None else ctypes.byref(desc)
        call("hf_surface_find_critical_points", self._raw_handle, desc, 0, None, ctypes.byref(info))
        out = np.empty(info.point_count, np.dtype(_raw.hf_critical_point))
        if out.size:
            call("hf_surface_find_critical_points", self._raw_handle, desc, out.size, address(out), ctypes.byref(info))
        return out

    def find_extremities(self, *, progress: Optional[Progress] = None, geodesics: Optional["Geodesics"] = None,
        **options: Any) -> np.ndarray:
        """Tips of the surface, the longest first: records vertex, component, length, position.

        Options: kind, least_length_share, source_count.
        """
        desc = make(_raw.hf_extremities_desc)
        options_into(desc, options)
        desc.progress, desc.geodesics = handle_of(progress, Progress, "progress"), handle_of(geodesics, Geodesics,
            "geodesics")
        count = ctypes.c_uint32()
        call("hf_surface_find_extremities", self._raw_handle, ctypes.byref(desc), 0, None, ctypes.byref(count))
        out = np.empty(count.value, np.dtype(_raw.hf_extremity))
        if out.size:
            call("hf_surface_find_extremities", self._raw_handle, ctypes.byref(desc), out.size, address(out),
                ctypes.byref(count))
        return out

    def propose_handles(self, *, joints: Optional[ArrayLike] = None, parents: Optional[ArrayLike] = None,
        up: Optional[ArrayLike] = None, progress: Optional[Progress] = None, **options: Any) -> np.ndarray:
        """Places for handles, pinned ones first: records vertex, component, reason, pinned, joint, position, radius,
        length. Reasons are the constants HF_HANDLE_REASON_*. joints, parents: a skeleton, by position in the list; a
        root has the parent HF_NO_INDEX.

        Options: least_length_share, limit.
        """
        desc = make(_raw.hf_handle_proposals_desc)
        options_into(desc, options)
        desc.progress = handle_of(progress, Progress, "progress")
        if joints is not None:
            places, above = np.ascontiguousarray(joints, np.float64).reshape(-1, 3), integers(parents, "parents")
            if len(places) != len(above):
                raise InvalidArgumentError(f"{len(places)} joints have {len(above)} parents")
            desc.joint_count, desc.joints, desc.parents = len(places), address(places), address(above)
        if up is not None:
            desc.up[:] = [float(x) for x in np.asarray(up, np.float64).reshape(3)]
        count = ctypes.c_uint32()
        call("hf_surface_propose_handles", self._raw_handle, ctypes.byref(desc), 0, None, ctypes.byref(count))
        out = np.empty(count.value, np.dtype(_raw.hf_handle_proposal))
        if out.size:
            call("hf_surface_propose_handles", self._raw_handle, ctypes.byref(desc), out.size, address(out), ctypes.byref(count))
        return out


class Geodesics(Object):
    """Distances along a surface, by a method of DistanceMethod."""

    _destroy = "hf_geodesics_destroy"

    def __init__(self, surface: Surface, *, smoothing: float = 0.0, method: int = DistanceMethod.AUTO,
                 progress: Optional[Progress] = None) -> None:
        desc, handle = make(_raw.hf_geodesics_desc, smoothing=smoothing, method=method), ctypes.c_void_p()
        desc.progress = handle_of(progress, Progress, "progress")
        call("hf_geodesics_create", handle_of(surface, Surface, "surface"), ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = surface.vertex_count

    def distance(self, sources: ArrayLike, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32) -> np.ndarray:
        """From every vertex to the nearest source; -1 where none can be reached."""
        at = integers(sources, "sources")
        out, stride = output(out, (self.vertex_count,), dtype if out is None else (np.float32, np.float64))
        call("hf_geodesics_solve" if out.dtype == np.float32 else "hf_geodesics_solve_f64", self._raw_handle,
            count_of(at),
             address(at), address(out), stride)
        return out

    def path(self, start: "Place", end: "Place") -> np.ndarray:
        """The shortest path between two places: positions of its corners; empty where none leads. A place is a vertex,
        or three vertices of a triangle and their weights."""
        ends, path = (_point(start), _point(end)), make(_raw.hf_path)
        arguments = (self._raw_handle, ctypes.byref(ends[0]), ctypes.byref(ends[1]), ctypes.byref(path))
        call("hf_geodesics_find_path", *arguments)
        positions = np.empty((path.point_count, 3))
        path.point_capacity, path.positions = path.point_count, address(positions)
        call("hf_geodesics_find_path", *arguments)
        return positions

    def map(self, centre: "Place", radius: float = 0.0) -> np.ndarray:
        """The surface around a place laid out in a plane: two coordinates per vertex; NaN beyond the radius."""
        point, out = _point(centre), np.empty((self.vertex_count, 2))
        call("hf_geodesics_get_map", self._raw_handle, ctypes.byref(point), ctypes.c_double(radius), address(out), None)
        return out


Place = Union[int, Tuple[Sequence[int], Sequence[float]]]


def _point(place: Place) -> Any:
    point = _raw.hf_surface_point()
    corners, weights = ((place,) * 3, (1.0, 0.0, 0.0)) if isinstance(place, (int, np.integer)) else place
    for k in range(3):
        point.corners[k], point.barycentrics[k] = int(corners[k]), float(weights[k])
    return point
