"""Quads that follow in the Blender add-on: strokes, poles and edges change, and the quads are made again."""

import contextlib
import io
import math
import os
import sys
import tempfile
import traceback

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
from blender_bodies import fails  # noqa: E402
import hf  # noqa: E402  (the package inside the add-on)
mesh_data, panels, quads, session = blender_addon.modules("mesh_data", "panels", "quads", "session")

raised = []  # Blender only prints what a handler raises
calls = []  # of hf.Quads.update, and how they ended


def watched(function):
    def run(*arguments):
        try:
            return function(*arguments)
        except BaseException:
            raised.append(traceback.format_exc())
            raise
    run.inner = function
    return bpy.app.handlers.persistent(run)


HANDLERS = [getattr(bpy.app.handlers, f"{name}_post") for name in ("depsgraph_update", "undo", "redo", "load")]
for handlers in HANDLERS:
    handlers[:] = [watched(f) if f.__module__.startswith(blender_addon.MODULE) else f for f in handlers]

library_update = hf.Quads.update


def counted(self, **options):
    calls.append(options)
    return library_update(self, **options)


hf.Quads.update = counted

for leftover in list(bpy.data.objects):
    bpy.data.objects.remove(leftover)


def ball(name, n, at=(0, 0, 0), scale=(1, 1, 1.4)):
    """A cube of 6 n^2 quads on an egg."""
    bpy.ops.mesh.primitive_cube_add(size=2, location=at)
    obj = bpy.context.active_object
    obj.name = obj.data.name = name
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=n - 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    points = mesh_data.positions_of(obj.data)
    points = points / np.linalg.norm(points, axis=1)[:, None] * np.array(scale, np.float32)
    obj.data.vertices.foreach_set("co", points.ravel())
    obj.data.update()
    return obj


def stroke_over(name, turns=0.7):
    line = bpy.data.curves.new(name, "CURVE")
    line.dimensions = "3D"
    spline = line.splines.new("POLY")
    angles = np.linspace(-0.8, 0.8, 24)
    spline.points.add(len(angles) - 1)
    for point, a in zip(spline.points, angles):
        b = turns * a
        point.co = (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), 1.4 * math.sin(b), 1)
    obj = bpy.data.objects.new(name, line)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def select(*objects):
    """The last one is active."""
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    for obj in objects:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = objects[-1]


def update():
    bpy.context.view_layer.update()


def content(obj):
    """Positions and faces, bit for bit."""
    return mesh_data.positions_of(obj.data).tobytes(), mesh_data.column(obj.data.loops, "vertex_index").tobytes()


def state_of(made):
    return quads.kept[made.hf_quads.key]


def fresh(source, *members, **options):
    """What Make quads makes of the same things now."""
    select(*members, source)
    assert bpy.ops.hf.quads(faces=FACES, **options) == {"FINISHED"}
    made = next(o for o in bpy.context.selected_objects if o.type == "MESH" and o != source)
    out = content(made)
    key = made.hf_quads.key
    for member in members:
        member[quads.KEYS] = " ".join(k for k in quads.keys_of(member) if k != key)
    mesh = made.data
    bpy.data.objects.remove(made)
    bpy.data.meshes.remove(mesh)
    return out


FACES = 900
body = ball("body", 20)
body.vertex_groups.new(name="upper").add([v.index for v in body.data.vertices if v.co.z > 0], 1.0, "REPLACE")
paint = bpy.data.materials.new("paint")
body.data.materials.append(paint)
line = stroke_over("line")
select(line, body)
assert bpy.ops.hf.quads(faces=FACES) == {"FINISHED"}
made = bpy.data.objects["body quads"]
group = made.hf_quads
assert group.source == body and group.faces == FACES and group.follow and quads.keys_of(line) == [group.key]
first, mesh = content(made), made.data
gloss = bpy.data.materials.new("gloss")
mesh.materials.append(gloss)
for polygon in mesh.polygons:
    polygon.use_smooth, polygon.material_index = True, 1

# ---- an update about something else makes nothing again
bystander = bpy.data.objects.new("bystander", None)
bpy.context.scene.collection.objects.link(bystander)
bystander.location.x = 3
update()
assert content(made) == first and not calls and not state_of(made).error

