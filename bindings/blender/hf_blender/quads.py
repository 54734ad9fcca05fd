"""Quads that follow: the object that was made keeps its source and its options, and its mesh is made again when a stroke,
a pole or an edge of the source changes. Without relaxation while the user drags; with it once nothing has changed for a
while.

The scene is the truth. The options are properties of the object made (HF_PG_quads). Strokes (curves) and poles (empties)
carry the keys of their quads. The mesh carries what it was made of, so Blender's undo takes both back together. `kept` only
saves time and can be dropped at any moment."""

import hashlib
import math
import time
import uuid
from concurrent.futures import ThreadPoolExecutor

import bpy
import numpy as np
from mathutils import Matrix, Vector

import hf

from . import mesh_data, session

KEYS = "hf_quads_keys"  # of strokes and poles: the quads that they belong to, with blanks between
POLE = "hf_pole"  # how many quads meet there
SHOWN, WRITTEN, RELAXED = "hf_quads_shown", "hf_quads_written", "hf_quads_relaxed"  # of the mesh made

# Relaxation begins when nothing has changed for so many seconds: a hand that rests for a moment would wait at half of it.
IDLE = 0.3
# How often a relaxation is asked whether it is ready, in seconds.
POLL = 0.05

# One thread relaxes, so that the user can go on dragging.
WORKER = ThreadPoolExecutor(1, "hf quads")

# More quads than so many times those asked for have a reason that is said. A mannequin of 60 pieces gets 3 % more than 600, and
# 1.8 times as many as 300. At half of the excess or double the same are said.
SAID_FROM = 1.3


class Kept:
    """What is kept of quads while Blender runs."""

    def __init__(self):
        self.quads, self.surface = None, None
        self.members = None  # names of strokes and poles, as last seen; None: look again
        self.failed = None  # digest of what failed: it is not tried again
        self.wanted, self.digest = None, None  # surface and options of the mesh that waits for relaxation, and their name
        self.due, self.job, self.progress, self.begun = None, None, None, 0.0
        self.line, self.error = "", ""  # for the panel
        self.figures = {"library_ms": 0.0, "total_ms": 0.0}

    def stop(self):
        """Ends a relaxation that runs."""
        self.due = None
        if self.job is not None:
            self.progress.cancel()
            self.job.exception()
            self.job = None

    def make(self, surface, **options):
        """The quads of these options; may be called on the thread."""
        if self.quads is not None and self.surface is surface:
            self.quads.update(**options)
            return
        made = hf.Quads(surface, **options)
        self.close()
        self.quads, self.surface = made, surface

    def close(self):
        if self.quads is not None:
            self.quads.close()
            self.quads = None


kept = {}  # key -> Kept
known = None  # whether there are quads to follow; None: nobody has looked


def forget(keys=None):
    """Drops what was kept, of some quads or of all."""
    for key in list(kept if keys is None else keys):
        if key in kept:
            state = kept.pop(key)
            state.stop()
            state.close()


# ---- what belongs to quads

def keys_of(obj):
    return str(obj.get(KEYS, "")).split()


def attach(obj, key):
    """Makes a curve a stroke, or an empty a pole, of these quads too."""
    obj[KEYS] = " ".join(dict.fromkeys([*keys_of(obj), key]))


def members_of(scene, key):
    """Strokes and poles, in the order of their names."""
    found = [o for o in scene.objects if KEYS in o and key in keys_of(o)]
    found.sort(key=lambda o: o.name)
    return ([o for o in found if o.type == "CURVE"], [o for o in found if o.type == "EMPTY" and POLE in o])


def made_in(scene):
    """key -> object. A duplicate has the key too: it stays as it is while the first by name is there."""
    found = {}
    for obj in scene.objects:
        key = obj.hf_quads.key if obj.type == "MESH" else ""
        if key and (key not in found or obj.name < found[key].name):
            found[key] = obj
    return found


def made_of(context):
    """The quads of the active object: itself, or those that it is a stroke or a pole of."""
    active = context.active_object
    if active is None:
        return None
    if active.type == "MESH":
        return active if active.hf_quads.key else None
    keys = keys_of(active)
    found = made_in(context.scene) if keys else {}
    return next((found[key] for key in reversed(keys) if key in found), None)


