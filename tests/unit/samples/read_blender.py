"""Posed vertices of a glTF as Blender imports it: blender -b --factory-startup --python read_blender.py -- FILE TIMES OUT

Blender's frames are whole, 24 a second and subframes between; its z is up, so x y z become x z -y back.
"""
import json
import sys

import addon_utils
import bpy
import numpy

if not hasattr(numpy, "bool"):
    numpy.bool = bool
file, times, out = sys.argv[sys.argv.index("--") + 1:]
addon_utils.enable("io_scene_gltf2")
bpy.ops.wm.read_factory_settings(use_empty=True)
addon_utils.enable("io_scene_gltf2")
bpy.ops.import_scene.gltf(filepath=file, merge_vertices=False)
scene = bpy.context.scene
rate = scene.render.fps / scene.render.fps_base
meshes = [o for o in scene.objects if o.type == "MESH" and o.users_collection and not o.name.startswith("Icosphere")]
frames = []
for time in times.split(","):
    frame = float(time) * rate
    scene.frame_set(int(frame), subframe=frame - int(frame))
    points = []
    graph = bpy.context.evaluated_depsgraph_get()
    for o in meshes:
        posed = o.evaluated_get(graph)
        mesh = posed.to_mesh()
        for vertex in mesh.vertices:
            p = posed.matrix_world @ vertex.co
            points.extend((p.x, p.z, -p.y))
        posed.to_mesh_clear()
    frames.append(points)
json.dump({"frames": frames}, open(out, "w"))