# ---- a stroke that is moved: the quads follow at once without relaxation, and with it when the hand rests
line.rotation_euler.z += 0.4
line.rotation_euler.x += 0.3
update()
moved = content(made)
assert moved != first and made.data == mesh and bpy.data.objects["body quads"] == made
assert calls[-1]["relax_count"] == hf.NO_INDEX and not mesh[quads.RELAXED] and len(calls) == 1
assert "followed in" in state_of(made).line and not state_of(made).error
assert list(mesh.materials) == [paint, gloss] and all(p.use_smooth and p.material_index == 1 for p in mesh.polygons)
update()
assert len(calls) == 1 and content(made) == moved  # its own writing is no reason to make it again
quads.finish()
relaxed = content(made)
assert "relax_count" not in calls[-1] and mesh[quads.RELAXED] and "relaxed in" in state_of(made).line
update()
assert len(calls) == 2 and relaxed != moved
assert relaxed == fresh(body, line), "the same bits as a new one"
assert list(mesh.materials) == [paint, gloss] and all(p.use_smooth and p.material_index == 1 for p in mesh.polygons)
assert [g.name for g in made.vertex_groups] == ["upper"]
upper = set(mesh_data.group_vertices(made, "upper"))
at = mesh_data.positions_of(mesh)
assert set(np.flatnonzero(at[:, 2] > 0.1)) <= upper and not upper & set(np.flatnonzero(at[:, 2] < -0.1))

# ---- undo and redo: one step for the move, and the quads follow it back and again
def undo_of(*steps):
    """Names of what is used go stale with every step of undo."""
    global body, made, line, group, mesh
    for step in steps:
        assert step() == {"FINISHED"}
        body, made, line = (bpy.data.objects[n] for n in ("body", "body quads", "line"))
        group, mesh = made.hf_quads, made.data
        update()


bpy.ops.ed.undo_push(message="before")
select(line)
bpy.ops.transform.translate(value=(0, 0, 0.25))
bpy.ops.ed.undo_push(message="moved")  # as Blender does it: before the event
update()
quads.finish()
further = content(made)
assert further != relaxed
undo_of(bpy.ops.ed.undo)
assert abs(line.location.z) < 1e-6
quads.finish()
assert content(made) == relaxed and mesh[quads.RELAXED]
undo_of(bpy.ops.ed.redo)
assert abs(line.location.z - 0.25) < 1e-6
quads.finish()
assert content(made) == further
bpy.data.objects["bystander"].location.x += 1
bpy.ops.ed.undo_push(message="something else")
undo_of(bpy.ops.ed.undo)  # to a step that was kept before the quads had followed
quads.finish()
assert abs(line.location.z - 0.25) < 1e-6 and content(made) == further
undo_of(bpy.ops.ed.undo)
quads.finish()
assert content(made) == relaxed

line.location.z += 0.1  # no event yet: the end of an undo is enough
for handler in bpy.app.handlers.undo_post:
    handler(bpy.context.scene)
assert content(made) != relaxed
line.location.z -= 0.1
update()
quads.finish()
assert content(made) == fresh(body, line)

# ---- points of a stroke, in its Edit Mode too
count = len(calls)
line.data.splines[0].points[3].co.z += 0.2
line.data.update_tag()
update()
assert len(calls) == count + 1
select(line)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.curve.select_all(action="SELECT")
bpy.ops.transform.translate(value=(0, 0, -0.3))
update()
edited = content(made)
assert len(calls) == count + 2
bpy.ops.object.mode_set(mode="OBJECT")
update()
quads.finish()
assert content(made) == fresh(body, line)

# ---- edges that are marked as sharp, in Edit Mode too; and options of the panel
group.sharp = True
ring = [e.index for e in body.data.edges if all(abs(body.data.vertices[v].co.z) < 1e-5 for v in e.vertices)]
assert len(ring) == 80, len(ring)
on_ring = lambda: np.count_nonzero(abs(mesh_data.positions_of(made.data)[:, 2]) < 1e-5)
assert on_ring() < 10
select(body)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="DESELECT")
bpy.ops.object.mode_set(mode="OBJECT")
bpy.context.tool_settings.mesh_select_mode = (False, True, False)
for e in ring:
    body.data.edges[e].select = True
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.mark_sharp()
update()
assert on_ring() > 20, on_ring()
bpy.ops.object.mode_set(mode="OBJECT")
update()
quads.finish()
assert content(made) == fresh(body, line, sharp=True)
group.sharp = False
quads.finish()
assert content(made) == fresh(body, line) and on_ring() < 10
group.symmetry = "Y"
quads.finish()
assert content(made) == fresh(body, line, symmetry="Y")
group.symmetry = "NONE"
group.crease = math.radians(30)
quads.finish()
assert content(made) == fresh(body, line, crease=math.radians(30))
group.crease = 0
group.faces = 500
quads.finish()
assert abs(len(mesh.polygons) - 500) < 50
group.faces = FACES
quads.finish()
assert content(made) == fresh(body, line)