# ---- making

def options_of(source, found, strokes, poles, graph, faces, crease, sharp, symmetry):
    """Arguments of hf.Quads. source: the mesh object; found: its session; graph: the evaluated scene."""
    polygons = source.data.polygons
    areas = np.empty(len(polygons), np.float32)
    polygons.foreach_get("area", areas)
    area = float(areas.sum(dtype=np.float64))
    vertices, vectors = mesh_data.guides_of(source, strokes, found.surface, math.sqrt(area / min(faces, len(polygons))), graph)
    into = source.matrix_world.inverted_safe()
    places = [into @ pole.matrix_world for pole in poles]
    return {"face_count": faces, "crease_angle": crease,
        "crease_edges": mesh_data.sharp_edges(source.data) if sharp else None, "guide_vertices": vertices,
        "guide_vectors": vectors, "irregular_points": [at.translation[:] for at in places] if poles else None,
        "irregular_valences": [int(pole[POLE]) for pole in poles] if poles else None,
        "irregular_directions": [at.to_3x3().col[0][:] for at in places] if poles else None,
        "symmetry_plane": None if symmetry == "NONE" else [float(axis == symmetry) for axis in "XYZ"] + [0.0]}


def digest_of(found, options):
    """A name of everything that the mesh depends on."""
    text = hashlib.sha1(np.ascontiguousarray(found.rest).tobytes())
    for name in sorted(options):
        value = options[name]
        text.update(name.encode())
        text.update(b"" if value is None else np.ascontiguousarray(value, np.float64).tobytes())
    return text.hexdigest()


def content_of(mesh):
    """A name of a mesh as it is, to see whether somebody edited it."""
    text = hashlib.sha1(mesh_data.positions_of(mesh).tobytes())
    text.update(mesh_data.column(mesh.loops, "vertex_index").tobytes())
    return text.hexdigest()


def write(made, mesh, digest, relaxed, source):
    """A quad mesh into the object made: the same object, mesh and materials. Vertex groups come with relaxation."""
    mesh_data.write_quads(made.data, mesh)
    if relaxed:
        mesh_data.carry_groups(source, made, mesh)
    made.data[SHOWN], made.data[RELAXED], made.data[WRITTEN] = digest, relaxed, content_of(made.data)


def line_of(made, asked, found):
    """How many quads there are, and why so many more than asked for. found: the session of their mesh, or None."""
    count = len(made.data.polygons)
    if found is None or count <= SAID_FROM * asked:
        return f"{count} quads"
    if found.piece_count > 1:
        return (f"{count} quads, not {asked}, because the mesh has {found.piece_count} pieces: a closed one needs six quads or more, "
            "and a thin one more to keep its form")
    return f"{count} quads, not {asked}, because fewer do not keep to the form of the mesh"


def create(source, curves, poles, window_manager, graph, faces, crease, sharp, symmetry):
    """A new object of quads, which follows from here on."""
    global known
    known = True
    found = session.session_of(source, window_manager)
    by_name = lambda objects: sorted(objects, key=lambda o: o.name)
    options = options_of(source, found, by_name(curves), by_name(poles), graph, faces, crease, sharp, symmetry)
    quads = session.watched(lambda progress: hf.Quads(found.surface, progress=progress, **options), window_manager)
    made = mesh_data.quads_object(source)
    group = made.hf_quads
    group.source, group.key = source, uuid.uuid4().hex
    group.faces, group.crease, group.sharp, group.symmetry = faces, crease, sharp, symmetry
    for obj in (*curves, *poles):
        attach(obj, group.key)
    write(made, quads.mesh(), digest_of(found, options), True, source)
    state = kept[group.key] = Kept()
    state.quads, state.surface = quads, found.surface
    state.members = names_of(*members_of(bpy.context.scene, group.key))
    state.line = line_of(made, faces, found)
    return made


def names_of(strokes, poles):
    return [o.name for o in (*strokes, *poles)]


