"""What a bound mesh keeps while Blender runs: its solver, its pose, and which empty stands for which handle.

The scene is the truth: a handle is an empty with the properties hf_key (the mesh it belongs to), hf_id and hf_vertices, so
Blender's own undo, delete and duplicate work; sync() brings the pose in line with it. Nothing here factorises twice:
handles come and go on the factor made at bind.
"""

import threading
import time
import uuid

import bpy
import numpy as np
from mathutils import Matrix

import hf

REST = "hf_rest"
sessions = {}
figures = {"bind_ms": 0.0, "update_ms": 0.0, "sync_ms": 0.0}


def positions_of(mesh):
    out = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", out)
    return out.reshape(-1, 3)


def triangles_of(mesh):
    mesh.calc_loop_triangles()
    out = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", out)
    return out.reshape(-1, 3)


def make_solver(positions, triangles, window_manager=None, **options):
    """A solver made on a thread of its own, so that Blender's progress bar moves; options as hf.Solver."""
    progress, made = hf.Progress(), {}

    def work():
        try:
            made["solver"] = hf.Solver(positions, triangles, progress=progress, thread_count=2, **options)
        except BaseException as error:  # noqa: BLE001 - raised again below
            made["error"] = error

    worker = threading.Thread(target=work)
    if window_manager:
        window_manager.progress_begin(0, 100)
    worker.start()
    while worker.is_alive():
        worker.join(0.05)
        if window_manager:
            window_manager.progress_update(int(100 * progress.fraction))
    if window_manager:
        window_manager.progress_end()
    if "error" in made:
        raise made["error"]
    return made["solver"]


def empties_of(key):
    return {o["hf_id"]: o for o in bpy.data.objects if o.type == "EMPTY" and o.get("hf_key") == key}


