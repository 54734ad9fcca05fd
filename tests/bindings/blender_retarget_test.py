"""An armature that follows another live, in Blender without a display, held against the plain arrays of the library."""

import math
import os
import sys

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
import hf  # noqa: E402  (the package inside the add-on)

retarget, panels = blender_addon.modules("retarget", "panels")
for leftover in list(bpy.data.objects):
    bpy.data.objects.remove(leftover)

PLACES = {"hips": (0, 0, 1.0), "spine": (0, 0, 1.3), "head": (0, 0, 1.7), "left_thigh": (0.1, 0, 0.95), "left_shin": (0.1, -0.02, 0.5),
    "left_foot": (0.1, 0, 0.08), "right_thigh": (-0.1, 0, 0.95), "right_shin": (-0.1, -0.02, 0.5), "right_foot": (-0.1, 0, 0.08)}
PARENTS = {"spine": "hips", "head": "spine", "left_thigh": "hips", "left_shin": "left_thigh", "left_foot": "left_shin",
    "right_thigh": "hips", "right_shin": "right_thigh", "right_foot": "right_shin"}


def armature(name, size, tail):
    """A body of bones that all point along `tail` at rest: another convention, the same body."""
    made = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name, place in PLACES.items():
        bone = made.data.edit_bones.new(bone_name)
        bone.head, bone.tail = size * Vector(place), size * Vector(place) + 0.1 * size * Vector(tail)
        if bone_name in PARENTS:
            bone.parent = made.data.edit_bones[PARENTS[bone_name]]
    bpy.ops.object.mode_set(mode="OBJECT")
    return made


def numbers(matrix):
    place, turn, scale = Matrix(matrix.tolist()).decompose()
    return [*place, turn.x, turn.y, turn.z, turn.w, *scale]


def pose_of(obj, rest=False):
    """Transforms from the parent as the library wants them, by another way than the add-on's."""
    world = {b.name: np.array(b.bone.matrix_local if rest else b.matrix) for b in obj.pose.bones}
    return np.array([numbers(np.linalg.inv(world[b.parent.name]) @ world[b.name] if b.parent else world[b.name])
        for b in (obj.pose.bones[bone.name] for bone in obj.data.bones)], np.float32)


def selected(source, target):
    bpy.ops.object.select_all(action="DESELECT")
    for obj in (source, target):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = target


def skeleton(obj, skin=None):
    names = [bone.name for bone in obj.data.bones]
    parents = [names.index(bone.parent.name) if bone.parent else hf.NO_INDEX for bone in obj.data.bones]
    return hf.Skeleton(names, parents, pose_of(obj, rest=True), skin=skin)


def far(a, b):
    """The largest difference of two poses; a quaternion and its negative are one rotation."""
    a, b = np.array(a), np.array(b)
    a[:, 3:7] *= np.sign((a[:, 3:7] * b[:, 3:7]).sum(1, keepdims=True))
    return np.abs(a - b).max()


