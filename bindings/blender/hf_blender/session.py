"""What a bound mesh keeps while Blender runs: its surface, its pose, and which carrier stands for which handle.

The scene is the truth (carriers.py); sync() brings the pose in line with it. Nothing here factorises twice: handles
come and go on the factor made at bind.
"""

import time
import uuid
from concurrent.futures import ThreadPoolExecutor, wait

import bpy
import numpy as np
from mathutils import Quaternion, Vector

import hf

from . import armatures, carriers, edits, mesh_data, paint, standing
from .mesh_data import faces_of, group_vertices

# The quickest to bind: on meshes of this size minimum degree is ordered in a fifth of the time that nested dissection
# takes, and the factorisation loses less than that (50,000 vertices: 18 and 104 ms; 200,000: 86 and 461 ms).
ORDERING = hf.constants.HF_ORDERING_MINIMUM_DEGREE
ORDERING_LIMIT = 300000  # vertices; above it nested dissection, the library's default

IDENTITY = np.eye(4)
# Keeping lengths takes so many steps of as-rigid-as-possible on the whole surface, from the smooth pose on: the least
# that hf_deform_desc gives for it. More make bends sharper. 50,000 vertices take 0.15 s more on two threads of a slow EPYC.
LENGTH_STEPS = 8
# Gaps below this share of the box are not said: a newcomer does not see them.
GAP_SAID = 0.005

# One thread makes all surfaces, so that one finds the memory that another gave back.
WORKER = ThreadPoolExecutor(1, "hf")

sessions = {}
unbound = {}  # key -> why an edit could not be followed; the handles wait until the mesh is mended
figures = {"bind_ms": 0.0, "update_ms": 0.0, "sync_ms": 0.0}


def watched(make, window_manager=None, meanwhile=None):
    """What make(progress) returns, made on a thread of its own, so that Blender's progress bar moves. `meanwhile` is called
    on this thread."""
    progress, made = hf.Progress(), {}

    def work():
        try:
            made["it"] = make(progress)
        except BaseException as error:  # noqa: BLE001 - raised again below
            made["error"] = error

    worker = WORKER.submit(work)
    if window_manager:
        window_manager.progress_begin(0, 100)
    try:
        if meanwhile:
            meanwhile()
    finally:
        while wait([worker], 0.05).not_done:
            if window_manager:
                window_manager.progress_update(int(100 * progress.fraction))
        if window_manager:
            window_manager.progress_end()
    if "error" in made:
        raise made["error"]
    return made["it"]


def make_surface(positions, faces, window_manager=None, meanwhile=None, **options):
    """A surface; options as hf.Surface."""
    if not len(faces[0]):
        raise hf.EmptyError("the mesh has no faces")
    order = ORDERING if len(positions) <= ORDERING_LIMIT else hf.constants.HF_ORDERING_NESTED_DISSECTION
    return watched(lambda progress: hf.Surface(positions, faces=faces, progress=progress, thread_count=2, ordering=order,
        **options), window_manager, meanwhile)


def handles_of(obj):
    """The carriers of a mesh, those that wait to be moved among them."""
    return [*carriers.carriers_of(obj["hf_key"]).values(), *carriers.offered(obj["hf_key"])] if "hf_key" in obj else []


def surface_of(mesh, rest, old, window_manager, meanwhile):
    """The surface of a mesh as it is now, linked over its gaps. old: the session of the mesh before an edit, or None. This
    function alone has to change when the library can replace triangles of a surface that was factorised."""
    if old:
        old.close()  # the new one finds its memory
    return make_surface(rest, faces_of(mesh), window_manager, meanwhile, link_pieces=True)


