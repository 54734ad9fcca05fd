"""A Blender with a window: its 3D view, events as a user makes them, and steps one after the other."""

import os
import traceback

import bpy

bpy.context.preferences.view.show_splash = False


def view():
    window = bpy.context.window_manager.windows[0]
    area = max((a for a in window.screen.areas if a.type == "VIEW_3D"), key=lambda a: a.width * a.height)
    return window, area, next(r for r in area.regions if r.type == "WINDOW")


def inside(operator, *arguments, **options):
    window, area, region = view()
    with bpy.context.temp_override(window=window, area=area, region=region):
        return operator(*arguments, **options)


def only_view():
    """One 3D view, and no tab of others than hf."""
    for panel in bpy.types.Panel.__subclasses__():  # Blender's own tab Item stays
        if (getattr(panel, "bl_region_type", ""), getattr(panel, "bl_space_type", "")) == ("UI", "VIEW_3D") \
                and getattr(panel, "bl_category", "") != "hf" and panel.is_registered:
            bpy.utils.unregister_class(panel)
    inside(bpy.ops.screen.screen_full_area, use_hide_panels=False)


def click(x, y):
    """x, y: pixels of the window."""
    window, _, _ = view()
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, x=x, y=y)


def sidebar():
    return next(r for r in view()[1].regions if r.type == "UI")


def open_tab():
    """The tab below Item."""
    click(sidebar().x + sidebar().width - 12, sidebar().y + sidebar().height - 62)


def event(kind, value="PRESS", at=(0, 0), **keys):
    """at: pixels in the 3D view."""
    window, _, region = view()
    window.event_simulate(type=kind, value=value, x=int(region.x + at[0]), y=int(region.y + at[1]), **keys)


def undo():
    event("Z", ctrl=True)
    event("Z", "RELEASE", ctrl=True)


def run(steps, seconds, failed=lambda: None):
    """Calls one step after the other and ends Blender. A step that returns true is not ready: it is called again."""
    def tick():
        try:
            if steps[0]():
                return seconds
            steps.pop(0)
            view()[1].tag_redraw()
        except BaseException:
            traceback.print_exc()
            failed()
            os._exit(1)
        if not steps:
            print("blender with a window: all right", flush=True)
            os._exit(0)
        return seconds

    bpy.app.timers.register(tick, first_interval=2.0)
