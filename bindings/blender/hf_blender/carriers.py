"""What carries a handle in the scene: an empty, or a bone of an armature.

Both hold the same properties: hf_key (the mesh), hf_id, hf_layer, hf_vertices, and hf_rest, the carrier's place at rest
in the mesh's frame. So Blender's own undo, delete and duplicate work on them, and the motion of a handle is always place
now times place at rest inverted, scale left out.

An armature that moves the mesh by a modifier moves the empties too: a constraint blends the bones as the modifier does for
the region. The pose of the handles comes before the modifier, so the place of such an empty is taken without the constraint.
"""

import uuid

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

import hf

from . import armatures, mesh_data
from .armatures import is_bone

# An empty that went farther than this was moved (a share of the mesh's box) or turned (entries of its matrix): single precision
# rounds by less, and nobody sees it.
SEEN_CHANGE = 1e-5

PROPERTIES = ("hf_key", "hf_id", "hf_layer", "hf_vertices", "hf_rest")
NAME = "hf_name"  # of the object when hf last saw it: a copy has another name
SEEN = "hf_seen"  # the motion of an empty when the pose was last solved
FREE = "hf_free"  # True: the pose finds the rotation of the handle
TURN = "hf_turn"  # the rotation of the handle where the empty has none: w, x, y, z; without it there is none
PLACED = "hf_placed"  # motions of the handle in the last pose: with the rotation that was found, and as the carrier gave it
OFFERED = "hf_offered"  # where an offered empty was put


def bones_of(armature):
    """Bones of an armature that move handles."""
    return [bone for bone in armature.pose.bones if "hf_id" in bone] if armature.get("hf_bones") else []


def offer(empty):
    """An empty that is no handle until it is moved."""
    empty[OFFERED] = [x for row in armatures.stand_of(empty) for x in row]


def waits(carrier):
    place = carrier.get(OFFERED)
    return place is not None and np.allclose(np.array(armatures.stand_of(carrier)).ravel(), place, rtol=1e-6, atol=1e-7)


def offered(key):
    """Empties of a mesh that wait to be moved."""
    return [o for o in bpy.data.objects if o.type == "EMPTY" and o.get("hf_key") == key and waits(o)]


def carriers_in(objects):
    """key -> {id: carrier}, for all meshes."""
    found = {}
    for obj in objects:
        if obj.type == "EMPTY" and "hf_id" in obj and not waits(obj):
            found.setdefault(obj["hf_key"], {})[obj["hf_id"]] = obj
        elif obj.type == "ARMATURE":
            for bone in bones_of(obj):
                found.setdefault(bone["hf_key"], {})[bone["hf_id"]] = bone
    return found


def carriers_of(key):
    return carriers_in(bpy.data.objects).get(key, {})


def name(obj):
    """Keeps the name of an object, which tells it from its copies."""
    if obj.get(NAME) != obj.name:
        obj[NAME] = obj.name


def strip(carrier):
    """A carrier, or a mesh, is nothing to hf any more."""
    armatures.let_go(carrier, seen=True)
    for key in (*PROPERTIES, NAME, SEEN, FREE, TURN, PLACED, OFFERED):
        if key in carrier:
            del carrier[key]


def mark(carrier, obj, vertices, rest, layer):
    carrier["hf_key"], carrier["hf_id"], carrier["hf_layer"] = obj["hf_key"], uuid.uuid4().hex, int(layer)
    carrier["hf_vertices"], carrier["hf_rest"] = [int(v) for v in vertices], [x for row in rest for x in row]
    name(carrier.id_data)
    if not is_bone(carrier):
        carrier[SEEN] = np.eye(4).ravel().tolist()


def unmark(carrier):
    """The handle goes; a bone stays, an empty goes with it."""
    if not is_bone(carrier):
        bpy.data.objects.remove(carrier)
        return
    strip(carrier)
    for option in ("hf_following", "hf_limb"):
        carrier.property_unset(option)


def motion_of(obj, carrier):
    """The rigid motion of a carrier since rest, in the frame of the mesh."""
    shift, turn, _ = armatures.place_in(obj, carrier).decompose()  # the mesh's scale goes here: place at rest has none
    rest = Matrix([carrier["hf_rest"][4 * r:4 * r + 4] for r in range(4)])
    return np.array(Matrix.Translation(shift) @ turn.to_matrix().to_4x4() @ rest.inverted())


def is_dragged(carrier):
    """True for an empty that the user alone places, on layer 0. Others give the rotation of what moves them."""
    if is_bone(carrier) or SEEN not in carrier or carrier["hf_layer"] or not armatures.is_placed_by_user(carrier):
        return False
    return carrier.animation_data is None or not (carrier.animation_data.action or carrier.animation_data.drivers)


