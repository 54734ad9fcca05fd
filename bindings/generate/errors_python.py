"""bindings/python/hf/_errors.py: an exception for each error code."""

import textwrap

from plan import camel
from words import wrapped

BUILTIN = {  # errors that Python has a word for
    "INVALID_ARGUMENT": "ValueError", "NULL_POINTER": "TypeError", "OUT_OF_RANGE": "IndexError", "NON_FINITE": "ValueError",
    "EMPTY": "ValueError", "DUPLICATE": "ValueError", "NOT_FOUND": "KeyError",
    "NOT_FOUND": "KeyError", "NOT_FOUND": "KeyError", "DUPLICATE": "ValueError", "CONFLICT": "ValueError",
    "CONFLICT": "ValueError", "UNSUPPORTED": "NotImplementedError", "TOO_SMALL": "ValueError", "OUT_OF_MEMORY": "MemoryError",
    "TOO_LARGE": "ValueError", "NOT_POSITIVE_DEFINITE": "ArithmeticError", "INACCURATE": "ArithmeticError"}


def error_name(constant):
    return camel(constant[len("HF_ERROR_"):].lower()) + "Error"


def block(text, indent):
    """A docstring, wrapped."""
    lines = wrapped(text, 118 - indent)
    lines[0] = '"""' + lines[0]
    if len(lines) == 1 and len(lines[0]) + indent + 3 < 120:
        lines[0] += '"""'
    else:
        lines.append('"""')
    return [(" " * indent + line).rstrip() for line in lines]


ERRORS = '''"""Generated from include/hf/*.h by bindings/generate; do not edit. An exception for each error code."""
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

'''


def errors(api, words):
    out, names = [ERRORS], []
    for constant in api["constants"]:
        if constant["name"].startswith("HF_ERROR_"):
            name, kind = error_name(constant["name"]), BUILTIN.get(constant["name"][len("HF_ERROR_"):])
            names.append(name)
            out += ["", f"class {name}({'HfError' + (', ' + kind if kind else '')}):"]
            out += block(words.say(constant["doc"]), 4) if constant.get("doc") else []
            out += [f"    code = _raw.{constant['name']}", ""]
    out += ["", "EXCEPTIONS: Dict[int, Type[HfError]] = {kind.code: kind for kind in (" ,
            *["    " + line for line in textwrap.wrap(", ".join(names), 110)], ")}", "", "__all__ = [",
            *["    " + line for line in textwrap.wrap(", ".join(repr(n) for n in ["HfError", "EXCEPTIONS", *names]), 110)], "]"]
    return "\n".join(out) + "\n"
