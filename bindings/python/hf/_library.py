"""Finds and loads the shared library; turns numpy arrays into pointers and counts; owns handles. What is made from the
headers (_api.py) stands on this."""

from __future__ import annotations

import contextlib
import ctypes
import functools
import math
import os
import sys
from typing import Any, Callable, Dict, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np

from . import _errors, _raw
from ._errors import EmptyError, InvalidArgumentError, NullPointerError, OutOfRangeError, TooSmallError

ArrayLike = Any
PlaceLike = Union[int, Tuple[Sequence[int], Sequence[float]], _raw.hf_place, _raw.hf_hit]
This = TypeVar("This", bound="Object")


@functools.lru_cache(None)
def library() -> ctypes.CDLL:
    """The loaded shared library: $HF_LIBRARY, the file inside this package, or the system's."""
    name = {"win32": "hf.dll", "darwin": "libhf.dylib"}.get(sys.platform, "libhf.so.0")
    beside = [os.path.join(os.path.dirname(os.path.abspath(__file__)), n) for n in (name, "libhf.so")]
    given = os.environ.get("HF_LIBRARY")
    tried = []
    for path in [given] if given else [*filter(os.path.exists, beside), name]:
        try:
            return _raw.load(path)
        except (OSError, AttributeError) as error:  # not there, of another version, or too old: a function is missing
            tried.append(f"{path}: {error}")
    raise ImportError("found no hf library; set HF_LIBRARY to libhf.so or put it into the package. " + "; ".join(tried))


def version() -> Tuple[int, ...]:
    """Version of the loaded library: (major, minor, patch)."""
    number = library().hf_version_get()
    return number // 1000000, number // 1000 % 1000, number % 1000


def call(name: str, *arguments: Any) -> None:
    """Calls a function that returns an hf_result; raises the exception of its code."""
    code = getattr(library(), name)(*arguments)
    if code != _raw.HF_OK:
        detail = _raw.hf_error_detail()
        library().hf_error_get_detail(ctypes.byref(detail))
        index = None if detail.index == _raw.HF_NO_INDEX else detail.index
        raise _errors.EXCEPTIONS.get(code, _errors.HfError)(detail.message.decode("utf-8", "replace"), code, index,
                                                            detail.function.decode())


def require(right: Any, words: str, *values: Any, error: Any = InvalidArgumentError, index: Any = None) -> None:
    """Refuses what is not right. The words are put together only then."""
    if not right:
        raise error(words.format(*values), index=index)


# ---- numbers ----

def numbers(values: ArrayLike, name: str) -> np.ndarray:
    """An array of numbers, as given when it is one. Masks, complex numbers, objects and foreign byte order are refused:
    numpy would drop or convert them without a word."""
    for i, row in enumerate(values if isinstance(values, (list, tuple)) else (values,)):
        if isinstance(row, np.ma.MaskedArray) and np.ma.is_masked(row):
            first = int(np.flatnonzero(np.ma.getmaskarray(row))[0]) if row is values else i
            require(False, "{} holds masked values, the first at {}", name, first, index=first)
    try:
        array = np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidArgumentError(f"{name} must be numbers: {error}") from None
    require(array.dtype.kind in "iuf" or not array.size, "{} must be numbers, not {}", name, array.dtype)
    require(array.dtype.isnative, "{} is in foreign byte order ({}); convert it with astype(dtype.newbyteorder('='))",
            name, array.dtype.str)
    return array


@functools.lru_cache(None)
def _types(kinds: Any) -> list:
    return [np.dtype(kind) for kind in (kinds.split() if isinstance(kinds, str) else [kinds])]


def converted(values: ArrayLike, name: str, kinds: Any, sentinel: bool = False) -> np.ndarray:
    """An array of one of the types that the library takes ('f4 f8', or one of ctypes), as given when it is one. sentinel: -1
    stands for NO_INDEX."""
    types = _types(kinds)
    array = values if type(values) is np.ndarray and values.dtype in types else numbers(values, name)
    if array.dtype in types or types[0].kind == "f":
        return array if array.dtype in types else array.astype(types[-1])
    limits, flat = np.iinfo(types[0]), array.ravel()
    require(flat.dtype.kind in "iu" or not flat.size, "{} must be whole numbers, not {}", name, flat.dtype)
    for i in np.flatnonzero((flat < (-1 if sentinel else limits.min)) | (flat > limits.max)):
        require(False, "{} holds {}; it must lie in {} to {}", name, flat[i], limits.min, limits.max,
                error=OutOfRangeError, index=int(i) if array.ndim else None)
    return array.astype(types[0])


