"""Plays an armature on another, live: in every frame the bones of the target follow those of the source (hf/retarget.h).

Object.hf_source of the target names the source and is stored with the scene. A player is made at the first frame.
"""

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

import hf

from . import mesh_data, skinning

# Seconds. Frames that are farther apart count as a jump of the clip, and planted feet are forgotten. Playback shows more
# than one frame per second, and jumps in the timeline are mostly longer. Half would forget feet while a heavy scene plays
# at two frames per second. Double would drag planted feet over a short jump.
JUMP = 1.0

players = {}  # name of the target -> Player


def numbers_of(matrix):
    """Returns a transform as 10 numbers: translation, rotation x y z w, scale."""
    place, turn, scale = matrix.decompose()
    return (*place, turn.x, turn.y, turn.z, turn.w, *scale)


class Joints:
    """The bones of an armature, each with its rest from its parent."""

    def __init__(self, armature):
        bones = armature.data.bones
        self.names = [bone.name for bone in bones]
        number = {name: i for i, name in enumerate(self.names)}
        self.parents = [number[bone.parent.name] if bone.parent else -1 for bone in bones]
        rests = [bone.parent.matrix_local.inverted() @ bone.matrix_local if bone.parent else bone.matrix_local for bone in bones]
        self.to_rest = [rest.inverted() for rest in rests]
        self.pose = np.array([numbers_of(rest) for rest in rests], np.float32)

    def skeleton(self, armature):
        return hf.Skeleton(self.names, self.parents, self.pose, skin=skin_of(armature, self.names))

    def skeleton_in(self, obj, armature):
        """The skeleton at rest in the frame of a mesh that it moves, with that mesh as its skin."""
        to_mesh = obj.matrix_world.inverted() @ armature.matrix_world
        rest = self.pose.copy()
        for i, (bone, parent) in enumerate(zip(armature.data.bones, self.parents)):
            if parent < 0:
                rest[i] = numbers_of(to_mesh @ bone.matrix_local)
        obj.data.calc_loop_triangles()
        triangles = mesh_data.column(obj.data.loop_triangles, "vertices", 3).reshape(-1, 3)
        joints, weights = skinning.group_weights(obj, self.names)
        skin = {"positions": mesh_data.rest_of(obj.data), "triangles": triangles, "joints": joints, "weights": weights}
        return hf.Skeleton(self.names, self.parents, rest, skin=skin)

    def read(self, armature):
        """The pose of an evaluated armature."""
        bones = armature.pose.bones
        places = [bones[name].matrix for name in self.names]
        for i, (place, parent) in enumerate(zip(places, self.parents)):
            self.pose[i] = numbers_of(places[parent].inverted() @ place if parent >= 0 else place)
        return self.pose

    def write(self, armature, pose):
        bones = armature.pose.bones
        for name, to_rest, row in zip(self.names, self.to_rest, pose.tolist()):
            x, y, z, w = row[3:7]
            bones[name].matrix_basis = to_rest @ Matrix.LocRotScale(Vector(row[:3]), Quaternion((w, x, y, z)), Vector(row[7:]))


def skin_of(armature, names):
    """Returns the meshes that an armature moves, at rest, as one skin for soles; None without such a mesh."""
    found, count = [], 0
    for obj in bpy.data.objects:
        if obj.type != "MESH" or skinning.armature_of(obj) != armature or not len(obj.data.vertices):
            continue
        place = np.array(armature.matrix_world.inverted() @ obj.matrix_world)
        obj.data.calc_loop_triangles()
        triangles = mesh_data.column(obj.data.loop_triangles, "vertices", 3).reshape(-1, 3) + count
        joints, weights = skinning.group_weights(obj, names)
        found.append((mesh_data.rest_of(obj.data) @ place[:3, :3].T + place[:3, 3], triangles, joints, weights))
        count += len(joints)
    if not found:
        return None
    parts = ("positions", "triangles", "joints", "weights")
    return {part: np.concatenate(arrays) for part, arrays in zip(parts, zip(*found))}


class Player:
    """The motion of one armature on another."""

    def __init__(self, source, target):
        self.source = source.name
        self.joints = Joints(source), Joints(target)
        with self.joints[0].skeleton(source) as first, self.joints[1].skeleton(target) as second:
            self.retarget = hf.Retarget(first, second)
        self.frame = None  # in seconds

    def fits(self, source, target):
        return self.source == source.name and all(len(joints.names) == len(armature.data.bones)
            for joints, armature in zip(self.joints, (source, target)))

    def play(self, scene, depsgraph, source, target):
        now = (scene.frame_current + scene.frame_subframe) * scene.render.fps_base / scene.render.fps
        seconds = now - self.frame if self.frame is not None else 0.0
        if not 0 <= seconds <= JUMP:
            self.retarget.reset()
            seconds = 0.0
        self.frame = now
        first, second = self.joints
        second.write(target, self.retarget.solve(first.read(source.evaluated_get(depsgraph)), seconds))


def forget(name=None):
    for key in [name] if name is not None else list(players):
        if key in players:
            players.pop(key).retarget.close()


def start(source, target):
    """Makes the target follow the source from now on. Raises HfError, and changes nothing, if they do not pair."""
    made = Player(source, target)
    forget(target.name)
    players[target.name], target.hf_source = made, source
    return made


def play(scene, depsgraph):
    """Plays a frame on every armature that follows another, and prints errors. Returns whether one was posed."""
    played = False
    for target in scene.objects:
        source = target.hf_source if target.type == "ARMATURE" else None
        if source is None:
            continue
        try:
            if target.name not in players or not players[target.name].fits(source, target):
                start(source, target)
            players[target.name].play(scene, depsgraph, source, target)
            played = True
        except (hf.HfError, KeyError) as error:
            print(f"hf: {target.name} does not follow {source.name}: {error}")
    return played
