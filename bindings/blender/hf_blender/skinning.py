"""Skin weights from the bones of an armature, carried from another mesh, or mirrored, as vertex groups."""

import uuid

import bpy
import numpy as np
from mathutils import Matrix

import hf

from .armatures import armature_of
from .mesh_data import edited_rest, faces_of, on_surface, positions_of, size_of
from .session import make_surface

NOTE = "hf_weights_note"  # what was guessed, for the panel
PIN = "hf_pin"
KEY = "hf_skin_key"  # of a mesh and its pins
COUNT = "hf_skin_count"  # of a mesh: bones for each vertex of its last weights

kept = {}  # key -> Skin: pins that move change its weights at once


class Skin:
    """The weights of a mesh, kept while Blender runs."""

    def __init__(self, surface, weights, names):
        self.surface, self.weights, self.names = surface, weights, names
        self.places, self.rows = None, None  # the pins, and what the groups hold

    def close(self):
        self.weights.close()
        self.surface.close()


def forget(key=None):
    """Drops what was kept for one mesh, or for all."""
    for k in [key] if key is not None else list(kept):
        if k in kept:
            kept.pop(k).close()


def groups_changed():
    """After an undo, nobody knows what the groups hold."""
    for skin in kept.values():
        skin.rows = None


def bone_ends(obj, armature, bones):
    """Heads and tails at rest in the frame of the mesh."""
    to_local = obj.matrix_world.inverted() @ armature.matrix_world
    ends = [[(to_local @ point)[:] for point in (bone.head_local, bone.tail_local)] for bone in bones]
    return np.array(ends, np.float64).reshape(-1, 2, 3)


def group_weights(obj, names):
    """The vertex groups of these names as (vertices, n) joints and weights, the largest eight of each vertex."""
    number = {obj.vertex_groups[n].index: i for i, n in enumerate(names) if n in obj.vertex_groups}
    joints, weights = np.zeros((len(obj.data.vertices), 8), np.uint32), np.zeros((len(obj.data.vertices), 8), np.float32)
    for v, vertex in enumerate(obj.data.vertices):
        found = sorted(((g.weight, number[g.group]) for g in vertex.groups if g.group in number and g.weight > 0),
            reverse=True)[:8]
        for k, (weight, joint) in enumerate(found):
            joints[v, k], weights[v, k] = joint, weight
    return joints, weights


def write_groups(obj, names, joints, weights, before=None):
    """Weights as vertex groups of the bones' names, in place of what the groups held. before: the joints and weights
    that they hold; only vertices that differ are written. Locked groups stay as they are."""
    changed = np.ones(len(joints), bool)
    if before is not None:
        changed = (joints != before[0]).any(1) | (weights != before[1]).any(1)
    rows = np.flatnonzero(changed).tolist()
    for joint, name in enumerate(names):
        group = obj.vertex_groups.get(name)
        if group is not None and group.lock_weight:
            continue
        if group is not None and rows:
            group.remove(rows)
        there = (joints == joint) & (weights > 0) & changed[:, None]
        if not there.any():
            continue
        group = group or obj.vertex_groups.new(name=name)
        for v, k in zip(*np.nonzero(there)):
            group.add([int(v)], float(weights[v, k]), "ADD")


def pins_of(obj):
    """The empties that pin weights of a mesh."""
    key = obj.get(KEY)
    return [o for o in bpy.data.objects if o.type == "EMPTY" and key and o.get(KEY) == key and PIN in o]


def add_pin(obj, armature, bone):
    """An empty over the active or first selected vertex: this place belongs to the bone."""
    vertex = next((v.index for v in obj.data.vertices if v.select), None)
    if vertex is None:
        raise hf.EmptyError(f"select a vertex of {obj.name} for the pin")
    obj[KEY] = obj.get(KEY) or uuid.uuid4().hex
    empty = bpy.data.objects.new(f"{obj.name} pin {bone}", None)
    empty.empty_display_type, empty.empty_display_size = "PLAIN_AXES", 0.05 * size_of(obj.data)
    (obj.users_collection or (bpy.context.scene.collection,))[0].objects.link(empty)
    empty[KEY], empty[PIN] = obj[KEY], bone
    empty.matrix_world = Matrix.Translation(obj.matrix_world @ obj.data.vertices[vertex].co)
    return empty


