# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds metallic_ring.blend: a gold ring on a wooden floor between brick walls, a small lamp above it.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_metallic_ring.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import common as c  # noqa: E402
import surfaces  # noqa: E402


def band(inner: float, outer: float, height: float, steps: int = 72) -> list[tuple[float, float]]:
    """The ring's profile: its inside, almost flat, throws the cardioid; its outside bulges and mirrors the room."""
    middle, points = inner + 0.3 * (outer - inner), []
    for k in range(steps):
        t = 2 * math.pi * k / steps
        power = 2 / 2.3 if math.cos(t) > 0 else 2 / 9.0
        reach = outer - middle if math.cos(t) > 0 else middle - inner
        points.append(
            (
                middle + reach * math.copysign(abs(math.cos(t)) ** power, math.cos(t)),
                height * (0.5 + 0.5 * math.copysign(abs(math.sin(t)) ** power, math.sin(t))) + 0.001,
            )
        )
    return points


def build() -> None:
    scene = c.start(1152, 864)
    planks, wall = surfaces.wood(), surfaces.bricks()
    c.quad("floor", (0, 0, 0), (2.2, 0, 0), (0, 2.2, 0), planks)
    c.quad("wall_back", (0, 1.55, 1.3), (-2.2, 0, 0), (0, 0, 1.3), wall).data.flip_normals()
    c.quad("wall_left", (-1.55, 0, 1.3), (0, 2.2, 0), (0, 0, 1.3), wall)
    c.quad("wall_right", (2.1, 0, 1.3), (0, -2.2, 0), (0, 0, 1.3), wall)
    c.quad("wall_front", (0, -2.2, 1.3), (2.2, 0, 0), (0, 0, 1.3), wall).data.flip_normals()
    skirting = c.material("skirting", "BsdfPrincipled", Base_Color=(0.045, 0.02, 0.01), Roughness=0.4)
    c.box("skirting_back", (2.2, 0.012, 0.055), skirting, bevel=0.006, location=(0, 1.538, 0.055))
    c.box("skirting_left", (0.012, 2.2, 0.055), skirting, bevel=0.006, location=(-1.538, 0, 0.055))
    gold = c.material("gold", "BsdfPrincipled", Base_Color=(0.98, 0.76, 0.40), Metallic=1.0, Roughness=0.0)
    c.revolve("ring", band(0.50, 0.575, 0.22), gold, segments=256)
    c.area_lamp("lamp", (1.12, 0.70, 1.06), (0, 0, 0.05), 0.13, 26.0, (1.0, 0.84, 0.64))
    c.world((0.34, 0.46, 0.66), 0.12)
    c.camera((0.22, -2.05, 1.20), (-0.05, 0.20, 0.17), 45, focus=(0.0, -0.2, 0.1), fstop=4.0)
    scene.view_settings.exposure = 0.75
    c.save(c.output_path(os.path.join(HERE, "metallic_ring.blend")))


build()
