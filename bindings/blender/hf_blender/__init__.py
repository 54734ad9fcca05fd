"""hf for Blender: harmonic fields, posing with handles that come and go, motion transfer."""

bl_info = {
    "name": "hf: dynamic harmonic fields", "author": "hf", "version": (0, 1, 0), "blender": (3, 0, 0), "category": "Mesh",
    "location": "View3D > Sidebar > hf",
    "description": "Pose meshes with handles added at any time, harmonic fields, weights, motion transfer, quads",
}

import pathlib
import sys
import time

_vendor = str(pathlib.Path(__file__).resolve().parent / "vendor")  # the package hf with libhf.so
if _vendor not in sys.path:
    sys.path.insert(0, _vendor)

import hf  # noqa: E402
import bpy  # noqa: E402
from bpy.app.handlers import persistent  # noqa: E402

from . import armatures, carriers, copies, operators, paint, paint_operators, panels, quad_operators, quads  # noqa: E402
from . import retarget, rig, session, skinning  # noqa: E402
from .operators import refresh  # noqa: E402


# A painted group is read when the brush has rested for so many seconds: 50,000 vertices take 20 ms to read. Half of it would
# catch a hand between two strokes, double it is seen as a wait.
PAINT_WAIT = 0.2
painted_at = 0.0  # when Blender last told of a stroke


def follow(scene, keys=None):
    """Solves the poses of these meshes, or of all with handles, where something has changed: leaving Edit Mode and a rendered
    picture are events too. A mesh of a file that was opened binds now."""
    if keys is None:
        keys = carriers.carriers_in(scene.objects).keys() | session.sessions.keys()
    keys = keys - session.unbound.keys()
    # a list: a handle may go meanwhile, and its empty with it
    for obj in [o for o in scene.objects if o.type == "MESH" and o.get("hf_key") in keys and o.mode != "EDIT"]:
        try:
            refresh(obj, again=False)
        except hf.HfError as error:
            print(f"hf: {obj.name}: {error.message}")


def look_at_edits(depsgraph):
    """The keys of meshes that an edit has changed, once Edit Mode is left."""
    keys = set()
    for update in depsgraph.updates:
        obj = update.id.original
        if not isinstance(obj, bpy.types.Object) or obj.type != "MESH" or not update.is_updated_geometry:
            continue
        key, found = obj.get("hf_key"), session.sessions.get(obj.get("hf_key"))
        if obj.mode == "EDIT":
            if found:
                found.editing = True
        elif found and (found.editing or len(found.rest) != len(obj.data.vertices)):
            found.editing = not found.fits(obj.data)
            if found.editing:
                keys.add(key)
        elif session.unbound.pop(key, None):  # perhaps it can be followed now
            keys.add(key)
    return keys


def look_at_paint(scene, depsgraph):
    """Meshes whose painted groups may have changed are read again: at once, or when the brush rests."""
    global painted_at
    changed = {update.id.original for update in depsgraph.updates if isinstance(update.id, bpy.types.Mesh)}
    keys = set()
    for obj in scene.objects if changed and session.sessions else ():
        found = session.sessions.get(obj.get("hf_key")) if obj.type == "MESH" and obj.data in changed else None
        if found is None:
            continue
        ours, found.wrote = found.wrote, False
        if (obj.mode == "WEIGHT_PAINT" or not ours) and obj.mode != "EDIT" and (paint.PINS in obj or paint.STIFF_GROUP in obj):
            found.repainted = True
            keys.add(obj["hf_key"])
    if bpy.app.background or not keys:
        return keys
    painted_at = time.monotonic()
    if not bpy.app.timers.is_registered(on_paint):
        bpy.app.timers.register(on_paint, first_interval=PAINT_WAIT)
    return set()


def on_paint():
    """The timer of painted groups. Blender calls it again after the seconds that it returns; None: never."""
    rest = painted_at + PAINT_WAIT - time.monotonic()
    if rest > 0:
        return rest
    if bpy.context.scene.hf_live:
        follow(bpy.context.scene, {key for key, found in session.sessions.items() if found.repainted})
    return None


