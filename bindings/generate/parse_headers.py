"""Reads include/hf/*.h and writes bindings/api.json, the one description all layers are generated from.

The headers follow strict conventions (include/hf/base.h, comments.py), so a small reader is enough: preprocessor lines
are taken off and comments become marks, then enums, opaque handles, structs and HF_API functions are matched. What it does
not understand is an error, never left out: the text that no pattern claimed must be empty at the end, and model.py refuses
a field or parameter whose comment leaves a question open.

usage: parse_headers.py INCLUDE_DIR [OUT.json]     (without OUT: to standard output)
"""

import json
import pathlib
import re
import sys

import comments
import model

SCALARS = {"int32_t", "uint32_t", "int64_t", "uint64_t", "size_t", "float", "double", "char", "void", "uint8_t",
    "uint16_t", "hf_result"}


class HeaderError(Exception):
    pass


def parse_type(text, where):
    """'const float*' -> type, pointer depth, const."""
    pointer = text.count("*")
    words = text.replace("*", " ").split()
    const = "const" in words
    words = [word for word in words if word not in ("const", "struct")]
    if len(words) != 1:
        raise HeaderError(f"{where}: cannot read the type '{text}'")
    return {"type": words[0], "pointer": pointer, "const": const}


def parse_declarators(text, where, constants):
    """'double a, b[3]' -> fields."""
    if "(*" in text:
        return [{"name": re.search(r"\(\*(\w+)\)", text).group(1), "type": "function", "pointer": 0, "const": False,
            "count": 0}]
    parts = [part.strip() for part in text.split(",")]
    first = re.match(r"(.*?[\s*])(\w+)(?:\[(\w+)\])?$", parts[0], re.S)
    if not first:
        raise HeaderError(f"{where}: cannot read '{text}'")
    base = parse_type(first.group(1), where)
    fields = []
    for index, part in enumerate(parts):
        name, count = (first.group(2), first.group(3)) if index == 0 else re.match(r"(\w+)(?:\[(\w+)\])?$",
            part).groups()
        size = 0 if count is None else int(count) if count.isdigit() else constants[count]
        fields.append({"name": name, **base, "count": size})
    return fields


def split_commented(body, separator):
    """(declaration, marks of its comments): a comment behind a declaration is its own, one on its own line the next one's."""
    found, leading, current = [], [], ""
    for line in body.splitlines():
        for piece in re.split(r"(@\d+@)", line):
            if re.fullmatch(r"@\d+@", piece):
                if not current.strip() and found and line[:line.index(piece)].strip(" @0123456789"):
                    found[-1][1].insert(0, piece[1:-1])  # its shape comes first
                else:
                    leading.append(piece[1:-1])
                continue
            *done, current = (current + piece).split(separator)
            for declaration in done:
                found.append((declaration.strip(), leading))
                leading = []
        current += " "
    if current.strip():  # the last value of an enum
        found.append((current.strip(), leading))
    return found


