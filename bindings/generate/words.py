"""The words of the headers as a language says them: names of classes, methods, constants and shapes of arrays."""

import re
import textwrap

import comments
from plan import camel


class Words:
    """null, no_index: the language's words. method(class, verb), constant(enum, member), error(constant), shape(dims)."""

    def __init__(self, api, groups, language):
        self.language = language
        self.table = {}
        for enum in api["enums"]:
            self.table.update({m["name"]: language.constant(enum, m) for m in enum["members"]})
            self.table[enum["prefix"] + "*"] = language.enum(enum)
        for handle, methods in groups:
            for m in methods:
                self.table[m.name] = camel(handle["name"]) + ("" if m.function["verb"] == "create" else "." + language.method(m))
        for function in api["functions"]:
            long = function["short_of"]
            if long in self.table:
                self.table[function["name"]] = self.table[long]
        self.table.update({c["name"]: language.error(c["name"]) for c in api["constants"] if c["name"].startswith("HF_ERROR_")})
        self.table.update({s["name"]: camel(s["name"]) for s in api["structs"] if s["used"] != "in"})
        self.table.update({"HF_NO_INDEX": language.no_index, "NULL": language.null})

    def say(self, text):
        text = re.sub(r"(?:\b(?:float|double|u?int\d+_t|hf_\w+))?((?:\[[\w. +()]+\])+)", lambda m: self.shape(m.group(1)), text)
        text = re.sub(r"\b(?:in)?out_(\w+)->", r"\1.", text).replace("->", ".")
        text = re.sub(r"\b(?:in)?out_(?=[a-z])", "", text)
        return re.sub(r"\b(?:HF_|hf_|NULL)\w*\*?", lambda m: self.table.get(m.group(0), m.group(0)), text)

    def shape(self, dims):
        if re.match(r"\[sum", dims):
            return "lists of whole numbers:"
        return self.language.shape(comments.dims_of(dims))


def wrapped(text, width):
    lines = []
    for paragraph in text.split("\n"):
        lines += textwrap.wrap(paragraph, width, subsequent_indent="    " if re.match(r"\w+: ", paragraph) else "") or [""]
    return lines


def fold(text, indent, deeper=8):
    """A long line of code, broken behind commas."""
    pieces, lines, pad = re.split(r"(?<=,) ", text), [], " " * indent
    for piece in pieces:
        if lines and len(lines[-1]) + 1 + len(piece) <= 120:
            lines[-1] += " " + piece
        else:
            lines.append((pad if not lines else pad + " " * deeper) + piece)
    return lines


def method_words(plan, raises, shown=str, options=()):
    """What a method's documentation says: prose, a line for each argument, errors. Fields of options say theirs themselves."""
    apart = [f["name"] for f in options]
    said = [f"{shown(a.name)}: {re.sub(r'^NULL, or ', '', a.doc)}" for a in plan.arguments if a.doc and not (a.struct and a.name in apart)]
    errors = plan.method.function["errors"]
    parts = [plan.method.prose(), "\n".join(said), raises + " " + ", ".join(errors) + "." if errors else ""]
    return "\n\n".join(part for part in parts if part)


def class_words(handle, methods, structs, shown=str):
    make = next((m for m in methods if m.function["verb"] == "create"), None)
    parts = [handle["doc"]]
    if make:
        said = []
        for p in make.inputs:
            if p in make.flat:
                said += [f"{shown(f['name'])}: {re.sub(r'^NULL, or ', '', f['doc'])}" for f, _ in structs[p["type"]].asked() if f["doc"]]
            elif p["doc"]:
                said.append(f"{shown(p['name'])}: {p['doc']}")
        parts += [make.prose(), "\n".join(said)]
    return "\n\n".join(part for part in parts if part) or f"{camel(handle['name'])}."
