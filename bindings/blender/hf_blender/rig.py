"""A pose or a motion as an armature: vertex groups and one bone per cluster, standing or moving as the mesh does."""

import bpy
import numpy as np

import hf

from .mesh_data import faces_of, group_vertices, keep_pose, positions_of, rest_of, size_of
from .session import make_surface, session_of


def write_skin(obj, skin, name):
    """A skin as an armature of loose bones and vertex groups; the bones stand at the pivots."""
    armature = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    (obj.users_collection or (bpy.context.scene.collection,))[0].objects.link(armature)
    armature.matrix_world = obj.matrix_world
    view, active = bpy.context.view_layer, bpy.context.view_layer.objects.active
    view.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    size = 0.03 * size_of(obj.data)
    names = [f"hf{j:03d}" for j in range(len(skin.pivots))]
    for bone_name, pivot in zip(names, skin.pivots):
        bone = armature.data.edit_bones.new(bone_name)
        bone.head, bone.tail, bone.roll = pivot, pivot + np.array([0.0, size, 0.0]), 0.0  # rest axes are the armature's
    bpy.ops.object.mode_set(mode="OBJECT")
    view.objects.active = active
    for group in [g for g in obj.vertex_groups if g.name in names]:
        obj.vertex_groups.remove(group)
    groups = [obj.vertex_groups.new(name=n) for n in names]
    for vertex, (joints, weights) in enumerate(zip(skin.vertex_joints, skin.vertex_weights)):
        for joint, weight in zip(joints, weights):
            if weight > 0:
                groups[joint].add([vertex], float(weight), "REPLACE")
    modifier = obj.modifiers.new(name, "ARMATURE")
    modifier.object = armature
    rest = rest_of(obj.data)
    keep_pose(obj.data, rest, rest)
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


# Words of a group's name in square brackets say what a pair is: "hf hoof left [foot]", "hf rump [trunk anchor]".
KINDS = {"foot": hf.PairFlag.FOOT, "trunk": hf.PairFlag.TRUNK, "anchor": hf.PairFlag.ANCHOR, "contact": hf.PairFlag.CONTACT,
    "sinks": hf.PairFlag.SINKS, "neck": hf.PairFlag.NECK, "tail": hf.PairFlag.TAIL, "arm": hf.PairFlag.ARM}


def flags_of(name):
    inside = name[name.find("[") + 1:name.rfind("]")] if "[" in name and name.endswith("]") else ""
    unknown = [word for word in inside.split() if word not in KINDS]
    if unknown:
        raise hf.InvalidArgumentError(f"group '{name}': '{unknown[0]}' is none of {', '.join(KINDS)}")
    flags = hf.PairFlag.NONE
    for word in inside.split():
        flags |= KINDS[word]
    return int(flags)


class Motion:
    """A transfer with the source's frames, so that dials can be turned without a new preparation."""

    def __init__(self, source_surface, transfer):
        self.source_surface, self.transfer, self.armature = source_surface, transfer, None
        self.frames = []  # (number, positions of the source)
        self.flags = 0  # of all pairs

    def close(self):
        self.transfer.close()
        self.source_surface.close()

    def play(self, target, window_manager=None, **dials):
        """Keys the armature with the motion under these dials; makes it at the first call."""
        self.transfer.set_dials(**dials)
        if window_manager:
            window_manager.progress_begin(0, len(self.frames))
        out = np.empty_like(session_of(target).rest)
        for count, (frame, posed) in enumerate(self.frames):
            self.transfer.apply(posed, out)
            skin = self.transfer.skin(4)
            if self.armature is None:
                self.armature = write_skin(target, skin, f"{target.name} motion").name
            pose_bones(bpy.data.objects[self.armature], skin, frame)
            if window_manager:
                window_manager.progress_update(count)
        if window_manager:
            window_manager.progress_end()
        return bpy.data.objects[self.armature]


motions = {}  # by the name of the target

DIALLED = {"hip_height_share": "trunk", "neck_follow": "neck", "tail_follow": "tail", "arm_space": "arm"}  # the kind each turns


def idle_dials(target, **dials):
    """[(dial, kind)]: dials that are turned, but no pair of the last transfer to this mesh is of the kind they turn."""
    motion = motions.get(target.name)
    return [(dial, kind) for dial, kind in DIALLED.items()
        if motion and dials.get(dial) and not motion.flags & int(KINDS[kind])]


def forget_motions():
    for motion in motions.values():
        motion.close()
    motions.clear()


def turn_dials(target, window_manager=None, **dials):
    """Plays the last transfer to this mesh again, with other dials."""
    motion = motions.get(target.name)
    if motion is None or motion.armature not in bpy.data.objects:
        raise hf.InvalidArgumentError(f"transfer an animation to {target.name} first")
    return motion.play(target, window_manager, **dials)


def transfer_animation(source, target, frames, prefix="hf ", window_manager=None, scale=0.0, **dials):
    """The motion of one mesh (however it is animated) played on another through pairs of equally named vertex groups.
    Returns the armature that carries it."""
    names = [g.name for g in source.vertex_groups if g.name.startswith(prefix) and target.vertex_groups.get(g.name)]
    if len(names) < 2:
        raise hf.InvalidArgumentError(f"{source.name} and {target.name} need two vertex groups or more of the same names, "
                                      f"starting with '{prefix}'")
    flags = [flags_of(n) for n in names]
    source_surface = make_surface(rest_of(source.data), faces_of(source.data), window_manager)
    try:
        transfer = hf.Transfer(source_surface, session_of(target).surface, scale=scale)
    except hf.HfError:
        source_surface.close()
        raise
    motion = Motion(source_surface, transfer)
    try:
        transfer.add_pairs([group_vertices(source, n) for n in names], [group_vertices(target, n) for n in names], flags)
        for own in flags:
            motion.flags |= own
        scene = bpy.context.scene
        now = scene.frame_current
        for frame in frames:
            scene.frame_set(frame)
            evaluated = source.evaluated_get(bpy.context.evaluated_depsgraph_get())
            mesh = evaluated.to_mesh()
            if len(mesh.vertices) != len(source.data.vertices):
                raise hf.InvalidArgumentError(f"the modifiers of {source.name} change its number of vertices")
            motion.frames.append((frame, np.array(positions_of(mesh), np.float32)))
            evaluated.to_mesh_clear()
        armature = motion.play(target, window_manager, **dials)
        scene.frame_set(now)
    except Exception:
        motion.close()
        raise
    if target.name in motions:
        motions[target.name].close()
    motions[target.name] = motion
    return armature