class Session:
    def __init__(self, obj, window_manager=None, meanwhile=None, old=None):
        mesh = obj.data
        begin = time.perf_counter()
        if handles_of(obj) and mesh_data.numbers_of(mesh) is None:
            raise hf.ConflictError(f"all vertices of {obj.name} are new, as after a remesh")
        self.rest, self.faces = mesh_data.edited_rest(mesh), faces_of(mesh)
        self.editing = False  # the mesh is or was in Edit Mode or undone, and has not been looked at since
        self.repainted = False  # a stroke or an undo may have changed what is painted, which has not been read since
        self.surface = surface_of(mesh, self.rest, old, window_manager, meanwhile)
        pieces, self.light = self.surface.pieces()
        self.piece_count = len(np.unique(pieces[mesh_data.on_surface(mesh)]))
        self.info = hf.DeformInfo()
        self.remarks = []  # sentences for the panel
        self.stiffness = np.ones(len(self.rest))  # by vertex, of the surface
        self.painted = np.empty(0, np.uint32)  # the vertices that are pinned by painting
        self.pin = None  # the handle that holds those of them that no other handle has
        self.stale = True  # that handle has to be looked at, and what the mesh keeps of all regions
        self.place_of = None  # mesh_data.places_of, once it is asked for
        self.paint_error = ""  # why what is painted now cannot be taken
        self.wrote = False  # Blender has yet to tell of our own change of the mesh
        self.pose = hf.Pose(self.surface)
        self.numbers = {}  # hf_id -> handle
        self.free = set()  # hf_id of handles whose rotation the pose finds
        self.limbs = {}  # hf_id -> how much follows, and the steps on the limb, of handles of layer 0
        self.placed = {}  # hf_id -> matrix of the last update
        self.told = None  # all else that the last pose was solved with
        self.standing = None  # what the shown shape has beside the pose
        self.mover = ""  # the armature that moves the handles
        self.stood = {}  # hf_id -> where a carrier stood in the last update, without what the armature does
        self.posed = self.rest.copy()
        obj["hf_key"] = obj.get("hf_key") or uuid.uuid4().hex
        carriers.name(obj)
        edit = edits.take(obj, self.rest, handles_of(obj))  # since the last bind; nothing is written before
        mesh_data.number_vertices(mesh)
        self.follow_paint(obj)
        armatures.carry_all(obj, handles_of(obj), anew=True)
        figures["bind_ms"] = 1e3 * (time.perf_counter() - begin)
        self.note = edit.sentence(figures["bind_ms"], paint.words_of(obj, self)) if edit else ""
        self.noted = False  # the panel has shown it
        self.undone = False  # the mesh and its handles may be those of another moment
        self.stand(obj, not (edit and edit.lost))

    def close(self):
        if not self.surface.closed:
            self.pose.close()
            self.surface.close()

    def stand(self, obj, stays=True):
        """Goes on from the pose that the mesh shows. stays: as in standing.start."""
        self.undone = False
        if mesh_data.POSED in obj.data.attributes and not np.array_equal(mesh_data.positions_of(obj.data), self.posed):
            if self.numbers:
                self.pose.close()
                self.pose = hf.Pose(self.surface)
                self.numbers, self.pin, self.free, self.limbs, self.stale = {}, None, set(), {}, True
            self.standing = standing.start(self, obj, mesh_data.positions_of(obj.data), stays)

    def take_paint(self, obj):
        """Takes what is painted on the mesh. Nothing is factorised again for a stroke of some hundred vertices, and the handles
        stay. A group that is renamed or removed changes nothing: the panel says so."""
        pins = self.painted if paint.lost_group(obj, paint.PINS) else paint.pins_of(obj)
        stiffness = self.stiffness if paint.lost_group(obj, paint.STIFF_GROUP) else paint.stiffness_of(obj, self)
        if not np.array_equal(stiffness, self.stiffness):
            edited = self.surface.edit(stiffness=stiffness)
            self.pose.move_to(edited)
            self.surface.close()
            self.surface, self.stiffness = edited, stiffness
            self.placed = {}  # the same handles, another pose
        if not np.array_equal(pins, self.painted):
            self.painted, self.stale, self.placed = pins, True, {}
        self.paint_error = ""

    def follow_paint(self, obj):
        """take_paint(), and what is wrong with it goes to the panel."""
        self.repainted = False
        try:
            self.take_paint(obj)
        except hf.HfError as error:
            self.paint_error = error.message

    def unheld(self, held):
        """The painted vertices that no handle has, nor a vertex at the same place, which the library takes as one."""
        if not len(self.painted) or not held:
            return self.painted
        taken = np.concatenate([np.array(carrier["hf_vertices"], np.int64) for carrier in held])
        places = self.places()
        return self.painted[~np.isin(places[self.painted], places[taken])]

    def places(self):
        if self.place_of is None:
            self.place_of = mesh_data.places_of(self.rest)
        return self.place_of

    def sync(self, obj, posed=False):
        """Handles for new carriers and for painted pins, none for those that have gone. posed: carriers that were in the pose
        which the mesh shows, alone."""
        begin = time.perf_counter()
        found = carriers.carriers_of(obj["hf_key"])
        if posed:
            found = {i: carrier for i, carrier in found.items() if carriers.PLACED in carrier}
        gone = [i for i in self.numbers if i not in found]
        fresh = [i for i in found if i not in self.numbers]
        self.stale = self.stale or bool(gone or fresh)
        modifier = armatures.modifier_of(obj)
        mover = modifier.object.name_full if modifier else ""
        if self.stale or mover != self.mover:
            self.mover = mover
            armatures.carry_all(obj, handles_of(obj))
        if self.stale and self.pin is not None:
            self.pose.remove_handles([self.pin])
            self.pin = None
        if gone:
            self.pose.remove_handles([self.numbers[i] for i in gone])
            for i in gone:
                del self.numbers[i]
                self.limbs.pop(i, None)
            self.free.difference_update(gone)
        for layer in sorted({int(found[i].get("hf_layer", 0)) for i in fresh}):
            batch = [i for i in fresh if int(found[i].get("hf_layer", 0)) == layer]
            regions = [np.array(found[i]["hf_vertices"], np.uint32) for i in batch]
            for i, number in zip(batch, self.pose.add_handles(regions, layer=layer)):
                self.numbers[i] = int(number)
        if self.stale:
            pins = self.unheld(list(found.values()))
            self.pin = int(self.pose.add_handles([pins])[0]) if len(pins) else None
            mesh_data.keep_regions(obj.data, [carrier["hf_vertices"] for carrier in handles_of(obj)])
            self.stale = False
        figures["sync_ms"] = 1e3 * (time.perf_counter() - begin)
        return found

    def free_rotations(self, found, motions):
        """A drag frees the rotation of its handle; turning the empty gives it."""
        diagonal = self.surface.report.bounding_box_diagonal or 1.0
        for (i, carrier), motion in zip(found.items(), motions):
            x, y, z, w = self.pose.handle(self.numbers[i]).rotation
            carriers.look_at(carrier, motion, Quaternion((w, x, y, z)), diagonal)
        wanted = {i for i, carrier in found.items() if carrier.get(carriers.FREE)}
        for changed, free in ((wanted - self.free, True), (self.free - wanted, False)):
            if changed:
                self.pose.set_free_rotations([self.numbers[i] for i in sorted(changed)], free)
        self.free = wanted

    def set_limbs(self, found):
        """Tells the pose how much follows, and whose limbs keep their lengths, where that has changed."""
        wanted = {i: (c.hf_following, LENGTH_STEPS * c.hf_limb) for i, c in found.items() if not c["hf_layer"]}
        for k, tell in enumerate((self.pose.set_following, self.pose.set_limb_refine)):
            for value in sorted({both[k] for both in wanted.values()}):
                changed = [self.numbers[i] for i, both in wanted.items()
                    if both[k] == value and self.limbs.get(i, (1.0, 0))[k] != value]
                if changed:
                    tell(changed, value)
        self.limbs = wanted

    def steps(self):
        return LENGTH_STEPS if bpy.context.scene.hf_lengths else 0

    def conditions(self, found):
        """All that a pose is solved with, beside the places of its handles. In another frame it is solved again."""
        return (set(found), set(self.free), self.limbs, self.pin, self.steps(), bpy.context.scene.frame_current_final)

    def remarks_of(self, found):
        """What the pose leaves behind: vertices that no handle reaches, gaps between pieces, handles on light pieces."""
        out, diagonal = [], self.surface.report.bounding_box_diagonal or 1.0
        if self.info.unreached_vertex_count:
            out.append(f"{self.info.unreached_vertex_count} vertices are reached by no handle and stay at rest")
        gaps = hf.GapsInfo()
        self.surface.measure_gaps(self.posed, info=gaps)
        if gaps.link_count and gaps.worst > GAP_SAID * diagonal:
            out.append(f"Gap between pieces: {100 * gaps.worst / diagonal:.1f} % of the box at worst")
        for carrier in found.values():
            if np.mean(self.light[np.array(carrier["hf_vertices"], np.uint32)]) > 0.5:
                out.append(f"{carrier.name} lies on a light piece: it hardly pulls the rest")
        return [self.note] * bool(self.note) + out

    def fits(self, mesh):
        """Whether a mesh is still the one that was bound: no edit has changed it, and no undo."""
        return all(map(np.array_equal, self.faces, faces_of(mesh))) and np.array_equal(self.rest, mesh_data.edited_rest(mesh))

    def update(self, obj, again=True):
        """The pose from where the carriers stand, into the mesh. again: also where nothing has changed in this frame; a solve
        goes on from the last one, so the pose settles and the mesh moves."""
        begin = time.perf_counter()
        if self.pose.handle_count:
            mesh_data.refuse_shape_keys(obj)
        found = self.sync(obj)
        if found:
            motions = [carriers.motion_of(obj, carrier) for carrier in found.values()]
            self.free_rotations(found, motions)
            self.set_limbs(found)
            matrices = np.array([carriers.turned(m, carrier) for m, carrier in zip(motions, found.values())])
            moved = any(not np.array_equal(self.placed.get(i, IDENTITY), m) for i, m in zip(found, matrices))
            told = self.conditions(found)
            if again or moved or told != self.told or not np.array_equal(mesh_data.positions_of(obj.data), self.posed):
                self.solve(found, matrices)
            self.note = "" if moved and self.noted else self.note
            self.remarks, self.noted = self.remarks_of(found), True
            self.placed, self.told = dict(zip(found, matrices)), told
            self.stood = {i: armatures.stand_of(carrier).copy() for i, carrier in found.items() if armatures.carried(carrier)}
        else:
            self.posed[:] = self.rest
            moved, self.remarks, self.told, self.standing = True, [], None, None
        # a mesh that is as it should be stays untouched: Blender would recompute its normals and its box
        if moved or not np.array_equal(mesh_data.positions_of(obj.data), self.posed):
            mesh_data.keep_pose(obj.data, self.rest, self.posed)
            self.wrote = True
        figures["update_ms"] = 1e3 * (time.perf_counter() - begin)

    def solve(self, found, matrices):
        given, share, sent = dict(zip(found, matrices)), 0.0, matrices
        if self.standing:
            share = self.standing.share(given, self.free)
            sent = self.standing.shifted(given, share, self.free)
        self.pose.set_matrices([self.numbers[i] for i in found], sent)
        iterations = standing.SETTLING if self.jumps(given) else 0
        self.pose.deform(self.posed, info=self.info, iteration_count=iterations, refine=self.steps())
        if share > 0:
            self.posed[:] = self.posed + share * self.standing.offset
        else:
            self.standing = None
        standing.keep(self, found, matrices, sent)


    def jumps(self, given):
        """Whether a handle goes far at once, as by a typed distance. Such a pose is solved to its end; else the frames after
        it would go on moving the mesh. A drag comes in small steps and settles on its way."""
        far = standing.JUMP * (self.surface.report.bounding_box_diagonal or 1.0)
        for i, motion in given.items():
            step = motion - self.placed.get(i, IDENTITY)
            way = step @ np.append(self.pose.handle(self.numbers[i]).centroid, 1)
            if np.linalg.norm(way[:3]) > far or np.abs(step[:3, :3]).max() > standing.TURN_JUMP:
                return True
        return False


