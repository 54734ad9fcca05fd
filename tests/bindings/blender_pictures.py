"""Pictures of the add-on for its README, in Blender with a window: blender_pictures.py MODEL.glb FOLDER.

The sidebar shows the tab hf alone. Three states: bound with proposed handles; the head pulled; a field in strips. Then
quads that follow a stroke, which simulated events drag as a user would.
"""

import math
import os
import sys

import bpy
import numpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Quaternion, Vector

MODEL, FOLDER = sys.argv[sys.argv.index("--") + 1:][:2]
numpy.bool = bool  # Blender 3.4's own glTF importer still asks newer numpy for it
sys.path.insert(0, os.environ["HF_TESTS"])
import blender_addon  # noqa: E402
import blender_window  # noqa: E402
from blender_bodies import active  # noqa: E402
from blender_window import click, inside, only_view, open_tab, run, sidebar, undo, view  # noqa: E402

panels, quads = blender_addon.modules("panels", "quads")


def done(made, state, *rest, shown=quads.done):
    """What was made, without the times of this machine: it draws by its processor, beside other tests."""
    shown(made, state, *rest)
    state.line = state.line.split(",")[0]


quads.done = done


def say(layout, context, sentence, *rest, shown=panels.say):
    """A sentence of the tab without the times of this machine."""
    shown(layout, context, sentence.split(", factor")[0], *rest)


panels.say = say


def screen():
    """The window without the bars above and below: rows from below."""
    path = os.path.join(FOLDER, "screen.png")
    inside(bpy.ops.screen.screenshot, filepath=path)
    shot = bpy.data.images.load(path)
    width, height = shot.size
    pixels = numpy.empty(4 * width * height, numpy.float32)
    shot.pixels.foreach_get(pixels)
    bpy.data.images.remove(shot)
    os.remove(path)
    return pixels.reshape(height, width, 4)[80:height - 80, 230:]


def picture(name, pixels=None):
    """FOLDER/NAME.jpg."""
    pixels = screen() if pixels is None else pixels
    image = bpy.data.images.new(name, pixels.shape[1], pixels.shape[0])
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = os.path.join(FOLDER, f"{name}.jpg"), "JPEG"
    image.save()
    assert os.path.getsize(image.filepath_raw) > 15000, name
    bpy.data.images.remove(image)


def set_up():
    for leftover in list(bpy.data.objects):
        bpy.data.objects.remove(leftover)
    inside(bpy.ops.import_scene.gltf, filepath=MODEL)
    only_view()


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
    active(body)
    for other in bpy.data.objects:
        other.hide_set(other.type == "ARMATURE")
    corners = [body.matrix_world @ Vector(c) for c in body.bound_box]
    low, high = (Vector(f(c[k] for c in corners) for k in range(3)) for f in (min, max))
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_location = (low + high) / 2
    space.region_3d.view_distance = 1.25 * (high - low).length
    space.region_3d.view_rotation = Quaternion((0, 0, 1), 0.9) @ Quaternion((1, 0, 0), 1.36)


def propose():
    active(mesh())
    assert bpy.ops.hf.propose() == {"FINISHED"}


def mesh():
    return max((o for o in bpy.data.objects if o.type == "MESH"), key=lambda o: len(o.data.vertices))


def pull():
    size = max(mesh().dimensions)
    head = max((o for o in bpy.data.objects if o.type == "EMPTY" and o.empty_display_type == "SPHERE"),
        key=lambda o: o.location.z)
    head.location += Vector((0.02, 0.0, 0.09)) * size  # the ears stay in the picture
    head.rotation_mode = "QUATERNION"
    active(head)
    bpy.context.view_layer.update()
    for _ in range(20):
        bpy.ops.hf.update()


def strips():
    assert bpy.ops.hf.field(output="COLOUR") == {"FINISHED"}
    _, area, _ = view()
    area.spaces.active.shading.color_type = "VERTEX"


def event(kind, value="PRESS", at=(0, 0)):
    """at: from the origin of the stroke, in pixels."""
    _, _, region = view()
    middle = location_3d_to_region_2d(region, region.data, bpy.data.objects["stroke"].location)
    blender_window.event(kind, value, middle + Vector(at))


def move(degrees):
    event("MOUSEMOVE", "NOTHING", (150 * math.cos(math.radians(degrees)), 150 * math.sin(math.radians(degrees))))


