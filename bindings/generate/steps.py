"""The steps of a method, whatever the language: what its caller gives, what is made of it, the call, what comes back.

plan(api, structs, sizes, method) gives a Plan. A language writes each step in its words; names are those of C, without out_.

  arguments  Argument: role handle, place, array, lists, text, blob, fixed, desc, scalar, flag, enum, out (an array to fill and
             return), type (of a new one), fill (an array to fill), info (a struct to fill), request (whether an array is wanted)
  steps      (op, values): forget, known, struct, rows, desc, record, records, array, out, view, fill, point, scalar, info, call,
             make, bytes, grow, returns. An item with a `view` is an hf_array in C
  results    Result: array, info, figure, arrays (a struct of arrays), object, bytes, string
"""

import re
from collections import namedtuple

import comments
from model import OBJECT_COUNTS, named, symbols
from plan import bare

Argument = namedtuple("Argument", "name role item required first doc struct")
Result = namedtuple("Result", "kind name item")
Plan = namedtuple("Plan", "method arguments steps results")


def step(op, **values):
    return op, values


class Planner:
    def __init__(self, api, structs, sizes, method):
        self.api, self.structs, self.sizes, self.m = api, structs, sizes, method
        self.arguments, self.steps, self.results, self.values = [], [], [], {}
        self.grown, self.grown_struct, self.desc = [], None, None

    def argue(self, name, role, item, required=False, first=True, doc=None, struct=None):
        if any(a.name == name for a in self.arguments):
            raise ValueError(f"{self.m.name}: two arguments {name}")
        self.arguments.append(Argument(name, role, item, required, first, item["doc"] if doc is None else doc, struct))

    def do(self, op, **values):
        self.steps.append((op, values))

    def plan(self):
        m = self.m
        for p in m.function["parameters"]:
            if p["role"] == "count" and (p["name"] in OBJECT_COUNTS or p["name"] in m.function["object_counts"]):
                self.do("forget", key=p["name"])  # of the list given here, not of the object
        if m.own:
            self.values[m.own["name"]] = ("self",)
        for p in m.inputs:
            self.take(p)
        self.give_fields()
        for p in m.outputs:
            self.give(p)
        self.finish()
        return Plan(m, self.arguments, self.steps, self.results)

    # ---- what goes in ----

    def field(self, struct, f, first=True):
        """One field of a desc as an argument."""
        if f["role"] == "array":
            role = "lists" if f["name"] in struct.ragged else "array"
        else:
            role = {"string": "text", "bytes": "blob", "struct": "desc"}.get(f["role"], f["role"])
        self.argue(bare(f["name"]) if f["role"] == "array" and not f["const"] else f["name"], role, f, first=first, struct=struct)

    def take(self, p):
        m, name = self.m, p["name"]
        if p in m.parents:
            self.argue(name, "handle", p, required=not p["optional"], first=not p["optional"])
            self.values[name] = ("handle", name, p["type"])
        elif p in m.places:
            self.argue(name, "place", p, required=True)
            self.values[name] = ("place", name, p["type"])
        elif p in m.flat:
            struct = self.structs[p["type"]]
            for f, first in struct.asked():
                self.field(struct, f, first)
            kept = OBJECT_COUNTS | set(m.function["object_counts"]) if m.own else set()
            # a count of the list, not of the object; without a dot, so that what is made does not keep it
            prefix = "list_" if kept & {f["name"] for f in struct.counts} else ""
            self.do("desc", var="desc", struct=struct, names=[f["name"] for f, _ in struct.asked()], prefix=prefix)
            self.values[name], self.desc = ("ref", "desc"), struct
        elif p in m.records or (p["role"] == "array" and named(self.api["structs"], p["type"])):
            many = "s" if p["role"] == "array" else ""
            fields = [f for f in named(self.api["structs"], p["type"])["fields"] if f["role"] != "reserved"]
            for f in fields:
                self.argue(f["name"] + many, "fixed", f)
            pairs = [(f, f["name"] + many) for f in fields]
            self.do("records" if many else "record", var=name, type=p["type"], fields=pairs, dims=p["dims"])
            self.values[name] = ("var", name) if many else ("ref", name)
        elif p["role"] == "string":
            self.argue(name, "text", p)
            self.values[name] = ("text", name)
        elif p["role"] == "array":
            self.argue(name, "array", p, required=not p["optional"])
            self.do("array", var=name + "_", name=name, item=p)
            self.values[name] = ("ref_if", name + "_", name) if p["view"] else ("var", name + "_")
        else:
            self.argue(name, p["role"], p, required=not (p["zero"] or p["role"] in ("enum", "flag")))
            self.values[name] = ("number", name, p)
            if name in self.sizes or any(name in symbols(q["dims"]) for q in m.function["parameters"]):
                self.do("known", key=name, default=comments.default_of(p["doc"]))

    # ---- what comes out ----

    def free(self, name):
        """A variable that no argument has."""
        return name + "_" * any(a.name == name for a in self.arguments)

    def give_fields(self):
        """Outputs among the fields of a desc."""
        for f in self.desc.filled if self.desc else []:
            main = not self.results and not self.m.outputs_are_arrays()
            name, twin = "out" if main else bare(f["name"]), f.get("twin") if main else None
            self.argue(name, "out" if main else "fill", f, first=main)
            if main and twin:
                self.argue("dtype", "type", f, first=False, doc="")
            self.do("out" if main else "fill", var=name, item=f, twin=twin, given=True)
            self.do("point", var=name, field=f, twin=twin, optional=not main)
            if main:
                self.results.append(Result("array", "out", f))

    def give(self, p):
        name = bare(p["name"])
        if p["role"] == "handle":
            return
        if p["role"] == "struct" and p["direction"] == "inout":
            self.give_both(p, name)
        elif p["role"] == "struct" and (p["optional"] or self.results or self.grown):
            self.argue(name, "info", p, first=False, doc="filled in when given")
            if self.m.capacity and self.m.capacity["counted_by"].startswith(p["name"] + "."):
                self.do("info", var=name, type=p["type"], optional=True)
            self.values[p["name"]] = ("info", name, p["type"])
        elif p["role"] == "struct":
            name = self.free(name)
            self.do("info", var=name, type=p["type"], optional=False)
            self.values[p["name"]] = ("ref", name)
            self.results.append(Result("info", name, p))
        elif p["role"] == "array" and self.m.capacity:
            self.grown.append(p)
            self.results.append(Result("grown", name, p))
        elif p["role"] == "array":
            self.give_array(p, name)
        elif p["role"] in ("bytes", "string"):
            self.results.append(Result("bytes" if p["role"] == "bytes" else "string", "block", p))
        else:
            name = self.free(name)
            self.do("scalar", var=name, item=p)
            self.values[p["name"]] = ("figure", name)
            self.results.append(Result("figure", name, p))

    def give_array(self, p, name):
        m, twin = self.m, p.get("twin")
        if any(r.name == "out" for r in self.results):
            self.argue(name, "fill", p, first=False)
            self.do("fill", var=name, item=p, twin=None, given=True)
            self.values[p["name"]] = ("address", name)
            return
        main = bool(p["view"]) and not self.results
        variable = "out" if main else self.free(name)
        if main:
            self.argue("out", "out", p)
            if twin:
                self.argue("dtype", "type", p, first=False, doc="")
        self.do("out", var=variable, item=p, twin=twin if main else None, given=main)
        self.values[p["name"]] = ("address", variable)
        if p["view"]:
            self.do("view", var=variable + "_view", name=variable, item=p)
            self.values[p["name"]] = ("ref", variable + "_view")
        self.results.append(Result("array", variable, p))

    def give_both(self, p, name):
        """A struct that goes in and out: options in, arrays and figures out."""
        struct = self.structs[p["type"]]
        for f, _ in struct.asked():
            self.field(struct, {**f, "doc": re.sub(r"^in[:;]?\s*|;\s*out:.*$", "", f["doc"])}, first=f["role"] != "handle")
        for f in struct.on_request:
            self.argue(f["name"], "request", f, first=False)
        name = self.free(name)
        self.do("struct", var=name, type=struct.name, fields=[f["name"] for f in struct.scalars])
        for f in struct.scalars:
            if f["name"] in self.sizes:
                self.do("known", key=f["name"], default=comments.default_of(f["doc"]))
        self.do("fields", struct=struct, var=name)
        self.values[p["name"]] = ("ref", name)
        if struct.filled:
            self.grown_struct = (struct, name)
            self.results.append(Result("arrays", name, struct))
        else:
            self.results.append(Result("info", name, p))

    # ---- the call ----

    def finish(self):
        m, parameters = self.m, self.m.function["parameters"]
        for p in parameters:
            if p["role"] == "count":
                self.values[p["name"]] = ("count", p["name"])
        if m.function["returns"]["type"] not in ("hf_result", "void"):
            self.steps[:] = []
            self.do("returns", function=m.name, values=self.ordered())
            self.results.append(Result("returned", "", m.function["returns"]))
        elif m.kind in ("create", "clone", "derive"):
            made = "self" if m.kind == "create" and m.function["verb"] == "create" else "made"
            self.do("make", made=made, function=m.name, values=self.ordered(lambda p: not (p["role"] == "handle" and p["pointer"])), kind=m.kind)
            if made == "made":
                self.results.append(Result("object", "made", m.noun))
        elif any(r.kind in ("bytes", "string") for r in self.results):
            out = next(p for p in parameters if p["role"] in ("bytes", "string") and p["direction"] == "out")
            self.values[m.capacity["counted_by"]] = ("figure", "size")
            self.values[m.capacity["name"]], self.values[out["name"]] = ("literal", "0"), ("null",)
            asked = self.ordered()
            self.values[m.capacity["name"]], self.values[out["name"]] = ("size_of", "block"), ("address", "block")
            self.do("bytes", function=m.name, first=asked, second=self.ordered())
        elif self.grown or self.grown_struct:
            self.grow()
        else:
            self.do("call", function=m.name, values=self.ordered())

    def ordered(self, keep=lambda p: True):
        return [self.values[p["name"]] for p in self.m.function["parameters"] if keep(p)]

    def grow(self):
        m = self.m
        owner = "self" if m.own else m.parents[0]["name"]
        if self.grown:
            by = m.capacity["counted_by"]
            told = (bare(by.split(".")[0]), by.split(".")[1]) if "." in by else ("count", "")
            if "." not in by:
                self.values[by] = ("figure", "count")
            self.values[m.capacity["name"]] = ("room", "capacity")
            for p in self.grown:
                self.values[p["name"]] = ("grown", bare(p["name"]))
            self.do("grow", function=m.name, owner=owner, values=self.ordered(), tell=[("capacity", *told)], rooms=[("capacity", "")],
                    arrays=[(bare(p["name"]), p, False) for p in self.grown], into=None)
        else:
            struct, name = self.grown_struct
            told = [(f["name"], name, f["counted_by"]) for f in struct.capacities]
            shaped = set().union(*(symbols(f["dims"]) for f in struct.filled))
            told += [(f["name"], name, f["name"]) for f in struct.struct["fields"] if f["direction"] == "out" and f["name"] in shaped]
            rooms = [(f["name"], f["counted_by"] if f["counted_by"] in self.sizes else "") for f in struct.capacities]
            self.do("grow", function=m.name, owner=owner, values=self.ordered(), tell=told, rooms=rooms,
                    arrays=[(f["name"], f, f in struct.on_request) for f in struct.filled], into=name)


