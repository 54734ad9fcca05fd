"""Finds and loads the shared library; turns numpy arrays into pointers and counts; owns handles. What is made from the
headers (_api.py) stands on this."""

from __future__ import annotations

import ctypes
import math
import operator
import os
import pathlib
import sys
from typing import Any, Callable, Dict, Optional, Sequence, Tuple, Union

import numpy as np

from . import _errors, _raw
from ._errors import EmptyError, InvalidArgumentError, NullPointerError, OutOfRangeError, TooSmallError

ArrayLike = Any
NO_INDEX = _raw.HF_NO_INDEX
_TYPES = {"f4": np.float32, "f8": np.float64, "u4": np.uint32, "u2": np.uint16, "u1": np.uint8, "i4": np.int32}
_KINDS: Dict[str, list] = {}
_FIELDS: Dict[type, dict] = {}
_SUFFIX = {"f8": "_f64", "u2": "_u16"}  # the field that takes the other type of array


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
        raise _errors.EXCEPTIONS.get(code, _errors.HfError)(detail.message.decode("utf-8", "replace"), code, index,
                                                            detail.function.decode())


# ---- numbers ----

_INTEGERS: Dict[Any, tuple] = {ctypes.c_int32: (-(1 << 31), (1 << 31) - 1), ctypes.c_uint32: (0, (1 << 32) - 1),
             ctypes.c_size_t: (0, 2 * sys.maxsize + 1)}
_FLOATS: Dict[Any, float] = {ctypes.c_float: float(np.finfo(np.float32).max), ctypes.c_double: float(np.finfo(np.float64).max)}


def number(value: Any, name: str, kind: Any = ctypes.c_uint32, flag: bool = True) -> Any:
    """A number of a C type. ctypes would wrap what does not fit, and take floats and bools for counts; here they are refused by
    name. Flags (int32_t) take bools."""
    is_bool: bool = isinstance(value, (bool, np.bool_))
    if kind in _FLOATS:
        if is_bool or not isinstance(value, (int, float, np.integer, np.floating)):
            raise InvalidArgumentError(f"{name} must be a number, not {value!r}")
        value = value if isinstance(value, int) else float(value)
        if _FLOATS[kind] < abs(value) < float("inf"):
            raise OutOfRangeError(f"{name} is {value}; it must lie within {_FLOATS[kind]:g}")
        return float(value)
    try:
        whole = None if is_bool and not (flag and kind is ctypes.c_int32) else operator.index(int(value) if is_bool else value)
    except TypeError:
        whole = None
    if whole is None:
        raise InvalidArgumentError(f"{name} must be a whole number, not {value!r}")
    low, high = _INTEGERS[kind]
    if not low <= whole <= high:
        raise OutOfRangeError(f"{name} is {whole}; it must lie in {low} to {high}")
    return whole


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


def _whole(array: np.ndarray, name: str, dtype: Any, sentinel: bool) -> np.ndarray:
    """Whole numbers of a type, checked. sentinel: -1 stands for NO_INDEX."""
    if array.size and array.dtype.kind not in "iu":
        raise InvalidArgumentError(f"{name} must be whole numbers, not {array.dtype}")
    limits, flat = np.iinfo(dtype), array.ravel()
    bad: Any = np.flatnonzero((flat < (-1 if sentinel else limits.min)) | (flat > limits.max)) if array.size else ()
    if len(bad):
        raise OutOfRangeError(f"{name} holds {flat[bad[0]]}", index=int(bad[0]))
    return (array & limits.max if sentinel and array.size else array).astype(dtype)


def _types(kinds: str) -> list:
    return _KINDS.get(kinds) or _KINDS.setdefault(kinds, [np.dtype(_TYPES[kind]) for kind in kinds.split()])


