"""bindings/csharp/Hf/Api.cs: the classes, enums and results of C#. What Call.cs does by hand: arrays to pointers and counts, room
for arrays that grow."""

import re

import comments
from layer_csharp import TYPES, safe as raw_safe
from model import named, symbols
from plan import bare, camel, classes, counts_of, dims_used, edits, moves, recorded
from steps import Planner, desc_steps, field_steps, least
from words import Words, class_words, fold, method_words, wrapped

RESERVED = {"base", "in", "out", "ref", "params", "operator", "object", "fixed", "lock", "event", "string", "float", "double", "is", "as",
            "c", "raw", "found", "result"}
RENAMED = {"Path": "SurfacePath"}  # System.IO has a Path
HINTS = {"lists": "uint[][]", "text": "string[]", "blob": "byte[]", "place": "Place", "request": "bool", "flag": "bool"}
PAIRS = {"float": "Reals", "uint32_t": "Indices"}  # arrays that may have either of two types


def lower(name):
    """out_sites -> outSites"""
    text = re.sub(r"_([a-z0-9])", lambda m: m.group(1).upper(), name.rstrip("_")) + "_" * name.endswith("_")
    return "@" + text if text in RESERVED else text


def upper(name):
    return "".join(word[:1].upper() + word[1:] for word in name.strip("_").split("_"))


def cs(type_name):
    """The class of a struct or object."""
    name = camel(type_name)
    return RENAMED.get(name, name)


class Spoken:
    null, no_index, error = "null", "uint.MaxValue", staticmethod(lambda constant: constant)

    def constant(self, enum, member):
        return f"{camel(enum['name'])}.{upper(member['name'][len(enum['prefix']):].lower())}"

    def enum(self, enum):
        return camel(enum["name"])

    def method(self, m):
        return upper(m.title())

    def shape(self, sizes):
        return "[" + " x ".join(lower(size) for size in sizes) + "]"


