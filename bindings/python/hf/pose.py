"""Posing with handles that come and go; the motion of one surface played on another (hf/pose.h, hf/transfer.h)."""

from __future__ import annotations

import ctypes
from enum import IntEnum, IntFlag
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np

from . import _raw
from ._library import (ArrayLike, InvalidArgumentError, Object, address, call, count_of, doubles, handle_of, index, integers,
    library, make, options_into, output,
                       points, real, regions)
from .surface import Surface


class DeformMode(IntEnum):
    SMOOTH, PAPER = _raw.HF_DEFORM_SMOOTH, _raw.HF_DEFORM_PAPER


class TransferMode(IntEnum):
    FIELDS, PAPER, STRETCH = _raw.HF_TRANSFER_FIELDS, _raw.HF_TRANSFER_PAPER, _raw.HF_TRANSFER_STRETCH


class Pair(IntFlag):
    NONE = 0
    ANCHOR, FOOT, TRUNK = _raw.HF_PAIR_ANCHOR, _raw.HF_PAIR_FOOT, _raw.HF_PAIR_TRUNK
    NO_ALIGNMENT, CONTACT, SINKS = _raw.HF_PAIR_NO_ALIGNMENT, _raw.HF_PAIR_CONTACT, _raw.HF_PAIR_SINKS
    NECK, TAIL, ARM = _raw.HF_PAIR_NECK, _raw.HF_PAIR_TAIL, _raw.HF_PAIR_ARM


class Skin(NamedTuple):
    """For linear blend skinning. The inverse bind matrix of a joint is the translation by minus its pivot."""

    pivots: np.ndarray  # (joints, 3)
    rotations: np.ndarray  # (joints, 4) x, y, z, w
    translations: np.ndarray  # (joints, 3) posed place of the pivot
    joints: np.ndarray  # (n, 4 or 8) uint32
    weights: np.ndarray  # (n, 4 or 8) float32, sum 1


def _skin(function: str, handle: Optional[int], vertex_count: int, influence_count: int) -> Skin:
    info = make(_raw.hf_skin_info, influence_count=influence_count)
    call(function, handle, ctypes.byref(info))
    joints = info.joint_count
    skin = Skin(np.empty((joints, 3)), np.empty((joints, 4)), np.empty((joints, 3)),
        np.empty((vertex_count, influence_count), np.uint32),
                np.empty((vertex_count, influence_count), np.float32))
    info.joint_capacity, info.vertex_capacity = joints, vertex_count
    info.pivots, info.rotations = address(skin.pivots), address(skin.rotations)
    info.translations = address(skin.translations)
    info.vertex_joints, info.vertex_weights = address(skin.joints), address(skin.weights)
    call(function, handle, ctypes.byref(info))
    return skin


