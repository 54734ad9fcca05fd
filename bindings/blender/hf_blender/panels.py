"""The sidebar's tab hf: what to do next, and a panel for each tool, named as in the studio."""

import textwrap

import bpy

from . import armatures, carriers, mesh_data, operators, paint, quads, session, skinning
from .operators import mesh_of


def next_step(obj, found):
    """The sentence at the top of the tab. found: the session of the mesh, or None while it is not bound."""
    if obj is not None and obj.type == "ARMATURE":
        if obj.hf_source:
            return f"{obj.name} follows {obj.hf_source.name}: play any clip."
        return "Select the armature that moves, then this one, and press Follow armature."
    if obj is None or obj.type != "MESH":
        return "Select a mesh."
    if not len(obj.data.polygons):
        return f"{obj.name} has no faces: select another mesh."
    if obj.data.shape_keys is not None:
        return f"{mesh_data.shape_keys_of(obj)}. Fields, weights and quads can be made."
    if obj.get("hf_key") in session.unbound:
        return "Undo the edit, or mend the mesh in Edit Mode. Or press Unbind, and propose handles again."
    if found is None and session.handles_of(obj):  # a file that was opened
        return "Move or turn a handle: the mesh follows." if bpy.context.scene.hf_live else "Press Update, or turn Live on."
    if found is None:
        return "Press Propose handles, or Bind."
    if obj.mode == "EDIT":
        return "Leave Edit Mode (Tab): the handles and what is painted go along with the edit."
    placed = carriers.carriers_of(obj["hf_key"])
    pinned = len(found.painted) > 0
    if obj.mode == "WEIGHT_PAINT":
        name = obj.get(paint.PINS) or obj.get(paint.STIFF_GROUP)
        if not name:
            return "Paint what holds and press Pins from group, or what stays rigid and press Stiffness from group."
        return "Paint or erase: the pose follows. Go back to Object Mode to move a handle."
    if not placed and carriers.offered(obj["hf_key"]):
        return "Move a sphere: it becomes a handle."
    if not placed and pinned:
        return "Add a handle where you want to pull: select vertices in Edit Mode, press Add handle."
    if not placed:
        return "Propose handles, or add one from selected vertices."
    if len(placed) == 1 and not pinned and not carriers.offered(obj["hf_key"]):
        return "Add a second handle, or paint pins: one part holds, one is moved."
    if not bpy.context.scene.hf_live:
        return "Press Update, or turn Live on."
    return "Move or turn a handle: the mesh follows."


def remarks_on(obj, found):
    """What is wrong, in sentences."""
    why = session.unbound.get(obj.get("hf_key"))
    return [why] if why else found.remarks if found else []


def quads_step(made, active):
    """The same for quads that were made."""
    if not made.hf_quads.follow:
        return "Press Update quads, or turn Follow on."
    if active == made:
        return "Draw strokes, or add a pole."
    return f"Move the {'pole' if active.type == 'EMPTY' else 'stroke'}: the quads follow."


def say(layout, context, sentence, icon="NONE"):
    """A sentence in as many lines as the sidebar's width asks for; Blender alone would cut out its middle."""
    scale = context.preferences.view.ui_scale
    letters = max(12, int((context.region.width / scale - 70) / 6.2))  # 70: borders and the icon; 6.2: a letter's mean width
    column = layout.column()
    column.scale_y = 0.8
    for number, line in enumerate(textwrap.wrap(sentence, letters)):
        column.label(text=line, icon="BLANK1" if number and icon != "NONE" else icon)


class Panel:
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "hf"


class HF_PT_panel(Panel, bpy.types.Panel):
    bl_label, bl_idname = "hf", "HF_PT_panel"

    def draw(self, context):
        layout, obj = self.layout, mesh_of(context)
        found = session.session_of(obj, bind=False) if obj is not None and obj.type == "MESH" else None
        made = quads.made_of(context)
        if made is not None:
            say(layout, context, quads_step(made, context.active_object), "INFO")
            return
        say(layout, context, next_step(obj, found), "INFO")
        if obj is None or obj.type != "MESH":
            return
        row = layout.row(align=True)
        row.operator("hf.bind", text="Bind" if found is None else "Bound")
        row.operator("hf.unbind")
        if found:
            bind, update = session.figures["bind_ms"], session.figures["update_ms"]
            count = len(found.numbers)
            say(layout, context, f"{count} handle{'s' * (count != 1)}, factor {bind:.0f} ms, pose {update:.1f} ms")
            if armatures.sentence_on(obj):
                say(layout, context, armatures.sentence_on(obj), "ARMATURE_DATA")
        for remark in remarks_on(obj, found):
            say(layout, context, remark, "ERROR")