def pin_places(obj, names):
    """Vertex and bone of every pin: the vertex of the surface nearest to the empty."""
    points, inverse = positions_of(obj.data).astype(np.float64), obj.matrix_world.inverted()
    points[~on_surface(obj.data)] = np.inf
    places = {}
    for pin in pins_of(obj):
        if pin[PIN] not in names:
            raise hf.InvalidArgumentError(f"{pin.name} names the bone '{pin[PIN]}', which does not deform")
        away = points - np.array((inverse @ pin.matrix_world.translation)[:])
        places[int(np.einsum("ij,ij->i", away, away).argmin())] = names.index(pin[PIN])
    return places


def note_on(obj, sentences):
    obj[NOTE] = "\n".join(sentences)


def describe(info, work, helpers):
    """What was guessed, in sentences."""
    note = [f"{info.informed_count} vertices have their bone in sight, {info.solved_count} are between"]
    guessed = info.nearest_count + info.rigid_count + info.isolated_count
    if guessed:
        note.append(f"guessed: {guessed} vertices of {work.nearest_piece_count} loose parts")
    if work.blind:
        note.append("guessed: a part of the mesh has no bone in sight")
    if work.outside_count:
        note.append(f"{work.outside_count} bones outside the mesh")
    if helpers:
        note.append("look like helpers: " + ", ".join(helpers[:4]) + (f" and {len(helpers) - 4} more" if len(helpers) > 4 else ""))
    return note


def pin(obj, skin, places):
    """Weights with these pins, into the groups."""
    skin.weights.set_pins(list(places), joints=[[b] for b in places.values()] or None, weights=[[1.0]] * len(places) or None)
    found = skin.weights.get()
    write_groups(obj, skin.names, found.joints, found.weights, skin.rows)
    skin.places, skin.rows = places, (found.joints, found.weights)


def follow_pins(key):
    """The pins of a mesh were moved or deleted: new weights, without a factorisation unless the mesh was edited or the file opened
    since."""
    skin = kept.get(key)
    obj = next((o for o in bpy.data.objects if o.type == "MESH" and o.get(KEY) == key), None)
    if obj is None or NOTE not in obj or obj.mode == "EDIT":
        return
    if skin is None or len(obj.data.vertices) != skin.surface.vertex_count:
        armature = armature_of(obj)
        if armature is not None:
            weights_from_bones(obj, armature, obj.get(COUNT, 4))
        return
    places = pin_places(obj, skin.names)
    if places != skin.places:
        pin(obj, skin, places)


def weights_from_bones(obj, armature, count=4, window_manager=None):
    """Vertex groups and a modifier from the deforming bones. Locked groups keep their weights, pins count."""
    bones = [bone for bone in armature.data.bones if bone.use_deform]
    if not bones:
        raise hf.EmptyError(f"{armature.name} has no bone that deforms")
    names = [bone.name for bone in bones]
    number = {name: i for i, name in enumerate(names)}
    ends = bone_ends(obj, armature, bones)

    def parent_of(bone):
        while bone.parent is not None and bone.parent.name not in number:
            bone = bone.parent
        return number[bone.parent.name] if bone.parent is not None else -1

    places = pin_places(obj, names)
    obj[KEY], obj[COUNT] = obj.get(KEY) or uuid.uuid4().hex, count
    forget(obj[KEY])
    surface = make_surface(edited_rest(obj.data), faces_of(obj.data), window_manager)
    try:
        weights = hf.Weights(surface, ends[:, 0], tails=ends[:, 1], parents=[parent_of(b) for b in bones],
            influence_count=count)
        skin = kept[obj[KEY]] = Skin(surface, weights, names)
    except hf.HfError:
        surface.close()
        raise
    locked = [n for n in names if n in obj.vertex_groups and obj.vertex_groups[n].lock_weight]
    if locked:
        joints, given = group_weights(obj, locked)
        values = np.zeros((len(joints), len(locked)), np.float32)
        for k in range(joints.shape[1]):
            np.maximum.at(values, (np.arange(len(joints)), joints[:, k]), given[:, k])
        values /= np.maximum(values.sum(1, keepdims=True), 1)
        weights.set_locks([number[n] for n in locked], values)
    pin(obj, skin, places)
    info, work, reasons = weights.info, weights.statistics, weights.helpers(names)
    if not any(m.type == "ARMATURE" and m.object == armature for m in obj.modifiers):
        obj.modifiers.new(armature.name, "ARMATURE").object = armature
    helpers = [n for n, r in zip(names, reasons) if r & hf.HelperReason.PROPOSED]
    note_on(obj, describe(info, work, helpers))
    return info, helpers


