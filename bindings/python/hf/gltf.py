"""Characters from glTF files (and FBX, VRM, COLLADA, BVH where the library has assimp): arrays for surfaces, skeletons and
retargets; clips in and out.

    from hf import gltf
    man = gltf.Model("man.glb")
    surface = man.surface()            # pieces linked by the skeleton
    skeleton = man.skeleton()          # for hf.Retarget and Surface.propose_handles

It needs libhf_gltf, built with -DHF_BUILD_GLTF=ON: $HF_GLTF_LIBRARY, the file beside libhf, or the system's."""

from __future__ import annotations

import ctypes
import functools
import os
import sys
from ctypes import c_char, c_char_p, c_double, c_int32, c_uint32, c_uint64, c_void_p
from typing import Any, Dict, List, NamedTuple, Optional, Union

import numpy as np

from . import _errors, _raw
from ._extended import Surface
from ._api import LinkMode, Skeleton
from ._library import ArrayLike, address, converted, require
from ._library import library as core

__all__ = ["Clip", "Model"]


def _struct(name: str, *fields: Any) -> Any:
    return type(name, (_raw.Struct,), {"_fields_": [("struct_size", c_uint32), *fields]})


_Read = _struct("Read", ("reserved", c_uint32), ("bytes", c_char_p), ("byte_count", c_uint64), ("file", c_char_p))
_Info = _struct("Info", *((name, c_uint32) for name in ("vertex_count", "triangle_count", "clip_count", "joint_count",
                                                        "note_count")), ("has_skin", c_int32), ("name_byte_count", c_uint32))
_Arrays = _struct("Arrays", ("reserved", c_uint32), *((name, c_void_p) for name in ("positions", "triangles", "joints", "weights")))
_Joints = _struct("Joints", ("name_capacity", c_uint32),
                  *((name, c_void_p) for name in ("names", "parents", "rest", "inverse_binds")))
_Clip = _struct("Clip", ("key_count", c_uint32), ("duration", c_double), ("name", c_char * 64))
_Poses = _struct("Poses", ("frame_count", c_uint32), ("name", c_char_p), ("times", c_void_p), ("joints", c_void_p))


@functools.lru_cache(None)
def library() -> ctypes.CDLL:
    """The loaded libhf_gltf."""
    name = {"win32": "hf_gltf.dll", "darwin": "libhf_gltf.dylib"}.get(sys.platform, "libhf_gltf.so.0")
    given, folder = os.environ.get("HF_GLTF_LIBRARY"), os.path.dirname(core()._name)
    beside = [os.path.join(folder, *parts) for parts in ((name,), ("gltf", name))] if folder else []
    tried = []
    for path in [given] if given else [*filter(os.path.exists, beside), name]:
        try:
            return ctypes.CDLL(path)
        except OSError as error:
            tried.append(f"{path}: {error}")
    raise ImportError("found no hf_gltf library; build it with -DHF_BUILD_GLTF=ON and set HF_GLTF_LIBRARY to libhf_gltf.so. "
                      + "; ".join(tried))


def _call(name: str, *arguments: Any) -> None:
    code = getattr(library(), name)(*arguments)
    if code != _raw.HF_OK:
        detail = _raw.hf_error_detail()
        library().hf_gltf_error_get_detail(ctypes.byref(detail))
        index = None if detail.index == _raw.HF_NO_INDEX else detail.index
        raise _errors.EXCEPTIONS.get(code, _errors.HfError)(detail.message.decode("utf-8", "replace"), code, index,
                                                            detail.function.decode())


class Clip(NamedTuple):
    """A clip of a model. duration: seconds."""
    name: str
    duration: float