def parse_header(path, api, constants):
    text = path.read_text()
    texts = []  # each comment becomes a mark: in front of a function, struct, enum or handle it is its documentation

    def keep(match):
        texts.append(comments.plain(match.group(0)))
        return f" @{len(texts) - 1}@ "

    text = re.sub(r"/\*.*?\*/", keep, text, flags=re.S)
    for name, value in re.findall(r"^#define (HF_\w+) (0[xX][0-9a-fA-F]+|\d+)u?\s*(?:@\d+@)?\s*$", text, flags=re.M):
        constants[name] = int(value, 0)
        api["constants"].append({"name": name, "value": int(value, 0)})
    text = re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*$", "", text, flags=re.M)
    text = text.replace('extern "C" {', "")
    text = re.sub(r"^\}\s*$", "", text, flags=re.M)

    def documentation(mark):
        return texts[int(mark)] if mark and not texts[int(mark)].startswith("----") else ""  # those are headlines

    def take_enum(match):
        value, members = -1, []
        for entry, words in split_commented(match.group(3), ","):
            name, _, given = (part.strip() for part in entry.partition("="))
            value = int(given, 0) if given else value + 1
            constants[name] = value
            members.append({"name": name, "value": value, "doc": said(words)})
            api["constants"].append({"name": name, "value": value, "doc": said(words)})
        if match.group(2):
            doc = documentation(match.group(1))
            api["enums"].append({"name": match.group(2), "header": path.name, "doc": doc, "bits": doc.startswith("Bits"),
                                 "members": members})
        return ""

    def said(words):
        return " ".join(texts[int(word)] for word in words)

    def take_struct(match):
        mark, name, body = match.groups()
        fields, doc = [], documentation(mark)
        for declaration, words in split_commented(body, ";"):
            for field in parse_declarators(" ".join(declaration.split()), f"{path.name}, {name}", constants):
                fields.append(comments.say_field(field, said(words), doc))
        api["structs"].append({"name": name, "header": path.name, "doc": doc, "fields": fields})
        return ""

    def take_handle(match):
        api["handles"].append({"name": match.group(3), "object": match.group(2), "doc": documentation(match.group(1))})
        return ""

    def take_function(match):
        mark, returns, name, body = match.groups()
        where = f"{path.name}, {name}"
        parameters = []
        body = " ".join(re.sub(r"@\d+@", "", body).split())
        for part in [] if body == "void" else body.split(","):
            declared = re.match(r"(.*?[\s*])(\w+)$", part.strip())
            parameters.append({"name": declared.group(2), **parse_type(declared.group(1), where)})
        doc = documentation(mark)
        prose, ends = comments.parts(doc)
        spoken = comments.segments(prose, [p["name"] for p in parameters])
        parameters = [comments.say_parameter(p, spoken.get(p["name"], "")) for p in parameters]
        api["functions"].append({"name": name, "header": path.name, "doc": doc, "errors": comments.errors_of(ends.get("Errors", "")),
                                 "errors_as": re.findall(r"\b[Aa]s (?:for |the )?(hf_\w+)|and (hf_\w+)", ends.get("Errors", "")),
                                 "returns": parse_type(returns, where), "parameters": parameters})
        return ""

    mark = r"(?:@(\d+)@\s*)?"
    text = re.sub(mark + r"enum\s*(?:(hf_\w+)\s*)?\{([^}]*)\};", take_enum, text)
    text = re.sub(mark + r"typedef struct (\w+)\s*\{(.*?)\}\s*\2;", take_struct, text, flags=re.S)
    text = re.sub(mark + r"typedef struct (\w+)\s*\*\s*(\w+);", take_handle, text)
    text = re.sub(r"typedef int32_t hf_result;", "", text)
    text = re.sub(mark + r"HF_API\s+([\w\s*]+?[\s*])(\w+)\(([^)]*)\);", take_function, text)
    rest = " ".join(re.sub(r"@\d+@", "", text).split())
    if rest:
        raise HeaderError(f"{path.name}: not understood: {rest[:200]}")


def check(api):
    known = SCALARS | {"function"} | {item["name"] for item in api["handles"] + api["structs"]}
    for struct in api["structs"]:
        for field in struct["fields"]:
            if field["type"] not in known:
                raise HeaderError(f"{struct['name']}.{field['name']}: unknown type {field['type']}")
    for function in api["functions"]:
        for item in [function["returns"], *function["parameters"]]:
            if item["type"] not in known:
                raise HeaderError(f"{function['name']}: unknown type {item['type']}")


def read_api(include):
    """The description of the headers that hf.h includes, in its order, base.h first."""
    folder = pathlib.Path(include) / "hf"
    names = re.findall(r'#include "hf/(\w+\.h)"', (folder / "hf.h").read_text())
    api = {"constants": [], "enums": [], "handles": [], "structs": [], "functions": []}
    constants = {}
    order = ["base.h", "surface.h", "solver.h"]
    for name in [n for n in order if n in names] + [n for n in names if n not in order]:
        parse_header(folder / name, api, constants)
    check(api)
    return model.derive(api)


def lean(item):
    """Without what does not hold: {"optional": false} and the like."""
    if isinstance(item, list):
        return [lean(entry) for entry in item]
    if not isinstance(item, dict):
        return item
    return {key: lean(value) for key, value in item.items() if value or key in ("name", "type", "pointer", "const", "count", "value", "fields", "parameters")}


def to_text(api):
    lines = ["{"]
    keys = list(api)
    for key in keys:
        if isinstance(api[key], str):
            lines.append(f' "{key}": {json.dumps(api[key])},')
            continue
        lines.append(f' "{key}": [')
        lines += [f"  {json.dumps(lean(item))}{',' if item is not api[key][-1] else ''}" for item in api[key]]
        lines.append(" ]" + ("," if key != keys[-1] else ""))
    return "\n".join(lines + ["}"]) + "\n"


if __name__ == "__main__":
    try:
        result = to_text(read_api(sys.argv[1]))
    except (HeaderError, model.Problems) as error:
        sys.exit(f"error: {error}")
    if len(sys.argv) > 2:
        pathlib.Path(sys.argv[2]).write_text(result)
    else:
        sys.stdout.write(result)
