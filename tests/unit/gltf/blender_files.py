"""Models that Blender writes as .fbx, .dae and .bvh: what posed_points reads of them, beside what Blender reads of them.

blender -b --factory-startup --python blender_files.py -- POSED_POINTS FOLDER MODEL.glb...
Every vertex must lie by a vertex of the other within a part of the box: corners are split differently. Blender's z is up,
so x y z becomes x z -y. Its first frame of a clip is 1 in FBX and BVH and 0 in COLLADA.
"""

import builtins
import os
import subprocess
import sys

import bpy
import numpy as np
from mathutils.kdtree import KDTree

# The vertices differ by 5e-7 of the box, the rounding of floats.
TOLERANCE = 1e-5
CLIPS = 2  # of each model
if not hasattr(np, "bool"):
    np.bool = bool
plain_open = builtins.open  # the reader of .bvh in Blender 3.4 asks for a mode that Python 3.11 lacks
builtins.open = lambda file, mode="r", *rest, **named: plain_open(file, mode.replace("rU", "r"), *rest, **named)
program, folder, *models = sys.argv[sys.argv.index("--") + 1:]


def y_up(points):
    points = np.asarray(points, dtype=float)
    return np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1)


def vertices():
    graph = bpy.context.evaluated_depsgraph_get()
    parts = []
    for o in bpy.context.scene.objects:
        if o.type != "MESH":
            continue
        posed = o.evaluated_get(graph)
        mesh = posed.to_mesh()
        flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.vertices.foreach_get("co", flat)
        matrix = np.array(posed.matrix_world)
        parts.append(flat.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
        posed.to_mesh_clear()
    return y_up(np.concatenate(parts))


def heads():
    armature = next(o for o in bpy.context.scene.objects if o.type == "ARMATURE")
    return y_up([armature.matrix_world @ bone.head for bone in armature.pose.bones])


def furthest(points, others):
    tree = KDTree(len(others))
    for i, p in enumerate(others):
        tree.insert(p, i)
    tree.balance()
    return max(tree.find(p)[2] for p in points)


def ours(file, clip, times):
    said = subprocess.run([program, file, clip, ",".join(map(repr, times))], stdout=subprocess.PIPE, check=True, text=True).stdout
    return [np.array(line.split(), dtype=float).reshape(-1, 3) for line in said.splitlines()]


def compare(file, clip, times, show, points, both):
    worst = 0
    for time, mine in zip(times, ours(file, clip, times)):
        show(time)
        theirs = points()
        box = np.linalg.norm(theirs.max(axis=0) - theirs.min(axis=0))
        worst = max(worst, furthest(theirs, mine) / box, furthest(mine, theirs) / box if both else 0)
    print(f"read {os.path.basename(file)} {clip}: {len(times)} times, off by {worst:.1e} of the box", flush=True)
    assert worst < TOLERANCE, f"{file} {clip}"


def check(file, read, first_frame, clip_of, points, both=True):
    """Every action that Blender reads, at three of its frames; the rest pose, which COLLADA has
    not."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    read(filepath=file)
    scene = bpy.context.scene
    rate = scene.render.fps / scene.render.fps_base
    armature = next(o for o in scene.objects if o.type == "ARMATURE")

    def frame(number):
        scene.frame_set(number)
        bpy.context.view_layer.update()

    if first_frame == 1:
        armature.data.pose_position = "REST"
        compare(file, "-", [0.0], lambda time: frame(1), points, both)
        armature.data.pose_position = "POSE"
    for action in list(bpy.data.actions):
        if "|" in action.name and not action.name.startswith(armature.name + "|"):
            continue  # of another object
        armature.animation_data_create().action = action
        last = int(action.frame_range[1])
        frames = sorted({1, (1 + last) // 2, last - 1})
        compare(file, clip_of(action.name), [(f - first_frame) / rate for f in frames],
                lambda time: frame(round(time * rate) + first_frame), points, both)


for model in models:
    name = os.path.splitext(os.path.basename(model))[0]
    base = os.path.join(folder, name)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=model)
    for sphere in [o for o in bpy.data.objects if o.name.startswith("Icosphere")]:
        bpy.data.objects.remove(sphere)
    for action in list(bpy.data.actions)[CLIPS:]:
        bpy.data.actions.remove(action)
    # With all keys: between keys Blender's quaternions go along a straight line, ours along the arc.
    # a file of centimetres with y up, and one of metres with z up
    bpy.ops.export_scene.fbx(filepath=base + ".fbx", bake_anim_simplify_factor=0)
    bpy.ops.export_scene.fbx(filepath=base + "_z.fbx", axis_forward="-Y", axis_up="Z", apply_scale_options="FBX_SCALE_UNITS",
                             add_leaf_bones=False, bake_anim_use_all_actions=False, bake_anim_use_nla_strips=False,
                             bake_anim_simplify_factor=0)
    bpy.context.scene.frame_end = 20
    bpy.ops.wm.collada_export(filepath=base + ".dae")
    armature = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    bpy.context.view_layer.objects.active = armature
    bpy.ops.export_anim.bvh(filepath=base + ".bvh", frame_start=0, frame_end=20)
    has_loose_parts = any(o.type == "MESH" and not o.modifiers for o in bpy.data.objects)

    after_bar = lambda action: action.split("|", 1)[1]
    check(base + ".fbx", bpy.ops.import_scene.fbx, 1, after_bar, vertices)
    check(base + "_z.fbx", bpy.ops.import_scene.fbx, 1, after_bar, vertices)
    if not has_loose_parts:  # Blender loses the parents of those when it reads .dae
        check(base + ".dae", bpy.ops.wm.collada_import, 0, lambda action: "", vertices)
    check(base + ".bvh", bpy.ops.import_anim.bvh, 1, lambda action: "Motion", heads, both=False)

# Shape keys and a clip of them. Blender writes them where the object moves too.
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8)
sphere = bpy.context.object
sphere.shape_key_add(name="Basis")
for axis, factor in ((0, 2), (2, 3)):
    for vertex in sphere.shape_key_add(name=f"along {axis}").data:
        vertex.co[axis] *= factor
keys = sphere.data.shape_keys.key_blocks
for key, frame, value in ((1, 0, 0), (1, 20, 1), (2, 0, 0.5), (2, 10, 0), (2, 20, 1)):
    keys[key].value = value
    keys[key].keyframe_insert("value", frame=frame)
for frame in (0, 20):
    sphere.location.x = frame / 10
    sphere.keyframe_insert("location", frame=frame)
bpy.context.scene.frame_start, bpy.context.scene.frame_end = 0, 20
file = os.path.join(folder, "sphere.fbx")
bpy.ops.export_scene.fbx(filepath=file, bake_anim_use_all_actions=False, bake_anim_use_nla_strips=False, bake_anim_simplify_factor=0)
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.fbx(filepath=file)
rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
compare(file, "Scene", [f / rate for f in (0, 7, 14, 20)], lambda time: bpy.context.scene.frame_set(round(time * rate) + 1), vertices, True)
