"""Blender with a window: a handle is dragged by the mouse on a mesh that an armature moves, then pins are painted with the brush.
blender_window_test.py FOLDER, which gets three pictures: nothing bound, a handle set, painted pins."""

import math
import os
import sys

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Quaternion, Vector

FOLDER = sys.argv[sys.argv.index("--") + 1]
sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
from blender_bodies import active, rig_tube, tube  # noqa: E402
from blender_window import event, inside, only_view, open_tab, run, undo, view  # noqa: E402

mesh_data, paint, panels, session = blender_addon.modules("mesh_data", "paint", "panels", "session")
os.makedirs(FOLDER, exist_ok=True)
seen = {}


def picture(name):
    path = os.path.join(FOLDER, f"{name}.png")
    inside(bpy.ops.screen.screenshot, filepath=path)
    assert os.path.getsize(path) > 10000, name


def pixel(place):
    _, _, region = view()
    return tuple(location_3d_to_region_2d(region, region.data, Vector(place)))


def body():
    return bpy.data.objects["tube"]


def handle():
    return bpy.data.objects["tube high"]


def shown():
    bpy.context.view_layer.update()
    return mesh_data.positions_of(body().evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh())


def middle():
    return shown()[list(handle()["hf_vertices"])].mean(0)


def held():
    return session.session_of(body(), bind=False)


def set_up():
    for leftover in list(bpy.data.objects):
        bpy.data.objects.remove(leftover)
    only_view()
    made = tube()
    rig = rig_tube(made, np.clip(mesh_data.positions_of(made.data)[:, 2] - 1.5, 0, 1))
    rig.pose.bones["upper"].rotation_quaternion = Quaternion((0, 0, 1), math.radians(-70))
    for polygon in made.data.polygons:
        polygon.use_smooth = True
    active(made)


def look():
    _, area, _ = view()
    space = area.spaces.active
    space.show_region_ui, space.show_region_toolbar = True, False
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = space.overlay.show_cursor = False
    space.region_3d.view_perspective = "ORTHO"
    space.region_3d.view_location = (0.6, 0, 1.8)
    space.region_3d.view_distance = 8
    space.region_3d.view_rotation = Quaternion((1, 0, 0), math.radians(90))  # from the front: x to the right, z up


def add_handles():
    seen["rest"] = shown()
    assert bpy.ops.hf.add_groups() == {"FINISHED"}
    np.testing.assert_allclose(shown(), seen["rest"], atol=1e-5)
    active(handle())
    bpy.ops.ed.undo_push(message="handles")


def grab():
    seen["from"], seen["pixel"] = middle(), pixel(handle().matrix_world.translation)
    event("MOUSEMOVE", "NOTHING", at=seen["pixel"])
    event("G", at=seen["pixel"])
    event("G", "RELEASE", at=seen["pixel"])


def drag(x, z):
    target = pixel(Vector(seen["from"].tolist()) + Vector((x, 0, z)))
    event("MOUSEMOVE", "NOTHING", at=target)
    seen["to"] = Vector(seen["from"].tolist()) + Vector((x, 0, z))


def let_go():
    event("LEFTMOUSE", at=pixel(seen["to"]))
    event("LEFTMOUSE", "RELEASE", at=pixel(seen["to"]))


def dragged():
    """The region is where the mouse was, in the pose of the armature."""
    for _ in range(20):
        bpy.ops.hf.update()
    error = (Vector(middle().tolist()) - seen["to"]).length
    assert error < 0.03, (error, middle(), seen["to"])  # 80 pixels for a unit; the mouse stands on whole ones
    assert (handle().matrix_world.translation - seen["to"]).length < 0.03
    step = panels.next_step(body(), held())
    assert step == "Move or turn a handle: the mesh follows.", step


def pose_bone():
    bpy.data.objects["rig"].pose.bones["upper"].rotation_quaternion = Quaternion((0, 0, 1), math.radians(-20))
    bpy.context.view_layer.update()
    assert (handle().matrix_world.translation - Vector(middle().tolist())).length < 1e-3


def begin_paint():
    active(body())
    bpy.data.objects.remove(bpy.data.objects["tube low"])
    bpy.data.objects.remove(bpy.data.objects["tube middle"])
    pins = body().vertex_groups.new(name="holds")
    body().vertex_groups.active_index = pins.index
    pins.add([v.index for v in body().data.vertices if v.co.z < 0.15], 1.0, "REPLACE")
    assert bpy.ops.hf.pins() == {"FINISHED"}
    seen["pinned"] = len(held().painted)
    inside(bpy.ops.object.mode_set, mode="WEIGHT_PAINT")
    settings = bpy.context.scene.tool_settings
    settings.unified_paint_settings.size, settings.unified_paint_settings.weight = 30, 1
    settings.unified_paint_settings.use_unified_strength, settings.unified_paint_settings.strength = True, 1
    bpy.ops.ed.undo_push(message="painted")


def stroke(x, z, kind="MOUSEMOVE", value="NOTHING"):
    event(kind, value, at=pixel((x, -0.5, z)))


def stroke_begins():
    stroke(-0.2, 0.4)
    stroke(-0.2, 0.4, "LEFTMOUSE", "PRESS")


def stroke_ends():
    stroke(0.2, 1.0)
    stroke(0.2, 1.0, "LEFTMOUSE", "RELEASE")


def painted():
    assert len(held().painted) > seen["pinned"], "the pins follow the brush"
    assert body().mode == "WEIGHT_PAINT"
    at = mesh_data.positions_of(body().data)[held().painted]
    np.testing.assert_allclose(at, mesh_data.rest_of(body().data)[held().painted], atol=1e-5)
    seen["pinned"] = len(held().painted)


def undone():
    assert len(held().painted) < seen["pinned"], "undo of the stroke"


STEPS = [set_up, look, open_tab, lambda: None, lambda: picture("nothing_bound"), add_handles, lambda: None, grab, lambda: drag(0.1, 0.1),
    lambda: drag(0.5, 0.6), let_go, dragged, lambda: picture("handle_set"), pose_bone, begin_paint, lambda: None, stroke_begins,
    lambda: stroke(-0.1, 0.5), lambda: stroke(0, 0.7), stroke_ends, lambda: None, painted, lambda: picture("painted_pins"), undo,
    lambda: None, undone]

run(STEPS, 0.7, failed=lambda: picture("failed"))
