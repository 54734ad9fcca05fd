"""include/hf/hf.hpp: the classes, options and results of C++. What call.hpp does by hand: errors, handles, vectors to pointers and
counts, room for arrays that grow."""

import re

import class_rust
import comments
from model import named, symbols
from plan import camel, counts_of, dims_used, edits, moves
from steps import Planner, desc_steps, field_steps, least
from words import Words, class_words, fold, method_words, wrapped

RESERVED = {"c", "raw", "room", "code", "register", "operator", "union", "new", "delete", "default"}
PAIRS = {"float": "Reals", "uint32_t": "Indices"}


def safe(name):
    return name + "_" if name in RESERVED else name


class Spoken(class_rust.Spoken):
    null, no_index, error = "none", "HF_NO_INDEX", staticmethod(lambda constant: constant)

    def constant(self, enum, member):
        return member["name"]

    def enum(self, enum):
        return enum["prefix"] + "*"

    def method(self, m):
        return title(m)


def title(m):
    return m.noun[3:] if m.title() == "get" else m.title()  # get() is the handle


class Steps:
    """Steps of steps.py as lines of C++. options: inside the `fill` of a struct of options."""

    def __init__(self, writer, plan=None, options=None, kind=None):
        self.w, self.plan, self.options, self.kind, self.records = writer, plan, options, kind, set()
        self.required = {a.name for a in plan.arguments if a.required} if plan else set()
        self.ahead = set()
        self.fills = {a.name for a in plan.arguments if a.role == "fill"} if plan else set()

    def lines(self, op, values):
        return getattr(self, "do_" + op)(**values)

    def dims(self, dims):
        counted = {f["name"] for f in self.options.counts} if self.options else set()
        return "{" + ", ".join(f'prefix + "{d}"' if symbols([d]) & counted else f'"{d}"' for d in dims) + "}"

    def given(self, name):
        return f"{safe(name)}"

    def needed(self, name):
        return "true" if name in self.required or name in self.ahead else "false"

    def number(self, item, name):
        return f"{name} ? 1 : 0" if item["role"] == "flag" else name

    def value(self, v, parameter):
        kind, *rest = v
        if kind == "number":
            return self.number(rest[1], safe(rest[0]))
        if kind == "handle":
            return f"{safe(rest[0])}.get()" if rest[0] in self.required else f"{safe(rest[0])} ? {safe(rest[0])}->get() : nullptr"
        if kind == "place":
            return "&" + safe(rest[0])
        if kind == "var":
            return f"{safe(rest[0])}.data()" if rest[0] in self.records else safe(rest[0])
        if kind == "address":
            if parameter["type"] == "char":
                return f"reinterpret_cast<char*>({safe(rest[0])}.data())"
            return f"{rest[0]}_at" if rest[0] in self.fills else "out" if rest[0] == "out" else f"{safe(rest[0])}.data()"
        if kind == "info":
            return safe(rest[0])
        return {"self": "get()", "null": "nullptr"}.get(kind) or {
            "ref": "&{name}", "ref_if": "&{name}", "text": "c.text({name})", "figure": "&{name}", "count": 'c.count("{raw}", 1)',
            "room": 'c.count("{raw}", 0)', "grown": "{raw}_at", "literal": "{raw}", "size_of": "{name}.size()"}[kind].format(name=safe(rest[0]), raw=rest[0])

    def called(self, function, values):
        parameters = self.w.function(function)["parameters"]
        return f"{function}({', '.join(self.value(v, p) for v, p in zip(values, parameters))})"

    def do_forget(self, key):
        return [f'c.sizes.erase("{key}");  // of the list given here']

    def do_known(self, key, default):
        name = self.given(key)
        return [f'c.known("{key}", {f"{name} ? {name} : {default}" if default else name});']

    def do_struct(self, var, type, fields):
        struct = named(self.w.api["structs"], type)
        return [f"auto {safe(var)} = make<{type}>();"] + [f"{safe(var)}.{f} = {self.number(named(struct['fields'], f), self.given(f))};" for f in fields]

    def do_desc(self, var, struct, names, prefix):
        ahead = "".join(f", {safe(n)}" for n in self.w.ahead(struct))
        const = "" if struct.filled else "const "
        who = self.w.options_argument(self.plan) if self.w.fields_of(struct) else f"{self.w.options_name(struct)}()"
        return [f'{const}{struct.name} {var} = {who}.fill(c, "{prefix}"{ahead});']

    def do_record(self, var, type, fields, dims):
        return [f"{type} {safe(var)}{{}};"] + [f"if ({safe(n)}) std::copy({safe(n)}->begin(), {safe(n)}->end(), {safe(var)}.{f['name']});" for f, n in fields]

    def do_records(self, var, type, fields, dims):
        self.records.add(var)
        lines = [f"std::vector<{type}> {safe(var)}(c.product({self.dims(dims)}));"]
        for f, name in fields:
            lines += [f'need({safe(name)}.empty() ? {safe(var)}.size() * {f["count"]} : {safe(name)}.size(), {safe(var)}.size() * {f["count"]}, "{name}");',
                      f"for (size_t i = 0; i < {safe(name)}.size(); ++i) {safe(var)}[i / {f['count']}].{f['name']}[i % {f['count']}] = {safe(name)}[i];"]
        return lines

    def do_array(self, var, name, item):
        if item["view"]:
            return [f'const hf_array {safe(var)} = c.view({safe(name)}, {self.needed(name)}, "{name}", {self.dims(item["dims"])});']
        return [f'const {item["type"]}* {safe(var)} = c.array({safe(name)}, {self.needed(name)}, "{name}", {self.dims(item["dims"])});']

    def do_rows(self, struct, field, name, var="desc"):
        given, dims = self.given(name), self.dims(field["dims"])
        for missing, other in field["without"].items():
            dims = f"{self.given(missing)}.empty() ? Dims{self.dims(other)} : Dims{dims}"
        if field["view"]:
            return [f'{safe(var)}.{field["name"]} = c.view({given}, {self.needed(name)}, "{name}", {dims});']
        return [f'{safe(var)}.{field["name"]} = c.array({given}, {self.needed(name)}, "{name}", {dims});']

    def do_fields(self, struct, var):
        lines, name = [], safe(var)
        for op, values in field_steps(self.w.api, struct):
            lines += self.do_rows(**values, var=var) if op == "rows" else getattr(self, "field_" + op)(name, **values)
        for f in struct.inner:
            lines.append(f'if ({self.given(f["name"])}) {name}.{f["name"]} = c.keep({self.given(f["name"])}->fill(c, "{f["name"]}."));')
        for f in struct.counts:
            key = f'prefix + "{f["name"]}"' if self.options else f'"{f["name"]}"'
            lines.append(f'{name}.{f["name"]} = c.count({key}, {least(f)});')
        return lines

    def field_ragged(self, var, counts, field):
        name = field["name"]
        return [f'c.lists({self.given(name)}, {self.needed(name) if not field["optional"] else "false"}, &{var}.{counts["name"]}, &{var}.{name}, "{name}", {self.dims(counts["dims"])});']

    def field_written(self, var, field):
        return [f'{var}.{field["name"]} = c.array({self.given(field["name"])}, false, "{field["name"]}", {self.dims(field["dims"])});']

    def field_blob(self, var, field, count):
        given = self.given(field["name"])
        return [f"{var}.{field['name']} = {given}.empty() ? nullptr : {given}.data();", f"{var}.{count} = {given}.size();"]

    def field_text(self, var, field):
        return [f"{var}.{field['name']} = c.text({self.given(field['name'])});"]

    def field_fixed(self, var, field):
        given = self.given(field["name"])
        return [f"if ({given}) std::copy({given}->begin(), {given}->end(), {var}.{field['name']});"]

    def field_handle(self, var, field):
        given = self.given(field["name"])
        return [f"{var}.{field['name']} = {given} ? {given}->get() : nullptr;"]

    def do_out(self, var, item, twin, given):
        dims = self.dims(item["dims"])
        if given:
            return [f'need(size, c.product({dims}), "out");']
        return [f"std::vector<{item['type']}> {safe(var)}(c.product({dims}));"]

    def do_fill(self, var, item, twin, given):
        return [f"if ({var}) {var}->resize(c.product({self.dims(item['dims'])}));", f"{item['type']}* {var}_at = {var} ? {var}->data() : nullptr;"]

    def out_view(self, var, item):
        place = f"{var}_at" if var in self.fills else "out" if var == "out" else f"{safe(var)}.data()"
        return f'c.out({place}, "{item["dims"][0]}")'

    def do_view(self, var, name, item):
        return [f"const hf_array_out {safe(var)} = {self.out_view(name, item)};"]

    def do_point(self, var, field, twin, optional):
        plain = f"{var}_at" if optional else "out"
        return [f"desc.{field['name']} = {self.out_view(var, field) if field['view'] else plain};"]

    def do_scalar(self, var, item):
        return [f"{item['type']} {safe(var)} = 0;"]

    def do_info(self, var, type, optional):
        return [f"auto {safe(var)}_ = make<{type}>();", f"if (!{safe(var)}) {safe(var)} = &{safe(var)}_;"] if optional else [f"auto {safe(var)} = make<{type}>();"]

    def do_call(self, function, values):
        lines = [f"check({self.called(function, values)});"]
        return lines + (['counts_["vertex_count"] = known(surface.known_counts(), "vertex_count");'] if moves(function) else [])

    def do_returns(self, function, values):
        return [f"return {self.called(function, values)};"]

    def do_make(self, made, function, values, kind):
        parameters = self.w.function(function)["parameters"]
        given = ", ".join([*(self.value(v, p) for v, p in zip(values, parameters)), "&raw"])
        counts = ", ".join(f'"{k}"' for k in self.w.counts)
        end = f"own(raw, c.counts({{{counts}}}));" if made == "self" else f"return {camel(self.w.noun)}(raw, c.counts({{{counts}}}));"
        if edits(function):
            end = [end.replace("return ", "").replace("(raw", " made(raw", 1), 'made.counts_["vertex_count"] = made.info().vertex_count;', "return made;"]
        return [f"{self.w.noun} raw = nullptr;", f"check({function}({given}));", *(end if edits(function) else [end])]

    def do_bytes(self, function, first, second):
        return ["size_t size = 0;", f"check({self.called(function, first)});", "std::vector<uint8_t> block(size);", f"check({self.called(function, second)});"]

    def do_grow(self, function, owner, values, tell, rooms, arrays, into):
        lines = ["uint32_t count = 0;"] if any(var == "count" for _, var, _ in tell) else []
        lines += [f'c.sizes["{key}"] = {f"c.count({chr(34)}{known}{chr(34)}, Call::kFirst)" if known else "Call::kFirst"};' for key, known in rooms]
        mine = {name: f"found.{name}" if into else safe(name) for name, _, _ in arrays}
        lines += [f"{camel(named(self.w.api['structs'], self.w.struct_of(self.plan, into))['name'])} found;"] if into else [
            f"std::vector<{item['type']}> {safe(name)};" for name, item, _ in arrays]
        lines += ["for (bool done = false; !done;) {"] + [f'  {safe(into)}.{key} = c.count("{key}", 0);' for key, _ in rooms if into]
        for name, item, on_request in arrays:
            room = f"c.room({mine[name]}, {self.dims(item['dims'])})"
            lines.append(f"  {safe(into) + '.' + name if into else f'auto* {name}_at'} = {f'want_{name} ? {room} : nullptr' if on_request else room};")
        told = ", ".join(f'{{"{key}", {safe(var)}{("->" if self.is_pointer(var) else ".") + field if field else ""}}}' for key, var, field in tell)
        lines += [f"  const hf_result code = {self.called(function, values)};", f"  done = c.enough(code, {{{told}}});", "}"]
        lines += [f"{f'if (want_{name}) ' if on_request else ''}{mine[name]}.resize(c.product({self.dims(item['dims'])}));" for name, item, on_request in arrays]
        if into:
            struct = self.w.structs[self.w.struct_of(self.plan, into)]
            lines += [f"found.{safe(f['name'])} = {safe(into)}.{safe(f['name'])};" for f in self.w.figures_of(struct)]
        return lines

    def is_pointer(self, var):
        return any(a.name == var and a.role == "info" for a in self.plan.arguments)


