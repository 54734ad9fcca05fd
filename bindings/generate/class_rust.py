"""bindings/rust/src/api.rs: the objects, options and results of the Rust crate. What core.rs and call.rs do by hand: errors, slices
to pointers and counts, room for arrays that grow."""

import re

import comments
from layer_rust import RESERVED as WORDS, TYPES, safe as raw_safe
from model import named, symbols
from plan import FIRST, camel, classes, counts_of, dims_used, edits, moves, recorded
from steps import Planner, field_steps, least
from words import Words, class_words, fold, method_words, wrapped

PAIRS = {"float": "Reals", "uint32_t": "Indices"}  # slices that may be of either of two types
RESERVED = WORDS | {"c", "code", "room", "handle_", "made"}


def safe(name):
    return name.rstrip("_") + "_" if name.endswith("_") else "r#" + name if name in WORDS else name


class Spoken:
    null, no_index, error = "`None`", "[`raw::HF_NO_INDEX`]", staticmethod(lambda constant: f"[`raw::{constant}`]")

    def constant(self, enum, member):
        return f"[`raw::{member['name']}`]"

    def enum(self, enum):
        return f"`{enum['prefix']}*`"

    def method(self, m):
        return "try_clone" if m.kind == "clone" else m.title()

    def shape(self, sizes):
        return "`[" + " x ".join(sizes) + "]`"  # without the marks rustdoc takes it for a link