def look_at(carrier, motion, stood, diagonal):
    """Frees the rotation of a handle whose empty was moved and not turned; gives it when the empty was turned.

    stood: the rotation of the handle in the last pose, a Quaternion; a given rotation begins there. diagonal: of the mesh's
    box. All of it stands in properties of the empty, so undo takes it back with the move."""
    if not is_dragged(carrier):
        return
    seen = np.array(carrier[SEEN]).reshape(4, 4)
    if not np.allclose(seen[:3, :3], motion[:3, :3], rtol=0, atol=SEEN_CHANGE):
        if carrier.get(FREE):
            turn = Matrix(seen[:3, :3].tolist()).to_quaternion().inverted() @ stood
            carrier[FREE], carrier[TURN] = False, turn[:]
    elif np.linalg.norm(motion[:3, 3] - seen[:3, 3]) > SEEN_CHANGE * diagonal:
        carrier[FREE] = True
    else:
        return
    carrier[SEEN] = motion.ravel().tolist()


def turned(motion, carrier):
    """The motion with the rotation that is given to the handle. It turns about the middle of the region, which is the
    origin of the empty."""
    if TURN not in carrier or carrier.get(FREE):
        return motion
    middle = np.array(carrier["hf_rest"]).reshape(4, 4)[:3, 3]
    out = motion.copy()
    out[:3, :3] = motion[:3, :3] @ np.array(Quaternion(carrier[TURN]).to_matrix())
    out[:3, 3] += (motion[:3, :3] - out[:3, :3]) @ middle
    return out


def make_empty(obj, name, vertices, rest_positions, diagonal, layer):
    """An empty at the centre of a region of the mesh at rest; diagonal: of the mesh's box. An armature that moves the mesh
    moves it from there."""
    rest = Matrix.Translation(rest_positions[np.asarray(vertices)].mean(0).tolist())
    empty = bpy.data.objects.new(f"{obj.name} {name}", None)
    empty.empty_display_type = "SPHERE"
    empty.empty_display_size = 0.05 * diagonal
    empty.show_in_front = True  # its middle lies inside the body
    for collection in obj.users_collection or (bpy.context.scene.collection,):
        collection.objects.link(empty)
    mark(empty, obj, vertices, rest, layer)
    empty.rotation_mode = "QUATERNION"
    place, turn, _ = (obj.matrix_world @ rest).decompose()
    empty.matrix_world = Matrix.Translation(place) @ turn.to_matrix().to_4x4()  # there at once, without an evaluation
    armatures.carry(obj, empty)
    return empty


def bone_regions(positions, heads, tails, share):
    """For each bone the vertices that are nearest to it among all bones, at a place in its middle `share`: limbs are
    held, joints stay free."""
    along = tails - heads
    squared = np.maximum(np.einsum("ij,ij->i", along, along), 1e-30)
    nearest, inside = np.empty(len(positions), np.int64), np.empty(len(positions), bool)
    for first in range(0, len(positions), 4096):  # in pieces: memory stays small
        part = slice(first, first + 4096)
        at = (positions[part] @ along.T - np.einsum("ij,ij->i", heads, along)) / squared  # along the bone, 0 to 1
        away = positions[part, None, :] - (heads + np.clip(at, 0, 1)[:, :, None] * along)
        nearest[part] = np.einsum("ijk,ijk->ij", away, away).argmin(1)
        inside[part] = np.abs(np.take_along_axis(at, nearest[part, None], 1)[:, 0] - 0.5) <= 0.5 * share
    return [np.flatnonzero((nearest == j) & inside) for j in range(len(heads))]


def mark_bones(obj, armature, rest_positions, groups, layer, share):
    """Marks the deforming bones of an armature as carriers: regions by vertex groups of the bones' names (`groups`:
    name -> vertices) or by place. Returns the bones marked."""
    if any(m.type == "ARMATURE" and m.object == armature and m.show_viewport for m in obj.modifiers):
        raise hf.ConflictError(f"{armature.name} moves {obj.name} by a modifier already; switch that off first")
    bones = [bone for bone in armature.pose.bones if bone.bone.use_deform and "hf_id" not in bone]
    if not bones:
        raise hf.EmptyError(f"{armature.name} has no deforming bone without a handle")
    to_local = obj.matrix_world.inverted() @ armature.matrix_world
    ends = [[(to_local @ point)[:] for point in (bone.bone.head_local, bone.bone.tail_local)] for bone in bones]
    ends = np.array(ends, np.float64)
    near = bone_regions(rest_positions.astype(np.float64), ends[:, 0], ends[:, 1], share)
    marked = []
    shown = mesh_data.on_surface(obj.data)
    for bone, region in zip(bones, near):
        region = groups.get(bone.name, region[shown[region]])
        if len(region):
            place, turn, _ = (to_local @ bone.bone.matrix_local).decompose()
            mark(bone, obj, region, Matrix.Translation(place) @ turn.to_matrix().to_4x4(), layer)
            marked.append(bone)
    if not marked:
        raise hf.EmptyError(f"no vertex of {obj.name} is near the middle of a bone of {armature.name}")
    armature["hf_bones"] = True
    return marked
