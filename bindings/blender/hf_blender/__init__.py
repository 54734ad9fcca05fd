"""hf for Blender: harmonic fields, posing with handles that come and go, motion transfer."""

bl_info = {"name": "hf: dynamic harmonic fields", "author": "hf", "version": (0, 1, 0), "blender": (3, 0, 0), "location": "View3D > Sidebar > hf",
           "description": "Pose meshes with handles added at any time, harmonic fields, weights, motion transfer", "category": "Mesh"}

import contextlib
import pathlib
import sys

_vendor = str(pathlib.Path(__file__).resolve().parent / "vendor")  # the package hf with libhf.so
if _vendor not in sys.path:
    sys.path.insert(0, _vendor)

import hf  # noqa: E402
import bpy  # noqa: E402
from bpy.app.handlers import persistent  # noqa: E402

from . import session  # noqa: E402


def guarded(execute):
    """An operator's failure is a sentence in the status bar, with nothing changed."""
    def run(self, context):
        try:
            return execute(self, context) or {"FINISHED"}
        except hf.HfError as error:
            self.report({"ERROR"}, error.message)
            return {"CANCELLED"}
    return run


def mesh_of(context):
    """The active mesh, or the mesh of the active handle."""
    active = context.active_object
    if active is not None and active.type == "EMPTY" and "hf_key" in active:
        return next((o for o in bpy.data.objects if o.type == "MESH" and o.get("hf_key") == active["hf_key"]), None)
    return active


class HF_OT_bind(bpy.types.Operator):
    """Factorise the mesh once; handles, fields and poses then take milliseconds"""
    bl_idname, bl_label, bl_options = "hf.bind", "Bind", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        session.session_of(mesh_of(context), context.window_manager)


class HF_OT_unbind(bpy.types.Operator):
    """Back to the rest shape, without handles"""
    bl_idname, bl_label, bl_options = "hf.unbind", "Unbind", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        session.forget(mesh_of(context))


class HF_OT_add_handle(bpy.types.Operator):
    """A handle from the selected vertices or from a vertex group; the pose stays"""
    bl_idname, bl_label, bl_options = "hf.add_handle", "Add handle", {"REGISTER", "UNDO"}
    group: bpy.props.StringProperty(name="Vertex group", description="Empty: the selected vertices")
    layer: bpy.props.IntProperty(name="Layer", min=0, max=7)

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        session.session_of(obj, context.window_manager)
        vertices = session.group_vertices(obj, self.group) if self.group else session.selected_vertices(obj)
        mode = obj.mode
        if mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")
        with quiet():
            session.add_handles(obj, [vertices], [self.group or "handle"], self.layer)
        refresh(obj)
        if mode == "EDIT":
            bpy.ops.object.mode_set(mode=mode)


class HF_OT_add_groups(bpy.types.Operator):
    """A handle for every vertex group whose name starts with the prefix"""
    bl_idname, bl_label, bl_options = "hf.add_groups", "Handles from groups", {"REGISTER", "UNDO"}
    prefix: bpy.props.StringProperty(name="Prefix", default="hf ")

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        session.session_of(obj, context.window_manager)
        names = [g.name for g in obj.vertex_groups if g.name.startswith(self.prefix)]
        if not names:
            raise hf.EmptyError(f"no vertex group starts with '{self.prefix}'")
        with quiet():
            session.add_handles(obj, session.groups_vertices(obj, names), [name[len(self.prefix):] for name in names])
        refresh(obj)


class HF_OT_remove_handle(bpy.types.Operator):
    """Remove the active handle; the others keep their places"""
    bl_idname, bl_label, bl_options = "hf.remove_handle", "Remove handle", {"REGISTER", "UNDO"}
    name: bpy.props.StringProperty(name="Handle", description="Empty: the active object")

    @guarded
    def execute(self, context):
        empty = bpy.data.objects.get(self.name) if self.name else context.active_object
        if empty is None or "hf_id" not in empty:
            raise hf.NoSuchHandleError("the active object is no handle")
        obj = next((o for o in bpy.data.objects if o.type == "MESH" and o.get("hf_key") == empty["hf_key"]), None)
        bpy.data.objects.remove(empty)
        if obj:
            context.view_layer.objects.active = obj
            refresh(obj)


class HF_OT_update(bpy.types.Operator):
    """Solve the pose now (with Live off)"""
    bl_idname, bl_label, bl_options = "hf.update", "Update", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        refresh(mesh_of(context))


class HF_OT_field(bpy.types.Operator):
    """A harmonic field as a vertex group or as coloured strips"""
    bl_idname, bl_label, bl_options = "hf.field", "Field", {"REGISTER", "UNDO"}
    high: bpy.props.StringProperty(name="1 on", description="Vertex group where the field is 1; empty: the active handle's field")
    low: bpy.props.StringProperty(name="0 on", description="Vertex group where the field is 0")
    output: bpy.props.EnumProperty(name="As", items=[("GROUP", "Vertex group", ""), ("COLOUR", "Colour attribute", "")])
    name: bpy.props.StringProperty(name="Name", default="hf field")

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        if self.high or self.low:
            values = session.field_between(obj, self.high, self.low)
        else:
            active, found = context.active_object, session.session_of(obj)
            found.sync(obj)
            if active.get("hf_id") not in found.numbers:
                raise hf.NoSuchHandleError("make a handle the active object, or name two vertex groups")
            values = found.pose.handle_field(found.numbers[active["hf_id"]])
        (session.write_group if self.output == "GROUP" else session.write_colour)(obj, self.name, values)


