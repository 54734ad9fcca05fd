"""Writes the reference of a header as Markdown, from bindings/api.json, which is made from the headers."""

import html
import re

PARTS = re.compile(r"(?<=[.)]) (?=(?:Cost|Errors|Thread safety|Since)\b)")


def linked(doc, names):
    """A comment as Markdown: signs that Markdown would read are escaped, names of the library lead to their places."""
    doc = re.sub(r"([*\\|])", r"\\\1", html.escape(re.sub(r"`([^`]*)`", r"\1", doc or ""), quote=False))
    return re.sub(r"\bhf_\w+", lambda m: f"[{m[0]}]({names[m[0]]}#{m[0]})" if m[0] in names else m[0], doc)


def c_type(item):
    return ("const " if item.get("const") else "") + item["type"] + "*" * item.get("pointer", 0)


def declarator(item):
    count = item.get("count", 0)
    return f"{c_type(item)} {item['name']}" + (f"[{count}]" if count else "")


def head(source):
    """The first comment of a header, as Markdown."""
    comment = re.match(r"/\*(.*?)\*/", source, re.S).group(1)
    lines = [re.sub(r"^ \* ?", "", line) for line in comment.split("\n")]
    lines[0] = re.sub(r"^ *hf/\S+ - ", "", lines[0])
    lines[0] = lines[0][:1].upper() + lines[0][1:]
    return re.sub(r"([<*])", r"\\\1", "\n".join(lines))


def use(source):
    """The use of a header: the first sentence of its first comment."""
    return head(source).split("\n")[0]


def table(columns, rows):
    return "\n".join([" | ".join([""] + columns + [""]).strip(), "|---" * len(columns) + "|"]
        + ["| " + " | ".join(row) + " |" for row in rows])


def page(header, source, api, names):
    """The page of include/hf/HEADER. names: the header of each name."""
    def text(doc):
        return linked(doc, names)

    out = [f"# hf/{header}", head(source)]
    handles = [h for h in api["handles"] if f"typedef struct {h['object']}* {h['name']};" in source]
    for handle in handles:
        out += [f"## {handle['name']}", text(handle.get("doc"))]
    functions = [f for f in api["functions"] if f["header"] == header]
    if functions:
        out.append("## Functions")
    for function in functions:
        parameters = [declarator(p) for p in function["parameters"]] or ["void"]
        line = f"{c_type(function['returns'])} {function['name']}(" + ", ".join(parameters) + ");"
        if len(line) > 90:
            line = line.replace("(", "(\n    ", 1).replace(", ", ",\n    ")
        out += [f"### {function['name']}", f"```c\n{line}\n```"] + [text(part) for part in PARTS.split(function.get("doc", ""))]
    structs = [s for s in api["structs"] if s["header"] == header]
    if structs:
        out.append("## Structs")
    for struct in structs:
        rows = [[f"`{f['name']}`", f"`{c_type(f)}" + (f"[{f['count']}]`" if f.get("count") else "`"),
            text(f.get("doc"))] for f in struct["fields"] if f["name"] != "struct_size"]
        out += [f"### {struct['name']}", text(struct.get("doc")), table(["field", "type", "meaning"], rows)]
    enums = [e for e in api["enums"] if e["header"] == header]
    if enums:
        out.append("## Enums")
    for enum in enums:
        rows = [[f"`{m['name']}`", str(m["value"]), text(m.get("doc"))] for m in enum["members"]]
        out += [f"### {enum['name']}", text(enum.get("doc")), table(["name", "value", "meaning"], rows)]
    return "\n\n".join(part for part in out if part) + "\n"


def anchors(api, sources):
    """Every name of the reference, and the header whose page has it."""
    found = {item["name"]: item["header"] for kind in ("functions", "structs", "enums") for item in api[kind]}
    for handle in api["handles"]:
        for header, source in sources.items():
            if f"typedef struct {handle['object']}* {handle['name']};" in source:
                found[handle["name"]] = header
    return found
