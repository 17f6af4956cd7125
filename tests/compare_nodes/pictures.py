# SPDX-License-Identifier: GPL-3.0-or-later
"""Image files and other files that the cases read, written into the worker's folder."""

from __future__ import annotations

import os
from typing import Any

import bpy
import numpy as np
from tile import assign


def colourful(width: int = 12, height: int = 10, seed: int = 1) -> np.ndarray:
    """(h, w, 4) in [0, 1], bottom row first: a gradient with noise, no symmetry, alpha that changes."""
    rng = np.random.default_rng(seed)
    v, u = np.mgrid[0:height, 0:width] / (max(width, height) - 1)
    out = np.stack([0.1 + 0.8 * u, 0.9 - 0.7 * v, 0.2 + 0.5 * u * v, 0.25 + 0.7 * v], -1)
    return np.clip(out + rng.uniform(-0.15, 0.15, out.shape), 0.0, 1.0)


def bright(width: int = 16, height: int = 8) -> np.ndarray:
    """(h, w, 4) of an HDRI: from -0.1 to 20."""
    out = colourful(width, height, 5)
    out[..., :3] = out[..., :3] ** 4 * 20.0 - 0.1
    out[..., 3] = 1.0
    return out


def write(path: str, pixels: np.ndarray, kind: str = "PNG", alpha: bool = True, mode: str = "", depth: str = "") -> str:
    """Saves an image file; values are those that the file stores. mode: BW, RGB or RGBA; depth: 8, 16 or 32."""
    if os.path.exists(path):
        return path
    h, w = pixels.shape[:2]
    data = bpy.data.images.new("writer", w, h, alpha=alpha, float_buffer=bool(depth) or kind == "OPEN_EXR")
    data.colorspace_settings.name = "Non-Color"
    data.pixels.foreach_set(np.ascontiguousarray(pixels, np.float32).ravel())
    if mode or depth:
        scene = bpy.data.scenes.new("writer")
        settings = scene.render.image_settings
        settings.file_format = kind
        settings.color_mode = mode or "RGBA"
        if depth:
            settings.color_depth = depth
        scene.view_settings.view_transform = "Raw"
        data.save_render(path, scene=scene)
        bpy.data.scenes.remove(scene)
    else:
        data.filepath_raw, data.file_format = path, kind
        data.save()
    bpy.data.images.remove(data)
    return path


def load(path: str, space: str = "", alpha_mode: str = "") -> bpy.types.Image:
    data = bpy.data.images.load(path)
    if space:
        assign(data.colorspace_settings, "name", space)
    if alpha_mode:
        assign(data, "alpha_mode", alpha_mode)
    return data


def png(tile: Any, space: str = "", alpha_mode: str = "") -> bpy.types.Image:
    """The colourful picture with 8 bits a channel."""
    return load(write(os.path.join(tile.folder, "colourful.png"), colourful()), space, alpha_mode)


def opaque(tile: Any, space: str = "") -> bpy.types.Image:
    """The same without alpha, so that what alpha does to bytes shows in cases of its own."""
    solid = colourful()
    solid[..., 3] = 1.0
    return load(write(os.path.join(tile.folder, "opaque.png"), solid), space)


def exr(tile: Any, space: str = "", alpha_mode: str = "") -> bpy.types.Image:
    return load(write(os.path.join(tile.folder, "bright.exr"), bright(), "OPEN_EXR"), space, alpha_mode)


def udim(tile: Any) -> bpy.types.Image:
    """Tiles 1001, 1002 and 1011, of different sizes; 1012 is missing."""
    for number, size in ((1001, 8), (1002, 5), (1011, 12)):
        pixels = colourful(size, size, number)
        pixels[..., 3] = 1.0
        write(os.path.join(tile.folder, f"tiles.{number}.png"), pixels)
    data = bpy.data.images.load(os.path.join(tile.folder, "tiles.1001.png"))
    data.source = "TILED"
    data.filepath = os.path.join(tile.folder, "tiles.<UDIM>.png")
    for number in (1002, 1011):
        if all(t.number != number for t in data.tiles):
            data.tiles.new(number)
    return data


IES = """IESNA:LM-63-1995
[TEST] made for the comparison
TILT=NONE
1 1000 1.5 5 3 1 2 0.1 0.1 0.1
1 1 100
0 30 60 80 90
0 90 180
400 350 200 60 5
380 300 180 50 4
360 320 150 20 2
"""


def ies(tile: Any) -> str:
    path = os.path.join(tile.folder, "lamp.ies")
    if not os.path.exists(path):
        with open(path, "w") as file:
            file.write(IES)
    return path