class Model:
    """A model that was read. Its arrays are those of the rest pose, in the space of the scene.

    positions: (n, 3) of double. triangles: (m, 3). joints, weights: (n, 8) rows of a skin. names, parents: of each joint;
    every node of the file is one. rest: (j, 10) translation, rotation x y z w, scale, relative to the parent.
    inverse_binds: (j, 16) columns first, or None without a skin. clips: a list of Clip. notes: sentences about the file.
    """

    def __init__(self, file: Union[str, "os.PathLike[str]", bytes]) -> None:
        handle = c_void_p()
        given = file if isinstance(file, bytes) else None
        name = None if given is not None else os.fsencode(os.fspath(file))  # type: ignore[arg-type]
        _call("hf_gltf_model_read", ctypes.byref(_Read(bytes=given, byte_count=len(given or b""), file=name)), ctypes.byref(handle))
        self._handle: Optional[c_void_p] = handle
        info = _Info()
        _call("hf_gltf_model_get_info", handle, ctypes.byref(info))
        n, j = info.vertex_count, info.joint_count
        self.positions, self.triangles = np.zeros((n, 3)), np.zeros((info.triangle_count, 3), np.uint32)
        self.joints, self.weights = np.zeros((n, 8), np.uint16), np.zeros((n, 8), np.float32)
        if n:
            _call("hf_gltf_model_get_surface", handle, ctypes.byref(_Arrays(positions=address(self.positions), triangles=address(
                self.triangles), joints=address(self.joints), weights=address(self.weights))))
        text, self.parents = ctypes.create_string_buffer(info.name_byte_count), np.zeros(j, np.uint32)
        self.rest, binds = np.zeros((j, 10), np.float32), np.zeros((j, 16), np.float32)
        _call("hf_gltf_model_get_skeleton", handle, ctypes.byref(_Joints(
            name_capacity=info.name_byte_count, names=ctypes.addressof(text), parents=address(self.parents),
            rest=address(self.rest), inverse_binds=address(binds))))
        self.names: List[str] = text.value.decode("utf-8", "replace").split("\n")[:j]
        self.inverse_binds: Optional[np.ndarray[Any, Any]] = binds if info.has_skin else None
        note = ctypes.create_string_buffer(1024)
        self.notes: List[str] = []
        for i in range(info.note_count):
            _call("hf_gltf_model_get_note", handle, i, len(note), note)
            self.notes.append(note.value.decode("utf-8", "replace"))

    @property
    def clips(self) -> List[Clip]:
        info, clip = _Info(), _Clip()
        found: List[Clip] = []
        _call("hf_gltf_model_get_info", self._handle, ctypes.byref(info))
        for i in range(info.clip_count):
            _call("hf_gltf_model_get_clip", self._handle, i, ctypes.byref(clip))
            found.append(Clip(clip.name.decode("utf-8", "replace"), clip.duration))
        return found

    def links(self) -> Dict[str, Any]:
        """For Surface(links=...): pieces are joined as the skeleton joins them."""
        return {"mode": LinkMode.PIECES, "joints": self.joints, "weights": self.weights, "joint_parents": self.parents}

    def surface(self, **options: Any) -> Surface:
        """A surface of the model, with links between its pieces. options: those of Surface."""
        return Surface(self.positions, self.triangles, **{"links": self.links(), **options})

    def skeleton(self, **options: Any) -> Skeleton:
        """The skeleton of the model with its skin. options: those of Skeleton, such as up and forward."""
        skin: Optional[Dict[str, Any]] = {"positions": self.positions.astype(np.float32), "triangles": self.triangles,
                "joints": self.joints.astype(np.uint32), "weights": self.weights, "at_rest": True}
        if not len(self.positions):
            skin = None
        return Skeleton(self.names, self.parents, self.rest, **{"inverse_binds": self.inverse_binds, "skin": skin, **options})

    def pose(self, clip: int, time: float) -> "np.ndarray[Any, Any]":
        """The vertices in a clip at a time in seconds: (n, 3)."""
        out = np.zeros(self.positions.shape)
        _call("hf_gltf_model_pose", self._handle, c_uint32(clip), c_double(time), c_void_p(address(out)))
        return out

    def pose_joints(self, clip: int, time: float) -> "np.ndarray[Any, Any]":
        """The joints in a clip at a time in seconds, for Retarget.solve: (j, 10)."""
        out = np.zeros(self.rest.shape, np.float32)
        _call("hf_gltf_model_pose_joints", self._handle, c_uint32(clip), c_double(time), c_void_p(address(out)))
        return out

    def add_clip(self, name: str, times: ArrayLike, poses: ArrayLike) -> None:
        """Adds a clip, as the first. times: (f,) in seconds, increasing, from 0 on. poses: (f, j, 10) as pose_joints."""
        at = np.ascontiguousarray(converted(times, "times", "f8"))
        joints = np.ascontiguousarray(converted(poses, "poses", "f4"))
        shape = (*at.shape, *self.rest.shape)
        require(joints.shape == shape, "poses must have the shape {}, not {}", shape, joints.shape)
        _call("hf_gltf_model_add_joint_clip", self._handle, ctypes.byref(_Poses(
            frame_count=len(at), name=name.encode(), times=address(at), joints=address(joints))))

    def save(self, file: Union[str, "os.PathLike[str]"]) -> None:
        """Writes .glb or .gltf by its ending."""
        _call("hf_gltf_model_save", self._handle, os.fsencode(os.fspath(file)))

    def close(self) -> None:
        """Gives the memory back. Later calls raise InvalidObjectError."""
        if self._handle is not None:
            library().hf_gltf_model_destroy(self._handle)
        self._handle = None

    def __del__(self) -> None:
        if getattr(self, "_handle", None) is not None and library is not None:
            self.close()

    def __repr__(self) -> str:
        return f"hf.gltf.Model({len(self.positions)} vertices, {len(self.names)} joints, {len(self.clips)} clips)"
