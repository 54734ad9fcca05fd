"""bindings/python/hf/_api.py and _errors.py: classes, enums, results and errors of the Python package."""

import re
import textwrap

import comments
from layer_python import TYPES as CTYPES
from model import named, symbols
from plan import LOOSE, bare, camel, classes, dims_used

KINDS = {"float": "f4", "double": "f8", "uint32_t": "u4", "uint16_t": "u2", "uint8_t": "u1", "int32_t": "i4"}
BUILTIN = {  # errors that Python has a word for
    "INVALID_ARGUMENT": "ValueError", "NULL_POINTER": "TypeError", "OUT_OF_RANGE": "IndexError", "NON_FINITE": "ValueError",
    "EMPTY": "ValueError", "DUPLICATE_SITE": "ValueError", "NO_SUCH_SITE": "KeyError", "NO_SUCH_HANDLE": "KeyError",
    "NO_SUCH_PAIR": "KeyError", "NOT_FOUND": "KeyError", "DUPLICATE": "ValueError", "CONFLICT": "ValueError",
    "OVERLAP": "ValueError", "UNSUPPORTED": "NotImplementedError", "TOO_SMALL": "ValueError", "OUT_OF_MEMORY": "MemoryError",
    "TOO_LARGE": "ValueError", "NOT_POSITIVE_DEFINITE": "ArithmeticError", "INACCURATE": "ArithmeticError"}
RESERVED = {"from", "in", "is", "not", "and", "or", "with", "as", "def", "class", "return", "pass", "lambda", "None", "True", "False",
            "global", "import", "raise", "try", "while", "for", "if", "else", "del", "self", "c", "run", "call"}


def safe(name):
    return name + "_" if name in RESERVED else name


def error_name(constant):
    return camel(constant[len("HF_ERROR_"):].lower()) + "Error"


class Words:
    """C phrases as Python says them."""

    def __init__(self, api, groups):
        self.table = {}
        for enum in api["enums"]:
            self.table.update({m["name"]: f"{camel(enum['name'])}.{m['name'][len(enum['prefix']):]}" for m in enum["members"]})
            self.table[enum["prefix"] + "*"] = camel(enum["name"])
        for handle, methods in groups:
            for m in methods:
                self.table[m.name] = camel(handle["name"]) + ("" if m.function["verb"] == "create" else "." + m.title())
        for function in api["functions"]:
            long = function["short_of"] or function["double_of"]
            if long in self.table:
                self.table[function["name"]] = self.table[long]
        self.table.update({c["name"]: error_name(c["name"]) for c in api["constants"] if c["name"].startswith("HF_ERROR_")})
        self.table.update({s["name"]: camel(s["name"]) for s in api["structs"] if s["used"] != "in"})
        self.table.update({"HF_NO_INDEX": "NO_INDEX", "NULL": "None"})

    def say(self, text):
        text = re.sub(r",?(?: rows)?\s+\w+_stride bytes apart(?: \(0 = packed\))?", "", text)
        text = re.sub(r"(?:\b(?:float|double|u?int\d+_t|hf_\w+))?((?:\[[\w. +()]+\])+)", lambda m: self.shape(m.group(1)), text)
        text = re.sub(r"\b(?:in)?out_(\w+)->", r"\1.", text).replace("->", ".")
        text = re.sub(r"\b(?:in)?out_(?=[a-z])", "", text)
        return re.sub(r"\b(?:HF_|hf_|NULL)\w*\*?", lambda m: self.table.get(m.group(0), m.group(0)), text)

    def shape(self, dims):
        if re.match(r"\[sum", dims):
            return "lists of whole numbers:"
        sizes = comments.dims_of(dims)
        return "(" + ", ".join(sizes) + ("," if len(sizes) == 1 else "") + ")"


def block(text, indent, first='"""', last='"""'):
    """A docstring, wrapped."""
    lines = []
    for paragraph in text.split("\n"):
        lines += textwrap.wrap(paragraph, 118 - indent, subsequent_indent="    " if re.match(r"\w+: ", paragraph) else "") or [""]
    lines[0] = first + lines[0]
    if len(lines) == 1 and len(lines[0]) + indent + 3 < 120:
        lines[0] += last
    else:
        lines.append(last)
    return [(" " * indent + line).rstrip() for line in lines]


def fold(text, indent, deeper=8):
    """A long line of code, broken behind commas."""
    pieces, lines, pad = re.split(r"(?<=,) ", text), [], " " * indent
    for piece in pieces:
        if lines and len(lines[-1]) + 1 + len(piece) <= 120:
            lines[-1] += " " + piece
        else:
            lines.append((pad if not lines else pad + " " * deeper) + piece)
    return lines