@persistent
def on_depsgraph(scene, depsgraph):
    if operators.busy() or depsgraph.mode == "RENDER":
        return
    repainted = look_at_paint(scene, depsgraph)
    with operators.quiet():
        copies.part()
        quads.on_depsgraph(scene, depsgraph)
    edited = look_at_edits(depsgraph)
    if not scene.hf_live:
        return
    for key in {u.id[skinning.KEY] for u in depsgraph.updates if isinstance(u.id, bpy.types.Object)
            and u.id.type == "EMPTY" and u.is_updated_transform and skinning.KEY in u.id}:
        try:
            with operators.quiet():
                skinning.follow_pins(key)
        except hf.HfError as error:
            print(f"hf: {error.message}")
    keys = edited | repainted
    for update in depsgraph.updates:
        item = update.id
        if not isinstance(item, bpy.types.Object):
            continue
        if item.type == "EMPTY" and update.is_updated_transform and "hf_key" in item:
            found = session.sessions.get(item["hf_key"])
            if found is None or found.stood.get(item.get("hf_id")) != armatures.stand_of(item.original):
                keys.add(item["hf_key"])
        elif item.type == "ARMATURE" and item.get("hf_bones"):  # moved, or posed
            keys |= {bone["hf_key"] for bone in carriers.bones_of(item.original)}
    held = carriers.carriers_in(scene.objects)
    keys |= {key for key, found in session.sessions.items() if found.numbers.keys() != held.get(key, {}).keys()}
    if keys:
        follow(scene, keys)


@persistent
def on_frame(scene, depsgraph=None):
    if depsgraph is not None and retarget.play(scene, depsgraph) and session.sessions:
        with operators.quiet():
            depsgraph.view_layer.update()  # bones that carry handles have moved
    if scene.hf_live:
        follow(scene)


def on_lengths(scene, context):
    if scene.hf_live:
        follow(scene)


def on_handle(carrier, context):
    if context.scene.hf_live and not operators.busy() and "hf_key" in carrier:
        follow(context.scene, {carrier["hf_key"]})


@persistent
def on_undo(*_):
    skinning.groups_changed()
    session.look_again()
    with operators.quiet():
        copies.part(always=True)
        bpy.context.view_layer.update()  # after an undo Blender 5 has no place of an object until it is evaluated
    if bpy.context.scene.hf_live:
        follow(bpy.context.scene)
    with operators.quiet():
        quads.look_at_all(bpy.context.scene)


@persistent
def on_load(*_):
    skinning.forget()
    rig.forget_motions()
    retarget.forget()
    session.forget_all()
    copies.known = 0
    quads.forget()
    quads.known = None


CLASSES = (*operators.OPERATORS, *paint_operators.CLASSES, *quad_operators.CLASSES, *panels.PANELS)
CARRIERS = (bpy.types.Object, bpy.types.PoseBone)  # of handles
HANDLERS = (("depsgraph_update_post", on_depsgraph), ("frame_change_post", on_frame), ("undo_post", on_undo),
    ("redo_post", on_undo), ("load_post", on_load))


def register():
    hf.version()  # the library is loaded here, and what is wrong with it is said here
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.hf_live = bpy.props.BoolProperty(name="Live", default=True,
        description="Follow the handles while they are dragged")
    bpy.types.Scene.hf_lengths = bpy.props.BoolProperty(name="Keep lengths", default=False, update=on_lengths,
        description="Limbs keep their length and thickness; bends get sharper, and a pose takes longer")
    for carrier in CARRIERS:
        carrier.hf_following = bpy.props.FloatProperty(name="How much follows", default=1, min=0, max=1, update=on_handle,
            description="1: the whole mesh follows this handle; 0: its limb alone, such as an arm")
        carrier.hf_limb = bpy.props.BoolProperty(name="Keep lengths of the limb", update=on_handle,
            description="The limb of this handle keeps its lengths and bends like two bones; the rest stays as it is")
    bpy.types.Object.hf_source = bpy.props.PointerProperty(name="Follows", type=bpy.types.Object,
        poll=lambda self, other: other.type == "ARMATURE" and other != self,
        description="The armature whose motion this one plays; clear it and the bones stay as they are")
    bpy.types.Object.hf_quads = bpy.props.PointerProperty(type=quad_operators.HF_PG_quads)
    for name, (label, neutral, least, most, description) in operators.DIALS.items():
        unit = {"subtype": "ANGLE"} if name == "arm_space" else {}
        setattr(bpy.types.Scene, f"hf_{name}", bpy.props.FloatProperty(name=label,
            default=neutral, min=least, max=most, description=description, **unit))
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister():
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).remove(function)
    for timer in (quads.tick, on_paint):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    quads.forget()
    quads.known = None
    skinning.forget()
    rig.forget_motions()
    retarget.forget()
    session.forget_all()
    for carrier in CARRIERS:
        del carrier.hf_following, carrier.hf_limb
    del bpy.types.Object.hf_source
    del bpy.types.Object.hf_quads
    del bpy.types.Scene.hf_live
    del bpy.types.Scene.hf_lengths
    for name in operators.DIALS:
        delattr(bpy.types.Scene, f"hf_{name}")
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
