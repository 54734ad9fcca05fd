"""bindings/python/hf/_raw.py: ctypes structures, prototypes and constants."""

import textwrap

from comments import first_sentence
from layout import is_pointer

TYPES = {"int32_t": "c_int32", "uint32_t": "c_uint32", "hf_result": "c_int32", "float": "c_float", "double": "c_double",
         "size_t": "c_size_t", "char": "c_char", "uint8_t": "c_uint8", "uint16_t": "c_uint16", "int64_t": "c_int64", "uint64_t": "c_uint64"}
HINTS = {"float": "float", "double": "float", "char": "bytes"}


BASE = '''
class Struct(Structure):
    """A struct of zeros with its size set, shown with its fields."""

    struct_size: int

    def __init__(self, *values: Any, **fields: Any) -> None:
        super().__init__(*values, **fields)
        if self._fields_[0][0] == "struct_size":
            self.struct_size = sizeof(self)

    def __repr__(self) -> str:
        shown: List[str] = []
        for name, *_ in self._fields_:
            value = getattr(self, name)
            if name not in ("struct_size", "reserved"):
                shown.append(f"{name}={list(value) if hasattr(value, '_length_') else value!r}")
        return f"{type(self).__name__}({', '.join(shown)})"

'''.strip("\n").split("\n")


def ctype(api, item):
    if is_pointer(api, item):
        return "c_void_p"
    base = TYPES.get(item["type"], item["type"])
    return f"{base} * {item['count']}" if item.get("count") else base


def hint(api, field):
    if is_pointer(api, field):
        return "int"
    kind = TYPES.get(field["type"], field["type"])
    if field["count"] and field["type"] != "char":
        return f"Array[{kind}]"
    return HINTS.get(field["type"], "int" if field["type"] in TYPES else kind)


def write(api):
    out = ['"""Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI as ctypes sees it."""',
           "# fmt: off",
           "from __future__ import annotations", "",
           "from ctypes import (Array, CDLL, Structure, c_char, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint32, c_void_p, sizeof)",
           "from typing import Any, List", "",
           f'HEADER_VERSION = "{api["version"]}"', "", *BASE]
    out += [f"{c['name']} = {c['value']}" for c in api["constants"]]
    out += ["", "RESULT_NAMES = {",
            *[f"    {c['value']}: \"{c['name']}\"," for c in api["constants"] if c["name"] == "HF_OK"
                or c["name"].startswith("HF_ERROR_")],
            "}", ""]
    for struct in api["structs"]:
        out += ["", f"class {struct['name']}(Struct):"]
        if struct["doc"]:
            out.append(f'    """{first_sentence(struct["doc"])}"""')
        out += [f"    {f['name']}: {hint(api, f)}" for f in struct["fields"]]
        pairs = ", ".join(f"(\"{f['name']}\", {ctype(api, f)})" for f in struct["fields"])
        out += [*textwrap.wrap(f"_fields_ = [{pairs}]", 118, initial_indent="    ", subsequent_indent="                "), ""]
    out += ["", "STRUCTS = [" + ", ".join(s["name"] for s in api["structs"]) + "]", "",
            "# name: (result type, argument types); every pointer and handle is a c_void_p", "PROTOTYPES = {"]
    for function in api["functions"]:
        returns = function["returns"]
        kind = "c_char_p" if returns["type"] == "char" else "None" if returns["type"] == "void" else ctype(api, returns)
        arguments = ", ".join(ctype(api, p) for p in function["parameters"])
        out.append(f"    \"{function['name']}\": ({kind}, [{arguments}]),")
    major, minor, _ = map(int, api["version"].split("."))
    least = major * 1000000 + minor * 1000
    out += ["}", "", "",
            "def load(path: str) -> CDLL:", '    """Loads the shared library and gives every function its prototype."""',
            "    library = CDLL(path)", "    version = library.hf_version_get()", f"    if not {least} <= version < {(least // 1000000 + 1) * 1000000}:",
            f'        raise OSError(f"it is of version {{version // 1000000}}.{{version // 1000 % 1000}}, this package of {api["version"]}; install matching ones")',
            "    for name, (result, arguments) in PROTOTYPES.items():",
            "        function = getattr(library, name)", "        function.restype = result",
            "        function.argtypes = arguments", "    return library"]
    return {"python/hf/_raw.py": "\n".join(out) + "\n"}
