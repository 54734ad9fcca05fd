"""Pins by painting: a vertex group of the mesh says what holds, and the pose follows the brush."""

import os
import sys

import bpy
import bmesh  # a part of bpy where this is a module
import numpy as np

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
from blender_bodies import AROUND, active, tube  # noqa: E402

mesh_data, paint, panels, session = blender_addon.modules("mesh_data", "paint", "panels", "session")

for leftover in list(bpy.data.objects):
    bpy.data.objects.remove(leftover)
body = tube()
rest = mesh_data.positions_of(body.data)
z = rest[:, 2]
near = lambda low, high: np.flatnonzero((low <= z) & (z <= high)).tolist()


def now():
    return mesh_data.positions_of(body.data)


def held():
    return session.session_of(body, bind=False)


def step():
    return panels.next_step(body, held())


def refused(text, **options):
    try:
        bpy.ops.hf.pins(**options)
    except RuntimeError as error:
        assert text in str(error), error
        return
    raise AssertionError(f"taken: {options}")


def stroke(vertices, weight):
    """What a stroke of the brush leaves, and Blender's event after it."""
    pins.add(vertices, weight, "REPLACE")
    bpy.context.view_layer.update()


def settle():
    for _ in range(40):
        bpy.ops.hf.update()


# ---- what is no pin is refused with what to do
active(body)
for group in list(body.vertex_groups):
    body.vertex_groups.remove(group)
refused("tube has no vertex group; paint one in Weight Paint")
pins = body.vertex_groups.new(name="holds")
refused("the weights of holds are 0; paint what holds", group="holds")
refused("has no vertex group 'nothing'", group="nothing")
pins.add(near(0, 1), 0.25, "REPLACE")
refused("no weight of holds is 0.5 or more; paint what holds with more strength", group="holds")
pins.add(near(0, 4), 1.0, "REPLACE")
refused("holds pins all vertices, so nothing can move; erase", group="holds")
pins.remove(near(0, 4))
pins.add([7], float("nan"), "REPLACE")
if not np.isfinite(pins.weight(7)):
    refused("the weight of vertex 7 in holds is nan; paint it again", group="holds")
assert paint.PINS not in body and not len(held().painted)
pins.remove([7])
assert step() == "Propose handles, or add one from selected vertices."

# ---- painted vertices hold; one handle is enough then, and no empty is there for them
stroke(near(0, 1), 1.0)
stroke(near(1.1, 1.4), 0.4)
assert bpy.ops.hf.pins() == {"FINISHED"}  # the active group
assert body[paint.PINS] == "holds" and held().pose.handle_count == 1 and not [o for o in bpy.data.objects if o.type == "EMPTY"]
np.testing.assert_array_equal(held().painted, near(0, 1))
assert step() == "Add a handle where you want to pull: select vertices in Edit Mode, press Add handle."
assert paint.lines_on(body, held()) == [(f"{len(near(0, 1))} vertices hold where holds is painted", "NONE")]
body.vertex_groups.new(name="hf top").add(near(3.7, 4), 1.0, "REPLACE")
assert bpy.ops.hf.add_groups() == {"FINISHED"}
top = bpy.data.objects["tube top"]
assert step() == "Move or turn a handle: the mesh follows." and held().pose.handle_count == 2
top.location.x += 1
bpy.context.view_layer.update()
settle()
np.testing.assert_allclose(now()[near(0, 1)], rest[near(0, 1)], atol=1e-5)
assert np.abs(now() - rest)[near(3.7, 4)].max() > 0.9 and np.abs(now() - rest)[near(1.5, 2)].max() > 0.02

# ---- more paint holds more, erased paint holds less; nothing is factorised again
factor = held()
bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
assert step() == "Paint or erase: the pose follows. Go back to Object Mode to move a handle."
stroke(near(1.1, 2), 1.0)
np.testing.assert_array_equal(held().painted, near(0, 2))
settle()
np.testing.assert_allclose(now()[near(0, 2)], rest[near(0, 2)], atol=1e-5)
stroke(near(0.5, 2), 0.0)
settle()
assert np.abs(now() - rest)[near(0.9, 1)].max() > 1e-3
np.testing.assert_allclose(now()[near(0, 0.4)], rest[near(0, 0.4)], atol=1e-5)
assert held() is factor

# ---- what is wrong later stays in the panel, and the pins stay as they were
stroke(near(0, 4), 1.0)
assert ("Pins and stiffness stay as they were: holds pins all vertices, so nothing can move; erase the part that is to move.",
    "ERROR") in paint.lines_on(body, held())