class Writer:
    def __init__(self, api):
        self.api = api
        self.groups, self.structs = classes(api)
        self.words = Words(api, self.groups)
        self.named_results = {}
        self.names = []

    # ---- small things ----

    def dims(self, dims, struct=None, prefix=""):
        keys = [struct.key(d, prefix) if struct else d for d in dims]
        return "(" + ", ".join(k if k.isdigit() else repr(k) for k in keys) + ("," if len(keys) == 1 else "") + ")"

    def kinds(self, item, twin=None):
        return KINDS[item["type"]] + (" " + KINDS[twin["type"]] if twin else "")

    def hint(self, item):
        if item["role"] == "flag" and not item["pointer"]:
            return "bool"
        if item["role"] == "enum":
            return camel(item["enum"]) + " | int" if False else "int"
        return "float" if item["type"] in ("float", "double") else "int"

    def zero(self, item):
        if item["role"] == "enum":
            enum = named(self.api["enums"], item["enum"])
            member = next((m for m in enum["members"] if m["value"] == 0), None)
            return f"{camel(enum['name'])}.{member['name'][len(enum['prefix']):]}" if member else "0"
        return {"bool": "False", "float": "0.0"}.get(self.hint(item), "0")

    def ragged_key(self, struct, field, prefix=""):
        return struct.key(named(struct.struct["fields"], struct.ragged[field["name"]])["dims"][0], prefix)

    def shape(self, item):
        dims = [re.sub(r"^sum\((\w+)\)$", r"lists, one for each", d) for d in item["dims"]]
        return dims

    # ---- arguments ----

    def field_argument(self, struct, field):
        """(name, hint, default) of a field of a desc."""
        name = safe(field["name"])
        if field["role"] == "array":
            hint = "Sequence[ArrayLike]" if field["name"] in struct.ragged else "np.ndarray" if not field["const"] else "ArrayLike"
            return safe(bare(field["name"])) if not field["const"] else name, f"Optional[{hint}]", "None"
        if field["role"] == "string":
            return name, "Union[None, str, Sequence[str]]", "None"
        if field["role"] == "bytes":
            return name, "Optional[bytes]", "None"
        if field["role"] == "fixed":
            return name, "Optional[ArrayLike]", "None"
        if field["role"] == "handle":
            return name, f"Optional[{camel(field['type'])}]", "None"
        if field["role"] == "struct":
            return name, f"Any", "None"
        return name, self.hint(field), self.zero(field)

    def signature(self, arguments, indent, head, returns):
        """arguments: (name, hint, default or None, keyword only)."""
        required = [a for a in arguments if a[2] is None]
        positional = [a for a in arguments if a[2] is not None and not a[3]]
        keyword = [a for a in arguments if a[2] is not None and a[3]]
        parts = [f"{n}: {h}" for n, h, _, _ in required] + [f"{n}: {h} = {d}" for n, h, d, _ in positional]
        parts += ["*"] * bool(keyword) + [f"{n}: {h} = {d}" for n, h, d, _ in keyword]
        return fold(f"{head}({', '.join(parts)}) -> {returns}:", indent)

    # ---- fillers of descs ----

    def filler(self, struct):
        name = "_" + struct.name[3:]
        arguments = [(*self.field_argument(struct, f), True) for f, _ in struct.asked()]
        if not (struct.given or struct.scalars or struct.handles or struct.inner or struct.blobs or struct.texts):
            return []
        given = ", ".join(f"{n}: {h}" + (f" = {d}" if d else "") for n, h, d, _ in arguments)
        lines = ["", "", *fold(f"def {name}(c: Call, prefix: str = '', *, {given}) -> Any:", 0)]
        options = ", ".join(f"'{f['name']}': {safe(f['name'])}" for f in struct.scalars)
        lines += fold(f"desc = c.struct(_raw.{struct.name}, {{{options}}})", 4)
        used = self.sizes & {f["name"] for f in struct.scalars}
        for size in sorted(used):
            default = comments.default_of(named(struct.scalars, size)["doc"])
            lines.append(f"    c.known('{size}', {safe(size)}{' or ' + default if default else ''})")
        lines += self.fill_arrays(struct, "desc", "prefix + " if struct.counts else "")
        lines.append("    return desc")
        return lines

    def pref(self, text, prefix):
        """dims with a prefix that is known at run time."""
        return text

    def fill_arrays(self, struct, desc, prefix, pad="    ", renamed=None):
        lines = []
        counted = {f["name"] for f in struct.counts}

        def dims(items):
            out = []
            for d in items:
                symbol = next(iter(symbols([d])), "")
                out.append(d if d.isdigit() else f"prefix + {d!r}" if prefix and symbol in counted else repr(d))
            return "(" + ", ".join(out) + ("," if len(out) == 1 else "") + ")"

        for f in struct.given:
            name = safe(f["name"])
            inner = named(self.api["structs"], f["type"])
            if f["name"] in struct.ragged.values():
                continue
            if f["name"] in struct.ragged:
                counts = named(struct.struct["fields"], struct.ragged[f["name"]])
                lines.append(f"{pad}c.ragged({desc}, '{counts['name']}', '{f['name']}', {name}, {dims(counts['dims'])[1:-1].rstrip(',')})")
            elif inner:
                lines.append(f"{pad}{desc}.{f['name']} = c.written('{f['name']}', {name}, _raw.{f['type']}, {dims(f['dims'])})")
            else:
                shape = dims(f["dims"])
                for missing, other in f["without"].items():
                    shape = f"{dims(other)} if {safe(missing)} is None else {shape}"
                extra = f", '{struct.strides[f['name']]}'" if f["name"] in struct.strides else ""
                extra += ", sentinel=True" if f["sentinel"] else ""
                lines.append(f"{pad}c.rows({desc}, '{f['name']}', {name}, '{self.kinds(f, struct.twins.get(f['name']))}', {shape}{extra})")
        for f in struct.blobs:
            lines.append(f"{pad}c.bytes({desc}, '{f['name']}', '{re.sub('s$', '', f['name'])}_count', {safe(f['name'])})")
        lines += [f"{pad}{desc}.{f['name']} = c.text({safe(f['name'])})" for f in struct.texts]
        lines += [f"{pad}c.fixed({desc}, '{f['name']}', {safe(f['name'])})" for f in struct.fixed]
        lines += [f"{pad}{desc}.{f['name']} = handle_of({safe(f['name'])}, {camel(f['type'])}, '{f['name']}')" for f in struct.handles]
        for f in struct.inner:
            inner = self.structs[f["type"]]
            first = next((g["name"] for g, positional in inner.asked() if positional), "")
            lines.append(f"{pad}{desc}.{f['name']} = c.inner({safe(f['name'])}, '{first}', _{f['type'][3:]}, '{f['name']}.')")
        if struct.counts:
            counts = []
            for f in struct.counts:
                least = 1 if f["doc"].startswith(">= 1") and not any(f["name"] in symbols(g["dims"]) and g["name"] in struct.twins for g in struct.given) else 0
                counts.append(f"{f['name']}=({prefix}'{f['name']}', {least})")
            lines += fold(f"c.counts({desc}, {', '.join(counts)})", len(pad))
        return lines

    # ---- methods ----

    def method(self, m, handle):
        own_class = camel(handle["name"])
        creates = m.kind == "create"
        arguments, lines, values, docs = [], [], {}, []
        owner = ["self"] if m.own and not creates else []
        held = ", ".join(owner + [f"{safe(p['name'])}={safe(p['name'])}" for p in m.parents if not p["optional"]])
        lines.append(f"c = Call({held})")
        for p in m.function["parameters"]:
            if p["role"] == "count" and p["name"] in ("vertex_count", "channel_count"):
                lines.append(f"c.n.pop('{p['name']}', None)  # of the list given here")
        if m.own:
            values[m.own["name"]] = "self._handle"
        for p in m.inputs:
            self.take(m, p, arguments, lines, values, docs)
        results = self.give(m, arguments, lines, values, docs, own_class)
        return self.assemble(m, handle, arguments, lines, results, docs)

    def take(self, m, p, arguments, lines, values, docs):
        name, key = safe(p["name"]), p["name"]
        if p in m.parents:
            arguments.append((name, f"Optional[{camel(p['type'])}]" if p["optional"] else camel(p["type"]), "None" if p["optional"] else None, p["optional"]))
            values[key] = f"handle_of({name}, {camel(p['type'])}, '{key}')"
        elif p in m.places:
            arguments.append((name, "Place", None, False))
            values[key] = f"ref(place(_raw.{p['type']}, {name}))"
        elif p in m.whole:
            struct, field = self.structs[p["type"]], self.structs[p["type"]].given[0]
            arguments.append((name, "ArrayLike", None, False))
            extra = f", '{struct.strides[field['name']]}'" if field["name"] in struct.strides else ""
            lines.append(f"{name}_ = c.struct(_raw.{p['type']}, {{}})")
            lines.append(f"c.rows({name}_, '{field['name']}', {name}, '{self.kinds(field, struct.twins.get(field['name']))}', "
                         f"{self.dims(field['dims'])}{extra}, name='{key}')")
            values[key] = f"None if {name} is None else ref({name}_)"
        elif p in m.flat:
            self.take_desc(m, p, arguments, lines, values, docs)
            return
        elif p in m.records:
            fields = [f for f in named(self.api["structs"], p["type"])["fields"] if f["role"] != "reserved"]
            lines.append(f"{name} = _raw.{p['type']}()")
            for f in fields:
                arguments.append((safe(f["name"]), "Optional[ArrayLike]", "None", False))
                lines.append(f"c.fixed({name}, '{f['name']}', {safe(f['name'])})")
                docs.append((f["name"], f["doc"], f))
            values[key] = f"ref({name})"
            return
        elif p["role"] == "string":
            arguments.append((name, "Union[None, str, Sequence[str]]", "None", False))
            values[key] = f"c.text({name})"
        elif p["role"] == "array" and named(self.api["structs"], p["type"]):
            fields = [f for f in named(self.api["structs"], p["type"])["fields"] if f["role"] != "reserved"]
            arguments += [(safe(f["name"]) + "s", "Optional[ArrayLike]", "None", False) for f in fields]
            given = ", ".join(f"'{f['name']}': ('{f['name']}s', {safe(f['name'])}s)" for f in fields)
            lines.append(f"{name} = c.records(_raw.{p['type']}, {self.dims(p['dims'])}, {{{given}}})")
            values[key] = name
            docs += [(f["name"] + "s", f["doc"], f) for f in fields]
            return
        elif p["role"] == "array":
            arguments.append((name, "Optional[ArrayLike]" if p["optional"] else "ArrayLike", "None" if p["optional"] else None, False))
            sentinel = ", sentinel=True" if p["sentinel"] else ""
            lines.append(f"{name}_ = c.array('{key}', {name}, '{self.kinds(p)}', {self.dims(p['dims'])}{sentinel})")
            values[key] = f"{name}_"
        else:
            zero = p["zero"] or p["role"] in ("enum", "flag")
            arguments.append((name, self.hint(p), self.zero(p) if zero else None, False))
            values[key] = f"number({name}, '{key}', {self.ctype(p)}{', flag=False' if p['role'] == 'enum' else ''})"
            if key in self.sizes or any(key in symbols(q["dims"]) for q in m.function["parameters"]):
                default = comments.default_of(p["doc"])
                lines.append(f"c.known('{key}', {name}{' or ' + default if default else ''})")
        docs.append((key, p["doc"], p))

    def ctype(self, item):
        return "ctypes." + CTYPES[item["type"]]

    def take_desc(self, m, p, arguments, lines, values, docs):
        struct, name = self.structs[p["type"]], safe(p["name"])
        given = []
        taken = {a[0] for a in arguments}
        for f, positional in struct.asked():
            argument, hint, default = self.field_argument(struct, f)
            if argument in taken:
                raise ValueError(f"{m.name}: two arguments {argument}")
            arguments.append((argument, hint, default, not positional))
            given.append(f"{argument}={argument}")
            docs.append((f["name"], f["doc"], f))
        variable = "desc"
        lines.append(f"{variable} = _{struct.name[3:]}(c{''.join(', ' + g for g in given)})")
        values[p["name"]] = f"ref({variable})"
        m.variables = getattr(m, "variables", {}) | {p["name"]: variable}

    def give(self, m, arguments, lines, values, docs, own_class):
        """Outputs. Returns [(expression, hint)]."""
        results, first = [], True
        function = repr(m.name)
        for p in m.flat:  # outputs among the fields of a desc
            struct = self.structs[p["type"]]
            for f in struct.filled:
                argument = "out" if first and not m.outputs_are_arrays() else safe(bare(f["name"]))
                kinds, twin = self.kinds(f, struct.twins.get(f["name"])), struct.twins.get(f["name"])
                stride = struct.strides.get(f["name"])
                arguments.append((argument, "Optional[np.ndarray]", "None", argument != "out"))
                desc, pad = m.variables[p["name"]], ""
                if argument != "out":
                    lines.append(f"if {argument} is not None:")
                    pad = "    "
                if argument == "out" and twin:
                    arguments.append(("dtype", "Any", "np.float32", True))
                take = f"c.out({argument}, '{kinds}', {self.dims(f['dims'])}" + (", dtype" if argument == "out" and twin else "") + (
                    f", name='{argument}'" if argument != "out" else "") + ")"
                lines.append(f"{pad}{argument}, {desc + '.' + stride if stride else '_'} = {take}")
                target = f"'{f['name']}_f64' if {argument}.dtype == np.float64 else '{f['name']}'" if twin else f"'{f['name']}'"
                lines.append(f"{pad}setattr({desc}, {target}, address({argument}))")
                if argument == "out":
                    results.append(("out", "np.ndarray"))
                docs.append((argument, f["doc"], f))
                first = False
        grown = []
        for p in m.outputs:
            name = safe(bare(p["name"]))
            if p["role"] == "handle":
                continue
            if p["role"] == "struct" and p["direction"] == "inout":
                results += self.give_struct(m, p, arguments, lines, values, docs, grown)
            elif p["role"] == "struct" and (p["optional"] or results or grown):
                arguments.append((name, f"Optional[{camel(p['type'])}]", "None", True))
                if m.capacity and m.capacity["counted_by"].startswith(p["name"] + "."):
                    lines.append(f"{name} = {name} or c.struct(_raw.{p['type']}, {{}})")
                values[p["name"]] = f"c.info({name}, _raw.{p['type']})"
                docs.append((name, "filled in when given", p))
            elif p["role"] == "struct":
                lines.append(f"{name} = c.struct(_raw.{p['type']}, {{}})")
                values[p["name"]] = f"ref({name})"
                if named(self.structs[p["type"]].struct["fields"], "found"):
                    results.append((f"{name} if {name}.found else None", f"Optional[{camel(p['type'])}]"))
                else:
                    results.append((name, camel(p["type"])))
            elif p["role"] == "array" and m.capacity:
                grown.append(p)
                results.append((f"found['{name}']", "np.ndarray"))
            elif p["role"] == "array":
                results += self.give_array(m, p, arguments, lines, values, docs, results)
            elif p["role"] == "bytes":
                results.append(("block.tobytes()", "bytes"))
            else:
                kind = self.ctype(p)
                lines.append(f"{name} = {kind}()")
                values[p["name"]] = f"ref({name})"
                results.append((f"{name}.value", self.hint(p)))
        self.finish(m, lines, values, grown, results)
        return results

    def give_array(self, m, p, arguments, lines, values, docs, results):
        name = safe(bare(p["name"]))
        stride, twin = m.strides.get(p["name"]), named(m.twin["parameters"], p["name"]) if m.twin else None
        twin = twin if twin and twin["type"] != p["type"] else None
        filled = bool(stride) and not results
        if not filled and results and any(r[0] == "out" for r in results):
            arguments.append((name, "Optional[np.ndarray]", "None", True))
            lines.append(f"if {name} is not None:")
            lines.append(f"    {name}, _ = c.out({name}, '{self.kinds(p)}', {self.dims(p['dims'])}, name='{name}')")
            values[p["name"]] = f"address({name})"
            docs.append((name, p["doc"], p))
            return []
        variable = "out" if filled else name
        if filled:
            arguments.append(("out", "Optional[np.ndarray]", "None", False))
            if twin:
                arguments.append(("dtype", "Any", "np.float32", True))
            docs.append(("out", p["doc"], p))
        lines.append(f"{variable}, {'stride' if stride else '_'} = c.out({'out' if filled else 'None'}, '{self.kinds(p, twin)}', "
                     f"{self.dims(p['dims'])}{', dtype' if filled and twin else ''})")
        values[p["name"]] = f"address({variable})"
        if stride:
            values[stride] = "stride"
        if twin:
            m.chosen = f"'{m.twin['name']}' if {variable}.dtype == np.float64 else '{m.name}'"
        return [(f"{variable} != 0" if p.get("flag") else variable, "np.ndarray")]

    def give_struct(self, m, p, arguments, lines, values, docs, grown):
        """A struct that goes in and out: options in, arrays and figures out."""
        struct, name = self.structs[p["type"]], safe(bare(p["name"]))
        for f, _ in struct.asked():
            argument, hint, default = self.field_argument(struct, f)
            arguments.append((argument, hint, default, f["role"] == "handle"))
            docs.append((f["name"], re.sub(r"^in[:;]?\s*|;\s*out:.*$", "", f["doc"]), f))
        name = name if name not in {a[0] for a in arguments} else name + "_"
        for f in struct.on_request:
            arguments.append((safe(f["name"]), "bool", "False", True))
            docs.append((f["name"], f["doc"], f))
        options = ", ".join(f"'{f['name']}': {safe(f['name'])}" for f in struct.scalars)
        lines.append(f"{name} = c.struct(_raw.{struct.name}, {{{options}}})")
        for f in struct.scalars:
            if f["name"] in self.sizes:
                default = comments.default_of(f["doc"])
                lines.append(f"c.known('{f['name']}', {f['name']}{' or ' + default if default else ''})")
        lines += [line[4:] for line in self.fill_arrays(struct, name, "")]
        values[p["name"]] = f"ref({name})"
        if not struct.filled:
            return [(name, camel(struct.name))]
        m.grown_struct = (struct, name)
        self.named_results[struct.name] = struct
        figures = "".join(f", {f['name']}={name}.{f['name']}" for f in struct.results if f["name"] not in self.sizes)
        bools = [f for f in struct.filled if f.get("flag")]
        for f in bools:
            figures += f", {f['name']}=found.pop('{f['name']}') != 0"
        figures = figures[2:] + ", " if figures else ""
        return [(f"{camel(struct.name)}({figures}**found)", camel(struct.name))]

    def finish(self, m, lines, values, grown, results):
        """The call itself."""
        parameters = m.function["parameters"]
        counts = {p["name"]: f"c.n.setdefault('{p['name']}', 1)" for p in parameters if p["role"] == "count"}
        values.update(counts)
        called = getattr(m, "chosen", repr(m.name))
        creates = m.kind in ("create", "clone", "derive")
        if m.function["returns"]["type"] not in ("hf_result", "void"):
            lines[:] = []
            results.append((f"library().{m.name}({', '.join(values[p['name']] for p in parameters)})", self.hint({**m.function["returns"], "role": "scalar"})))
            return
        if creates:
            values = {k: v for k, v in values.items()}
            given = ", ".join(values[p["name"]] for p in parameters if not (p["role"] == "handle" and p["pointer"]))
            made = "self" if m.kind == "create" and m.function["verb"] == "create" else "made"
            if made == "made":
                lines.append(f"made = {'cls.__new__(cls)' if m.kind == 'create' else 'type(self).__new__(type(self))'}")
                results.append(("made", f'"{camel(m.noun)}"'))
            if m.kind in ("clone", "derive"):
                lines.append("c.n.update(self._n)")
            lines.append(f"{made}._own({called}, c{', ' + given if given else ''})")
            return
        owner = "self" if m.own else safe(m.parents[0]["name"])
        if any(p["role"] == "bytes" and p["direction"] == "out" for p in parameters):
            out = next(p for p in parameters if p["role"] == "bytes" and p["direction"] == "out")
            lines.append("size = ctypes.c_size_t()")
            for capacity, pointer in (("0", "None"), ("block.size", "address(block)")):
                values.update({m.capacity["name"]: capacity, out["name"]: pointer, m.capacity["counted_by"]: "ref(size)"})
                lines.append(f"call({', '.join([called] + [values[p['name']] for p in parameters])})")
                if capacity == "0":
                    lines.append("block = np.empty(size.value, np.uint8)")
            return
        if grown or hasattr(m, "grown_struct"):
            self.finish_grown(m, lines, values, grown, called, owner)
            return
        lines.append(f"call({', '.join([called] + [values[p['name']] for p in parameters])})")

    def finish_grown(self, m, lines, values, grown, called, owner):
        parameters, arrays, rooms = m.function["parameters"], [], []
        if grown:
            by = m.capacity["counted_by"]
            if "." in by:
                told = bare(by.split(".")[0]) + "." + by.split(".")[1]
                values[by.split(".")[0]] = f"ref({bare(by.split('.')[0])})"
            else:
                lines.append("count = ctypes.c_uint32()")
                told, values[by] = "count.value", "ref(count)"
            values[m.capacity["name"]] = "room['capacity']"
            tell = f"{{'capacity': {told}}}"
            rooms.append("'capacity': None")
            for p in grown:
                name = safe(bare(p["name"]))
                inner = named(self.api["structs"], p["type"])
                kind = f"np.dtype(_raw.{p['type']})" if inner else f"np.{self.numpy(p)}"
                arrays.append(f"'{name}': ({kind}, {self.dims(p['dims'])})")
                values[p["name"]] = f"address(made['{name}'])"
            body = []
        else:
            struct, name = m.grown_struct
            body = [f"    c.into({name}, room, made)"]
            tells = [f"'{f['name']}': {name}.{f['counted_by']}" for f in struct.capacities]
            tells += [f"'{f['name']}': {name}.{f['name']}" for f in struct.struct["fields"] if f["direction"] == "out" and f["name"] in self.sizes and f["role"] == "scalar"]
            tell = "{" + ", ".join(tells) + "}"
            for f in struct.capacities:
                count = f["counted_by"]
                rooms.append(f"'{f['name']}': c.n.get('{count}')" if count in self.sizes else f"'{f['name']}': None")
            for f in struct.filled:
                entry = f"'{f['name']}': (np.{self.numpy(f)}, {self.dims(f['dims'])})"
                arrays.append(f"**({{{entry}}} if {safe(f['name'])} else {{}})" if f in struct.on_request else entry)
        asked = f"call({', '.join([called] + [values[p['name']] for p in parameters])})"
        lines += ["", "def run(room: Any, made: Any) -> None:", *body]
        lines.append("    " + asked)
        text = f"found = c.grow({owner}, {m.name!r}, run, lambda: {tell}, {{{', '.join(rooms)}}}, {{{', '.join(arrays)}}})"
        lines += ["", text]
        for p in grown:
            if p.get("flag"):
                lines.append(f"found['{bare(p['name'])}'] = found['{bare(p['name'])}'] != 0")

    def numpy(self, item):
        return {"float": "float32", "double": "float64", "uint32_t": "uint32", "int32_t": "int32", "uint16_t": "uint16", "uint8_t": "uint8"}[item["type"]]

    def assemble(self, m, handle, arguments, lines, results, docs):
        name, creates = safe(m.title()), m.kind == "create"
        head = []
        if creates and m.function["verb"] == "create":
            name, receiver = "__init__", "self"
        elif creates:
            head, receiver = ["@classmethod"], "cls"
        elif m.own:
            receiver = "self"
        else:
            head, receiver = ["@staticmethod"], ""
        if m.is_property():
            head = ["@property"]
        returns = "None" if not results else results[0][1] if len(results) == 1 else f"Tuple[{', '.join(r[1] for r in results)}]"
        full = ([(receiver, "", None, False)] if receiver else []) + arguments
        out = [" " * 4 + line for line in head]
        signature = self.signature(full, 4, f"def {name}", returns)
        out += [line.replace(f"({receiver}: , ", f"({receiver}, ").replace(f"({receiver}: )", f"({receiver})") for line in signature]
        if name != "__init__":
            out += block(self.words.say(self.doc(m, docs)), 8)
        for line in lines:
            out += fold(line.lstrip(), 8 + len(line) - len(line.lstrip())) if line else [""]
        if results:
            out += fold("return " + ", ".join(r[0] for r in results), 8)
        return out

    def doc(self, m, docs):
        text = m.prose()
        said = [f"{name}: {re.sub(r'^NULL, or ', '', doc)}" for name, doc, _ in docs if doc]
        errors = [e for e in m.function["errors"]]
        parts = [text] + (["\n".join(said)] if said else [])
        if errors:
            parts.append("Raises " + ", ".join(errors) + ".")
        return "\n\n".join(p for p in parts if p)

    # ---- the file ----

    def enums(self):
        out = []
        for enum in self.api["enums"]:
            name = camel(enum["name"])
            self.names.append(name)
            out += ["", "", f"class {name}({'IntFlag' if enum['bits'] else 'IntEnum'}):"]
            if enum["doc"]:
                out += block(self.words.say(enum["doc"]), 4) + [""]
            if enum["bits"]:
                out.append("    NONE = 0")
            for member in enum["members"]:
                out.append(f"    {member['name'][len(enum['prefix']):]} = _raw.{member['name']}")
                if member["doc"]:
                    out += block(self.words.say(member["doc"]), 4)
        return out

    def results(self):
        out = []
        for name, struct in self.named_results.items():
            arrays = struct.filled
            out += ["", "", f"class {camel(name)}(NamedTuple):"]
            self.names.append(camel(name))
            out += block(self.words.say(struct.struct["doc"] or "Results."), 4) + [""]
            figures = [f for f in struct.results if f["name"] not in self.sizes]
            for f in sorted(arrays + figures, key=lambda f: f in struct.on_request):
                hint = "np.ndarray" if f in arrays else self.hint(f)
                out.append(f"    {f['name']}: Optional[{hint}] = None" if f in struct.on_request else f"    {f['name']}: {hint}")
                if f["doc"]:
                    out += block(self.words.say(re.sub(r"^out[:;]?\s*", "", f["doc"])), 4)
            for f in arrays:
                starts = re.match(r"(\w+)_starts$", f["name"])
                rows = next((g for g in arrays if g["dims"][1:] == ["3"]), None)
                if starts and rows:
                    out += ["", f"    def {starts.group(1)}s(self) -> List[np.ndarray]:", f'        """The {rows["name"]} of each {starts.group(1)}."""',
                            f"        return [self.{rows['name']}[a:b] for a, b in zip(self.{f['name']}[:-1], self.{f['name']}[1:])]"]
        return out

    def write(self):
        self.sizes = set()
        for _, methods in self.groups:
            self.sizes |= dims_used(methods, self.structs)
        bodies, fillers = [], []
        taken = set()
        for handle, methods in self.groups:
            name = camel(handle["name"])
            self.names.append(name)
            bodies += ["", "", f"class {name}(Object):"]
            makers = [m for m in methods if m.kind == "create"]
            made = makers[0].doc_of(self) if False else ""
            bodies += block(self.class_doc(handle, methods), 4)
            destroy = next((m.name for m in methods if m.kind == "destroy"), "")
            counts = sorted(s for s in dims_used(methods, self.structs) if s in ("vertex_count", "channel_count") or s.endswith(".vertex_count"))
            counts = sorted({c.rpartition(".")[2] for c in counts})
            bodies += ["", f"    _destroy = {destroy!r}", f"    _counts = {tuple(counts)!r}"]
            bodies += self.count_properties(counts, methods)
            for m in methods:
                if m.kind != "destroy":
                    bodies += [""] + self.method(m, handle)
                    taken |= {p["type"] for p in m.flat}
        inner = {f["type"] for s in list(taken) for f in self.structs[s].inner}
        inner |= {f["type"] for s in inner for f in self.structs[s].inner}
        for name, struct in self.structs.items():
            if name in taken | inner:
                fillers += self.filler(struct)
        aliases = self.aliases(taken | inner)
        enums, results = self.enums(), self.results()
        head = ['"""Generated from include/hf/*.h by bindings/generate; do not edit. Classes, enums and results of the package."""',
                "# fmt: off", "", "from __future__ import annotations", "", "import ctypes", "from enum import IntEnum, IntFlag",
                "from typing import Any, List, NamedTuple, Optional, Sequence, Tuple, Union", "", "import numpy as np", "",
                "from . import _raw", "from ._library import ArrayLike, Call, Object, address, call, handle_of, library, number, place, ref",
                "from ._library import Place"]
        listed = textwrap.wrap(", ".join(repr(n) for n in sorted(set(self.names))), 110)
        repeated = sorted({n for n in self.names if self.names.count(n) > 1})
        if repeated:
            raise ValueError(f"two things are called {', '.join(repeated)} in Python")
        tail = ["", "", "__all__ = [", *["    " + line for line in listed], "]"]
        return "\n".join(head + aliases + enums + results + fillers + bodies + tail) + "\n"

    def class_doc(self, handle, methods):
        make = next((m for m in methods if m.function["verb"] == "create"), None)
        parts = [handle["doc"]]
        if make:
            parts.append(make.prose())
            said = []
            for p in make.inputs:
                if p in make.flat:
                    said += [f"{f['name']}: {re.sub(r'^NULL, or ', '', f['doc'])}" for f, _ in self.structs[p["type"]].asked() if f["doc"]]
                elif p["doc"]:
                    said.append(f"{p['name']}: {p['doc']}")
            parts.append("\n".join(said))
        return self.words.say("\n\n".join(p for p in parts if p) or f"{camel(handle['name'])}.")

    def count_properties(self, counts, methods):
        out = []
        for count in counts:
            out += ["", "    @property", f"    def {count}(self) -> int:", f'        """{"Vertices of the surface, as given." if count == "vertex_count" else "As it was made with."}"""',
                    f"        return self._n.get({count!r}, 0)"]
        return out

    def aliases(self, descs):
        """Structs that the library fills, under their own names."""
        out = ["", ""]
        for name, struct in self.structs.items():
            if struct.struct["used"] in ("out", "plain") or (struct.struct["used"] == "inout" and not struct.filled):
                if any(f["role"] == "callback" for f in struct.struct["fields"]) or name == "hf_error_detail":
                    continue
                out.append(f"{camel(name)} = _raw.{name}")
                self.names.append(camel(name))
        return out


