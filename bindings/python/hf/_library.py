"""Finds and loads the shared library; exceptions from result codes; arrays in and out without copies; owned handles."""

from __future__ import annotations

import ctypes
import operator
import os
import pathlib
import sys
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _raw

ArrayLike = Any
NO_INDEX = _raw.HF_NO_INDEX


class HfError(Exception):
    """A call that failed. code: HF_ERROR_*; name: its name; index: what it is about, or None; function: of the C ABI."""

    code: int = 0

    def __init__(self, message: str, code: Optional[int] = None, index: Optional[int] = None,
        function: str = "") -> None:
        self.code = type(self).code if code is None else code
        self.name = _raw.RESULT_NAMES.get(self.code, str(self.code))
        self.index, self.function, self.message = index, function, message
        super().__init__(f"{function + ': ' if function else ''}{message} ({self.name})")


class InvalidArgumentError(HfError, ValueError): code = _raw.HF_ERROR_INVALID_ARGUMENT
class NullPointerError(HfError, TypeError): code = _raw.HF_ERROR_NULL_POINTER
class InvalidObjectError(HfError): code = _raw.HF_ERROR_INVALID_OBJECT
class InvalidDescError(HfError): code = _raw.HF_ERROR_INVALID_DESC
class OutOfRangeError(HfError, IndexError): code = _raw.HF_ERROR_OUT_OF_RANGE
class NonFiniteError(HfError, ValueError): code = _raw.HF_ERROR_NON_FINITE
class EmptyError(HfError, ValueError): code = _raw.HF_ERROR_EMPTY
class DuplicateError(HfError, ValueError): code = _raw.HF_ERROR_DUPLICATE
class NotFoundError(HfError, KeyError): code = _raw.HF_ERROR_NOT_FOUND
class ConflictError(HfError, ValueError): code = _raw.HF_ERROR_CONFLICT
class UnsupportedError(HfError, NotImplementedError): code = _raw.HF_ERROR_UNSUPPORTED
class BusyError(HfError): code = _raw.HF_ERROR_BUSY
class ReentrantError(HfError): code = _raw.HF_ERROR_REENTRANT
class TooSmallError(HfError, ValueError): code = _raw.HF_ERROR_TOO_SMALL
class OutOfMemoryError(HfError, MemoryError): code = _raw.HF_ERROR_OUT_OF_MEMORY
class TooLargeError(HfError, ValueError): code = _raw.HF_ERROR_TOO_LARGE
class CancelledError(HfError): code = _raw.HF_ERROR_CANCELLED
class NotPositiveDefiniteError(HfError, ArithmeticError): code = _raw.HF_ERROR_NOT_POSITIVE_DEFINITE
class InaccurateError(HfError, ArithmeticError): code = _raw.HF_ERROR_INACCURATE
class InternalError(HfError): code = _raw.HF_ERROR_INTERNAL


EXCEPTIONS = {cls.code: cls for cls in HfError.__subclasses__()}
for _cls in EXCEPTIONS.values():  # KeyError would show the repr of the message
    _cls.__str__ = Exception.__str__  # type: ignore[method-assign]


def _candidates() -> list:
    given = os.environ.get("HF_LIBRARY")
    if given:
        return [given]
    name = {"win32": "hf.dll", "darwin": "libhf.dylib"}.get(sys.platform, "libhf.so.0")
    beside = [pathlib.Path(__file__).resolve().parent / n for n in (name, "libhf.so")]
    return [str(path) for path in beside if path.exists()] + [name]


_loaded: Optional[ctypes.CDLL] = None


def library() -> ctypes.CDLL:
    """The loaded shared library: $HF_LIBRARY, the file inside this package, or the system's."""
    global _loaded
    if _loaded is None:
        tried = []
        for path in _candidates():
            try:
                _loaded = _raw.load(path)
                break
            except (OSError, AttributeError) as error:  # not there, or too old: a function is missing
                tried.append(f"{path}: {error}")
        if _loaded is None:
            raise ImportError("the hf library was not found; set HF_LIBRARY to libhf.so, or put it beside the package. "
                              + "; ".join(tried))
        _check_version(_loaded.hf_version_get())
    return _loaded


