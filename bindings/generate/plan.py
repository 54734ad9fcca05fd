"""What a class layer makes of each function, whatever the language: what a caller gives, what comes back.

A class for each object, a method for each function. Counts, strides and capacities follow from arrays. The fields of a desc
become named arguments. Outputs are returned; an optional struct of results is filled when the caller gives one.
"""

import re

import comments
from model import OBJECT_COUNTS, named, symbols

# what a call is about comes first; the other ways to say it are named, as options are
FIRST = {"hf_surface_desc": ("positions", "triangles"), "hf_skeleton_desc": ("names", "parents", "rest"),
         "hf_skin_desc": ("positions", "triangles", "joints", "weights"), "hf_sites_desc": ("vertices", "values"), "hf_morph_desc": ("weight",),
         "hf_transfer_frame": ("source_positions",), "hf_faces_desc": ("corners", "sizes", "starts"), "hf_handles_desc": ("region_vertices",),
         "hf_pairs_desc": ("source_vertices", "target_vertices", "flags"), "hf_graph_desc": ("edges", "weights"), "hf_pins_desc": ("vertices",),
         "hf_skeleton_desc": ("names", "parents", "rest"), "hf_skin_desc": ("positions", "triangles", "joints", "weights")}
# functions that no class holds: the layers use them for errors and versions
LOOSE = ("hf_error_get_detail", "hf_result_get_name", "hf_version_get")

PLACE = "hf_place"  # one place: languages take a vertex, a hit, or corners with weights for it

LENT = ("borrow",)  # memory of the caller that outlives the call: no language of owned arrays can promise it


def bare(name):
    return re.sub(r"^(in)?out_", "", name)


def camel(name):
    """hf_surface_report -> SurfaceReport"""
    return "".join(word[:1].upper() + word[1:] for word in re.sub(r"^hf_", "", name).split("_"))


class Struct:
    """A desc, an info, or both, as a class layer sees it."""

    def __init__(self, api, struct):
        fields = [f for f in struct["fields"] if not f["twin_of"] and f["role"] not in ("size", "reserved", "callback") and f["name"] not in LENT]
        self.api, self.struct, self.name = api, struct, struct["name"]
        self.counts = [f for f in fields if f["role"] == "count"]
        self.capacities = [f for f in fields if f["role"] == "capacity"]
        arrays = [f for f in fields if f["role"] == "array"]
        self.given = [f for f in arrays if f["const"]]
        self.filled = [f for f in arrays if not f["const"]]
        self.on_request = [f for f in self.filled if "NULL =" in f["doc"]]  # to ask for it changes the others
        self.ragged = {f["name"]: symbols(f["dims"]).pop() for f in self.given if f["dims"][0].startswith("sum(")}
        self.handles = [f for f in fields if f["role"] == "handle"]
        self.inner = [f for f in fields if f["role"] == "struct"]
        self.texts = [f for f in fields if f["role"] == "string" and f["pointer"]]
        self.fixed = [f for f in fields if f["role"] == "fixed" and f["direction"] != "out"]
        self.blobs = [f for f in fields if f["role"] == "bytes"]
        sizes = [re.sub("s$", "", b["name"]) + "_count" for b in self.blobs]
        self.scalars = [f for f in fields if f["role"] in ("scalar", "enum", "flag") and f["direction"] != "out" and f["name"] not in sizes]
        self.results = [f for f in fields if f["direction"] == "out" and f["role"] in ("scalar", "enum", "flag") and f["name"] not in {
            c.get("counted_by") for c in self.capacities}]

    def asked(self):
        """(field, positional) that a caller gives, what comes first in front."""
        lists = [f for f in self.given if f["name"] not in self.ragged.values()]
        first = [named(self.struct["fields"], name) for name in FIRST.get(self.name, ())]
        rest = [f for f in self.struct["fields"] if f in lists + self.texts + self.blobs and f not in first]
        options = [f for f in self.struct["fields"] if f in self.scalars + self.fixed + self.handles + self.inner and f not in first]
        return [(f, True) for f in first] + [(f, not first) for f in rest] + [(f, False) for f in options]

    def key(self, dim, prefix=""):
        """A dimension as a key of the counts of a call: inner structs have counts of their own."""
        name = next(iter(symbols([dim])), "")
        return dim.replace(name, prefix + name) if name and named(self.counts, name) else dim