class Pose(Object):
    """Handles on a surface; every vertex follows.

    Options: mode, band_count, iteration_count, rim_site_count, group_count.
    """

    _destroy = "hf_pose_destroy"

    def __init__(self, surface: Surface, **options: Any) -> None:
        desc, handle = make(_raw.hf_pose_desc), ctypes.c_void_p()
        options_into(desc, options)
        call("hf_pose_create", handle_of(surface, Surface, "surface"), ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = surface.vertex_count

    def clone(self) -> "Pose":
        handle = ctypes.c_void_p()
        call("hf_pose_clone", self._raw_handle, ctypes.byref(handle))
        copy = Pose.__new__(Pose)
        copy._own(handle)
        copy.vertex_count = self.vertex_count
        return copy

    def add_handles(self, region_lists: Optional[Sequence[ArrayLike]] = None, *, points: Optional[ArrayLike] = None,
                    radii: Optional[ArrayLike] = None, layer: int = 0, in_place: bool = False) -> np.ndarray:
        """Adds handles: lists of vertices, or points with radii; no factorisation. Returns their numbers, (k,) uint32.

        in_place: they start where the posed surface stands, not at rest; handle_info says where.
        """
        if points is not None:
            centres = doubles(points, "points")
            if centres.size % 3:
                raise InvalidArgumentError(f"points must have the shape (k, 3), not {centres.shape}")
            reach = doubles(radii, "radii", centres.size // 3)
            desc = make(_raw.hf_handles_desc, handle_count=centres.size // 3, points=address(centres),
                radii=address(reach), layer=layer, in_place=in_place)
        else:
            counts, vertices = regions(region_lists, "region_lists")
            desc = make(_raw.hf_handles_desc, handle_count=1 if counts is None else counts.size,
                region_counts=address(counts),
                        region_vertices=address(vertices), layer=layer, in_place=in_place)
        out = np.empty(desc.handle_count, np.uint32)
        call("hf_pose_add_handles", self._raw_handle, ctypes.byref(desc), address(out))
        return out

    def add_handle_at(self, point: ArrayLike, radius: float) -> int:
        """Adds one handle: what is edge-connected within radius of a point at rest. Returns its number."""
        place, number = doubles(point, "point", 3), ctypes.c_uint32()
        call("hf_pose_add_handle_at", self._raw_handle, address(place), real(radius, "radius"), ctypes.byref(number))
        return number.value

    def remove_handles(self, handles: ArrayLike) -> None:
        numbers = integers(handles, "handles")
        call("hf_pose_remove_handles", self._raw_handle, count_of(numbers), address(numbers))

    def set_transforms(self, handles: ArrayLike, rotations: Optional[ArrayLike] = None,
        translations: Optional[ArrayLike] = None) -> None:
        """Rigid motions from rest about the handles' centroids: (k, 4) quaternions x, y, z, w and (k, 3); None = none."""
        numbers = integers(handles, "handles")
        count = count_of(numbers)
        packed = np.zeros((count, 7))
        for columns, values, name in ((slice(0, 4), rotations, "rotations"),
            (slice(4, 7), translations, "translations")):
            if values is not None:
                width = columns.stop - columns.start
                packed[:, columns] = doubles(values, name, count * width).reshape(count, width)
        call("hf_pose_set_transforms", self._raw_handle, count, address(numbers), address(packed))

    def set_transform(self, handle: int, rotation: Optional[ArrayLike] = None,
                      translation: Optional[ArrayLike] = None) -> None:
        """A rigid motion of one handle: a quaternion x, y, z, w and a translation; None = none."""
        motion = _raw.hf_transform()
        for name, values, width in (("rotation", rotation, 4), ("translation", translation, 3)):
            if values is not None:
                setattr(motion, name, (ctypes.c_double * width)(*doubles(values, name, width).ravel()))
        call("hf_pose_set_transform", self._raw_handle, index(handle, "handle"), ctypes.byref(motion))

    def set_matrices(self, handles: ArrayLike, matrices: ArrayLike) -> None:
        """Rigid 4 x 4 matrices rest -> posed, (k, 4, 4) in the usual row-by-row reading."""
        numbers = integers(handles, "handles")
        count = count_of(numbers)
        given = doubles(matrices, "matrices", 16 * count)
        columns = None if given is None else np.ascontiguousarray(given.reshape(count, 4, 4).transpose(0, 2, 1))
        call("hf_pose_set_matrices", self._raw_handle, count, address(numbers), address(columns))

    @property
    def info(self) -> _raw.hf_pose_info:
        """The options the pose was made with, defaults filled in."""
        return self._read("hf_pose_get_info", _raw.hf_pose_info)

    def handle_info(self, handle: int) -> _raw.hf_handle_info:
        info = make(_raw.hf_handle_info)
        call("hf_pose_get_handle", self._raw_handle, index(handle, "handle"), ctypes.byref(info))
        return info

    @property
    def handle_count(self) -> int:
        return library().hf_pose_get_handle_count(self._raw_handle)

    def handle_field(self, handle: int, out: Optional[np.ndarray] = None) -> np.ndarray:
        """How much each vertex belongs to a handle, (n,) float32."""
        out, stride = output(out, (self.vertex_count,), np.float32)
        call("hf_pose_get_field", self._raw_handle, index(handle, "handle"), address(out), stride)
        return out

    def deform(self, out: Optional[np.ndarray] = None, *, normals: Optional[np.ndarray] = None, dtype: Any = np.float32,
               info: Optional[_raw.hf_deform_info] = None, **options: Any) -> np.ndarray:
        """Solves the pose: (n, 3) positions, into out when given (float32 or float64, strided rows).

        normals: (n, 3) float32 to fill. Options: iteration_count, restart, refine, refine_from_last.
        """
        out, stride = output(out, (self.vertex_count, 3), dtype if out is None else (np.float32, np.float64))
        desc = make(_raw.hf_deform_desc, position_stride=stride)
        options_into(desc, options)
        setattr(desc, "positions" if out.dtype == np.float32 else "positions_f64", address(out))
        if normals is not None:
            normals, desc.normal_stride = output(normals, (self.vertex_count, 3), np.float32, "normals")
            desc.normals = address(normals)
        if info is not None:
            info.struct_size = ctypes.sizeof(info)
        call("hf_pose_deform", self._raw_handle, ctypes.byref(desc), None if info is None else ctypes.byref(info))
        return out

    def skin(self, influence_count: int = 4) -> Skin:
        """The pose as joints and weights."""
        return _skin("hf_pose_get_skin", self._raw_handle, self.vertex_count, influence_count)


class Transfer(Object):
    """The motion of one surface played on another. Options: mode, cluster_count, kernel_width, scale, alignment_angle,
    ground. source_rest, target_rest: poses in which the two correspond, (vertex_count, 3)."""

    _destroy = "hf_transfer_destroy"

    def __init__(self, source: Surface, target: Surface, *, source_axes: Optional[ArrayLike] = None,
        target_axes: Optional[ArrayLike] = None, source_rest: Optional[ArrayLike] = None,
        target_rest: Optional[ArrayLike] = None, **options: Any) -> None:
        desc, handle = make(_raw.hf_transfer_desc), ctypes.c_void_p()
        options_into(desc, options)
        kept = []  # the arrays live until the call is over
        for name, rest, surface in (("source_rest", source_rest, source), ("target_rest", target_rest, target)):
            if rest is None:
                continue
            rows = np.ascontiguousarray(rest, np.float32)
            if rows.size != 3 * surface.vertex_count:
                raise InvalidArgumentError(f"{name} must hold {3 * surface.vertex_count} numbers, not {rows.size}")
            kept.append(rows)
            setattr(desc, name, address(rows))
        for name, axes in (("source_axes", source_axes), ("target_axes", target_axes)):
            if axes is not None:
                setattr(desc, name, (ctypes.c_float * 9)(*doubles(axes, name, 9).ravel()))
        call("hf_transfer_create", handle_of(source, Surface, "source"), handle_of(target, Surface, "target"),
            ctypes.byref(desc), ctypes.byref(handle))
        self._own(handle)
        self.source_vertex_count, self.vertex_count = source.vertex_count, target.vertex_count

    def add_pairs(self, source_regions: Sequence[ArrayLike], target_regions: Sequence[ArrayLike],
        flags: Optional[ArrayLike] = None) -> np.ndarray:
        """Adds pairs of regions; no factorisation. Returns their numbers."""
        (source_counts, source), (target_counts, target) = regions(source_regions,
            "source_regions"), regions(target_regions, "target_regions")
        if source_counts is None or target_counts is None or source_counts.size != target_counts.size:
            raise InvalidArgumentError("source_regions and target_regions must be of one length")
        marks = integers(flags, "flags")
        if marks is not None and marks.size != source_counts.size:
            raise InvalidArgumentError(f"flags must hold {source_counts.size} numbers, not {marks.size}")
        desc = make(_raw.hf_pairs_desc, pair_count=source_counts.size, source_counts=address(source_counts),
            source_vertices=address(source),
                    target_counts=address(target_counts), target_vertices=address(target), flags=address(marks))
        out = np.empty(source_counts.size, np.uint32)
        call("hf_transfer_add_pairs", self._raw_handle, ctypes.byref(desc), address(out))
        return out

    def remove_pairs(self, pairs: ArrayLike) -> None:
        numbers = integers(pairs, "pairs")
        call("hf_transfer_remove_pairs", self._raw_handle, count_of(numbers), address(numbers))

    def pair_info(self, pair: int) -> _raw.hf_pair_info:
        info = make(_raw.hf_pair_info)
        call("hf_transfer_get_pair", self._raw_handle, index(pair, "pair"), ctypes.byref(info))
        return info

    @property
    def info(self) -> _raw.hf_transfer_info:
        return self._read("hf_transfer_get_info", _raw.hf_transfer_info)

    def set_dials(self, **dials: float) -> None:
        """stride, hip_height_share, neck_follow, tail_follow, arm_space, long_follow of the next frames; the others become neutral."""
        desc = make(_raw.hf_transfer_dials)
        options_into(desc, dials)
        call("hf_transfer_set_dials", self._raw_handle, ctypes.byref(desc))

    @property
    def dials(self) -> _raw.hf_transfer_dials:
        return self._read("hf_transfer_get_dials", _raw.hf_transfer_dials)

    def sinking(self) -> np.ndarray:
        """Whether each target vertex may sink into the ground."""
        out = np.empty(self.vertex_count, np.uint8)
        call("hf_transfer_get_sinking", self._raw_handle, address(out))
        return out.astype(bool)

    def apply(self, source_positions: ArrayLike, out: Optional[np.ndarray] = None, *,
        normals: Optional[np.ndarray] = None, dtype: Any = np.float32,
              holds: Optional[ArrayLike] = None, hold_positions: Optional[ArrayLike] = None) -> np.ndarray:
        """One posed frame of the source -> (n, 3) positions of the target.

        holds: pairs whose place hold_positions decides.
        """
        posed, stride = points(source_positions, "source_positions")
        if len(posed) != self.source_vertex_count:
            raise InvalidArgumentError(f"source_positions must have the shape ({self.source_vertex_count}, 3), "
                                       f"not {posed.shape}")
        out, out_stride = output(out, (self.vertex_count, 3), dtype if out is None else (np.float32, np.float64))
        frame = make(_raw.hf_transfer_frame, source_stride=stride, target_stride=out_stride)
        setattr(frame, "source_positions" if posed.dtype == np.float32 else "source_positions_f64", address(posed))
        setattr(frame, "target_positions" if out.dtype == np.float32 else "target_positions_f64", address(out))
        if normals is not None:
            normals, frame.normal_stride = output(normals, (self.vertex_count, 3), np.float32, "normals")
            frame.target_normals = address(normals)
        numbers = integers(holds, "holds")
        if numbers is not None:
            places = doubles(hold_positions, "hold_positions", 3 * numbers.size)
            frame.hold_count, frame.hold_pairs, frame.hold_positions = numbers.size, address(numbers), address(places)
        call("hf_transfer_apply", self._raw_handle, ctypes.byref(frame))
        return out

    def skin(self, influence_count: int = 4) -> Skin:
        return _skin("hf_transfer_get_skin", self._raw_handle, self.vertex_count, influence_count)
