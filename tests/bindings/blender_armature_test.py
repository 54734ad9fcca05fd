"""Handles and painted pins on a mesh that an armature moves by a modifier, in Blender without a display."""

import math
import os
import sys

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
from blender_bodies import AROUND, active, rig_tube, tube, weigh_tube  # noqa: E402

armatures, carriers, mesh_data, operators, panels, session = blender_addon.modules("armatures", "carriers", "mesh_data", "operators",
    "panels", "session")

for leftover in list(bpy.data.objects):
    bpy.data.objects.remove(leftover)
body = tube()
points = mesh_data.positions_of(body.data)
z = points[:, 2]


def bend(degrees):
    rig.pose.bones["upper"].rotation_quaternion = Quaternion((1, 0, 0), math.radians(degrees))
    bpy.context.view_layer.update()


def shown():
    bpy.context.view_layer.update()
    return mesh_data.positions_of(body.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh())


def empties():
    return {o.name[len("tube "):]: o for o in bpy.data.objects if o.type == "EMPTY" and "hf_id" in o}


def seen_at(empty):
    """How far an empty is from the middle of its region as it is shown."""
    bpy.context.view_layer.update()
    middle = body.matrix_world @ Vector(shown()[list(empty["hf_vertices"])].mean(0).tolist())
    return (empty.matrix_world.translation - middle).length


def held():
    return session.session_of(body, bind=False)


rig = rig_tube(body, np.clip(z - 1.5, 0, 1))
bend(90)
posed = shown()
assert posed[-AROUND:, 1].mean() < -1.9  # the upper half lies along -y

# ---- bound in a pose of the armature: the empties stand where the regions are seen, and nothing moves
active(body)
assert bpy.ops.hf.add_groups() == {"FINISHED"}
np.testing.assert_allclose(shown(), posed, atol=1e-5)
np.testing.assert_allclose(mesh_data.positions_of(body.data), points, atol=1e-6)
low, middle, high = (empties()[name] for name in ("low", "middle", "high"))
assert seen_at(low) < 1e-5 and seen_at(high) < 1e-5 and seen_at(middle) < 0.05, [seen_at(o) for o in (low, middle, high)]
assert panels.next_step(body, held()) == "Move or turn a handle: the mesh follows."
assert "rig moves the handles too" in armatures.sentence_on(body)
active(rig)
assert operators.mesh_of(bpy.context) == body  # the panel is that of the mesh while its bones are posed
active(body)

# ---- the pose of the armature takes them along, and solves nothing anew
solve, solved = held().pose.deform, []
held().pose.deform = lambda *arguments, **options: (solved.append(1), solve(*arguments, **options))
bend(30)
assert not solved
held().pose.deform = solve
np.testing.assert_allclose(mesh_data.positions_of(body.data), points, atol=1e-6)
assert seen_at(high) < 1e-5 and np.linalg.norm(np.array(high.matrix_world.translation) - points[-AROUND:].mean(0)) > 0.5

# ---- a handle that is moved in the pose: the region is where its empty is, in this pose of the armature and in others
bend(90)
here = high.matrix_world.copy()
wanted = Matrix.Translation((0.6, 0, 0.3)) @ here
high.matrix_basis = armatures.bone_motion(armatures.carried(high)).inverted() @ wanted  # as Blender's G does it
assert np.abs(np.array(high.matrix_world.translation) - np.array(here.translation)).max() < 1e-5  # not yet evaluated
bpy.context.view_layer.update()
np.testing.assert_allclose(np.array(high.matrix_world.translation), np.array(here.translation) + (0.6, 0, 0.3), atol=1e-5)
for _ in range(40):
    bpy.ops.hf.update()
assert seen_at(high) < 1e-4 and seen_at(low) < 1e-5
still = mesh_data.positions_of(body.data)
assert np.abs(still - points).max() > 0.5 and high.get(carriers.FREE)  # a drag: the rotation is found
region = list(high["hf_vertices"])
for degrees in (0, 40, 90):
    bend(degrees)
    assert seen_at(high) < 1e-4, (degrees, seen_at(high))
    np.testing.assert_allclose(mesh_data.positions_of(body.data), still, atol=2e-4)  # the armature alone changes no handle

