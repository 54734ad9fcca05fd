"""bindings/names.md: each function of the ABI and what it is called in languages whose classes are made from the headers."""

import class_cpp
import class_csharp
import class_js
import class_python
import class_rust
from plan import LOOSE, camel, classes


def write(api):
    groups, _ = classes(api)
    methods = {m.name: (handle, m) for handle, group in groups for m in group}
    lines = ["# Names", "", "Generated from include/hf/*.h by bindings/generate; do not edit. A function without a name of its own is the short form of another, which takes its",
             "arguments.", "", "| C | C++ | Python | JavaScript | C# | Rust |", "|---|---|---|---|---|---|"]
    for function in api["functions"]:
        name = function["name"]
        handle, m = methods.get(name) or methods.get(function["short_of"]) or (None, None)
        if name in LOOSE:
            cpp = python = script = sharp = rust = "inside the package"
        elif m.kind == "destroy":
            cpp, python, script, sharp, rust = "destructor", "close", "close", "Dispose", "drop"
        else:
            owner = camel(handle["name"])
            makes = m.kind == "create" and m.function["verb"] == "create"
            called = "" if m.is_property() or makes else "()"
            python = owner if makes else f"{owner}.{class_python.safe(m.title())}{called}"
            script = f"new {owner}" if makes else f"{owner}.{class_js.js(m.title())}{called}"
            owner = class_csharp.cs(handle["name"])
            sharp = f"new {owner}" if makes else f"{owner}.{class_csharp.upper(m.title())}{called}"
            rust = f"{camel(handle['name'])}::{'new' if makes else class_rust.Spoken().method(m)}"
            cpp = camel(handle["name"]) + ("" if makes else f"::{class_cpp.title(m)}")
        lines.append(f"| `{name}` | {cpp} | {python} | {script} | {sharp} | {rust} |")
    return {"names.md": "\n".join(lines) + "\n"}
