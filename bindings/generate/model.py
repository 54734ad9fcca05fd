"""What follows from the headers: the role of every field and parameter, the object and the verb of every function.

derive(api) adds them to the description; every layer reads the same. Roles:
  size, reserved    struct_size and reserved
  array             numbers or plain structs, `dims` rows by columns; string and bytes likewise. An hf_array has `view`, the types
                    that its numbers may have
  count             how long an array is: a layer takes it from the array
  capacity, stride  of the caller's arrays
  handle, struct, callback, enum, flag, scalar, fixed (double[3]), value (a plain struct inside another)
"""

import pickle
import re

from comments import VIEWS

MOST_FIELDS, WHY_MORE = 16, "More than 16 fields:"  # more than a reader takes in at once
SUFFIXES = ("_u16",)  # the same array in another type

class Problems(Exception):
    pass


def symbols(dims):
    """Names in dimensions: ['vertex_count', '3'] -> {'vertex_count'}."""
    return {name for dim in dims for name in re.findall(r"[A-Za-z_][\w.]*", dim) if name != "sum"}


def named(items, name):
    return next((item for item in items if item["name"] == name), None)


def role_of(api, item, struct=None):
    handle, inner = named(api["handles"], item["type"]), named(api["structs"], item["type"])
    if item["type"] in VIEWS:
        return "array"
    if struct and item["name"] == "struct_size":
        return "size"
    if struct and item["name"].startswith("reserved"):
        return "reserved"
    if item["type"] == "function" or item["name"] == "user":
        return "callback"
    if handle:
        return "handle"
    if inner and (item["dims"] or not item["pointer"]):
        return "array" if item["pointer"] else "callback" if any(f["role"] == "callback" for f in inner["fields"]) else "value"
    if inner:
        return "struct"
    if item["type"] == "char" and item["pointer"]:
        return "string"
    if item["type"] == "void" and item["pointer"]:
        return "bytes"
    if item["pointer"]:
        return "array" if item["dims"] else "scalar"
    if item.get("count"):
        return "string" if item["type"] == "char" else "fixed"
    if item["name"].endswith("_stride"):
        return "stride"
    if re.fullmatch(r"(\w+_)?capacity", item["name"]):
        return "capacity"
    return "flag" if item.get("flag") else "enum" if item["enum"] and item["type"] == "int32_t" else "scalar"


def twins(items):
    """An array of the same name with _u16 is the same in another type."""
    for item in items:
        base = next((item["name"][:-len(end)] for end in SUFFIXES if item["name"].endswith(end)), "")
        item["twin_of"] = base if named(items, base) else ""


def enums_of(api):
    found = {}
    for enum in api["enums"]:
        names = [member["name"] for member in enum["members"]]
        prefix = names[0]
        while not all(name.startswith(prefix) for name in names) or not prefix.endswith("_"):
            prefix = prefix[:-1]
        enum["prefix"] = prefix
        found.setdefault(prefix, enum["name"])
    return found


def look_at_struct(api, struct, enums, problems):
    where, fields = struct["name"], struct["fields"]
    if len(fields) > MOST_FIELDS and WHY_MORE not in struct["doc"]:
        problems.append(f"{where}: {len(fields)} fields. Split it, or say in its comment why not: {WHY_MORE} ...")
    struct["doc"] = re.sub(rf"\s*{WHY_MORE}.*?\.(?=\s|$)", "", struct["doc"])  # it is about C
    counted = set().union(*(symbols(f["dims"]) | symbols(sum(f["without"].values(), [])) for f in fields if f["const"]), set())
    twins(fields)
    for field in fields:
        field["role"] = role_of(api, field, struct)
        if field["name"].endswith("_count"):
            field["enum"] = ""
        if field["enum"]:
            field["enum"] = enums.get(field["enum"]) or problems.append(f"{where}.{field['name']}: no enum has the values {field['enum']}*")
        if field["role"] == "scalar" and field["name"] in counted and not field["direction"] and struct["used"] == "in" and (
                "also without" not in field["doc"]):
            field["role"] = "count"
        if struct["used"] == "inout" and field["direction"] == "in" and field["name"] in counted and field["role"] == "scalar" and any(
                f["const"] and field["name"] in symbols(f["dims"]) for f in fields):
            field["role"] = "count"
        if struct["used"] == "inout" and field["role"] == "capacity":
            field["counted_by"] = re.sub("capacity$", "count", field["name"])
            if not named(fields, field["counted_by"]):
                problems.append(f"{where}.{field['name']}: no field {field['counted_by']} says how many were written")
        if field["type"] in VIEWS and not (field["dims"] and field["view"]):
            problems.append(f"{where}.{field['name']}: an array of what? start its comment with [count] of float or double, say")
        if field["pointer"] and field["role"] == "scalar":
            problems.append(f"{where}.{field['name']}: how many? start its comment with [count]")
        if struct["used"] == "inout" and not field["pointer"] and field["role"] not in ("size", "reserved") and not field["direction"]:
            problems.append(f"{where}.{field['name']}: who writes it? start its comment with in: or out:")
        if not field["direction"]:
            read = field["const"] or field["type"] == "hf_array"
            field["direction"] = ("in" if read else "out") if field["role"] == "array" else (
                "out" if struct["used"] == "out" else "in")


