"""The operators: each has undo, and reports a fault in one sentence."""

import contextlib

import bpy

import hf

from . import armatures, carriers, mesh_data, proposals, retarget, rig, session, skinning

_busy = 0


def busy():
    return _busy > 0


@contextlib.contextmanager
def quiet():
    """Our own changes do not come back as events."""
    global _busy
    _busy += 1
    try:
        yield
    finally:
        _busy -= 1


def refresh(obj, again=True):
    if obj is None or obj.type != "MESH":
        raise hf.InvalidArgumentError("select a mesh object")
    with quiet():
        session.session_of(obj).update(obj, again)


@contextlib.contextmanager
def outside_edit_mode(context):
    """The data of a mesh or an armature is there outside its Edit Mode alone. Afterwards the mode is as before."""
    edited = context.active_object if context.mode in ("EDIT_MESH", "EDIT_ARMATURE") else None
    if edited:
        bpy.ops.object.mode_set(mode="OBJECT")
        if edited.get("hf_key") in session.sessions:
            session.sessions[edited["hf_key"]].editing = True
    try:
        yield
    finally:
        if edited and context.view_layer.objects.active == edited:
            bpy.ops.object.mode_set(mode="EDIT")


def guarded(execute):
    """An operator's failure is a sentence in the status bar, with nothing changed."""
    def run(self, context):
        try:
            with outside_edit_mode(context):
                return execute(self, context) or {"FINISHED"}
        except hf.HfError as error:
            self.report({"ERROR"}, error.message)
            return {"CANCELLED"}
    return run


def mesh_of(context):
    """The active mesh, or the mesh of the active handle, or that with handles which the active armature moves."""
    active = context.active_object
    if active is None:
        return None
    key = active.get("hf_key") if active.type == "EMPTY" else None
    if active.type == "ARMATURE":
        key = next((bone["hf_key"] for bone in carriers.bones_of(active)), None)
        if key is None and active.hf_source is None:
            key = next((o["hf_key"] for o in context.scene.objects if o.type == "MESH" and "hf_key" in o
                and getattr(armatures.modifier_of(o), "object", None) == active), None)
    return mesh_with(key) if key else active


def mesh_with(key):
    return next((o for o in bpy.data.objects if o.type == "MESH" and o.get("hf_key") == key), None)


def active_carrier(context):
    """The active empty or bone, when it moves a handle."""
    active = context.active_object
    if active is not None and active.type == "ARMATURE":
        bone = context.active_pose_bone or (active.data.bones.active
            and active.pose.bones[active.data.bones.active.name])
        return bone if bone and "hf_id" in bone else None
    return active if active is not None and active.type == "EMPTY" and "hf_id" in active else None


class HF_OT_bind(bpy.types.Operator):
    """Factorise the mesh once; handles, fields and poses then take milliseconds"""
    bl_idname, bl_label, bl_options = "hf.bind", "Bind", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        note = session.session_of(mesh_of(context), context.window_manager).note
        if note:
            self.report({"INFO"}, note)


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
        vertices = mesh_data.group_vertices(obj, self.group) if self.group else mesh_data.selected_vertices(obj)
        with quiet():
            session.add_handles(obj, [vertices], [self.group or "handle"], self.layer)
        refresh(obj)


class HF_OT_add_groups(bpy.types.Operator):
    """A handle for every vertex group whose name starts with the prefix"""
    bl_idname, bl_label, bl_options = "hf.add_groups", "Handles from groups", {"REGISTER", "UNDO"}
    prefix: bpy.props.StringProperty(name="Prefix", default="hf ")

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        if obj is None or obj.type != "MESH":
            raise hf.InvalidArgumentError("select a mesh object")
        names = [g.name for g in obj.vertex_groups if g.name.startswith(self.prefix)]
        if not names:
            raise hf.EmptyError(f"no vertex group starts with '{self.prefix}'")
        regions = []  # read while the mesh is factorised, when it is not yet
        session.session_of(obj, context.window_manager, meanwhile=lambda: regions.extend(mesh_data.groups_vertices(obj,
            names)))
        with quiet():
            session.add_handles(obj, regions, [name[len(self.prefix):] for name in names])
        refresh(obj)


