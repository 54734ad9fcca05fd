"""Bodies for the tests of the add-on, and what else several of them need."""

import math

import bpy
import numpy as np

RINGS, AROUND = 41, 16


def tube():
    """A closed tube along z from 0 to 4, thick 0.5."""
    turn = 2 * np.pi * np.arange(AROUND) / AROUND
    points = [(0.5 * np.cos(t), 0.5 * np.sin(t), 0.1 * i) for i in range(RINGS) for t in turn]
    faces = [(i * AROUND + j, i * AROUND + (j + 1) % AROUND, (i + 1) * AROUND + (j + 1) % AROUND, (i + 1) * AROUND + j)
        for i in range(RINGS - 1) for j in range(AROUND)]
    mesh = bpy.data.meshes.new("tube")
    mesh.from_pydata(points, [], [*faces, tuple(reversed(range(AROUND))), tuple(range((RINGS - 1) * AROUND, RINGS * AROUND))])
    obj = bpy.data.objects.new("tube", mesh)
    bpy.context.scene.collection.objects.link(obj)
    for name, low, high in (("hf low", 0, 0.35), ("hf middle", 1.75, 2.25), ("hf high", 3.65, 4)):
        obj.vertex_groups.new(name=name).add([i for i, p in enumerate(points) if low <= p[2] <= high], 1.0, "REPLACE")
    return obj


def cylinder(name, length, radius, rings, around, at):
    """A closed cylinder along z, and its vertices."""
    points = [(radius * math.cos(2 * math.pi * j / around), radius * math.sin(2 * math.pi * j / around),
        length * i / (rings - 1))
              for i in range(rings) for j in range(around)]
    faces = [(i * around + j, i * around + (j + 1) % around, (i + 1) * around + (j + 1) % around, (i + 1) * around + j)
             for i in range(rings - 1) for j in range(around)]
    faces += [tuple(reversed(range(around))), tuple(range((rings - 1) * around, rings * around))]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    obj.location = at
    bpy.context.scene.collection.objects.link(obj)
    return obj, np.array(points)


def rig_tube(body, share):
    """An armature of two bones along a tube that moves it; share: the weights of the upper bone."""
    rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
    bpy.context.scene.collection.objects.link(rig)
    active(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    for name, low, high in (("lower", 0, 2), ("upper", 2, 4)):
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail = (0, 0, low), (0, 0, high)
    rig.data.edit_bones["upper"].parent = rig.data.edit_bones["lower"]
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.pose.bones["upper"].rotation_mode = "QUATERNION"
    weigh_tube(body, share)
    body.modifiers.new("rig", "ARMATURE").object = rig
    return rig


def weigh_tube(body, share):
    for name, weights in (("lower", 1 - share), ("upper", share)):
        group = body.vertex_groups.get(name) or body.vertex_groups.new(name=name)
        for vertex, weight in enumerate(weights):
            group.add([vertex], float(weight), "REPLACE")


def active(obj):
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def fails(text, operator, **arguments):
    try:
        operator(**arguments)
    except RuntimeError as error:
        assert text in str(error), error
        return
    raise AssertionError(f"{operator.idname()} did not fail with: {text}")