ERRORS = '''"""Generated from include/hf/*.h by bindings/generate; do not edit. An exception for each error code."""
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

'''


def errors(api, words):
    out, names = [ERRORS], []
    docs = {c["name"]: "" for c in api["constants"]}
    for constant in api["constants"]:
        if constant["name"].startswith("HF_ERROR_"):
            name, kind = error_name(constant["name"]), BUILTIN.get(constant["name"][len("HF_ERROR_"):])
            names.append(name)
            out += ["", f"class {name}({'HfError' + (', ' + kind if kind else '')}):"]
            doc = api.get("error_docs", {}).get(constant["name"], "")
            out += block(words.say(doc), 4) if doc else []
            out += [f"    code = _raw.{constant['name']}", ""]
    out += ["", "EXCEPTIONS: Dict[int, Type[HfError]] = {kind.code: kind for kind in (" ,
            *["    " + line for line in textwrap.wrap(", ".join(names), 110)], ")}", "", "__all__ = [",
            *["    " + line for line in textwrap.wrap(", ".join(repr(n) for n in ["HfError", "EXCEPTIONS", *names]), 110)], "]"]
    return "\n".join(out) + "\n"


def write(api):
    writer = Writer(api)
    text = writer.write()
    return {"python/hf/_api.py": text, "python/hf/_errors.py": errors(api, writer.words)}