class HF_OT_add_bones(bpy.types.Operator):
    """The deforming bones of an armature as handles: pose or animate it and the mesh follows. Regions are vertex groups
    of the bones' names, or the middle of each limb"""
    bl_idname, bl_label, bl_options = "hf.add_bones", "Handles from bones", {"REGISTER", "UNDO"}
    armature: bpy.props.StringProperty(name="Armature", description="Empty: the other selected object")
    layer: bpy.props.IntProperty(name="Layer", min=0, max=7)
    share: bpy.props.FloatProperty(name="Middle", description="Share of a bone's length that holds the mesh",
        default=0.5, min=0.05, max=1)

    @guarded
    def execute(self, context):
        armature = bpy.data.objects.get(self.armature) if self.armature else next(
            (o for o in context.selected_objects if o.type == "ARMATURE"), None)
        obj = context.active_object
        if obj is armature:
            obj = next((o for o in context.selected_objects if o.type == "MESH"), None)
        session.session_of(obj, context.window_manager)
        with quiet():
            session.add_bones(obj, armature, self.layer, self.share)
        refresh(obj)


class HF_OT_propose(bpy.types.Operator):
    """Handles at the feet, which hold the body, and at head, tail and hands, which you drag"""
    bl_idname, bl_label, bl_options = "hf.propose", "Propose handles", {"REGISTER", "UNDO"}
    holding: bpy.props.BoolProperty(name="Only what holds", default=False,
        description="Only the feet, or what else holds the body")

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        session.session_of(obj, context.window_manager)
        with quiet():
            made = proposals.add_proposals(obj, self.holding)
        refresh(obj)
        held = sum(1 for carrier in made if not carriers.waits(carrier))
        self.report({"INFO"}, f"{len(made)} handles, {held} of them hold; move one of the others")


class HF_OT_remove_handle(bpy.types.Operator):
    """Remove the active handle, an empty or a bone's; the others keep their places"""
    bl_idname, bl_label, bl_options = "hf.remove_handle", "Remove handle", {"REGISTER", "UNDO"}
    name: bpy.props.StringProperty(name="Handle", description="An empty, or a bone; empty: the active one")

    @guarded
    def execute(self, context):
        if self.name:
            found = [c for held in carriers.carriers_in(bpy.data.objects).values() for c in held.values()
                if c.name == self.name]
            carrier = found[0] if found else None
        else:
            carrier = active_carrier(context)
        if carrier is None:
            raise hf.NotFoundError("the active object is no handle")
        obj = mesh_with(carrier["hf_key"])
        with quiet():
            carriers.unmark(carrier)
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
    high: bpy.props.StringProperty(name="1 on",
        description="Vertex group where the field is 1; empty: the active handle's field")
    low: bpy.props.StringProperty(name="0 on", description="Vertex group where the field is 0")
    output: bpy.props.EnumProperty(name="As", items=[("GROUP", "Vertex group", ""), ("COLOUR", "Colour attribute", "")])
    name: bpy.props.StringProperty(name="Name", default="hf field")

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        if self.high or self.low:
            values = session.field_between(obj, self.high, self.low)
        else:
            carrier, found = active_carrier(context), session.session_of(obj)
            found.sync(obj)
            if carrier is None or carrier["hf_id"] not in found.numbers:
                raise hf.NotFoundError("make a handle the active object, or name two vertex groups")
            values = found.pose.field(found.numbers[carrier["hf_id"]])
        (mesh_data.write_group if self.output == "GROUP" else mesh_data.write_colour)(obj, self.name, values)


class HF_OT_weights(bpy.types.Operator):
    """Write the pose as vertex groups and an armature with one bone per cluster, in the pose of the mesh"""
    bl_idname, bl_label, bl_options = "hf.weights", "Weights and armature", {"REGISTER", "UNDO"}
    count: bpy.props.EnumProperty(name="Bones for each vertex", items=[("4", "4", ""), ("8", "8", "")])

    @guarded
    def execute(self, context):
        obj = mesh_of(context)
        found = session.session_of(obj)
        found.update(obj)
        skin = found.pose.skin(int(self.count))
        armature = rig.write_skin(obj, skin, f"{obj.name} weights")
        rig.pose_bones(armature, skin)
        armature[armatures.BAKED] = True
        context.scene.hf_live = False  # the armature moves the mesh from here on


class HF_OT_transfer(bpy.types.Operator):
    """Play the motion of another selected mesh on the active one, through equally named vertex groups"""
    bl_idname, bl_label, bl_options = "hf.transfer", "Transfer animation", {"REGISTER", "UNDO"}
    source: bpy.props.StringProperty(name="Source", description="Empty: the other selected mesh")
    prefix: bpy.props.StringProperty(name="Prefix", default="hf ")
    start: bpy.props.IntProperty(name="Start", default=1)
    end: bpy.props.IntProperty(name="End", default=24)
    scale: bpy.props.FloatProperty(name="Scale", min=0,
        description="Lengths of the target over lengths of the source; 0: computed")

    @guarded
    def execute(self, context):
        target = mesh_of(context)
        source = bpy.data.objects.get(self.source) if self.source else next((o for o in context.selected_objects
            if o != target and o.type == "MESH"), None)
        if source is None or source.type != "MESH" or target is None or target.type != "MESH":
            raise hf.InvalidArgumentError("select the source mesh, then the target mesh")
        if self.end < self.start:
            raise hf.InvalidArgumentError("the last frame is before the first")
        rig.transfer_animation(source, target, range(self.start, self.end + 1), self.prefix, context.window_manager,
            self.scale, **dials_of(context.scene))
        context.scene.hf_live = False
        say_idle_dials(self, target, context.scene)