class Tool(Panel):
    """A panel under the first, open or closed."""
    bl_parent_id = "HF_PT_panel"

    @classmethod
    def poll(cls, context):
        obj = mesh_of(context)
        return obj is not None and obj.type == "MESH"

    def draw(self, context):
        column = self.layout.column(align=True)
        for name, text in self.buttons:
            column.operator(name, **({"text": text} if text else {}))


class HF_PT_pose(Tool, bpy.types.Panel):
    bl_label, bl_idname = "Pose", "HF_PT_pose"
    buttons = (("hf.propose", ""), ("hf.add_handle", "Add handle from selection"), ("hf.add_groups", ""),
        ("hf.add_bones", ""), ("hf.remove_handle", ""), ("hf.pins", ""), ("hf.stiffness", ""), ("hf.update", ""))

    def draw(self, context):
        super().draw(context)
        self.layout.prop(context.scene, "hf_live")
        self.layout.prop(context.scene, "hf_lengths")
        obj = mesh_of(context)
        for sentence, icon in paint.lines_on(obj, session.session_of(obj, bind=False)):
            say(self.layout, context, sentence, icon)
        carrier = operators.active_carrier(context)
        if carrier is not None and not carrier["hf_layer"]:
            column = self.layout.column(align=True)
            column.label(text=carrier.name)
            column.prop(carrier, "hf_following", slider=True)
            column.prop(carrier, "hf_limb")


class HF_PT_field(Tool, bpy.types.Panel):
    bl_label, bl_idname, bl_options = "Field", "HF_PT_field", {"DEFAULT_CLOSED"}
    buttons = (("hf.field", ""),)


class HF_PT_weights(Tool, bpy.types.Panel):
    bl_label, bl_idname, bl_options = "Weights", "HF_PT_weights", {"DEFAULT_CLOSED"}
    buttons = (("hf.weights_from_bones", ""), ("hf.pin_weights", ""), ("hf.transfer_weights", ""), ("hf.mirror_weights", ""),
        ("hf.weights", ""))

    def draw(self, context):
        super().draw(context)
        for sentence in mesh_of(context).get(skinning.NOTE, "").splitlines():
            say(self.layout, context, sentence)


class HF_PT_transfer(Tool, bpy.types.Panel):
    bl_label, bl_idname, bl_options = "Transfer", "HF_PT_transfer", {"DEFAULT_CLOSED"}
    buttons = (("hf.transfer", ""),)

    def draw(self, context):
        super().draw(context)
        column = self.layout.column(align=True)
        for name in operators.DIALS:
            column.prop(context.scene, f"hf_{name}")
        column.operator("hf.dials")


class HF_PT_retarget(Tool, bpy.types.Panel):
    bl_label, bl_idname = "Retarget", "HF_PT_retarget"
    buttons = (("hf.retarget", ""),)

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "ARMATURE"

    def draw(self, context):
        super().draw(context)
        self.layout.prop(context.active_object, "hf_source", text="")


class HF_PT_quads(Tool, bpy.types.Panel):
    bl_label, bl_idname, bl_options = "Quads", "HF_PT_quads", {"DEFAULT_CLOSED"}
    buttons = (("hf.quads", ""),)

    @classmethod
    def poll(cls, context):
        return super().poll(context) or quads.made_of(context) is not None

    def draw(self, context):
        made = quads.made_of(context)
        if made is None:
            super().draw(context)
            return
        group, state = made.hf_quads, quads.kept.get(made.hf_quads.key)
        self.layout.prop(group, "follow")
        column = self.layout.column(align=True)
        for name in ("faces", "crease", "sharp"):
            column.prop(group, name)
        column.label(text="Mirror")
        column.row(align=True).prop(group, "symmetry", expand=True)
        column = self.layout.column(align=True)
        column.operator("hf.draw_strokes")
        row = column.row(align=True)
        for count in "35":
            row.operator("hf.add_pole", text=f"Pole of {count}").count = count
        column.operator("hf.update_quads")
        if state and state.line:
            say(self.layout, context, state.line)
        if state and state.error:
            say(self.layout, context, f"The quads stay as they were: {state.error}", "ERROR")


PANELS = (HF_PT_panel, HF_PT_pose, HF_PT_field, HF_PT_weights, HF_PT_transfer, HF_PT_retarget, HF_PT_quads)
