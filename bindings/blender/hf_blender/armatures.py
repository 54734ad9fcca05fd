"""The armature that moves a mesh by a modifier moves the handles of the mesh too.

Handles deform the mesh before the modifier. An empty has a constraint that blends the bones as the modifier does for its region,
so it stands where the region is seen. Its own place, without the constraint, is where the handle puts the region at rest.
"""

import bpy
import numpy as np
from mathutils import Matrix

from . import mesh_data

CARRIED = "hf armature"  # the constraint
BAKED = "hf_baked"  # of an armature that holds what the handles did; it moves no handle, or all would be done twice
# Bones of a constraint, those with the largest shares of the region. A region on a joint of three limbs has four; at half of it
# the empty would stand beside such a region, and at double the shares that are added are below a percent.
BONE_COUNT = 6


def is_bone(carrier):
    return isinstance(carrier, bpy.types.PoseBone)


def armature_of(obj):
    """The armature whose modifier moves a mesh."""
    return next((m.object for m in obj.modifiers if m.type == "ARMATURE" and m.object), None)


def modifier_of(obj):
    """The modifier whose armature moves the handles of a mesh, or None."""
    return next((m for m in obj.modifiers if m.type == "ARMATURE" and m.object and m.show_viewport and m.use_vertex_groups
        and BAKED not in m.object), None)


def bone_shares(obj, armature, vertices):
    """[(bone, share)] of a region, the largest first."""
    bones = {g.index: g.name for g in obj.vertex_groups if g.name in armature.data.bones and armature.data.bones[g.name].use_deform}
    total = dict.fromkeys(bones, 0.0)
    for vertex in vertices:
        for g in obj.data.vertices[vertex].groups:
            if g.group in total:
                total[g.group] += g.weight
    found = sorted(((share / len(vertices), bones[group]) for group, share in total.items() if share > 0), reverse=True)
    return [(bone, share) for share, bone in found[:BONE_COUNT]]


def carried(carrier):
    """The constraint by which the armature of the mesh moves an empty, or None."""
    return carrier.constraints.get(CARRIED) if isinstance(carrier, bpy.types.Object) else None


def bone_motion(constraint):
    """How the armature moves what the constraint is on, in the world."""
    total, out = 0.0, np.zeros((4, 4))
    for target in constraint.targets:
        bone = target.target.pose.bones.get(target.subtarget) if target.target and target.target.pose else None
        if bone is not None:
            frame = target.target.matrix_world
            out += target.weight * np.array(frame @ bone.matrix @ bone.bone.matrix_local.inverted() @ frame.inverted())
            total += target.weight
    return Matrix((out / total).tolist()) if total > 0 else Matrix()


def own_place(carrier):
    """Where a carrier stands in the world, without what the armature of the mesh does to it."""
    if is_bone(carrier):
        return carrier.id_data.matrix_world @ carrier.matrix
    constraint = carried(carrier)
    if constraint is None or constraint.mute:
        return carrier.matrix_world
    if is_placed_by_user(carrier):
        frame = carrier.parent.matrix_world @ carrier.matrix_parent_inverse if carrier.parent else Matrix()
        return frame @ carrier.matrix_basis  # exact; the way back through the bones is not
    return bone_motion(constraint).inverted_safe() @ carrier.matrix_world


def stand_of(empty):
    """What tells whether the user has moved an empty: neither its mesh nor the armature changes it."""
    return empty.matrix_basis if carried(empty) and is_placed_by_user(empty) else empty.matrix_world


def place_in(obj, carrier):
    """own_place in the frame of the mesh."""
    constraint = carried(carrier)
    if constraint and not constraint.mute and carrier.parent == obj and is_placed_by_user(carrier):
        return carrier.matrix_parent_inverse @ carrier.matrix_basis
    return obj.matrix_world.inverted() @ own_place(carrier)


def is_placed_by_user(empty):
    """Whether nothing places an empty but the user, and the armature of its mesh."""
    ours = carried(empty)
    if any(constraint != ours for constraint in empty.constraints):
        return False
    return empty.parent is None or ours is not None and empty.parent_type == "OBJECT" and empty.parent.get("hf_key") == empty.get("hf_key")


def carry(obj, empty):
    """Lets the armature that moves a mesh move an empty as it moves the region, and the object of the mesh with it. Without
    such an armature the empty is free."""
    modifier = modifier_of(obj)
    shares = bone_shares(obj, modifier.object, empty["hf_vertices"]) if modifier else []
    if not shares:
        let_go(empty)
        return
    constraint = carried(empty) or empty.constraints.new("ARMATURE")
    constraint.name = CARRIED
    constraint.use_deform_preserve_volume = modifier.use_deform_preserve_volume
    constraint.targets.clear()
    for bone, share in shares:
        target = constraint.targets.new()
        target.target, target.subtarget, target.weight = modifier.object, bone, share
    if empty.parent is None:
        empty.parent = obj
        empty.matrix_parent_inverse = obj.matrix_world.inverted_safe()


def let_go(empty, seen=False):
    """No armature moves an empty any more. It goes to its own place, or stays where it is seen."""
    constraint = carried(empty)
    if constraint is None:
        return
    place, placed = (empty.matrix_world if seen else own_place(empty)).copy(), is_placed_by_user(empty)
    empty.constraints.remove(constraint)
    if placed and empty.parent is not None:
        empty.parent = None
        empty.matrix_world = place


def carry_all(obj, found, anew=False):
    """carry() for carriers whose constraint is not that of the armature that moves the mesh now; anew: for all."""
    modifier = modifier_of(obj)
    for empty in found:
        if is_bone(empty):
            continue
        constraint = carried(empty)
        held = constraint.targets[0].target if constraint and len(constraint.targets) else None
        if anew or held != (modifier.object if modifier else None):
            carry(obj, empty)


def sentence_on(obj):
    """For the panel, how handles and the armature of a mesh go together; "" without one."""
    modifier = modifier_of(obj)
    if modifier is None:
        return ""
    return f"{modifier.object.name} moves the handles too. What you drag stays in every pose of its bones."
