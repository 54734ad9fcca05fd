"""bindings/js/src/classes.js and index.d.ts: the classes of the JavaScript package and their types. What call.js does by hand:
arrays to memory and counts, room for arrays that grow."""

import re

from model import named, symbols
from plan import FIRST, PLACE, camel, classes, counts_of, dims_used, edits, moves, recorded
from steps import Planner, desc_steps, field_steps, least
from types_js import ARRAYS, KINDS, Types, js
from words import Words, fold, wrapped


class Spoken:
    null, no_index = "null", "constants.HF_NO_INDEX"

    def constant(self, enum, member):
        return member["name"]

    def enum(self, enum):
        return enum["prefix"] + "*"

    def error(self, constant):
        return constant

    def method(self, m):
        return js(m.title())

    def shape(self, sizes):
        return "[" + " x ".join(js(size) for size in sizes) + "]"


class Steps:
    """Steps of steps.py as lines of JavaScript."""

    def __init__(self, writer, filler=None):
        self.w, self.filler = writer, filler

    def dims(self, dims):
        counted = {f["name"] for f in self.filler.counts} if self.filler else set()
        return "[" + ", ".join(d if d.isdigit() else f"prefix + '{d}'" if symbols([d]) & counted else f"'{d}'" for d in dims) + "]"

    def kinds(self, item, twin=None):
        return KINDS[item["type"]] + (" " + KINDS[twin["type"]] if twin else "")

    def value(self, v):
        kind, *rest = v
        name = js(rest[0]) if rest else ""
        if kind in ("self", "null"):
            return {"self": "this._handle", "null": "null"}[kind]
        return {"number": name, "handle": f"handleOf({name}, {camel(rest[-1])}, '{name}')" if kind == "handle" else "",
                "place": f"c.place({name}, '{name}')" if kind == "place" else "", "ref": name,
                "ref_if": f"{js(rest[-1])} === null || {js(rest[-1])} === undefined ? null : {name}" if kind == "ref_if" else "", "var": name,
                "text": f"c.text({name}, '{name}')", "figure": f"written({name})", "address": f"written({name})",
                "count": f"(c.n.{rest[0] if rest else ''} ??= 1)", "info": name, "room": f"room.{rest[0] if rest else ''}",
                "grown": f"written(made.{name})", "literal": rest[0] if rest else "", "size_of": f"{name}.length"}[kind]

    def lines(self, op, values):
        return getattr(self, "do_" + op)(**values)

    def do_forget(self, key):
        return [f"delete c.n.{key}; // of the list given here"]

    def do_known(self, key, default):
        given = f"scalar('u32', {js(key)}, '{js(key)}')"
        return [f"c.n.{key} = {given} || {default};" if default else f"if ({given}) c.n.{key} = {js(key)};"]

    def do_struct(self, var, type, fields):
        options = ", ".join(name if js(name) == name else f"{name}: {js(name)}" for name in fields)
        return [f"const {js(var)} = c.struct('{type}', {{ {options} }});".replace("{  }", "{}")]

    def do_desc(self, var, struct, names, prefix):
        given = names[0][3:] if len(names) == 1 and names[0].startswith("...") else f"{{ {', '.join(names)} }}"
        return [f"const {var} = {js(struct.name[3:])}(c, '{prefix}', {given});"]

    def do_record(self, var, type, fields, dims):
        return [f"const {js(var)} = c.struct('{type}', {{}});"] + [line for f, name in fields for line in self.field_fixed(js(var), f, js(name))]

    def do_records(self, var, type, fields, dims):
        lines = [f"const {js(name)}_ = {js(name)} && c.numbers('{js(name)}', {js(name)}, 'f8', [{self.dims(dims)[1:-1]}, {f['count']}]);" for f, name in fields]
        part = ", ".join(f"{f['name']}: {js(name)}_?.subarray({f['count']} * i, {f['count']} * (i + 1)) ?? 0" for f, name in fields)
        indices = f"[...Array(c.product({self.dims(dims)})).keys()]"
        return [*lines, f"const {js(var)} = c.rows('{js(var)}', {indices}, {self.dims(dims)}, (i) => c.struct('{type}', {{ {part} }}));"]

    def do_array(self, var, name, item):
        if item["view"]:
            return [f"const {js(var)} = {self.view(name, item, self.dims(item['dims']))};"]
        return [f"const {js(var)} = c.array('{js(name)}', {js(name)}, '{self.kinds(item)}', {self.dims(item['dims'])});"]

    def view(self, name, item, shape):
        return f"c.viewOf('hf_array', read, {js(name)} && c.numbers('{js(name)}', {js(name)}, '{self.kinds(item, item['twin'])}', {shape}), {shape})"

    def do_rows(self, struct, field, name, var="desc"):
        shape = self.dims(field["dims"])
        for missing, other in field["without"].items():
            shape = f"{js(missing)} ? {shape} : {self.dims(other)}"
        if field["view"]:
            return [f"{js(var)}.set('{field['name']}', {self.view(name, field, shape)});"]
        return [f"{js(var)}.set('{field['name']}', c.array('{js(name)}', {js(name)}, '{self.kinds(field)}', {shape}));"]

    def do_fields(self, struct, var):
        lines = []
        for op, values in field_steps(self.w.api, struct):
            lines += self.do_rows(**values, var=var) if op == "rows" else getattr(self, "field_" + op)(js(var), **values)
        for f in struct.inner:
            inner = self.w.structs[f["type"]]
            first = next((g["name"] for g, ahead in inner.asked() if ahead), "")
            lines.append(f"{js(var)}.set('{f['name']}', c.inner({js(f['name'])}, '{js(first)}', {js(f['type'][3:])}, '{f['name']}.'));")
        prefix = "prefix + " if self.filler else ""
        return lines + [f"{js(var)}.set('{f['name']}', (c.n[{prefix}'{f['name']}'] ??= {least(f)}));" for f in struct.counts]

    def field_ragged(self, var, counts, field):
        name = js(field["name"])
        return [f"const {name}_ = c.lists('{name}', {name}, {self.dims(counts['dims'])});",
                f"{var}.set('{counts['name']}', {name}_[0]).set('{field['name']}', {name}_[1]);"]

    def field_written(self, var, field):
        name = js(field["name"])
        if field["type"] == PLACE:
            return [f"{var}.set('{field['name']}', c.rows('{name}', {name}, {self.dims(field['dims'])}, c.place));"]
        return [f"{var}.set('{field['name']}', c.rows('{name}', {name}, {self.dims(field['dims'])}, (row) => c.struct('{field['type']}', row)));"]

    def field_blob(self, var, field, count):
        name = js(field["name"])
        return [f"{var}.set('{field['name']}', c.array('{name}', {name}, 'u1', [prefix + '{count}'])).set('{count}', c.n[prefix + '{count}']);"]

    def field_text(self, var, field):
        return [f"{var}.set('{field['name']}', c.text({js(field['name'])}, '{js(field['name'])}'));"]

    def field_fixed(self, var, field, name=None):
        name = name or js(field["name"])
        return [f"{var}.set('{field['name']}', {name} && c.numbers('{name}', {name}, '{KINDS[field['type']]}', [{field['count']}]));"]

    def field_handle(self, var, field):
        return [f"{var}.set('{field['name']}', handleOf({js(field['name'])}, {camel(field['type'])}, '{js(field['name'])}') || null);"]

    def do_out(self, var, item, twin, given):
        kinds, dims = self.kinds(item, twin), self.dims(item["dims"])
        if given:
            return [f"{js(var)} = c.out({js(var)}, '{kinds}', {dims}{', Type' if twin else ''});"]
        return [f"const {js(var)} = c.out(null, '{kinds}', {dims});"]

    def do_view(self, var, name, item):
        return [f"const {js(var)} = c.viewOf('hf_array_out', written, {js(name)}, {self.dims(item['dims'])});"]

    def do_fill(self, var, item, twin, given):
        kinds = self.kinds(item, item.get("twin"))
        return [f"const {js(var)}_ = {js(var)} && c.out({js(var)}, '{kinds}', {self.dims(item['dims'])}, null, '{js(var)}');"]

    def do_point(self, var, field, twin, optional):
        name = js(var) + "_" * optional
        value = f"c.viewOf('hf_array_out', written, {name}, {self.dims(field['dims'])})" if field["view"] else f"written({name})"
        return [f"desc.set('{field['name']}', {name} && {value});"]

    def do_scalar(self, var, item):
        return [f"const {js(var)} = new {ARRAYS[KINDS[item['type']]]}(1);"]

    def do_info(self, var, type, optional):
        return [] if optional else [f"const {js(var)} = c.struct('{type}', {{}});"]

    def do_call(self, function, values):
        lines = [f"call({', '.join([repr(function), *map(self.value, values)])});"]
        return lines + (["this._n.vertex_count = surface._n.vertex_count;"] if moves(function) else [])

    def do_returns(self, function, values):
        return [f"return direct('{function}', {', '.join(map(self.value, values))});"]

    def do_make(self, made, function, values, kind):
        lines = [] if made == "self" else [f"const made = new {'this' if kind == 'create' else 'this.constructor'}(bare);"]
        lines += ["Object.assign(c.n, this._n);"] if kind in ("clone", "derive") else []
        lines += [f"{'this' if made == 'self' else made}._own({', '.join([repr(function), 'c', *map(self.value, values)])});"]
        return lines + ([f"{made}._n.vertex_count = {made}.info.vertexCount;"] if edits(function) else [])

    def do_bytes(self, function, first, second):
        first, second = self.do_call(function, first), self.do_call(function, second)
        return ["const size = newHandle();", *first, "const block = new Uint8Array(Number(size[0]));", *second]

    def do_grow(self, function, owner, values, tell, rooms, arrays, into):
        lines = ["const count = new Uint32Array(1);"] if any(var == "count" for _, var, _ in tell) else []
        tells = ", ".join(f"{key}: " + (f"{js(var)}.get('{field}')" if field else "count[0]") for key, var, field in tell)
        room = ", ".join(f"{key}: c.n.{known}" if known else f"{key}: null" for key, known in rooms)
        made = []
        for name, item, on_request in arrays:
            kind = item["type"] if named(self.w.api["structs"], item["type"]) else KINDS[item["type"]]
            entry = f"{js(name)}: ['{kind}', {self.dims(item['dims'])}]"
            made.append(f"...({js(name)} ? {{ {entry} }} : {{}})" if on_request else entry)
        asked = self.do_call(function, values)[0].rstrip(";")
        if into:
            sets = [f"'{key}', room.{key}" for key, _ in rooms] + [f"'{name}', written(made.{js(name)})" for name, _, _ in arrays]
            asked = f"({js(into)}{''.join(f'.set({one})' for one in sets)}, {asked})"
        who = "this" if owner == "self" else js(owner)
        return [*lines, f"const found = c.grow({who}, '{function}', (room, made) => {asked}, () => ({{ {tells} }}), {{ {room} }}, {{ {', '.join(made)} }});"]