def forget_removed():
    """Drops what was kept for removed objects. If undo brings one back, its next use binds it again."""
    there = {obj.get("hf_key") for obj in bpy.data.objects if obj.type == "MESH"}
    for key in sessions.keys() - there:
        sessions.pop(key).close()


def session_of(obj, window_manager=None, bind=True, meanwhile=None):
    """The session of a mesh object, made when there is none. meanwhile: called once, while the mesh is factorised when
    that is necessary."""
    if obj is None or obj.type != "MESH":
        raise hf.InvalidArgumentError("select a mesh object")
    key = obj.get("hf_key")
    found, old = sessions.get(key), None
    if not bind:
        return found
    if found and obj.mode != "EDIT" and (found.editing or len(found.rest) != len(obj.data.vertices)):
        found.editing = False
        if not found.fits(obj.data):
            found, old = None, sessions.pop(key)
        else:
            found.repainted = True
    if found:
        if found.repainted and obj.mode != "EDIT":
            found.follow_paint(obj)
        if found.undone and obj.mode != "EDIT":
            found.stand(obj)
        if meanwhile:
            meanwhile()
        return found
    other = next((o for o in bpy.data.objects if o != obj and o.data == obj.data and o.get("hf_key") != key and "hf_key" in o), None)
    if other:
        if old:
            old.close()
        raise hf.ConflictError(f"{obj.name} shares its mesh with {other.name}, which has handles; make it a single user first")
    forget_removed()
    unbound.pop(key, None)
    try:
        made = Session(obj, window_manager, meanwhile, old)
    except hf.HfError as error:
        if old:
            old.close()
        if key and handles_of(obj):
            unbound[key] = f"The handles of {obj.name} cannot follow the edit: {error.message}"
        raise
    sessions[obj["hf_key"]] = made
    return made


