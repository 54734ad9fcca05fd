"""bindings/js/src/raw.js: constants, struct layouts for both pointer sizes, signatures."""

import json

from layout import is_pointer, lay_out

TYPES = {"int32_t": "i32", "uint32_t": "u32", "hf_result": "i32", "float": "f32", "double": "f64", "size_t": "size",
    "char": "char",
         "uint8_t": "u8", "uint16_t": "u16"}


def kind(api, item):
    return "ptr" if is_pointer(api, item) else TYPES.get(item["type"], item["type"])


def write(api):
    out = ["// Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI: constants, layouts, signatures.", "",
           f"export const headerVersion = {json.dumps(api['version'])};", "",
           "export const constants = Object.freeze({", *[f"  {c['name']}: {c['value']},"
               for c in api["constants"]], "});", "",
           "// struct: size and fields, [type, offset, count]; first for pointers of 4 bytes (WebAssembly), then of 8.",
           "export const layouts = {"]
    for struct in api["structs"]:
        sizes, offsets = [], []
        for width in (4, 8):
            size, _, places = lay_out(api, struct, width)
            sizes.append(size)
            offsets.append(places)
        out.append(f"  {struct['name']}: {{ size: {sizes}, fields: {{")
        out += [f"    {f['name']}: ['{kind(api, f)}', [{offsets[0][f['name']]}, {offsets[1][f['name']]}], {f['count']}]," for f in struct["fields"]]
        out.append("  } },")
    out += ["};", "", "// function: [result, parameters]", "export const functions = {"]
    for function in api["functions"]:
        returns = function["returns"]
        result = "string" if returns["type"] == "char" else "void" if returns["type"] == "void" else kind(api, returns)
        parameters = ", ".join("'handle'" if p["pointer"] == 0 and kind(api, p) == "ptr" else f"'{kind(api, p)}'"
            for p in function["parameters"])
        out.append(f"  {function['name']}: ['{result}', [{parameters}]],")
    out += ["};"]
    return {"js/src/raw.js": "\n".join(out) + "\n"}