class Steps:
    """Steps of steps.py as lines of Rust. options: inside the `fill` of a struct of options; fresh: a new array is returned."""

    def __init__(self, writer, plan=None, options=None, fresh=False):
        self.w, self.plan, self.options, self.fresh, self.records = writer, plan, options, fresh, set()
        self.required = {a.name for a in plan.arguments if a.required} if plan else set()
        self.twin = bool(plan) and any(a.role == "type" for a in plan.arguments)
        self.fills = {a.name for a in plan.arguments if a.role == "fill"} if plan else set()

    def lines(self, op, values):
        return getattr(self, "do_" + op)(**values)

    def dims(self, dims):
        counted = {f["name"] for f in self.options.counts} if self.options else set()
        return "&[" + ", ".join(f'&format!("{{prefix}}{d}")' if symbols([d]) & counted else f'"{d}"' for d in dims) + "]"

    def given(self, name):
        """An option, or an argument."""
        here = self.options and name not in self.w.ahead(self.options)
        return f"self.{safe(name)}" if here else safe(name)

    def maybe(self, name):
        return f"Some({safe(name)})" if name in self.required else self.given(name)

    def number(self, item, name):
        return f"i32::from({name})" if item["role"] == "flag" else name

    def value(self, v, parameter):
        kind, *rest = v
        borrow = "&" if parameter["const"] or parameter["view"] else "&mut "  # a view is read, what it views is not
        if kind == "number":
            return self.number(rest[1], safe(rest[0]))
        if kind == "handle":
            return f"{safe(rest[0])}.handle" if rest[0] in self.required else f"{safe(rest[0])}.map_or(std::ptr::null_mut(), |o| o.handle)"
        if kind == "place":
            return safe(rest[0])
        if kind == "var":
            return f"{safe(rest[0])}.as_ptr()" if rest[0] in self.records else safe(rest[0])
        if kind == "address":
            if rest[0] in self.fills:
                return f"{rest[0]}_at"
            return f"{safe(rest[0])}.as_mut_ptr()" + (".cast()" if rest[0] == "out" and self.twin or parameter["type"] in ("void", "char") else "")
        return {"self": "self.handle", "null": "std::ptr::null_mut()"}.get(kind) or {
            "ref": "{borrow}{name}", "ref_if": "{borrow}{name}", "text": "c.text({name})?", "figure": "&mut {name}", "count": 'c.count("{raw}", 1)?',
            "info": "&mut {name}", "room": 'c.count("{raw}", 0)?', "grown": "{raw}_at", "literal": "{raw}",
            "size_of": "{name}.len()"}[kind].format(borrow=borrow, name=safe(rest[0]), raw=rest[0])

    def called(self, function, values):
        parameters = self.w.function(function)["parameters"]
        return f"raw::{function}({', '.join(self.value(v, p) for v, p in zip(values, parameters))}"

    def do_forget(self, key):
        return [f'c.sizes.remove("{key}"); // of the list given here']

    def do_known(self, key, default):
        name = self.given(key)
        learn = f'c.learn("{key}", {name} as usize);'
        return [f'c.learn("{key}", if {name} == 0 {{ {default} }} else {{ {name} as usize }});' if default else f"if {name} > 0 {{ {learn} }}"]

    def do_struct(self, var, type, fields):
        struct = named(self.w.api["structs"], type)
        sets = [f"{raw_safe(f)}: {self.number(named(struct['fields'], f), self.given(f))}, " for f in fields]
        return [f"let mut {safe(var)} = raw::{type} {{ {''.join(sets)}..Default::default() }};"]

    def do_desc(self, var, struct, names, prefix):
        ahead = "".join(f", {self.w.ahead_value(struct, n)}" for n in self.w.ahead(struct))
        mutable = "mut " * bool(struct.filled)
        who = self.w.options_argument(self.plan) if self.w.fields_of(struct) else f"{self.w.options_name(struct)} {{}}"
        return [f'let {mutable}desc = {who}.fill(&mut c, "{prefix}"{ahead})?;']

    def do_record(self, var, type, fields, dims):
        return [f"let mut {safe(var)} = raw::{type}::default();"] + [
            f"if let Some(given) = {safe(name)} {{ {safe(var)}.{raw_safe(f['name'])} = given; }}" for f, name in fields]

    def do_records(self, var, type, fields, dims):
        self.records.add(var)
        lines = [f"let mut {safe(var)} = vec![raw::{type}::default(); c.product({self.dims(dims)})];"]
        for f, name in fields:
            lines += [f"if let Some(given) = {safe(name)} {{", f'    c.fit(given.len(), "{name}", &["{f["count"]}", "{dims[0]}"])?;',
                      f"    for (row, numbers) in {safe(var)}.iter_mut().zip(given.chunks_exact({f['count']})) {{",
                      f"        row.{f['name']}.copy_from_slice(numbers);", "    }", "}"]
        return lines

    def do_array(self, var, name, item):
        if item["view"]:
            return [f"let {safe(var)} = {self.view(name, item, self.dims(item['dims']))};"]
        return [f'let {safe(var)} = c.array({self.maybe(name)}, "{name}", {self.dims(item["dims"])})?;']

    def view(self, name, item, dims):
        """An hf_array: of slices of either type, or of the only one."""
        given = self.maybe(name)
        if item["twin"] and name in self.required:
            return f'c.view(Some({safe(name)}.into().numbers()), "{name}", {dims})?'
        numbers = f"{PAIRS[item['type']]}::numbers" if item["twin"] else "|v| Indices::U32(v).numbers()"
        return f'c.view({given}.map({numbers}), "{name}", {dims})?'

    def do_rows(self, struct, field, name, var="desc"):
        given, dims, target = self.maybe(name), self.dims(field["dims"]), f"{safe(var)}.{raw_safe(field['name'])}"
        for missing, other in field["without"].items():
            one, two = (self.view(name, field, d) if field["view"] else f'c.array({given}, "{name}", {d})?' for d in (self.dims(other), dims))
            return [f"{target} = if {self.given(missing)}.is_none() {{ {one} }} else {{ {two} }};"]
        if field["view"]:
            return [f"{target} = {self.view(name, field, dims)};"]
        return [f'{target} = c.array({given}, "{name}", {dims})?;']

    def do_fields(self, struct, var):
        lines, name = [], safe(var)
        for op, values in field_steps(self.w.api, struct):
            lines += self.do_rows(**values, var=var) if op == "rows" else getattr(self, "field_" + op)(name, **values)
        for f in struct.inner:
            lines += [f"if let Some(inner) = &{self.given(f['name'])} {{", f'    let inner = inner.fill(c, "{f["name"]}.")?;', f"    {name}.{f['name']} = c.keep(inner);", "}"]
        for f in struct.counts:
            key = f'&format!("{{prefix}}{f["name"]}")' if self.options else f'"{f["name"]}"'
            lines.append(f'{name}.{f["name"]} = c.count({key}, {least(f)})?;')
        return lines

    def field_ragged(self, var, counts, field):
        name = field["name"]
        return [f'({var}.{counts["name"]}, {var}.{name}) = c.lists({self.given(name)}, "{name}", {self.dims(counts["dims"])})?;']

    def field_written(self, var, field):
        return [f'{var}.{field["name"]} = c.array({self.given(field["name"])}, "{field["name"]}", {self.dims(field["dims"])})?;']

    def field_blob(self, var, field, count):
        given = self.given(field["name"])
        return [f"{var}.{field['name']} = {given}.map_or(std::ptr::null(), start).cast();", f"{var}.{count} = {given}.map_or(0, <[u8]>::len);"]

    def field_text(self, var, field):
        return [f"{var}.{field['name']} = c.text({self.given(field['name'])})?;"]

    def field_fixed(self, var, field):
        return [f"if let Some(given) = {self.given(field['name'])} {{ {var}.{field['name']} = given; }}"]

    def field_handle(self, var, field):
        return [f"{var}.{field['name']} = {self.given(field['name'])}.map_or(std::ptr::null_mut(), |o| o.handle);"]

    def do_out(self, var, item, twin, given):
        dims = self.dims(item["dims"])
        if given and not self.fresh:
            return [f'c.fit(out.len(), "out", {dims})?;']
        kind = "f64" if given and twin else TYPES[item["type"]]
        return [f"let mut {safe(var)} = vec![{kind}::default(); c.product({dims})];"]

    def do_fill(self, var, item, twin, given):
        if self.fresh:
            return [f"let {var}_at: *mut {TYPES[item['type']]} = std::ptr::null_mut();"]
        return [f'let {var}_at = c.fill({var}, "{var}", {self.dims(item["dims"])})?;']

    def out_view(self, var, item):
        if var in self.fills:
            return f'c.out({var}_at, "{item["dims"][0]}")'
        return f'c.out({safe(var)}.as_mut_ptr(), "{item["dims"][0]}")'

    def do_view(self, var, name, item):
        return [f"let {safe(var)} = {self.out_view(name, item)};"]

    def do_point(self, var, field, twin, optional):
        plain = f"{var}_at" if optional else "out.as_mut_ptr()"
        return [f"desc.{field['name']} = {self.out_view(var, field) if field['view'] else plain};"]

    def do_scalar(self, var, item):
        return [f"let mut {safe(var)} = {TYPES[item['type']]}::default();"]

    def do_info(self, var, type, optional):
        return [] if optional else [f"let mut {safe(var)} = raw::{type}::default();"]

    def do_call(self, function, values):
        lines = ["// SAFETY: every slice is as long as its check says.", f"check(unsafe {{ {self.called(function, values)}) }})?;"]
        return lines + (["self.counts.extend(surface.counts.clone());"] if moves(function) else [])

    def do_returns(self, function, values):
        return ["// SAFETY: the handle is valid.", f"unsafe {{ {self.called(function, values)}) }}"]

    def do_make(self, made, function, values, kind):
        parameters = self.w.function(function)["parameters"]
        given = ", ".join([*(self.value(v, p) for v, p in zip(values, parameters)), "&mut handle_"])
        counts = ", ".join(f'"{k}"' for k in self.w.counts)
        made = f"{camel(self.w.noun)} {{ handle: handle_, counts: c.counts(&[{counts}]) }}"
        end = [f"let mut made = {made};", "let info = made.info()?;", 'made.counts.insert("vertex_count".into(), info.vertex_count as usize);', "Ok(made)"]
        return ["let mut handle_ = std::ptr::null_mut();", "// SAFETY: every slice is as long as its check says.", f"check(unsafe {{ raw::{function}({given}) }})?;",
                *(end if edits(function) else [f"Ok({made})"])]

    def do_bytes(self, function, first, second):
        return ["let mut size = 0;", "// SAFETY: the first call asks for the size.", f"check(unsafe {{ {self.called(function, first)}) }})?;", "let mut block = vec![0u8; size];",
                f"check(unsafe {{ {self.called(function, second)}) }})?;"]

    def kind(self, item):
        return f"raw::{item['type']}" if named(self.w.api["structs"], item["type"]) else TYPES[item["type"]]

    def do_grow(self, function, owner, values, tell, rooms, arrays, into):
        lines = ["let mut count = 0;"] if any(var == "count" for _, var, _ in tell) else []
        lines += [f'c.learn("{key}", {f"c.size({chr(34)}{known}{chr(34)}).unwrap_or(Call::FIRST)" if known else "Call::FIRST"});' for key, known in rooms]
        mine = {name: f"all_{name}" if into else safe(name) for name, _, _ in arrays}
        lines += [*(f"let mut {mine[name]}: Vec<{self.kind(item)}> = Vec::new();" for name, item, _ in arrays), "loop {"]
        lines += [f'    {safe(into)}.{key} = c.count("{key}", 0)?;' for key, _ in rooms if into]
        for name, item, on_request in arrays:
            room = f"c.room(&mut {mine[name]}, {self.dims(item['dims'])})"
            room = f"if want_{name} {{ {room} }} else {{ std::ptr::null_mut() }}" if on_request else room
            lines.append(f"    {safe(into) + '.' + name if into else f'let {name}_at'} = {room};")
        lines += ["    // SAFETY: the arrays have the room that the call is told.", f"    let code = unsafe {{ {self.called(function, values)}) }};"]
        told = ", ".join(f'("{key}", {safe(var)}{"." + field if field else ""})' for key, var, field in tell)
        lines += [f"    if c.enough(code, &[{told}])? {{", "        break;", "    }", "}"]
        return lines + [f"{mine[name]}.truncate(c.product({self.dims(item['dims'])}));" for name, item, _ in arrays]


