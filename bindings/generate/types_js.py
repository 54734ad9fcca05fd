"""bindings/js/src/index.d.ts: what each class of JavaScript takes and gives, with the words of the headers."""

import re

from model import named
from plan import PLACE, camel, recorded
from steps import Planner
from words import class_words, fold, method_words

KINDS = {"float": "f4", "double": "f8", "uint32_t": "u4", "uint16_t": "u2", "uint8_t": "u1", "int32_t": "i4"}
ARRAYS = {"f4": "Float32Array", "f8": "Float64Array", "u4": "Uint32Array", "u2": "Uint16Array", "u1": "Uint8Array", "i4": "Int32Array"}
RESERVED = {"function", "in", "new", "delete", "default", "class", "c", "call", "options"}


def js(name):
    """out_sites -> outSites"""
    text = re.sub(r"_([a-z0-9])", lambda m: m.group(1).upper(), name.rstrip("_")) + "_" * name.endswith("_")
    return text + "_" if text in RESERVED else text


class Types:
    """The part of class_js.Writer that declares."""

    def hint(self, a):
        if a.role == "handle":
            return camel(a.item["type"]) + ("" if a.required else " | null")
        if a.role == "array" and a.item["type"] == PLACE:
            return "readonly PlaceGiven[] | null"
        return {"array": "Rows | null" if not a.required else "Rows", "lists": "ReadonlyArray<Numbers> | null", "fixed": "Rows | null", "text": "string | readonly string[] | null",
                "blob": "Uint8Array | null", "place": "PlaceGiven", "type": "FloatsType", "request": "boolean", "flag": "boolean | number"}.get(a.role) or (
                    "T | null" if a.role == "out" and self.both else ARRAYS[KINDS[a.item["type"]]] + " | null" if a.role in ("out", "fill") else
                    f"{camel(a.item['type'])}Given | Rows | null" if a.role == "desc" else "number")

    def field_hint(self, f):
        if f["role"] == "value":
            return camel(f["type"])
        if f["role"] == "array":
            return ARRAYS[KINDS[f["type"]]]
        return "number[]" if f["role"] == "fixed" else "string" if f["role"] == "string" else "number"

    def result_hint(self, kind, name, item, plan):
        if kind == "array":
            return "T" if self.both and name == "out" else ARRAYS[KINDS[item["type"]]]
        if kind == "grown":
            return f"{camel(item['type'])}[]" if named(self.api["structs"], item["type"]) else ARRAYS[KINDS[item["type"]]]
        if kind == "info":
            return camel(item["type"]) + (" | null" if named(self.structs[item["type"]].struct["fields"], "found") else "")
        return {"bytes": "Uint8Array", "string": "string", "object": camel(item) if kind == "object" else "", "figure": "number", "returned": "number", "arrays": camel(item.name) if kind == "arrays" else ""}[kind]

    def declare(self, plan):
        m = plan.method
        self.both = any(a.role == "type" for a in plan.arguments)
        ahead, options = self.split(plan)
        parts = [f"{self.name(a)}{'' if a.required else '?'}: {self.hint(a)}" for a in ahead]
        if options:
            parts.append("options?: { " + "; ".join(f"{self.name(a)}?: {self.hint(a)}" for a in options) + " }")
        results = [(js(n.rstrip("_")), self.result_hint(k, n, i, plan)) for k, n, i in plan.results]
        extra = [(js(a.name), camel(a.item["type"])) for a in plan.arguments if a.role == "info"] if not m.own and m.kind == "call" else []
        if not results:
            returns = "void"
        elif plan.results[0].kind == "arrays" and len(results + extra) > 1:
            returns = results[0][1] + " & { " + "; ".join(f"{n}: {h}" for n, h in results[1:] + extra) + " }"
        else:
            returns = results[0][1] if len(results + extra) == 1 else "{ " + "; ".join(f"{n}: {h}" for n, h in results + extra) + " }"
        name = js(m.title())
        lines = self.doc(method_words(plan, "Throws", js), 2)
        if m.is_property():
            return lines + [f"  readonly {name}: {returns};"]
        if not self.both:
            return lines + fold(f"{name}({', '.join(parts)}): {returns};", 2)
        # `out` tells the type of the result; without it Type does, and without both it is Float32Array
        out = parts.index("out?: T | null")
        ahead = [part.replace("?:", ":", 1) + " | undefined" if "?:" in part else part for part in parts[:out]]
        behind = [part.replace("Type?: FloatsType; ", "").replace("; Type?: FloatsType", "").replace("Type?: FloatsType", "") for part in parts[out + 1:]]
        double = [part.replace("options?:", "options:").replace("Type?: FloatsType", "Type: Float64ArrayConstructor") for part in parts[out + 1:]]
        single = [part.replace("Type?: FloatsType", "Type?: Float32ArrayConstructor") for part in parts[out + 1:]]
        result = lambda T: re.sub(r"\bT\b", T, returns)
        for generic, own, given in (("", parts[:out] + ["out?: null"] + single, "Float32Array"), ("", ahead + ["out: null | undefined"] + double, "Float64Array"),
                                    ("<T extends Floats>", ahead + ["out: T | null | undefined"] + behind, "T")):
            lines += fold(f"{name}{generic}({', '.join(own)}): {result(given)};".replace("options?: {  }", "options?: {}"), 2)
        return lines

    def types(self):
        out = [TYPES]
        for name, struct in self.structs.items():
            fields = [f for f in struct.struct["fields"] if f["role"] not in ("size", "reserved", "callback", "handle", "struct", "bytes", "stride", "capacity") and not f["twin_of"]]
            if (struct.struct["used"] in ("out", "plain", "inout") or struct.struct.get("written")) and fields and name != "hf_error_detail":
                out += ["", *self.doc(struct.struct["doc"], 0)] + [f"export interface {camel(name)} {{"]
                for f in fields:
                    if f["role"] == "array" and f["const"] or (struct.struct["used"] == "inout" and f["direction"] == "in"):
                        continue
                    out += self.doc(re.sub(r"^out[:;]?\s*", "", f["doc"]), 2)
                    out.append(f"  {js(f['name'])}{'?' if f in struct.on_request else ''}: {self.field_hint(f)};")
                out.append("}")
        inner = {f["type"] for s in self.structs.values() for f in s.inner}
        for name in sorted(inner):
            planner = Planner(self.api, self.structs, self.sizes, None)
            for f, first in self.structs[name].asked():
                planner.field(self.structs[name], f, first)
            self.both = False
            out += ["", *self.doc(self.structs[name].struct["doc"], 0), f"export interface {camel(name)}Given {{"]
            for a in planner.arguments:
                out += self.doc(a.doc, 2) + [f"  {js(a.name)}?: {self.hint(a)};"]
            out.append("}")
        for name, (handle, methods, plans, told, counts) in self.methods.items():
            out += ["", *self.doc(class_words(handle, methods, self.structs, js), 0), f"export interface {name} extends {'Recorded' if recorded(methods) else 'Handle'} {{"]
            out += [f"  readonly {js(count)}: number;" for count in counts]
            for plan in plans:
                if plan.method.kind != "create" and plan.method.own:
                    out += self.declare(plan)
            for struct in told:
                out += [f"  /** What the last call told that writes it. */", f"  readonly {js(struct[3:])}: {camel(struct)};"]
            out.append("}")
            made = next((p for p in plans if p.method.function["verb"] == "create"), None)
            statics = [p for p in plans if (p.method.kind == "create" and p is not made) or (not p.method.own and p.method.kind != "create")]
            out.append(f"export interface {name}Class {{")
            if made:
                extras = f"{name}Extras & " if f"interface {name}Extras" in TYPES else ""
                out += [re.sub(r"^  create\(", "  new (", line).replace("): void;", f"): {name};").replace("options?: {", f"options?: {extras}{{") for line in self.declare(made) if not line.lstrip().startswith(("/**", "*"))]
            for plan in statics:
                out += [line.replace("): void;", f"): {name};") if plan.method.kind == "create" else line for line in self.declare(plan)]
            out.append("}")
        out += ["", "/** HF_* of the headers. */", "export interface Constants {", *[f"  readonly {c['name']}: {c['value']};" for c in self.api["constants"]], "}"]
        out += ["", "export interface Api {", *[f"  {name}: {name}Class;" for name in self.methods], API]
        return "\n".join(out) + "\n"


