"""Compares the weights of hf_weights with Blender's automatic weights, in one run and by one measure.

usage: blender -b --factory-startup --python blender_weights.py -- HF_WEIGHTS MODEL.glb ...
Every model is imported with its weights. Joints that carry nothing do not deform. Blender computes its weights on the
mesh merged by distance; copies of a vertex take those of the nearest merged one. hf computes on the file as stored.
Distances from the pose of the file's weights are in per cent of the box, mean and 95 %, over all clips. Models without a
clip swing every joint. Blender is run as a program; nothing of it is used in hf.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

import bmesh
import bpy
import numpy as np
from mathutils import Quaternion, Vector
from mathutils.kdtree import KDTree

# Blender 3.4 reads glTF with a name that newer numpy has dropped.
if not hasattr(np, "bool"):
    np.bool = bool

POSES = 40  # at least, over all clips of a model
MERGE = 1e-5  # of the box: copies at seams agree to rounding


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path), bone_heuristic="BLENDER")
    rig = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    meshes = [o for o in bpy.data.objects if o.type == "MESH" and any(m.type == "ARMATURE" for m in o.modifiers)]
    return rig, sorted(meshes, key=lambda o: o.name)


def weights_of(mesh, names):
    out = np.zeros((len(mesh.data.vertices), len(names)))
    column = [names.get(g.name, -1) for g in mesh.vertex_groups]
    for v in mesh.data.vertices:
        for g in v.groups:
            if column[g.group] >= 0:
                out[v.index, column[g.group]] += g.weight
    return out


def points_of(mesh, rig):
    to_rig = rig.matrix_world.inverted() @ mesh.matrix_world
    return np.array([to_rig @ v.co for v in mesh.data.vertices])


def poses_of(rig):
    bones = list(rig.pose.bones)
    rest = [np.array(b.bone.matrix_local.inverted()) for b in bones]

    def now():
        bpy.context.view_layer.update()
        return np.array([np.array(b.matrix) @ r for b, r in zip(bones, rest)])

    if rig.animation_data:
        for track in rig.animation_data.nla_tracks:
            track.mute = True
    actions = [a for a in bpy.data.actions if any(c.data_path.startswith("pose.bones") for c in a.fcurves)]
    for action in actions:
        rig.animation_data_create().action = action
        first, last = action.frame_range
        each = math.ceil(POSES / len(actions))
        for i in range(each):
            at = first + (last - first) * i / each
            bpy.context.scene.frame_set(int(at), subframe=at - int(at))
            yield now()
    for i in range(0 if actions else POSES):
        for j, bone in enumerate(bones):
            phase, turn = 2.399963 * j, 0.157 * (i + 1)
            axis = Vector((math.sin(3 * phase) + 0.1, math.cos(5 * phase), math.sin(7 * phase + 1)))
            bone.rotation_mode = "QUATERNION"
            bone.rotation_quaternion = Quaternion(axis, 0.5 * math.sin(turn + phase))
        yield now()


def blender_weights(rig, mesh, names, box):
    """Automatic weights on a merged copy, by vertex of the mesh, and the merged vertices that have none."""
    copy = mesh.copy()
    copy.data = mesh.data.copy()
    bpy.context.collection.objects.link(copy)
    copy.vertex_groups.clear()
    copy.modifiers.clear()
    b = bmesh.new()
    b.from_mesh(copy.data)
    bmesh.ops.remove_doubles(b, verts=b.verts, dist=MERGE * box)
    b.to_mesh(copy.data)
    b.free()
    bpy.ops.object.select_all(action="DESELECT")
    copy.select_set(True)
    rig.select_set(True)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    found = weights_of(copy, names)
    tree = KDTree(len(copy.data.vertices))
    for v in copy.data.vertices:
        tree.insert(v.co, v.index)
    tree.balance()
    near = [tree.find(v.co)[1] for v in mesh.data.vertices]
    bare = int((found.sum(1) <= 0).sum())
    bpy.data.objects.remove(copy)
    return found[near], bare


def measure(points, given, own, poses):
    def posed(weights, m):
        sums = weights.sum(1, keepdims=True)
        w = np.where(sums > 0, weights / np.where(sums > 0, sums, 1), 0)
        b = (w @ m[:, :3, :].reshape(len(m), 12)).reshape(-1, 3, 4)
        out = np.einsum("vij,vj->vi", b[:, :, :3], points) + b[:, :, 3]
        return np.where(sums > 0, out, points)

    unit = 100 / np.linalg.norm(points.max(0) - points.min(0))
    d = np.array([unit * np.linalg.norm(posed(given, m) - posed(own, m), axis=1) for m in poses])
    return d.mean(), np.quantile(d, 0.95)


def compare(program, path):
    rig, meshes = load(path)
    names = {b.name: i for i, b in enumerate(rig.data.bones)}
    points = np.concatenate([points_of(m, rig) for m in meshes])
    given = np.concatenate([weights_of(m, names) for m in meshes])
    box = float(np.linalg.norm(points.max(0) - points.min(0)))
    used = given.sum(0) > 0
    for bone in rig.data.bones:
        bone.use_deform = bool(used[names[bone.name]])
    poses = list(poses_of(rig))
    for bone in rig.pose.bones:
        bone.matrix_basis.identity()
    rig.data.pose_position = "REST"
    if rig.animation_data:
        rig.animation_data.action = None
    bpy.context.view_layer.update()
    made = [blender_weights(rig, m, names, box * 3**0.5 / m.matrix_world.to_scale().length) for m in meshes]
    theirs, bare = np.concatenate([w for w, _ in made]), sum(b for _, b in made)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.glb"
        subprocess.run([program, str(path), "-o", str(out)], check=True, stdout=subprocess.DEVNULL)
        rig, again = load(out)
        numbers = {b.name: i for i, b in enumerate(rig.data.bones)}  # a joint without a name gets another one
        ours = np.concatenate([weights_of(m, numbers) for m in again])
    return measure(points, given, ours, poses), measure(points, given, theirs, poses), bare, int((ours.sum(1) <= 0).sum())


def main():
    program, *models = sys.argv[sys.argv.index("--") + 1 :]
    print("| model | hf mean | hf 95 % | Blender mean | Blender 95 % | 95 %, hf over Blender | bare: hf, Blender |")
    print("|---|---|---|---|---|---|---|")
    failed = 0
    for model in models:
        try:
            ours, theirs, bare, own_bare = compare(program, model)
        except Exception as error:  # one model that cannot be read does not hide the others
            print(f"failed: {pathlib.Path(model).stem}: {error}", flush=True)
            failed += 1
            continue
        failed += own_bare > 0
        print(
            f"| {pathlib.Path(model).stem} | {ours[0]:.3f} | {ours[1]:.3f} | {theirs[0]:.3f} | {theirs[1]:.3f} | "
            f"{ours[1] / max(theirs[1], 1e-9):.2f} | {own_bare}, {bare} |",
            flush=True,
        )
    sys.exit(1 if failed else 0)


main()
