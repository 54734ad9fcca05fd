"""Solvers: sites that come and go on a surface, and the field through them (hf/solver.h)."""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import Any, Optional

import numpy as np

from . import _raw
from ._library import (ArrayLike, InvalidArgumentError, Recorded, address, call, count_of, doubles, handle_of, index,
                       integers, library, make, options_into, output, paired, whole)
from .surface import Progress, Surface


class Engine(IntEnum):
    GREEN, UPDOWN, REFACTOR = _raw.HF_ENGINE_GREEN, _raw.HF_ENGINE_UPDOWN, _raw.HF_ENGINE_REFACTOR


class Solver(Recorded):
    """Sites on a surface, and their field.

    Options are the fields of hf_solver_desc: field_kind, engine, channel_count, site_limit, penalty. progress: a
    Progress, for a factor that is not there yet.
    """

    _destroy = "hf_solver_destroy"

    def __init__(self, surface: Surface, *, progress: Optional[Progress] = None, **options: Any) -> None:
        desc, handle = make(_raw.hf_solver_desc), ctypes.c_void_p()
        options_into(desc, options)
        desc.progress = handle_of(progress, Progress, "progress")
        call("hf_create", handle_of(surface, Surface, "surface"), ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count: int = surface.vertex_count
        self.channel_count: int = desc.channel_count or 1

    def clone(self) -> "Solver":
        """A solver on the same surface with a copy of the sites."""
        handle = ctypes.c_void_p()
        call("hf_solver_clone", self._raw_handle, ctypes.byref(handle))
        copy = Solver.__new__(Solver)
        copy._own(handle)
        copy.vertex_count, copy.channel_count = self.vertex_count, self.channel_count
        return copy

    @property
    def info(self) -> _raw.hf_solver_info:
        """What the solver was made with, and how many sites it holds."""
        return self._read("hf_solver_get_info", _raw.hf_solver_info)

    @property
    def statistics(self) -> _raw.hf_solver_statistics:
        """Sites, factorisations and memory."""
        return self._read("hf_solver_get_statistics", _raw.hf_solver_statistics)

    # ---- sites ----

    def _sites(self, vertices: Any = None, values: Any = None, stiffness: Any = None, radii: Any = None,
               triangles: Any = None, barycentrics: Any = None, corners: Any = None) -> tuple:
        at, inside, between = (integers(vertices, "vertices"), integers(triangles, "triangles"),
                               integers(corners, "corners"))
        if between is not None and between.size % 3:
            raise InvalidArgumentError(f"corners must have the shape (k, 3), not {between.shape}")
        counts = [a.size for a in (at, inside) if a is not None] + ([] if between is None else [between.size // 3])
        count = counts[0] if counts else count_of(at)  # of none, the library says so
        if any(c != count for c in counts):
            raise InvalidArgumentError("vertices, triangles and corners: give one")
        held = [at, inside, doubles(barycentrics, "barycentrics", 3 * count),
            doubles(values, "values", count * self.channel_count),
                doubles(stiffness, "stiffness", count), doubles(radii, "radii", count), between]
        desc = make(_raw.hf_sites_desc, site_count=count)
        for name, array in zip(("vertices", "triangles", "barycentrics", "values", "stiffness", "radii", "corners"),
                               held):
            setattr(desc, name, address(array))
        return desc, count, held

    def add_sites(self, vertices: Optional[ArrayLike] = None, values: Optional[ArrayLike] = None, *,
        stiffness: Optional[ArrayLike] = None,
                  radii: Optional[ArrayLike] = None, triangles: Optional[ArrayLike] = None,
                  barycentrics: Optional[ArrayLike] = None, corners: Optional[ArrayLike] = None) -> np.ndarray:
        """Adds sites at vertices, inside triangles, or between three corners of a face ((k, 3), as a Hit has them); all
        or nothing. Returns their numbers, (k,) uint32."""
        desc, count, _held = self._sites(vertices, values, stiffness, radii, triangles, barycentrics, corners)
        out = np.empty(count, np.uint32)
        call("hf_add_sites", self._raw_handle, ctypes.byref(desc), address(out))
        return out

    def add_site(self, vertex: int, value: ArrayLike = 0.0) -> int:
        """Adds one hard site at a vertex. value: a number, or one per channel. Returns its number."""
        given = doubles(value, "value")
        if given is not None and given.size == 1:
            given = np.full(self.channel_count, given.ravel()[0])
        if given is not None and given.size != self.channel_count:
            raise InvalidArgumentError(f"value must hold {self.channel_count} numbers, not {given.size}")
        number = ctypes.c_uint32()
        call("hf_solver_add_site", self._raw_handle, index(vertex, "vertex"), address(given), ctypes.byref(number))
        return number.value

    def remove_sites(self, sites: ArrayLike) -> None:
        numbers = integers(sites, "sites")
        call("hf_remove_sites", self._raw_handle, count_of(numbers), address(numbers))

    def move_sites(self, sites: ArrayLike, vertices: Optional[ArrayLike] = None, *,
        triangles: Optional[ArrayLike] = None,
                   barycentrics: Optional[ArrayLike] = None, corners: Optional[ArrayLike] = None) -> None:
        """Moves sites, keeping their numbers and values."""
        numbers = integers(sites, "sites")
        desc, _, _held = self._sites(vertices, None, None, None, triangles, barycentrics, corners)
        call("hf_solver_move_sites", self._raw_handle, count_of(numbers), address(numbers), ctypes.byref(desc))

    def set_values(self, sites: ArrayLike, values: ArrayLike) -> None:
        numbers = integers(sites, "sites")
        count = count_of(numbers)
        given = doubles(values, "values", count * self.channel_count)
        call("hf_solver_set_values", self._raw_handle, count, address(numbers), address(given))

    def set_screening(self, screening: Optional[ArrayLike], targets: Optional[ArrayLike] = None) -> None:
        """(K + A H) u = A H p + W lambda: screening is H by vertex in 1 / length^2, targets is p, 0 if None. None removes
        the screening."""
        strength = doubles(screening, "screening", self.vertex_count)
        wish = doubles(targets, "targets", self.vertex_count * self.channel_count)
        call("hf_solver_set_screening", self._raw_handle, address(strength), address(wish))

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
        call("hf_solver_edit_sites", self._raw_handle, ctypes.byref(edit), address(out))
        return out

    @property
    def site_count(self) -> int:
        return library().hf_solver_get_site_count(self._raw_handle)

    def sites(self) -> dict:
        """All sites: arrays sites, vertices, components, values, stiffness, flux, radii."""
        count, channels = self.site_count, self.channel_count
        arrays = {"sites": np.empty(count, np.uint32), "vertices": np.empty(count, np.uint32),
            "components": np.empty(count, np.uint32),
                  "values": np.empty((count, channels)), "stiffness": np.empty(count), "flux": np.empty((count,
                      channels)), "radii": np.empty(count)}
        info = make(_raw.hf_sites_info, capacity=count, **{name: address(array) for name, array in arrays.items()})
        call("hf_solver_get_sites", self._raw_handle, ctypes.byref(info))
        return arrays

    def prepare_rebase(self) -> None:
        call("hf_solver_prepare_rebase", self._raw_handle)

    # ---- fields ----

    def _shape(self) -> tuple:
        return (self.vertex_count,) if self.channel_count == 1 else (self.vertex_count, self.channel_count)

    def solve(self, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32,
        info: Optional[_raw.hf_solve_info] = None) -> np.ndarray:
        """The field at every vertex, (n,) or (n, channels). out: float32 or float64 to write into, strided rows allowed."""
        out, stride = output(out, self._shape(), dtype if out is None else (np.float32, np.float64))
        if info is not None:
            info.struct_size = ctypes.sizeof(info)
        call("hf_solve" if out.dtype == np.float32 else "hf_solver_solve_f64", self._raw_handle, address(out), stride,
             None if info is None else ctypes.byref(info))
        return out

    def solve_at(self, vertices: ArrayLike) -> np.ndarray:
        """The field at chosen vertices, float64."""
        at = integers(vertices, "vertices")
        count = count_of(at)
        out = np.empty((count,) if self.channel_count == 1 else (count, self.channel_count))
        call("hf_solver_solve_at", self._raw_handle, count, address(at), address(out))
        return out

    def solve_vectors(self, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32) -> np.ndarray:
        """A tangent vector field from three channels, (n, 3)."""
        out, stride = output(out, (self.vertex_count, 3), dtype if out is None else (np.float32, np.float64))
        call("hf_solver_solve_vectors" if out.dtype == np.float32 else "hf_solver_solve_vectors_f64", self._raw_handle, address(out),
            stride, None, None)
        return out

    def solve_preview(self, out: Optional[np.ndarray] = None, *, correction_count: int = 0,
        dtype: Any = np.float32) -> np.ndarray:
        """As solve, through the factor in single precision."""
        out, stride = output(out, self._shape(), dtype if out is None else (np.float32, np.float64))
        call("hf_solver_solve_preview" if out.dtype == np.float32 else "hf_solver_solve_preview_f64", self._raw_handle, address(out),
            stride,
             whole(correction_count, "correction_count"), None)
        return out

    def certify(self, tolerance: float = 0.0) -> _raw.hf_certificate:
        """Measures the field on its own equations; InaccurateError when an error exceeds the tolerance (0: the default)."""
        certificate = make(_raw.hf_certificate, tolerance=tolerance)
        call("hf_solver_certify", self._raw_handle, ctypes.byref(certificate))
        return certificate

    def release_preview(self) -> None:
        """Gives the memory of the single-precision factor back."""
        call("hf_solver_release_preview", self._raw_handle)

    def move_vectors(self, sites: ArrayLike, vertices: ArrayLike) -> None:
        """Moves sites of a three-channel solver, carrying their vectors along the surface."""
        numbers, at = paired(sites, vertices)
        call("hf_solver_move_vectors", self._raw_handle, numbers.size, address(numbers), address(at))

    def rotate_vectors(self, sites: ArrayLike, angles: ArrayLike) -> None:
        """Turns the vectors of sites about the normals, radians."""
        numbers = integers(sites, "sites")
        turns = doubles(angles, "angles", count_of(numbers))
        call("hf_solver_rotate_vectors", self._raw_handle, count_of(numbers), address(numbers), address(turns))
