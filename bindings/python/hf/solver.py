"""Solvers: a surface, its factor and a set of sites; fields, iso-lines, critical points, distances, extremities."""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import Any, List, NamedTuple, Optional, Sequence

import numpy as np

from . import _raw
from ._library import (NO_INDEX, ArrayLike, InvalidArgumentError, Object, address, call, count_of, doubles, handle_of,
    integers, library, make,
                       options_into, output, paired, points, scalars)


class Weld(IntEnum):
    EXACT, NONE, TOLERANCE = _raw.HF_WELD_EXACT, _raw.HF_WELD_NONE, _raw.HF_WELD_TOLERANCE


class Operator(IntEnum):
    COTANGENT, CLAMPED = _raw.HF_OPERATOR_COTANGENT, _raw.HF_OPERATOR_CLAMPED
    UNIFORM, INTRINSIC_DELAUNAY = _raw.HF_OPERATOR_UNIFORM, _raw.HF_OPERATOR_INTRINSIC_DELAUNAY


class FieldKind(IntEnum):
    HARMONIC, BIHARMONIC = _raw.HF_FIELD_HARMONIC, _raw.HF_FIELD_BIHARMONIC
    BIHARMONIC_GRAPH = _raw.HF_FIELD_BIHARMONIC_GRAPH


class Engine(IntEnum):
    GREEN, UPDOWN, REFACTOR = _raw.HF_ENGINE_GREEN, _raw.HF_ENGINE_UPDOWN, _raw.HF_ENGINE_REFACTOR


class Levels(IntEnum):
    VALUE, AREA, LENGTH = _raw.HF_LEVELS_VALUE, _raw.HF_LEVELS_AREA, _raw.HF_LEVELS_LENGTH


class Extremities(IntEnum):
    POISSON, GEODESIC = _raw.HF_EXTREMITIES_POISSON, _raw.HF_EXTREMITIES_GEODESIC


class Progress(Object):
    """Watches and cancels a long call from another thread: fraction, cancel()."""

    _destroy = "hf_progress_destroy"

    def __init__(self) -> None:
        handle = ctypes.c_void_p()
        call("hf_progress_create", ctypes.byref(handle))
        self._own(handle)

    @property
    def fraction(self) -> float:
        value = ctypes.c_float()
        call("hf_progress_get", self._raw_handle, ctypes.byref(value))
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


