"""Regions of a surface, their smooth base, the detail on it, and detail carried to another region (hf/region.h)."""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import Any, Optional

import numpy as np

from . import _raw
from ._library import (ArrayLike, InvalidArgumentError, Object, Recorded, address, call, handle_of, integers, make, output,
                       points, whole)
from .surface import Progress, Surface


class Base(IntEnum):
    DEFAULT, MEMBRANE = _raw.HF_BASE_DEFAULT, _raw.HF_BASE_MEMBRANE
    THIN_PLATE, THIN_PLATE_GRAPH = _raw.HF_BASE_THIN_PLATE, _raw.HF_BASE_THIN_PLATE_GRAPH


class CurveKind(IntEnum):
    STRAIGHT, EDGES = _raw.HF_CURVE_STRAIGHT, _raw.HF_CURVE_EDGES


class Side(IntEnum):
    SMALLER, LARGER, SEED = _raw.HF_SIDE_SMALLER, _raw.HF_SIDE_LARGER, _raw.HF_SIDE_SEED


class RegionList(IntEnum):
    INSIDE, RIM, SITES = _raw.HF_REGION_INSIDE, _raw.HF_REGION_RIM, _raw.HF_REGION_SITES


def _morph(function: str, thing: Any, weight: float, out: Optional[np.ndarray], normals: Optional[np.ndarray],
           dtype: Any) -> np.ndarray:
    out, stride = output(out, (thing.vertex_count, 3), dtype if out is None else (np.float32, np.float64))
    desc = make(_raw.hf_morph_desc, position_stride=stride, weight=weight)
    setattr(desc, "positions" if out.dtype == np.float32 else "positions_f64", address(out))
    if normals is not None:
        normals, desc.normal_stride = output(normals, (thing.vertex_count, 3), np.float32, "normals")
        desc.normals = address(normals)
    call(function, thing._raw_handle, ctypes.byref(desc))
    return out


class Region(Recorded):
    """A region of a surface that grows, shrinks and is drawn by closed curves.

    positions: a pose of the surface to work on; None: at rest. base: a thin plate leaves the surface around it without
    a crease, a membrane has nearly the least area.
    """

    _destroy = "hf_region_destroy"

    def __init__(self, surface: Surface, positions: Optional[ArrayLike] = None, *,
                 base: int = Base.DEFAULT, progress: Optional[Progress] = None) -> None:
        desc, handle = make(_raw.hf_region_desc, base=base), ctypes.c_void_p()
        desc.progress = handle_of(progress, Progress, "progress")
        parent = handle_of(surface, Surface, "surface")
        if positions is not None:
            xyz, desc.position_stride = points(positions, "positions")
            if len(xyz) != surface.vertex_count:
                raise InvalidArgumentError(f"positions must have the shape ({surface.vertex_count}, 3), not {xyz.shape}")
            setattr(desc, "positions" if xyz.dtype == np.float32 else "positions_f64", address(xyz))
        call("hf_region_create", parent, ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = surface.vertex_count

    def clone(self) -> "Region":
        handle = ctypes.c_void_p()
        call("hf_region_clone", self._raw_handle, ctypes.byref(handle))
        copy = Region.__new__(Region)
        copy._own(handle)
        copy.vertex_count = self.vertex_count
        return copy

    def edit(self, *, curve: Optional[ArrayLike] = None, side: int = Side.SMALLER, seed_vertex: int = 0,
             curve_kind: int = CurveKind.STRAIGHT, rings: int = 0, add: Optional[ArrayLike] = None,
             remove: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> None:
        """One edit, all or nothing: what a closed curve through these vertices encloses, straight through triangles or
        along edges; rings of vertices more, or less when below 0; vertices added and removed. Sites are edited, nothing
        is factorised."""
        added, removed, along = integers(add, "add"), integers(remove, "remove"), integers(curve, "curve")
        desc = make(_raw.hf_region_edit_desc, ring_count=rings, progress=handle_of(progress, Progress, "progress"))
        if along is not None:
            line = make(_raw.hf_curve_desc, point_count=along.size, vertices=address(along), side=side,
                        seed_vertex=seed_vertex, kind=curve_kind)
            desc.curve = ctypes.addressof(line)
        if added is not None:
            desc.add_count, desc.add_vertices = added.size, address(added)
        if removed is not None:
            desc.remove_count, desc.remove_vertices = removed.size, address(removed)
        call("hf_region_edit", self._raw_handle, ctypes.byref(desc))

    @property
    def info(self) -> _raw.hf_region_info:
        return self._read("hf_region_get_info", _raw.hf_region_info)

    def vertices(self, which: int = RegionList.INSIDE) -> np.ndarray:
        """Vertices inside, on the rim, or the sites that hold the base, (k,) uint32."""
        which, size = whole(which, "which"), ctypes.c_uint32()
        call("hf_region_get_vertices", self._raw_handle, which, 0, None, ctypes.byref(size))
        out = np.empty(size.value, np.uint32)
        call("hf_region_get_vertices", self._raw_handle, which, out.size, address(out), ctypes.byref(size))
        return out

    def curve(self) -> np.ndarray:
        """Corners of the last closed curve, (k, 3) float64, to draw it; the last is joined to the first."""
        size = ctypes.c_uint32()
        call("hf_region_get_curve", self._raw_handle, 0, None, ctypes.byref(size))
        out = np.empty((size.value, 3))
        call("hf_region_get_curve", self._raw_handle, len(out), address(out), ctypes.byref(size))
        return out

    def morph(self, weight: float, out: Optional[np.ndarray] = None, *, normals: Optional[np.ndarray] = None,
              dtype: Any = np.float32) -> np.ndarray:
        """(n, 3) positions: 0 the surface, 1 its base without detail, between and beyond in proportion."""
        return _morph("hf_region_morph", self, weight, out, normals, dtype)


class Detail(Object):
    """The detail of one region on the base of another. Points of the rims that correspond: source_vertices and
    target_vertices, in order along both; scale 0: by the areas of the bases."""

    _destroy = "hf_detail_destroy"

    def __init__(self, source: Region, target: Region, *, source_vertices: Optional[ArrayLike] = None,
                 target_vertices: Optional[ArrayLike] = None, scale: float = 0.0,
                 progress: Optional[Progress] = None) -> None:
        starts, ends = integers(source_vertices, "source_vertices"), integers(target_vertices, "target_vertices")
        if (starts is None) != (ends is None) or (starts is not None and starts.size != ends.size):
            raise InvalidArgumentError("source_vertices and target_vertices must be of one length")
        desc = make(_raw.hf_detail_desc, pair_count=0 if starts is None else starts.size, scale=scale,
                    source_vertices=address(starts), target_vertices=address(ends),
                    progress=handle_of(progress, Progress, "progress"))
        handle = ctypes.c_void_p()
        call("hf_detail_create", handle_of(source, Region, "source"), handle_of(target, Region, "target"),
             ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = target.vertex_count

    def morph(self, weight: float, out: Optional[np.ndarray] = None, *, normals: Optional[np.ndarray] = None,
              dtype: Any = np.float32) -> np.ndarray:
        """(n, 3) positions of the target's surface: 0 as it is, 1 its region with the source's detail."""
        return _morph("hf_detail_morph", self, weight, out, normals, dtype)