DIALS = {  # of hf_transfer_dials: label, neutral value, range, what it does
    "stride": ("Stride", 1.0, 0.1, 4.0, "How many times the paths of feet and trunk along the ground count"),
    "hip_height_share": ("Hip height", 0.0, -0.5, 0.5, "Raises the trunk by this share of its height at rest"),
    "neck_follow": ("Neck follows", 0.0, -1.0, 1.0,
        "1: the neck points where the source's points; -1: it does not move against the trunk"),
    "tail_follow": ("Tail follows", 0.0, -1.0, 1.0,
        "1: the tail points where the source's points; -1: it does not move against the trunk"),
    "arm_space": ("Room at the arms", 0.0, -1.5707, 1.5707, "Turns the arms away from the body"),
    "long_follow": ("Long parts follow", 0.0, 0.0, 1.0, "1: a long sword, tail or head makes the source's whole turn"),
}


def dials_of(scene):
    return {name: getattr(scene, f"hf_{name}") for name in DIALS}


def say_idle_dials(operator, target, scene):
    for dial, kind in rig.idle_dials(target, **dials_of(scene)):
        operator.report({"WARNING"}, f"{DIALS[dial][0]} turns nothing: no pair is a [{kind}]")


class HF_OT_dials(bpy.types.Operator):
    """Play the last transfer to the active mesh again, with the dials as they are now; nothing is prepared again"""
    bl_idname, bl_label, bl_options = "hf.dials", "Turn dials", {"REGISTER", "UNDO"}

    @guarded
    def execute(self, context):
        target = mesh_of(context)
        if target is None or target.type != "MESH":
            raise hf.InvalidArgumentError("select the target mesh")
        rig.turn_dials(target, context.window_manager, **dials_of(context.scene))
        say_idle_dials(self, target, context.scene)


class HF_OT_retarget(bpy.types.Operator):
    """The active armature follows the other selected armature in every frame: any clip plays on it, live"""
    bl_idname, bl_label, bl_options = "hf.retarget", "Follow armature", {"REGISTER", "UNDO"}
    source: bpy.props.StringProperty(name="Source", description="Empty: the other selected armature")

    @guarded
    def execute(self, context):
        target = context.active_object
        source = bpy.data.objects.get(self.source) if self.source else next((o for o in context.selected_objects
            if o != target and o.type == "ARMATURE"), None)
        if source is None or source.type != "ARMATURE" or target is None or target.type != "ARMATURE" or source == target:
            raise hf.InvalidArgumentError("select the armature that moves, then the armature that follows")
        info = retarget.start(source, target).retarget.info
        retarget.play(context.scene, context.evaluated_depsgraph_get())
        self.report({"INFO"}, f"{info.matched_joint_count} of {info.target_joint_count} bones follow {source.name}")


def mesh_and_armature(context):
    """The selected mesh and the selected armature; else the armature that moves the mesh already."""
    obj = next((o for o in [context.active_object, *context.selected_objects] if o and o.type == "MESH"), None)
    armature = next((o for o in context.selected_objects if o.type == "ARMATURE"), None)
    armature = armature or (skinning.armature_of(obj) if obj else None)
    if obj is None or armature is None:
        raise hf.InvalidArgumentError("select a mesh and an armature")
    return obj, armature


def meshes_and_armature(context):
    """The selected meshes, or all that the selected armature moves or is the parent of; and the armature."""
    armature = next((o for o in context.selected_objects if o.type == "ARMATURE"), None)
    meshes = [o for o in context.selected_objects if o.type == "MESH"]
    if armature and not meshes:
        meshes = [o for o in context.scene.objects if o.type == "MESH" and armature in (o.parent, skinning.armature_of(o))]
    if armature and meshes:
        return meshes, armature
    obj, armature = mesh_and_armature(context)
    return [obj], armature


