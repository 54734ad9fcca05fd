"""Compares the weights of hf_weights with Blender's automatic weights, in one run and by one measure.

usage: blender -b --factory-startup --python blender_weights.py -- HF_WEIGHTS MODEL.glb ...
Every model is imported with its weights. Joints that carry nothing do not deform. Blender computes its weights on one
mesh of all objects, merged by distance; copies of a vertex take those of the nearest merged one. hf computes on the file as stored.
Distances from the pose of the file's weights are in per cent of the box, mean and 95 %, over all clips. Models without a
clip swing every joint. Blender is run as a program; nothing of it is used in hf.
"""

import json
import math
import pathlib
import struct
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
# Blender takes whole frames of its own rate, so the two programs sample clips at other times. Over 28 models, the 95 %
# distances of the same weights differ by up to this share.
POSES_AGREE = 0.4


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


def still_basis(path):
    """The pose of the file's nodes, by bone. Blender evaluates the last clip when it has read them, so the file is read
    without its clips."""
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    root = json.loads(data[20 : 20 + size])
    root.pop("animations", None)
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text + data[20 + size :]
    with tempfile.TemporaryDirectory() as folder:
        still = pathlib.Path(folder) / "still.glb"
        still.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body)
        rig, _ = load(still)
    return {b.name: (b.location.copy(), b.rotation_quaternion.copy(), b.scale.copy()) for b in rig.pose.bones}


def poses_of(rig, still):
    bones = list(rig.pose.bones)
    rest = [np.array(b.bone.matrix_local.inverted()) for b in bones]

    def reset():
        # A clip says nothing of joints without keys: they stand as the nodes do, not as the clip before left them.
        for bone in bones:
            bone.rotation_mode = "QUATERNION"
            bone.location, bone.rotation_quaternion, bone.scale = still[bone.name]

    def now():
        bpy.context.view_layer.update()
        return np.array([np.array(b.matrix) @ r for b, r in zip(bones, rest)])

    if rig.animation_data:
        for track in rig.animation_data.nla_tracks:
            track.mute = True
    actions = [a for a in bpy.data.actions if any(c.data_path.startswith("pose.bones") for c in a.fcurves)]
    for action in actions:
        rig.animation_data_create().action = None
        reset()
        rig.animation_data.action = action
        first, last = action.frame_range
        each = math.ceil(POSES / len(actions))
        for i in range(each):
            at = first + (last - first) * i / each
            bpy.context.scene.frame_set(int(at), subframe=at - int(at))
            yield now()
    for i in range(0 if actions else POSES):
        reset()
        for j, bone in enumerate(bones):
            phase, turn = 2.399963 * j, 0.157 * (i + 1)
            axis = Vector((math.sin(3 * phase) + 0.1, math.cos(5 * phase), math.sin(7 * phase + 1)))
            bone.rotation_quaternion = bone.rotation_quaternion @ Quaternion(axis, 0.5 * math.sin(turn + phase))
        yield now()


