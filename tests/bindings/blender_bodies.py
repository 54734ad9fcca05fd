"""Bodies for the tests of the add-on."""

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


def active(obj):
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