class Solver(Object):
    """One surface, its Laplacian and factor, and a set of sites (hf/mesh.h, hf/field.h).

    positions: (n, 3) float32 or float64, any stride between rows, borrowed for the call; triangles: (m, 3) whole numbers.
    Options are the fields of hf_create_desc: operator_kind, field_kind, weld, weld_tolerance, engine, channel_count,
    thread_count, site_limit, memory_limit_mb, ... progress: a Progress. saved_factor: bytes of save_factor().
    """

    _destroy = "hf_destroy"

    def __init__(self, positions: ArrayLike, triangles: ArrayLike, *, progress: Optional[Progress] = None,
                 saved_factor: Optional[bytes] = None, **options: Any) -> None:
        xyz, stride = points(positions, "positions")
        corners = integers(triangles, "triangles")
        if corners is not None and (corners.size % 3 or (corners.ndim == 2 and corners.shape[1] != 3)):
            raise InvalidArgumentError(f"triangles must have the shape (m, 3), not {corners.shape}")
        desc = make(_raw.hf_create_desc)
        options_into(desc, options)
        desc.vertex_count, desc.position_stride = len(xyz), stride
        if xyz.dtype == np.float32:
            desc.positions = address(xyz)
        else:
            desc.positions_f64 = address(xyz)
        desc.triangles, desc.triangle_count = address(corners), 0 if corners is None else corners.size // 3
        desc.progress = handle_of(progress, Progress, "progress")
        if saved_factor is not None:
            block = np.frombuffer(saved_factor, np.uint8)
            factor = make(_raw.hf_factor_desc, bytes=address(block), byte_count=block.size)
            desc.saved_factor = ctypes.addressof(factor)
        handle = ctypes.c_void_p()
        call("hf_create", ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count: int = len(xyz)
        self.channel_count: int = desc.channel_count or 1

    def clone(self) -> "Solver":
        """A solver that shares mesh and factor and has a copy of the sites."""
        handle = ctypes.c_void_p()
        call("hf_clone", self._raw_handle, ctypes.byref(handle))
        copy = Solver.__new__(Solver)
        copy._own(handle)
        copy.vertex_count, copy.channel_count = self.vertex_count, self.channel_count
        return copy

    # ---- what is known ----

    @property
    def report(self) -> _raw.hf_mesh_report:
        """What was found in the mesh."""
        report = make(_raw.hf_mesh_report)
        call("hf_get_mesh_report", self._raw_handle, ctypes.byref(report))
        return report

    @property
    def statistics(self) -> _raw.hf_statistics:
        """Counts, times and memory."""
        statistics = make(_raw.hf_statistics)
        call("hf_get_statistics", self._raw_handle, ctypes.byref(statistics))
        return statistics

    @property
    def components(self) -> np.ndarray:
        """(n,) uint32: the component of every vertex, NO_INDEX for isolated ones."""
        out = np.empty(self.vertex_count, np.uint32)
        call("hf_get_components", self._raw_handle, self.vertex_count, address(out))
        return out

    # ---- sites ----

    def _sites(self, vertices: Any = None, values: Any = None, stiffness: Any = None, radii: Any = None,
               triangles: Any = None, barycentrics: Any = None) -> tuple:
        at, inside = integers(vertices, "vertices"), integers(triangles, "triangles")
        count = inside.size if at is None and inside is not None else count_of(at)  # of none, the library says so
        if inside is not None and inside.size != count:
            raise InvalidArgumentError("vertices and triangles are given both")
        held = [at, inside, doubles(barycentrics, "barycentrics", 3 * count),
            doubles(values, "values", count * self.channel_count),
                doubles(stiffness, "stiffness", count), doubles(radii, "radii", count)]
        desc = make(_raw.hf_sites_desc, site_count=count)
        for name, array in zip(("vertices", "triangles", "barycentrics", "values", "stiffness", "radii"), held):
            setattr(desc, name, address(array))
        return desc, count, held

    def add_sites(self, vertices: Optional[ArrayLike] = None, values: Optional[ArrayLike] = None, *,
        stiffness: Optional[ArrayLike] = None,
                  radii: Optional[ArrayLike] = None, triangles: Optional[ArrayLike] = None,
                  barycentrics: Optional[ArrayLike] = None) -> np.ndarray:
        """Adds sites at vertices, or inside triangles; all or nothing. Returns their numbers, (k,) uint32."""
        desc, count, _held = self._sites(vertices, values, stiffness, radii, triangles, barycentrics)
        out = np.empty(count, np.uint32)
        call("hf_add_sites", self._raw_handle, ctypes.byref(desc), address(out))
        return out

    def remove_sites(self, sites: ArrayLike) -> None:
        numbers = integers(sites, "sites")
        call("hf_remove_sites", self._raw_handle, count_of(numbers), address(numbers))

    def move_sites(self, sites: ArrayLike, vertices: Optional[ArrayLike] = None, *,
        triangles: Optional[ArrayLike] = None,
                   barycentrics: Optional[ArrayLike] = None) -> None:
        """Moves sites, keeping their numbers and values."""
        numbers = integers(sites, "sites")
        desc, _, _held = self._sites(vertices, None, None, None, triangles, barycentrics)
        call("hf_move_sites", self._raw_handle, count_of(numbers), address(numbers), ctypes.byref(desc))

    def set_site_values(self, sites: ArrayLike, values: ArrayLike) -> None:
        numbers = integers(sites, "sites")
        count = count_of(numbers)
        given = doubles(values, "values", count * self.channel_count)
        call("hf_set_site_values", self._raw_handle, count, address(numbers), address(given))

    def edit_sites(self, *, remove: ArrayLike = (), move: ArrayLike = (), move_to: Optional[ArrayLike] = None,
        set: ArrayLike = (),
                   set_values: Optional[ArrayLike] = None, add: Optional[ArrayLike] = None,
                   add_values: Optional[ArrayLike] = None) -> np.ndarray:
        """One batch: remove, move, set, add; all or nothing. Returns the numbers of the added sites."""
        removed, moved, changed = (integers(() if a is None else a, n) for a, n in ((remove, "remove"), (move, "move"),
            (set, "set")))
        values = doubles(set_values, "set_values", changed.size * self.channel_count)
        edit = make(_raw.hf_edit_desc, remove_count=removed.size, remove_sites=address(removed), move_count=moved.size,
                    move_sites=address(moved), set_count=changed.size, set_sites=address(changed),
                    set_values=address(values))
        held = []
        if move_to is not None:
            held.append(self._sites(move_to))
            edit.move_to = ctypes.addressof(held[-1][0])
        count = 0
        if add is not None:
            held.append(self._sites(add, add_values))
            edit.add, count = ctypes.addressof(held[-1][0]), held[-1][1]
        out = np.empty(count, np.uint32)
        call("hf_edit_sites", self._raw_handle, ctypes.byref(edit), address(out))
        return out

    @property
    def site_count(self) -> int:
        return library().hf_get_site_count(self._raw_handle)

    def sites(self) -> dict:
        """All sites: arrays sites, vertices, components, values, stiffness, flux, radii."""
        count, channels = self.site_count, self.channel_count
        arrays = {"sites": np.empty(count, np.uint32), "vertices": np.empty(count, np.uint32),
            "components": np.empty(count, np.uint32),
                  "values": np.empty((count, channels)), "stiffness": np.empty(count), "flux": np.empty((count,
                      channels)), "radii": np.empty(count)}
        info = make(_raw.hf_site_info, capacity=count, **{name: address(array) for name, array in arrays.items()})
        call("hf_get_sites", self._raw_handle, ctypes.byref(info))
        return arrays

    def record(self) -> None:
        """Keeps the present sites for undo()."""
        call("hf_record", self._raw_handle)

    def undo(self) -> None:
        call("hf_undo", self._raw_handle)

    def redo(self) -> None:
        call("hf_redo", self._raw_handle)

    def prepare_rebase(self) -> None:
        call("hf_prepare_rebase", self._raw_handle)

    # ---- fields ----

    def _shape(self) -> tuple:
        return (self.vertex_count,) if self.channel_count == 1 else (self.vertex_count, self.channel_count)

    def solve(self, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32,
        info: Optional[_raw.hf_solve_info] = None) -> np.ndarray:
        """The field at every vertex, (n,) or (n, channels). out: float32 or float64 to write into, strided rows allowed."""
        out, stride = output(out, self._shape(), dtype if out is None else (np.float32, np.float64))
        if info is not None:
            info.struct_size = ctypes.sizeof(info)
        call("hf_solve" if out.dtype == np.float32 else "hf_solve_f64", self._raw_handle, address(out), stride,
             None if info is None else ctypes.byref(info))
        return out

    def solve_at(self, vertices: ArrayLike) -> np.ndarray:
        """The field at chosen vertices, float64."""
        at = integers(vertices, "vertices")
        count = count_of(at)
        out = np.empty((count,) if self.channel_count == 1 else (count, self.channel_count))
        call("hf_solve_at", self._raw_handle, count, address(at), address(out))
        return out

    def solve_vectors(self, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32) -> np.ndarray:
        """A tangent vector field from three channels, (n, 3)."""
        out, stride = output(out, (self.vertex_count, 3), dtype if out is None else (np.float32, np.float64))
        call("hf_solve_vectors" if out.dtype == np.float32 else "hf_solve_vectors_f64", self._raw_handle, address(out),
            stride, None, None)
        return out

    def solve_preview(self, out: Optional[np.ndarray] = None, *, correction_count: int = 0,
        dtype: Any = np.float32) -> np.ndarray:
        """As solve, through the factor in single precision."""
        out, stride = output(out, self._shape(), dtype if out is None else (np.float32, np.float64))
        call("hf_solve_preview" if out.dtype == np.float32 else "hf_solve_preview_f64", self._raw_handle, address(out),
            stride,
             correction_count, None)
        return out

    def certify(self, tolerance: float = 0.0) -> _raw.hf_certificate:
        """Measures the field on its own equations; InaccurateError when an error exceeds the tolerance (0: the default)."""
        certificate = make(_raw.hf_certificate, tolerance=float(tolerance))
        call("hf_certify", self._raw_handle, ctypes.byref(certificate))
        return certificate

    def release_preview(self) -> None:
        """Gives the memory of the single-precision factor back."""
        call("hf_release_preview", self._raw_handle)

    def save_factor(self) -> bytes:
        """The factor as bytes, for Solver(..., saved_factor=...)."""
        size = ctypes.c_size_t()
        call("hf_get_factor_size", self._raw_handle, ctypes.byref(size))
        block = np.empty(size.value, np.uint8)
        call("hf_save_factor", self._raw_handle, address(block), size.value)
        return block.tobytes()

    # ---- looking into a field ----

    def space_levels(self, field: ArrayLike, level_count: int, spacing: int = Levels.VALUE) -> np.ndarray:
        """Levels that divide a field into level_count + 1 strips of equal value steps, areas or widths."""
        desc, _held = scalars(field, self.vertex_count)
        out = np.empty(max(0, min(level_count, 1000000)))
        call("hf_space_levels", self._raw_handle, None if desc is None else ctypes.byref(desc), int(spacing),
            max(0, level_count), address(out))
        return out

    def trace_isolines(self, field: ArrayLike, levels: ArrayLike) -> Isolines:
        """The lines of the levels as polylines."""
        desc, _held = scalars(field, self.vertex_count)
        desc = None if desc is None else ctypes.byref(desc)
        wanted = doubles(levels, "levels")
        count = count_of(wanted)
        lines = make(_raw.hf_isolines)
        call("hf_trace_isolines", self._raw_handle, desc, count, address(wanted), ctypes.byref(lines))
        p, k = lines.point_count, lines.line_count
        result = Isolines(np.empty((p, 3)), np.empty((p, 2), np.uint32), np.empty(p), np.zeros(k + 1, np.uint32),
            np.empty(k, np.uint32),
                          np.empty(k, np.int32))
        if k:
            lines.point_capacity, lines.line_capacity = p, k
            for name in Isolines._fields:
                setattr(lines, name, address(getattr(result, name)))
            call("hf_trace_isolines", self._raw_handle, desc, count, address(wanted), ctypes.byref(lines))
        return result._replace(line_closed=result.line_closed != 0)

    def find_critical_points(self, field: ArrayLike) -> np.ndarray:
        """Minima, maxima and saddles: an array of records vertex, kind, index, component, value."""
        desc, _held = scalars(field, self.vertex_count)
        info = make(_raw.hf_critical_info)
        desc = None if desc is None else ctypes.byref(desc)
        call("hf_find_critical_points", self._raw_handle, desc, 0, None, ctypes.byref(info))
        out = np.empty(info.point_count, np.dtype(_raw.hf_critical_point))
        if out.size:
            call("hf_find_critical_points", self._raw_handle, desc, out.size, address(out), ctypes.byref(info))
        return out

    def find_extremities(self, *, progress: Optional[Progress] = None, geodesics: Optional["Geodesics"] = None,
        **options: Any) -> np.ndarray:
        """Tips of the surface, farthest first: records vertex, component, length, position.

        Options: kind, least_length, source_count.
        """
        desc = make(_raw.hf_extremities_desc)
        options_into(desc, options)
        desc.progress, desc.geodesics = handle_of(progress, Progress, "progress"), handle_of(geodesics, Geodesics,
            "geodesics")
        count = ctypes.c_uint32()
        call("hf_find_extremities", self._raw_handle, ctypes.byref(desc), 0, None, ctypes.byref(count))
        out = np.empty(count.value, np.dtype(_raw.hf_extremity))
        if out.size:
            call("hf_find_extremities", self._raw_handle, ctypes.byref(desc), out.size, address(out),
                ctypes.byref(count))
        return out

    def move_vector_sites(self, sites: ArrayLike, vertices: ArrayLike) -> None:
        """Moves sites of a three-channel solver, carrying their vectors along the surface."""
        numbers, at = paired(sites, vertices)
        call("hf_move_vector_sites", self._raw_handle, numbers.size, address(numbers), address(at))

    def rotate_vector_sites(self, sites: ArrayLike, angles: ArrayLike) -> None:
        """Turns the vectors of sites about the normals, radians."""
        numbers = integers(sites, "sites")
        turns = doubles(angles, "angles", count_of(numbers))
        call("hf_rotate_vector_sites", self._raw_handle, count_of(numbers), address(numbers), address(turns))


class Geodesics(Object):
    """Distances along a solver's surface by the heat method."""

    _destroy = "hf_geodesics_destroy"

    def __init__(self, solver: Solver, *, smoothing: float = 0.0) -> None:
        desc, handle = make(_raw.hf_geodesics_desc, smoothing=smoothing), ctypes.c_void_p()
        call("hf_geodesics_create", handle_of(solver, Solver, "solver"), ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = solver.vertex_count

    def distance(self, sources: ArrayLike, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32) -> np.ndarray:
        """From every vertex to the nearest source; -1 where none can be reached."""
        at = integers(sources, "sources")
        out, stride = output(out, (self.vertex_count,), dtype if out is None else (np.float32, np.float64))
        call("hf_geodesics_distance" if out.dtype == np.float32 else "hf_geodesics_distance_f64", self._raw_handle,
            count_of(at),
             address(at), address(out), stride)
        return out
