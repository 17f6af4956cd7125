# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the engine into Blender's render result."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

# Blender 3.4 wants one row per pixel and checks only the number of rows; from 3.5 on a flat buffer
k_flat_buffer = bpy.app.version >= (3, 5)


def upload(render_pass: bpy.types.RenderPass, picture: np.ndarray) -> None:
    """Writes (height, width, channels) floats, bottom row first, into a pass of the same size.

    Missing channels become 0 (a fourth one: 1), surplus ones are dropped.
    """
    pixels = np.ascontiguousarray(_with_channels(picture, render_pass.channels), dtype=np.float32)
    if k_flat_buffer:
        render_pass.rect.foreach_set(pixels.reshape(-1))
    else:
        render_pass.rect.foreach_set(pixels.reshape(-1, render_pass.channels))


def cut(picture: np.ndarray, size: tuple[int, int], area: tuple[int, int, int, int]) -> np.ndarray | None:
    """The part of `picture` that fills a result of `size`: all of it, or `area` of a whole frame; None: no fit."""
    height, width = picture.shape[:2]
    if (width, height) == size:
        return picture
    x, y, w, h = area
    if (w, h) == size and x + w <= width and y + h <= height:
        return picture[y:y + h, x:x + w]
    return None


def _with_channels(picture: np.ndarray, channels: int) -> np.ndarray:
    if picture.ndim == 2:
        picture = picture[..., None]
    have = picture.shape[2]
    if have >= channels:
        return picture[..., :channels]
    wide: Any = np.zeros((*picture.shape[:2], channels), np.float32)
    wide[..., :have] = picture
    if channels == 4:
        wide[..., 3] = 1.0
    return wide