# ---- a change ends the relaxation of what was there before
line.location.z += 0.05
update()
quads.begin(state_of(made))
job = state_of(made).job
line.location.z += 0.05
update()
assert job.done() and state_of(made).job is None and not mesh[quads.RELAXED]
quads.finish()
assert content(made) == fresh(body, line)

# ---- the timer: nothing before its time, then a thread, then the mesh
line.location.z += 0.02
update()
state = state_of(made)
assert quads.tick() == quads.POLL and state.job is None
state.due -= quads.IDLE
assert quads.tick() == quads.POLL and state.job is not None
state.job.result()
assert quads.tick() is None and mesh[quads.RELAXED] and state.job is None
assert content(made) == fresh(body, line)

# ---- edited by hand while it is relaxed: the edit stays
line.location.z -= 0.02
update()
quads.begin(state)
state.job.result()
mesh.vertices[0].co.x += 0.01
by_hand = content(made)
assert quads.tick() is None and content(made) == by_hand and not mesh[quads.RELAXED]
select(made)
assert bpy.ops.hf.update_quads() == {"FINISHED"} and content(made) == fresh(body, line)

# ---- what cannot be made: the mesh of before stays, the panel says why, and it is not tried again and again
before = content(made)
line.data.bevel_depth = 0.02
update()
state = state_of(made)
assert content(made) == before and "line has faces; a stroke is a curve without bevel or fill" in state.error, state.error
height = line.location.z
with contextlib.redirect_stdout(io.StringIO()) as printed:
    for _ in range(3):
        line.location.z += 0.01
        update()
assert state.error and not printed.getvalue(), "it is printed once"
line.location.z = height
line.data.bevel_depth = 0
update()
assert not state.error and content(made) == before
plain_guides = mesh_data.guides_of
mesh_data.guides_of = lambda *_: 1 / 0  # what nobody thought of is said too, and no handler raises
line.location.z += 0.01
update()
assert "ZeroDivisionError" in state.error and content(made) == before
mesh_data.guides_of = plain_guides
line.location.z = height
update()
assert not state.error and content(made) == before
# the library's own refusal: a mirror that the shape has not
refused = ball("refused", 12, at=(6, 0, 0))
lopsided = mesh_data.positions_of(refused.data)
lopsided[lopsided[:, 0] > 0.5, 0] += 0.8
refused.data.vertices.foreach_set("co", lopsided.ravel())
refused.data.update()
select(refused)
assert bpy.ops.hf.quads(faces=400) == {"FINISHED"}
other = bpy.data.objects["refused quads"]
before_other, count = content(other), len(calls)
other.hf_quads.symmetry = "X"
assert content(other) == before_other and state_of(other).error and not state_of(other).line.startswith("follow")
print("said:", state_of(other).error)
assert len(calls) == count + 1
for _ in range(3):
    refused.location.x += 0.1  # the same mesh without strokes: the same refusal, which is not asked for again
    update()
assert len(calls) == count + 1 and state_of(other).error and content(other) == before_other
select(other)
fails(state_of(other).error, bpy.ops.hf.update_quads)
assert content(other) == before_other
other.hf_quads.symmetry = "NONE"
assert not state_of(other).error and content(other) == before_other

# ---- another mesh in the source
flat = ball("flat", 14, at=(6, 0, 0), scale=(2, 1, 0.5))
plain_mesh, refused.data = refused.data, flat.data
update()
assert not state_of(other).error and np.ptp(mesh_data.positions_of(other.data), axis=0)[2] < 1.1
refused.data = plain_mesh
update()
quads.finish()
assert content(other) == before_other
bpy.data.objects.remove(flat)

# ---- Follow off, Update quads
select(made)
group.follow = False
assert panels.quads_step(made, made) == "Press Update quads, or turn Follow on."
before, count = content(made), len(calls)
line.location.z -= 0.1
update()
assert content(made) == before and len(calls) == count
assert bpy.ops.hf.update_quads() == {"FINISHED"}
assert content(made) == fresh(body, line) != before
line.location.z -= 0.1
update()
group.follow = True  # follows what it missed
assert not mesh[quads.RELAXED]
quads.finish()
assert content(made) == fresh(body, line)
assert panels.quads_step(made, line) == "Move the stroke: the quads follow."

