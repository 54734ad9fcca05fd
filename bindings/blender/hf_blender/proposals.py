"""Handles that the library proposes on a mesh."""

import numpy as np
from mathutils import Vector

import hf

from . import carriers, mesh_data, retarget, skinning
from .session import session_of, take_up

REASONS = ("foot", "tip", "end", "joint", "middle")


def proposals_of(obj, surface, rest):
    """The proposals of the library, each with a name and the vertices of its region. An armature that moves the mesh gives
    them the names of its bones, and a hand is a whole hand."""
    up = obj.matrix_world.to_3x3().inverted_safe() @ Vector((0.0, 0.0, 1.0))  # Blender's ground is below z
    armature = skinning.armature_of(obj)
    if armature and any(bone.name in obj.vertex_groups for bone in armature.data.bones):
        joints, regions = retarget.Joints(armature), np.empty(len(rest), np.uint32)
        with joints.skeleton_in(obj, armature) as skeleton:
            for i, place in enumerate(surface.propose_handles(skeleton=skeleton, up=up, regions=regions)):
                known = place["joint"] != hf.NO_INDEX
                yield (place, joints.names[place["joint"]] if known else REASONS[place["reason"]],
                    np.flatnonzero(regions == i).tolist())
        return
    for place in surface.propose_handles(up=up):
        near = np.linalg.norm(rest - place["position"], axis=1) <= place["radius"]
        region = sorted(mesh_data.connected(obj.data, int(place["vertex"]), near))  # as hf_pose_add_handle_at
        yield place, REASONS[place["reason"]], region


def add_proposals(obj, only_pinned=False):
    """Handles the library proposes, where no handle is yet. Those that hold come first and are drawn as cubes. The
    others hold nothing until they are moved."""
    session = session_of(obj)
    mesh_data.refuse_shape_keys(obj)
    session.sync(obj)
    held = [*carriers.carriers_of(obj["hf_key"]).values(), *carriers.offered(obj["hf_key"])]
    taken = {v for carrier in held for v in carrier["hf_vertices"]}
    made = []
    diagonal = session.surface.report.bounding_box_diagonal
    for place, name, region in proposals_of(obj, session.surface, session.rest):
        if (only_pinned and not place["pinned"]) or taken.intersection(region):
            continue
        taken.update(region)
        made.append(carriers.make_empty(obj, name, region, session.rest, diagonal, 0))
        if place["pinned"]:
            made[-1].empty_display_type = "CUBE"
        else:
            carriers.offer(made[-1])
        made[-1].hf_following = place["following"]
    if not made:
        raise hf.EmptyError(f"{obj.name} has handles at all proposed places")
    return take_up(obj, made)