class HF_OT_weights(bpy.types.Operator):
    """Write the pose as vertex groups and an armature with one bone per cluster, standing as the pose stands"""
    bl_idname, bl_label, bl_options = "hf.weights", "Weights and armature", {"REGISTER", "UNDO"}
    count: bpy.props.EnumProperty(name="Bones per vertex", items=[("4", "4", ""), ("8", "8", "")])

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        found = session.session_of(obj)
        found.update(obj)
        skin = found.pose.skin(int(self.count))
        armature = session.write_skin(obj, skin, f"{obj.name} weights")
        session.pose_bones(armature, skin)
        context.scene.hf_live = False  # the armature moves the mesh from here on


class HF_OT_transfer(bpy.types.Operator):
    """Play the motion of another selected mesh on the active one, through equally named vertex groups"""
    bl_idname, bl_label, bl_options = "hf.transfer", "Transfer animation", {"REGISTER", "UNDO"}
    source: bpy.props.StringProperty(name="Source", description="Empty: the other selected mesh")
    prefix: bpy.props.StringProperty(name="Prefix", default="hf ")
    start: bpy.props.IntProperty(name="Start", default=1)
    end: bpy.props.IntProperty(name="End", default=24)
    scale: bpy.props.FloatProperty(name="Scale", min=0, description="Lengths of the target over those of the source; 0: found")

    @guarded
    def execute(self, context):
        target = mesh_of(context)
        source = bpy.data.objects.get(self.source) if self.source else next((o for o in context.selected_objects if o != target and o.type == "MESH"), None)
        if source is None or source.type != "MESH" or target is None or target.type != "MESH":
            raise hf.InvalidArgumentError("select the source mesh, then the target mesh")
        if self.end < self.start:
            raise hf.InvalidArgumentError("the last frame is before the first")
        session.transfer_animation(source, target, range(self.start, self.end + 1), self.prefix, context.window_manager, self.scale)
        context.scene.hf_live = False


class HF_PT_panel(bpy.types.Panel):
    bl_label, bl_idname, bl_space_type, bl_region_type, bl_category = "hf", "HF_PT_panel", "VIEW_3D", "UI", "hf"

    def draw(self, context):
        layout, obj = self.layout, mesh_of(context)
        if obj is None or obj.type != "MESH":
            layout.label(text="Select a mesh")
            return
        found = session.session_of(obj, bind=False)
        row = layout.row(align=True)
        row.operator("hf.bind", text="Bind" if found is None else "Bound")
        row.operator("hf.unbind")
        layout.prop(context.scene, "hf_live")
        column = layout.column(align=True)
        column.operator("hf.add_handle", text="Add handle from selection")
        column.operator("hf.add_groups")
        column.operator("hf.remove_handle")
        column.operator("hf.update")
        column = layout.column(align=True)
        column.operator("hf.field")
        column.operator("hf.weights")
        column.operator("hf.transfer")
        if found:
            layout.label(text=f"{found.pose.handle_count} handles, factor {session.figures['bind_ms']:.0f} ms, pose {session.figures['update_ms']:.1f} ms")


_busy = 0


@contextlib.contextmanager
def quiet():
    """Our own changes do not come back as events."""
    global _busy
    _busy += 1
    try:
        yield
    finally:
        _busy -= 1


def refresh(obj):
    if obj is None or obj.type != "MESH":
        raise hf.InvalidArgumentError("select a mesh object")
    with quiet():
        session.session_of(obj).update(obj)


def follow(scene, keys=None):
    for obj in [o for o in scene.objects if o.type == "MESH" and o.get("hf_key") in session.sessions and (keys is None or o["hf_key"] in keys)]:
        try:
            refresh(obj)
        except hf.HfError as error:
            print(f"hf: {obj.name}: {error.message}")


@persistent
def on_depsgraph(scene, depsgraph):
    if _busy or not scene.hf_live or not session.sessions:
        return
    keys = {u.id["hf_key"] for u in depsgraph.updates if isinstance(u.id, bpy.types.Object) and u.id.type == "EMPTY" and u.is_updated_transform and "hf_key" in u.id}
    held = {}
    for o in scene.objects:
        if o.type == "EMPTY" and "hf_id" in o:
            held.setdefault(o["hf_key"], set()).add(o["hf_id"])
    keys |= {key for key, found in session.sessions.items() if set(found.numbers) != held.get(key, set())}
    if keys:
        follow(scene, keys)


@persistent
def on_frame(scene, *_):
    if scene.hf_live:
        follow(scene)


@persistent
def on_undo(*_):
    if bpy.context.scene.hf_live:
        follow(bpy.context.scene)


@persistent
def on_load(*_):
    session.sessions.clear()  # the next use binds again, from the rest positions kept in the mesh


CLASSES = (HF_OT_bind, HF_OT_unbind, HF_OT_add_handle, HF_OT_add_groups, HF_OT_remove_handle, HF_OT_update, HF_OT_field, HF_OT_weights, HF_OT_transfer, HF_PT_panel)
HANDLERS = (("depsgraph_update_post", on_depsgraph), ("frame_change_post", on_frame), ("undo_post", on_undo), ("redo_post", on_undo), ("load_post", on_load))


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.hf_live = bpy.props.BoolProperty(name="Live", default=True, description="Follow the handles while they are dragged")
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister():
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).remove(function)
    session.sessions.clear()
    del bpy.types.Scene.hf_live
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
