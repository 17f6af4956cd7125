# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered shading in the viewport: says that it is not there yet."""

from __future__ import annotations

import blf
import bpy

k_lines = ("Cardioid does not render in the viewport yet",
           "Material Preview shows the materials; F12 renders the picture")
k_text_size = 16


def draw_notice(region: bpy.types.Region) -> None:
    """Two lines of text at the bottom of the region, clear of the scene and of Blender's own texts."""
    font = 0
    scale = bpy.context.preferences.system.ui_scale
    if bpy.app.version >= (4, 0):
        blf.size(font, k_text_size * scale)
    else:
        blf.size(font, k_text_size * scale, 72)
    blf.color(font, 0.9, 0.9, 0.9, 1.0)
    height = 1.6 * k_text_size * scale
    for number, line in enumerate(k_lines):
        width = blf.dimensions(font, line)[0]
        blf.position(font, (region.width - width) / 2, height * (len(k_lines) + 0.5 - number), 0)
        blf.draw(font, line)