class Session:
    def __init__(self, obj, window_manager=None):
        mesh = obj.data
        begin = time.perf_counter()
        self.rest = rest_of(mesh)
        self.solver = make_solver(self.rest, triangles_of(mesh), window_manager)
        self.pose = hf.Pose(self.solver)
        self.numbers = {}  # hf_id -> handle
        self.posed = self.rest.copy()
        if REST not in mesh.attributes:
            mesh.attributes.new(REST, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", self.rest.ravel())
        obj["hf_key"] = obj.get("hf_key") or uuid.uuid4().hex
        figures["bind_ms"] = 1e3 * (time.perf_counter() - begin)

    def sync(self, obj):
        """Handles for new empties, none for those that have gone."""
        begin = time.perf_counter()
        empties = empties_of(obj["hf_key"])
        gone = [i for i in self.numbers if i not in empties]
        fresh = [i for i in empties if i not in self.numbers]
        if gone:
            self.pose.remove_handles([self.numbers[i] for i in gone])
            for i in gone:
                del self.numbers[i]
        for layer in sorted({int(empties[i].get("hf_layer", 0)) for i in fresh}):
            batch = [i for i in fresh if int(empties[i].get("hf_layer", 0)) == layer]
            regions = [np.array(empties[i]["hf_vertices"], np.uint32) for i in batch]
            for i, number in zip(batch, self.pose.add_handles(regions, layer=layer)):
                self.numbers[i] = int(number)
        figures["sync_ms"] = 1e3 * (time.perf_counter() - begin)
        return empties

    def update(self, obj, write=True):
        """The pose from where the empties stand, into the mesh."""
        begin = time.perf_counter()
        empties = self.sync(obj)
        if empties:
            to_local = obj.matrix_world.inverted()
            ids = list(empties)
            matrices = np.array([motion_of(to_local, empties[i]) for i in ids])
            self.pose.set_matrices([self.numbers[i] for i in ids], matrices)
            self.pose.deform(self.posed)
        else:
            self.posed[:] = self.rest
        if write:
            obj.data.vertices.foreach_set("co", self.posed.ravel())
            obj.data.update()
        figures["update_ms"] = 1e3 * (time.perf_counter() - begin)


def motion_of(to_local, empty):
    """The rigid motion of an empty since it was made, in the mesh's frame; scale is left out."""
    rest = Matrix([empty["hf_rest"][4 * r:4 * r + 4] for r in range(4)])
    moved = (to_local @ empty.matrix_world) @ rest.inverted()
    place, turn, _ = moved.decompose()
    return np.array(Matrix.Translation(place) @ turn.to_matrix().to_4x4())


def rest_of(mesh):
    """The rest positions: the attribute of an earlier bind, or the mesh as it is."""
    if REST in mesh.attributes and len(mesh.attributes[REST].data) == len(mesh.vertices):
        out = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.attributes[REST].data.foreach_get("vector", out)
        return out.reshape(-1, 3)
    return positions_of(mesh)


def session_of(obj, window_manager=None, bind=True):
    """The session of a mesh object, made when there is none."""
    if obj is None or obj.type != "MESH":
        raise hf.InvalidArgumentError("select a mesh object")
    found = sessions.get(obj.get("hf_key"))
    if found and len(found.rest) == len(obj.data.vertices):
        return found
    if not bind:
        return None
    made = Session(obj, window_manager)
    sessions[obj["hf_key"]] = made
    return made


def forget(obj):
    """Rest positions back, handles and properties away."""
    key = obj.get("hf_key")
    session = sessions.pop(key, None)
    rest = rest_of(obj.data)
    for empty in empties_of(key).values():
        bpy.data.objects.remove(empty)
    obj.data.vertices.foreach_set("co", rest.ravel())
    if REST in obj.data.attributes:
        obj.data.attributes.remove(obj.data.attributes[REST])
    obj.data.update()
    if "hf_key" in obj:
        del obj["hf_key"]
    if session:
        session.pose.close()
        session.solver.close()


def add_handles(obj, regions, names, layer=0):
    """An empty at the centre of each region of the mesh at rest; all of them or none."""
    session = session_of(obj)
    session.sync(obj)
    size = 0.05 * float(np.linalg.norm(np.ptp(session.rest, axis=0)))
    made = []
    for vertices, name in zip(regions, names):
        if not len(vertices):
            raise hf.EmptyError(f"no vertex in {name}")
        rest = Matrix.Translation(session.rest[np.asarray(vertices)].mean(0).tolist())
        empty = bpy.data.objects.new(f"{obj.name} {name}", None)
        empty.empty_display_type, empty.empty_display_size = "SPHERE", size
        for collection in obj.users_collection or (bpy.context.scene.collection,):
            collection.objects.link(empty)
        empty["hf_key"], empty["hf_id"], empty["hf_layer"] = obj["hf_key"], uuid.uuid4().hex, int(layer)
        empty["hf_vertices"], empty["hf_rest"] = [int(v) for v in vertices], [x for row in rest for x in row]
        empty.rotation_mode = "QUATERNION"
        place = obj.matrix_world @ rest
        empty.location, empty.rotation_quaternion = place.to_translation(), place.to_quaternion()
        made.append(empty)
    bpy.context.view_layer.update()
    try:
        session.sync(obj)
    except hf.HfError:
        for empty in made:
            bpy.data.objects.remove(empty)
        raise
    return made


def groups_vertices(obj, names, least=0.5):
    """Vertices of each vertex group with at least that weight, in one pass over the mesh."""
    found = {}
    for name in names:
        group = obj.vertex_groups.get(name)
        if group is None:
            raise hf.InvalidArgumentError(f"{obj.name} has no vertex group '{name}'")
        found[group.index] = []
    for vertex in obj.data.vertices:
        for g in vertex.groups:
            if g.group in found and g.weight >= least:
                found[g.group].append(vertex.index)
    return list(found.values())


def group_vertices(obj, name, least=0.5):
    return groups_vertices(obj, [name], least)[0]


def selected_vertices(obj):
    if obj.mode == "EDIT":
        obj.update_from_editmode()
    picked = np.empty(len(obj.data.vertices), bool)
    obj.data.vertices.foreach_get("select", picked)
    return np.flatnonzero(picked).tolist()


# ---- results into Blender ----

def write_group(obj, name, values):
    """A field as a vertex group, weights clamped to 0..1."""
    group = obj.vertex_groups.get(name) or obj.vertex_groups.new(name=name)
    levels = np.clip(np.round(np.asarray(values) * 1024).astype(int), 0, 1024)  # one call per level, not per vertex
    order = np.argsort(levels, kind="stable")
    for part in np.split(order, np.flatnonzero(np.diff(levels[order])) + 1):
        group.add(part.tolist(), float(levels[part[0]]) / 1024, "REPLACE")
    return group


def write_colour(obj, name, values, strips=12):
    """A field as a colour attribute in strips, orange at 1 and blue at 0."""
    mesh = obj.data
    attribute = mesh.color_attributes.get(name) or mesh.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    t = np.clip(np.asarray(values, np.float32), 0, 1)[:, None]
    colour = (1 - t) * np.array([0.05, 0.16, 0.6]) + t * np.array([0.9, 0.35, 0.04])
    colour = np.where(np.floor(t * strips) % 2 == 1, 0.45 * colour + 0.55, colour)
    attribute.data.foreach_set("color", np.hstack([colour, np.ones_like(t)]).astype(np.float32).ravel())
    mesh.color_attributes.active_color = attribute
    return attribute


def field_between(obj, high, low):
    """The harmonic field that is 1 on one group and 0 on another, from the mesh's factor."""
    session = session_of(obj)
    ones, zeros = group_vertices(obj, high), group_vertices(obj, low)
    both = [v for v in ones if v in set(zeros)]
    if both:
        raise hf.ConflictError(f"vertex {both[0]} is in both groups", index=both[0])
    with session.solver.clone() as clone:
        clone.add_sites(ones + zeros, [1.0] * len(ones) + [0.0] * len(zeros))
        return clone.solve()


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
        raise hf.InvalidArgumentError(f"{source.name} and {target.name} need two vertex groups or more of the same names, starting with '{prefix}'")
    rest = session_of(target).rest
    with make_solver(rest_of(source.data), triangles_of(source.data), window_manager) as from_solver:
        with hf.Transfer(from_solver, session_of(target).solver, scale=scale) as transfer:
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
