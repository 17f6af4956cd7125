# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside a Blender with a window: renders, then tunes the filter while an Image Editor shows the result. Pictures
as they would be saved go into the folder after `--`; what happened is printed, one line each."""

import sys
import traceback
from pathlib import Path

import bpy

folder = Path(sys.argv[-1])
scene = bpy.context.scene
scene.render.engine = "CARDIOID"
scene.render.resolution_x, scene.render.resolution_y = 320, 180
scene.cardioid.samples = 4
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.exr_codec = "NONE"
scene.render.image_settings.color_depth = "32"
view = bpy.context.preferences.view
view.show_splash = view.use_save_prompt = False
view.render_display_type = "WINDOW"
renders = []


def window():
    return bpy.context.window_manager.windows[0]


def largest_area():
    return max(window().screen.areas, key=lambda area: area.width * area.height)


def only_cardioids_tab():
    """The sidebar shows one tab, and a script cannot choose which."""
    for panel in bpy.types.Panel.__subclasses__():
        place = tuple(getattr(panel, f"bl_{what}", "") for what in ("space_type", "region_type"))
        if place == ("IMAGE_EDITOR", "UI") and panel.is_registered and getattr(panel, "bl_category", "") != "Cardioid":
            bpy.utils.unregister_class(panel)


def save(name):
    bpy.data.images["Render Result"].save_render(str(folder / f"{name}.exr"), scene=scene)


def tell(what, *values):
    print("WINDOW", what, *values, flush=True)


def settled():
    """Waits until nothing is rendered, filtered or due."""
    from cardioid import retune

    quiet = 0
    while quiet < 3:
        busy = retune.current() or retune.state(scene.name)[0] or bpy.app.is_job_running("RENDER")
        quiet = 0 if busy else quiet + 1
        yield 0.1


def press_f12():
    with bpy.context.temp_override(window=window()):
        bpy.ops.render.render("INVOKE_DEFAULT")
    yield from settled()


def steps():
    from cardioid import films, retune

    bpy.app.handlers.render_init.append(lambda *_: renders.append(retune.current() is not None))
    view.render_display_type = "NONE"
    yield from press_f12()
    scene.cardioid.filter_size = 9
    yield from settled()
    tell("UNSEEN", films.get("Scene", "ViewLayer", "").settings["filter_size"], len(renders))
    scene.cardioid.filter_size = 11

    area = largest_area()
    area.type = "IMAGE_EDITOR"
    space = area.spaces.active
    space.image, space.show_region_ui = bpy.data.images["Render Result"], True
    view.render_display_type = "WINDOW"
    save("first")
    windows = len(bpy.context.window_manager.windows)

    for size in (3, 5, 25, 5):
        scene.cardioid.filter_size = size
        yield 0.05
    yield from settled()
    tell("LIVE", films.get("Scene", "ViewLayer", "").settings["filter_size"], all(renders[1:]), len(renders) > 1)
    tell("WINDOWS", len(bpy.context.window_manager.windows) - windows, view.render_display_type)
    save("live")

    bpy.context.preferences.view.render_display_type = "NONE"
    yield from press_f12()
    save("fresh")
    tell("F12", renders[-1])

    scene.cardioid.use_filter = False
    yield from settled()
    save("off")
    with bpy.context.temp_override(window=window(), area=area):
        bpy.ops.screen.screenshot(filepath=str(folder / "panel.png"))

    scene.cardioid.live_filter = False
    scene.cardioid.use_filter = True
    yield from settled()
    tell("STALE", films.get("Scene", "ViewLayer", "").settings["use_filter"])
    with bpy.context.temp_override(window=window(), area=area):
        bpy.ops.cardioid.filter_again()
    yield from settled()
    save("again")

    with bpy.context.temp_override(window=window(), area=area):
        bpy.ops.cardioid.save_film(filepath=str(folder / "film.cardioid"))
    scene.render.resolution_x = 400
    with bpy.context.temp_override(window=window(), area=area):
        bpy.ops.cardioid.open_film(filepath=str(folder / "film.cardioid"))
    image = space.image
    while films.of_image(image.name).settings == {}:
        yield 0.1
    tell("IMAGE", image.name, tuple(image.size), round(sum(image.pixels[:4000]), 3) > 0)
    tell("DONE")
    bpy.ops.wm.quit_blender()


def tick():
    try:
        return next(work)
    except StopIteration:
        return None
    except Exception:
        traceback.print_exc()
        bpy.ops.wm.quit_blender()


only_cardioids_tab()
work = steps()
bpy.app.timers.register(tick, first_interval=1.0)