class Writer(class_rust.Writer):
    def __init__(self, api):
        super().__init__(api)
        self.words = Words(api, self.groups, Spoken())
        self.words.table.update({name: f"{self.options_name(s)}" if s.struct["used"] == "in" else name for name, s in self.structs.items()})
        for handle, methods in self.groups:
            for m in methods:
                self.words.table[m.name] = camel(handle["name"]) + ("" if m.function["verb"] == "create" else f"::{title(m)}")

    def doc(self, text, indent):
        said = self.words.say(text)
        return [(" " * indent + "// " + line.strip()).rstrip() for line in wrapped(said, 117 - indent)] if said else []

    def struct_of(self, plan, into):
        return next(p["type"] for p in plan.method.function["parameters"] if p["direction"] == "inout" and p["role"] == "struct")

    # ---- options ----

    def options_argument(self, plan):
        return "options"

    def hint(self, item, struct, required=False, life=None):
        """The type of a field of options."""
        role = item["role"]
        if role in ("scalar", "enum"):
            return item["type"]
        if role == "flag":
            return "bool"
        if role == "fixed":
            return f"std::optional<std::array<{item['type']}, {item['count']}>>"
        if role == "array" and struct and item["name"] in struct.ragged:
            return "std::vector<std::vector<uint32_t>>"
        if role == "array":
            return PAIRS[item["type"]] if item.get("twin") else f"std::vector<{item['type']}>"
        return {"handle": f"const {camel(item['type'])}*", "bytes": "std::vector<uint8_t>", "string": "std::vector<std::string>",
                "struct": f"std::optional<{self.options_name(self.structs[item['type']]) if item['type'] in self.structs else ''}>"}[role]

    def passed(self, item, struct):
        hint = self.hint(item, struct)
        return f"const {hint}& " if hint.startswith(("std::", "Reals", "Indices")) else hint + " "

    def zero(self, item, struct):
        hint = self.hint(item, struct)
        return " = nullptr" if hint.endswith("*") else " = false" if hint == "bool" else "" if hint.startswith(("std::", "Reals", "Indices")) else " = 0"

    def options(self, struct):
        name, fields = self.options_name(struct), self.fields_of(struct)
        out = ["", *self.doc(struct.struct["doc"], 0), f"struct {name} {{"]
        for f in fields:
            out += self.doc(f["doc"], 2) + [f"  {self.hint(f, struct)} {safe(f['name'])}{self.zero(f, struct) or '{}'};"]
        given = "".join(f", {self.passed(named(struct.struct['fields'], n), struct)}{safe(n)}" for n in self.ahead(struct))
        steps = Steps(self, options=struct)
        steps.ahead = {n for n in self.ahead(struct) if not named(struct.struct["fields"], n)["optional"]}
        body = [line for op, values in desc_steps(self.api, struct, self.sizes) for line in steps.lines(op, values)]
        declared = f"fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix{given}) const"
        out += fold(f"{struct.name} {declared};", 2, 4) + ["};"]
        return out, ["", *fold(f"inline {struct.name} {name}::{declared} {{", 0, 4), *indented([*body, "return desc;"], 2), "}"]

    # ---- methods ----

    def argument(self, a, plan):
        struct, name = a.struct, safe(a.name)
        if a.role == "place":
            return f"const hf_place& {name}"
        if a.role == "fill":
            return f"std::vector<{a.item['type']}>* {name} = nullptr"
        if a.role == "info":
            return f"{a.item['type']}* {name} = nullptr"
        if a.role == "request":
            return f"bool want_{a.name} = false"
        if a.role == "text":
            return f"const std::vector<std::string>& {name} = {{}}"
        if a.role == "handle" and a.required:
            return f"const {camel(a.item['type'])}& {name}"
        if a.role == "fixed" and a.name != a.item["name"]:
            return f"const std::vector<{a.item['type']}>& {name} = {{}}"
        default = "" if a.required else self.zero(a.item, struct) or " = {}"
        return f"{self.passed(a.item, struct)}{name}{default}"

    def signature(self, plan, into):
        m, parts = plan.method, []
        desc = self.structs[m.flat[0]["type"]] if m.flat else None
        shown = [a for a in plan.arguments if a.role not in ("info", "out", "type", "fill")]
        parts += [self.argument(a, plan) for a in shown if a.required and a.struct is None]
        ahead = list(self.ahead(desc)) if desc else []
        items = [named(desc.struct["fields"], n) for n in ahead] if desc else []
        first = next((k for k, item in enumerate(items) if all(i["optional"] for i in items[k:])), len(items))
        parts += [self.passed(item, desc) + safe(item["name"]) + ("" if k < first else self.zero(item, desc) or " = {}") for k, item in enumerate(items)]
        if into:
            parts += [f"{into}* out", "size_t size"]
        if desc and self.fields_of(desc):
            parts.append(f"const {self.options_name(desc)}& {self.options_argument(plan)} = {{}}")
        parts += [self.argument(a, plan) for a in shown if not a.required and a.struct is None or a.role == "request" or (a.struct is not None and not m.flat)]
        parts += [self.argument(a, plan) for a in plan.arguments if a.role in ("fill", "info")]
        return ", ".join(parts)

    def method(self, m):
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        out = next((a for a in plan.arguments if a.role == "out"), None)
        if not out:
            return [""] + self.one(plan, None)
        kinds = [out.item["type"]] + ["double"] * any(a.role == "type" for a in plan.arguments)
        lines = []
        for kind in kinds:
            lines += [""] + self.fresh(plan, out, kind, kind == "double" and len(kinds) > 1)
        return lines + [line for kind in kinds for line in [""] + self.one(plan, kind)]

    def returned(self, plan):
        found = []
        for kind, name, item in plan.results:
            if kind in ("array", "grown") and name != "out":
                found.append((f"std::move({safe(name)})", f"std::vector<{item['type']}>"))
            elif kind == "bytes":
                found.append(("block", "std::vector<uint8_t>"))
            elif kind == "string":
                found.append(("std::string(block.begin(), block.end() - (block.empty() ? 0 : 1))", "std::string"))
            elif kind == "figure":
                found.append((safe(name), item["type"]))
            elif kind == "info":
                found.append((safe(name), item["type"]))
            elif kind == "arrays":
                self.results[item.name] = item
                found.append(("std::move(found)", camel(item.name)))
        return found

    def changes(self, m):
        return bool(m.own) and bool(re.search(r"Thread safety:[^.]*\bchanges `" + m.own["name"], m.function["doc"]))

    def fresh(self, plan, out, kind, double):
        """A call that returns a new array stands on the one that fills the caller's."""
        m, signature = plan.method, self.signature(plan, None)
        steps, body = Steps(self, plan, kind=kind), ["Call c(counts_);"]
        dims = next(values["item"]["dims"] for op, values in plan.steps if op == "out" and values["given"])
        if m.flat:
            body += [f'c.known("{f["name"]}", {self.options_argument(plan)}.{f["name"]});' for f in self.structs[m.flat[0]["type"]].scalars if f["name"] in self.sizes]
        names = [re.sub(r" = .*", "", p).split()[-1].lstrip("*&") for p in self.signature(plan, kind).split(", ") if p.strip()]
        names = [{"out": "out.data()", "size": "out.size()"}.get(n, n) for n in names]
        body += [f"std::vector<{kind}> out(c.product({steps.dims(dims)}));", f"{title(m)}_into({', '.join(names)});", "return out;"]
        head = f"std::vector<{kind}> {title(m)}{'_f64' * double}({signature}){'' if self.changes(m) else ' const'} {{"
        words = method_words(plan, "Fails with", options=self.fields_of(self.structs[m.flat[0]["type"]]) if m.flat else ()) if not double else f"The same in double."
        return self.doc(words, 2) + fold(head, 2, 4) + indented(body, 4) + ["  }"]

    def one(self, plan, into):
        m = plan.method
        results = self.returned(plan)
        makes = m.kind in ("create", "clone", "derive")
        plain = m.function["returns"]["type"] not in ("hf_result", "void")
        kinds = [t for _, t in results]
        returns = "void" if not kinds else kinds[0] if len(kinds) == 1 else f"std::tuple<{', '.join(kinds)}>"
        returns = m.function["returns"]["type"] if plain else camel(m.noun) if makes else returns
        constructor = m.kind == "create" and m.function["verb"] == "create"
        signature = self.signature(plan, into)
        name = camel(m.noun) if constructor else title(m) + ("_into" if into else "")
        static = "static " * (not constructor and (m.kind == "create" or not m.own))
        end = " const" * (bool(m.own) and m.kind != "create" and not self.changes(m))
        head = ("explicit " if "," not in signature.split("=")[0] else "") + name if constructor else f"{static}{returns} {name}"
        steps, body = Steps(self, plan, kind=into), []
        if not plain:
            body.append("Call c(counts_);" if m.own and m.kind != "create" else "Call c;")
            body += [f'c.parent("{p["name"]}", {safe(p["name"])}.known_counts());' for p in m.parents if not p["optional"]]
        for op, values in plan.steps:
            body += steps.lines(op, values)
        if results:
            text = ", ".join(e for e, _ in results)
            body.append(f"return {re.sub(r'^std::move.(.*).$', chr(92) + '1', text)};" if len(results) == 1 else f"return {{{text}}};")
        words = method_words(plan, "Fails with", options=self.fields_of(self.structs[m.flat[0]["type"]]) if m.flat else ()) if not into else f"As {title(m)}, into memory of yours."
        return self.doc(words, 2) + fold(f"{head}({signature}){end} {{", 2, 4) + indented(body, 4) + ["  }"]

    def class_of(self, handle, methods):
        name, raw = camel(handle["name"]), handle["name"]
        self.noun, self.counts = raw, counts_of(handle, self.groups, self.structs)
        destroy = next(m.name for m in methods if m.kind == "destroy")
        out = ["", *self.doc(class_words(handle, [], self.structs), 0), f"class {name} {{", " public:"]
        body = [line for m in methods if m.kind != "destroy" for line in self.method(m)]
        for f in (m for m in methods if m.flat and self.takes_desc(m)):
            body += [""] + self.desc_form(f)
        for f in (m for m in methods if m.flat):
            body += self.short_form(f)
        for count in self.counts:
            body += ["", f'  uint32_t {count}() const noexcept {{ return known(counts_, "{count}"); }}']
        body += ["", f"  {raw} get() const noexcept {{ return handle_.get(); }}", "  const Counts& known_counts() const noexcept { return counts_; }"]
        private = ["", " private:"]
        if any(m.kind in ("clone", "derive") or (m.kind == "create" and m.function["verb"] != "create") for m in methods):
            private.append(f"  {name}({raw} raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {{}}")
        private += [f"  void own({raw} raw, Counts counts) {{", f"    handle_ = Handle<{raw}, {destroy}>(raw);", "    counts_ = std::move(counts);", "  }",
                    f"  Handle<{raw}, {destroy}> handle_;", "  Counts counts_;"]
        return out + body[1:] + private + ["};"]

    def short_form(self, m):
        """Options that other options hold too, by the arrays that a call is about."""
        struct = self.structs[m.flat[0]["type"]]
        first = class_rust.FIRST.get(struct.name, ())
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        if not first or self.ahead(struct) or m.kind != "call" or any(a.role in ("out", "fill", "info") for a in plan.arguments):
            return []
        items = [named(struct.struct["fields"], name) for name in first]
        required = [a for a in plan.arguments if a.required and a.struct is None]
        returns = "".join(t for _, t in self.returned(plan)) or "void"
        arguments = [self.argument(a, plan) for a in required]
        arguments += [self.passed(item, struct) + item["name"] + (" = {}" if n else "") for n, item in enumerate(items)]
        call = ", ".join([*(safe(a.name) for a in required), "options"])
        return ["", *fold(f"{returns} {title(m)}({', '.join(arguments)}) {{", 2, 4), f"    {self.options_name(struct)} options;",
                *[f"    options.{item['name']} = {item['name']};" for item in items], f"    {'return ' * (returns != 'void')}{title(m)}({call});", "  }"]

    def takes_desc(self, m):
        """Functions whose struct of C stands for all but objects; the struct says how long its arrays are."""
        plan = Planner(self.api, self.structs, self.sizes, m).plan()
        return not any(a.role in ("out", "fill") for a in plan.arguments) and not any(p["role"] != "handle" for p in m.outputs)

    def desc_form(self, m):
        p, constructor = m.flat[0], m.kind == "create" and m.function["verb"] == "create"
        name, raw = camel(m.noun), m.noun
        objects = [f"const {camel(q['type'])}& {q['name']}" for q in m.parents]
        given = ", ".join([*objects, f"const {p['type']}& desc"])
        if not constructor:
            if m.kind == "create" or m.outputs:
                return []
            others = [q for q in m.inputs if q is not p]
            return [f"  // With the struct of C.", f"  void {title(m)}(const {p['type']}& desc) {{ check({m.name}(get(), &desc)); }}"] if not others else []
        rest = [q for q in m.function["parameters"] if q["role"] not in ("handle",) and q is not p]
        extra = "".join(f", {q['type']} {q['name']} = 0" for q in rest)
        body = ["Call c;", *[f'c.parent("{q["name"]}", {q["name"]}.known_counts());' for q in m.parents]]
        fields = self.structs[p["type"]].struct["fields"]
        for k in self.counts:
            rows = next((f for f in fields if f["role"] == "array" and f["view"] and f["dims"][0] == k), None)
            body += [f'c.known("{k}", desc.{k});'] if named(fields, k) else [f'c.known("{k}", desc.{rows["name"]}.count);'] if rows else []
        if "channel_count" in self.counts:
            body.append('if (!desc.channel_count) c.known("channel_count", 1);')
        counts = ", ".join(f'"{k}"' for k in self.counts)
        call = ", ".join({"handle": f"{q['name']}.get()"}.get(q["role"], q["name"]) if q is not p else "&desc" for q in m.function["parameters"] if not (q["role"] == "handle" and q["pointer"]))
        return [f"  // With the struct of C.", f"  {'explicit ' * (not objects)}{name}({given}{extra}) {{",
                *indented([*body, f"{raw} raw = nullptr;", f"check({m.name}({call}, &raw));", f"own(raw, c.counts({{{counts}}}));"], 4), "  }"]

    def figures_of(self, struct):
        """Numbers that a struct of arrays has besides."""
        return struct.results + [f for f in struct.scalars if f["name"] in self.sizes]

    def result_class(self, item):
        out = ["", *self.doc(item.struct["doc"], 0), f"struct {camel(item.name)} {{"]
        for f in item.filled + self.figures_of(item):
            out += self.doc(re.sub(r"^(in|out)[:;]?\s*", "", f["doc"]), 2)
            out.append(f"  std::vector<{f['type']}> {safe(f['name'])};" if f in item.filled else f"  {f['type']} {safe(f['name'])} = 0;")
        return out + ["};"]

    def ordered(self):
        """Classes behind those that they are made on: C++ reads from top to bottom."""
        done, rest = [], list(self.groups)
        while rest:
            names = {h["name"] for h, _ in rest}
            ready = next(g for g in rest if not any(p["type"] in names - {g[0]["name"]} for m in g[1] for p in m.parents if not p["optional"]))
            done.append(ready)
            rest.remove(ready)
        return done

    def write(self):
        bodies, declared = [], []
        for handle, methods in self.ordered():
            body = self.class_of(handle, methods)
            bodies += body
            declared.append(f"class {camel(handle['name'])};")
        taken = {p["type"] for _, methods in self.groups for m in methods for p in m.flat}
        taken |= {f["type"] for s in self.structs.values() for f in s.inner}
        # classes that a struct of options names stand in front of it
        options = {name: self.options(s) for name, s in self.structs.items() if name in taken and s.asked()}
        results = [line for item in self.results.values() for line in self.result_class(item)]
        return HEAD, declared, options, results, bodies


HEAD = '''// Generated from include/hf/*.h by bindings/generate; do not edit.
// hf/hf.hpp - C++17 wrapper of hf.h: handles destroy themselves, failures are exceptions, arrays are vectors.
//
//   hf::Surface surface(positions, triangles);
//   hf::Solver solver(surface);
//   solver.add_sites({0, 41}, {0.0, 1.0});
//   std::vector<float> field = solver.solve();
// clang-format off
#ifndef HF_HF_HPP
#define HF_HF_HPP

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hf/call.hpp"

namespace hf {
'''


def indented(lines, pad):
    out = []
    for line in lines:
        text = line.lstrip()
        out += fold(text, pad + len(line) - len(text), 4) if text else [""]
    return out


def write(api):
    return {"../include/hf/hf.hpp": text_of(api)}


def text_of(api):
    head, declared, options, results, bodies = Writer(api).write()
    shown = [line for struct, _ in options.values() for line in struct]
    filled = [line for _, fill in options.values() for line in fill]
    return head + "\n".join([*declared, *shown, *results, *bodies, *filled]) + "\n\n}  // namespace hf\n\n#endif\n"
