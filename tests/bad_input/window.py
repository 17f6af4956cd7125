# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside a Blender with a window: F12, F12 again while that runs, then quit in the middle of it."""

import time

import bpy

bpy.context.scene.render.engine = "CARDIOID"
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.view.use_save_prompt = False
bpy.context.preferences.view.render_display_type = "NONE"
started = 0.0


def note(*_) -> None:
    """The render has begun."""
    global started
    started = started or time.monotonic()


def press_f12() -> str:
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        return "".join(bpy.ops.render.render("INVOKE_DEFAULT"))


def first():
    print("FIRST", press_f12(), flush=True)
    bpy.app.timers.register(second, first_interval=0.2)


def second():
    if not started or time.monotonic() - started < 2:
        return 0.2
    print("SECOND", press_f12(), flush=True)
    print("QUITTING", flush=True)
    bpy.ops.wm.quit_blender()


bpy.app.handlers.render_pre.append(note)
bpy.app.timers.register(first, first_interval=0.5)