def _check_version(loaded: int) -> None:
    major, minor, patch = (int(part) for part in _raw.HEADER_VERSION.split("."))
    if loaded // 1000000 != major or loaded < major * 1000000 + minor * 1000:
        raise ImportError(f"the hf library is of version {loaded // 1000000}.{loaded // 1000 % 1000}.{loaded % 1000}, "
                          f"this package of {_raw.HEADER_VERSION}; install matching ones")


def call(name: str, *arguments: Any) -> None:
    """Calls a function that returns an hf_result; raises the exception of its code."""
    lib = library()
    code = getattr(lib, name)(*arguments)
    if code != _raw.HF_OK:
        detail = _raw.hf_error_detail()
        lib.hf_error_get_detail(ctypes.byref(detail))
        index = None if detail.index == NO_INDEX else detail.index
        raise EXCEPTIONS.get(code, HfError)(detail.message.decode("utf-8", "replace"), code, index,
            detail.function.decode())


_INTEGERS = {ctypes.c_int32: (-(1 << 31), (1 << 31) - 1), ctypes.c_uint32: (0, (1 << 32) - 1),
             ctypes.c_size_t: (0, 2 * sys.maxsize + 1)}
_FLOATS = {ctypes.c_float: float(np.finfo(np.float32).max), ctypes.c_double: float(np.finfo(np.float64).max)}
_types: dict = {}  # struct -> field -> ctypes type


def _type_of(struct: type, key: str) -> Any:
    if struct not in _types:
        _types[struct] = {field[0]: field[1] for field in struct._fields_}
    return _types[struct][key]


def whole(value: Any, name: str, low: int = 0, high: int = NO_INDEX) -> int:
    """A whole number in a range. Floats and bools are refused: they are slips where a count or an index is asked for."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or isinstance(value, (bool, np.bool_)):
        raise InvalidArgumentError(f"{name} must be a whole number, not {value!r}")
    if not low <= number <= high:
        raise OutOfRangeError(f"{name} is {number}; it must lie in {low} to {high}")
    return number


def real(value: Any, name: str, largest: float = float(np.finfo(np.float64).max)) -> float:
    """A number; float32 fields do not turn what is too large into infinity."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InvalidArgumentError(f"{name} must be a number, not {value!r}")
    if largest < abs(value) < float("inf"):
        raise OutOfRangeError(f"{name} is {value}; it must lie within {largest:g}")
    return float(value)


def put(desc: Any, key: str, value: Any, name: str) -> None:
    """Sets a field of a desc. ctypes would wrap what does not fit; here it is an error that names it. Flags take bools."""
    kind = _type_of(type(desc), key)
    if kind in _INTEGERS:
        flag = kind is ctypes.c_int32 and isinstance(value, (bool, np.bool_))
        value = int(value) if flag else whole(value, name, *_INTEGERS[kind])
    elif kind in _FLOATS:
        value = real(value, name, _FLOATS[kind])
    setattr(desc, key, value)


def make(struct: type, **fields: Any) -> Any:
    """A desc with every byte zero but its size and the given fields."""
    desc = struct()
    desc.struct_size = ctypes.sizeof(struct)
    for key, value in fields.items():
        put(desc, key, value, key)
    return desc


# what the package fills in itself; without corners, face_count is a wish and not the length of an array
_OWN = ("struct_size", "reserved", "vertex_count", "triangle_count", "face_count", "corner_count", "edge_count",
        "site_count", "crease_count", "guide_count", "irregular_count")


