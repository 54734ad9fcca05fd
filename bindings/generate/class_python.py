"""bindings/python/hf/_api.py and _errors.py: classes, enums, results and errors of the Python package. What _library.py does by
hand: arrays to pointers and counts, room for arrays that grow, handles."""

import re
import textwrap

from errors_python import block, error_name, errors
from layer_python import TYPES as CTYPES
from model import named, symbols
from plan import PLACE, camel, classes, counts_of, dims_used, edits, moves, recorded
from steps import Planner, desc_steps, field_steps, least
from words import Words, class_words, fold, method_words

KINDS = {"float": "f4", "double": "f8", "uint32_t": "u4", "uint16_t": "u2", "uint8_t": "u1", "int32_t": "i4"}
NUMPY = {"float": "float32", "double": "float64", "uint32_t": "uint32", "int32_t": "int32", "uint16_t": "uint16", "uint8_t": "uint8"}
RESERVED = {"from", "in", "is", "not", "and", "or", "with", "as", "def", "class", "return", "pass", "lambda", "None", "True", "False",
            "global", "import", "raise", "try", "while", "for", "if", "else", "del", "self", "c", "run", "call"}
HINTS = {"array": "Optional[ArrayLike]", "lists": "Optional[Sequence[ArrayLike]]", "fixed": "Optional[ArrayLike]", "desc": "Any",
         "text": "Union[None, str, Sequence[str]]", "blob": "Optional[bytes]", "out": "Optional[np.ndarray[Any, Any]]", "type": "Any",
         "fill": "Optional[np.ndarray[Any, Any]]", "place": "PlaceLike", "request": "bool"}


def safe(name):
    return name + "_" if name in RESERVED else name


class Spoken:
    null, no_index, error = "None", "NO_INDEX", staticmethod(error_name)

    def constant(self, enum, member):
        return f"{camel(enum['name'])}.{member['name'][len(enum['prefix']):]}"

    def enum(self, enum):
        return camel(enum["name"])

    def method(self, m):
        return m.title()

    def shape(self, sizes):
        return "(" + ", ".join(sizes) + ("," if len(sizes) == 1 else "") + ")"


