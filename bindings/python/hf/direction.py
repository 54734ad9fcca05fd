"""Direction fields on a surface, with constraints and singularities (hf/direction.h)."""

from __future__ import annotations

import ctypes
from typing import Any, Optional

import numpy as np

from . import _raw
from ._library import (ArrayLike, Recorded, address, call, count_of, doubles, handle_of, integers, library, make, output,
                       paired)
from .surface import Progress, Surface


class Direction(Recorded):
    """A field of vectors, lines or crosses (degree 1, 2, 4). Constraints come and go on its own factor."""

    _destroy = "hf_direction_destroy"

    def __init__(self, surface: Surface, *, degree: int = 1, site_limit: int = 0,
                 progress: Optional[Progress] = None) -> None:
        desc, handle = make(_raw.hf_direction_desc, degree=degree, site_limit=site_limit), ctypes.c_void_p()
        desc.progress = handle_of(progress, Progress, "progress")
        call("hf_direction_create", handle_of(surface, Surface, "surface"), ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = surface.vertex_count

    def clone(self) -> "Direction":
        """One that shares connection and factor and has a copy of the constraints."""
        handle = ctypes.c_void_p()
        call("hf_direction_clone", self._raw_handle, ctypes.byref(handle))
        copy = Direction.__new__(Direction)
        copy._own(handle)
        copy.vertex_count = self.vertex_count
        return copy

    def add_sites(self, vertices: ArrayLike, vectors: ArrayLike) -> np.ndarray:
        """Vectors at vertices, (k, 3), projected on the surface. Returns their numbers, (k,) uint32."""
        at = integers(vertices, "vertices")
        given, out = doubles(vectors, "vectors", 3 * count_of(at)), np.empty(count_of(at), np.uint32)
        call("hf_direction_add_sites", self._raw_handle, count_of(at), address(at), address(given), address(out))
        return out

    def remove_sites(self, sites: ArrayLike) -> None:
        numbers = integers(sites, "sites")
        call("hf_direction_remove_sites", self._raw_handle, count_of(numbers), address(numbers))

    def move_sites(self, sites: ArrayLike, vertices: ArrayLike) -> None:
        """Moves constraints, carrying their vectors along the surface."""
        numbers, at = paired(sites, vertices)
        call("hf_direction_move_sites", self._raw_handle, numbers.size, address(numbers), address(at))

    def set_vectors(self, sites: ArrayLike, vectors: ArrayLike) -> None:
        numbers = integers(sites, "sites")
        given = doubles(vectors, "vectors", 3 * count_of(numbers))
        call("hf_direction_set_vectors", self._raw_handle, count_of(numbers), address(numbers), address(given))

    def rotate_sites(self, sites: ArrayLike, angles: ArrayLike) -> None:
        """Turns constraints about the normals, radians."""
        numbers = integers(sites, "sites")
        turns = doubles(angles, "angles", count_of(numbers))
        call("hf_direction_rotate_sites", self._raw_handle, count_of(numbers), address(numbers), address(turns))

    @property
    def site_count(self) -> int:
        return library().hf_direction_get_site_count(self._raw_handle)

    def sites(self) -> dict:
        """All constraints: arrays sites, vertices, vectors (k, 3)."""
        count = self.site_count
        found = {"sites": np.empty(count, np.uint32), "vertices": np.empty(count, np.uint32),
            "vectors": np.empty((count, 3))}
        call("hf_direction_get_sites", self._raw_handle, count, *(address(array) for array in found.values()),
             None)
        return found

    @property
    def statistics(self) -> _raw.hf_direction_statistics:
        return self._read("hf_direction_get_statistics", _raw.hf_direction_statistics)

    def solve(self, out: Optional[np.ndarray] = None, *, dtype: Any = np.float32) -> np.ndarray:
        """The field as vectors, (n, 3)."""
        out, stride = output(out, (self.vertex_count, 3), dtype if out is None else (np.float32, np.float64))
        name = "hf_direction_solve" if out.dtype == np.float32 else "hf_direction_solve_f64"
        call(name, self._raw_handle, address(out), stride, None)
        return out

    def singularities(self) -> np.ndarray:
        """Records triangle, vertex, index."""
        count = ctypes.c_uint32()
        call("hf_direction_get_singularities", self._raw_handle, 0, None, ctypes.byref(count))
        out = np.empty(count.value, np.dtype(_raw.hf_singularity))
        if out.size:
            call("hf_direction_get_singularities", self._raw_handle, out.size, address(out), ctypes.byref(count))
        return out