man, robot = armature("man", 1.0, (0, 0, 1)), armature("robot", 2.0, (0, 1, 0))
robot.location, robot.rotation_euler = (5, 0, 0), (0, 0, 1)
robot.pose.bones["left_thigh"].rotation_mode = "XYZ"
# a mesh that the armature of the robot moves, a box for each bone, tells where its soles are
SIDES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
corners = [2 * Vector(place) + 0.15 * Vector((x, y, z)) for place in PLACES.values() for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
mesh = bpy.data.meshes.new("boxes")
mesh.from_pydata(corners, [], [[8 * box + v for v in side] for box in range(len(PLACES)) for side in SIDES])
shoe = bpy.data.objects.new("boxes", mesh)
bpy.context.scene.collection.objects.link(shoe)
for box, name in enumerate(PLACES):
    shoe.vertex_groups.new(name=name).add(range(8 * box, 8 * box + 8), 1.0, "REPLACE")
shoe.modifiers.new("robot", "ARMATURE").object = robot
bpy.context.view_layer.update()
shoe.matrix_world = robot.matrix_world

thigh, hips = man.pose.bones["left_thigh"], man.pose.bones["hips"]
thigh.rotation_mode = "QUATERNION"
for frame, degrees, forward in ((1, 0, 0.0), (10, 50, 0.4), (20, -20, 0.9)):
    thigh.rotation_quaternion = Quaternion((1, 0, 0), math.radians(degrees))
    thigh.keyframe_insert("rotation_quaternion", frame=frame)
    hips.location = (0, 0, forward)
    hips.keyframe_insert("location", frame=frame)

# ---- what users get wrong is a sentence, and nothing has changed
def fails(text, **arguments):
    try:
        bpy.ops.hf.retarget(**arguments)
    except RuntimeError as error:
        assert text in str(error), error
        return
    raise AssertionError(f"it did not fail with: {text}")


selected(robot, robot)
fails("select the armature that moves")
selected(shoe, robot)
fails("select the armature that moves")
rock = bpy.data.objects.new("rock", bpy.data.armatures.new("rock"))
bpy.context.scene.collection.objects.link(rock)
selected(rock, robot)
fails("")
assert robot.hf_source is None and not retarget.players
bpy.data.objects.remove(rock)

# ---- every frame is what the library makes of the plain arrays, and the next frame follows
bpy.context.scene.frame_set(1)
selected(man, robot)
assert panels.next_step(robot, None).startswith("Select the armature that moves")
assert panels.HF_PT_retarget.poll(bpy.context)
assert bpy.ops.hf.retarget() == {"FINISHED"} and robot.hf_source == man
order = [[b.name for b in robot.data.bones].index(name) for name in PLACES]
soles = {"positions": np.array(corners, np.float32), "triangles": [list(p.vertices) for p in mesh.polygons],
    "joints": np.repeat(order, 8).reshape(-1, 1), "weights": np.ones((len(corners), 1), np.float32)}
with skeleton(man) as first, skeleton(robot, soles) as second:
    plain = hf.Retarget(first, second)
    bare = hf.Retarget(first, skeleton(robot))
assert plain.info.matched_joint_count == len(PLACES), plain.info.matched_joint_count
second_long = bpy.context.scene.render.fps_base / bpy.context.scene.render.fps
plain.solve(pose_of(man), 0.0)  # of the operator
seen = {}
for frame in range(1, 21):
    bpy.context.scene.frame_set(frame)
    wanted = plain.solve(pose_of(man), second_long if frame > 1 else 0.0)
    seen[frame] = pose_of(robot)
    assert far(wanted, seen[frame]) < 1e-5, (frame, far(wanted, seen[frame]))
assert far(seen[1], pose_of(robot, rest=True)) < 0.01, far(seen[1], pose_of(robot, rest=True))
hips_went = np.linalg.norm(seen[20][0, :3] - seen[1][0, :3])
assert hips_went > 1.5 * 0.9, hips_went  # of twice the size
knee = np.array(robot.pose.bones["left_shin"].matrix)[:3, 3] - np.array(robot.pose.bones["left_thigh"].matrix)[:3, 3]
knee_of_man = np.array(man.pose.bones["left_shin"].matrix)[:3, 3] - np.array(man.pose.bones["left_thigh"].matrix)[:3, 3]
assert np.dot(knee, knee_of_man) / np.linalg.norm(knee) / np.linalg.norm(knee_of_man) > 0.95, (knee, knee_of_man)
assert far(bare.solve(pose_of(man), 0.0), seen[20]) > 1e-3, "the mesh tells nothing"

assert panels.next_step(robot, None) == "robot follows man: play any clip."

# ---- a clip that jumps back has forgotten its planted feet: the frame is that of a fresh player
bpy.context.scene.frame_set(10)
plain.reset()
assert far(plain.solve(pose_of(man), 0.0), pose_of(robot)) < 1e-5

# ---- a mesh whose handles are bones of the target follows them in the same frame
def shown():
    return np.array([v.co[:] for v in body.data.vertices])


made = bpy.data.meshes.new("body")
made.from_pydata([(x, y, 0.1 * z) for z in range(41) for x, y in ((0.3, 0.3), (-0.3, 0.3), (-0.3, -0.3), (0.3, -0.3))], [],
    [(4 * z + k, 4 * z + (k + 1) % 4, 4 * z + 4 + (k + 1) % 4, 4 * z + 4 + k) for z in range(40) for k in range(4)])
body = bpy.data.objects.new("body", made)
bpy.context.scene.collection.objects.link(body)
body.matrix_world = robot.matrix_world
for name, first in (("left_foot", 0), ("hips", 76), ("head", 140)):
    body.vertex_groups.new(name=name).add(range(first, first + 12), 1.0, "REPLACE")
selected(robot, body)
bpy.context.scene.frame_set(1)
assert bpy.ops.hf.add_bones() == {"FINISHED"}
rest = shown()
bpy.context.scene.frame_set(20)
seen_at_once = shown()
bpy.ops.hf.update()
went, late = np.abs(seen_at_once - rest).max(), np.abs(shown() - seen_at_once).max()
assert went > 0.5 and late < 0.05 * went, (went, late)
assert bpy.ops.hf.unbind() == {"FINISHED"}
bpy.data.objects.remove(body)

# ---- the bones name the handles that are proposed on the mesh they move; feet hold, and a foot is the whole box
bpy.context.view_layer.objects.active = shoe
for obj in bpy.data.objects:
    obj.select_set(obj == shoe)
assert bpy.ops.hf.propose() == {"FINISHED"}
offered = {o.name[len("boxes "):]: o for o in bpy.data.objects if o.type == "EMPTY" and o.get("hf_key") == shoe["hf_key"]}
assert {"left_foot", "right_foot", "head"} <= set(offered), list(offered)
for name in ("left_foot", "right_foot", "head"):
    first = 8 * list(PLACES).index(name)
    assert list(offered[name]["hf_vertices"]) == list(range(first, first + 8)), (name, list(offered[name]["hf_vertices"]))
    assert (offered[name].empty_display_type == "CUBE") == name.endswith("foot")
assert bpy.ops.hf.unbind() == {"FINISHED"}

# ---- another bone in the target pairs again; a cleared source leaves the bones as they stand; a saved file goes on
kept = retarget.players["robot"]
bpy.context.view_layer.objects.active = robot
bpy.ops.object.mode_set(mode="EDIT")
hat = robot.data.edit_bones.new("hat")
hat.head, hat.tail, hat.parent = (0, 0, 3.8), (0, 0, 4.0), robot.data.edit_bones["head"]
bpy.ops.object.mode_set(mode="OBJECT")
bpy.context.scene.frame_set(11)
assert retarget.players["robot"] is not kept
path = os.path.join(os.path.dirname(os.environ["HF_ADDON_ZIP"]), "follows.blend")
bpy.ops.wm.save_as_mainfile(filepath=path)
bpy.ops.wm.open_mainfile(filepath=path)
assert not retarget.players
robot, man = bpy.data.objects["robot"], bpy.data.objects["man"]
bpy.context.scene.frame_set(12)
assert "robot" in retarget.players and robot.hf_source == man
robot.hf_source = None
stood = pose_of(robot)
bpy.context.scene.frame_set(18)
assert far(stood, pose_of(robot)) == 0
blender_addon.disable()
print("blender retarget: all right")