class Writer(Types):
    def __init__(self, api):
        self.api = api
        self.groups, self.structs = classes(api)
        self.words = Words(api, self.groups, Spoken())
        self.sizes = set().union(*(dims_used(methods, self.structs) for _, methods in self.groups))
        self.shown = {}  # interfaces of results: name -> lines

    # ---- arguments ----

    def split(self, plan):
        """(positional, options): what a call is about, then options by name."""
        outs = any(a.role == "out" for a in plan.arguments)
        flat = bool(plan.method.flat)
        ahead, rest = [], []
        for a in plan.arguments:
            if a.struct is not None:
                (ahead if a.item["name"] in FIRST.get(a.struct.name, ()) else rest).append(a)
            elif a.required or a.role == "out" or a.role == "text" or (a.role == "array" and a.first):
                ahead.append(a)
            elif a.role in ("scalar", "enum", "flag") and not outs and not flat:
                ahead.append(a)
            else:
                rest.append(a)
        ahead.sort(key=lambda a: (not a.required, a.role == "out"))
        return ahead, [a for a in rest if a.role != "info"]

    def default(self, a):
        return {"type": "Float32Array", "request": "false", "scalar": "0", "enum": "0", "flag": "false"}.get(a.role, "null")

    def name(self, a):
        return "Type" if a.role == "type" else js(a.name)

    def doc(self, text, indent):
        pad = " " * indent
        if not text:
            return []
        lines = wrapped(self.words.say(text), 112 - indent)
        return [f"{pad}/** {lines[0]} */"] if len(lines) == 1 else [f"{pad}/**", *[f"{pad} * {line}".rstrip() for line in lines], f"{pad} */"]

    # ---- classes ----

    def method(self, m):
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        ahead, options = self.split(plan)
        given = [self.name(a) + ("" if a.required else f" = {self.default(a)}") for a in ahead]
        desc = m.flat and self.structs[m.flat[0]["type"]]
        shown = [f"{self.name(a)} = {self.default(a)}" for a in options if not desc or a.struct is not desc]
        makes = m.kind == "create" and m.function["verb"] == "create"
        head = js(m.title())
        if makes:
            head, given = "constructor", [re.sub(r" = .*", "", g) if not n else g for n, g in enumerate(given)] or ["first"]
        elif m.kind == "create" or not m.own:
            head = "static " + head
        elif m.is_property():
            head = "get " + head
        out = fold(f"{head}({', '.join(given + ['options = {}'] * bool(options))}) {{", 4)
        out += ["      super();", f"      if ({re.sub(' = .*', '', given[0])} === bare) return;"] if makes else []
        if options:
            if shown:
                out += fold(f"const {{ {', '.join(shown)}, ...more }} = options;", 6)
            out += [] if desc else ["      none(more);"]
        body = []
        if plan.steps[0][0] != "returns":
            objects = ", ".join(f"{js(p['name'])}" for p in m.parents if not p["optional"])
            own = "this" if m.own and m.kind != "create" else "null"
            body.append(f"const c = new Call({own}{', { ' + objects + ' }' if objects else ''});")
        told = [a for a in plan.arguments if a.role == "info"]
        for a in told:
            body.append(f"const {js(a.name)} = " + (f"Call.told(this, '{a.item['type']}');" if m.own else f"c.struct('{a.item['type']}', {{}});"))
        for op, values in plan.steps:
            if op == "desc":  # options that are left are the desc's: it refuses others
                ahead_names = [js(a.name) for a in ahead if a.struct is desc and a.role != "out"]
                more = ["...more" if shown else "...options"] if options else []
                values = {**values, "names": ahead_names + more}
            body += Steps(self).lines(op, values)
        for line in body:
            out += fold(line, 6)
        result = self.returned(plan, told, m)
        out += fold(result, 6) if result else []
        return [*out, "    }"], plan

    def returned(self, plan, told, m):
        found = []
        for kind, name, item in plan.results:
            if kind == "info":
                text = f"{js(name)}.toObject()"
                found.append((js(name), f"{js(name)}.get('found') ? {text} : null" if named(self.structs[item["type"]].struct["fields"], "found") else text))
            elif kind == "string":
                found.append((js(name), "new TextDecoder().decode(block.subarray(0, -1))"))
            elif kind == "returned":
                return ""
            elif kind == "arrays":
                figures = [f for f in item.struct["fields"] if f["direction"] == "out" and f["role"] in ("scalar", "flag", "enum")]
                found.append((js(name), "{ ...found" + "".join(f", {js(f['name'])}: {js(name)}.get('{f['name']}')" for f in figures) + " }"))
            else:
                found.append((js(name), {"grown": f"found.{js(name)}", "figure": f"{js(name)}[0]"}.get(kind, js(name))))
        if not m.own and m.kind == "call":
            found += [(js(a.name), f"{js(a.name)}.toObject()") for a in told]
        found = [(n.rstrip("_"), v) for n, v in found]
        if not found:
            return ""
        if len(found) == 1:
            return f"return {found[0][1]};"
        if plan.results[0].kind == "arrays":  # one object with all
            return f"return {{ ...{found[0][1]}, {', '.join(f'{n}: {v}' if n != v else n for n, v in found[1:])} }};"
        return f"return {{ {', '.join(f'{n}: {v}' if n != v else n for n, v in found)} }};"

    def filler(self, struct):
        planner = Planner(self.api, self.structs, self.sizes, None)
        for f, first in struct.asked():
            planner.field(struct, f, first)
        given = [f"{js(a.name)} = {self.default(a)}" for a in planner.arguments]
        lines = ["", *fold(f"const {js(struct.name[3:])} = (c, prefix, options) => {{", 2)]
        lines += [*fold(f"const {{ {', '.join(given)}, ...more }} = options;", 4), "    none(more);"]
        for op, values in desc_steps(self.api, struct, self.sizes):
            for line in Steps(self, struct).lines(op, values):
                lines += fold(line, 4)
        return [*lines, "    return desc;", "  };"]

    def classes(self):
        taken = {p["type"] for _, methods in self.groups for m in methods for p in m.flat}
        taken |= {f["type"] for name in taken for f in self.structs[name].inner}
        taken |= {f["type"] for name in taken for f in self.structs[name].inner}
        out = ["// Generated from include/hf/*.h by bindings/generate; do not edit. The classes, over a backend.", "",
               "export function makeClasses({ Handle, Recorded, Call, bare, call, direct, handleOf, newHandle, none, read, scalar, written }) {"]
        for name, struct in self.structs.items():
            out += self.filler(struct) if name in taken and struct.asked() else []
        self.methods = {}
        for handle, methods in self.groups:
            name = camel(handle["name"])
            counts = counts_of(handle, self.groups, self.structs)
            out += ["", f"  class {name} extends {'Recorded' if recorded(methods) else 'Handle'} {{", f"    static destroy = '{next((m.name for m in methods if m.kind == 'destroy'), '')}';",
                    f"    static counts = [{', '.join(repr(c) for c in counts)}];"]
            for count in counts:
                out += [f"    get {js(count)}() {{", f"      return this._n.{count};", "    }"]
            told, plans = [], []
            for m in methods:
                if m.kind != "destroy":
                    lines, plan = self.method(m)
                    out += [""] + lines
                    plans.append(plan)
                    told += [a.item["type"] for a in plan.arguments if a.role == "info" and m.own and a.item["type"] not in told]
            for struct in told:
                out += ["", f"    get {js(struct[3:])}() {{", f"      return Call.told(this, '{struct}').toObject();", "    }"]
            out.append("  }")
            self.methods[name] = (handle, methods, plans, told, counts)
        out += ["", "  return { " + ", ".join(camel(h["name"]) for h, _ in self.groups) + " };", "}"]
        return "\n".join(out) + "\n"


def write(api):
    writer = Writer(api)
    return {"js/src/classes.js": writer.classes(), "js/src/index.d.ts": writer.types()}
