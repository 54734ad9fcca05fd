"""A bound mesh that is edited, and a file that is opened again, in Blender without a display: handles stay and go on."""

import os
import sys

import bmesh
import bpy
import numpy as np

sys.path.insert(0, os.environ["HF_TESTS"])
bpy.ops.preferences.addon_install(filepath=os.environ["HF_ADDON_ZIP"])
bpy.ops.preferences.addon_enable(module="hf_blender")
from hf_blender import mesh_data, session  # noqa: E402

RINGS, AROUND = 41, 16


def tube():
    """A closed tube along z from 0 to 4, thick 0.5."""
    turn = 2 * np.pi * np.arange(AROUND) / AROUND
    points = [(0.5 * np.cos(t), 0.5 * np.sin(t), 0.1 * i) for i in range(RINGS) for t in turn]
    faces = [(i * AROUND + j, i * AROUND + (j + 1) % AROUND, (i + 1) * AROUND + (j + 1) % AROUND, (i + 1) * AROUND + j)
        for i in range(RINGS - 1) for j in range(AROUND)]
    mesh = bpy.data.meshes.new("tube")
    mesh.from_pydata(points, [], [*faces, tuple(reversed(range(AROUND))), tuple(range((RINGS - 1) * AROUND, RINGS * AROUND))])
    obj = bpy.data.objects.new("tube", mesh)
    bpy.context.scene.collection.objects.link(obj)
    for name, low, high in (("hf low", 0, 0.35), ("hf middle", 1.75, 2.25), ("hf high", 3.65, 4)):
        obj.vertex_groups.new(name=name).add([i for i, p in enumerate(points) if low <= p[2] <= high], 1.0, "REPLACE")
    return obj


def active(obj):
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def edit(change):
    """Edit Mode around an act on the bmesh."""
    bpy.ops.object.mode_set(mode="EDIT")
    shape = bmesh.from_edit_mesh(body.data)
    shape.verts.ensure_lookup_table()
    change(shape)
    bmesh.update_edit_mesh(body.data)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.update()


def handles():
    return {o.name[len("tube "):]: o for o in bpy.data.objects if o.type == "EMPTY" and "hf_id" in o}


def now():
    return mesh_data.positions_of(body.data)


def held():
    return session.session_of(body, bind=False)


body = tube()
active(body)
assert bpy.ops.hf.add_groups() == {"FINISHED"}
rest = now()
handles()["high"].location.x += 1
bpy.context.view_layer.update()
for _ in range(40):
    bpy.ops.hf.update()  # until the pose is at rest
posed, factor = now(), held()
assert np.abs(posed - rest).max() > 0.9

# ---- Edit Mode without an edit keeps the session, and the pose to the bit
edit(lambda shape: None)
assert held() is factor and np.array_equal(now(), posed)

# ---- a vertex that is moved in the pose moves at rest; all handles stay
def pull(shape):
    shape.verts[0].co.z -= 0.25
edit(pull)
assert held() is not factor and held().pose.handle_count == 3 and set(handles()) == {"low", "middle", "high"}
np.testing.assert_allclose(mesh_data.rest_of(body.data)[0], rest[0] - (0, 0, 0.25), atol=1e-5)
np.testing.assert_allclose(mesh_data.rest_of(body.data)[1:], rest[1:], atol=1e-6)
np.testing.assert_allclose(now()[1:], posed[1:], atol=0.01)

# ---- new vertices lie on the rest shape, regions grow with them, and the pose goes on
def refine(shape):
    bmesh.ops.subdivide_edges(shape, edges=[e for e in shape.edges if min(v.co.z for v in e.verts) < 2], cuts=1, use_grid_fill=True)
region = len(handles()["low"]["hf_vertices"])
edit(refine)
grown = mesh_data.rest_of(body.data)
assert len(grown) > len(rest) + 500 and held().pose.handle_count == 3
np.testing.assert_allclose(np.delete(grown[:len(rest)], 0, 0), rest[1:], atol=1e-6)
around = np.linalg.norm(grown[:, :2], axis=1)
assert around.min() > 0.45 and around.max() < 0.51, (around.min(), around.max())
assert len(handles()["low"]["hf_vertices"]) >= region
before = now()
handles()["high"].location.x += 0.5
bpy.context.view_layer.update()
assert 0.4 < np.abs(now() - before).max() < 0.7

# ---- a handle whose vertices are deleted goes, and the panel says so; the numbers of the others follow
def cut(shape):
    bmesh.ops.delete(shape, geom=[v for v in shape.verts if v.index in there], context="VERTS")
there = set(handles()["middle"]["hf_vertices"])
edit(cut)
assert set(handles()) == {"low", "high"} and held().pose.handle_count == 2
assert any("tube middle went with its vertices" in remark for remark in held().remarks), held().remarks
high = list(handles()["high"]["hf_vertices"])
assert mesh_data.rest_of(body.data)[high, 2].min() > 3.6
handles()["high"].location.y += 0.1
bpy.context.view_layer.update()
assert not held().remarks or "edited" not in held().remarks[0]

# ---- a file that is opened again follows at the first move, without a button
path = os.path.join(os.path.dirname(os.environ["HF_ADDON_ZIP"]), "edited.blend")
bpy.ops.wm.save_as_mainfile(filepath=path)
saved = now()
bpy.ops.wm.open_mainfile(filepath=path)
body = bpy.data.objects["tube"]
np.testing.assert_allclose(now(), saved, atol=1e-4)
handles()["high"].location.x -= 1
bpy.context.view_layer.update()
assert held().pose.handle_count == 2
assert np.abs(now() - saved).max() > 0.8

# ---- a played file follows too
bpy.ops.wm.save_as_mainfile(filepath=path)
high = handles()["high"]
for frame, x in ((1, 0.0), (10, 1.5)):
    high.location.x = x
    high.keyframe_insert("location", frame=frame)
bpy.context.scene.frame_set(1)
bpy.ops.wm.save_as_mainfile(filepath=path)
bpy.ops.wm.open_mainfile(filepath=path)
body = bpy.data.objects["tube"]
before = now()
bpy.context.scene.frame_set(10)
assert np.abs(now() - before).max() > 1.2

# ---- unbind takes back all that was added
active(body)
assert bpy.ops.hf.unbind() == {"FINISHED"}
assert not handles() and mesh_data.NUMBER not in body.data.attributes and mesh_data.REST not in body.data.attributes
bpy.ops.preferences.addon_disable(module="hf_blender")
print("blender edit: all right")