def converted(values: ArrayLike, name: str, kinds: str, sentinel: bool = False) -> np.ndarray:
    """An array of one of the types that the library takes ('f4 f8'), as given when it is one."""
    types = _types(kinds)
    if type(values) is np.ndarray and values.dtype in types:
        return values
    array = numbers(values, name)
    if array.dtype in types:
        return array
    if types[-1].kind == "f":
        return array.astype(types[-1])
    if array.dtype.kind == "b" or types[0] == np.int32:
        return array.astype(np.int32)
    if array.dtype == np.int32 and types[0] == np.uint32 and array.flags.c_contiguous and (not array.size or array.min() >= 0):
        return array.view(np.uint32)  # the same bits
    return _whole(array, name, types[0], sentinel)


def address(array: Optional[np.ndarray]) -> Optional[int]:
    """Where an array's memory is; None is NULL."""
    return None if array is None or array.size == 0 else array.__array_interface__["data"][0]


PlaceLike = Union[int, Tuple[Sequence[int], Sequence[float]], _raw.hf_place, _raw.hf_hit]


def place(value: PlaceLike, name: str = "place") -> _raw.hf_place:
    """One place: a vertex, a hit, or the three vertices of a triangle and their weights."""
    if isinstance(value, _raw.hf_hit):
        return value.place  # type: ignore[return-value]
    if isinstance(value, _raw.hf_place):
        return value
    made: Any = _raw.hf_place()
    try:
        corners, weights = ((value,) * 3, (1.0, 0.0, 0.0)) if isinstance(value, (int, np.integer)) else value
        made.corners[:] = [number(corner, name) for corner in corners]
        made.barycentrics[:] = [number(weight, name, ctypes.c_double) for weight in weights]
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{name} must be a vertex, a hit, or three corners and three weights") from None
    return made


def ref(struct: Any) -> Any:
    return None if struct is None else ctypes.byref(struct)


# ---- one call ----