class Steps:
    """Steps of steps.py as lines of C#. inner: inside a desc of its own class; into: where the array to fill comes from.
    listed: a desc whose counts have a prefix."""

    def __init__(self, writer, inner=None, into=None):
        self.w, self.inner, self.into, self.blocks = writer, inner, into, 0
        self.listed, self.prefix = None, ""

    def lines(self, op, values):
        return getattr(self, "do_" + op)(**values)

    def given(self, name):
        return upper(name) if self.inner else lower(name)

    def dims(self, dims):
        desc = self.inner or self.listed
        counted = {f["name"] for f in desc.counts} if desc else set()
        prefix = 'prefix + "' if self.inner else f'"{self.prefix}'
        return ", ".join(f'{prefix}{d}"' if symbols([d]) & counted else f'"{d}"' for d in dims)

    def number(self, item, name):
        if item["role"] == "flag":
            return f"{name} ? 1 : 0"
        return f"(int){name}" if item["role"] == "enum" else f"(UIntPtr){name}" if item["type"] == "size_t" else name

    def value(self, v):
        kind, *rest = v
        name = lower(rest[0]) if rest else ""
        if kind == "number":
            return self.number(rest[1], name)
        return {"self": "RawHandle", "null": "null"}.get(kind) or {
            "handle": "c.Handle({name})", "place": "c.Place({name}, \"{name}\")", "ref": "{name}", "ref_if": "{last} == null ? null : {name}",
            "var": "{name}", "text": "c.Text({name})", "figure": "&{name}", "address": "{name}Place", "count": "(uint)c.Count(\"{raw}\", 1)",
            "info": "&{name}", "room": "(uint)c.Size(\"{raw}\")", "grown": "{name}Place", "literal": "(UIntPtr){raw}",
            "size_of": "(UIntPtr){name}.Length"}[kind].format(name=name, raw=rest[0], last=lower(rest[-1]) if isinstance(rest[-1], str) else "")

    def do_forget(self, key):
        return [f'c.Sizes.Remove("{key}");  // of the list given here']

    def do_known(self, key, default):
        name = self.given(key)
        return [("" if default else f"if ({name} != 0) ") + f'c.Sizes["{key}"] = (int)Math.Min({f"{name} == 0 ? {default} : {name}" if default else name}, int.MaxValue);']

    def do_struct(self, var, type, fields):
        struct, name = self.w.structs[type].struct, lower(var)
        sets = [f"{raw_safe(f)} = {self.number(named(struct['fields'], f), self.given(f))}" for f in fields]
        if struct["fields"][0]["name"] == "struct_size":
            sets.insert(0, f"struct_size = (uint)sizeof({type})")
        if self.inner:
            return [f"var {name} = ({type}*)c.New(sizeof({type}));"] + [f"{name}->{s};" for s in sets]
        return [f"var {name}Struct = new {type} {{ {', '.join(sets)} }};", f"{type}* {name} = &{name}Struct;"]

    def do_desc(self, var, struct, names, prefix):
        lines, self.listed, self.prefix = [], struct if prefix else None, prefix
        for op, values in desc_steps(self.w.api, struct, self.w.sizes):
            lines += self.lines(op, values)
        self.listed, self.prefix = None, ""
        return lines

    def do_record(self, var, type, fields, dims):
        name = lower(var)
        return [f"var {name}Struct = new {type}();", f"{type}* {name} = &{name}Struct;"] + [
            line for f, given in fields for line in filled(lower(given), lower(given), f["count"], f"{name}->{f['name']}")]

    def do_records(self, var, type, fields, dims):
        name = lower(var)
        lines = [f"var {name} = ({type}*)c.Rows(sizeof({type}), {self.dims(dims)});"]
        return lines + [line for f, given in fields for line in filled(lower(given), lower(given), f["count"], f"{name}[i / {f['count']}].{f['name']}", self.dims(dims))]

    def do_array(self, var, name, item):
        if item["view"]:
            view = f'c.View({lower(name)}{"?.Values" * bool(item["twin"])}, "{lower(name)}", {self.dims(item["dims"])})'
            return [f"hf_array {lower(var)}Array = {view};", f"hf_array* {lower(var)} = &{lower(var)}Array;"]
        return [f'void* {lower(var)} = c.Array({lower(name)}, "{lower(name)}", {self.dims(item["dims"])});']

    def do_rows(self, struct, field, name, var="desc"):
        given, dims, target = self.given(name), self.dims(field["dims"]), f"{lower(var)}->{raw_safe(field['name'])}"
        for missing, other in field["without"].items():
            dims = f"{self.given(missing)} == null ? new[] {{ {self.dims(other)} }} : new[] {{ {dims} }}"
        if field["view"]:
            return [f'{target} = c.View({given}{"?.Values" * bool(field["twin"])}, "{lower(name)}", {dims});']
        return [f'{target} = (IntPtr)c.Array({given}, "{lower(name)}", {dims});']

    def do_fields(self, struct, var):
        lines, name = [], lower(var)
        for op, values in field_steps(self.w.api, struct):
            lines += self.do_rows(**values, var=var) if op == "rows" else getattr(self, "field_" + op)(name, **values)
        for f in struct.inner:
            given = self.given(f["name"])
            lines.append(f'if ({given} != null) {name}->{f["name"]} = {given}.Fill(c, "{f["name"]}.");')
        for f in struct.counts:
            prefix = 'prefix + "' if self.inner else f'"{self.prefix}'
            lines.append(f'{name}->{f["name"]} = (uint)c.Count({prefix}{f["name"]}", {least(f)});')
        return lines

    def field_ragged(self, var, counts, field):
        name = field["name"]
        return [f'c.Lists({self.given(name)}, "{lower(name)}", {self.dims(counts["dims"])}, out {var}->{counts["name"]}, out {var}->{name});']

    def field_written(self, var, field):
        name, type_name = field["name"], field["type"]
        rows, given = lower(name) + "Rows", self.given(name)
        return [f'var {rows} = ({type_name}*)c.Given({given}, "{lower(name)}", sizeof({type_name}), {self.dims(field["dims"])});',
                f"for (int i = 0; {given} != null && i < {given}.Length; ++i) {given}[i].Write(c, {rows} + i);", f"{var}->{name} = (IntPtr){rows};"]

    def field_blob(self, var, field, count):
        given = self.given(field["name"])
        return [f"{var}->{field['name']} = c.Pin({given});", f"{var}->{count} = (UIntPtr)({given} == null ? 0 : {given}.Length);"]

    def field_text(self, var, field):
        return [f"{var}->{field['name']} = (IntPtr)c.Text({self.given(field['name'])});"]

    def field_fixed(self, var, field):
        name = field["name"]
        return filled(self.given(name), lower(name), field["count"], f"{var}->{name}")

    def field_handle(self, var, field):
        return [f"{var}->{field['name']} = c.Handle({self.given(field['name'])});"]

    def do_out(self, var, item, twin, given):
        name, dims = lower(var), self.dims(item["dims"])
        if given and self.into:
            return self.span("into", name, self.into, dims)
        kind = self.fresh if given else TYPES[item["type"]]
        return [f"var {name} = new {kind}[c.Product({dims})];", f"var {name}Place = ({kind}*)c.Pin({name});"]

    def span(self, given, name, kind, dims):
        self.blocks += 1
        return [f'c.Need({given}.Length, "{given}", {dims});', f"fixed ({kind}* {name}Place = &MemoryMarshal.GetReference({given}))", "{"]

    def do_fill(self, var, item, twin, given):
        name = lower(var)
        return [f"if (!{name}.IsEmpty)", *["    " + line if n == 0 else line for n, line in enumerate(self.span(name, name, TYPES[item["type"]], self.dims(item["dims"])))]]

    fresh = None

    def out_view(self, var, item):
        double = var == "out" and (self.into or self.fresh) == "double"
        return f'Call.Out({lower(var)}Place, {"true" if double else "false"}, c.Size("{item["dims"][0]}"))'

    def do_view(self, var, name, item):
        return [f"hf_array_out {lower(var)}Array = {self.out_view(name, item)};", f"hf_array_out* {lower(var)} = &{lower(var)}Array;"]

    def do_point(self, var, field, twin, optional):
        return [f"desc->{field['name']} = {self.out_view(var, field) if field['view'] else f'(IntPtr){lower(var)}Place'};"]

    def do_scalar(self, var, item):
        return [f"{TYPES[item['type']]} {lower(var)} = 0;"]

    def do_info(self, var, type, optional):
        if optional:
            return []
        return [f"var {lower(var)}Struct = new {type} {{ struct_size = (uint)sizeof({type}) }};", f"{type}* {lower(var)} = &{lower(var)}Struct;"]

    def called(self, function, values):
        return f"Functions.{function}({', '.join(map(self.value, values))})"

    def do_call(self, function, values):
        lines = [f"HfException.Check({self.called(function, values)});"]
        return lines + (['lock (Counts) Counts["vertex_count"] = surface.Known("vertex_count");'] if moves(function) else [])

    def do_returns(self, function, values):
        return [f"{TYPES[self.w.function(function)['returns']['type']]} result = {self.called(function, values)};", "GC.KeepAlive(this);"]

    def do_make(self, made, function, values, kind):
        who = "" if made == "self" else "made."
        given = ", ".join([*map(self.value, values), "raw"])
        lines = ["var raw = (IntPtr*)c.New(sizeof(IntPtr));"]
        if kind == "create":  # Mono looks for the library when it compiles a method that calls it: this one, after Call has loaded it
            lines.append(f"HfException.Check(Library.Late(() => Functions.{function}({given})));")
        else:
            lines.append(f"HfException.Check(Functions.{function}({given}));")
        if who:
            lines.append(f"var made = new {cs(self.w.noun)}();")
        lines += [f"{who}Own(*raw, {self.w.destroy}, c{''.join(f', {chr(34)}{k}{chr(34)}' for k in self.w.counts)});"]
        return lines + ([f'{who}Counts["vertex_count"] = (int){who}Info.VertexCount;'] if edits(function) else [])

    def do_bytes(self, function, first, second):
        second = [("grownblock",) if v == ("address", "block") else v for v in second]
        given = ", ".join("(void*)c.Pin(block)" if v == ("grownblock",) else self.value(v) for v in second)
        return ["UIntPtr size = UIntPtr.Zero;", f"HfException.Check({self.called(function, first)});", "var block = new byte[(int)size];",
                f"HfException.Check(Functions.{function}({given}));"]

    def do_grow(self, function, owner, values, tell, rooms, arrays, into):
        lines = ["uint count = 0;"] if any(var == "count" for _, var, _ in tell) else []
        for name, item, on_request in arrays:
            kind = TYPES.get(item["type"])
            lines += [f"{kind}[] all{upper(name)} = null;"] if kind else [f"void* {lower(name)}Place = null;"]
        lines += [f'c.Room("{key}", "{known or function + "." + key}");' for key, known in rooms] + ["int result;", "do", "{"]
        lines += [f'    {lower(into)}->{key} = (uint)c.Size("{key}");' for key, _ in rooms if into]
        for name, item, on_request in arrays:
            dims = self.dims(item["dims"])
            made = f"c.Make(out all{upper(name)}, {dims})" if item["type"] in TYPES else f"c.Rows(sizeof({item['type']}), {dims})"
            made = f"{lower(name)} ? {made} : IntPtr.Zero" if on_request else made
            target = f"{lower(into)}->{name}" if into else f"{lower(name)}Place" if item["type"] not in TYPES else f"void* {lower(name)}Place"
            lines.append(f"    {target} = {made if into or item['type'] not in TYPES else f'(void*){made}'};")
        lines.append(f"    result = {self.called(function, values)};")
        told = [f'("{key}", {lower(var) + ("." if self.is_info(var) else "->") + field if field else lower(var)})' for key, var, field in tell]
        return lines + ["}", f'while (c.Again("{function}", result, {", ".join(told)}));']

    def is_info(self, var):
        return any(a.name == var and a.role == "info" for a in self.arguments)

    arguments = ()


