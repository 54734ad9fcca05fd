"""The table of panels and operators in the add-on's README is that of the registered classes, in Blender without a display. If it
differs, the right table is printed."""

import inspect
import os
import pathlib
import re
import sys

import bpy

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402

panels, = blender_addon.modules("panels")
HEAD = "| panel | button | operator | what it does |\n|---|---|---|---|\n"


def text_of(value):
    """A default as a script writes it."""
    return f"{value:.6g}" if isinstance(value, float) else repr(value).replace("'", '"')


def options_of(operator):
    return ", ".join(f"{p.identifier}={text_of(p.default)}" for p in operator.get_rna_type().properties if p.identifier != "rna_type")


def rows():
    """A row for each button of each panel, in the order of the sidebar."""
    for panel in panels.PANELS:
        title = f"*{panel.bl_label}*, `{panel.bl_idname}`"
        for name in dict.fromkeys(re.findall(r'"hf\.(\w+)"', inspect.getsource(panel))):
            operator = getattr(bpy.ops.hf, name)
            kind = operator.get_rna_type()
            yield f"| {title} | {kind.name} | `hf.{name}({options_of(operator)})` | {' '.join(kind.description.split())} |\n"
            title = ""


assert all(hasattr(bpy.types, panel.bl_idname) for panel in panels.PANELS)
assert {getattr(bpy.types, c.__name__) for c in sys.modules[blender_addon.MODULE].CLASSES if issubclass(c, bpy.types.Panel)} == set(panels.PANELS)
wanted = HEAD + "".join(rows())
assert sorted(re.findall(r"`hf\.(\w+)\(", wanted)) == sorted(dir(bpy.ops.hf)), "an operator without a button, or with two"
readme = (pathlib.Path(os.environ["HF_TESTS"]).parents[1] / "bindings" / "blender" / "README.md").read_text()
there = re.search(re.escape(HEAD) + r"(?:\|.*\n)*", readme)
assert there and there.group(0) == wanted, f"the table of bindings/blender/README.md has to be:\n\n{wanted}"

blender_addon.disable()
print("blender names: all right")
