# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside a Blender with a window: the Render tab with every panel open, in each mode, as a PNG in the folder after
`--`. Blender prints a traceback when a panel cannot draw."""

import sys
from pathlib import Path

import bpy

MODES = ["PT", "SPPM", "PTPPM"]
folder = Path(sys.argv[-1])
scene = bpy.context.scene
scene.render.engine = "CARDIOID"
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.view.use_save_prompt = False
left = list(MODES)


def open_all_panels():
    """Panels that start closed would not be drawn."""
    from cardioid.ui import render

    render.unregister()
    for panel in render._classes:
        panel.bl_options = set(getattr(panel, "bl_options", ())) - {"DEFAULT_CLOSED"}
    render.register()


def properties():
    """The Properties editor, alone in the window."""
    window = bpy.context.window_manager.windows[0]
    area = next(one for one in window.screen.areas if one.type in {"PROPERTIES", "VIEW_3D"})
    area.type = "PROPERTIES"
    area.spaces.active.context = "RENDER"
    return window, area


def begin():
    window, area = properties()
    if len(window.screen.areas) > 1:
        with bpy.context.temp_override(window=window, area=area):
            bpy.ops.screen.screen_full_area(use_hide_panels=True)
        return 1.0
    bpy.app.timers.register(next_mode, first_interval=0.5)
    return None


def next_mode():
    if not left:
        print("PANELS DRAWN", flush=True)
        bpy.ops.wm.quit_blender()
        return None
    scene.cardioid.integrator = left[0]
    properties()[1].tag_redraw()
    bpy.app.timers.register(shoot, first_interval=1.0)
    return None


def shoot():
    window, _ = properties()
    with bpy.context.temp_override(window=window):
        bpy.ops.screen.screenshot(filepath=str(folder / f"{left.pop(0)}.png"))
    return next_mode()


open_all_panels()
bpy.app.timers.register(begin, first_interval=1.0)