def use_of(api):
    """in, out or inout: how functions take each struct; plain for rows of arrays and values."""
    for struct in api["structs"]:
        struct["used"] = "plain" if struct["fields"][0]["name"] != "struct_size" else ""
    for function in api["functions"]:
        for p in function["parameters"]:
            struct = named(api["structs"], p["type"])
            if struct and struct["used"] != "plain":
                struct["written"] = struct.get("written", False) or p["name"].startswith("out_")
                struct["used"] = "inout" if p["name"].startswith("inout_") else "in" if p["const"] else "out" if not struct["used"] else struct["used"]
    for struct in api["structs"]:
        for field in struct["fields"]:
            inner = named(api["structs"], field["type"])
            if inner and field["const"] and not inner["used"]:
                inner["used"] = "in"
        struct["used"] = struct["used"] or "in"


def look_at_parameters(api, function, enums, problems):
    where, items = function["name"], function["parameters"]
    twins(items)
    counted = set().union(*(symbols(p["dims"]) for p in items if p["const"]), set())
    for p in items:
        p["role"] = role_of(api, p)
        if p["enum"] and not p["pointer"]:
            p["enum"] = enums.get(p["enum"]) or problems.append(f"{where}, {p['name']}: no enum has the values {p['enum']}*")
            p["role"] = "enum"
        elif p["enum"]:
            p["enum"] = enums.get(p["enum"], "")
        p["direction"] = next((d for d in ("inout", "out") if p["name"].startswith(d + "_")), "in")
        if p["role"] == "scalar" and p["pointer"] and (p["const"] or not p["receives"]):
            problems.append(f"{where}, {p['name']}: how many? say in the comment: {p['name']}: {p['type']}[count], or {p['name']}: receives ...")
        if p["role"] == "scalar" and not p["pointer"] and p["name"] in counted:
            p["role"] = "count"
        if p["role"] == "struct" and p["direction"] == "out" and any(q["name"] == "capacity" for q in items) and "capacity" in p["doc"] and not p["dims"]:
            problems.append(f"{where}, {p['name']}: say {p['type']}[capacity]")
        if p["type"] in VIEWS and not (p["dims"] and p["view"]):
            problems.append(f"{where}, {p['name']}: an array of what? say in the comment: {p['name']}: [count] of float or double")
        if p["pointer"] and not p["const"] and p["direction"] == "in":
            problems.append(f"{where}, {p['name']}: written by the library, so its name starts with out_ or inout_")
        if p["role"] == "capacity":
            tells = [q["name"] for q in items if q["name"] in ("out_count", "out_size")]
            for q in items:
                told = re.search(rf"(\w+)->(\w+) of them", q["doc"])
                tells += [f"{told.group(1)}.{told.group(2)}"] if told else []
            p["counted_by"] = tells[0] if tells else ""
            if not tells:
                problems.append(f"{where}, {p['name']}: who says how many were written? out_count, or: out_info->some_count of them")