class Steps:
    """Steps of plan.py as lines of Python."""

    def __init__(self, writer, in_filler=None):
        self.w, self.filler = writer, in_filler

    def lines(self, op, values):
        return getattr(self, "do_" + op)(**values)

    def dims(self, dims):
        """A tuple; the counts of an inner desc have a prefix of their own."""
        counted = {f["name"] for f in self.filler.counts} if self.filler else set()
        keys = [d if d.isdigit() else f"prefix + {d!r}" if symbols([d]) & counted else repr(d) for d in dims]
        return "(" + ", ".join(keys) + ("," if len(keys) == 1 else "") + ")"

    def kinds(self, item, twin=None):
        return KINDS[item["type"]] + (" " + KINDS[twin["type"]] if twin else "")

    def value(self, v):
        kind, *rest = v
        if kind == "number":
            name, item = rest
            return f"number({safe(name)}, '{name}', ctypes.{CTYPES[item['type']]}{', flag=False' if item['role'] == 'enum' else ''})"
        return {"self": "self._handle", "null": "None"}.get(kind) or {
            "handle": "handle_of({0}, {1}, '{2}')", "place": "ref(place({0}, '{raw}'))", "ref": "ref({0})", "ref_if": "None if {1} is None else ref({0})",
            "var": "{0}", "text": "c.text({0})", "figure": "ref({0})", "address": "address({0})", "count": "c.n.setdefault('{raw}', 1)",
            "info": "ref({0}, _raw.{type})", "room": "room['{raw}']", "grown": "address(made['{raw}'])", "literal": "{raw}",
            "size_of": "{0}.size"}[kind].format(safe(rest[0]), camel(rest[1]) if kind == "handle" else rest[1] if len(rest) > 1 else "", rest[0],
                                                raw=rest[0], type=rest[-1])

    def do_forget(self, key):
        return [f"c.n.pop('{key}', None)  # of the list given here"]

    def do_known(self, key, default):
        given = f"number({safe(key)}, '{key}')"
        return [f"c.n['{key}'] = {given} or {default}"] if default else [f"if {given}:", f"    c.n['{key}'] = {safe(key)}"]

    def do_struct(self, var, type, fields):
        options = ", ".join(f"'{name}': {safe(name)}" for name in fields)
        return [f"{safe(var)} = c.struct(_raw.{type}, {{{options}}})"]

    def do_desc(self, var, struct, names, prefix):
        ahead = f", '{prefix}'" if prefix else ""
        return [f"{var} = _{struct.name[3:]}(c{ahead}{''.join(f', {safe(n)}={safe(n)}' for n in names)})"]

    def do_record(self, var, type, fields, dims):
        return [f"{var} = _raw.{type}()"] + [f"c.fixed({var}.{f['name']}, '{name}', {safe(name)})" for f, name in fields]

    def do_records(self, var, type, fields, dims):
        given = ", ".join(f"'{f['name']}': ('{name}', {safe(name)})" for f, name in fields)
        return [f"{var} = c.records(_raw.{type}, {self.dims(dims)}, {{{given}}})"]

    def do_array(self, var, name, item):
        if item["view"]:
            return [f"{safe(var)} = c.view('{name}', {safe(name)}, '{self.kinds(item, item['twin'])}', {self.dims(item['dims'])})"]
        return [f"{var} = c.array('{name}', {safe(name)}, '{self.kinds(item)}', {self.dims(item['dims'])}{', sentinel=True' if item['sentinel'] else ''})"]

    def do_rows(self, struct, field, name, var="desc"):
        shape = self.dims(field["dims"])
        for missing, other in field["without"].items():
            shape = f"{self.dims(other)} if {safe(missing)} is None else {shape}"
        if field["view"]:
            return [f"{var}.{field['name']} = c.view('{name}', {safe(name)}, '{self.kinds(field, field['twin'])}', {shape})"]
        extra = ", sentinel=True" if field["sentinel"] else ""
        return [f"{var}.{field['name']} = c.array('{name}', {safe(name)}, '{self.kinds(field)}', {shape}{extra})"]

    def do_fields(self, struct, var):
        """Arrays, handles and descs of a struct, then the counts that follow."""
        lines = []
        for op, values in field_steps(self.w.api, struct):
            lines += self.do_rows(**values, var=var) if op == "rows" else getattr(self, "field_" + op)(var, **values)
        for f in struct.inner:
            inner = self.w.structs[f["type"]]
            first = next((g["name"] for g, ahead in inner.asked() if ahead), "")
            lines.append(f"{var}.{f['name']} = c.inner({safe(f['name'])}, '{first}', _{f['type'][3:]}, '{f['name']}.')")
        pre = "prefix + " if self.filler else ""
        return lines + [f"{var}.{f['name']} = c.n.setdefault({pre}'{f['name']}', {least(f)})" for f in struct.counts]

    def field_ragged(self, var, counts, field):
        return [f"{var}.{counts['name']}, {var}.{field['name']} = c.lists('{field['name']}', {safe(field['name'])}, {self.dims(counts['dims'])})"]

    def field_written(self, var, field):
        if field["type"] == PLACE:
            return [f"{var}.{field['name']} = c.places('{field['name']}', {safe(field['name'])}, {self.dims(field['dims'])})"]
        return [f"{var}.{field['name']} = c.written('{field['name']}', {safe(field['name'])}, _raw.{field['type']}, {self.dims(field['dims'])})"]

    def field_blob(self, var, field, count):
        return [f"{var}.{field['name']}, {var}.{count} = c.bytes('{field['name']}', {safe(field['name'])})"]

    def field_text(self, var, field):
        return [f"{var}.{field['name']} = c.text({safe(field['name'])})"]

    def field_fixed(self, var, field):
        return [f"c.fixed({var}.{field['name']}, '{field['name']}', {safe(field['name'])})"]

    def field_handle(self, var, field):
        return [f"{var}.{field['name']} = handle_of({safe(field['name'])}, {camel(field['type'])}, '{field['name']}')"]

    def do_out(self, var, item, twin, given):
        extra = ", dtype" if given and twin else ""
        extra += "" if item["view"] else ", packed=True"
        return [f"{safe(var)} = c.out({safe(var) if given else 'None'}, '{self.kinds(item, twin)}', {self.dims(item['dims'])}{extra})"]

    def do_view(self, var, name, item):
        return [f"{safe(var)} = c.view_out({safe(name)}, {self.dims(item['dims'])})"]

    def do_fill(self, var, item, twin, given):
        kinds, packed = self.kinds(item, item.get("twin")), "" if item["view"] else ", packed=True"
        return [f"if {safe(var)} is not None:", f"    {safe(var)} = c.out({safe(var)}, '{kinds}', {self.dims(item['dims'])}, name='{var}'{packed})"]

    def do_point(self, var, field, twin, optional):
        value = f"c.view_out({safe(var)}, {self.dims(field['dims'])})" if field["view"] else f"address({safe(var)})"
        return [f"{'    ' if optional else ''}desc.{field['name']} = {value}"]

    def do_scalar(self, var, item):
        return [f"{safe(var)} = ctypes.{CTYPES[item['type']]}()"]

    def do_info(self, var, type, optional):
        return [f"{safe(var)} = {safe(var) + ' or ' if optional else ''}c.struct(_raw.{type}, {{}})"]

    def do_call(self, function, values):
        lines = [f"call({', '.join([repr(function), *map(self.value, values)])})"]
        return lines + (["self._n['vertex_count'] = surface._n['vertex_count']"] if moves(function) else [])

    def do_returns(self, function, values):
        return []

    def do_make(self, made, function, values, kind):
        lines = [] if made == "self" else [f"made = {'cls.__new__(cls)' if kind == 'create' else 'type(self).__new__(type(self))'}"]
        lines += ["c.n.update(self._n)"] if kind in ("clone", "derive") else []
        lines += [f"{made}._own({', '.join([repr(function), 'c', *map(self.value, values)])})"]
        return lines + ([f"{made}._n['vertex_count'] = {made}.info.vertex_count"] if edits(function) else [])

    def do_bytes(self, function, first, second):
        return ["size = ctypes.c_size_t()", *self.do_call(function, first), "block = np.empty(size.value, np.uint8)", *self.do_call(function, second)]

    def do_grow(self, function, owner, values, tell, rooms, arrays, into):
        lines = ["count = ctypes.c_uint32()"] if any(var == "count" for _, var, _ in tell) else []
        tells = ", ".join(f"'{key}': {var}.{field or 'value'}" for key, var, field in tell)
        room = ", ".join(f"'{key}': c.n.get('{known}')" if known else f"'{key}': None" for key, known in rooms)
        made = []
        for name, item, on_request in arrays:
            inner = named(self.w.api["structs"], item["type"])
            kind = f"np.dtype(_raw.{item['type']})" if inner else f"np.{NUMPY[item['type']]}"
            entry = f"'{safe(name)}': ({kind}, {self.dims(item['dims'])})"
            made.append(f"**({{{entry}}} if {safe(name)} else {{}})" if on_request else entry)
        lines += ["", "def run(room: Any, made: Any) -> None:"] + ([f"    c.into({into}, room, made)"] if into else [])
        lines += ["    " + line for line in self.do_call(function, values)]
        lines += ["", f"found = c.grow({owner if owner == 'self' else safe(owner)}, '{function}', run, lambda: {{{tells}}}, {{{room}}}, {{{', '.join(made)}}})"]
        return lines + [f"found['{name}'] = found['{name}'] != 0" for name, item, _ in arrays if item.get("flag") and not into]