def look_again():
    """After an undo every mesh may be another: the next use compares it with what was bound."""
    unbound.clear()
    for found in sessions.values():
        found.editing = found.repainted = found.stale = found.undone = True


def forget_all():
    """Drops what was kept for all meshes. The next use binds again, from the rest positions kept in the mesh."""
    unbound.clear()
    for key in list(sessions):
        sessions.pop(key).close()


def forget(obj):
    """Rest positions back, handles and properties away."""
    if obj is None or obj.type != "MESH":
        raise hf.InvalidArgumentError("select a mesh object")
    key = obj.get("hf_key")
    session = sessions.pop(key, None)
    unbound.pop(key, None)
    for carrier in handles_of(obj):
        carriers.unmark(carrier)
    for name in (paint.STIFF, paint.STIFF_GROUP, paint.PINS):
        obj.pop(name, None)
    mesh_data.restore_rest(obj.data)
    carriers.strip(obj)
    if session:
        session.close()


def take_up(obj, made):
    """Handles for the carriers just made; all of them or none."""
    try:
        session_of(obj).sync(obj)
    except hf.HfError:
        for carrier in made:
            carriers.unmark(carrier)
        raise
    return made


def add_handles(obj, regions, names, layer=0):
    """An empty at the centre of each region of the mesh at rest; all of them or none."""
    session = session_of(obj)
    mesh_data.refuse_shape_keys(obj)
    session.sync(obj)
    for vertices, name in zip(regions, names):
        if not len(vertices):
            raise hf.EmptyError(f"no vertex in {name}")
    diagonal = session.surface.report.bounding_box_diagonal
    return take_up(obj, [carriers.make_empty(obj, name, vertices, session.rest, diagonal, layer) for vertices,
        name in zip(regions, names)])


def add_bones(obj, armature, layer=0, share=0.5):
    """The deforming bones of an armature become handles: the mesh follows them as they are posed or animated."""
    if armature is None or armature.type != "ARMATURE":
        raise hf.InvalidArgumentError("select an armature and the mesh")
    session = session_of(obj)
    mesh_data.refuse_shape_keys(obj)
    session.sync(obj)
    named = [bone.name for bone in armature.pose.bones if bone.name in obj.vertex_groups]
    groups = dict(zip(named, mesh_data.groups_vertices(obj, named)))
    return take_up(obj, carriers.mark_bones(obj, armature, session.rest, groups, layer, share))


def field_between(obj, high, low):
    """The harmonic field that is 1 on one group and 0 on another, from the mesh's factor."""
    session = session_of(obj)
    ones, zeros = group_vertices(obj, high), group_vertices(obj, low)
    there = set(zeros)
    both = [v for v in ones if v in there]
    if both:
        raise hf.ConflictError(f"vertex {both[0]} is in both groups", index=both[0])
    with hf.Solver(session.surface) as solver:
        solver.add_sites(ones + zeros, [1.0] * len(ones) + [0.0] * len(zeros))
        return solver.solve()