def desc_steps(api, struct, sizes):
    """The steps that fill a desc: the same for every function that takes it."""
    known = [("known", {"key": f["name"], "default": comments.default_of(f["doc"])}) for f in struct.scalars if f["name"] in sizes]
    return [step("struct", var="desc", type=struct.name, fields=[f["name"] for f in struct.scalars]), *known, step("fields", struct=struct, var="desc")]


def field_steps(api, struct):
    """(op, values) for the fields of a struct that are no scalars."""
    steps = []
    for f in struct.given:
        if f["name"] in struct.ragged.values():
            continue
        if f["name"] in struct.ragged:
            counts = named(struct.struct["fields"], struct.ragged[f["name"]])
            steps.append(step("ragged", counts=counts, field=f))
        elif named(api["structs"], f["type"]):
            steps.append(step("written", field=f))
        else:
            steps.append(step("rows", struct=struct, field=f, name=f["name"]))
    steps += [step("blob", field=f, count=re.sub("s$", "", f["name"]) + "_count") for f in struct.blobs]
    steps += [step("text", field=f) for f in struct.texts] + [step("fixed", field=f) for f in struct.fixed]
    steps += [step("handle", field=f) for f in struct.handles]
    return steps


def least(count):
    """A count that no array gives: 1, so that the library says what is missing, where none is allowed."""
    return 1 if count["doc"].startswith(">= 1") else 0