TYPES = '''// Generated from include/hf/*.h by bindings/generate; do not edit. Types of hf-fields: the same for the native and the
// WebAssembly backend.
type Numbers = ArrayLike<number>;
type Rows = Numbers | ReadonlyArray<Numbers>;
type Floats = Float32Array | Float64Array;
type FloatsType = Float32ArrayConstructor | Float64ArrayConstructor;

/** A failed call: code, codeName ("HF_ERROR_*"), index it is about (or null), functionName of the C ABI. */
export class HfError extends Error {
  code: number;
  codeName: string;
  index: number | null;
  functionName: string;
}

/** A vertex, a hit, or three corners of a triangle and their weights. */
export type PlaceGiven = number | { corners: Numbers; barycentrics: Numbers } | { place: Place };

export interface Handle {
  readonly closed: boolean;
  /** Gives the memory back; later calls do nothing. Objects may be closed in any order, or left to the garbage collector. */
  close(): void;
}

/** Undo on clones: a record is a clone and shares memory with the object. */
export interface Recorded extends Handle {
  /** Keeps the present state for undo(). */
  record(): void;
  /** Goes back to the last record, bit for bit. Without one it throws HF_ERROR_EMPTY. */
  undo(): void;
  /** Goes to the state before the last undo(). Without one since the last record() it throws HF_ERROR_EMPTY. */
  redo(): void;
}

/** What Surface takes beyond its options in the header. */
export interface SurfaceExtras {
  /** Faces instead of triangles. Starts without sizes are offsets, one more than there are faces. */
  faces?: { starts?: Numbers | null; sizes?: Numbers | null; corners: Numbers } | null;
  /** Joins the pieces of a character by links, so that fields and poses span them. */
  linkPieces?: boolean | number | { distance?: number; stiffness?: number; overlayDistance?: number };
  /** With linkPieces: a number per vertex. Pieces of different tags stay apart. */
  tags?: Numbers | null;
}'''
API = '''  HfError: typeof HfError;
  constants: Constants;
  /** Which build the calls go to. In node that is WebAssembly where no native library of the system was found. */
  backend: 'native' | 'wasm';
  version: [number, number, number];
}
export interface LoadOptions {
  /** In node: the path of the shared library. No other is tried. */
  library?: string;
  /** The bytes of hf.wasm, or its address, where a bundler or a host has moved it. */
  wasm?: ArrayBuffer | Uint8Array | URL | string;
  /** The default export of another hf.mjs, such as one with threads; with wasm. */
  factory?: (options: object) => Promise<object>;
}
export function load(options?: LoadOptions): Promise<Api>;'''
