"""Operators of quads, and the options that the object made keeps."""

import math

import bpy

import hf

from . import quads
from .operators import busy, guarded, mesh_of, quiet

SYMMETRY = [("NONE", "None", ""), ("X", "X", ""), ("Y", "Y", ""), ("Z", "Z", "")]
QUAD_OPTIONS = {  # of Make quads, and of the object that it makes
    "faces": (bpy.props.IntProperty, {"name": "Quads", "default": 5000, "min": 1, "max": 10000000,
        "description": "How many are wanted"}),
    "crease": (bpy.props.FloatProperty, {"name": "Creases from", "default": 0.0, "min": 0.0, "max": math.pi, "subtype": "ANGLE",
        "description": "Edges that bend by more are kept; 0: none"}),
    "sharp": (bpy.props.BoolProperty, {"name": "Keep sharp edges", "default": False,
        "description": "Edges that are marked as sharp are kept"}),
    "symmetry": (bpy.props.EnumProperty, {"name": "Mirror", "items": SYMMETRY,
        "description": "The positive side of the object's axis, mirrored"}),
}


def quad_option(name, **more):
    kind, arguments = QUAD_OPTIONS[name]
    return kind(**arguments, **more)


def look_again(group, context):
    """An option of quads was changed in the panel."""
    if group.key and not busy():
        with quiet():
            quads.look(group.id_data, context.scene, context.evaluated_depsgraph_get())


class HF_PG_quads(bpy.types.PropertyGroup):
    """What quads were made of, kept with the object made."""
    key: bpy.props.StringProperty()
    source: bpy.props.PointerProperty(type=bpy.types.Object)
    follow: bpy.props.BoolProperty(name="Follow", default=True, update=look_again,
        description="Make the quads again when a stroke, a pole or an edge of the mesh changes")
    faces: quad_option("faces", update=look_again)
    crease: quad_option("crease", update=look_again)
    sharp: quad_option("sharp", update=look_again)
    symmetry: quad_option("symmetry", update=look_again)


class HF_OT_quads(bpy.types.Operator):
    """A new object beside this one: its rest shape in quads that follow the form, the strokes and the poles"""
    bl_idname, bl_label, bl_options = "hf.quads", "Make quads", {"REGISTER", "UNDO"}
    faces: quad_option("faces")
    crease: quad_option("crease")
    sharp: quad_option("sharp")
    symmetry: quad_option("symmetry")
    strokes: bpy.props.StringProperty(name="Strokes",
        description="A curve that edges follow; empty: the other selected curves")

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        if obj is None or obj.type != "MESH":
            raise hf.InvalidArgumentError("select a mesh object")
        curves = [o for o in context.selected_objects if o.type == "CURVE"]
        poles = [o for o in context.selected_objects if o.type == "EMPTY" and quads.POLE in o]
        if self.strokes:
            curves = [o for o in (bpy.data.objects.get(self.strokes),) if o and o.type == "CURVE"]
            if not curves:
                raise hf.InvalidArgumentError(f"there is no curve '{self.strokes}'")
        with quiet():
            made = quads.create(obj, curves, poles, context.window_manager, context.evaluated_depsgraph_get(), self.faces,
                self.crease, self.sharp, self.symmetry)
        for other in context.selected_objects:
            other.select_set(False)
        made.select_set(True)
        context.view_layer.objects.active = made
        self.report({"INFO"}, f"{made.name}: {quads.kept[made.hf_quads.key].line}")


def quads_made(context):
    made = quads.made_of(context)
    if made is None:
        raise hf.InvalidArgumentError("select quads that Make quads made, or a stroke or a pole of them")
    return made


class HF_OT_update_quads(bpy.types.Operator):
    """Make the quads again now (with Follow off, or after an edit by hand)"""
    bl_idname, bl_label, bl_options = "hf.update_quads", "Update quads", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        with quiet():
            quads.look(quads_made(context), context.scene, context.evaluated_depsgraph_get(), force=True)


class HF_OT_draw_strokes(bpy.types.Operator):
    """Draw on the body: edges follow the stroke. Move or edit the curve, and the quads follow"""
    bl_idname, bl_label, bl_options = "hf.draw_strokes", "Draw strokes", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        made = quads_made(context)
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        with quiet():
            stroke = quads.add_stroke(made)
        for other in context.selected_objects:
            other.select_set(False)
        stroke.select_set(True)
        context.view_layer.objects.active = stroke
        bpy.ops.object.mode_set(mode="EDIT")
        context.scene.tool_settings.curve_paint_settings.depth_mode = "SURFACE"
        if context.area is not None and context.area.type == "VIEW_3D":
            bpy.ops.wm.tool_set_by_id(name="builtin.draw")


class HF_OT_add_pole(bpy.types.Operator):
    """An empty at the 3D cursor: 3 or 5 quads meet there. Move or turn it, and the quads follow"""
    bl_idname, bl_label, bl_options = "hf.add_pole", "Add pole", {"REGISTER", "UNDO"}
    count: bpy.props.EnumProperty(name="Quads", items=[("3", "3", "3 quads meet"), ("5", "5", "5 quads meet")])

    @guarded
    def execute(self, context):
        made = quads_made(context)
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        with quiet():
            pole = quads.add_pole(made, int(self.count), context.scene.cursor.location)
        for other in context.selected_objects:
            other.select_set(False)
        pole.select_set(True)
        context.view_layer.objects.active = pole
        with quiet():
            quads.look(made, context.scene, context.evaluated_depsgraph_get())


CLASSES = (HF_PG_quads, HF_OT_quads, HF_OT_update_quads, HF_OT_draw_strokes, HF_OT_add_pole)
