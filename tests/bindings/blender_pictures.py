"""Pictures of the add-on for its README, in Blender with a window: blender_pictures.py MODEL.glb FOLDER.

The sidebar shows the tab hf alone. Three states: bound with proposed handles; the head pulled; a field in strips.
"""

import os
import sys
import traceback

import bpy
import numpy
from mathutils import Quaternion, Vector

MODEL, FOLDER = sys.argv[sys.argv.index("--") + 1:][:2]
numpy.bool = bool  # Blender 3.4's own glTF importer still asks newer numpy for it
bpy.context.preferences.view.show_splash = False
bpy.ops.preferences.addon_install(filepath=os.environ["HF_ADDON_ZIP"])
bpy.ops.preferences.addon_enable(module="hf_blender")


def view():
    window = bpy.context.window_manager.windows[0]
    area = max((a for a in window.screen.areas if a.type == "VIEW_3D"), key=lambda a: a.width * a.height)
    return window, area, next(r for r in area.regions if r.type == "WINDOW")


def inside(operator, *arguments, **options):
    window, area, region = view()
    with bpy.context.temp_override(window=window, area=area, region=region):
        return operator(*arguments, **options)


def picture(name):
    """The window without the bars above and below, as FOLDER/NAME.jpg."""
    path = os.path.join(FOLDER, f"{name}.png")
    inside(bpy.ops.screen.screenshot, filepath=path)
    shot = bpy.data.images.load(path)
    width, height = shot.size
    pixels = numpy.empty(4 * width * height, numpy.float32)
    shot.pixels.foreach_get(pixels)
    cut = pixels.reshape(height, width, 4)[80:height - 80, 230:].ravel()  # rows from below
    image = bpy.data.images.new(name, width - 230, height - 160)
    image.pixels.foreach_set(cut)
    image.filepath_raw, image.file_format = os.path.join(FOLDER, f"{name}.jpg"), "JPEG"
    image.save()
    assert os.path.getsize(image.filepath_raw) > 15000, name
    bpy.data.images.remove(shot), bpy.data.images.remove(image)
    os.remove(path)


def activate(obj):
    for other in bpy.context.view_layer.objects:
        other.select_set(other is obj)
    bpy.context.view_layer.objects.active = obj


def set_up():
    for leftover in list(bpy.data.objects):
        bpy.data.objects.remove(leftover)
    for panel in bpy.types.Panel.__subclasses__():  # the tabs of others; Blender's own tab Item stays
        if (getattr(panel, "bl_region_type", ""), getattr(panel, "bl_space_type", "")) == ("UI", "VIEW_3D") \
                and getattr(panel, "bl_category", "") != "hf" and panel.is_registered:
            bpy.utils.unregister_class(panel)
    inside(bpy.ops.import_scene.gltf, filepath=MODEL)
    inside(bpy.ops.screen.screen_full_area, use_hide_panels=False)


def look():
    _, area, _ = view()
    space = area.spaces.active
    space.show_region_ui, space.show_region_toolbar = True, False
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.overlay.show_cursor = space.overlay.show_text = space.overlay.show_extras = True
    space.overlay.show_relationship_lines = False
    space.shading.color_type, space.shading.light = "OBJECT", "STUDIO"
    body = max((o for o in bpy.data.objects if o.type == "MESH"), key=lambda o: len(o.data.vertices))
    for polygon in body.data.polygons:
        polygon.use_smooth = True
    body.color = (0.55, 0.62, 0.72, 1)
    activate(body)
    for other in bpy.data.objects:
        other.hide_set(other.type == "ARMATURE")
    corners = [body.matrix_world @ Vector(c) for c in body.bound_box]
    low, high = (Vector(f(c[k] for c in corners) for k in range(3)) for f in (min, max))
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_location = (low + high) / 2
    space.region_3d.view_distance = 1.25 * (high - low).length
    space.region_3d.view_rotation = Quaternion((0, 0, 1), 0.9) @ Quaternion((1, 0, 0), 1.36)


def open_tab():
    window, area, _ = view()
    sidebar = next(r for r in area.regions if r.type == "UI")
    place = {"x": sidebar.x + sidebar.width - 12, "y": sidebar.y + sidebar.height - 62}  # the tab below Item
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", **place)
    window.event_simulate(type="LEFTMOUSE", value="PRESS", **place)
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", **place)


def propose():
    activate(mesh())
    assert bpy.ops.hf.propose() == {"FINISHED"}


def mesh():
    return max((o for o in bpy.data.objects if o.type == "MESH"), key=lambda o: len(o.data.vertices))


def pull():
    size = max(mesh().dimensions)
    head = max((o for o in bpy.data.objects if o.type == "EMPTY" and o.empty_display_type == "SPHERE"),
        key=lambda o: o.location.z)
    head.location += Vector((0.02, 0.0, 0.16)) * size
    head.rotation_mode = "QUATERNION"
    activate(head)
    bpy.context.view_layer.update()
    for _ in range(20):
        bpy.ops.hf.update()


def strips():
    assert bpy.ops.hf.field(output="COLOUR") == {"FINISHED"}
    _, area, _ = view()
    area.spaces.active.shading.color_type = "VERTEX"


STEPS = [set_up, look, open_tab, propose, lambda: picture("proposed"), pull, lambda: picture("pulled"), strips,
    lambda: picture("field")]


def tick():
    try:
        STEPS.pop(0)()
        view()[1].tag_redraw()
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    if not STEPS:
        os._exit(0)
    return 1.0


bpy.app.timers.register(tick, first_interval=2.0)
