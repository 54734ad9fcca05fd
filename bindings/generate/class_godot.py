"""bindings/godot/src/surface_made.cpp: methods of Godot's class that take lists and numbers alone, or return a struct of figures.
What takes or returns more is written by hand, as scripts need it."""

from model import named, symbols
from plan import classes, dims_used
from steps import Planner
from words import fold

# the object of a class that a HfSurface holds, and what its setters are called
HELD = {"hf_surface": ("s.get()", "surface_"), "hf_solver": ("solver_of(s)", ""), "hf_pose": ("pose_of(s)", ""),
        "hf_direction": ("s.direction.get()", "direction_"), "hf_quads": ("s.quads.get()", "quads_"),
        "hf_region": ("s.region.get()", "region_"), "hf_transfer": ("s.transfer.get()", "transfer_")}
NAMES = {"hf_solver_get_statistics": "statistics"}
# fields of several channels, previews and threads are not offered; region_info has more, by hand
LEFT_OUT = ("hf_solver_move_vectors", "hf_solver_rotate_vectors", "hf_solver_release_preview", "hf_solver_prepare_rebase", "hf_region_get_info")
HEAD = '''// Generated from include/hf/*.h by bindings/generate; do not edit. Methods of lists and numbers, and figures.
// clang-format off
#include "arguments.h"

namespace hf_godot {
namespace {
'''


def setter(m, arguments):
    """The lines of a call that takes lists and numbers: integers first, since counts are theirs."""
    lines, counts, values = [], {"vertex_count": "s.vertex_count"}, {}
    for i, a in enumerate(arguments):
        item = a.item
        if a.role == "array" and item["type"] == "uint32_t":
            lines.append(f'  const List {a.name} = integers(at(a, {i}), "{a.name}");')
            count = next(iter(symbols(item["dims"])))
            if counts.get(count, "s.").startswith("s."):
                counts[count] = f"{a.name}.count()"
            else:
                first = counts[count].split(".")[0]
                lines.append(f'  if ({a.name}.count() != {first}.count()) fail("{first} and {a.name} must be of one length");')
            values[a.name] = f"{a.name}.data()"
        elif a.role == "array":
            size = " * ".join(d if d.isdigit() else f"size_t{{{counts[d]}}}" for d in item["dims"] if d != "channel_count")
            values[a.name] = f'doubles(at(a, {i}), {size}, "{a.name}")'
        else:
            read = {"double": "{}", "uint32_t": 'whole({}, "{name}")', "int32_t": 'signed_whole({}, "{name}")'}[item["type"]]
            values[a.name] = read.format(f"at(a, {i}).number", name=a.name)
    given = [HELD[m.noun][0]] + [values.get(p["name"]) or counts[p["name"]] for p in m.function["parameters"] if p is not m.own]
    return [*lines, f"  check({m.name}({', '.join(given)}));", "  return done();"]


def figures(m, struct):
    shown = [f["name"] for f in struct["fields"] if f["role"] in ("scalar", "enum", "flag", "count")]
    pairs = ", ".join(f'{{"{name}", info.{name}}}' for name in shown)
    return [f"  auto info = make<{struct['name']}>();", f"  check({m.name}({HELD[m.noun][0]}, &info));", f"  return named({{{pairs}}});"]


def write(api):
    groups, structs = classes(api)
    sizes = set().union(*(dims_used(methods, structs) for _, methods in groups))
    out, table = [], []
    for m in (m for handle, methods in groups if handle["name"] in HELD for m in methods):
        if m.kind not in ("call", "info") or not m.own or m.name in LEFT_OUT:
            continue
        plan = Planner(api, structs, sizes, m).plan()
        simple = all(a.role in ("array", "scalar", "enum", "flag") for a in plan.arguments)
        if [r.kind for r in plan.results] == ["info"] and not plan.arguments:
            name, body = f"{m.noun[3:]}_{m.title()}", figures(m, named(api["structs"], plan.results[0].item["type"]))
        elif simple and not plan.results and {op for op, _ in plan.steps} <= {"array", "call", "forget"}:
            name, body = HELD[m.noun][1] + m.title(), setter(m, plan.arguments)
        else:
            continue
        name = NAMES.get(m.name, name)
        table.append(f'{{"{name}", {sum(a.required for a in plan.arguments)}, {len(plan.arguments)}, {name}}}')
        out += ["", f"// {name}({', '.join(a.name for a in plan.arguments)})", f"Value {name}(Surface& s, const Arguments&{' a' * bool(plan.arguments)}) {{"]
        out += [line for text in body for line in fold(text.lstrip(), 2, 4)] + ["}"]
    entries = [f"      {one}," for one in table]
    end = ["", "}  // namespace", "", "const std::vector<Entry>& made_methods() {", "  static const std::vector<Entry> all = {", *entries, "  };",
           "  return all;", "}", "", "}  // namespace hf_godot"]
    return {"godot/src/surface_made.cpp": HEAD + "\n".join(out + end) + "\n"}
