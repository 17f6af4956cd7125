# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a scene has texture and where it has edges of light, from its reference and from what its surfaces are.

The surface's albedo, normal and depth behind mirrors and glass come from Cycles' denoising passes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NORMAL_STEP, NORMAL_WIDTH, DEPTH_STEP = 0.988, 2.0, 0.015
"""An object's edge: neighbours' normals, blurred so that bumps are none, farther apart than this cosine, or a kink of
the depth by this share of it."""
TEXTURE, TEXTURE_WIDTH = 0.03, 2.0
"""High-passed log albedo must vary by this (standard deviation) to be texture; pixels of the high pass."""
LIGHT_STEP = 0.05
"""Light's relative change from pixel to pixel at an edge of light."""
SHEEN = 0.05
"""Added to the albedo where light is told from texture: what a surface reflects whatever its colour."""
MARGIN = 3
"""Pixels around objects' edges that belong to no region, and that an edge of light reaches to each side."""


@dataclass
class Surface:
    """Per pixel: albedo (h, w, 3), normal (h, w, 3) of any length, depth (h, w)."""

    albedo: np.ndarray
    normal: np.ndarray
    depth: np.ndarray


def luminance(picture: np.ndarray) -> np.ndarray:
    return picture[..., :3].astype(np.float64) @ (0.2126, 0.7152, 0.0722)


def blur(values: np.ndarray, width: float) -> np.ndarray:
    """Gaussian blur of (h, w) by a standard deviation in pixels; the border is repeated."""
    reach = int(np.ceil(3 * width))
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / width) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        padded = np.pad(values, [(reach, reach) if a == axis else (0, 0) for a in (0, 1)], "edge")
        count = values.shape[axis]
        values = sum(k * np.take(padded, range(i, i + count), axis) for i, k in enumerate(kernel))
    return values


def grown(mask: np.ndarray, pixels: int) -> np.ndarray:
    """The mask and all pixels within a square of so many pixels around it."""
    for axis in (0, 1):
        padded = np.pad(mask, [(pixels, pixels) if a == axis else (0, 0) for a in (0, 1)])
        count = mask.shape[axis]
        mask = np.any([np.take(padded, range(i, i + count), axis) for i in range(2 * pixels + 1)], axis=0)
    return mask


def median(values: np.ndarray) -> np.ndarray:
    """Of each pixel and its eight neighbours: takes away what reflections in water sprinkle over the depth."""
    padded = np.pad(values, 1, "edge")
    height, width = values.shape
    return np.median([padded[i : i + height, j : j + width] for i in range(3) for j in range(3)], axis=0)


def object_edges(surface: Surface) -> np.ndarray:
    edges = np.zeros(surface.depth.shape, bool)
    depth = median(np.minimum(surface.depth, 1e5))
    facing = np.stack([blur(surface.normal[..., c], NORMAL_WIDTH) for c in range(3)], -1)
    facing /= np.linalg.norm(facing, axis=-1, keepdims=True) + 1e-9
    for axis in (0, 1):
        normal, z = np.moveaxis(facing, axis, 0), np.moveaxis(depth, axis, 0)
        out = np.moveaxis(edges, axis, 0)
        turned = (normal[1:] * normal[:-1]).sum(-1) < NORMAL_STEP
        kink = np.abs(z[2:] - 2 * z[1:-1] + z[:-2]) > DEPTH_STEP * z[1:-1]
        out[1:] |= turned
        out[:-1] |= turned
        out[1:-1] |= kink
    return edges


def gradient(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.gradient(values, axis=0), np.gradient(values, axis=1)


def light_edges(halves: tuple[np.ndarray, np.ndarray], albedo: np.ndarray) -> np.ndarray:
    """Where light of any colour changes in both halves of a reference alike, so that noise is no edge."""
    slopes = []
    for half in halves:
        light = [blur(half[..., c].astype(np.float64) / (albedo[..., c] + SHEEN), 1.2) for c in range(3)]
        level = sum(light) / 3 + 1e-3
        slopes.append([slope / level for channel in light for slope in gradient(channel)])
    return sum(a * b for a, b in zip(*slopes)) / 3 > LIGHT_STEP**2


def regions(halves: tuple[np.ndarray, np.ndarray], surface: Surface) -> dict[str, np.ndarray]:
    """Masks `texture` and `light edges`; neither touches objects' edges."""
    away = ~grown(object_edges(surface), MARGIN)
    tone = np.log(luminance(surface.albedo) + 0.02)
    share = blur(away.astype(float), TEXTURE_WIDTH) + 1e-6
    fine = np.where(away, tone - blur(tone * away, TEXTURE_WIDTH) / share, 0.0)
    textured = np.sqrt(blur(fine * fine, 2 * TEXTURE_WIDTH)) > TEXTURE
    lit = light_edges(halves, surface.albedo) & away
    return {"texture": textured & away, "light edges": grown(lit, MARGIN) & away}
