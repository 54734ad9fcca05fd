"""A pose or a motion as an armature: vertex groups and one bone per cluster, standing or moving as the mesh does."""

import bpy
import numpy as np

import hf

from .mesh_data import faces_of, group_vertices, positions_of, rest_of
from .session import make_surface, session_of


def write_skin(obj, skin, name):
    """A skin as an armature of loose bones and vertex groups; the bones stand at the pivots."""
    armature = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    (obj.users_collection or (bpy.context.scene.collection,))[0].objects.link(armature)
    armature.matrix_world = obj.matrix_world
    view, active = bpy.context.view_layer, bpy.context.view_layer.objects.active
    view.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    size = 0.03 * float(np.linalg.norm(np.ptp(rest_of(obj.data), axis=0)))
    names = [f"hf{j:03d}" for j in range(len(skin.pivots))]
    for bone_name, pivot in zip(names, skin.pivots):
        bone = armature.data.edit_bones.new(bone_name)
        bone.head, bone.tail, bone.roll = pivot, pivot + np.array([0.0, size, 0.0]), 0.0  # rest axes are the armature's
    bpy.ops.object.mode_set(mode="OBJECT")
    view.objects.active = active
    for group in [g for g in obj.vertex_groups if g.name in names]:
        obj.vertex_groups.remove(group)
    groups = [obj.vertex_groups.new(name=n) for n in names]
    for vertex, (joints, weights) in enumerate(zip(skin.joints, skin.weights)):
        for joint, weight in zip(joints, weights):
            if weight > 0:
                groups[joint].add([vertex], float(weight), "REPLACE")
    modifier = obj.modifiers.new(name, "ARMATURE")
    modifier.object = armature
    obj.data.vertices.foreach_set("co", rest_of(obj.data).ravel())
    obj.data.update()
    return armature


def pose_bones(armature, skin, frame=None):
    for j, bone in enumerate(armature.pose.bones):
        x, y, z, w = skin.rotations[j]
        bone.rotation_mode = "QUATERNION"
        turn = [w, x, y, z]
        if np.dot(turn, bone.rotation_quaternion) < 0:  # the same turn on the near side, for interpolation
            turn = [-c for c in turn]
        bone.rotation_quaternion, bone.location = turn, skin.translations[j] - skin.pivots[j]
        if frame is not None:
            bone.keyframe_insert("rotation_quaternion", frame=frame)
            bone.keyframe_insert("location", frame=frame)


def transfer_animation(source, target, frames, prefix="hf ", window_manager=None, scale=0.0):
    """The motion of one mesh (however it is animated) played on another through pairs of equally named vertex groups.
    Returns the armature that carries it."""
    names = [g.name for g in source.vertex_groups if g.name.startswith(prefix) and target.vertex_groups.get(g.name)]
    if len(names) < 2:
        raise hf.InvalidArgumentError(f"{source.name} and {target.name} need two vertex groups or more of the same names, "
                                      f"starting with '{prefix}'")
    rest, source_rest = session_of(target).rest, rest_of(source.data)
    with make_surface(source_rest, faces_of(source.data), window_manager) as source_surface:
        with hf.Transfer(source_surface, session_of(target).surface, scale=scale) as transfer:
            transfer.add_pairs([group_vertices(source, n) for n in names], [group_vertices(target, n) for n in names])
            armature, scene = None, bpy.context.scene
            now = scene.frame_current
            if window_manager:
                window_manager.progress_begin(0, len(frames))
            for count, frame in enumerate(frames):
                scene.frame_set(frame)
                evaluated = source.evaluated_get(bpy.context.evaluated_depsgraph_get())
                mesh = evaluated.to_mesh()
                if len(mesh.vertices) != len(source.data.vertices):
                    raise hf.InvalidArgumentError(f"the modifiers of {source.name} change its number of vertices")
                transfer.apply(positions_of(mesh), np.empty_like(rest))
                evaluated.to_mesh_clear()
                skin = transfer.skin(4)
                armature = armature or write_skin(target, skin, f"{target.name} motion")
                pose_bones(armature, skin, frame)
                if window_manager:
                    window_manager.progress_update(count)
            if window_manager:
                window_manager.progress_end()
            scene.frame_set(now)
    return armature