# ---- following

def source_of(made, scene):
    source = made.hf_quads.source
    if source is None or source.type != "MESH" or scene.objects.get(source.name) != source:
        raise hf.UnsupportedError(f"the mesh that {made.name} was made of is gone")
    return source


def trouble_with(made, edits=True):
    """Why the mesh cannot be written, or None. edits: whether edits by hand count."""
    mesh = made.data
    if made.mode == "EDIT":
        return f"{made.name} follows when you leave its Edit Mode"
    if mesh.shape_keys:
        return f"{made.name} has shape keys, so it does not follow"
    if edits and mesh.get(WRITTEN) != content_of(mesh):
        return f"{made.name} was edited by hand, so it does not follow; Update quads makes it again without the edits"
    return None


def look(made, scene, graph, force=False):
    """Makes quads again if what they are made of has changed. force: also with Follow off or edited by hand, and relaxed
    at once; then errors are raised."""
    group = made.hf_quads
    state = kept.setdefault(group.key, Kept())
    strokes, poles = members_of(scene, group.key)
    state.members = names_of(strokes, poles)
    if not group.follow and not force:
        state.stop()
        return
    digest = None
    try:
        source = source_of(made, scene)
        if source.mode == "EDIT":
            source.update_from_editmode()
        found = session.session_of(source)
        options = options_of(source, found, strokes, poles, graph, group.faces, group.crease, group.sharp, group.symmetry)
        digest = digest_of(found, options)
        if not force and digest == made.data.get(SHOWN):
            stay(made, state, found, options, digest)
            return
        trouble, tried = trouble_with(made, edits=not force), digest == state.failed
        if trouble:
            digest = None  # it can go while the strokes stay
            raise hf.UnsupportedError(trouble)
        if force or not tried:
            again(made, state, found, options, digest, relaxed=force)
            if not force:
                wait(state, found, options, digest)
    except Exception as error:  # an error of any kind must not come back with every event
        state.failed = digest
        say(state, error)
        if force:
            raise


def stay(made, state, found, options, digest):
    """The mesh is that of what is there now, though it may wait for relaxation."""
    state.error, state.failed = "", None
    if digest != state.digest:
        state.stop()  # it relaxes what was there before
    if not made.data.get(RELAXED) and state.job is None and state.due is None:
        wait(state, found, options, digest)


def again(made, state, found, options, digest, relaxed):
    """Makes the mesh again and writes it."""
    begin = time.perf_counter()
    state.stop()
    state.make(found.surface, **options, **({} if relaxed else {"relax_count": hf.NO_INDEX}))
    mesh = state.quads.mesh()
    middle = time.perf_counter()
    write(made, mesh, digest, relaxed, made.hf_quads.source)
    state.error, state.failed = "", None
    done(made, state, relaxed, begin, middle)


def done(made, state, relaxed, begin, middle):
    """begin, middle: when the library was called, and when it was ready."""
    now = time.perf_counter()
    state.figures = {"library_ms": 1e3 * (middle - begin), "total_ms": 1e3 * (now - begin)}
    ms = state.figures["total_ms"]
    line = line_of(made, made.hf_quads.faces, session.session_of(made.hf_quads.source, bind=False))
    state.line = f"{line}, " + (f"relaxed in {ms / 1000:.1f} s" if relaxed else f"followed in {ms:.0f} ms")
    redraw()


def say(state, error):
    """An error goes to the panel, where it stays until quads can be made again; once also to the console."""
    text = getattr(error, "message", None) or f"{type(error).__name__}: {error}"
    if text != state.error:
        print(f"hf: quads: {text}")
    state.error = text
    redraw()


def redraw():
    manager = bpy.context.window_manager
    for window in manager.windows if manager else ():
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


# ---- relaxation, when the hand rests

def wait(state, found, options, digest):
    state.wanted, state.digest, state.due = (found.surface, options), digest, time.perf_counter() + IDLE
    if not bpy.app.background and not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=IDLE)


