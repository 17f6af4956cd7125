# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures made of numbers, for the built scenes: textures that tile and a sky. All from fixed seeds."""

from __future__ import annotations

import math

import bpy
import numpy as np


def noise(size: int, seed: int, falloff: float = 1.0, stretch: float = 1.0) -> np.ndarray:
    """Tiling noise in [0, 1] with a power-law spectrum; `stretch` > 1 draws it out along u."""
    fy, fx = np.fft.fftfreq(size)[:, None] * size, np.fft.fftfreq(size)[None, :] * size * stretch
    weight = 1.0 / np.maximum(np.hypot(fx, fy), 1.0) ** (1.0 + falloff)
    white = np.random.default_rng(seed).standard_normal((size, size))
    values = np.fft.ifft2(np.fft.fft2(white) * weight).real
    low, high = np.quantile(values, (0.01, 0.99))
    return np.clip((values - low) / (high - low), 0.0, 1.0)


def blend(a, b, t: np.ndarray) -> np.ndarray:
    return np.asarray(a) * (1.0 - t[..., None]) + np.asarray(b) * t[..., None]


def wood(size: int, seed: int) -> np.ndarray:
    """Eight boards with their own tone and grain."""
    grain = noise(size, seed, 0.6, 12.0)
    row = np.arange(size) * 8 // size
    tone = np.random.default_rng(seed + 100).uniform(0.6, 1.0, 8)[row][:, None]
    gap = (np.arange(size) % (size // 8) < max(1, size // 400))[:, None]
    return blend((0.30, 0.16, 0.08), (0.72, 0.48, 0.27), grain) * (tone * np.where(gap, 0.25, 1.0))[..., None]


def plaster(size: int, seed: int) -> np.ndarray:
    return blend(
        (0.74, 0.70, 0.63), (0.90, 0.88, 0.84), 0.6 * noise(size, seed, 0.8) + 0.4 * noise(size, seed + 1, 0.1)
    )


def cloth(size: int, seed: int) -> np.ndarray:
    v, u = np.mgrid[0:size, 0:size] * (2 * math.pi * 32 / size)
    weave = 0.5 + 0.25 * np.sin(u) * np.cos(v) + 0.25 * np.sin(v)
    return blend((0.20, 0.08, 0.10), (0.55, 0.28, 0.25), 0.7 * weave + 0.3 * noise(size, seed, 0.5))


def tiles(size: int, seed: int) -> np.ndarray:
    v, u = np.mgrid[0:size, 0:size] * 8 // size
    which = np.random.default_rng(seed).integers(0, 3, (8, 8))[v, u]
    colors = np.array([(0.12, 0.35, 0.42), (0.82, 0.78, 0.66), (0.60, 0.22, 0.10)])[which]
    edge = (np.mgrid[0:size, 0:size] % (size // 8) < size // 128).any(0)
    return np.where(edge[..., None], 0.55, colors * (0.85 + 0.15 * noise(size, seed + 1))[..., None])


def sky(width: int, seed: int) -> np.ndarray:
    """An equirectangular day: blue above, haze, clouds, a sun of a few pixels, dull ground. Linear."""
    height = width // 2
    v = (np.arange(height) + 0.5) / height
    up = np.sin(math.pi * (v - 0.5))[:, None]
    clear = blend((0.62, 0.68, 0.74), (0.10, 0.22, 0.55), np.clip(up * 1.4, 0, 1) * np.ones((1, width)))
    cloud = np.clip(noise(width, seed, 1.0, 0.5)[:height] * 2.2 - 1.2, 0, 1) * np.clip(up * 4, 0, 1)
    out = blend(np.zeros(3), np.ones(3), cloud) * 1.3 + clear * (1 - cloud[..., None])
    out = np.where((up > 0)[..., None], out, np.array((0.16, 0.14, 0.11)))
    y, x = int(height * (0.5 + 38 / 180)), int(width * 0.30)
    radius = max(1, width // 700)
    out[y - radius : y + radius, x - radius : x + radius] = (
        np.array((1.0, 0.86, 0.66)) * 0.55 * (width / radius) ** 2 / 40.0
    )
    return out


def image(name: str, color: np.ndarray, linear: bool = False) -> bpy.types.Image:
    """A packed image of (h, w, 3), bottom row first: 8-bit sRGB, or floats when `linear`."""
    h, w = color.shape[:2]
    data = bpy.data.images.new(name, w, h, alpha=False, float_buffer=linear)
    if linear:
        names = bpy.types.ColorManagedInputColorspaceSettings.bl_rna.properties["name"].enum_items.keys()
        data.colorspace_settings.name = next(n for n in ("Linear Rec.709", "Linear", "Non-Color") if n in names)
    data.pixels.foreach_set(np.concatenate([color, np.ones((h, w, 1))], -1).astype(np.float32).ravel())
    data.update()
    data.pack()
    return data


def box_uvs(obj: bpy.types.Object) -> None:
    """UVs in metres by projecting each face along its main axis."""
    mesh = obj.data
    layer = mesh.uv_layers.new(name="UVMap")
    for face in mesh.polygons:
        axis = max(range(3), key=lambda i: abs(face.normal[i]))
        a, b = ((1, 2), (0, 2), (0, 1))[axis]
        for corner in face.loop_indices:
            at = mesh.vertices[mesh.loops[corner].vertex_index].co
            layer.data[corner].uv = (at[a], at[b])
