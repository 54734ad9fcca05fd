"""Generated from include/hf/*.h by bindings/generate; do not edit. An exception for each error code."""
# fmt: off

from __future__ import annotations

from typing import Dict, Optional, Type

from . import _raw


class HfError(Exception):
    """A call that failed. code: HF_ERROR_*; name: its name; index: what it is about, or None; function: of the C ABI."""

    code: int = 0
    __str__ = Exception.__str__  # KeyError would show the repr of the message

    def __init__(self, message: str, code: Optional[int] = None, index: Optional[int] = None, function: str = "") -> None:
        self.code = type(self).code if code is None else code
        self.name = _raw.RESULT_NAMES.get(self.code, str(self.code))
        self.index, self.function, self.message = index, function, message
        super().__init__(f"{function + ': ' if function else ''}{message} ({self.name})")



class InvalidArgumentError(HfError, ValueError):
    """a value outside what the function documents arguments and state"""
    code = _raw.HF_ERROR_INVALID_ARGUMENT


class NullPointerError(HfError, TypeError):
    """a required pointer is None"""
    code = _raw.HF_ERROR_NULL_POINTER


class InvalidHandleError(HfError):
    """a handle is None, destroyed or of another kind"""
    code = _raw.HF_ERROR_INVALID_HANDLE


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
    """nothing to work on: no vertices, no triangles, an empty list"""
    code = _raw.HF_ERROR_EMPTY


class DuplicateSiteError(HfError, ValueError):
    """the vertex carries a site already, or is named twice in one batch"""
    code = _raw.HF_ERROR_DUPLICATE_SITE


class NoSuchSiteError(HfError, KeyError):
    """no site of that number in the solver"""
    code = _raw.HF_ERROR_NO_SUCH_SITE


class ConflictError(HfError, ValueError):
    """contradicting values: on welded copies of a vertex, or linearly dependent hard sites"""
    code = _raw.HF_ERROR_CONFLICT


class NoSitesError(HfError):
    """the solver has no site at all; add one before solving"""
    code = _raw.HF_ERROR_NO_SITES


class NoSuchHandleError(HfError, KeyError):
    """no handle of that number in the pose"""
    code = _raw.HF_ERROR_NO_SUCH_HANDLE


class NoSuchPairError(HfError, KeyError):
    """no pair of that number in the transfer"""
    code = _raw.HF_ERROR_NO_SUCH_PAIR


class OverlapError(HfError, ValueError):
    """two handles claim one vertex"""
    code = _raw.HF_ERROR_OVERLAP


class UnsupportedError(HfError, NotImplementedError):
    """not in this build or not for this object; the detail says what to use"""
    code = _raw.HF_ERROR_UNSUPPORTED


class BusyError(HfError):
    """another thread is changing this handle"""
    code = _raw.HF_ERROR_BUSY


class ReentrantError(HfError):
    """called from inside a callback of the same handle"""
    code = _raw.HF_ERROR_REENTRANT


class TooSmallError(HfError, ValueError):
    """a capacity or stride is too small"""
    code = _raw.HF_ERROR_TOO_SMALL


class NoRecordError(HfError):
    """nothing to undo or redo"""
    code = _raw.HF_ERROR_NO_RECORD


class OutOfMemoryError(HfError, MemoryError):
    """the allocator refused; the handle is as before resources"""
    code = _raw.HF_ERROR_OUT_OF_MEMORY


class TooLargeError(HfError, ValueError):
    """beyond a limit; the detail names the limit"""
    code = _raw.HF_ERROR_TOO_LARGE


class CancelledError(HfError):
    """cancelled through the progress object"""
    code = _raw.HF_ERROR_CANCELLED


class NotPositiveDefiniteError(HfError, ArithmeticError):
    """the matrix has a pivot that is not positive: report it with the mesh numerical"""
    code = _raw.HF_ERROR_NOT_POSITIVE_DEFINITE


class InaccurateError(HfError, ArithmeticError):
    """Solver.certify: the field fails its equations"""
    code = _raw.HF_ERROR_INACCURATE


class InternalError(HfError):
    """internal a fault of the library; destroy the handle"""
    code = _raw.HF_ERROR_INTERNAL


EXCEPTIONS: Dict[int, Type[HfError]] = {kind.code: kind for kind in (
    InvalidArgumentError, NullPointerError, InvalidHandleError, InvalidDescError, OutOfRangeError, NonFiniteError,
    EmptyError, DuplicateSiteError, NoSuchSiteError, ConflictError, NoSitesError, NoSuchHandleError,
    NoSuchPairError, OverlapError, UnsupportedError, BusyError, ReentrantError, TooSmallError, NoRecordError,
    OutOfMemoryError, TooLargeError, CancelledError, NotPositiveDefiniteError, InaccurateError, InternalError
)}

__all__ = [
    'HfError', 'EXCEPTIONS', 'InvalidArgumentError', 'NullPointerError', 'InvalidHandleError', 'InvalidDescError',
    'OutOfRangeError', 'NonFiniteError', 'EmptyError', 'DuplicateSiteError', 'NoSuchSiteError', 'ConflictError',
    'NoSitesError', 'NoSuchHandleError', 'NoSuchPairError', 'OverlapError', 'UnsupportedError', 'BusyError',
    'ReentrantError', 'TooSmallError', 'NoRecordError', 'OutOfMemoryError', 'TooLargeError', 'CancelledError',
    'NotPositiveDefiniteError', 'InaccurateError', 'InternalError'
]