def make_quads():
    """Quads of the body at rest, with a stroke over the flank and a pole of 5 on the croup."""
    _, area, _ = view()
    space = area.spaces.active
    body = mesh()
    active(body)
    assert bpy.ops.hf.unbind() == {"FINISHED"}
    right, up, back = (space.region_3d.view_rotation @ Vector(axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    middle = sum((body.matrix_world @ Vector(c) for c in body.bound_box), Vector()) / 8
    size, into = max(body.dimensions), body.matrix_world.inverted()

    def on_body(x, y):
        start = middle + size * (x * right + y * up + 2 * back)
        hit, place, _, _ = body.ray_cast(into @ start, into.to_3x3() @ -back)
        assert hit, (x, y)
        return body.matrix_world @ place

    line = bpy.data.curves.new("stroke", "CURVE")
    line.dimensions = "3D"
    spline = line.splines.new("POLY")
    places = [on_body(0.01 * i - 0.09, 0.05 + 0.002 * i) for i in range(23)]
    centre = on_body(0.02, 0.072)
    spline.points.add(len(places) - 1)
    for point, place in zip(spline.points, places):
        point.co = (*(place - centre), 1)
    stroke = bpy.data.objects.new("stroke", line)
    stroke.location = centre
    bpy.context.scene.collection.objects.link(stroke)
    stroke.show_in_front = True
    stroke.select_set(True)
    assert bpy.ops.hf.quads(faces=5000) == {"FINISHED"}
    body.hide_set(True)
    made = quads_made()
    active(made)
    bpy.context.scene.cursor.location = on_body(0.17, 0.11)
    assert bpy.ops.hf.add_pole(count="5") == {"FINISHED"}
    bpy.context.active_object.show_in_front = True
    bpy.context.scene.cursor.location = (0, 0, -10 * size)
    made.color, made.show_wire, made.show_all_edges = (0.55, 0.62, 0.72, 1), True, True
    space.shading.color_type = "OBJECT"
    space.overlay.wireframe_threshold = 1
    space.region_3d.view_distance *= 0.7
    space.region_3d.view_location += size * (0.05 * up + 0.08 * right)
    active(stroke)
    bpy.ops.ed.undo_push(message="quads, a stroke and a pole")


def quads_made():
    return next(o for o in bpy.data.objects if o.type == "MESH" and o.hf_quads.key)


def places_of(obj):
    out = numpy.empty(3 * len(obj.data.vertices), numpy.float32)
    obj.data.vertices.foreach_get("co", out)
    return out


def open_panel():
    """A click on the panel Quads, below the sentence at the top."""
    click(sidebar().x + 60, sidebar().y + sidebar().height - 88)


def turn_stroke():
    """R, and the mouse goes around the stroke: a drag of Blender's own."""
    seen["made"] = places_of(quads_made())
    move(0)
    event("R", at=(150, 0))
    event("R", "RELEASE", at=(150, 0))


def on_the_way():
    made = quads_made()
    assert not made.data["hf_quads_relaxed"] and len(places_of(made)) and not numpy.array_equal(places_of(made), seen["made"]), \
        "quads follow while the mouse button is not released yet"


def let_go():
    event("LEFTMOUSE", at=(0, 0))
    event("LEFTMOUSE", "RELEASE", at=(0, 0))


def relaxed():
    """Again in a second while the thread is at work."""
    waits = seen["waits"] = seen.get("waits", 0) + 1
    assert waits < 60, "quads are relaxed when the mouse rests"
    if quads_made().data["hf_quads_relaxed"]:
        seen["waits"] = 0
    return seen["waits"] > 0


def show_pole():
    """The pole from near, along its normal."""
    pole = next(o for o in bpy.data.objects if "hf_pole" in o)
    active(pole)
    space = view()[1].spaces.active
    space.region_3d.view_location = pole.location
    space.region_3d.view_rotation = Quaternion((0, 0, 1), 0.1) @ space.region_3d.view_rotation
    space.region_3d.view_distance *= 0.25


def take_back():
    assert abs(bpy.data.objects["stroke"].matrix_world.to_quaternion().angle) > 0.3
    undo()


def undone():
    assert abs(bpy.data.objects["stroke"].matrix_world.to_quaternion().angle) < 1e-6
    assert numpy.array_equal(places_of(quads_made()), seen["made"]), "undo of the drag takes the quads back"


seen = {}
STEPS = [set_up, look, open_tab, propose, lambda: picture("proposed"), pull, lambda: picture("pulled"), strips,
    lambda: picture("field"), make_quads, relaxed, open_panel, lambda: move(0), lambda: picture("drawn", screen()[:, :760]), turn_stroke,
    lambda: move(-10), lambda: move(-30), on_the_way, lambda: picture("followed"), lambda: move(-50), let_go, relaxed, take_back, relaxed,
    undone, show_pole, lambda: None, lambda: picture("pole")]

run(STEPS, 1.0)