class Call:
    """The arrays of one call, kept until it is over, and the counts that follow from them and from the objects."""

    def __init__(self, *objects: Any, **named: Any) -> None:
        self.n: Dict[str, int] = {}
        self.keep: list = []
        for thing in objects:
            self.n.update(thing._n)
        for name, thing in named.items():
            for key, value in getattr(thing, "_n", {}).items():
                self.n[f"{name}.{key}"] = self.n[key] = value

    def _size(self, dim: Any) -> Optional[int]:
        if dim.__class__ is int:
            return dim
        size = self.n.get(dim)
        if size is None and " + " in dim:
            base, _, more = dim.partition(" + ")
            return None if base not in self.n else self.n[base] + int(more)
        return size

    def _fit(self, array: np.ndarray, name: str, dims: tuple) -> np.ndarray:
        """The array in the shape that dims say; a dimension that is not known yet becomes known."""
        known, loose = 1, None
        sizes: Any = []
        for dim in dims:
            size = dim if dim.__class__ is int else self._size(dim)
            sizes.append(size)
            if size is not None:
                known *= size
            elif loose is None:
                loose = dim
            elif array.ndim != len(dims):
                self._refuse(array, name, dims, sizes)
        if array.ndim == 0 and loose is None:
            return np.full(sizes, array)  # one number for all
        if array.ndim == len(dims) > 1:
            for dim, size, have in zip(dims, sizes, array.shape):
                if size is None:
                    self._learn(dim, have)
                elif size != have:
                    self._refuse(array, name, dims, sizes)
        elif loose is None:
            if array.size != known:
                raise InvalidArgumentError(f"{name} must hold {known} numbers, not {array.size}")
        elif known and array.size % known == 0:
            self._learn(loose, array.size // known)
        elif array.size:
            self._refuse(array, name, dims, sizes)
        else:
            self._learn(loose, 0)
        return array

    def _learn(self, dim: str, size: int) -> None:
        base, _, more = dim.partition(" + ")
        self.n[base] = max(size - int(more or 0), 0)

    def _refuse(self, array: np.ndarray, name: str, dims: tuple, sizes: list) -> None:
        wanted = ", ".join(str(dim if size is None else size) for dim, size in zip(dims, [*sizes, None, None]))
        raise InvalidArgumentError(f"{name} must have the shape ({wanted}), not {array.shape}")

    def array(self, name: str, values: Optional[ArrayLike], kinds: str, dims: tuple, sentinel: bool = False) -> Optional[int]:
        """The address of packed numbers."""
        if values is None:
            return None
        array = np.ascontiguousarray(self._fit(converted(values, name, kinds, sentinel), name, dims))
        self.keep.append(array)
        return address(array)

    def rows(self, desc: Any, field: str, values: Optional[ArrayLike], kinds: str, dims: tuple, stride: str = "",
             sentinel: bool = False, name: str = "") -> None:
        """Sets the pointer of a desc and its stride. Where it has a stride, rows are used in place."""
        if values is None:
            return
        array, name = self._fit(converted(values, name or field, kinds, sentinel), name or field, dims), name or field
        inner = len(dims) == 1 or (array.ndim == 2 and array.strides[1] == array.itemsize)
        row = array.itemsize * (array.shape[1] if array.ndim == 2 else 1)
        if not (stride and array.ndim == len(dims) and inner and row <= array.strides[0] < 1 << 31):
            array = np.ascontiguousarray(array)
        elif len(array) > 1:
            setattr(desc, stride, array.strides[0])
        self.keep.append(array)
        second = kinds.split()[-1]
        other = second in _SUFFIX and " " in kinds and array.dtype == _TYPES[second]
        setattr(desc, field + _SUFFIX[second] if other else field, address(array))

    def struct(self, kind: type, options: Dict[str, Any], prefix: str = "") -> Any:
        """A struct with its size and the scalars among its fields set."""
        made: Any = kind()
        if options:
            types = _FIELDS.get(kind) or _FIELDS.setdefault(kind, dict(f[:2] for f in kind._fields_))  # type: ignore[attr-defined]
            for key, value in options.items():
                if value.__class__ is not int or value:  # a whole 0 is the default of every field
                    setattr(made, key, number(value, key, types[key]))
        self.keep.append(made)
        return made

    def counts(self, desc: Any, **fields: Any) -> None:
        """Sets the counts of a desc. (key, least): least where no array says."""
        for field, (key, least) in fields.items():
            setattr(desc, field, self.n.setdefault(key, least))

    def ragged(self, desc: Any, counts: str, field: str, lists: Optional[Sequence[ArrayLike]], key: str) -> None:
        """Lists of different lengths, one after the other."""
        if lists is None:
            return
        if any(part is None for part in lists):
            raise NullPointerError(f"{field} holds None")
        arrays = [converted(part, f"{field}[{i}]", "u4").ravel() for i, part in enumerate(lists)]
        if self.n.setdefault(key, len(arrays)) != len(arrays):
            raise InvalidArgumentError(f"{field} must hold {self.n[key]} lists, not {len(arrays)}")
        sizes = np.array([part.size for part in arrays], np.uint32)
        together = np.concatenate(arrays) if arrays else np.empty(0, np.uint32)
        self.keep += [sizes, together]
        setattr(desc, counts, address(sizes))
        setattr(desc, field, address(together))

    def fixed(self, struct: Any, field: str, values: Optional[ArrayLike], name: str = "") -> None:
        """A field of a fixed number of numbers."""
        if values is not None:
            into = getattr(struct, field)
            kind = np.dtype(into._type_)
            array = numbers(values, name or field) if kind.kind == "f" else _whole(numbers(values, name or field), name or field, kind, True)
            into[:] = self._fit(array, name or field, (len(into),)).ravel().tolist()

    def records(self, kind: type, dims: tuple, fields: Dict[str, tuple]) -> Optional[int]:
        """Rows of a plain struct, given field by field: field -> (name, values)."""
        given = {field: (name, numbers(values, name)) for field, (name, values) in fields.items() if values is not None}
        types: Any = np.dtype(kind)
        for field, (name, array) in given.items():
            given[field] = (name, self._fit(array, name, (*dims, *types[field].shape)))
        rows: Any = np.zeros(self.n.get(dims[0], 0), types)
        for field, (_, array) in given.items():
            rows[field] = array.reshape(rows[field].shape)
        self.keep.append(rows)
        return address(rows)

    def written(self, name: str, values: Optional[ArrayLike], kind: type, dims: tuple) -> Optional[int]:
        """Records that the library wrote, given back to it."""
        if values is None:
            return None
        if not isinstance(values, np.ndarray) or values.dtype != np.dtype(kind):
            raise InvalidArgumentError(f"{name} must be records of numpy.dtype(hf.constants.{kind.__name__})")
        rows = np.ascontiguousarray(self._fit(values, name, dims))
        self.keep.append(rows)
        return address(rows)

    def places(self, name: str, values: Optional[Sequence[PlaceLike]], dims: tuple) -> Optional[int]:
        """Places in any form, or records of numpy.dtype(hf.constants.hf_place)."""
        if values is None or isinstance(values, np.ndarray) and values.dtype == np.dtype(_raw.hf_place):
            return self.written(name, values, _raw.hf_place, dims)
        rows = np.zeros(len(values), _raw.hf_place)
        for i, value in enumerate(values):
            rows[i] = np.frombuffer(place(value, f"{name}[{i}]"), _raw.hf_place)[0]  # type: ignore[call-overload]
        return self.written(name, rows, _raw.hf_place, dims)

    def text(self, values: Any) -> Optional[int]:
        """Lines in UTF-8: a string, or a list of one for each."""
        if values is None:
            return None
        lines = values if isinstance(values, str) else "".join(str(line).replace("\n", " ") + "\n" for line in values)
        self.keep.append(ctypes.create_string_buffer(lines.encode()))
        return ctypes.addressof(self.keep[-1])

    def bytes(self, desc: Any, field: str, count: str, values: Any) -> None:
        if values is not None:
            try:
                block = np.frombuffer(values, np.uint8)
            except (TypeError, ValueError, BufferError) as error:
                raise InvalidArgumentError(f"{field} must be bytes: {error}") from None
            self.keep.append(block)
            setattr(desc, field, address(block))
            setattr(desc, count, block.size)

    def inner(self, given: Any, first: str, fill: Callable, prefix: str) -> Optional[int]:
        """A desc inside a desc: a dict of its arguments, or its first array alone."""
        if given is None:
            return None
        return ctypes.addressof(fill(self, prefix, **(given if isinstance(given, dict) else {first: given})))

    def known(self, key: str, value: int) -> None:
        if number(value, key):
            self.n[key] = int(value)

    # ---- what comes out ----

    def into(self, struct: Any, room: Dict[str, int], arrays: Dict[str, Any]) -> None:
        for key, value in room.items():
            setattr(struct, key, value)
        for key, array in arrays.items():
            setattr(struct, key, address(array))

    def shape(self, dims: tuple) -> tuple:
        """channel_count and the like leave the shape where they are 1."""
        sizes = [self._size(dim) or 0 for dim in dims]
        return tuple(s for k, (s, dim) in enumerate(zip(sizes, dims)) if not (k and s == 1 and isinstance(dim, str)))

    def out(self, out: Optional[np.ndarray], kinds: str, dims: tuple, dtype: Any = None, name: str = "out") -> tuple:
        """The caller's array, or a new one. Rows may have a stride. Returns (array, stride)."""
        shape, wanted = self.shape(dims), _types(kinds)
        if out is None and dtype is not None and np.dtype(dtype) not in wanted:
            raise InvalidArgumentError(f"dtype must be {' or '.join(map(str, wanted))}, not {dtype}")
        if out is None:
            return np.empty(shape, dtype or wanted[0]), 0
        if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray) or out.dtype not in wanted:
            raise InvalidArgumentError(f"{name} must be an array of {' or '.join(map(str, wanted))}")
        if out.size != math.prod(shape):
            raise TooSmallError(f"{name} must have the shape {shape}, not {out.shape}")
        if not out.flags.writeable:
            raise InvalidArgumentError(f"{name} is read-only")
        if out.flags.c_contiguous:
            return out, 0
        row = out.itemsize * (shape[1] if len(shape) > 1 else 1)
        if out.shape != shape or out.strides[0] < row or (len(shape) > 1 and out.strides[1] != out.itemsize):
            raise InvalidArgumentError(f"{name} may have a stride between rows only")
        return out, out.strides[0]

    def grow(self, owner: Any, function: str, run: Callable, tell: Callable, rooms: Dict[str, Any], arrays: Dict[str, tuple]) -> Any:
        """Arrays of lengths that the library tells. run(room, arrays) calls it, and again with more room when that was too
        little; tell() gives the counts. rooms: capacity -> the first to try, or None: what sufficed last time."""
        memory = owner.__dict__.setdefault("_rooms", {})
        room = {key: memory.get((function, key), 1024) if first is None else first for key, first in rooms.items()}
        while True:
            self.n.update(room)
            blind = any(self._size(dim) is None for _, dims in arrays.values() for dim in dims)  # asks for counts alone
            made: Any = {name: None if blind else np.zeros(self.shape(dims), dtype) for name, (dtype, dims) in arrays.items()}
            try:
                run({key: 0 if blind else value for key, value in room.items()}, made)
                counts = tell()
                if not blind and all(counts[key] <= room[key] for key in room):
                    break
            except TooSmallError:
                counts = tell()
                if all(counts[key] <= room[key] for key in room):
                    raise
            room = {key: counts[key] if blind else max(value, counts[key] + counts[key] // 8) for key, value in room.items()}
            self.n.update({key: value for key, value in counts.items() if key not in room})
        memory.update({(function, key): max(value, 1) for key, value in room.items()})
        self.n.update(counts)
        return {name: array[:self._size(arrays[name][1][0])] for name, array in made.items()}

    def info(self, info: Any, kind: Any) -> Any:
        """A struct of the caller to fill, or NULL."""
        if info is None:
            return None
        if not isinstance(info, kind):
            raise InvalidArgumentError(f"info must be a {kind.__name__}, not {type(info).__name__}")
        return ctypes.byref(info)


class Object:
    """Owns one handle of the library: close() it, use it in a with statement, or leave it to the garbage collector.

    Objects may be closed in any order and more than once. A call on a closed one raises InvalidObjectError.
    """

    _destroy = ""
    _handle: Optional[int] = None
    _open = False
    _counts: tuple = ()  # of the object: how long its arrays are
    _n: Dict[str, int] = {}

    def _own(self, function: str, call_of: Call, *arguments: Any) -> None:
        """Makes the object: the last argument of the function receives its handle."""
        handle = ctypes.c_void_p()
        call(function, *arguments, ctypes.byref(handle))
        self._handle, self._open = handle.value, True
        self._n = {key: value for key, value in call_of.n.items() if key.rpartition(".")[2] in self._counts}

    @property
    def raw_handle(self) -> Optional[int]:
        """The handle of the C ABI."""
        return self._handle

    @property
    def closed(self) -> bool:
        return not self._open

    def close(self) -> None:
        """Gives the memory back. Later calls do nothing."""
        if self._open:
            self._open = False
            getattr(library(), self._destroy)(self._handle)

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
        self._handle, state._handle = state._handle, self._handle
        states.pop()


def handle_of(thing: Any, kind: type, name: str) -> Optional[int]:
    if thing is None:
        return None
    if not isinstance(thing, kind) or not isinstance(thing, Object):
        raise InvalidArgumentError(f"{name} must be a {kind.__name__}, not {type(thing).__name__}")
    return thing._handle
