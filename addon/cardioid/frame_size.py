# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels of the frame and of the render border, computed as Blender computes them."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np


@dataclass(frozen=True)
class Shape:
    """size: pixels of the render result. area: the border as in `crop`."""

    size: tuple[int, int]
    area: tuple[int, int, int, int]


def resolution(render: bpy.types.RenderSettings) -> tuple[int, int]:
    """Width and height of the whole frame, percentage applied."""
    percent = render.resolution_percentage
    return max(1, render.resolution_x * percent // 100), max(1, render.resolution_y * percent // 100)


def crop(render: bpy.types.RenderSettings) -> tuple[int, int, int, int]:
    """The render border as x, y, width, height from the bottom left; zeros without a border."""
    if not render.use_border:
        return 0, 0, 0, 0
    width, height = resolution(render)
    left, right = _pixel(render.border_min_x, width), _pixel(render.border_max_x, width)
    bottom, top = _pixel(render.border_min_y, height), _pixel(render.border_max_y, height)
    if right <= left or top <= bottom:
        return 0, 0, 0, 0
    return left, bottom, right - left, top - bottom


def result_size(render: bpy.types.RenderSettings) -> tuple[int, int]:
    """Pixels that the render result wants: those of the border, or of the whole frame."""
    area = crop(render)
    return (area[2], area[3]) if area[2] else resolution(render)


def shape(render: bpy.types.RenderSettings) -> Shape:
    return Shape(result_size(render), crop(render))


def _pixel(fraction: float, size: int) -> int:
    """Blender multiplies and truncates in single precision: 0.7 of 10 pixels is 7 there and 6 in double."""
    return int(np.float32(fraction) * np.float32(size))