def options_into(desc: Any, options: dict) -> None:
    """Sets the named scalar options of a desc; an unknown one is an error that names it."""
    allowed = {f[0] for f in desc._fields_ if f[1] in _INTEGERS or f[1] in _FLOATS}
    own = _OWN if "corner_count" in allowed else tuple(name for name in _OWN if name != "face_count")
    allowed = {name for name in allowed if name not in own and not name.endswith("_stride")}
    for key, value in options.items():
        if key not in allowed:
            raise InvalidArgumentError(f"no option '{key}'; there are: {', '.join(sorted(allowed))}")
        put(desc, key, value, f"option '{key}'")


def numbers(values: ArrayLike, name: str) -> np.ndarray:
    """An array of numbers, as given when it is one. Masks, complex numbers, objects and foreign byte order are refused:
    numpy would drop or convert them without a word."""
    rows = values if isinstance(values, (list, tuple)) else (values,)
    masked = [i for i, row in enumerate(rows) if isinstance(row, np.ma.MaskedArray) and np.ma.is_masked(row)]
    if masked:
        first = masked[0] if rows is values else int(np.flatnonzero(np.ma.getmaskarray(values))[0])
        raise InvalidArgumentError(f"{name} holds masked values, the first at {first}", index=first)
    try:
        array = np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidArgumentError(f"{name} must be numbers: {error}") from None
    if array.dtype.kind not in "iuf" and array.size:
        raise InvalidArgumentError(f"{name} must be numbers, not {array.dtype}")
    if not array.dtype.isnative:
        raise InvalidArgumentError(f"{name} is in foreign byte order ({array.dtype.str}); "
                                   "convert it with astype(dtype.newbyteorder('='))")
    return array


def address(array: Optional[np.ndarray]) -> Optional[int]:
    """Where an array's memory is; None is NULL."""
    return None if array is None or array.size == 0 else array.__array_interface__["data"][0]


def integers(values: Optional[ArrayLike], name: str) -> Optional[np.ndarray]:
    """uint32, as given when it is that already."""
    if values is None:
        return None
    array = numbers(values, name)
    if array.dtype == np.int32 and array.flags.c_contiguous and (array.size == 0 or array.min() >= 0):
        array = array.view(np.uint32)  # the same bits
    if array.dtype != np.uint32:
        if array.size and array.dtype.kind not in "iu":
            raise InvalidArgumentError(f"{name} must be whole numbers, not {array.dtype}")
        bad = np.flatnonzero((array.ravel() < 0) | (array.ravel() > NO_INDEX)) if array.size else ()
        if len(bad):
            raise OutOfRangeError(f"{name} holds {array.ravel()[bad[0]]}", index=int(bad[0]))
        array = array.astype(np.uint32)
    return np.ascontiguousarray(array)


def corners(values: Optional[ArrayLike], name: str) -> tuple:
    """Rows of three corners in uint32 or uint16 with any stride between rows, without a copy. Returns (array, stride)."""
    if values is None:
        return None, 0
    array = numbers(values, name)
    rows = array.ndim == 2 and array.shape[1] == 3
    if array.size % 3 or (array.ndim == 2 and not rows):
        raise InvalidArgumentError(f"{name} must have the shape (m, 3), not {array.shape}")
    in_place = rows and array.dtype in (np.uint16, np.uint32) and array.strides[1] == array.itemsize
    if not in_place or not 3 * array.itemsize <= array.strides[0] < 1 << 31:
        array = (np.ascontiguousarray(array) if array.dtype == np.uint16 else integers(array, name)).reshape(-1, 3)
    return array, array.strides[0] if len(array) > 1 else 0