class Method:
    def __init__(self, api, function, structs):
        self.api, self.function, self.structs = api, function, structs
        self.noun, self.name, self.kind = function["noun"], function["name"], function["kind"]
        parameters = function["parameters"]
        self.own = parameters[0] if parameters and parameters[0]["type"] == self.noun and not parameters[0]["pointer"] else None
        self.parents = [p for p in parameters if p["role"] == "handle" and not p["pointer"] and p is not self.own]
        self.capacity = next((p for p in parameters if p["role"] == "capacity"), None)
        self.counters = {p["name"] for p in parameters if self.capacity and p["name"] == self.capacity["counted_by"]}
        self.inputs = [p for p in parameters if p["direction"] == "in" and p is not self.own and p["role"] not in ("count", "capacity", "stride")]
        self.outputs = [p for p in parameters if p["direction"] != "in" and p["name"] not in self.counters]
        given = [p for p in self.inputs if p["role"] == "struct"]
        plain = [p for p in given if structs[p["type"]].struct["used"] == "plain"]
        self.places = plain if self.kind != "call" or not self.verb_sets() else []  # a struct given whole
        self.records = [p for p in plain if p not in self.places]  # a struct given field by field
        self.flat = [p for p in given if p not in plain]
        texts = [p for p in self.inputs if p["role"] == "string"]
        self.texts = texts

    def outputs_are_arrays(self):
        return any(p["role"] == "array" for p in self.outputs)

    def verb_sets(self):
        return self.function["verb"].startswith("set_")

    def title(self):
        """The method's name: get_x is x, create_x is from_x."""
        verb = self.function["verb"]
        if verb.startswith("create_"):
            return "from_" + verb[7:]
        return verb[4:] if verb.startswith("get_") else verb

    def is_property(self):
        """A figure or a struct of figures, asked with nothing but the object."""
        arrays = any(p["role"] in ("array", "bytes", "string") for p in self.outputs) or any(
            self.structs[p["type"]].filled for p in self.outputs if p["type"] in self.structs)
        return self.function["verb"].startswith("get_") and bool(self.own) and not self.inputs and not arrays and not self.capacity

    def prose(self):
        """The first words of the comment, up to what it says of each parameter."""
        prose, _ = comments.parts(self.function["doc"])
        for p in self.function["parameters"]:
            if p["doc"]:
                prose = re.sub(rf"(?:\w+(?:, | and ))*{re.escape(p['name'])}: {re.escape(p['doc'])}\s*", "", prose)
                prose = prose.replace(f"{p['name']}: {p['doc']}", "")
        return re.sub(r"\s*Sets \*\w+ to NULL first\.", "", prose).strip()


def classes(api):
    """[(handle, [Method])]: what a layer shows, in the order of the headers."""
    structs = {s["name"]: Struct(api, s) for s in api["structs"]}
    methods = [Method(api, f, structs) for f in api["functions"] if not f["short_of"] and f["name"] not in LOOSE]
    lost = [m.name for m in methods if not m.noun]
    if lost:
        raise ValueError(f"no class for {', '.join(lost)}")
    return [(h, [m for m in methods if m.noun == h["name"]]) for h in api["handles"]], structs


def edits(function):
    """Whether the object that a function makes may have other counts than the object that it was made from."""
    return function == "hf_surface_edit"


def moves(function):
    """Whether an object takes the counts of the surface that it goes to."""
    return function.endswith("_move_to")


def counts_of(handle, groups, structs):
    """The counts that an object keeps: its own calls ask for them, or those of objects made on it do."""
    methods = next(methods for h, methods in groups if h is handle)
    found = {c.rpartition(".")[2] for c in dims_used(methods, structs)} & OBJECT_COUNTS
    own = set().union(*(m.function["object_counts"] for m in methods if m.own and m.kind != "create"), set())
    for child, others in groups:
        if child is not handle and any(p["type"] == handle["name"] for m in others if m.kind == "create" for p in m.parents):
            own |= set().union(*(m.function["object_counts"] for m in others if m.own), set())
    return sorted(found | own - OBJECT_COUNTS)


def recorded(methods):
    """Objects that can be cloned have undo: a record is a clone."""
    return any(m.kind == "clone" for m in methods)


def dims_used(methods, structs):
    """Names in the dimensions of a class's arrays."""
    found = set()
    for method in methods:
        for p in method.function["parameters"]:
            found |= symbols(p["dims"])
            if p["type"] in structs:
                found |= dims_of_struct(structs, p["type"])
    return found


def dims_of_struct(structs, name):
    found = set()
    for field in structs[name].struct["fields"]:
        found |= symbols(field["dims"]) - {f["name"] for f in structs[name].counts}
        if field["role"] == "struct":
            found |= dims_of_struct(structs, field["type"])
    return found
