# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds coloured_grid.blend: a tilted green grid over a white plane under three coloured lamps of different sizes.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_coloured_grid.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import common as c  # noqa: E402

BARS, PITCH, THICKNESS = 8, 0.26, 0.026


def grid(surface, tilt: float) -> None:
    """Two sets of crossed bars on one frame; the front edge nearly touches the plane, the back edge is a metre up."""
    side = PITCH * (BARS - 1) / 2
    vertices, faces = [], []
    for k in range(BARS):
        at = -side + PITCH * k
        for center, half in (
            ((at, 0.0, 0.0), (THICKNESS, side + THICKNESS, THICKNESS)),
            ((0.0, at, 0.0), (side + THICKNESS, THICKNESS, THICKNESS * 0.96)),
        ):
            first = len(vertices)
            corners = [(sx, sy, sz) for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
            vertices += [tuple(m + s * h for m, s, h in zip(center, corner, half)) for corner in corners]
            sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
            faces += [tuple(first + i for i in face) for face in sides]
    height = (side + THICKNESS) * math.sin(tilt) + 0.03
    c.mesh("grid", vertices, faces, surface, location=(0, 0.1, height), rotation=(tilt, 0, math.radians(16)))


def build() -> None:
    scene = c.start(768, 768, 16)
    c.quad("plane", (0, 0, 0), (9, 0, 0), (0, 9, 0), c.material("white", "BsdfDiffuse", Color=(0.8, 0.8, 0.8)))
    grid(c.material("green", "BsdfDiffuse", Color=(0.07, 0.46, 0.10)), math.radians(28))
    c.area_lamp("lamp_red", (-2.2, -0.9, 3.4), (0, 0, 0.2), 0.06, 190.0, (1.0, 0.10, 0.06))
    c.area_lamp("lamp_blue", (2.1, -1.0, 3.4), (0, 0, 0.2), 0.35, 190.0, (0.10, 0.20, 1.0))
    c.area_lamp("lamp_green", (0.15, 2.3, 3.6), (0, 0, 0.2), 0.9, 120.0, (0.20, 1.0, 0.16))
    c.world((0.0, 0.0, 0.0))
    c.camera((0.1, -3.3, 3.5), (0.0, 0.0, 0.25), 46)
    scene.view_settings.exposure = -0.3
    c.save(c.output_path(os.path.join(HERE, "coloured_grid.blend")))


build()