# ---- the object that holds both moves: the handles go along, and the mesh does not change
rig.location.x = body.location.x = 5
bpy.context.view_layer.update()
np.testing.assert_allclose(mesh_data.positions_of(body.data), still, atol=2e-4)
assert seen_at(high) < 1e-4 and high.matrix_world.translation.x > 4
rig.location.x = body.location.x = 0
bpy.context.view_layer.update()

# ---- an action of the armature plays under the handles
for frame, degrees in ((1, 0), (10, 90)):
    bend(degrees)
    rig.pose.bones["upper"].keyframe_insert("rotation_quaternion", frame=frame)
for frame in (1, 5, 10):
    bpy.context.scene.frame_set(frame)
    assert seen_at(high) < 1e-4, frame
    np.testing.assert_allclose(mesh_data.positions_of(body.data), still, atol=2e-4)

# ---- an empty with a constraint of the user's own: it stands where that puts it, and the region is there
target = bpy.data.objects.new("target", None)
target.location = (0.5, -1.2, 2.9)
bpy.context.scene.collection.objects.link(target)
track = high.constraints.new("COPY_LOCATION")
track.target = target
bpy.context.view_layer.update()
for _ in range(3):
    bpy.ops.hf.update()
assert np.linalg.norm(shown()[region].mean(0) - np.array(target.location)) < 1e-3
target.location.z += 0.3
bpy.context.view_layer.update()
assert np.linalg.norm(shown()[region].mean(0) - np.array(target.location)) < 1e-3
high.constraints.remove(track)
bpy.data.objects.remove(target)
bpy.context.view_layer.update()

# ---- weights are computed from the rest shape, whatever the handles did to the mesh
def weights_now():
    active(body)
    rig.select_set(True)
    assert bpy.ops.hf.weights_from_bones() == {"FINISHED"}
    return mesh_data.weights_of(body)[:, [body.vertex_groups[name].index for name in ("lower", "upper")]]
bpy.context.view_layer.update()
in_pose, data = weights_now(), body.data
body.data = data.copy()
mesh_data.forget_pose(body.data)
body.data.vertices.foreach_set("co", points.ravel())
np.testing.assert_allclose(weights_now(), in_pose, atol=1e-5)
bare, body.data = body.data, data
bpy.data.meshes.remove(bare)
weigh_tube(body, np.clip(z - 1.5, 0, 1))
bpy.context.view_layer.update()

# ---- a file that is opened again, in the pose
path = os.path.join(os.path.dirname(os.environ["HF_ADDON_ZIP"]), "armature.blend")
bpy.ops.wm.save_as_mainfile(filepath=path)
before = shown()
bpy.ops.wm.open_mainfile(filepath=path)
body, rig = bpy.data.objects["tube"], bpy.data.objects["rig"]
high = empties()["high"]
np.testing.assert_allclose(shown(), before, atol=1e-4)
high.location.x += 0.2
bpy.context.view_layer.update()
assert held() and seen_at(high) < 1e-4 and np.abs(shown() - before).max() > 0.15

# ---- an edit of the mesh in the pose keeps them
active(body)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.mesh.subdivide()
bpy.ops.object.mode_set(mode="OBJECT")
bpy.context.view_layer.update()
assert len(held().rest) > 3 * len(points) and seen_at(high) < 0.05

# ---- the modifier goes: the empties stand by themselves at the region, which keeps what the handles did
body.modifiers.clear()
bpy.ops.hf.update()
assert not armatures.carried(high) and high.parent is None and seen_at(high) < 0.05
assert not armatures.sentence_on(body)
bpy.ops.hf.unbind()

