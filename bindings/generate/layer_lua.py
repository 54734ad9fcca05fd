"""bindings/lua/hf_raw.lua: the declarations for LuaJIT's ffi.cdef, and the constants."""


def c_type(item):
    return ("const " if item["const"] else "") + item["type"] + "*" * item["pointer"] + " "


def write(api):
    out = ["-- Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI for LuaJIT's FFI.",
           "local ffi = require('ffi')", "", "ffi.cdef[[", "typedef int32_t hf_result;"]
    out += [f"typedef struct {h['object']}* {h['name']};" for h in api["handles"]]
    for struct in api["structs"]:
        out.append(f"typedef struct {struct['name']} {{")
        for f in struct["fields"]:
            declared = "void *" if f["type"] == "function" else c_type(f)
            out.append(f"  {declared}{safe(f['name'])}{'[%d]' % f['count'] if f['count'] else ''};")
        out.append(f"}} {struct['name']};")
    for function in api["functions"]:
        parameters = ", ".join((c_type(p) + safe(p["name"])) for p in function["parameters"]) or "void"
        out.append(f"{c_type(function['returns'])}{function['name']}({parameters});")
    out += ["]]", "", f"local constants = {{ header_version = '{api['version']}',"]
    out += [f"  {c['name']} = {c['value']}," for c in api["constants"]]
    out += ["}", "", "return constants"]
    return {"lua/hf_raw.lua": "\n".join(out) + "\n"}


def safe(name):
    # a field called `function` is fine in C and in cdef; Lua code reads it as info['function']
    return name