TOLD = '''def told(of: Any, counts: Sequence[str], report: str = "") -> str:
    """The repr of an object: its counts, and those of its report that are not 0."""
    if of.closed:
        return f"<hf.{type(of).__name__} closed>"
    shown = [(name, getattr(of, name)) for name in counts]
    found = getattr(of, report) if report else None
    for name, *_ in found._fields_ if found else ():
        if name.endswith("_count") and name not in counts and getattr(found, name):
            shown.append((name, getattr(found, name)))
    return f"<hf.{type(of).__name__}{''.join(f' {name}={value}' for name, value in shown)}>"'''.split("\n")


class Writer:
    def __init__(self, api):
        self.api = api
        self.groups, self.structs = classes(api)
        self.words = Words(api, self.groups, Spoken())
        self.results, self.names = {}, []
        self.sizes = set().union(*(dims_used(methods, self.structs) for _, methods in self.groups))

    # ---- hints ----

    def hint(self, item):
        if item["role"] == "flag" and not item["pointer"]:
            return "bool"
        return "float" if item["type"] in ("float", "double") and item["role"] != "enum" else "int"

    def zero(self, item):
        if item["role"] == "enum":
            enum = named(self.api["enums"], item["enum"])
            member = next((m for m in enum["members"] if m["value"] == 0), None)
            return Spoken().constant(enum, member) if member else "0"
        return {"bool": "False", "float": "0.0"}.get(self.hint(item), "0")

    def argument(self, a):
        """'name: hint = default'."""
        if a.role == "handle":
            hint, default = camel(a.item["type"]), "None"
            hint = hint if a.required else f"Optional[{hint}]"
        elif a.role == "info":
            hint, default = f"Optional[{camel(a.item['type'])}]", "None"
        else:
            hint = "Optional[Sequence[PlaceLike]]" if a.role == "array" and a.item["type"] == PLACE else HINTS.get(a.role) or self.hint(a.item)
            default = {"type": "np.float32", "request": "False"}.get(a.role, "None" if a.role in HINTS else self.zero(a.item))
        if a.required:
            hint = hint.replace("Optional[ArrayLike]", "ArrayLike")
        return f"{safe(a.name)}: {hint}" + ("" if a.required else f" = {default}")

    def signature(self, receiver, arguments, name, returns):
        required = [self.argument(a) for a in arguments if a.required]
        first = [self.argument(a) for a in arguments if not a.required and a.first]
        keyword = [self.argument(a) for a in arguments if not a.required and not a.first]
        parts = [receiver] * bool(receiver) + required + first + ["*"] * bool(keyword) + keyword
        return fold(f"def {name}({', '.join(parts)}) -> {returns}:", 4)

    # ---- methods ----

    def render(self, plan):
        steps = Steps(self)
        return [line for op, values in plan.steps for line in steps.lines(op, values)]

    def returned(self, plan):
        """[(expression, hint)]"""
        found = []
        for kind, name, item in plan.results:
            if kind == "array":
                found.append((f"{safe(name)} != 0" if item.get("flag") else safe(name), "np.ndarray[Any, Any]"))
            elif kind == "grown":
                found.append((f"found['{name}']", "np.ndarray[Any, Any]"))
            elif kind == "bytes":
                found.append(("block.tobytes()", "bytes"))
            elif kind == "string":
                found.append(("block[:-1].tobytes().decode()", "str"))
            elif kind == "figure":
                found.append((f"{safe(name)}.value", self.hint(item)))
            elif kind == "object":
                found.append(("made", f'"{camel(item)}"'))
            elif kind == "returned":
                _, values = plan.steps[0]
                given = ", ".join(map(Steps(self).value, values["values"]))
                found.append((f"library().{values['function']}({given})", self.hint({**item, "role": "scalar"})))
            elif kind == "info":
                optional = named(self.structs[item["type"]].struct["fields"], "found")
                found.append((f"{safe(name)} if {safe(name)}.found else None", f"Optional[{camel(item['type'])}]") if optional else (safe(name), camel(item["type"])))
            else:
                self.results[item.name] = item
                figures = [f"{f['name']}={name}.{f['name']}" for f in item.results if f["name"] not in self.sizes]
                figures += [f"{f['name']}=found.pop('{f['name']}') != 0" for f in item.filled if f.get("flag")]
                found.append((f"{camel(item.name)}({', '.join([*figures, '**found'])})", camel(item.name)))
        return found

    def method(self, m):
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        name, receiver, head = safe(m.title()), "self", []
        if m.kind == "create":
            name, receiver, head = ("__init__", "self", []) if m.function["verb"] == "create" else (name, "cls", ["    @classmethod"])
        elif not m.own:
            receiver, head = "", ["    @staticmethod"]
        elif m.is_property():
            head = ["    @property"]
        results = self.returned(plan)
        returns = "None" if not results else results[0][1] if len(results) == 1 else f"Tuple[{', '.join(r[1] for r in results)}]"
        out = head + self.signature(receiver, plan.arguments, name, returns)
        if name != "__init__":
            out += block(self.words.say(method_words(plan, "Raises")), 8)
        if plan.steps[0][0] != "returns":
            held = ["self"] * bool(m.own and m.kind != "create") + [f"{safe(p['name'])}={safe(p['name'])}" for p in m.parents if not p["optional"]]
            out.append(f"        c = Call({', '.join(held)})")
        for line in self.render(plan):
            out += fold(line.lstrip(), 8 + len(line) - len(line.lstrip())) if line else [""]
        return out + (fold("return " + ", ".join(r[0] for r in results), 8) if results else [])

    def filler(self, struct):
        """_sites_desc(c, ...) makes the struct; inner ones have a prefix for their counts."""
        planner = Planner(self.api, self.structs, self.sizes, None)
        for f, first in struct.asked():
            planner.field(struct, f, first)
        given = ", ".join(map(self.argument, planner.arguments))
        lines = ["", "", *fold(f"def _{struct.name[3:]}(c: Call, prefix: str = '', *, {given}) -> Any:", 0)]
        for op, values in desc_steps(self.api, struct, self.sizes):
            for line in Steps(self, in_filler=struct).lines(op, values):
                lines += fold(line, 4)
        return [*lines, "    return desc"]

    # ---- the file ----

    def enums(self):
        out = []
        for enum in self.api["enums"]:
            self.names.append(camel(enum["name"]))
            out += ["", "", f"class {camel(enum['name'])}({'IntFlag' if enum['bits'] else 'IntEnum'}):"]
            out += block(self.words.say(enum["doc"]), 4) + [""] if enum["doc"] else []
            out += ["    NONE = 0"] if enum["bits"] else []
            for member in enum["members"]:
                out.append(f"    {member['name'][len(enum['prefix']):]} = _raw.{member['name']}")
                out += block(self.words.say(member["doc"]), 4) if member["doc"] else []
        return out

    def result_classes(self):
        out = []
        for name, struct in self.results.items():
            arrays, figures = struct.filled, [f for f in struct.results if f["name"] not in self.sizes]
            self.names.append(camel(name))
            out += ["", "", f"class {camel(name)}(NamedTuple):", *block(self.words.say(struct.struct["doc"] or "Results."), 4), ""]
            for f in sorted(arrays + figures, key=lambda f: f in struct.on_request):
                hint = "np.ndarray[Any, Any]" if f in arrays else self.hint(f)
                out.append(f"    {f['name']}: Optional[{hint}] = None" if f in struct.on_request else f"    {f['name']}: {hint}")
                out += block(self.words.say(re.sub(r"^out[:;]?\s*", "", f["doc"])), 4) if f["doc"] else []
            for f in arrays:
                starts, rows = re.match(r"(\w+)_starts$", f["name"]), next((g for g in arrays if g["dims"][1:] == ["3"]), None)
                if starts and rows:
                    out += ["", f"    def {starts.group(1)}s(self) -> List[np.ndarray[Any, Any]]:", f'        """The {rows["name"]} of each {starts.group(1)}."""',
                            f"        return [self.{rows['name']}[a:b] for a, b in zip(self.{f['name']}[:-1], self.{f['name']}[1:])]"]
        return out

    def class_of(self, handle, methods):
        self.names.append(camel(handle["name"]))
        counts = counts_of(handle, self.groups, self.structs)
        out = ["", "", f"class {camel(handle['name'])}({'Recorded' if recorded(methods) else 'Object'}):", *block(self.words.say(class_words(handle, methods, self.structs)), 4), ""]
        out += [f"    _destroy = {next((m.name for m in methods if m.kind == 'destroy'), '')!r}", f"    _counts = {tuple(counts)!r}"]
        for count in counts:
            what = "Vertices of the surface, as given." if count == "vertex_count" else "As it was made with."
            out += ["", "    @property", f"    def {count}(self) -> int:", f'        """{what}"""', f"        return self._n.get({count!r}, 0)"]
        told = [*counts, *(m.title() for m in methods if m.is_property() and m.title().endswith("_count"))]
        report = ", 'report'" if any(m.title() == "report" for m in methods) else ""
        out += ["", "    def __repr__(self) -> str:", f"        return told(self, {tuple(told)!r}{report})"]
        for m in methods:
            out += [""] + self.method(m) if m.kind != "destroy" else []
        return out

    def aliases(self):
        """Structs that the library fills, under their own names."""
        out = ["", ""]
        for name, struct in self.structs.items():
            filled = struct.struct["used"] in ("out", "plain") or struct.struct.get("written") or (struct.struct["used"] == "inout" and not struct.filled)
            if filled and name != "hf_error_detail" and not any(f["role"] == "callback" for f in struct.struct["fields"]):
                out.append(f"{camel(name)} = _raw.{name}")
                self.names.append(camel(name))
        return out

    def write(self):
        bodies = [line for handle, methods in self.groups for line in self.class_of(handle, methods)]
        taken = {p["type"] for _, methods in self.groups for m in methods for p in m.flat}
        taken |= {f["type"] for name in taken for f in self.structs[name].inner}
        taken |= {f["type"] for name in taken for f in self.structs[name].inner}
        fillers = [line for name, struct in self.structs.items() if name in taken and struct.asked() for line in self.filler(struct)]
        head = ['"""Generated from include/hf/*.h by bindings/generate; do not edit. Classes, enums and results of the package."""',
                "# fmt: off", "", "from __future__ import annotations", "", "import ctypes", "from enum import IntEnum, IntFlag",
                "from typing import Any, List, NamedTuple, Optional, Sequence, Tuple, Union", "", "import numpy as np", "",
                "from . import _errors, _raw", "from ._errors import *  # noqa: F401,F403", "from ._library import ArrayLike, Call, Object, Recorded, address, call, handle_of, library, number, place, ref",
                "from ._library import PlaceLike"]
        head += ["", "NO_INDEX = _raw.HF_NO_INDEX", "", "", *TOLD]
        text = head + self.aliases() + self.enums() + self.result_classes() + fillers + bodies
        repeated = sorted({n for n in self.names if self.names.count(n) > 1})
        if repeated:
            raise ValueError(f"two things are called {', '.join(repeated)} in Python")
        listed = textwrap.wrap(", ".join(repr(n) for n in sorted(["NO_INDEX", *self.names])), 110)
        return "\n".join(text + ["", "", "__all__ = [", *["    " + line for line in listed], "]", "__all__ += _errors.__all__"]) + "\n"


def write(api):
    writer = Writer(api)
    return {"python/hf/_api.py": writer.write(), "python/hf/_errors.py": errors(api, writer.words)}
