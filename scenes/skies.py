# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the sky made with numpy, as packed half-float EXR for the world."""

from __future__ import annotations

import math
import os
import tempfile

import bpy
import common as c
import numpy as np


def directions(width: int, height: int) -> np.ndarray:
    """Unit vectors (height × width × 3) of an equirectangular picture's pixels, as Blender maps them, from below."""
    phi = (0.5 - (np.arange(width) + 0.5) / width) * 2 * np.pi
    up = ((np.arange(height) + 0.5) / height - 0.5) * np.pi
    phi, up = np.meshgrid(phi, up)
    return np.stack([np.cos(up) * np.cos(phi), np.cos(up) * np.sin(phi), np.sin(up)], -1)


def direction(azimuth: float, elevation: float) -> np.ndarray:
    """The unit vector of an azimuth (degrees from +x to +y) and an elevation (degrees)."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])


def smoothstep(low: float, high: float, x):
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3 - 2 * t)


def blobs(at: np.ndarray, count: int, size: tuple[float, float], band: tuple[float, float], seed: int) -> np.ndarray:
    """Round spots of light at random azimuths, elevations in a band, radii in degrees: the sum of their coverages."""
    random = np.random.default_rng(seed)
    total = np.zeros(at.shape[:2])
    for _ in range(count):
        center = direction(random.uniform(0, 360), random.uniform(*band))
        edge = math.cos(math.radians(random.uniform(*size)))
        total += random.uniform(0.3, 1.0) * smoothstep(edge, 1 - 0.6 * (1 - edge), at @ center)
    return total


def evening_garden(azimuth: float, elevation: float, width: int = 1024) -> np.ndarray:
    """A low sun and a hedge: radiance (width/2 × width × 3); the sun is 1.1° wide to stay below half's largest."""
    at = directions(width, width // 2)
    sun = direction(azimuth, elevation)
    toward = np.clip(at @ sun, -1.0, 1.0)
    up = at[..., 2]
    warm = np.clip(0.5 + 0.5 * toward, 0, 1)[..., None]
    high = np.array([0.07, 0.15, 0.36])
    low = (1 - warm) * np.array([0.20, 0.25, 0.34]) + warm**2 * np.array([0.9, 0.58, 0.32])
    sky = low + (high - low) * smoothstep(0.0, 0.65, up)[..., None]
    glow = 5.0 * np.exp(-(1 - toward) / 0.004) + 1.0 * np.exp(-(1 - toward) / 0.05)
    sky += glow[..., None] * np.array([1.0, 0.80, 0.52])
    ground = np.array([0.050, 0.062, 0.018]) * (0.35 + 1.2 * warm**3)
    picture = np.where((up > 0)[..., None], sky, ground)
    phi = np.arctan2(at[..., 1], at[..., 0])
    top = 0.17 + 0.05 * np.sin(3 * phi + 1) + 0.03 * np.sin(11 * phi) + 0.018 * np.sin(29 * phi + 2)
    leaves = smoothstep(0.03, -0.02, up - top) * smoothstep(-0.52, -0.36, up)
    lit = blobs(at, 900, (0.5, 1.8), (-24, 12), 2).clip(0, 1.6)[..., None]
    shade = (0.35 + 1.3 * warm**3) * (0.55 + 0.75 * smoothstep(-0.45, 0.15, up))[..., None]
    hedge = shade * np.array([0.105, 0.135, 0.030]) + lit * (0.04 + 0.55 * warm**4) * np.array([0.52, 0.58, 0.12])
    picture = picture + leaves[..., None] * (hedge - picture)
    gaps = blobs(at, 420, (0.15, 0.5), (-20, 12), 3).clip(0, 1)[..., None] * leaves[..., None]
    picture += gaps * (0.2 + 6.0 * warm**4) * np.array([1.0, 0.80, 0.42])
    disc = smoothstep(math.cos(math.radians(0.72)), math.cos(math.radians(0.38)), toward)
    return (picture + disc[..., None] * 52000.0 * np.array([1.0, 0.80, 0.55])).astype(np.float32)


def packed(name: str, picture: np.ndarray) -> bpy.types.Image:
    """The picture (height × width × 3, rows from below) as a half-float EXR inside the file."""
    height, width = picture.shape[:2]
    made = bpy.data.images.new(name, width, height, float_buffer=True)
    made.pixels.foreach_set(np.concatenate([picture, np.ones((height, width, 1))], -1).astype(np.float32).ravel())
    settings = bpy.context.scene.render.image_settings
    before = settings.file_format
    settings.file_format, settings.color_mode, settings.color_depth, settings.exr_codec = (
        "OPEN_EXR",
        "RGB",
        "16",
        "DWAA",
    )
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name + ".exr")
        made.save_render(path)
        bpy.data.images.remove(made)
        image = bpy.data.images.load(path)
        image.pack()
        image.name = name
        image.filepath = image.packed_files[0].filepath = f"//{name}.exr"
    settings.file_format = before
    return image


def world(image: bpy.types.Image, strength: float = 1.0) -> None:
    """Lights the scene by the picture."""
    data = bpy.data.worlds.new("World")
    graph = c.Graph(data, "ShaderNodeOutputWorld")
    environment = graph.node("TexEnvironment")
    environment.image = image
    graph.surface(graph.node("Background", {"Color": environment.outputs["Color"], "Strength": strength}))
    bpy.context.scene.world = data