def carry(source, target, count=4, distance=0.0, window_manager=None):
    """The vertex groups of one mesh on another that lies over it. The armature of the source moves the target too."""
    armature = armature_of(source)
    names = [g.name for g in source.vertex_groups if armature is None or g.name in armature.data.bones]
    if not names:
        raise hf.EmptyError(f"{source.name} has no vertex group" + (f" of a bone of {armature.name}" if armature else ""))
    joints, weights = group_weights(source, names)
    to_target = np.array(target.matrix_world.inverted() @ source.matrix_world)
    points = edited_rest(source.data).astype(np.float64) @ to_target[:3, :3].T + to_target[:3, 3]
    with make_surface(points.astype(np.float32), faces_of(source.data), window_manager) as first:
        with make_surface(edited_rest(target.data), faces_of(target.data), window_manager) as second:
            info = hf.WeightsTransferInfo()
            found = hf.Weights.transfer(first, second, joints, weights, distance=distance, influence_count=count, info=info)
    write_groups(target, names, found.joints, found.weights)
    if armature is not None and armature_of(target) is None:
        target.modifiers.new(armature.name, "ARMATURE").object = armature
    note = [f"carried from {source.name}: {info.matched_count} vertices matched, {info.solved_count} filled in"]
    guessed = info.nearest_count + info.rigid_count + info.isolated_count
    if guessed:
        note.append(f"guessed: {guessed} vertices of {info.guessed_piece_count} loose parts")
    note_on(target, note)
    return info


def mirror(obj, to, count=4, window_manager=None):
    """The vertex groups of one side on the other, by the bones of the armature that moves the mesh."""
    armature = armature_of(obj)
    if armature is None:
        raise hf.InvalidArgumentError(f"no armature moves {obj.name}")
    bones = [bone for bone in armature.data.bones if bone.use_deform]
    names = [bone.name for bone in bones]
    if not any(name in obj.vertex_groups for name in names):
        raise hf.EmptyError(f"{obj.name} has no vertex group of a bone of {armature.name}")
    joints, weights = group_weights(obj, names)
    ends = bone_ends(obj, armature, bones)
    with make_surface(edited_rest(obj.data), faces_of(obj.data), window_manager) as surface:
        info, off = hf.WeightsMirrorInfo(), hf.WeightsMirrorStatistics()
        found, _, pairings = hf.Weights.mirror(surface, ends[:, 0], names, joints=joints, weights=weights, to=to, influence_count=count,
            info=info, statistics=off)
    write_groups(obj, names, found.joints, found.weights)
    alone = [n for n, p in zip(names, pairings) if p == hf.MirrorPairing.ALONE]
    note = [f"mirrored: {info.named_count} bones paired by name, {info.placed_count} by place, {info.centre_count} in the middle",
            f"{info.matched_count} vertices matched, {info.solved_count} filled in, farthest {off.worst_vertex_off:.3g} off"]
    if alone:
        note.append("without a partner: " + ", ".join(alone[:4]) + (f" and {len(alone) - 4} more" if len(alone) > 4 else ""))
    note_on(obj, note)
    return info