def faces_into(desc: Any, faces: Any) -> list:
    """Sets the faces of a desc: (m, k) corners, (offsets, corners) or (starts, sizes, corners). Returns what to keep."""
    if isinstance(faces, tuple):
        if len(faces) not in (2, 3):
            raise InvalidArgumentError("faces must be (offsets, corners) or (starts, sizes, corners)")
        starts, sizes = integers(faces[0], "faces[0]"), integers(faces[1], "faces[1]") if len(faces) == 3 else None
        around = integers(faces[-1], f"faces[{len(faces) - 1}]")
        if around is None or (starts is None and sizes is None):
            raise NullPointerError("faces holds no corners, or neither starts nor sizes")
        if starts is not None and sizes is not None and starts.size != sizes.size:
            raise InvalidArgumentError(f"faces holds {starts.size} starts, but {sizes.size} sizes")
        count = max(starts.size - 1, 0) if sizes is None else sizes.size
    else:
        around = integers(faces, "faces")
        if around.ndim != 2 or around.shape[1] < 3:
            raise InvalidArgumentError(f"faces must have the shape (m, 3) or wider, not {around.shape}")
        count, starts = len(around), None
        sizes = np.full(count, around.shape[1], np.uint32)
    desc.face_count, desc.corner_count = count, around.size
    desc.face_starts, desc.face_sizes, desc.corners = address(starts), address(sizes), address(around)
    return [starts, sizes, around]


def index(value: Any, name: str) -> int:
    """One whole number for a uint32 parameter."""
    return whole(value, name)


def count_of(array: Optional[np.ndarray]) -> int:
    """Elements of a list; a missing list counts one, so that the library says what is missing."""
    return 1 if array is None else array.size


def paired(sites: ArrayLike, vertices: ArrayLike) -> tuple:
    """Numbers of sites and as many vertices."""
    numbers, at = integers(sites, "sites"), integers(vertices, "vertices")
    if numbers is None or at is None or numbers.size != at.size:
        raise InvalidArgumentError("sites and vertices must be of one length")
    return numbers, at


def scalars(field: Optional[ArrayLike], vertex_count: int) -> tuple:
    """A field as the library reads it, in place where it can be. Returns (desc or None, what to keep alive)."""
    if field is None:
        return None, None
    array = numbers(field, "field")
    fits = array.dtype in (np.float32, np.float64) and array.ndim == 1 and array.size == vertex_count
    if not fits or array.strides[0] <= 0:
        array = doubles(field, "field", vertex_count).ravel()
    desc = make(_raw.hf_scalars, value_stride=array.strides[0])
    setattr(desc, "values" if array.dtype == np.float32 else "values_f64", address(array))
    return desc, array


def doubles(values: Optional[ArrayLike], name: str, count: Optional[int] = None) -> Optional[np.ndarray]:
    """float64, as given when it is that already; count: how many numbers there must be."""
    if values is None:
        return None
    array = np.ascontiguousarray(numbers(values, name), dtype=np.float64)
    if count is not None and array.size != count:
        raise InvalidArgumentError(f"{name} must hold {count} numbers, not {array.size}")
    return array


def points(values: ArrayLike, name: str) -> tuple:
    """Rows of xyz in float32 or float64 with any stride between rows, without a copy. Returns (array, stride)."""
    if values is None:
        raise NullPointerError(f"{name} is None")
    array = numbers(values, name)
    if array.dtype not in (np.float32, np.float64):
        array = array.astype(np.float64)
    if array.ndim == 1 and array.size % 3 == 0:
        array = np.ascontiguousarray(array).reshape(-1, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidArgumentError(f"{name} must have the shape (n, 3), not {array.shape}")
    if array.strides[1] != array.itemsize or array.strides[0] < 3 * array.itemsize or array.strides[0] >= 1 << 31:
        array = np.ascontiguousarray(array)
    return array, array.strides[0] if len(array) > 1 else 0


def output(out: Optional[np.ndarray], shape: tuple, dtype: Any, name: str = "out") -> tuple:
    """The caller's array, or a new one; any stride between rows. Returns (array, stride)."""
    if out is None:
        return np.empty(shape, dtype), 0
    wanted = [np.dtype(t) for t in (dtype if isinstance(dtype, tuple) else (dtype,))]
    if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray) or out.dtype not in wanted:
        raise InvalidArgumentError(f"{name} must be an array of {' or '.join(str(t) for t in wanted)}")
    if out.size != int(np.prod(shape)):
        raise TooSmallError(f"{name} must have the shape {shape}, not {out.shape}")
    if not out.flags.writeable:
        raise InvalidArgumentError(f"{name} is read-only")
    row = out.itemsize * (shape[1] if len(shape) > 1 else 1)
    if out.flags.c_contiguous:
        return out, 0
    if out.shape != tuple(shape) or out.strides[0] < row or (len(shape) > 1 and out.strides[1] != out.itemsize):
        raise InvalidArgumentError(f"{name} may have a stride between rows only")
    return out, out.strides[0]