def number(value: Any, name: str, kind: Any = ctypes.c_uint32, flag: bool = True) -> Any:
    """A number of a C type. ctypes would wrap what does not fit, and take floats and bools for counts; here they are refused by
    name. Flags (int32_t) take bools."""
    if value.__class__ is int and 0 <= value < 1 << 31:
        return value  # fits every type
    is_flag = flag and kind is ctypes.c_int32 and isinstance(value, (bool, np.bool_))
    array = converted(int(value) if is_flag else value, name, kind)
    require(array.ndim == 0, "{} must be one number, not {!r}", name, value)
    return array.item()


def address(array: Optional[np.ndarray]) -> Optional[int]:
    """Where an array's memory is; None is NULL."""
    return None if array is None or array.size == 0 else array.__array_interface__["data"][0]


def _in_rows(array: np.ndarray) -> bool:
    """Whether the library can use the array where it is: packed rows, with a stride between them."""
    row = array[:1]
    return array.flags.c_contiguous or (row.flags.c_contiguous and row.nbytes <= array.strides[0] < 1 << 31)


def ref(struct: Any, kind: type = object) -> Any:
    """The address of a struct; of one that the caller gave when it is of the right kind."""
    require(isinstance(struct, (kind, type(None))), "info must be a {0.__name__}, not {1.__name__}", kind, type(struct))
    return None if struct is None else ctypes.byref(struct)


def place(value: PlaceLike, name: str = "place") -> Any:
    """One place: a vertex, a hit, or the three vertices of a triangle and their weights."""
    if isinstance(value, (_raw.hf_hit, _raw.hf_place)):
        return getattr(value, "place", value)
    made: Any = _raw.hf_place()
    try:
        corners, weights = ((value,) * 3, (1.0, 0.0, 0.0)) if isinstance(value, (int, np.integer)) else value
        made.corners[:] = [number(corner, name) for corner in corners]
        made.barycentrics[:] = [number(weight, name, ctypes.c_double) for weight in weights]
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{name} must be a vertex, a hit, or three corners and three weights") from None
    return made


# ---- one call ----