class Writer:
    def __init__(self, api):
        self.api = api
        self.groups, self.structs = classes(api)
        self.words = Words(api, self.groups, Spoken())
        self.words.table.update({name: f"[`{self.options_name(s)}`]" if s.struct["used"] == "in" else f"[`raw::{name}`]" for name, s in self.structs.items()})
        for handle, methods in self.groups:
            for m in methods:
                known = "new" if m.function["verb"] == "create" else Spoken().method(m)
                self.words.table[m.name] = f"`{camel(handle['name'])}::{known}`"
        self.sizes = set().union(*(dims_used(methods, self.structs) for _, methods in self.groups))
        self.results = {}

    def function(self, name):
        return named(self.api["functions"], name)

    def doc(self, text, indent):
        text = self.words.say(text or "As the header says.").replace("<", "&lt;")
        lines = []
        for line in wrapped(text, 118 - indent):
            lines.append((" " * indent + "/// " + line.strip()).rstrip())
        return lines

    # ---- options ----

    def is_inner(self, struct):
        return any(f["type"] == struct.name for s in self.structs.values() for f in s.inner)

    def ahead(self, struct):
        """Fields that are arguments of their own in front of the options."""
        return () if self.is_inner(struct) else FIRST.get(struct.name, ())

    def options_name(self, struct):
        plain = re.sub("Desc$", "", camel(struct.name))
        figures = [f for f in struct.scalars if f["name"] not in self.ahead(struct)]
        if any(plain == camel(h["name"]) for h, _ in self.groups):
            return plain + "Options"
        return plain + ("Options" if (figures or not struct.given) and struct.name.endswith("_desc") and not self.is_inner(struct) else "")

    def fields_of(self, struct):
        return [f for f, _ in struct.asked() if f["name"] not in self.ahead(struct)]

    def borrows(self, struct):
        return any(f["role"] not in ("scalar", "enum", "flag", "fixed") and (f["role"] != "struct" or self.borrows(self.structs[f["type"]])) for f in self.fields_of(struct))

    def hint(self, item, struct, required=False, life="'a "):
        role = item["role"]
        if role in ("scalar", "enum"):
            return TYPES[item["type"]]
        if role == "flag":
            return "bool"
        if role == "fixed":
            kind = f"[{TYPES[item['type']]}; {item['count']}]"
        elif role == "array" and struct and item["name"] in struct.ragged:
            return f"Option<&{life}[&{life}[u32]]>"
        elif role == "array":
            twin = item.get("twin")
            kind = f"{PAIRS[item['type']]}<{life.strip() or chr(39) + '_'}>" if twin else f"&{life}[{self.element(item)}]"
        else:
            inner = self.structs.get(item["type"])
            kind = {"handle": f"&{life}{camel(item['type'])}", "bytes": f"&{life}[u8]", "string": f"&{life}[&{life}str]",
                    "struct": inner and self.options_name(inner) + (f"<{life.strip() or chr(39) + '_'}>" if self.borrows(inner) else "")}[role]
        return kind if required else f"Option<{kind}>"

    def element(self, item):
        return f"raw::{item['type']}" if named(self.api["structs"], item["type"]) else TYPES[item["type"]]

    def options(self, struct):
        name, fields = self.options_name(struct), self.fields_of(struct)
        life = "<'a>" if self.borrows(struct) else ""
        out = ["", *self.doc(struct.struct["doc"], 0), "#[derive(Clone, Copy, Debug, Default, PartialEq)]", f"{'pub ' if fields else ''}struct {name}{life} {{"]
        for f in fields:
            out += self.doc(f["doc"], 4) + [f"    pub {safe(f['name'])}: {self.hint(f, struct)},"]
        given = "".join(f", {safe(n)}: {self.hint(named(struct.struct['fields'], n), struct, life='')}" for n in self.ahead(struct))
        steps = Steps(self, options=struct)
        body = steps.do_struct("desc", struct.name, [f["name"] for f in struct.scalars])
        body += [line for f in struct.scalars if f["name"] in self.sizes for line in steps.do_known(f["name"], comments.default_of(f["doc"]))]
        body += steps.do_fields(struct, "desc")
        out += ["}", f"impl{life} {name}{life} {{"]
        numbers = [f for f in fields if f["role"] in ("scalar", "enum", "flag")]
        if numbers:
            out += ["    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.",
                    "    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {", "        match name {"]
            out += [f'            "{f["name"]}" => self.{safe(f["name"])} = {self.fits(f)},' for f in numbers]
            out += ['            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),', "        }", "        Ok(())", "    }", ""]
        out += fold(f"pub(crate) fn fill(&self, c: &mut Call, prefix: &str{given}) -> Result<raw::{struct.name}> {{", 4)
        out += indented(body + ["Ok(desc)"], 8) + ["    }", "}"]
        return out

    def fits(self, item):
        """A number as an option of this type."""
        return "whole::<u8>(name, value, 1.0)? == 1" if item["role"] == "flag" else "value" if TYPES[item["type"]] == "f64" else "whole(name, value, f64::MAX)?"

    # ---- methods ----

    def argument(self, a, plan):
        if a.role == "place":
            return f"{safe(a.name)}: &raw::hf_place"
        if a.role == "fill":
            return f"{safe(a.name)}: Option<&mut [{TYPES[a.item['type']]}]>"
        if a.role == "request":
            return f"want_{a.name}: bool"
        if a.role == "text":
            return f"{safe(a.name)}: Option<&[&str]>"
        if a.role == "array" and a.item.get("twin") and a.required:
            return f"{safe(a.name)}: impl Into<{PAIRS[a.item['type']]}<'i>>"
        if a.role == "array" and a.item["role"] == "fixed" or (a.role == "fixed" and a.name != a.item["name"]):
            return f"{safe(a.name)}: Option<&[{TYPES[a.item['type']]}]>"
        return f"{safe(a.name)}: {self.hint(a.item, a.struct, a.required, life='')}"

    def signature(self, plan, into):
        m, parts = plan.method, []
        desc = self.structs[m.flat[0]["type"]] if m.flat else None
        shown = [a for a in plan.arguments if a.role not in ("info", "out", "type")]
        if m.own and m.kind != "create":
            changes = re.search(r"Thread safety:[^.]*\bchanges `" + m.own["name"], m.function["doc"])
            parts.append("&mut self" if changes else "&self")
        parts += [self.argument(a, plan) for a in shown if a.required and a.struct is None]
        parts += [f"{safe(n)}: {self.ahead_hint(desc, n)}" for n in (self.ahead(desc) if desc else ())]
        out = next((a for a in plan.arguments if a.role == "out"), None)
        if into:
            parts.append(f"out: &mut [{'P' if any(a.role == 'type' for a in plan.arguments) else TYPES[out.item['type']]}]")
            parts += [self.argument(a, plan) for a in shown if a.role == "fill"]
        elif not out:
            parts += [self.argument(a, plan) for a in shown if a.role == "fill"]
        if desc and self.fields_of(desc):
            parts.append(f"{self.options_argument(plan)}: &{self.options_name(desc)}")
        parts += [self.argument(a, plan) for a in shown if not a.required and a.role != "fill" and a.struct is None or a.role == "request" or (
            a.struct is not None and not m.flat)]
        return ", ".join(parts)

    def options_argument(self, plan):
        name = plan.method.flat[0]["name"]
        return "options" if name == "desc" else safe(name)

    def ahead_hint(self, desc, name):
        """Slices that the call is about stand without Some, unless the header says that they may be NULL."""
        item = named(desc.struct["fields"], name)
        if item["role"] == "array" and item.get("twin"):
            return f"impl Into<{PAIRS[item['type']]}<'i>>"
        return self.hint(item, desc, life="") if item["optional"] else re.sub(r"^Option<(.*)>$", r"\1", self.hint(item, desc, life=""))

    def ahead_value(self, desc, name):
        item = named(desc.struct["fields"], name)
        if item["role"] == "array" and item.get("twin"):
            return f"Some({safe(name)}.into())"
        return f"Some({safe(name)})" if item["role"] == "array" and not item["optional"] else safe(name)

    def returned(self, plan):
        found = []
        for kind, name, item in plan.results:
            if kind == "array":
                found.append(("out" if name == "out" else safe(name), None if name == "out" else f"Vec<{TYPES[item['type']]}>"))
            elif kind == "grown":
                found.append((safe(name), f"Vec<{self.element(item)}>"))
            elif kind == "bytes":
                found.append(("block", "Vec<u8>"))
            elif kind == "string":
                found.append(("String::from_utf8_lossy(block.strip_suffix(&[0]).unwrap_or(&block)).into_owned()", "String"))
            elif kind == "figure":
                found.append((safe(name), TYPES[item["type"]]))
            elif kind == "info":
                optional = named(self.structs[item["type"]].struct["fields"], "found")
                kind = f"raw::{item['type']}"
                found.append((f"({safe(name)}.found != 0).then_some({safe(name)})", f"Option<{kind}>") if optional else (safe(name), kind))
            elif kind == "arrays":
                self.results[item.name] = item
                figures = [f for f in item.results + [f for f in item.scalars if f["name"] in self.sizes]]
                sets = [f"{safe(f['name'])}: {safe(name)}.{raw_safe(f['name'])}" for f in figures] + [f"{safe(f['name'])}: all_{f['name']}" for f in item.filled]
                found.append((f"{camel(item.name)} {{ {', '.join(sets)} }}", camel(item.name)))
        return found

    def method(self, m):
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        out = next((a for a in plan.arguments if a.role == "out"), None)
        lines = []
        for fresh in ((True, False) if out else (False,)):
            lines += [""] + self.one(plan, fresh, bool(out) and not fresh)
        return lines

    def one(self, plan, fresh, into):
        m = plan.method
        twin = any(a.role == "type" for a in plan.arguments)
        results = self.returned(plan)
        told = [a for a in plan.arguments if a.role == "info"]
        out_item = next((a.item for a in plan.arguments if a.role == "out"), None)
        if into:
            results = [r for r in results if r[1]]
        elif fresh:
            results = [(e, t or f"Vec<{'f64' if twin else TYPES[out_item['type']]}>") for e, t in results]
        if not fresh:
            results += [(safe(a.name), f"raw::{a.item['type']}") for a in told]
        makes = m.kind in ("create", "clone", "derive")
        plain = m.function["returns"]["type"] not in ("hf_result", "void")
        kinds = [t for _, t in results]
        returns = "Self" if makes else "()" if not kinds else kinds[0] if len(kinds) == 1 else f"({', '.join(kinds)})"
        returns = TYPES[m.function["returns"]["type"]] if plain else f"Result<{returns}>"
        name = "new" if m.function["verb"] == "create" else Spoken().method(m) + "_into" * into
        signature = self.signature(plan, into)
        generics = [g for g, has in (("'i", "<'i>" in signature), ("P: Real", into and twin)) if has]
        head = f"pub fn {safe(name)}{'<' + ', '.join(generics) + '>' if generics else ''}({signature}) -> {returns} {{"
        steps, body = Steps(self, plan, fresh=fresh), []
        if not plain:
            body.append("let mut c = Call { sizes: self.counts.clone(), ..Default::default() };" if m.own and m.kind != "create" else "let mut c = Call::default();")
            body += [f'c.parent("{p["name"]}", &{safe(p["name"])}.counts);' for p in m.parents if not p["optional"]]
        body += [f"let mut {safe(a.name)} = raw::{a.item['type']}::default();" for a in told]
        for op, values in plan.steps:
            body += steps.lines(op, values)
        if not makes and not plain:
            expressions = [e for e, _ in results]
            body.append("Ok(())" if not expressions else f"Ok({expressions[0]})" if len(expressions) == 1 else f"Ok(({', '.join(expressions)}))")
        words = method_words(plan, "Fails with", options=self.fields_of(self.structs[m.flat[0]["type"]]) if m.flat else ())
        if into:
            words = f"As `{m.title()}`, into a slice of yours." + ("" if not told else f" Returns the figures of the call.")
        return self.doc(words, 4) + [*fold(head, 4), *indented(body, 8), "    }"]

    def class_of(self, handle, methods):
        name = camel(handle["name"])
        self.noun, self.counts = handle["name"], counts_of(handle, self.groups, self.structs)
        destroy = next(m.name for m in methods if m.kind == "destroy")
        out = ["", "object!(", *self.doc(class_words(handle, [], self.structs), 4), f"    {name}: {handle['name']}, {destroy}", ");", f"impl {name} {{"]
        body = [line for m in methods if m.kind != "destroy" for line in self.method(m)]
        for count in self.counts:
            what = "Vertices of the surface, as given." if count == "vertex_count" else "As it was made with."
            body += ["", f"    /// {what}", f"    pub fn {count}(&self) -> usize {{", f'        self.counts.get("{count}").copied().unwrap_or(0)', "    }"]
        out += body[1:] + ["}"]
        if recorded(methods):
            out += [f"impl TryClone for {name} {{", "    fn try_clone(&self) -> Result<Self> {", f"        {name}::try_clone(self)", "    }", "}"]
        return out

    def result_class(self, item):
        out = ["", *self.doc(item.struct["doc"], 0), "#[derive(Clone, Debug, Default, PartialEq)]", f"pub struct {camel(item.name)} {{"]
        for f in item.filled + item.results + [f for f in item.scalars if f["name"] in self.sizes]:
            kind = TYPES[f["type"]]
            out += self.doc(re.sub(r"^(in|out)[:;]?\s*", "", f["doc"]), 4) + [f"    pub {safe(f['name'])}: {f'Vec<{kind}>' if f in item.filled else kind},"]
        return out + ["}"]

    def write(self):
        bodies = [line for handle, methods in self.groups for line in self.class_of(handle, methods)]
        taken = {p["type"] for _, methods in self.groups for m in methods for p in m.flat}
        taken |= {f["type"] for s in self.structs.values() for f in s.inner}
        options = [line for name, s in self.structs.items() if name in taken and s.asked() for line in self.options(s)]
        results = [line for item in self.results.values() for line in self.result_class(item)]
        head = ["// Generated from include/hf/*.h by bindings/generate; do not edit.", "//! The objects, their options and results.",
                "#![allow(unused_mut, unused_variables, clippy::all)]",
                "use crate::call::{object, start, whole, Call, Indices, Reals};", "use crate::core::{check, Real, TryClone};",
                "use crate::{raw, Error, Result};"]
        return "\n".join(head + options + results + bodies) + "\n"


def indented(lines, pad):
    out = []
    for line in lines:
        text = line.lstrip()
        out += fold(text, pad + len(line) - len(text), 4) if text else [""]
    return out


def write(api):
    return {"rust/src/api.rs": Writer(api).write()}
