"""bindings/csharp/Hf/Raw.cs: blittable structs and DllImport declarations; pointers and handles are IntPtr in structs."""

from layout import is_pointer

TYPES = {"int32_t": "int", "uint32_t": "uint", "hf_result": "int", "float": "float", "double": "double",
    "size_t": "UIntPtr", "char": "byte",
         "uint8_t": "byte", "uint16_t": "ushort", "void": "void"}
RESERVED = {"operator", "params", "ref", "out", "in", "object", "base", "fixed", "lock", "event"}


def safe(name):
    return "@" + name if name in RESERVED else name


def cs_type(api, item):
    return "IntPtr" if is_pointer(api, item) else TYPES.get(item["type"], item["type"])


def write(api):
    out = ["// Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI as P/Invoke sees it.",
           "using System;", "using System.Runtime.InteropServices;", "", "namespace Hf.Native", "{",
           "    public static class Constants", "    {", f'        public const string HeaderVersion = "{api["version"]}";']
    for c in api["constants"]:
        kind, suffix = ("uint", "u") if c["value"] > 0x7FFFFFFF else ("int", "")
        out.append(f"        public const {kind} {c['name']} = {c['value']}{suffix};")
    out += ["    }", ""]
    for struct in api["structs"]:
        out += ["    [StructLayout(LayoutKind.Sequential)]", f"    public unsafe struct {struct['name']}", "    {"]
        for f in struct["fields"]:
            if f["count"]:
                out.append(f"        public fixed {TYPES[f['type']]} {safe(f['name'])}[{f['count']}];")
            else:
                out.append(f"        public {cs_type(api, f)} {safe(f['name'])};")
        out += ["    }", ""]
    out += ["    public static unsafe class Functions", "    {",
            "#if UNITY_IOS && !UNITY_EDITOR", '        internal const string LibraryName = "__Internal";', "#else",
            '        internal const string LibraryName = "hf";', "#endif", "",
            "        static Functions() { Library.Load(); }", ""]
    for function in api["functions"]:
        returns = function["returns"]
        result = "IntPtr" if returns["pointer"] else cs_type(api, returns)
        parameters = []
        for p in function["parameters"]:
            kind = "void*" if p["pointer"] else cs_type(api, p)
            parameters.append(f"{kind} {safe(p['name'])}")
        out += [f"        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] "
                f"public static extern {result} {function['name']}({', '.join(parameters)});"]
    out += ["    }", "}"]
    return {"csharp/Hf/Raw.cs": "\n".join(out) + "\n"}