class Call:
    """The arrays of one call, kept until it is over, and the counts that follow from them and from the objects."""

    def __init__(self, *objects: Any, **named: Any) -> None:
        self.n: Dict[str, int] = {key: count for thing in objects for key, count in thing._n.items()}
        self.keep: list = []
        for name, thing in named.items():
            for key, count in getattr(thing, "_n", {}).items():
                self.n[f"{name}.{key}"] = self.n[key] = count

    # what goes in

    def size(self, dim: Any) -> Optional[int]:
        """What a dimension such as 'face_count + 1' is; None: not known yet."""
        base, _, more = ("", "", "") if dim.__class__ is int else dim.partition(" + ")
        return dim if dim.__class__ is int else self.n[base] + int(more or 0) if base in self.n else self.n.get(dim)

    def fit(self, array: np.ndarray, name: str, dims: tuple) -> np.ndarray:
        """The array in the shape that dims say; a dimension that is not known yet becomes known."""
        sizes = [self.size(dim) for dim in dims]
        loose = [dim for dim, size in zip(dims, sizes) if size is None]
        known = math.prod(size for size in sizes if size is not None)
        if array.ndim == 0 and not loose:
            return np.full([size or 0 for size in sizes], array)  # one number for all
        found = list(array.shape)
        if array.ndim != len(dims) and len(loose) < 2:  # one after the other
            found = [array.size // (known or 1) if size is None else size for size in sizes]
        right = len(found) == len(dims) and all(size in (None, have) for size, have in zip(sizes, found))
        if not right or math.prod(found) != array.size:
            wanted = ", ".join(str(dim if size is None else size) for dim, size in zip(dims, sizes))
            require(False, "{} must have the shape ({}), not {}", name, wanted, array.shape)
        self.n.update({dim: size for dim, size in zip(dims, found) if dim in loose})
        return array

    def kept(self, array: np.ndarray) -> Optional[int]:
        """The address of packed numbers."""
        self.keep.append(np.ascontiguousarray(array))
        return address(self.keep[-1])

    def array(self, name: str, values: Optional[ArrayLike], kinds: str, dims: tuple, sentinel: bool = False) -> Any:
        return None if values is None else self.kept(self.fit(converted(values, name, kinds, sentinel), name, dims))

    def view(self, name: str, values: Optional[ArrayLike], kinds: str, dims: tuple) -> Any:
        """An hf_array of numbers; rows with a stride are used in place."""
        if values is None:
            return _raw.hf_array()
        array = self.fit(converted(values, name, kinds), name, dims)
        self.keep.append(array if array.ndim == len(dims) and _in_rows(array) else np.ascontiguousarray(array))
        return self.view_out(self.keep[-1], dims, _raw.hf_array)

    def view_out(self, array: np.ndarray, dims: tuple, kind: Any = _raw.hf_array_out) -> Any:
        stride = 0 if array.flags.c_contiguous else array.strides[0]
        number_type = {"d": _raw.HF_TYPE_DOUBLE, "H": _raw.HF_TYPE_UINT16}.get(array.dtype.char, _raw.HF_TYPE_PLAIN)
        return kind(address(array), self.size(dims[0]) or 0, stride, number_type)

    def struct(self, kind: Any, options: Dict[str, Any]) -> Any:
        """A struct with its size and the scalars among its fields set."""
        made, types = kind(), dict(field[:2] for field in kind._fields_) if options else {}
        for key, value in options.items():
            if value.__class__ is not int or value:  # a whole 0 is the default of every field
                setattr(made, key, number(value, key, types[key]))
        self.keep.append(made)
        return made

    def lists(self, name: str, lists: Optional[Sequence[ArrayLike]], dims: tuple) -> tuple:
        """Lists of different lengths, one after the other: where their lengths are, and they."""
        if lists is None:
            return None, None
        require(all(part is not None for part in lists), "{} holds None", name, error=NullPointerError)
        arrays = [converted(part, f"{name}[{i}]", "u4").ravel() for i, part in enumerate(lists)]
        sizes = self.fit(np.array([part.size for part in arrays], np.uint32), name, dims)
        return self.kept(sizes), self.kept(np.concatenate([*arrays, np.empty(0, np.uint32)]))

    def fixed(self, into: Any, name: str, values: Optional[ArrayLike]) -> None:
        """A field of a fixed number of numbers."""
        if values is not None:
            into[:] = self.fit(numbers(values, name), name, (len(into),)).ravel().tolist()

    def records(self, kind: type, dims: tuple, fields: Dict[str, tuple]) -> Optional[int]:
        """Rows of a plain struct, given field by field: field -> (name, values)."""
        types: Any = np.dtype(kind)
        given = {field: self.fit(numbers(values, name), name, (*dims, *types[field].shape))
                 for field, (name, values) in fields.items() if values is not None}
        rows: Any = np.zeros(self.n.get(dims[0], 0), types)
        for field, array in given.items():
            rows[field] = array.reshape(rows[field].shape)
        return self.kept(rows)

    def written(self, name: str, values: Optional[ArrayLike], kind: type, dims: tuple) -> Optional[int]:
        """Records that the library wrote, given back to it."""
        right = values is None or getattr(values, "dtype", None) == np.dtype(kind)
        require(right, "{} must be records of numpy.dtype(hf.constants.{})", name, kind.__name__)
        return None if values is None else self.kept(self.fit(values, name, dims))

    def places(self, name: str, values: Optional[Sequence[PlaceLike]], dims: tuple) -> Optional[int]:
        """Places in any form, or records of numpy.dtype(hf.constants.hf_place)."""
        if values is not None and getattr(values, "dtype", None) != np.dtype(_raw.hf_place):
            made = [np.frombuffer(place(value, f"{name}[{i}]"), _raw.hf_place)[0] for i, value in enumerate(values)]
            values = np.array(made, np.dtype(_raw.hf_place))
        return self.written(name, values, _raw.hf_place, dims)

    def text(self, values: Any) -> Optional[int]:
        """Lines in UTF-8: a string, or a list of one for each."""
        if values is None:
            return None
        lines = values if isinstance(values, str) else "".join(str(line).replace("\n", " ") + "\n" for line in values)
        return self.kept(np.frombuffer(lines.encode() + b"\0", np.uint8))

    def bytes(self, name: str, values: Any) -> tuple:
        """Where bytes are, and how many."""
        block = np.frombuffer(b"" if values is None else values, np.uint8)
        return self.kept(block), block.size

    def inner(self, given: Any, first: str, fill: Callable, prefix: str) -> Optional[int]:
        """A desc inside a desc: a dict of its arguments, or its first array alone."""
        given = given if given is None or isinstance(given, dict) else {first: given}
        return None if given is None else ctypes.addressof(fill(self, prefix, **given))

    # what comes out

    def shape(self, dims: tuple) -> tuple:
        """channel_count and the like leave the shape where they are 1."""
        sizes = [(dim, self.size(dim) or 0) for dim in dims]
        return tuple(size for k, (dim, size) in enumerate(sizes) if k == 0 or size != 1 or isinstance(dim, int))

    def out(self, out: Optional[np.ndarray], kinds: str, dims: tuple, dtype: Any = None, name: str = "out",
            packed: bool = False) -> Any:
        """The caller's array, or a new one. Rows may have a stride, unless they must be packed."""
        shape, wanted = self.shape(dims), _types(kinds)
        if out is None:
            require(dtype is None or np.dtype(dtype) in wanted, "dtype must be one of {}, not {}", wanted, dtype)
            return np.empty(shape, dtype or wanted[0])
        usual = isinstance(out, np.ndarray) and not isinstance(out, np.ma.MaskedArray)
        require(usual and out.dtype in wanted, "{} must be an array of {}", name, wanted)
        fits = out.size == math.prod(shape)
        require(fits, "{} must have the shape {}, not {}", name, shape, out.shape, error=TooSmallError)
        require(out.flags.writeable, "{} is read-only", name)
        require(out.flags.c_contiguous or not packed, "{} must be contiguous", name)
        rows = out.flags.c_contiguous or (out.shape == shape and _in_rows(out))
        require(rows, "{} may have a stride between rows only", name)
        return out

    def into(self, struct: Any, room: Dict[str, int], arrays: Dict[str, Any]) -> None:
        for key, value in {**room, **{key: address(array) for key, array in arrays.items()}}.items():
            setattr(struct, key, value)

    def grow(self, owner: Any, function: str, run: Callable, tell: Callable, rooms: Dict[str, Any],
             arrays: Dict[str, tuple]) -> Any:
        """Arrays of lengths that the library tells. run(room, arrays) calls it, and again with more room when that was too
        little; tell() gives the counts. rooms: capacity -> the first to try, or None: what sufficed last time."""
        memory = owner.__dict__.setdefault("_rooms", {})
        room = {key: memory.get((function, key), 1024) if first is None else first for key, first in rooms.items()}
        done = False
        while not done:
            self.n.update(room)
            made = {name: np.zeros(self.shape(dims), dtype) for name, (dtype, dims) in arrays.items()}
            try:
                run(room, made)
            except TooSmallError:
                if all(count <= room.get(key, count) for key, count in tell().items()):
                    raise
            counts = tell()
            done = all(count <= room[key] if key in room else count == self.n.get(key) for key, count in counts.items())
            self.n.update(counts)
            room = {key: counts[key] for key in room}
            memory.update({(function, key): max(1024, count + count // 8) for key, count in room.items()})
        return {name: array[:self.size(arrays[name][1][0])] for name, array in made.items()}


class Object:
    """Owns one handle of the library: close() it, use it in a with statement, or leave it to the garbage collector.

    Objects may be closed in any order and more than once. A call on a closed one raises InvalidObjectError.
    """

    _destroy = ""
    _handle: Optional[int] = None
    _open = False
    _counts: Tuple[str, ...] = ()  # of the object: how long its arrays are
    _n: Dict[str, int] = {}

    def _own(self, function: str, call_of: Call, *arguments: Any) -> None:
        """Makes the object: the last argument of the function receives its handle."""
        handle = ctypes.c_void_p()
        call(function, *arguments, ctypes.byref(handle))
        self._handle, self._open = handle.value, True
        self._n = {key: count for key, count in call_of.n.items() if key.rpartition(".")[2] in self._counts}
        self._past, self._undone = [], []  # type: ignore[var-annotated]

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

    def __copy__(self: This, memo: Any = None) -> This:
        """A clone, of classes that have one."""
        if not isinstance(self, Recorded):
            raise TypeError(f"hf.{type(self).__name__} cannot be copied; use the same object, or make another one")
        return self.clone()  # type: ignore[attr-defined]

    __deepcopy__ = __copy__

    def __enter__(self: This) -> This:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        with contextlib.suppress(Exception):  # at the end of the interpreter
            self.close()


class Recorded(Object):
    """An object with undo. A record is a clone, so it shares memory with the object."""

    def record(self) -> None:
        """Keeps the present state for undo()."""
        self._past, self._undone = [*self._past, self.clone()], []  # type: ignore[attr-defined]

    def undo(self) -> None:
        """Goes back to the last record, bit for bit. Without one it raises EmptyError."""
        self._exchange(self._past, self._undone, "nothing is recorded; call record() before the edits")

    def redo(self) -> None:
        """Goes to the state before the last undo(). Without one since the last record() it raises EmptyError."""
        self._exchange(self._undone, self._past, "nothing was undone since the last record()")

    def _exchange(self, taken: list, kept: list, nothing: str) -> None:
        if self.closed:
            self.clone()  # type: ignore[attr-defined] # raises what every call on a closed object raises
        try:
            state = taken.pop()  # one step, so that of two threads one gets the record
        except IndexError:
            require(False, nothing, error=EmptyError)
        self._handle, state._handle = state._handle, self._handle
        kept.append(state)


def handle_of(thing: Any, kind: type, name: str) -> Optional[int]:
    require(isinstance(thing, (kind, type(None))), "{} must be a {}, not {}", name, kind.__name__, type(thing).__name__)
    return thing and thing._handle