# ---- an armature that comes later takes the handles along from then on; proposals that wait go on waiting
bpy.data.objects.remove(body)
bpy.data.objects.remove(rig)
body = tube()
body.location.x = 2
bpy.context.view_layer.update()
active(body)
assert bpy.ops.hf.propose() == {"FINISHED"}
waiting = {o.name for o in carriers.offered(body["hf_key"])}
assert waiting
rig = rig_tube(body, np.clip(z - 1.5, 0, 1))
rig.location.x = 2
active(body)
bpy.context.view_layer.update()
assert bpy.ops.hf.update() == {"FINISHED"}
bend(90)
assert {o.name for o in carriers.offered(body["hf_key"])} == waiting
for empty in empties().values():
    assert armatures.carried(empty) and seen_at(empty) < 0.1, (empty.name, seen_at(empty))
rig.location.x = body.location.x = 3
bpy.context.view_layer.update()
assert {o.name for o in carriers.offered(body["hf_key"])} == waiting
np.testing.assert_allclose(mesh_data.positions_of(body.data), points, atol=1e-6)

# ---- a copy of mesh, armature and empties has handles that its own armature moves; an empty that is copied alone is none
bpy.ops.object.select_all(action="SELECT")
bpy.context.view_layer.objects.active = body
there = set(bpy.data.objects)
bpy.ops.object.duplicate()
bpy.context.view_layer.update()
made = set(bpy.data.objects) - there
twin, twin_rig = next(o for o in made if o.type == "MESH"), next(o for o in made if o.type == "ARMATURE")
own = [o for o in made if o.type == "EMPTY"]
assert twin["hf_key"] != body["hf_key"] and {o["hf_key"] for o in own} == {twin["hf_key"]}
assert all(o.parent == twin and armatures.carried(o).targets[0].target == twin_rig for o in own)
some = next(o for o in empties().values() if o["hf_key"] == body["hf_key"])
active(some)
bpy.ops.object.duplicate()
bpy.context.view_layer.update()
alone = bpy.context.active_object
assert "hf_id" not in alone and not alone.constraints and alone.parent is None
np.testing.assert_allclose(np.array(alone.matrix_world.translation), np.array(some.matrix_world.translation), atol=1e-5)

# ---- an armature of Weights and armature holds what the handles did: they stay where they are
bpy.data.objects.remove(twin_rig)
for obj in (body, twin, rig, *list(empties().values())):
    bpy.data.objects.remove(obj)
bpy.context.scene.hf_live = True
body = tube()
active(body)
assert bpy.ops.hf.add_groups() == {"FINISHED"}
empties()["high"].location.x += 0.5
bpy.context.view_layer.update()
assert bpy.ops.hf.weights() == {"FINISHED"}
place = empties()["high"].matrix_world.copy()
assert bpy.ops.hf.update() == {"FINISHED"}
bpy.context.view_layer.update()
assert not armatures.carried(empties()["high"]) and empties()["high"].matrix_world == place

# ---- objects with a scale, a mirror image, an armature in centimetres: binding moves nothing, and a handle goes where it is put
for scale, with_rig in (((2, 2, 2), False), ((1, 2, 0.5), False), ((1, 1, -1), False), ((0.01, 0.01, 0.01), True), ((-3, 3, 3), True)):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    body = tube()
    body.scale, body.rotation_euler, body.location = scale, (0.3, 0.2, 0.1), (1, 2, 3)
    bpy.context.view_layer.update()
    if with_rig:
        rig = rig_tube(body, np.clip(z - 1.5, 0, 1))
        rig.matrix_world = body.matrix_world
        bend(60)
    active(body)
    assert bpy.ops.hf.add_groups() == {"FINISHED"}
    np.testing.assert_allclose(mesh_data.positions_of(body.data), points, atol=1e-4)  # single precision, 3 m away
    high = empties()["high"]
    size = np.mean(np.abs(scale))
    assert seen_at(high) < 1e-4 * size, (scale, seen_at(high))
    before = high.matrix_world.translation.copy()
    high.location += Vector((0.3, 0.2, -0.1)) * size
    bpy.context.view_layer.update()
    for _ in range(20):
        bpy.ops.hf.update()
    assert seen_at(high) < 1e-3 * size and (high.matrix_world.translation - before).length > 0.3 * size, (scale, seen_at(high))

blender_addon.disable()
print("blender armature: all right")
