"""Beside Blender's LaplacianDeform on the same mesh and handles: blender_bench.py [N]... (6 N^2 + 2 vertices; 91, 182)

A quad sphere, two handles of about 500 vertices each (LaplacianDeform: the same vertices as anchors, moved by a hook).
Printed: bind with the first update, of fresh objects (five binds, the peer's three; a small mesh was bound before, so that
nothing is loaded within them); one update while a handle moves, everything Blender does until the evaluated mesh is there; how long Blender takes for that with nothing to deform, so the most that any deformer could reach; both without
that share; a handle added while posing (LaplacianDeform has to be bound anew). Medians; the peer's times from the same run.
"""

import math
import os
import sys
import time

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
from blender_bodies import active  # noqa: E402

mesh_data, session = blender_addon.modules("mesh_data", "session")


def sphere(name, n):
    """A cube of 6 n^2 quads on the unit sphere: 6 n^2 + 2 vertices."""
    ticks = np.tan(np.linspace(-math.pi / 4, math.pi / 4, n + 1))
    u, v = (a.ravel() for a in np.meshgrid(ticks, ticks, indexing="ij"))
    one = np.ones_like(u)
    sides = [(one, u, v), (-one, v, u), (v, one, u), (u, -one, v), (u, v, one), (v, u, -one)]
    points = np.vstack([np.stack(side, -1) for side in sides])
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    quad = np.stack([i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1], -1)
    faces = np.vstack([quad + k * (n + 1) ** 2 for k in range(6)])
    _, first, welded = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    points, faces = points[first], welded.ravel()[faces]
    points /= np.linalg.norm(points, axis=1)[:, None]
    faces = faces.tolist()
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.tolist(), [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    order, k = np.argsort(points[:, 2]), min(500, len(points) // 20)
    for group, members in (("hf low", order[:k]), ("hf high", order[-k:]),
        ("middle", np.flatnonzero(points[:, 0] > 0.98)[:k])):
        obj.vertex_groups.new(name=group).add(members.tolist(), 1.0, "REPLACE")
    obj.vertex_groups.new(name="anchors").add(np.concatenate([order[:k], order[-k:]]).tolist(), 1.0, "REPLACE")
    return obj


def timed(function):
    begin = time.perf_counter()
    function()
    return 1e3 * (time.perf_counter() - begin)


def evaluate(obj):
    return obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices[0].co.copy()


def forget_everything():
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)


def processor_time(function):
    """Milliseconds by the clock, and of the processor in all threads: what a loaded machine does not change."""
    begin = time.process_time()
    wall = timed(function)
    return wall, 1e3 * (time.process_time() - begin)


def bind_ours(size):
    """A fresh object with both handles in place, the pose solved and its first update seen; how to drag it; the times."""
    forget_everything()
    obj = sphere("hf", size)
    active(obj)

    def drag(k):
        high = bpy.data.objects["hf high"]
        high.location = Vector((0.4 * math.sin(0.3 * k), 0, 1.0 + 0.3 * math.cos(0.3 * k)))
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        evaluate(obj)

    return obj, drag, processor_time(lambda: (bpy.ops.hf.add_groups(prefix="hf "), evaluate(obj), drag(0)))


def bind_peer(size, hook_at):
    """The same with a hook on the upper handle in front of LaplacianDeform."""
    forget_everything()
    peer = sphere("peer", size)
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

    def drag(k):
        target.location = Vector((0.4 * math.sin(0.3 * k), 0, float(hook_at[2]) + 0.3 * math.cos(0.3 * k)))
        bpy.context.view_layer.update()
        evaluate(peer)

    times = processor_time(
        lambda: (bpy.ops.object.laplaciandeform_bind(modifier="laplace"), evaluate(peer), drag(1)))
    assert laplace.is_bind
    return peer, drag, times


def bench(size, frames=21, binds=5, peer_binds=3):
    ours = []
    for _ in range(binds):
        obj, drag, times = bind_ours(size)
        ours.append(times)
    bind, cpu = np.median(ours, axis=0)
    n = len(obj.data.vertices)
    update = np.median([timed(lambda: drag(k)) for k in range(1, frames)])
    inner = np.median([(drag(k), session.figures["update_ms"])[1] for k in range(1, frames)])

    def touch():  # what Blender itself needs to take over a mesh whose vertices have changed
        obj.data.vertices.foreach_set("co", session.sessions[obj["hf_key"]].posed.ravel())
        obj.data.update()
        bpy.context.view_layer.update()
        evaluate(obj)

    floor = np.median([timed(touch) for _ in range(frames)])
    add = timed(lambda: bpy.ops.hf.add_handle(group="middle"))
    found = session.session_of(obj, bind=False)
    assert found is not None and not found.surface.closed
    assert found.pose.handle_count == 3
    hook_at = found.rest[mesh_data.group_vertices(obj, "hf high")].mean(0)

    theirs = []
    for _ in range(peer_binds):
        peer, peer_drag, times = bind_peer(size, hook_at)
        theirs.append(times)
    peer_bind, peer_cpu = np.median(theirs, axis=0)
    peer_update = np.median([timed(lambda: peer_drag(k)) for k in range(2, 7)])
    evaluated = peer.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    moved = np.abs(mesh_data.positions_of(evaluated) - mesh_data.positions_of(peer.data)).max()
    assert moved > 0.1, "the peer does not follow its hook"
    print(f"RESULT {n} vertices: bind {bind:.0f} ms ({', '.join(f'{wall:.0f}' for wall, _ in ours)}), peer {peer_bind:.0f} ms: {peer_bind / bind:.0f}x "
          f"(processor time {cpu:.0f} and {peer_cpu:.0f} ms: {peer_cpu / cpu:.0f}x); "
          f"update until the evaluated mesh is there {update:.1f} ms, peer {peer_update:.0f} ms: "
          f"{peer_update / update:.0f}x; "
          f"Blender alone, with any deformer of no cost, {floor:.1f} ms: {peer_update / floor:.0f}x; "
          f"without that share {inner:.2f} ms, peer {peer_update - floor:.0f} ms: "
          f"{(peer_update - floor) / inner:.0f}x; "
          f"handle added while posing {add:.1f} ms without a factorisation")


bind_ours(12), bind_peer(12, np.array([0.0, 0, 1]))  # loads what there is to load
for size in [int(x) for x in sys.argv[sys.argv.index("--") + 1:]] or [91, 182]:
    bench(size)
