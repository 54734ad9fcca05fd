"""Generated from include/hf/*.h by bindings/generate; do not edit. An exception for each error code."""
# fmt: off

from __future__ import annotations

from typing import Dict, Optional, Type

from . import _raw


class HfError(Exception):
    """A call that failed. code: HF_ERROR_*; name: its name; index: what it is about, or None; function: of the C ABI."""

    code: int = 0
    name: str
    index: Optional[int]
    function: str
    message: str

    def __str__(self) -> str:
        return Exception.__str__(self)  # KeyError would show the repr of the message

    def __init__(self, message: str, code: Optional[int] = None, index: Optional[int] = None, function: str = "") -> None:
        self.code = type(self).code if code is None else code
        self.name = _raw.RESULT_NAMES.get(self.code, str(self.code))
        self.index, self.function, self.message = index, function, message
        super().__init__(f"{function + ': ' if function else ''}{message} ({self.name})")



class InvalidArgumentError(HfError, ValueError):
    """a value outside the documented range"""
    code = _raw.HF_ERROR_INVALID_ARGUMENT


class NullPointerError(HfError, TypeError):
    """a required pointer is None"""
    code = _raw.HF_ERROR_NULL_POINTER


class InvalidObjectError(HfError):
    """an object is None, destroyed or of another kind"""
    code = _raw.HF_ERROR_INVALID_OBJECT


class InvalidDescError(HfError):
    """struct_size is too small, or a byte is set that this version does not know"""
    code = _raw.HF_ERROR_INVALID_DESC


class OutOfRangeError(HfError, IndexError):
    """an index beyond its array; the detail names it"""
    code = _raw.HF_ERROR_OUT_OF_RANGE


class NonFiniteError(HfError, ValueError):
    """NaN or infinity in an input; the detail names where"""
    code = _raw.HF_ERROR_NON_FINITE


class EmptyError(HfError, ValueError):
    """nothing to work on: a mesh without triangles, an empty list, no site, no handle"""
    code = _raw.HF_ERROR_EMPTY


class NotFoundError(HfError, KeyError):
    """no site, handle or pair of that number"""
    code = _raw.HF_ERROR_NOT_FOUND


class DuplicateError(HfError, ValueError):
    """a thing is there already, or is named twice in one batch"""
    code = _raw.HF_ERROR_DUPLICATE


class ConflictError(HfError, ValueError):
    """contradicting values on welded copies, linearly dependent hard sites, or regions that overlap"""
    code = _raw.HF_ERROR_CONFLICT


class UnsupportedError(HfError, NotImplementedError):
    """not in this build or not for this object; the detail says what to use"""
    code = _raw.HF_ERROR_UNSUPPORTED


class BusyError(HfError):
    """another thread is changing this object"""
    code = _raw.HF_ERROR_BUSY


class ReentrantError(HfError):
    """called from inside a callback of the same object"""
    code = _raw.HF_ERROR_REENTRANT


class TooSmallError(HfError, ValueError):
    """a capacity or stride is too small"""
    code = _raw.HF_ERROR_TOO_SMALL


class OutOfMemoryError(HfError, MemoryError):
    """the allocator refused; the object is as before"""
    code = _raw.HF_ERROR_OUT_OF_MEMORY


class TooLargeError(HfError, ValueError):
    """beyond a limit; the detail names the limit"""
    code = _raw.HF_ERROR_TOO_LARGE


class CancelledError(HfError):
    """cancelled through the progress object"""
    code = _raw.HF_ERROR_CANCELLED


class NotPositiveDefiniteError(HfError, ArithmeticError):
    """the matrix has a pivot that is not positive: report it with the mesh"""
    code = _raw.HF_ERROR_NOT_POSITIVE_DEFINITE


class InaccurateError(HfError, ArithmeticError):
    """Solver.certify: the field fails its equations"""
    code = _raw.HF_ERROR_INACCURATE


class InternalError(HfError):
    """a fault of the library; destroy the object"""
    code = _raw.HF_ERROR_INTERNAL


EXCEPTIONS: Dict[int, Type[HfError]] = {kind.code: kind for kind in (
    InvalidArgumentError, NullPointerError, InvalidObjectError, InvalidDescError, OutOfRangeError, NonFiniteError,
    EmptyError, NotFoundError, DuplicateError, ConflictError, UnsupportedError, BusyError, ReentrantError,
    TooSmallError, OutOfMemoryError, TooLargeError, CancelledError, NotPositiveDefiniteError, InaccurateError,
    InternalError
)}

__all__ = [
    'HfError', 'EXCEPTIONS', 'InvalidArgumentError', 'NullPointerError', 'InvalidObjectError', 'InvalidDescError',
    'OutOfRangeError', 'NonFiniteError', 'EmptyError', 'NotFoundError', 'DuplicateError', 'ConflictError',
    'UnsupportedError', 'BusyError', 'ReentrantError', 'TooSmallError', 'OutOfMemoryError', 'TooLargeError',
    'CancelledError', 'NotPositiveDefiniteError', 'InaccurateError', 'InternalError'
]