class HF_OT_weights_from_bones(bpy.types.Operator):
    """Skin weights for every vertex of the selected meshes from the deforming bones of the selected armature. Select the
    armature alone for all its meshes"""
    bl_idname, bl_label, bl_options = "hf.weights_from_bones", "Compute weights", {"REGISTER", "UNDO"}
    count: bpy.props.EnumProperty(name="Bones for each vertex", items=[("4", "4", ""), ("8", "8", "")])

    @guarded
    def execute(self, context):
        meshes, armature = meshes_and_armature(context)
        vertices, guessed, found, failed = 0, 0, set(), []
        for obj in meshes:
            try:
                with quiet():
                    info, helpers = skinning.weights_from_bones(obj, armature, int(self.count), context.window_manager)
            except hf.HfError as error:
                if len(meshes) == 1:
                    raise
                failed.append(obj)
                self.report({"WARNING"}, f"{obj.name} keeps its weights: {error.message}")
                continue
            vertices += info.vertex_count
            guessed += info.nearest_count + info.rigid_count + info.isolated_count
            found.update(helpers)
        if len(failed) == len(meshes):
            raise hf.InvalidArgumentError(f"none of {len(meshes)} meshes got weights; the warnings say why")
        of = f" of {len(meshes) - len(failed)} meshes" if len(meshes) > 1 else ""
        self.report({"INFO"}, f"{vertices} vertices{of}, {guessed} guessed; {len(found)} bones look like helpers")


class HF_OT_pin_weights(bpy.types.Operator):
    """An empty that gives the selected vertex to the active bone. Move it: the weights follow"""
    bl_idname, bl_label, bl_options = "hf.pin_weights", "Pin to bone", {"REGISTER", "UNDO"}
    bone: bpy.props.StringProperty(name="Bone", description="Empty: the active bone of the armature")

    @guarded
    def execute(self, context):
        obj, armature = mesh_and_armature(context)
        bone = self.bone or (armature.data.bones.active.name if armature.data.bones.active else "")
        if bone not in armature.data.bones or not armature.data.bones[bone].use_deform:
            raise hf.InvalidArgumentError(f"{armature.name} has no deforming bone '{bone}'")
        with quiet():
            skinning.add_pin(obj, armature, bone)
            skinning.weights_from_bones(obj, armature, 4, context.window_manager)


class HF_OT_carry_weights(bpy.types.Operator):
    """The weights of the other selected mesh on the active one: clothes, hair, levels of detail"""
    bl_idname, bl_label, bl_options = "hf.transfer_weights", "Transfer weights", {"REGISTER", "UNDO"}
    source: bpy.props.StringProperty(name="Source", description="Empty: the other selected mesh")
    distance: bpy.props.FloatProperty(name="Distance", min=0, description="How near the other mesh is; 0: 5 % of its size")

    @guarded
    def execute(self, context):
        target = context.active_object
        source = bpy.data.objects.get(self.source) if self.source else next((o for o in context.selected_objects
            if o != target and o.type == "MESH"), None)
        if source is None or source.type != "MESH" or target is None or target.type != "MESH":
            raise hf.InvalidArgumentError("select the mesh with the weights, then the other mesh")
        info = skinning.carry(source, target, 4, self.distance, context.window_manager)
        self.report({"INFO"}, f"{info.matched_count} vertices matched, {info.solved_count} filled in")


class HF_OT_mirror_weights(bpy.types.Operator):
    """The weights of one side on the other; vertices need not mirror"""
    bl_idname, bl_label, bl_options = "hf.mirror_weights", "Mirror weights", {"REGISTER", "UNDO"}
    to: bpy.props.EnumProperty(name="To", items=[("NEGATIVE", "-", "From + to -"), ("POSITIVE", "+", "From - to +"),
        ("BOTH", "Both", "The mean of both sides")])

    @guarded
    def execute(self, context):
        obj = context.active_object
        if obj is None or obj.type != "MESH":
            raise hf.InvalidArgumentError("select a mesh object")
        to = hf.MirrorTo.BOTH if self.to == "BOTH" else hf.MirrorTo[f"TO_{self.to}"]
        info = skinning.mirror(obj, to, 4, context.window_manager)
        self.report({"INFO"}, f"{info.matched_count} vertices mirrored, {info.alone_count} bones alone")


OPERATORS = (HF_OT_bind, HF_OT_unbind, HF_OT_add_handle, HF_OT_add_groups, HF_OT_add_bones, HF_OT_propose, HF_OT_remove_handle,
    HF_OT_update, HF_OT_field, HF_OT_weights, HF_OT_transfer, HF_OT_dials, HF_OT_retarget,
    HF_OT_weights_from_bones, HF_OT_pin_weights, HF_OT_carry_weights, HF_OT_mirror_weights)
