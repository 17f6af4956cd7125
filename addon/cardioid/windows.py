# SPDX-License-Identifier: GPL-3.0-or-later
"""Windows of Blender: which one shows a scene's render result, and rendering from a timer, which has no window."""

from __future__ import annotations

from collections.abc import Iterator

import bpy


def _all() -> Iterator[bpy.types.Window]:
    manager = bpy.context.window_manager
    yield from manager.windows if manager else ()


def _image_editors(window: bpy.types.Window) -> Iterator[bpy.types.Area]:
    return (area for area in window.screen.areas if area.type == "IMAGE_EDITOR")


def showing_result(scene: bpy.types.Scene) -> bpy.types.Window | None:
    """A window in which an Image Editor shows the render result of the scene."""
    for window in _all():
        if window.scene == scene:
            for area in _image_editors(window):
                image = area.spaces.active.image
                if image is not None and image.type == "RENDER_RESULT":
                    return window
    return None


def of_scene(scene: bpy.types.Scene) -> bpy.types.Window | None:
    """A window that has this scene, one with its render result first; None in the background."""
    if bpy.app.background:
        return None
    return showing_result(scene) or next((one for one in _all() if one.scene == scene), None) or next(_all(), None)


def render(window: bpy.types.Window, scene: bpy.types.Scene) -> set[str]:
    """Starts a render job without opening a window for it. Raises RuntimeError with Blender's reason."""
    view = bpy.context.preferences.view
    display = view.render_display_type
    view.render_display_type = "NONE"
    try:
        with bpy.context.temp_override(window=window):
            return bpy.ops.render.render("INVOKE_DEFAULT", scene=scene.name)
    finally:
        view.render_display_type = display


def redraw_panels() -> None:
    for window in _all():
        for area in window.screen.areas:
            if area.type in {"IMAGE_EDITOR", "PROPERTIES"}:
                area.tag_redraw()
