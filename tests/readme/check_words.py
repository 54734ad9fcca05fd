#!/usr/bin/env python3
"""check_words.py SOURCE_DIR: the add-on for Blender and the studio use the same words: tools, dials, what both have."""

import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
addon = {path.name: path.read_text() for path in sorted((root / "bindings/blender/hf_blender").glob("*.py"))}
studio = {path.name: path.read_text() for path in sorted((root / "samples/studio/src").rglob("*.js"))}
everywhere = ["\n".join(addon.values()), "\n".join(studio.values())]
wrong = []

titles = set(re.findall(r"static title = '(.*)'", studio["pose.js"] + studio["field.js"]))
titles |= set(re.findall(r"later\(\s*'(?!brush')\w+',\s*'(\w+)'", studio["studio.js"]))  # the brush is a part of Pose and Field
panels = re.findall(r'bl_label, bl_idname.* = "(\w+)", "HF_PT_', addon["panels.py"])
if len(titles) != 6:
    wrong.append(f"the studio has six tools; their names were read as {sorted(titles)}")
# armatures follow armatures in Blender alone; the studio has bodies
wrong += [f"the panel {name} is no tool of the studio" for name in panels if name not in titles | {"hf", "Retarget"}]

dials = re.findall(r"\['\w+', '(.*?)', ", studio["transfer.js"].split("const DIALS")[1].split("];")[0])
labels = re.findall(r'"\w+": \("(.*?)", ', addon["operators.py"].split("DIALS = {")[1].split("\n}")[0])
if len(dials) != 6 or dials != labels:
    wrong.append(f"dials of the studio are {dials}, those of the add-on {labels}")

for word in ("Make quads", "Draw strokes", "Pole of ", "Creases from", "Mirror", "Compute weights", "Bones for each vertex"):
    wrong += [f'"{word}" is not in {where}' for where, text in zip(("the add-on", "the studio"), everywhere)
        if not re.search(rf"""["'`]{word}""", text)]

print("\n".join(wrong) or "ok")
sys.exit(1 if wrong else 0)
