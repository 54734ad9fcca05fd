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
    code = _raw.HF_ERROR_INVALID_ARGUMENT


class NullPointerError(HfError, TypeError):
    code = _raw.HF_ERROR_NULL_POINTER


class InvalidHandleError(HfError):
    code = _raw.HF_ERROR_INVALID_HANDLE


class InvalidDescError(HfError):
    code = _raw.HF_ERROR_INVALID_DESC


class OutOfRangeError(HfError, IndexError):
    code = _raw.HF_ERROR_OUT_OF_RANGE


class NonFiniteError(HfError, ValueError):
    code = _raw.HF_ERROR_NON_FINITE


class EmptyError(HfError, ValueError):
    code = _raw.HF_ERROR_EMPTY


class DuplicateSiteError(HfError, ValueError):
    code = _raw.HF_ERROR_DUPLICATE_SITE


class NoSuchSiteError(HfError, KeyError):
    code = _raw.HF_ERROR_NO_SUCH_SITE


class ConflictError(HfError, ValueError):
    code = _raw.HF_ERROR_CONFLICT


class NoSitesError(HfError):
    code = _raw.HF_ERROR_NO_SITES


class NoSuchHandleError(HfError, KeyError):
    code = _raw.HF_ERROR_NO_SUCH_HANDLE


class NoSuchPairError(HfError, KeyError):
    code = _raw.HF_ERROR_NO_SUCH_PAIR


class OverlapError(HfError, ValueError):
    code = _raw.HF_ERROR_OVERLAP


class UnsupportedError(HfError, NotImplementedError):
    code = _raw.HF_ERROR_UNSUPPORTED


class BusyError(HfError):
    code = _raw.HF_ERROR_BUSY


class ReentrantError(HfError):
    code = _raw.HF_ERROR_REENTRANT


class TooSmallError(HfError, ValueError):
    code = _raw.HF_ERROR_TOO_SMALL


class NoRecordError(HfError):
    code = _raw.HF_ERROR_NO_RECORD


class OutOfMemoryError(HfError, MemoryError):
    code = _raw.HF_ERROR_OUT_OF_MEMORY


class TooLargeError(HfError, ValueError):
    code = _raw.HF_ERROR_TOO_LARGE


class CancelledError(HfError):
    code = _raw.HF_ERROR_CANCELLED


class NotPositiveDefiniteError(HfError, ArithmeticError):
    code = _raw.HF_ERROR_NOT_POSITIVE_DEFINITE


class InaccurateError(HfError, ArithmeticError):
    code = _raw.HF_ERROR_INACCURATE


class InternalError(HfError):
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
