"""Objects that were duplicated. Blender copies what hf keeps in them, so a copy gets a state of its own.

A mesh that was copied with the empties or the armature of its handles has these handles. Copied alone it keeps its shape and is
bound to nothing. An empty that was copied alone is no handle.
"""

import uuid

import bpy

from . import carriers, mesh_data, skinning

known = 0  # objects when copies were last looked for: a copy is one more


def own_objects():
    """Those of this file: what is linked from another cannot be written."""
    return [o for o in bpy.data.objects if o.library is None]


def first_of(objects):
    """The object that was there before its copies: it has the name that hf last saw."""
    return min(objects, key=lambda o: (o.name != o.get(carriers.NAME), o.name))


def held_by(obj):
    """The carriers of handles in an object."""
    if obj.type == "ARMATURE":
        return carriers.bones_of(obj)
    return [obj] if obj.type == "EMPTY" and "hf_id" in obj else []


def copied(key):
    """The copies of the carriers of a mesh: a list for each time that they were copied."""
    found, lists = {}, []
    for obj in own_objects():
        for carrier in held_by(obj):
            if carrier["hf_key"] == key:
                found.setdefault(carrier["hf_id"], []).append(carrier)
    for same in found.values():
        first = first_of([carrier.id_data for carrier in same])
        for number, carrier in enumerate(c for c in same if c.id_data != first):
            if number == len(lists):
                lists.append([])
            lists[number].append(carrier)
    return lists


def own_state(obj, held):
    """Gives a copy its own key and handles, or makes it a mesh without any."""
    shared = any(o != obj and o.data == obj.data for o in bpy.data.objects)
    if held and not shared:
        obj["hf_key"] = uuid.uuid4().hex
        for carrier in held:
            carrier["hf_key"], carrier["hf_id"] = obj["hf_key"], uuid.uuid4().hex
        carriers.name(obj)
        return
    for carrier in held:
        carriers.strip(carrier)
    carriers.strip(obj)
    if not shared:
        mesh_data.forget_pose(obj.data)


def part(always=False):
    """Parts copies from what they were copied from, when there are more objects than before."""
    global known
    if len(bpy.data.objects) == known and not always:
        return
    known = len(bpy.data.objects)
    keys, skins = {}, {}
    for obj in own_objects():
        for carrier in held_by(obj):
            keys.setdefault(carrier["hf_key"], [])
        if obj.type == "MESH" and "hf_key" in obj:
            keys.setdefault(obj["hf_key"], []).append(obj)
        if obj.type == "MESH" and skinning.KEY in obj:
            skins.setdefault(obj[skinning.KEY], []).append(obj)
    for objects in skins.values():
        for obj in set(objects) - {first_of(objects)}:
            del obj[skinning.KEY]  # pins move the weights of the first mesh alone
    for key, objects in keys.items():
        lists = copied(key)
        for obj in sorted(set(objects) - {first_of(objects)}, key=lambda o: o.name) if objects else ():
            own_state(obj, lists.pop(0) if lists else [])
        for carrier in sum(lists, []):
            carriers.strip(carrier)
        for obj in own_objects():
            if obj.get("hf_key") == key or any(carrier["hf_key"] == key for carrier in held_by(obj)):
                carriers.name(obj)
