"""Milliseconds of a followed change in Blender: blender_follow_bench.py [CUTS [QUADS [CHANGES]]].

A lumpy ball of 6 CUTS^2 + 2 vertices has a stroke and a pole, and one of them is moved again and again. Printed are the
time of the library, the time until the mesh of the quads is written, the time of Blender's whole update, and the processor
time of that.
"""

import math
import os
import sys
import time

import bpy
import numpy as np

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402

mesh_data, quads = blender_addon.modules("mesh_data", "quads")
CUTS, QUADS, CHANGES = [int(x) for x in sys.argv[sys.argv.index("--") + 1:]] + [58, 5000, 20][len(sys.argv) - sys.argv.index("--") - 1:]


def onto(points):
    """Places on the lumpy ball, in the directions of points."""
    p = points / np.linalg.norm(points, axis=1)[:, None]
    size = 1 + 0.12 * np.sin(5 * p[:, 0] + 1) * np.sin(4 * p[:, 1]) + 0.1 * np.sin(6 * p[:, 2] + 2 * p[:, 0])
    return p * size[:, None]


for leftover in list(bpy.data.objects):
    bpy.data.objects.remove(leftover)
bpy.ops.mesh.primitive_cube_add(size=2)
body = bpy.context.active_object
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.subdivide(number_cuts=CUTS - 1)
bpy.ops.object.mode_set(mode="OBJECT")
body.data.vertices.foreach_set("co", onto(mesh_data.positions_of(body.data)).astype(np.float32).ravel())
body.data.update()

curve = bpy.data.curves.new("stroke", "CURVE")
curve.dimensions = "3D"
turns = np.linspace(-0.8, 0.8, 40)
line = onto(np.stack([np.cos(turns), np.sin(turns), 0.7 * turns], 1))
spline = curve.splines.new("POLY")
spline.points.add(len(line) - 1)
spline.points.foreach_set("co", np.c_[line, np.ones(len(line))].astype(np.float32).ravel())
stroke = bpy.data.objects.new("stroke", curve)
bpy.context.scene.collection.objects.link(stroke)
stroke.select_set(True)
assert bpy.ops.hf.quads(faces=QUADS) == {"FINISHED"}
made = bpy.context.scene.objects[f"{body.name} quads"]
bpy.ops.object.select_all(action="DESELECT")
bpy.context.view_layer.objects.active = made
bpy.context.scene.cursor.location = (-1, 0, 0)
assert bpy.ops.hf.add_pole(count="3") == {"FINISHED"}
pole = bpy.context.active_object
state = quads.kept[made.hf_quads.key]


def table(name, change):
    rows = []
    for i in range(CHANGES + 1):
        change(i)
        begin, used = time.perf_counter(), time.process_time()
        bpy.context.view_layer.update()
        whole, used = 1e3 * (time.perf_counter() - begin), 1e3 * (time.process_time() - used)
        assert not state.error and not made.data[quads.RELAXED], state.error
        rows.append((state.figures["library_ms"], state.figures["total_ms"], whole, used))
    low, middle, high = np.quantile(rows[1:], [0, 0.5, 1], axis=0)  # the first one makes what the others keep
    cells = " | ".join(f"{middle[k]:.0f} ({low[k]:.0f} to {high[k]:.0f})" for k in range(4))
    print(f"| {name} | {len(body.data.vertices)} | {len(made.data.polygons)} | {cells} |")


print("| moved | vertices | quads | library ms | with writing the mesh | Blender's update | its processor time |\n|---|---|---|---|---|---|---|")
table("stroke", lambda i: setattr(stroke, "rotation_euler", (0, 0, 0.02 * i + 0.01)))
table("pole", lambda i: setattr(pole, "location", onto(np.array([[-1, 0.02 * i, 0.3]]))[0]))
begin = time.perf_counter()
quads.finish()
print(f"relaxed: {state.figures['library_ms']:.0f} ms, with writing {state.figures['total_ms']:.0f}")
