"""Reads include/hf/*.h and writes bindings/api.json, the one description all raw layers are generated from.

The headers follow strict conventions (include/hf/base.h), so a small reader is enough: comments and preprocessor lines
are taken off, then enums, opaque handles, structs and HF_API functions are matched. What it does not understand is an
error, never left out: the text that no pattern claimed must be empty at the end.

usage: parse_headers.py INCLUDE_DIR [OUT.json]     (without OUT: to standard output)
"""

import json
import pathlib
import re
import sys

SCALARS = {"int32_t", "uint32_t", "int64_t", "uint64_t", "size_t", "float", "double", "char", "void", "uint8_t",
    "uint16_t", "hf_result"}


class HeaderError(Exception):
    pass


def first_sentence(comment):
    text = " ".join(line.strip().lstrip("*").strip() for line in comment.strip("/*").splitlines()).strip()
    match = re.match(r"(.+?[.:])(\s|$)", text)
    return (match.group(1) if match else text).rstrip(":")


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


def parse_header(path, api, constants):
    text = path.read_text()
    comments = []  # each comment becomes a mark, so that the one in front of a function is its documentation

    def keep(match):
        comments.append(match.group(0))
        return f" @{len(comments) - 1}@ "

    text = re.sub(r"/\*.*?\*/", keep, text, flags=re.S)
    for name, value in re.findall(r"^#define (HF_\w+) (0[xX][0-9a-fA-F]+|\d+)u?\s*(?:@\d+@)?\s*$", text, flags=re.M):
        constants[name] = int(value, 0)
        api["constants"].append({"name": name, "value": int(value, 0)})
    text = re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*$", "", text, flags=re.M)
    text = text.replace('extern "C" {', "")
    text = re.sub(r"^\}\s*$", "", text, flags=re.M)

    def documentation(mark):
        return first_sentence(comments[int(mark)]) if mark else ""

    def take_enum(match):
        value = -1
        for entry in re.sub(r"@\d+@", "", match.group(1)).split(","):
            entry = entry.strip()
            if not entry:
                continue
            name, _, given = (part.strip() for part in entry.partition("="))
            value = int(given, 0) if given else value + 1
            constants[name] = value
            api["constants"].append({"name": name, "value": value})
        return ""

    def take_struct(match):
        mark, name, body = match.group(1), match.group(2), re.sub(r"@\d+@", "", match.group(3))
        fields = []
        for declaration in filter(None, (part.strip() for part in body.split(";"))):
            fields += parse_declarators(" ".join(declaration.split()), f"{path.name}, {name}", constants)
        api["structs"].append({"name": name, "header": path.name, "doc": documentation(mark), "fields": fields})
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
        api["functions"].append({"name": name, "header": path.name, "doc": documentation(mark),
                                 "returns": parse_type(returns, where), "parameters": parameters})
        return ""

    text = re.sub(r"enum\s*(?:hf_\w+\s*)?\{([^}]*)\};", take_enum, text)
    mark = r"(?:@(\d+)@\s*)?"
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
    api = {"constants": [], "handles": [], "structs": [], "functions": []}
    constants = {}
    order = ["base.h", "surface.h", "solver.h"]
    for name in [n for n in order if n in names] + [n for n in names if n not in order]:
        parse_header(folder / name, api, constants)
    check(api)
    return api


def to_text(api):
    lines = ["{"]
    keys = list(api)
    for key in keys:
        if isinstance(api[key], str):
            lines.append(f' "{key}": {json.dumps(api[key])},')
            continue
        lines.append(f' "{key}": [')
        lines += [f"  {json.dumps(item)}{',' if item is not api[key][-1] else ''}" for item in api[key]]
        lines.append(" ]" + ("," if key != keys[-1] else ""))
    return "\n".join(lines + ["}"]) + "\n"


if __name__ == "__main__":
    try:
        result = to_text(read_api(sys.argv[1]))
    except HeaderError as error:
        sys.exit(f"error: {error}")
    if len(sys.argv) > 2:
        pathlib.Path(sys.argv[2]).write_text(result)
    else:
        sys.stdout.write(result)