# ---- edited by hand: it stays, and is said; Update quads takes the edits back
mesh.vertices[0].co.x += 0.01
mesh.update()
by_hand = content(made)
line.location.z += 0.1
update()
assert content(made) == by_hand and "was edited by hand" in state_of(made).error
select(made)
assert bpy.ops.hf.update_quads() == {"FINISHED"} and not state_of(made).error
assert content(made) == fresh(body, line)
select(made)
bpy.ops.object.mode_set(mode="EDIT")
line.location.z += 0.1
update()
assert "when you leave its Edit Mode" in state_of(made).error
bpy.ops.object.mode_set(mode="OBJECT")
update()
assert not state_of(made).error, state_of(made).error
quads.finish()
assert content(made) == fresh(body, line)

# ---- a duplicate stays as it is; a duplicate of a stroke is one more stroke
copy = made.copy()
copy.data = made.data.copy()
bpy.context.scene.collection.objects.link(copy)
second = line.copy()
second.location.z -= 0.6
bpy.context.scene.collection.objects.link(second)
before = content(copy)
update()
quads.finish()
assert content(copy) == before != content(made)
assert content(made) == fresh(body, line, second)
bpy.data.objects.remove(copy)
select(second, line, body)
assert bpy.ops.hf.quads(faces=FACES) == {"FINISHED"}
twin, count = bpy.data.objects["body quads.001"], len(calls)
body.update_tag()
update()
assert len(calls) == count  # the order in which they were selected is no change
bpy.data.objects.remove(twin)

# ---- a stroke that is deleted, by the user's way and by a script's
with_second = content(made)
select(second)
bpy.ops.object.delete()
update()
quads.finish()
assert content(made) == fresh(body, line) != with_second

# ---- poles: the irregular vertex is where the empty is, and follows it
def pole_off(pole, count):
    """How far the nearest vertex of so many quads is from the pole, in edges of quads."""
    valences = np.bincount(mesh_data.column(made.data.edges, "vertices", 2))
    at = mesh_data.positions_of(made.data)[valences == count]
    edge = math.sqrt(sum(p.area for p in made.data.polygons) / len(made.data.polygons))
    return np.linalg.norm(at - np.array(pole.location), axis=1).min() / edge if len(at) else np.inf


def on_body(a, b):
    return Vector((math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), 1.4 * math.sin(b)))


select(body)
fails("select quads that Make quads made", bpy.ops.hf.add_pole)
fails("select quads that Make quads made", bpy.ops.hf.draw_strokes)
fails("select quads that Make quads made", bpy.ops.hf.update_quads)
for count in (3, 5):
    select(made)
    bpy.context.scene.cursor.location = on_body(2.6, 0.2)
    assert bpy.ops.hf.add_pole(count=str(count)) == {"FINISHED"}
    pole = bpy.context.active_object
    assert pole[quads.POLE] == count and panels.quads_step(made, pole) == "Move the pole: the quads follow."
    assert (pole.matrix_world.to_3x3().col[2] - Vector(pole.location) * Vector((1, 1, 1 / 1.96))).length < 0.6  # z: outwards
    away = []
    for a in np.linspace(2.6, 3.6, 6):
        pole.location = on_body(a, 0.2)
        update()
        away.append(pole_off(pole, count))
    quads.finish()
    away.append(pole_off(pole, count))
    print(f"pole of {count}: edges off", np.round(away, 2))
    assert max(away) < 1, away
    assert content(made) == fresh(body, line, pole)
    turned = content(made)
    pole.rotation_euler.rotate_axis("Z", 0.4)
    update()
    assert content(made) != turned
    place, body.location, body.rotation_euler.z, body.scale = pole.location.copy(), (3, 1, 2), 0.7, (2, 2, 2)
    update()
    pole.location = body.matrix_world @ place  # in the space of the mesh where it was
    update()
    pole.location = place
    assert pole_off(pole, count) < 1
    body.location, body.rotation_euler.z, body.scale = (0, 0, 0), 0, (1, 1, 1)
    update()
    select(pole)
    bpy.ops.object.delete()
    update()
quads.finish()
assert content(made) == fresh(body, line)

