"""Vertex groups that are painted on a bound mesh: stiffness, and pins, whose vertices hold.

The mesh object holds their names, so undo, a saved file and a copy take them along. While you paint, the pose follows."""

import numpy as np

import hf

from . import mesh_data

STIFF = "hf_stiff"  # of a mesh object: the stiffness where the weight is 1
STIFF_GROUP = "hf_stiff_group"  # the group that is painted
PINS = "hf_pins_group"
LEAST, MOST = 1e-4, 1e4  # the range of hf_surface_edit_desc.stiffness
# A vertex with this weight holds: what looks half painted, as for a handle from a group. Lower, a soft brush pins its whole disc.
PINNED_FROM = 0.5


def lost_group(obj, key):
    """The name of a painted group, if the mesh has no such group any more; else ""."""
    name = obj.get(key, "")
    return name if name and name not in obj.vertex_groups else ""


def stiffness_of(obj, found):
    """The stiffness of each vertex: s to the power of the weight. Vertices at one place are one to the library: the largest of
    their weights counts."""
    name, most = obj.get(STIFF_GROUP), obj.get(STIFF, 1.0)
    if not name:
        return np.ones(len(obj.data.vertices))
    places = found.places()
    weights = np.zeros(len(places))
    np.maximum.at(weights, places, mesh_data.group_weights(obj, name))
    # the least number of a Blender property, in single precision, is a little below the least of hf
    return np.clip(most ** weights[places], LEAST, MOST)


def pins_of(obj):
    """The vertices that hold where they are painted, sorted."""
    name = obj.get(PINS)
    if not name:
        return np.empty(0, np.uint32)
    shown = mesh_data.on_surface(obj.data)
    pinned = np.flatnonzero((mesh_data.group_weights(obj, name) >= PINNED_FROM) & shown)
    if len(pinned) == np.count_nonzero(shown):
        raise hf.ConflictError(f"{name} pins all vertices, so nothing can move; erase the part that is to move")
    return pinned.astype(np.uint32)


def keep(obj, found, values):
    """Sets properties of a mesh (None: away) and takes what is painted, or leaves all as it was."""
    before = {name: obj.get(name) for name in values}

    def put(chosen):
        for name, value in chosen.items():
            if value is None:
                obj.pop(name, None)
            else:
                obj[name] = value
    put(values)
    try:
        found.take_paint(obj)
    except hf.HfError:
        put(before)
        raise


def stiffen(obj, found, group, most):
    """The vertices of a painted group bend less than the rest, or more for `most` below 1. An empty group: all as they are."""
    if group:
        weights = mesh_data.group_weights(obj, group)
        if not weights.any():
            raise hf.EmptyError(f"the weights of {group} are 0; paint it in Weight Paint first")
        if most != 1 and np.ptp(weights) == 0:
            raise hf.InvalidArgumentError(f"{group} is painted alike on the whole mesh, so no part bends less than another; "
                "paint a part")
    keep(obj, found, {STIFF: most if group else None, STIFF_GROUP: group or None})


def pin(obj, found, group):
    """The painted vertices of a group hold. An empty group: none do."""
    if group:
        mesh_data.refuse_shape_keys(obj)
        weights = mesh_data.group_weights(obj, group)
        if not weights.any():
            raise hf.EmptyError(f"the weights of {group} are 0; paint what holds in Weight Paint first")
        if weights.max() < PINNED_FROM:
            raise hf.EmptyError(f"no weight of {group} is {PINNED_FROM} or more; paint what holds with more strength")
    keep(obj, found, {PINS: group or None})


def words_of(obj, found):
    """What is painted, for a sentence."""
    pins = [f"{len(found.painted)} pinned vertices"] * bool(len(found.painted))
    stiff = obj.get(STIFF_GROUP)
    return pins + [f"the stiffness of {stiff}"] * bool(stiff and not lost_group(obj, STIFF_GROUP))


def lines_on(obj, found):
    """[(sentence, icon)] for the panel on the painted groups of a mesh."""
    out = []
    for key, button in ((PINS, "Pins from group"), (STIFF_GROUP, "Stiffness from group")):
        name = obj.get(key)
        if lost_group(obj, key):
            out.append((f"The vertex group {name} is gone: give a group this name, press {button}, or choose Clear.", "ERROR"))
        elif name and key == PINS and found and not len(found.painted) and not found.paint_error:
            out.append((f"Nothing is painted in {name} any more: paint what holds, or choose Clear.", "ERROR"))
        elif name and key == PINS:
            out.append((f"{len(found.painted)} vertices hold where {name} is painted" if found
                else f"Pinned where {name} is painted", "NONE"))
        elif name:
            out.append((f"Stiffness {obj[STIFF]:g} where {name} is painted", "NONE"))
    if found and found.paint_error:
        out.append((f"Pins and stiffness stay as they were: {found.paint_error}.", "ERROR"))
    return out
