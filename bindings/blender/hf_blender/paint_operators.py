"""The operators of painted groups: pins and stiffness."""

import bpy

import hf

from . import paint, session
from .operators import guarded, mesh_of, quiet, refresh


def painted_group(operator, context):
    """The mesh, its session, and the name of the painted group: the one given or the active one; "" to clear."""
    obj = mesh_of(context)
    found = session.session_of(obj, context.window_manager)
    group = operator.group or (obj.vertex_groups.active.name if obj.vertex_groups.active else "")
    if not group and not operator.clear:
        raise hf.EmptyError(f"{obj.name} has no vertex group; paint one in Weight Paint first")
    return obj, found, "" if operator.clear else group


class HF_OT_stiffness(bpy.types.Operator):
    """Paint a vertex group in Weight Paint, then press this: what is painted bends less, as a belt or a shield. Paint more, or
    erase: the pose follows"""
    bl_idname, bl_label, bl_options = "hf.stiffness", "Stiffness from group", {"REGISTER", "UNDO"}
    group: bpy.props.StringProperty(name="Vertex group", description="Empty: the active one")
    most: bpy.props.FloatProperty(name="Stiffness", default=1e4, min=paint.LEAST, max=paint.MOST,
        description="Where the weight is 1. 10,000: rigid; 1: as it is; 0.02: takes up the bending around it")
    clear: bpy.props.BoolProperty(name="Clear", description="All vertices as they were, without a painted group")

    @guarded
    def execute(self, context):
        obj, found, group = painted_group(self, context)
        with quiet():
            paint.stiffen(obj, found, group, self.most)
        refresh(obj)


class HF_OT_pins(bpy.types.Operator):
    """Paint a vertex group in Weight Paint, then press this: what is painted holds, without a handle. Paint more, or erase: the
    pose follows"""
    bl_idname, bl_label, bl_options = "hf.pins", "Pins from group", {"REGISTER", "UNDO"}
    group: bpy.props.StringProperty(name="Vertex group", description="Empty: the active one")
    clear: bpy.props.BoolProperty(name="Clear", description="Nothing is pinned by painting any more")

    @guarded
    def execute(self, context):
        obj, found, group = painted_group(self, context)
        with quiet():
            paint.pin(obj, found, group)
        refresh(obj)
        self.report({"INFO"}, f"{len(found.painted)} vertices hold")


CLASSES = (HF_OT_pins, HF_OT_stiffness)