def regions(lists: Optional[Sequence[ArrayLike]], name: str) -> tuple:
    """Lists of vertices one after the other. Returns (counts, vertices)."""
    if lists is None:
        return None, None
    arrays = [integers(region, f"{name}[{i}]") for i, region in enumerate(lists)]
    if any(a is None for a in arrays):
        raise NullPointerError(f"{name} holds None")
    counts = np.array([a.size for a in arrays], np.uint32)
    return counts, np.concatenate([a.ravel() for a in arrays]) if arrays else np.empty(0, np.uint32)


class Object:
    """Owns one handle of the library: close() it, use it in a with statement, or leave it to the garbage collector.

    Objects may be closed in any order and more than once. A call on a closed one raises InvalidObjectError.
    """

    _destroy = ""
    _raw_handle: Optional[int] = None
    _open = False

    def _own(self, handle: ctypes.c_void_p) -> None:
        self._raw_handle, self._open = handle.value, True

    def _read(self, function: str, struct: type) -> Any:
        """A struct that a function of this object fills."""
        info = make(struct)
        call(function, self._raw_handle, ctypes.byref(info))
        return info

    @property
    def handle(self) -> Optional[int]:
        """The handle of the C ABI."""
        return self._raw_handle

    @property
    def closed(self) -> bool:
        return not self._open

    def close(self) -> None:
        """Gives the memory back. Later calls do nothing."""
        if self._open:
            self._open = False
            getattr(library(), self._destroy)(self._raw_handle)

    def __reduce_ex__(self, protocol: Any) -> Any:
        """A handle means nothing in another process, and two owners would close it twice."""
        raise TypeError(f"hf.{type(self).__name__} cannot be pickled: it lives in the memory of this process. "
                        "Send positions and triangles, or the bytes of Surface.save()")

    def __copy__(self) -> Any:
        """A clone, of classes that have one."""
        clone = getattr(self, "clone", None)
        if clone is None:
            raise TypeError(f"hf.{type(self).__name__} cannot be copied; use the same object, or make another one")
        return clone()

    def __deepcopy__(self, _memo: dict) -> Any:
        return self.__copy__()

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        try:
            self.close()
        except Exception:  # at the end of the interpreter
            pass


class Recorded(Object):
    """An object with undo. A record is a clone, so it shares memory with the object."""

    def record(self) -> None:
        """Keeps the present state for undo()."""
        self._past, self._undone = [*getattr(self, "_past", []), self.clone()], []

    def undo(self) -> None:
        """Goes back to the last record, bit for bit. Without one it raises EmptyError."""
        self._exchange("_past", "_undone")

    def redo(self) -> None:
        """Goes to the state before the last undo(). Without one since the last record() it raises EmptyError."""
        self._exchange("_undone", "_past")

    def _exchange(self, taken: str, kept: str) -> None:
        if self.closed:
            self.clone()  # raises what every call on a closed object raises
        states = getattr(self, taken, [])
        if not states:
            raise EmptyError("nothing is recorded; call record() before the edits" if taken == "_past" else
                             "nothing was undone since the last record()")
        state = states[-1]
        setattr(self, kept, [*getattr(self, kept, []), state])
        self._raw_handle, state._raw_handle = state._raw_handle, self._raw_handle
        states.pop()


def handle_of(thing: Optional[Union[Object, int]], kind: type, name: str) -> Optional[int]:
    if thing is None:
        return None
    if not isinstance(thing, kind):
        raise InvalidArgumentError(f"{name} must be a {kind.__name__}, not {type(thing).__name__}")
    return thing._raw_handle
