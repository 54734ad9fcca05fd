"""Skin weights of a surface from a skeleton (hf/weights.h)."""

from __future__ import annotations

import ctypes
from enum import IntEnum, IntFlag
from typing import Any, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _raw
from ._library import ArrayLike, InvalidArgumentError, Recorded, address, call, handle_of, integers, make
from .surface import Progress, Surface


class Origin(IntEnum):
    """How the weights of a vertex were found."""
    INFORMED, SOLVED, PINNED = _raw.HF_WEIGHTS_INFORMED, _raw.HF_WEIGHTS_SOLVED, _raw.HF_WEIGHTS_PINNED
    CARRIED, RIGID, ISOLATED = _raw.HF_WEIGHTS_NEAREST, _raw.HF_WEIGHTS_RIGID, _raw.HF_WEIGHTS_ISOLATED
    MATCHED, KEPT = _raw.HF_WEIGHTS_MATCHED, _raw.HF_WEIGHTS_KEPT


class JointFlag(IntFlag):
    """Why a joint deserves a look."""
    NO_LENGTH, COINCIDENT = _raw.HF_JOINT_NO_LENGTH, _raw.HF_JOINT_COINCIDENT
    INFORMS_NONE, OUTSIDE, HELPER = _raw.HF_JOINT_INFORMS_NONE, _raw.HF_JOINT_OUTSIDE, _raw.HF_JOINT_HELPER


class HelperReason(IntFlag):
    """Why a joint looks like a helper that should not deform."""
    PROPOSED, NAME_ROOT = _raw.HF_HELPER_PROPOSED, _raw.HF_HELPER_NAME_ROOT
    NAME_CONTROL, NAME_END = _raw.HF_HELPER_NAME_CONTROL, _raw.HF_HELPER_NAME_END
    ROOT, APART, NO_LENGTH = _raw.HF_HELPER_ROOT, _raw.HF_HELPER_APART, _raw.HF_HELPER_NO_LENGTH
    COINCIDENT, OUTSIDE = _raw.HF_HELPER_COINCIDENT, _raw.HF_HELPER_OUTSIDE
    INFORMS_NONE = _raw.HF_HELPER_INFORMS_NONE


class MirrorTo(IntEnum):
    """Which side of the plane takes the weights of the other."""
    NEGATIVE, POSITIVE, BOTH = _raw.HF_MIRROR_TO_NEGATIVE, _raw.HF_MIRROR_TO_POSITIVE, _raw.HF_MIRROR_BOTH


class Pairing(IntEnum):
    """How a joint found its partner."""
    ALONE, NAMED, PLACED = _raw.HF_MIRROR_JOINT_ALONE, _raw.HF_MIRROR_JOINT_NAMED, _raw.HF_MIRROR_JOINT_PLACED
    CENTRE, GIVEN = _raw.HF_MIRROR_JOINT_CENTRE, _raw.HF_MIRROR_JOINT_GIVEN


class VertexWeights(NamedTuple):
    joints: np.ndarray  # (vertices, 4 or 8) uint32
    weights: np.ndarray  # the same shape, float32; rows descend and sum to 1
    origins: np.ndarray  # (vertices,) uint8, Origin