# ---- strokes to draw: an empty curve, in Edit Mode, that belongs to the quads
select(made)
assert bpy.ops.hf.draw_strokes() == {"FINISHED"}
drawn = bpy.context.active_object
assert bpy.context.mode == "EDIT_CURVE" and quads.keys_of(drawn) == [group.key] and quads.made_of(bpy.context) == made
update()
assert not state_of(made).error
bpy.ops.object.mode_set(mode="OBJECT")
before = content(made)
spline = drawn.data.splines.new("POLY")
spline.points.add(9)
for i, point in enumerate(spline.points):
    point.co = (*on_body(2.5 + 0.1 * i, 0.08 * i), 1)
drawn.data.update_tag()
update()
assert content(made) != before
bpy.data.objects.remove(drawn)
update()
quads.finish()
assert content(made) == before

# ---- saved and loaded: nothing is made again until something changes; relaxation that waited is made up for
def loaded():
    global body, made, line
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "follow.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
    assert not quads.kept
    body, made, line = (bpy.data.objects[n] for n in ("body", "body quads", "line"))


saved, count = content(made), len(calls)
loaded()
update()
assert content(made) == saved and len(calls) == count
line.location.z += 0.1
update()
assert content(made) != saved and not made.data[quads.RELAXED]
saved = content(made)
loaded()
update()
assert content(made) == saved and not made.data[quads.RELAXED]
made.hf_quads.follow = False
made.hf_quads.follow = True
quads.finish()
assert made.data[quads.RELAXED] and content(made) == fresh(body, line)

# ---- another scene in between
scene, there = bpy.context.window.scene, bpy.data.scenes.new("empty")
bpy.context.window.scene = there
there.cursor.location.x += 1
bystander = bpy.data.objects.new("bystander", None)
there.collection.objects.link(bystander)
update()
assert made.hf_quads.key in quads.kept
bpy.context.window.scene = scene
line.location.z -= 0.1
update()
assert not made.data[quads.RELAXED]
quads.finish()
assert content(made) == fresh(body, line)

# ---- the quads are deleted while they are relaxed; the source is deleted; nothing raises
line.location.z += 0.05
update()
state = state_of(made)
quads.begin(state)
key = made.hf_quads.key
bpy.data.objects.remove(made)
quads.finish()
assert not state.error and state.job is None
update()
line.location.z += 0.05
update()
assert key not in quads.kept and state.quads is None and "body quads" not in bpy.data.objects
select(line, body)
assert bpy.ops.hf.quads(faces=FACES) == {"FINISHED"}
made = bpy.data.objects["body quads"]
select(line)
assert quads.made_of(bpy.context) == made  # not those that are gone
line.location.z += 0.05
update()
before = content(made)
select(body)
bpy.ops.object.delete()
line.location.z += 0.05
update()
assert "is gone" in state_of(made).error and content(made) == before
quads.finish()
select(made)
fails("is gone", bpy.ops.hf.update_quads)
fails("is gone", bpy.ops.hf.add_pole)
select(line)
assert bpy.ops.object.delete() == {"FINISHED"}
update()

# ---- switched off and on again
kept = list(quads.kept.values())
assert kept and any(k.quads for k in kept)
for handlers in HANDLERS:
    handlers[:] = [getattr(f, "inner", f) for f in handlers]
# ---- a mesh of many pieces gets more quads than were asked for, and the line says why
for leftover in list(bpy.data.objects):
    bpy.data.objects.remove(leftover)
many = ball("many", 4)
for k in range(1, 12):
    ball(f"piece {k}", 4, (3 * k, 0, 0)).select_set(True)
for obj in bpy.data.objects:
    obj.select_set(True)
bpy.context.view_layer.objects.active = many
bpy.ops.object.join()
for asked, said in ((20, ", not 20, because the mesh has 12 pieces: a closed one needs six quads or more"), (2000, "")):
    bpy.context.view_layer.objects.active = many
    with contextlib.redirect_stdout(io.StringIO()):
        assert bpy.ops.hf.quads(faces=asked) == {"FINISHED"}
    made = bpy.context.active_object
    line = quads.kept[made.hf_quads.key].line
    assert len(made.data.polygons) >= 72 and line.startswith(f"{len(made.data.polygons)} quads{said}"), line
    assert said or line == f"{len(made.data.polygons)} quads", line

blender_addon.disable()
assert not quads.kept and not any(k.quads for k in kept)
assert not raised, raised[0]
print(f"blender quads: Blender {bpy.app.version_string}: all right")