class Writer:
    def __init__(self, api):
        self.api = api
        self.groups, self.structs = classes(api)
        self.words = Words(api, self.groups, Spoken())
        self.words.table.update({s["name"]: cs(s["name"]) for s in api["structs"]})
        self.sizes = set().union(*(dims_used(methods, self.structs) for _, methods in self.groups))
        self.results, self.infos = {}, {}

    def function(self, name):
        return named(self.api["functions"], name)

    def doc(self, text, indent):
        if re.fullmatch(r"HF_[A-Z_]+_\*", text):  # the type says it
            return []
        pad, said = " " * indent + "/// ", self.words.say(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        lines = wrapped(said, 112 - indent)
        lines[0] = "<summary>" + lines[0]
        lines[-1] += "</summary>"
        return [(pad + line).rstrip() for line in lines]

    # ---- arguments ----

    def hint(self, item, role=None):
        role = role or item["role"]
        if role == "enum":
            return camel(item["enum"])
        if role == "handle":
            return cs(item["type"])
        if role == "desc":
            return cs(item["type"])
        if role in ("array", "fixed"):
            if named(self.api["structs"], item["type"]):
                return cs(item["type"]) + "[]"
            return PAIRS[item["type"]] if role == "array" and item.get("twin") else TYPES[item["type"]] + "[]"
        if role == "fill":
            return f"Span<{TYPES[item['type']]}>"
        return HINTS.get(role) or TYPES[item["type"]].replace("UIntPtr", "ulong")

    def argument(self, a):
        hint = self.hint(a.item, a.role)
        default = {"enum": f"default({hint})", "fill": f"default({hint})", "request": "false", "flag": "false", "scalar": "0"}.get(a.role, "null")
        return f"{hint} {lower(a.name)}" + ("" if a.required else f" = {default}")

    def signature(self, plan, head, into):
        shown = [a for a in plan.arguments if a.role not in ("info", "out", "type")]
        parts = [self.argument(a) for a in shown if a.required]
        parts += [f"Span<{into}> into"] if into else []
        fills = [a for a in shown if a.role == "fill" and into]  # more arrays to fill stand beside the first
        rest = [a for a in shown if not a.required and a not in fills]
        parts += [self.argument(a) for a in [*fills, *sorted(rest, key=lambda a: not a.first)]]
        return f"{head}({', '.join(parts)})"

    # ---- methods ----

    def dims(self, item):
        return Steps(self).dims(item["dims"])

    def returned(self, plan):
        """[(name, type, expression)], and lines in front."""
        found, lines = [], []
        for kind, name, item in plan.results:
            shown = upper(name)
            if kind == "array":
                found.append((shown, None if name == "out" else TYPES[item["type"]] + "[]", lower(name)))
            elif kind == "grown" and named(self.api["structs"], item["type"]):
                rows = lower(name)
                self.infos[item["type"]] = True
                lines += [f'var {rows} = new {cs(item["type"])}[c.Product({self.dims(item)})];', f"for (int i = 0; i < {rows}.Length; ++i)",
                          f'    {rows}[i] = new {cs(item["type"])}(({item["type"]}*){rows}Place + i);']
                found.append((shown, cs(item["type"]) + "[]", rows))
            elif kind == "grown":
                kind = TYPES[item["type"]]
                found.append((shown, kind + "[]", f"c.Cut(all{shown}, {self.dims(item)})"))
            elif kind == "bytes":
                found.append((shown, "byte[]", "block"))
            elif kind == "string":
                found.append((shown, "string", "System.Text.Encoding.UTF8.GetString(block, 0, Math.Max(block.Length - 1, 0))"))
            elif kind == "figure":
                found.append((shown, TYPES[item["type"]], lower(name)))
            elif kind == "object":
                found.append((shown, cs(item), "made"))
            elif kind == "returned":
                found.append((shown, "int", "(int)result"))
            elif kind == "info":
                self.infos[item["type"]] = True
                made = f"new {cs(item['type'])}({lower(name)})"
                optional = named(self.structs[item["type"]].struct["fields"], "found")
                found.append((shown, cs(item["type"]), f"{lower(name)}->found == 0 ? null : {made}" if optional else made))
            else:
                self.results[item.name] = item
                sets = [f"{upper(f['name'])} = {lower(name)}->{f['name']}" for f in item.results + [f for f in item.scalars if f["name"] in self.sizes]]
                sets += [f"{upper(f['name'])} = c.Cut(all{upper(f['name'])}, {self.dims(f)})" for f in item.filled]
                found.append((shown, cs(item.name), f"new {cs(item.name)} {{ {', '.join(sets)} }}"))
        return found, lines

    def variants(self, plan):
        """(name suffix, type of the caller's Span, type of a new array)."""
        out = next((a for a in plan.arguments if a.role == "out"), None)
        if not out:
            return [("", None, None)]
        kinds = [TYPES[out.item["type"]]] + (["double"] if any(a.role == "type" for a in plan.arguments) else [])
        return [v for kind in kinds for v in (("Double" if kind == "double" and len(kinds) > 1 else "", None, kind), ("", kind, None))]

    def method(self, m):
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        makes = m.kind == "create" and m.function["verb"] == "create"
        out = []
        for suffix, into, fresh in self.variants(plan):
            out += [""] + self.one(plan, makes, suffix, into, fresh)
        return out, plan

    def one(self, plan, makes, suffix, into, fresh):
        m = plan.method
        results, after = self.returned(plan)
        results = [(n, t or f"{fresh}[]", e) for n, t, e in results if t or not into]
        told = [a for a in plan.arguments if a.role == "info"]
        own_told = bool(m.own)
        if not own_told:
            results += [(upper(a.name), cs(a.item["type"]), f"new {cs(a.item['type'])}(&{lower(a.name)})") for a in told]
        self.infos.update({a.item["type"]: True for a in told})
        returns = "void" if not results else results[0][1] if len(results) == 1 else "(" + ", ".join(f"{t} {n}" for n, t, _ in results) + ")"
        name = upper(m.title()) + suffix
        static = "static " * (not makes and (m.kind == "create" or not m.own))
        prop = m.is_property()
        head = f"public {cs(m.noun)}" if makes else f"public {static}{returns} {name}"
        signature = head if prop else self.signature(plan, head, into)
        steps = Steps(self, into=into)
        steps.fresh, steps.arguments = fresh, plan.arguments
        body = []
        if plan.steps[0][0] != "returns":
            for p in m.parents:
                if not p["optional"]:
                    body.append(f'c.Parent("{p["name"]}.", {lower(p["name"])});')
        for a in told:
            body.append(f"var {lower(a.name)} = new {a.item['type']} {{ struct_size = (uint)sizeof({a.item['type']}) }};")
        for op, values in plan.steps:
            body += steps.lines(op, values)
        if own_told:
            body += [f"last{cs(a.item['type'])} = {lower(a.name)};" for a in told]
        body += after
        if results:
            text = ", ".join(e for _, _, e in results)
            body.append(f"return {text};" if len(results) == 1 else f"return ({text});")
        body += ["}"] * steps.blocks
        if plan.steps[0][0] != "returns":
            body = [f"using (var c = new Call({'this' if m.own and m.kind != 'create' else 'null'}))", "{", *body, "}"]
        as_other = ["in double precision"] * bool(suffix) + ["into an array of yours"] * bool(into)
        words = f"As {upper(m.title())}, {', '.join(as_other)}." if as_other else method_words(plan, "Throws", lower)
        lines = self.doc(words, 8) + fold(signature, 8)
        lines += ["        {"] + (["            get", "            {"] if prop else [])
        lines += indented(body, 16 if prop else 12)
        return lines + (["            }"] if prop else []) + ["        }"]

    def class_of(self, handle, methods):
        name = cs(handle["name"])
        self.noun, self.counts = handle["name"], counts_of(handle, self.groups, self.structs)
        self.destroy = f"Functions.{next(m.name for m in methods if m.kind == 'destroy')}"
        out = ["", *self.doc(class_words(handle, methods, self.structs, lower), 4), f"    public sealed unsafe class {name} : {'Recorded' if recorded(methods) else 'HfObject'}", "    {"]
        body, told = [], []
        for m in methods:
            if m.kind != "destroy":
                lines, plan = self.method(m)
                body += lines
                told += [a.item["type"] for a in plan.arguments if a.role == "info" and m.own and a.item["type"] not in told]
        for struct in told:
            body += ["", f"        {struct} last{cs(struct)};", "        /// <summary>What the last call told that writes it.</summary>",
                     f"        public {cs(struct)} {cs(struct)} {{ get {{ {struct} copy = last{cs(struct)}; return new {cs(struct)}(&copy); }} }}"]
        if any(m.kind in ("clone", "derive") or (m.kind == "create" and m.function["verb"] != "create") for m in methods):
            body = ["", f"        {name}() {{ }}", *body]
        if recorded(methods):
            body += ["", "        internal override Recorded State() { return Clone(); }"]
        for count in self.counts:
            what = "Vertices of the surface, as given." if count == "vertex_count" else "As it was made with."
            body += ["", f"        /// <summary>{what}</summary>", f'        public int {upper(count)} {{ get {{ return Known("{count}"); }} }}']
        return out + body[1:] + ["    }"]

    # ---- enums, results, descs inside descs ----

    def enums(self):
        out = []
        for enum in self.api["enums"]:
            out += ["", *(self.doc(enum["doc"], 4) if enum["doc"] else []), *(["    [Flags]"] if enum["bits"] else []), f"    public enum {camel(enum['name'])}", "    {"]
            out += ["        None = 0,"] if enum["bits"] else []
            for member in enum["members"]:
                out += self.doc(member["doc"], 8) if member["doc"] else []
                out.append(f"        {upper(member['name'][len(enum['prefix']):].lower())} = Constants.{member['name']},")
            out.append("    }")
        return out

    def info_class(self, name):
        """A struct that the library fills: fields, and for plain ones a way back."""
        struct = self.structs[name].struct
        fields = [f for f in struct["fields"] if f["role"] in ("scalar", "enum", "flag", "fixed", "count", "string", "value") and f["name"] != "found"]
        plain = struct["used"] == "plain"
        out = ["", *(self.doc(struct["doc"], 4) if struct["doc"] else []), f"    public sealed unsafe partial class {cs(name)}", "    {"]
        into, back = [], []
        for f in fields:
            hint = {"enum": camel(f["enum"]) if f["enum"] else "int", "flag": "bool", "fixed": TYPES.get(f["type"], "") + "[]", "value": cs(f["type"])}.get(f["role"]) or TYPES[f["type"]]
            out += self.doc(re.sub(r"^out[:;]?\s*", "", f["doc"]), 8) if f["doc"] else []
            out.append(f"        public {hint} {upper(f['name'])}{' = new ' + TYPES[f['type']] + '[' + str(f['count']) + ']' if f['role'] == 'fixed' else ''};")
            source = f"raw->{raw_safe(f['name'])}"
            if f["role"] == "value":
                into.append(f"{upper(f['name'])} = new {cs(f['type'])}(&{source});")
                back.append(f"{upper(f['name'])}.Write(c, &{source});")
            elif f["role"] == "fixed":
                into.append(f"for (int i = 0; i < {f['count']}; ++i) {upper(f['name'])}[i] = {source}[i];")
                back += filled(upper(f["name"]), upper(f["name"]), f["count"], source)
            else:
                into.append(f"{upper(f['name'])} = " + {"enum": f"({hint}){source}", "flag": f"{source} != 0"}.get(f["role"], source) + ";")
                back.append(f"{source} = {self_number(f)};")
        out += ["", f"        internal {cs(name)}({name}* raw)", "        {", *indented(into, 12), "        }"]
        if plain:
            out += ["", f"        public {cs(name)}() {{ }}", "", f"        internal void Write(Call c, {name}* raw)", "        {", *indented(back, 12), "        }"]
        return out + ["    }"]

    def result_class(self, item):
        out = ["", *self.doc(item.struct["doc"] or "Results.", 4), f"    public sealed class {cs(item.name)}", "    {"]
        figures = item.results + [f for f in item.scalars if f["name"] in self.sizes]
        for f in item.filled + figures:
            out += self.doc(re.sub(r"^(in|out)[:;]?\s*", "", f["doc"]), 8) if f["doc"] else []
            out.append(f"        public {TYPES[f['type']]}{'[]' if f in item.filled else ''} {upper(f['name'])};")
        return out + ["    }"]

    def desc_class(self, name):
        struct = self.structs[name]
        planner = Planner(self.api, self.structs, self.sizes, None)
        for f, first in struct.asked():
            planner.field(struct, f, first)
        out = ["", *(self.doc(struct.struct["doc"], 4) if struct.struct["doc"] else []), f"    public sealed unsafe class {cs(name)}", "    {"]
        for a in planner.arguments:
            out += (self.doc(a.doc, 8) if a.doc else []) + [f"        public {self.hint(a.item, a.role)} {upper(a.name)};"]
        ahead = next((a for (f, first), a in zip(struct.asked(), planner.arguments) if first and a.role in ("array", "blob")), None)
        if ahead:
            kind = self.hint(ahead.item, ahead.role)
            out += ["", f"        public static implicit operator {cs(name)}({kind} {lower(ahead.name)})", "        {",
                    f"            return {lower(ahead.name)} == null ? null : new {cs(name)} {{ {upper(ahead.name)} = {lower(ahead.name)} }};", "        }"]
        steps, body = Steps(self, inner=struct), []
        for op, values in desc_steps(self.api, struct, self.sizes):
            body += steps.lines(op, values)
        return out + ["", "        internal IntPtr Fill(Call c, string prefix)", "        {", *indented([*body, "return (IntPtr)desc;"], 12), "        }", "    }"]

    def write(self):
        bodies = [line for handle, methods in self.groups for line in self.class_of(handle, methods)]
        inner = {f["type"]: True for s in self.structs.values() for f in s.inner}
        given = {f["type"]: True for s in self.structs.values() for f in s.given if named(self.api["structs"], f["type"])}
        infos = [line for name in self.structs if name in self.infos or name in given for line in self.info_class(name)]
        results = [line for item in self.results.values() for line in self.result_class(item)]
        descs = [line for name in self.structs if name in inner for line in self.desc_class(name)]
        head = ["// Generated from include/hf/*.h by bindings/generate; do not edit. Classes, enums and results of the C# binding.",
                "using System;", "using System.Runtime.InteropServices;", "using Hf.Native;", "", "namespace Hf", "{"]
        return "\n".join(head + [*self.enums(), *infos, *results, *descs, *bodies][1:] + ["}"]) + "\n"


def filled(given, name, count, place, rows=""):
    """A field of a fixed number of numbers, of one struct or of rows of it."""
    return [f'c.Fit({given}, "{name}", "{count}"{rows and ", " + rows});',
            f"for (int i = 0; {given} != null && i < {given}.Length; ++i) {place}[i{f' % {count}' if rows else ''}] = {given}[i];"]


def self_number(f):
    name = upper(f["name"])
    return f"{name} ? 1 : 0" if f["role"] == "flag" else f"(int){name}" if f["role"] == "enum" else name


def indented(lines, pad):
    """Lines with the indentation of their braces, long ones broken behind commas."""
    out = []
    for line in lines:
        text = line.lstrip()
        pad -= 4 * (text == "}")
        out += fold(text, pad + len(line) - len(text), 4) if text else [""]
        pad += 4 * (text == "{")
    return out


def write(api):
    return {"csharp/Hf/Api.cs": Writer(api).write()}
