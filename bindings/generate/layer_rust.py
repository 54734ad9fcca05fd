"""bindings/rust/src/raw.rs: structs of C layout, functions and constants. Counts and figures can be asked by name."""

import textwrap

from comments import first_sentence

TYPES = {"int32_t": "i32", "uint32_t": "u32", "hf_result": "i32", "float": "f32", "double": "f64", "size_t": "usize",
    "char": "c_char", "uint8_t": "u8", "uint16_t": "u16", "int64_t": "i64", "uint64_t": "u64", "void": "c_void"}
RESERVED = {"type", "move", "ref", "in", "where", "loop", "match", "box", "fn", "mod", "use", "self"}
FILLED = ("_dials", "_info", "_report", "_statistics", "_certificate")  # ends of names of structs that the library fills

MACROS = '''
/// Structs of zeros with their size.
macro_rules! sized {
    ($($name:ident)*) => {$(
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: every field may be zero: numbers, arrays of numbers and null pointers.
                let mut made: Self = unsafe { std::mem::zeroed() };
                made.struct_size = std::mem::size_of::<Self>() as u32;
                made
            }
        }
    )*};
}

/// Structs of zeros.
macro_rules! zeroed {
    ($($name:ident)*) => {$(
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: every field may be zero: numbers, arrays of numbers and null pointers.
                unsafe { std::mem::zeroed() }
            }
        }
    )*};
}

/// Structs whose figures can be asked by name.
macro_rules! figures {
    ($($name:ident: $($field:ident)*;)*) => {$(
        impl $name {
            /// The figure of this name, for generic tools.
            pub fn figure(&self, name: &str) -> Option<f64> {
                Some(match name {
                    $(stringify!($field) => f64::from(self.$field),)*
                    _ => return None,
                })
            }
        }
    )*};
}
'''.strip().split("\n")


def safe(name):
    return "r#" + name if name in RESERVED else name


def rust_type(item):
    if item["type"] == "function":
        return "*const c_void"
    return ("*const " if item["const"] else "*mut ") * item["pointer"] + TYPES.get(item["type"], item["type"])


def write_struct(struct):
    out = [f"/// {line}" for line in [first_sentence(struct["doc"])] if line]
    out += ["#[repr(C)]", "#[derive(Clone, Copy, Debug, PartialEq)]", f"pub struct {struct['name']} {{"]
    for f in struct["fields"]:
        kind = rust_type(f)
        whole = f"[{kind}; {f['count']}]" if f["count"] else kind
        out.append(f"    pub {safe(f['name'])}: {whole},")
    return out + ["}"]


def figures_of(struct):
    """Names of the numbers of a struct that the library fills."""
    if not struct["name"].endswith(FILLED) or any(f["pointer"] for f in struct["fields"]):
        return []
    return [f["name"] for f in struct["fields"] if f["type"] in ("int32_t", "uint32_t", "float", "double") and not f["count"]]


def macro(name, rows):
    lines = [f"{name}! {{"]
    for row in rows:
        lines += textwrap.wrap(row, 116, initial_indent="    ", subsequent_indent="        ")
    return ["", *lines, "}"]


def write(api):
    out = ["// Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI as Rust sees it.",
           "//! The C ABI, unsafe and without wrapping. The headers of hf describe it.",
           "#![allow(non_camel_case_types, missing_docs)]", "use std::os::raw::{c_char, c_void};", "",
           f'pub const HEADER_VERSION: &str = "{api["version"]}";']
    for c in api["constants"]:
        out.append(f"pub const {c['name']}: {'u32' if c['value'] > 0x7FFFFFFF else 'i32'} = {c['value']};")
    out.append("")
    for handle in api["handles"]:
        out += ["#[repr(C)]", f"pub struct {handle['object']} {{", "    _opaque: [u8; 0],", "}",
                f"pub type {handle['name']} = *mut {handle['object']};"]
    for struct in api["structs"]:
        out += [""] + write_struct(struct)
    sized = [s["name"] for s in api["structs"] if s["fields"][0]["name"] == "struct_size"]
    out += ["", *MACROS]
    out += macro("sized", [" ".join(sized)]) + macro("zeroed", [" ".join(s["name"] for s in api["structs"] if s["name"] not in sized)])
    out += macro("figures", [f"{s['name']}: {' '.join(figures_of(s))};" for s in api["structs"] if figures_of(s)])
    out += ["", 'extern "C" {']
    for function in api["functions"]:
        parameters = ", ".join(f"{safe(p['name'])}: {rust_type(p)}" for p in function["parameters"])
        returns = rust_type(function["returns"])
        out.append(f"    pub fn {function['name']}({parameters}){'' if returns == 'c_void' else ' -> ' + returns};")
    out += ["}"]
    return {"rust/src/raw.rs": "\n".join(out) + "\n"}