def place_of(api, function):
    """(object, verb): hf_noun_verb, or the object that a short name makes or takes first."""
    handles = [h["name"] for h in api["handles"]]
    name, parameters = function["name"], function["parameters"]
    noun = max((h for h in handles if name.startswith(h + "_")), key=len, default="")
    if noun:
        return noun, name[len(noun) + 1:]
    own = next((p["type"] for p in parameters if p["type"] in handles and p["pointer"]), None)
    own = own or next((p["type"] for p in parameters if p["type"] in handles and not p["pointer"]), None)
    return own or "", name[3:]


def kind_of(api, function):
    parameters, noun = function["parameters"], function["noun"]
    made = [p for p in parameters if p["role"] == "handle" and p["pointer"]]
    out = [p for p in parameters if p["direction"] != "in"]
    if made:
        takes = any(p["type"] == noun and not p["pointer"] for p in parameters)
        return ("clone" if function["verb"] == "clone" else "derive") if takes else "create"
    if function["verb"] == "destroy":
        return "destroy"
    if any(p["role"] == "capacity" for p in parameters):
        return "arrays"
    if len(out) == 1 and out[0]["role"] == "struct" and len(parameters) == 2 and out[0]["direction"] == "out":
        return "info"
    return "count" if function["returns"]["type"] not in ("hf_result", "void") else "call"


OBJECT_COUNTS = {"vertex_count", "channel_count"}  # objects know them whatever made them


def counts_of_objects(api):
    """What each object can know of its arrays: counts of the descs that made it, and of the objects it was made on."""
    kept = {h["name"]: set(OBJECT_COUNTS) for h in api["handles"]}
    for _ in api["handles"]:  # objects on objects on objects
        for function in api["functions"]:
            for p in function["parameters"] if function["kind"] == "create" else ():
                struct = named(api["structs"], p["type"])
                kept[function["noun"]] |= {f["name"] for f in struct["fields"] if f["role"] == "count"} if struct else kept.get(p["type"], set())
    return kept


def derive(api):
    problems = []
    enums = enums_of(api)
    use_of(api)
    for struct in api["structs"]:
        look_at_struct(api, struct, enums, problems)
    for function in api["functions"]:
        look_at_parameters(api, function, enums, problems)
        function["noun"], function["verb"] = place_of(api, function)
        function["kind"] = kind_of(api, function)
    kept = counts_of_objects(api)
    for function in api["functions"]:
        known = set().union(*(names_known(api, function, p) for p in function["parameters"]))
        objects = set().union(*(kept.get(p["type"], set()) for p in function["parameters"]))
        function["object_counts"] = []
        for p in function["parameters"]:
            for name in sorted(symbols(p["dims"])):
                _, _, last = name.rpartition(".")
                if name not in known and last in objects:
                    function["object_counts"] += [last] if last not in function["object_counts"] else []
                elif name not in known and name.split(".")[0] not in known:
                    problems.append(f"{function['name']}, {p['name']}: what is {name}?")
    for function in api["functions"]:
        also = [named(api["functions"], name) for pair in function.pop("errors_as") for name in pair if name]
        function["errors"] = sorted(set(function["errors"]).union(*(f["errors"] for f in also if f)))
        long = named(api["functions"], f"{function['noun']}_{function['verb']}")
        function["short_of"] = long["name"] if long and long is not function else ""
    if problems:
        raise Problems("\n  ".join(["the headers leave open:", *problems]))
    return api


def elements(api):
    """The description for classes of languages: an hf_array is an array of its plain numbers, and its `twin` the other type."""
    api = pickle.loads(pickle.dumps(api))  # copy.deepcopy takes five times as long
    for item in (f for s in api["structs"] for f in s["fields"]):
        as_numbers(item, const=item["type"] == "hf_array")
    for item in (p for f in api["functions"] for p in f["parameters"]):
        as_numbers(item, const=item["type"] == "hf_array")
    api["structs"] = [s for s in api["structs"] if s["name"] not in VIEWS]
    api["enums"] = [e for e in api["enums"] if e["name"] != "hf_type"]  # languages know the types of their arrays
    return api


def as_numbers(item, const):
    if item["type"] not in VIEWS:
        return
    item.update({"type": item["view"][0], "pointer": 1, "const": const, "twin": {**item, "type": item["view"][1]} if item["view"][1:] else None})


def names_known(api, function, parameter):
    struct = named(api["structs"], parameter["type"])
    return {parameter["name"]} | ({f["name"] for f in struct["fields"]} if struct else set())
