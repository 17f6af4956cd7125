# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: an opened file made comparable. Its own camera, lamps and bounces stay; what one engine alone
clamps, blurs or filters is off; a file without a camera gets one, a library of materials a wall of balls."""

from __future__ import annotations

import math

import bpy
import common
import kit
from mathutils import Vector

CELL = 48
"""Pixels of a ball's cell in a library's picture."""


def settings(scene: bpy.types.Scene, width: int, samples: int, blur: bool) -> None:
    """The same settings for both engines."""
    render = scene.render
    render.resolution_y = max(1, round(render.resolution_y * width / render.resolution_x))
    render.resolution_x, render.resolution_percentage = width, 100
    render.use_motion_blur = blur and render.use_motion_blur
    render.use_compositing = render.use_sequencer = render.use_border = render.use_multiview = False
    render.use_freestyle = False
    render.dither_intensity = 0.0
    output = render.image_settings
    if hasattr(output, "media_type"):
        output.media_type = "IMAGE"
    output.file_format, output.color_mode, output.color_depth = "OPEN_EXR", "RGBA", "32"
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.time_limit = 0.0
    if bpy.app.version < (3, 5):
        cycles.sampling_pattern = "SOBOL"
    else:
        cycles.sampling_pattern = "TABULATED_SOBOL"
        cycles.use_guiding = False


def used(scene: bpy.types.Scene) -> list:
    """Materials, world and lamps that this file's picture may need."""
    owners = {scene.world} | {o.data for o in scene.objects if o.type == "LIGHT"}

    def add(obj) -> None:
        if obj.data is None:
            return  # 3.4 crashes at the slots of an evaluated empty
        owners.update(s.material.original for s in obj.material_slots if s.material)
        owners.update(m.original for m in getattr(obj.data, "materials", ()) if m)

    for obj in bpy.data.objects:
        if obj.users_scene or obj.users_collection:
            add(obj)
    for item in bpy.context.evaluated_depsgraph_get().object_instances:
        add(item.object)  # at once: the item is gone with the next step
    return sorted((o for o in owners if o is not None), key=lambda o: (type(o).__name__, o.name))


def is_library(scene: bpy.types.Scene) -> bool:
    """No camera, and many materials that no object wears."""
    worn = {s.material for o in scene.objects for s in o.material_slots}
    return scene.camera is None and len([m for m in bpy.data.materials if m not in worn]) >= 5


def add_camera(scene: bpy.types.Scene) -> None:
    """Looks down at all that is rendered, as near as it can."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    corners: list[float] = []
    for item in depsgraph.object_instances:
        if item.object.type not in ("LIGHT", "CAMERA", "EMPTY"):
            corners += [x for c in item.object.bound_box for x in item.matrix_world @ Vector(c)]
    data = bpy.data.cameras.new("added camera")
    camera = scene.camera = common.add(data, "added camera", Vector((0.55, -0.75, 0.4)))
    common.aim(camera, (0, 0, 0))
    depsgraph.update()
    camera.location, _ = camera.camera_fit_coords(depsgraph, corners)
    distance = max((Vector(corners[i : i + 3]) - camera.location).length for i in range(0, len(corners), 3))
    data.clip_start, data.clip_end = distance * 1e-4, distance * 2.0


def balls(scene: bpy.types.Scene) -> list[str]:
    """A wall of balls, one for each material, before a chequered wall under a sky with a sun and a lamp; the names
    by rows from the top. The picture is CELL pixels a ball."""
    for obj in list(scene.collection.all_objects):
        obj.hide_render = True
    scene.view_layers[0].use = True
    materials = sorted((m for m in bpy.data.materials if not m.is_grease_pencil), key=lambda m: m.name)
    columns = math.ceil(math.sqrt(len(materials) * 1.3))
    rows = math.ceil(len(materials) / columns)
    for i, material in enumerate(materials):
        x, z = i % columns - (columns - 1) / 2, (rows - 1) / 2 - i // columns
        ball = common.sphere(f"ball {i}", (x, 0, z), 0.42, material, 48, 24)
        layer = ball.data.uv_layers.new(name="UVMap")
        uvs = [sphere_uv(ball.data.vertices[loop.vertex_index].co) for loop in ball.data.loops]
        layer.data.foreach_set("uv", [v for uv in uvs for v in uv])
    wall = kit.graph("wall")
    shade = wall.node("TexChecker", {"Scale": 4.0, "Color1": (0.6, 0.55, 0.5), "Color2": (0.25, 0.3, 0.35)})
    wall.feed(shade.inputs["Vector"], wall.node("TexCoord").outputs["Object"])
    surface = wall.surface(wall.node("BsdfDiffuse", {"Color": shade.outputs["Color"]}))
    common.quad("wall", (0, 1.2, 0), (columns, 0, 0), (0, 0, rows), surface)
    scene.world = bpy.data.worlds.new("sky")
    sky = common.Graph(scene.world, "ShaderNodeOutputWorld")
    image = sky.node("TexEnvironment", image=kit.sky_image())
    sky.surface(sky.node("Background", {"Color": image.outputs["Color"], "Strength": 0.6}))
    kit.lamp("AREA", (columns * 0.4, -columns * 1.2, rows * 0.9), (0, 0, 0), size=3.0, energy=18.0 * columns**2)
    camera = common.camera((0, -20, 0), (0, 0, 0), 50.0)
    camera.data.type, camera.data.ortho_scale = "ORTHO", max(columns, rows)
    scene.render.resolution_x, scene.render.resolution_y = columns * CELL, rows * CELL
    return [m.name for m in materials]


def sphere_uv(point) -> tuple[float, float]:
    return math.atan2(point.y, point.x) / math.tau + 0.5, math.acos(max(-1.0, min(1.0, point.z / 0.42))) / math.pi