def blender_weights(rig, meshes, points, names, box):
    """Automatic weights on one mesh of all, merged by distance: by vertex as given, and the merged ones without any."""
    faces, first = [], 0
    for mesh in meshes:
        faces += [[first + v for v in face.vertices] for face in mesh.data.polygons]
        first += len(mesh.data.vertices)
    data = bpy.data.meshes.new("merged")
    data.from_pydata([tuple(p) for p in points], [], faces)
    copy = bpy.data.objects.new("merged", data)
    copy.matrix_world = rig.matrix_world
    bpy.context.collection.objects.link(copy)
    b = bmesh.new()
    b.from_mesh(data)
    bmesh.ops.remove_doubles(b, verts=b.verts, dist=MERGE * box)
    b.to_mesh(data)
    b.free()
    bpy.context.view_layer.update()
    bpy.ops.object.select_all(action="DESELECT")
    copy.select_set(True)
    rig.select_set(True)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    found = weights_of(copy, names)
    tree = KDTree(len(data.vertices))
    for v in data.vertices:
        tree.insert(v.co, v.index)
    tree.balance()
    near = [tree.find(p)[1] for p in points]
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
    still = still_basis(pathlib.Path(path))
    rig, meshes = load(path)
    names = {b.name: i for i, b in enumerate(rig.data.bones)}
    points = np.concatenate([points_of(m, rig) for m in meshes])
    given = np.concatenate([weights_of(m, names) for m in meshes])
    box = float(np.linalg.norm(points.max(0) - points.min(0)))
    used = given.sum(0) > 0
    for bone in rig.data.bones:
        bone.use_deform = bool(used[names[bone.name]])
    clips = len(bpy.data.actions) > 0
    poses = list(poses_of(rig, still))
    for bone in rig.pose.bones:
        bone.matrix_basis.identity()
    rig.data.pose_position = "REST"
    if rig.animation_data:
        rig.animation_data.action = None
    bpy.context.view_layer.update()
    theirs, bare = blender_weights(rig, meshes, points, names, box)
    with tempfile.TemporaryDirectory() as folder:
        out, report = pathlib.Path(folder) / "out.glb", pathlib.Path(folder) / "report.json"
        subprocess.run([program, str(path), "-o", str(out), "--report", str(report)], check=True, stdout=subprocess.DEVNULL)
        alone = json.loads(report.read_text())["distance"]["high"]
        rig, again = load(out)
        numbers = {b.name: i for i, b in enumerate(rig.data.bones)}  # a joint without a name gets another one
        ours = np.concatenate([weights_of(m, numbers) for m in again])
    result = Result(*measure(points, given, ours, poses), *measure(points, given, theirs, poses))
    result.own_bare, result.bare = int((ours.sum(1) <= 0).sum()), bare
    # By hf_weights' own poses of the clips. Without a clip, the two programs swing the joints differently.
    result.poses_agree = not clips or abs(result.high - alone) <= POSES_AGREE * alone + 0.01
    return result


class Result:
    def __init__(self, mean, high, their_mean, their_high):
        self.mean, self.high, self.their_mean, self.their_high = mean, high, their_mean, their_high
        self.ratio = high / max(their_high, 1e-9)


def main():
    program, *models = sys.argv[sys.argv.index("--") + 1 :]
    print("| model | hf mean | hf 95 % | Blender mean | Blender 95 % | 95 %, hf over Blender | bare: hf, Blender |")
    print("|---|---|---|---|---|---|---|")
    failed, whole = 0, []
    for model in models:
        try:
            r = compare(program, model)
        except Exception as error:  # one model that cannot be read does not hide the others
            print(f"failed: {pathlib.Path(model).stem}: {error}", flush=True)
            failed += 1
            continue
        print(
            f"| {pathlib.Path(model).stem} | {r.mean:.3f} | {r.high:.3f} | {r.their_mean:.3f} | {r.their_high:.3f} | "
            f"{r.ratio:.2f} | {r.own_bare}, {r.bare} |",
            flush=True,
        )
        if r.own_bare:
            print(f"failed: {pathlib.Path(model).stem}: {r.own_bare} vertices without weights")
        if not r.poses_agree:
            print(f"failed: {pathlib.Path(model).stem}: hf's distance is another than by hf_weights' own poses")
        failed += r.own_bare > 0 or not r.poses_agree
        if r.bare == 0:
            whole.append(r)
    if whole:
        ratios = np.array([r.ratio for r in whole])
        print(
            f"Blender leaves {len(whole)} of {len(models)} models whole. On these, 95 % distances of hf over Blender's: mean "
            f"{ratios.mean():.2f}, median {np.median(ratios):.2f}, mean of logarithms {np.exp(np.log(ratios).mean()):.2f}, "
            f"worst {ratios.max():.2f}, above 1.5 on {(ratios > 1.5).sum()}; medians {np.median([r.high for r in whole]):.3f} "
            f"and {np.median([r.their_high for r in whole]):.3f}"
        )
    sys.exit(1 if failed else 0)


main()