np.testing.assert_array_equal(held().painted, near(0, 0.4))
stroke(near(0, 4), 0.0)
assert paint.lines_on(body, held()) == [("Nothing is painted in holds any more: paint what holds, or choose Clear.", "ERROR")]
assert held().pose.handle_count == 1
stroke(near(0, 1), 1.0)
assert paint.lines_on(body, held())[0][1] == "NONE" and held().pose.handle_count == 2
bpy.ops.object.mode_set(mode="OBJECT")

# ---- a handle where it is painted: the handle has its vertices, and the pins get them back when it goes
body.vertex_groups.new(name="hf middle").add(near(0.8, 1.3), 1.0, "REPLACE")
assert bpy.ops.hf.add_handle(group="hf middle") == {"FINISHED"}
assert held().pose.handle_count == 3
middle = next(o for o in bpy.data.objects if o.type == "EMPTY" and o != top)
middle.location.y += 0.2
bpy.context.view_layer.update()
assert np.abs(now() - rest)[near(0.8, 1.3)].max() > 0.1
np.testing.assert_allclose(now()[near(0, 0.7)], rest[near(0, 0.7)], atol=1e-5)
bpy.data.objects.remove(middle)
bpy.context.view_layer.update()
settle()
np.testing.assert_allclose(now()[near(0, 1)], rest[near(0, 1)], atol=1e-5)

# ---- with Live off the brush waits for Update
bpy.context.scene.hf_live = False
stroke(near(1.1, 1.5), 1.0)
assert len(held().painted) == len(near(0, 1)) and step() == "Press Update, or turn Live on."
bpy.ops.hf.update()
np.testing.assert_array_equal(held().painted, near(0, 1.5))
bpy.context.scene.hf_live = True

# ---- undo and redo of a stroke and of the button; a file that is opened again
bpy.ops.ed.undo_push(message="before")
stroke(near(1.6, 2), 1.0)
bpy.ops.ed.undo_push(message="stroke")
bpy.ops.ed.undo()
body = bpy.data.objects["tube"]
active(body)
bpy.ops.hf.update()
np.testing.assert_array_equal(held().painted, near(0, 1.5))
bpy.ops.ed.redo()
body = bpy.data.objects["tube"]
active(body)
bpy.ops.hf.update()
np.testing.assert_array_equal(held().painted, near(0, 2))
settle()
before = now()
path = os.path.join(os.path.dirname(os.environ["HF_ADDON_ZIP"]), "pins.blend")
bpy.ops.wm.save_as_mainfile(filepath=path)
bpy.ops.wm.open_mainfile(filepath=path)
body, top = bpy.data.objects["tube"], bpy.data.objects["tube top"]
pins = body.vertex_groups["holds"]
active(body)
assert held() is None and paint.lines_on(body, None) == [("Pinned where holds is painted", "NONE")]
top.location.x += 0.3
bpy.context.view_layer.update()
np.testing.assert_array_equal(held().painted, near(0, 2))
np.testing.assert_allclose(now()[near(0, 2)], rest[near(0, 2)], atol=1e-5)
assert np.abs(now() - before).max() > 0.2

# ---- an edit of the mesh: new vertices between pinned ones hold, and the panel says so
bpy.ops.object.mode_set(mode="EDIT")
assert step() == "Leave Edit Mode (Tab): the handles and what is painted go along with the edit."
shape = bmesh.from_edit_mesh(body.data)
bmesh.ops.subdivide_edges(shape, edges=shape.edges[:], cuts=1, use_grid_fill=True)
bmesh.update_edit_mesh(body.data)
bpy.ops.object.mode_set(mode="OBJECT")
bpy.context.view_layer.update()
grown = mesh_data.rest_of(body.data)
wanted = np.flatnonzero((grown[:, 2] < 2.01) & (np.hypot(grown[:, 0], grown[:, 1]) > 0.4))
assert set(held().painted) >= set(wanted)
assert f"1 handle and {len(held().painted)} pinned vertices stay" in held().remarks[0], held().remarks
np.testing.assert_allclose(now()[held().painted], grown[held().painted], atol=1e-5)

# ---- vertices at one place count as one: a seam between a handle and pins is the handle's
def split(shape):
    ring = [e for e in shape.edges if all(abs(v.co.z - 3.7) < 1e-3 for v in e.verts)]
    bmesh.ops.split_edges(shape, edges=ring)
bpy.ops.hf.unbind()
for obj in list(bpy.data.objects):
    bpy.data.objects.remove(obj)
