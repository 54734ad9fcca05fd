#!/usr/bin/env bash
# godot4_interface.sh GODOT COMPILER SCRATCH: the declarations of bindings/godot/src/godot4.h are those of this Godot.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
godot=$1 compiler=$2
mkdir -p "$3" && cd "$3"
rm -f gdextension_interface.h extension_api.json
HOME=$PWD timeout 100 "$godot" --headless --dump-gdextension-interface >dump.log 2>&1
HOME=$PWD timeout 100 "$godot" --headless --dump-extension-api >>dump.log 2>&1
python3 - >godot4_names.h <<'PY'
import json
import re

# a comment says the name that Godot knows a function by; the type of its pointer follows
for name, major, minor, type_name in re.findall(r"@name (\w+)\n \* @since (\d+)\.(\d+)\n.*?\n \*/\ntypedef [^;]*?\(\*(GDExtensionInterface\w+)\)\(", open("gdextension_interface.h").read(), re.S):
    print(f"#define HF_GODOT_TYPE_{name} {type_name}\n#define HF_GODOT_SINCE_{name} {100 * int(major) + int(minor)}")
api = json.load(open("extension_api.json"))
usage = next(e for e in api["global_enums"] if e["name"] == "PropertyUsageFlags")["values"]
for flag in ("DEFAULT", "NIL_IS_VARIANT"):
    print(f"#define HF_GODOT_USAGE_{flag} {next(v['value'] for v in usage if v['name'] == 'PROPERTY_USAGE_' + flag)}")
sizes = {b["build_configuration"]: {s["name"]: s["size"] for s in b["sizes"]} for b in api["builtin_class_sizes"]}
opaque = ["String", "StringName", "Array", "Dictionary"] + [f"Packed{n}Array" for n in ("Byte", "Int32", "Int64", "Float32", "Float64", "Vector3")]
print("#define HF_GODOT_LARGEST_OPAQUE", max(build[name] for build in sizes.values() for name in opaque))
print("#define HF_GODOT_LARGEST_VARIANT", max(build["Variant"] for build in sizes.values()))
print("#define HF_GODOT_VECTOR3", sizes["float_64"]["Vector3"])
print("#define HF_GODOT_QUATERNION", sizes["float_64"]["Quaternion"])
PY
"$compiler" -std=c++17 -Wall -Wextra -Wno-unused -fsyntax-only -I. -I"$root/bindings/godot/src" "$root/tests/bindings/godot4_interface.cpp"
echo "$(grep -c HF_GODOT_TYPE_ godot4_names.h) functions of $("$godot" --version)"