def begin(state):
    """Starts a relaxation on the thread."""
    state.due, state.progress, state.begun = None, hf.Progress(), time.perf_counter()
    (surface, options), progress = state.wanted, state.progress
    state.job = WORKER.submit(lambda: state.make(surface, progress=progress, **options))


def take(key, state):
    """Writes what a relaxation made, if the object still shows what it was begun with."""
    job, state.job = state.job, None
    made = made_in(bpy.context.scene).get(key)
    try:
        job.result()
        if made is None or made.data.get(SHOWN) != state.digest or trouble_with(made):
            return
        middle = time.perf_counter()
        write(made, state.quads.mesh(), state.digest, True, made.hf_quads.source)
        done(made, state, True, state.begun, middle)
    except hf.CancelledError:
        pass
    except Exception as error:
        say(state, error)


def tick():
    """The timer. Blender calls it again after the seconds that it returns; None: never."""
    for key, state in list(kept.items()):
        if state.job is not None and state.job.done():
            take(key, state)
        elif state.job is None and state.due is not None and time.perf_counter() >= state.due:
            begin(state)
    return POLL if any(state.job is not None or state.due is not None for state in kept.values()) else None


def finish():
    """Relaxes now what waits for it, and returns when it is ready: for scripts, which have no timers."""
    for key, state in list(kept.items()):
        if state.job is None and state.due is not None:
            begin(state)
        if state.job is not None:
            state.job.exception()
            take(key, state)


# ---- events

def know(scene):
    """The quads of a scene. Those that are new follow from the next change on; those that are in no scene are dropped."""
    global known
    found = {each: made_in(each) for each in bpy.data.scenes}
    keys = {key for held in found.values() for key in held}
    known = bool(keys)
    forget(kept.keys() - keys)
    for key in found[scene].keys() - kept.keys():
        state = kept[key] = Kept()
        state.members = names_of(*members_of(scene, key))
    return found[scene]


def on_depsgraph(scene, graph):
    """Looks at the quads that an update is about."""
    if known is False:
        return
    changed = {u.id.original for u in graph.updates if isinstance(u.id, bpy.types.Object)
        and (u.is_updated_transform or u.is_updated_geometry)}
    for key, made in know(scene).items():
        state = kept[key]
        strokes, poles = members_of(scene, key)
        idle = state.job is None and state.due is None
        if state.members != names_of(strokes, poles) or not changed.isdisjoint({made.hf_quads.source, *strokes, *poles}) \
                or made in changed and (state.error or idle and not made.data.get(RELAXED)):
            look(made, scene, graph)


def look_at_all(scene):
    """After undo and redo nobody knows what has changed."""
    found = know(scene)
    if found:
        graph = bpy.context.evaluated_depsgraph_get()
        for made in found.values():
            look(made, scene, graph)


# ---- strokes and poles

def add_stroke(made):
    """An empty curve that quads follow, to be drawn."""
    line = bpy.data.curves.new(f"{made.name} stroke", "CURVE")
    line.dimensions = "3D"
    obj = bpy.data.objects.new(line.name, line)
    for collection in made.users_collection:
        collection.objects.link(obj)
    attach(obj, made.hf_quads.key)
    return obj


def add_pole(made, count, place):
    """An empty on the source, where 3 or 5 quads are to meet."""
    source = source_of(made, bpy.context.scene)
    at = np.array((source.matrix_world.inverted_safe() @ place)[:])
    found = session.session_of(source)
    vertex = source.data.vertices[found.surface.find_vertex(at)[0]]
    obj = bpy.data.objects.new(f"{made.name} pole {count}", None)
    obj.empty_display_type, obj.empty_display_size = "ARROWS", 0.05 * mesh_data.size_of(source.data)
    for collection in made.users_collection:
        collection.objects.link(obj)
    obj[POLE] = count
    attach(obj, made.hf_quads.key)
    turn = Vector(vertex.normal).to_track_quat("Z", "Y")
    obj.matrix_world = Matrix.Translation(source.matrix_world @ Vector(found.rest[vertex.index].tolist())) @ (
        source.matrix_world.to_quaternion() @ turn).to_matrix().to_4x4()
    return obj