body = tube()
active(body)
shape = bmesh.new()
shape.from_mesh(body.data)
split(shape)
shape.to_mesh(body.data)
assert len(body.data.vertices) == len(rest) + AROUND
places = now()
where = places[:, 2]
sides = [p.vertices[:] for p in body.data.polygons]
below = sorted({v for s in sides if where[list(s)].min() < 3.65 for v in s})
above = sorted({v for s in sides if where[list(s)].min() > 3.65 for v in s})
assert not set(below) & set(above)
body.vertex_groups.new(name="holds").add([v for v in below if where[v] > 3.45 or where[v] < 0.5], 1.0, "REPLACE")
body.vertex_groups.new(name="cap").add(above, 1.0, "REPLACE")
assert bpy.ops.hf.pins(group="holds") == {"FINISHED"}
assert bpy.ops.hf.add_handle(group="cap") == {"FINISHED"} and held().pose.handle_count == 2
next(o for o in bpy.data.objects if o.type == "EMPTY").location.x += 0.2
bpy.context.view_layer.update()
assert np.abs(now() - places)[above].min(axis=0)[0] > 0.15

# ---- a group that is renamed or removed changes nothing until the button is pressed again; Clear takes the pins back
body.vertex_groups["holds"].name = "anchors"
bpy.context.view_layer.update()
bpy.ops.hf.update()
(line, icon), = paint.lines_on(body, held())
assert line.startswith("The vertex group holds is gone: ") and "Pins from group" in line and icon == "ERROR"
assert len(held().painted) > 0
assert bpy.ops.hf.pins(group="anchors") == {"FINISHED"} and paint.lines_on(body, held())[0][1] == "NONE"
assert bpy.ops.hf.pins(clear=True) == {"FINISHED"}
assert paint.PINS not in body and held().pose.handle_count == 1 and not paint.lines_on(body, held())

# ---- stiffness follows the brush too
assert bpy.ops.hf.stiffness(group="anchors") == {"FINISHED"}
painted = mesh_data.group_vertices(body, "anchors")  # vertices of the seam among them: their copies are as stiff
assert set(np.flatnonzero(held().stiffness == 1e4)) == {*painted, *(v for v in above if where[v] < 3.75)}
body.vertex_groups["anchors"].add(list(range(5 * AROUND, 9 * AROUND)), 1.0, "REPLACE")
bpy.context.view_layer.update()
assert np.all(held().stiffness[5 * AROUND:9 * AROUND] == 1e4)
bpy.ops.hf.unbind()
assert not any(key.startswith("hf_stiff") or key == paint.PINS for key in body.keys())

# ---- shape keys are shown instead of a pose: handles and pins are refused, fields are made; without the keys all goes on
body.shape_key_add(name="Basis")
there = set(bpy.data.objects)
for operator, options in ((bpy.ops.hf.pins, {"group": "anchors"}), (bpy.ops.hf.add_handle, {"group": "cap"}), (bpy.ops.hf.propose, {})):
    try:
        operator(**options)
    except RuntimeError as error:
        assert "tube has shape keys" in str(error) and "remove them" in str(error), error
    else:
        raise AssertionError(f"taken: {operator}")
assert set(bpy.data.objects) == there and step().startswith("tube has shape keys")
body.vertex_groups.new(name="floor").add([v for v in below if where[v] < 0.5], 1.0, "REPLACE")
assert bpy.ops.hf.field(high="cap", low="floor") == {"FINISHED"}
body.shape_key_clear()
assert bpy.ops.hf.add_handle(group="cap") == {"FINISHED"} and step().startswith("Add a second handle")

# ---- keys that are added to a posed mesh: no pose is shown, the tab says so; without the keys the handles go on
straight = mesh_data.edited_rest(body.data)
far = lambda places, shape: float(np.abs(places - shape).max())
places_of_key = lambda key: np.array([point.co for point in key.data])
assert bpy.ops.hf.add_handle(group="floor") == {"FINISHED"}
top = next(o for o in bpy.data.objects if o.get("hf_vertices") and "cap" in o.name)
top.location.x += 0.5
settle()
posed = now()
assert far(posed, straight) > 0.4
body.shape_key_add(name="Basis")
body.shape_key_add(name="smile").data[0].co.y += 0.25
top.location.x += 0.5
bpy.context.view_layer.update()
assert far(now(), posed) == 0 and step().startswith("tube has shape keys")
body.shape_key_clear()
settle()
assert far(now(), straight) > 0.8

# ---- such keys hold the pose: Unbind takes it out of them, and what a key changes stays
body.shape_key_add(name="Basis")
smile = body.shape_key_add(name="smile")
smile.data[0].co.y += 0.25
smile.value = 0  # Blender 5 gives it 1
assert bpy.ops.hf.unbind() == {"FINISHED"}
basis, smile = body.data.shape_keys.key_blocks
change = places_of_key(smile) - places_of_key(basis)
assert far(places_of_key(basis), straight) < 1e-6 and abs(change[0, 1] - 0.25) < 1e-6 and far(change[1:], 0) < 1e-6
shown = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
assert far(mesh_data.positions_of(shown), straight) < 1e-6

blender_addon.disable()
print("blender pins: all right")
