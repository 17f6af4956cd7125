# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: small scenes whose right picture is known, and what a render of them gave.

The camera looks straight down at the square [-1,1]² and is orthographic, so a picture of an
emitting square is its colour.
"""

from __future__ import annotations

import json
import os
import tempfile
import time
import traceback
from collections.abc import Callable
from pathlib import Path

import addon_utils
import bpy
import numpy as np

# CYCLES shows what Blender itself makes of these scenes.
ENGINE = os.environ.get("CARDIOID_TEST_ENGINE", "CARDIOID")
CASES: dict[str, Callable[[], dict | None]] = {}


def case(function: Callable[[], dict | None]) -> Callable[[], dict | None]:
    """Registers a case: it builds a scene; then the harness renders, unless the case returns its own result."""
    CASES[function.__name__] = function
    return function


def reset(*, width: int = 32, height: int = 24, samples: int = 4) -> bpy.types.Scene:
    """An empty factory scene that Cardioid renders, camera in place."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles", persistent=True)
    if ENGINE == "CARDIOID":
        addon_utils.enable("cardioid", persistent=True)
    scene = bpy.context.scene
    scene.render.engine = ENGINE
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    if ENGINE == "CARDIOID":
        scene.cardioid.samples = samples
        scene.cardioid.use_filter = scene.cardioid.use_adaptive_sampling = False  # pictures as they are traced
    else:
        scene.cycles.samples, scene.cycles.use_denoising = samples, False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.exr_codec = "NONE"  # Blender misses a full disk when the file fits its last buffer
    scene.view_settings.view_transform = "Standard"
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 1.9
    camera.location = (0, 0, 5)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return scene


def add_mesh(name: str, vertices, faces, *, edges=()) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, edges, faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def add_square(name: str = "Square", *, z: float = 0.0, size: float = 1.0) -> bpy.types.Object:
    """The square [-size,size]² with a UV map over all of it."""
    corners = [(-size, -size, z), (size, -size, z), (size, size, z), (-size, size, z)]
    obj = add_mesh(name, corners, [(0, 1, 2, 3)])
    layer = obj.data.uv_layers.new(name="UVMap")
    for loop, uv in zip(layer.data, [(0, 0), (1, 0), (1, 1), (0, 1)]):
        loop.uv = uv
    return obj


def node_material(name: str) -> bpy.types.Material:
    """A material with nothing but its output node."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    for node in list(material.node_tree.nodes):
        if node.bl_idname != "ShaderNodeOutputMaterial":
            material.node_tree.nodes.remove(node)
    return material


def output_of(tree: bpy.types.NodeTree) -> bpy.types.Node:
    return next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")


def emission(name: str, color=(0.25, 0.5, 0.75)) -> bpy.types.Material:
    material = node_material(name)
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeEmission")
    node.inputs["Color"].default_value = (*color, 1)
    tree.links.new(node.outputs[0], output_of(tree).inputs["Surface"])
    return material


def square_with(material) -> bpy.types.Object:
    obj = add_square()
    obj.data.materials.append(material)
    return obj


def image_emission(name: str, image: bpy.types.Image | None) -> bpy.types.Material:
    """Emission whose colour is the image over the object's UV map."""
    material = emission(name)
    tree = material.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    node = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeEmission")
    tree.links.new(texture.outputs["Color"], node.inputs["Color"])
    return material


def lit_world(strength: float = 1.0) -> None:
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = next(n for n in world.node_tree.nodes if n.bl_idname == "ShaderNodeBackground")
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    background.inputs["Strength"].default_value = strength
    bpy.context.scene.world = world


def picture(path: Path) -> dict:
    """Size, means and extremes of a saved picture; rows from the bottom."""
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    width, height = image.size
    pixels = pixels.reshape(height, width, -1)
    half = max(1, width // 2)
    result = {
        "size": [width, height],
        "finite": bool(np.isfinite(pixels).all()),
        "mean": pixels.mean((0, 1)).tolist(),
        "left": pixels[:, :half].mean((0, 1)).tolist(),
        "right": pixels[:, -half:].mean((0, 1)).tolist(),
        "lowest": float(pixels[..., :3].min()),
        "highest": float(pixels[..., :3].max()),
    }
    bpy.data.images.remove(image)
    return result


def render(path: Path) -> dict:
    """Renders to an EXR at `path`: how it ended, how long it took, and what the picture looks like if there is one."""
    path.unlink(missing_ok=True)
    bpy.context.scene.render.filepath = str(path)
    start = time.monotonic()
    try:
        status = "".join(bpy.ops.render.render(write_still=True))
    except RuntimeError as error:
        status = str(error).strip()
    result = {"status": status, "seconds": time.monotonic() - start, "written": path.exists()}
    if path.exists():
        result.update(picture(path))
    return result


def run_case(name: str, folder: Path) -> None:
    """One case between two marker lines; the second carries its result as JSON."""
    print(f"CASE-BEGIN {name}", flush=True)
    try:
        result = CASES[name]()
        if result is None:
            result = render(folder / f"{name}.exr")
    except BaseException as error:
        result = {"status": f"the case itself failed: {error!r}", "trace": traceback.format_exc()}
    print(f"\nCASE-END {name} {json.dumps(result)}", flush=True)


def run_all(names: list[str]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for name in names or CASES:
            run_case(name, Path(folder))
    os._exit(0)