def _rows(values: ArrayLike, count: Optional[int], name: str) -> np.ndarray:
    rows = np.ascontiguousarray(values, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3 or (count is not None and len(rows) != count):
        raise InvalidArgumentError(f"{name} must have the shape ({'n' if count is None else count}, 3), not {rows.shape}")
    return rows


def _lines(names: Optional[Sequence[str]]) -> Optional[ctypes.Array]:
    """Names of joints as the library takes them: one line for each."""
    if names is None:
        return None
    return ctypes.create_string_buffer("".join(name.replace("\n", " ") + "\n" for name in names).encode())


def _given(surface: "Surface", joints: ArrayLike, weights: ArrayLike) -> Tuple[np.ndarray, np.ndarray]:
    joints, shares = np.ascontiguousarray(joints, dtype=np.uint32), np.ascontiguousarray(weights, dtype=np.float32)
    if joints.ndim != 2 or joints.shape != shares.shape or len(joints) != surface.vertex_count:
        raise InvalidArgumentError(f"joints and weights must have the shape ({surface.vertex_count}, n), not {joints.shape} "
                                   f"and {shares.shape}")
    return joints, shares


def _room(vertex_count: int, influence_count: int) -> Any:
    shape = (vertex_count, influence_count)
    found = VertexWeights(np.empty(shape, np.uint32), np.empty(shape, np.float32), np.empty(vertex_count, np.uint8))
    out = make(_raw.hf_weights_out, vertex_capacity=vertex_count)
    out.joints, out.weights, out.origins = (address(array) for array in found)
    return found, out


def transfer_weights(source: Surface, joints: ArrayLike, weights: ArrayLike, target: Surface, *, distance: float = 0.0,
                  angle: float = 0.0, influence_count: int = 4, progress: Optional[Progress] = None) -> Any:
    """Carries weights to another surface: clothes, levels of detail. joints, weights: (vertices of the source, n).
    distance, angle (radians): how near a point and its normal must be; 0: the library's own. Returns the weights and
    an hf_weights_transfer_info."""
    first, second = handle_of(source, Surface, "source"), handle_of(target, Surface, "target")
    joints, shares = _given(source, joints, weights)
    influence_count = influence_count or 4
    desc = make(_raw.hf_weights_transfer_desc, source_influence_count=joints.shape[1], joints=address(joints), weights=address(shares),
                distance=distance, angle=angle, influence_count=influence_count,
                progress=handle_of(progress, Progress, "progress"))
    found, out = _room(target.vertex_count, influence_count)
    info = make(_raw.hf_weights_transfer_info)
    call("hf_weights_transfer", first, second, ctypes.byref(desc), ctypes.byref(out), ctypes.byref(info))
    return found, info


class Mirrored(NamedTuple):
    weights: VertexWeights
    partners: np.ndarray  # (joints,) uint32, the joint of the other side
    pairings: np.ndarray  # (joints,) uint32, Pairing
    info: _raw.hf_weights_mirror_info


def mirror_weights(surface: Surface, joints: ArrayLike, weights: ArrayLike, heads: ArrayLike, *,
                   names: Optional[Sequence[str]] = None, partners: Optional[ArrayLike] = None,
                   plane: Optional[ArrayLike] = None, to: int = MirrorTo.NEGATIVE, distance: float = 0.0,
                   angle: float = 0.0, influence_count: int = 4, progress: Optional[Progress] = None) -> Mirrored:
    """Mirrors weights of one side to the other. heads: (joints, 3). names: of the joints, to pair them. partners: -1 for
    those to find. plane: a point and a normal; None: find it."""
    handle = handle_of(surface, Surface, "surface")
    joints, shares = _given(surface, joints, weights)
    influence_count = influence_count or 4
    points, lines = _rows(heads, None, "heads"), _lines(names)
    desc = make(_raw.hf_weights_mirror_desc, joint_count=len(points), heads=address(points), source_influence_count=joints.shape[1],
                to=int(to), joints=address(joints), weights=address(shares), distance=distance, angle=angle,
                influence_count=influence_count, progress=handle_of(progress, Progress, "progress"))
    if lines is not None:
        desc.names = ctypes.addressof(lines)
    given = _list(partners, np.int64, len(points), "partners")
    if given is not None:
        given = (given & 0xFFFFFFFF).astype(np.uint32)
        desc.partners = address(given)
    flat = _list(plane, np.float64, 6, "plane")
    if flat is not None:
        desc.plane = address(flat)
    found, out = _room(surface.vertex_count, influence_count)
    pairs, pairings = np.empty(len(points), np.uint32), np.empty(len(points), np.uint32)
    info = make(_raw.hf_weights_mirror_info)
    call("hf_weights_mirror", handle, ctypes.byref(desc), ctypes.byref(out), address(pairs), address(pairings),
         ctypes.byref(info))
    return Mirrored(found, pairs, pairings, info)


def _list(values: Optional[ArrayLike], dtype: Any, size: int, name: str) -> Optional[np.ndarray]:
    if values is None:
        return None
    array = np.ascontiguousarray(values, dtype=dtype).reshape(-1)
    if array.size != size:
        raise InvalidArgumentError(f"{name} must have {size} entries, not {array.size}")
    return array


class Weights(Recorded):
    """Skin weights of a surface. heads, tails, axes: (joints, 3); parents: -1 for a root; deforms: 0 or 1 by joint."""

    _destroy = "hf_weights_destroy"

    def __init__(self, surface: Surface, heads: ArrayLike, *, tails: Optional[ArrayLike] = None,
                 axes: Optional[ArrayLike] = None, parents: Optional[ArrayLike] = None,
                 deforms: Optional[ArrayLike] = None, influence_count: int = 4,
                 progress: Optional[Progress] = None) -> None:
        parent, handle = handle_of(surface, Surface, "surface"), ctypes.c_void_p()
        desc, _keep = self._joints(heads, tails, axes, parents, deforms, None, progress)
        call("hf_weights_create", parent, ctypes.byref(desc), influence_count, ctypes.byref(handle))
        self._own(handle)
        self.vertex_count = surface.vertex_count

    @staticmethod
    def _joints(heads: ArrayLike, tails: Any, axes: Any, parents: Any, deforms: Any, sources: Any,
               progress: Optional[Progress]) -> Any:
        h = _rows(heads, None, "heads")
        desc = make(_raw.hf_joints_desc, joint_count=len(h), heads=address(h),
                    progress=handle_of(progress, Progress, "progress"))
        keep = [h]
        for name, values in (("tails", tails), ("axes", axes)):
            if values is not None:
                keep.append(_rows(values, len(h), name))
                setattr(desc, name, address(keep[-1]))
        for name, values, dtype in (("parents", parents, np.int64), ("deforms", deforms, np.int32),
                                    ("sources", sources, np.int64)):
            array = _list(values, dtype, len(h), name)
            if array is not None:
                keep.append(array if dtype == np.int32 else (array & 0xFFFFFFFF).astype(np.uint32))
                setattr(desc, name, address(keep[-1]))
        return desc, keep

    def clone(self) -> "Weights":
        handle = ctypes.c_void_p()
        call("hf_weights_clone", self._raw_handle, ctypes.byref(handle))
        copy = Weights.__new__(Weights)
        copy._own(handle)
        copy.vertex_count = self.vertex_count
        return copy

    def set_joints(self, heads: ArrayLike, *, tails: Optional[ArrayLike] = None, axes: Optional[ArrayLike] = None,
                  parents: Optional[ArrayLike] = None, deforms: Optional[ArrayLike] = None,
                  sources: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> None:
        """Replaces all joints. sources: the number each joint had before, -1 for a new one; None: the same numbers."""
        desc, _keep = self._joints(heads, tails, axes, parents, deforms, sources, progress)
        call("hf_weights_set_joints", self._raw_handle, ctypes.byref(desc))

    def set_pins(self, vertices: ArrayLike, joints: ArrayLike, weights: ArrayLike, *,
                 radii: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> None:
        """Replaces all pins: vertices whose weights are given. joints, weights: (pins, 1 to 8). No vertices: no pins."""
        places = integers(vertices, "vertices")
        count = 0 if places is None else places.size
        desc = make(_raw.hf_pins_desc, pin_count=count, progress=handle_of(progress, Progress, "progress"))
        if count:
            joints = np.ascontiguousarray(joints, dtype=np.uint32).reshape(count, -1)
            shares = np.ascontiguousarray(weights, dtype=np.float32).reshape(count, -1)
            if joints.shape != shares.shape:
                raise InvalidArgumentError(f"joints and weights have the shapes {joints.shape} and {shares.shape}")
            sizes = _list(radii, np.float64, count, "radii")
            desc.vertices, desc.influence_count = address(places), joints.shape[1]
            desc.joints, desc.weights = address(joints), address(shares)
            if sizes is not None:
                desc.radii = address(sizes)
        call("hf_weights_set_pins", self._raw_handle, ctypes.byref(desc))

    def set_locks(self, joints: ArrayLike, values: Optional[ArrayLike] = None) -> None:
        """Locks joints: their weights stay. values: (vertices, joints); None: the present weights. Replaces all locks."""
        locked = np.ascontiguousarray(joints, dtype=np.uint32).reshape(-1)
        kept = _list(values, np.float32, self.vertex_count * locked.size, "values")
        call("hf_weights_set_locks", self._raw_handle, locked.size, address(locked) if locked.size else None,
             None if kept is None else address(kept))

    def weights(self) -> VertexWeights:
        out = make(_raw.hf_weights_out)
        call("hf_weights_get", self._raw_handle, ctypes.byref(out))
        shape = (out.vertex_count, out.influence_count)
        found = VertexWeights(np.empty(shape, np.uint32), np.empty(shape, np.float32), np.empty(shape[0], np.uint8))
        out.vertex_capacity = out.vertex_count
        out.joints, out.weights, out.origins = (address(array) for array in found)
        call("hf_weights_get", self._raw_handle, ctypes.byref(out))
        return found

    def joints(self) -> Any:
        """Flags (JointFlag) of every joint, and how many vertices ask for it."""
        count = ctypes.c_uint32()
        call("hf_weights_get_joints", self._raw_handle, 0, None, None, ctypes.byref(count))
        flags, counts = np.empty(count.value, np.uint32), np.empty(count.value, np.uint32)
        call("hf_weights_get_joints", self._raw_handle, count.value, address(flags), address(counts), None)
        return flags, counts

    def helpers(self, names: Optional[Sequence[str]] = None) -> np.ndarray:
        """Why each joint looks like a helper (HelperReason). names: one for each joint; None: by places alone."""
        count, lines = ctypes.c_uint32(), _lines(names)
        call("hf_weights_get_helpers", self._raw_handle, None, 0, None, ctypes.byref(count))
        reasons = np.empty(count.value, np.uint32)
        call("hf_weights_get_helpers", self._raw_handle, None if lines is None else ctypes.addressof(lines), count.value,
             address(reasons), None)
        return reasons

    def info(self) -> _raw.hf_weights_info:
        info = make(_raw.hf_weights_info)
        call("hf_weights_get_info", self._raw_handle, ctypes.byref(info))
        return info
