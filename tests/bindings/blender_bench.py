"""Beside Blender's LaplacianDeform on the same mesh and the same handles: blender_bench.py [RINGS AROUND]...

A quad sphere-like tube, two handles of about 500 vertices each (LaplacianDeform: the same vertices as anchors, moved by a hook).
Printed: bind, one update while a handle moves (everything Blender does until the evaluated mesh is there), and a handle added
while posing (LaplacianDeform has to be bound anew). Medians; the peer's times from the same run.
"""

import math
import os
import sys
import time

import bpy
import numpy as np
from mathutils import Vector

bpy.ops.preferences.addon_install(filepath=os.environ["HF_ADDON_ZIP"])
bpy.ops.preferences.addon_enable(module="hf_blender")
from hf_blender import session  # noqa: E402


def sphere(name, rings, around):
    phi = np.linspace(0, math.pi, rings + 2)[1:-1]
    theta = 2 * math.pi * np.arange(around) / around
    p, t = np.meshgrid(phi, theta, indexing="ij")
    points = np.stack([np.sin(p) * np.cos(t), np.sin(p) * np.sin(t), np.cos(p)], -1).reshape(-1, 3)
    points = np.vstack([points, [[0, 0, 1], [0, 0, -1]]])
    at = lambda i, j: i * around + j % around
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(rings - 1) for j in range(around)]
    north, south = len(points) - 2, len(points) - 1
    faces += [(north, at(0, j), at(0, j + 1)) for j in range(around)] + [(south, at(rings - 1, j + 1), at(rings - 1, j)) for j in range(around)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.tolist(), [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    order = np.argsort(points[:, 2])
    for group, members in (("hf low", order[:500]), ("hf high", order[-500:]), ("middle", np.flatnonzero(points @ [1, 0, 0] > 0.98)[:500])):
        obj.vertex_groups.new(name=group).add(members.tolist(), 1.0, "REPLACE")
    obj.vertex_groups.new(name="anchors").add(np.concatenate([order[:500], order[-500:]]).tolist(), 1.0, "REPLACE")
    return obj


def active(obj):
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def timed(function):
    begin = time.perf_counter()
    function()
    return 1e3 * (time.perf_counter() - begin)


def evaluate(obj):
    return obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices[0].co.copy()


def bench(rings, around, frames=21):
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    obj = sphere("hf", rings, around)
    n = len(obj.data.vertices)
    active(obj)
    session.triangles_of(obj.data)
    bind = timed(bpy.ops.hf.bind) + timed(lambda: bpy.ops.hf.add_groups(prefix="hf "))
    high = bpy.data.objects["hf high"]

    def drag(k):
        high.location = Vector((0.4 * math.sin(0.3 * k), 0, 1.0 + 0.3 * math.cos(0.3 * k)))
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        evaluate(obj)

    drag(0)
    update = np.median([timed(lambda: drag(k)) for k in range(1, frames)])
    inner = session.figures["update_ms"]
    add = timed(lambda: bpy.ops.hf.add_handle(group="middle"))
    found = session.session_of(obj)
    assert found.solver.statistics.factorisation_count == 1
    assert found.pose.handle_count == 3
    hook_at = found.rest[session.group_vertices(obj, "hf high")].mean(0)

    # the peer: hook on the upper handle in front of LaplacianDeform
    peer = sphere("peer", rings, around)
    target = bpy.data.objects.new("hook", None)
    bpy.context.scene.collection.objects.link(target)
    target.location = hook_at.tolist()
    bpy.context.view_layer.update()
    active(peer)
    hook = peer.modifiers.new("hook", "HOOK")
    hook.object, hook.vertex_group = target, "hf high"
    hook.matrix_inverse = target.matrix_world.inverted()
    laplace = peer.modifiers.new("laplace", "LAPLACIANDEFORM")
    laplace.vertex_group, laplace.iterations = "anchors", 1
    bpy.context.view_layer.update()
    peer_bind = timed(lambda: (bpy.ops.object.laplaciandeform_bind(modifier="laplace"), evaluate(peer)))
    assert laplace.is_bind

    def peer_drag(k):
        target.location = Vector((0.4 * math.sin(0.3 * k), 0, float(hook_at[2]) + 0.3 * math.cos(0.3 * k)))
        bpy.context.view_layer.update()
        evaluate(peer)

    first = timed(lambda: peer_drag(1))
    peer_update = np.median([timed(lambda: peer_drag(k)) for k in range(2, 7)])
    moved = np.abs(session.positions_of(peer.evaluated_get(bpy.context.evaluated_depsgraph_get()).data) - session.positions_of(peer.data)).max()
    assert moved > 0.1, "the peer does not follow its hook"
    print(f"RESULT {n} vertices: bind {bind:.0f} ms, peer {peer_bind + first:.0f} ms: {(peer_bind + first) / bind:.0f}x; "
          f"update {update:.1f} ms (of it pose and mesh {inner:.1f}), peer {peer_update:.0f} ms: {peer_update / update:.0f}x; "
          f"handle added while posing {add:.1f} ms without a factorisation")


sizes = [int(x) for x in sys.argv[sys.argv.index("--") + 1:]] or [157, 316, 314, 632]
for rings, around in zip(sizes[::2], sizes[1::2]):
    bench(rings, around)
