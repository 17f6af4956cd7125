# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes (inside Blender): cameras, meshes, transforms, lamps, sizes and renders in a row."""

from pathlib import Path

import bpy
from scene_kit import (
    add_mesh,
    add_square,
    case,
    emission,
    lit_world,
    picture,
    render,
    reset,
    square_with,
)

NAN = float("nan")


@case
def good_scene():
    reset()
    square_with(emission("Light"))


@case
def no_camera():
    scene = reset()
    bpy.data.objects.remove(scene.camera)
    square_with(emission("Light"))


@case
def camera_is_a_mesh():
    scene = reset()
    scene.camera = add_square("Not a camera", z=5)
    add_square("Floor").data.materials.append(emission("Light"))


@case
def no_light():
    reset()
    add_square()


@case
def empty_scene():
    reset()
    lit_world(0.5)


@case
def nothing_at_all():
    reset()


@case
def mesh_without_faces():
    reset()
    add_mesh("Points", [(0, 0, 1), (0.5, 0, 1)], [])
    add_mesh("Edge", [(0, 0, 1), (0.5, 0, 1)], [], edges=[(0, 1)])
    add_mesh("Nothing", [], [])
    square_with(emission("Light"))


@case
def nan_vertices():
    reset()
    broken = add_square("Broken", z=1)
    broken.data.vertices[0].co = (NAN, 0, NAN)
    square_with(emission("Light"))


@case
def infinite_vertices():
    reset()
    broken = add_square("Endless", z=1)
    broken.data.vertices[0].co = (float("inf"), 0, 1)
    square_with(emission("Light"))


@case
def nan_transform():
    reset()
    add_square("Lost object", z=1).location = (NAN, 0, 0)
    square_with(emission("Light"))


@case
def flat_transform():
    reset()
    add_square("Flattened", z=1).scale = (0, 0, 0)
    square_with(emission("Light"))


@case
def degenerate_triangles():
    reset()
    add_mesh("Slivers", [(0, 0, 1), (0, 0, 1), (0, 0, 1), (1, 1, 1)], [(0, 1, 2), (0, 1, 3)])
    square_with(emission("Light"))


@case
def collection_inside_itself():
    scene = reset()
    square_with(emission("Light"))
    ring = bpy.data.collections.new("Ring")
    scene.collection.children.link(ring)
    empty = bpy.data.objects.new("Instancer", None)
    ring.objects.link(empty)
    empty.instance_type = "COLLECTION"
    empty.instance_collection = ring


@case
def lamps_of_size_zero():
    scene = reset(samples=16)
    add_square()
    for kind in ("POINT", "SPOT", "SUN", "AREA"):
        data = bpy.data.lights.new(kind, kind)
        data.energy = 10
        for name in ("shadow_soft_size", "angle", "size", "spot_size"):
            if hasattr(data, name):
                setattr(data, name, 0)
        lamp = bpy.data.objects.new(kind, data)
        lamp.location.z = 2
        scene.collection.objects.link(lamp)


@case
def nan_lamp():
    scene = reset()
    square_with(emission("Light"))
    data = bpy.data.lights.new("Broken lamp", "POINT")
    data.energy = NAN
    lamp = bpy.data.objects.new("Broken lamp", data)
    lamp.location.z = 2
    scene.collection.objects.link(lamp)


@case
def one_pixel():
    scene = reset(width=100, height=100)
    scene.render.resolution_percentage = 1
    add_square(size=2).data.materials.append(emission("Light"))


@case
def one_pixel_border():
    scene = reset(width=32, height=32)
    square_with(emission("Light"))
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x = scene.render.border_min_y = 0.5
    scene.render.border_max_x = scene.render.border_max_y = 17 / 32


@case
def two_renders_in_a_row():
    reset()
    square_with(emission("Light"))
    folder = Path(bpy.app.tempdir)
    first, second = render(folder / "first.exr"), render(folder / "second.exr")
    return {**second, "first": first["mean"], "same": first["mean"] == second["mean"]}


@case
def render_from_a_handler():
    """A second render is asked for while the first one runs."""
    reset()
    square_with(emission("Light"))
    answers = []

    def again(*_):
        bpy.app.handlers.render_pre.remove(again)
        try:
            answers.append("".join(bpy.ops.render.render()))
        except RuntimeError as error:
            answers.append(str(error).strip())

    bpy.app.handlers.render_pre.append(again)
    path = Path(bpy.app.tempdir) / "outer.exr"
    return {**render(path), "answers": answers}


@case
def save_into_a_missing_folder():
    scene = reset()
    square_with(emission("Light"))
    blocked = Path(bpy.app.tempdir) / "file"
    blocked.write_text("")
    scene.render.filepath = str(blocked / "below" / "picture.exr")
    try:
        status = "".join(bpy.ops.render.render(write_still=True))
    except RuntimeError as error:
        status = str(error).strip()
    kept = Path(bpy.app.tempdir) / "kept.exr"
    bpy.data.images["Render Result"].save_render(str(kept))
    return {"status": status, **picture(kept)}


@case
def scene_after_all_that():
    """The same scene as the first case: nothing is left over from the bad ones."""
    good_scene()
