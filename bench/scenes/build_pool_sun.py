# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds pool_sun.blend: a swimming pool in a wide yard under the sun, seen from one end.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_pool_sun.py -- OUT.blend
"""

import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import bpy  # noqa: E402
import common as c  # noqa: E402

HALF_X, HALF_Y, DEPTH, LEVEL = 6.0, 2.5, 1.5, -0.12


def height(x: float, y: float) -> float:
    """Ripples of six directions that do not repeat within the pool."""
    waves = ((1.9, 0.3, 0.9), (-0.7, 2.3, 0.8), (1.2, -1.7, 0.7), (3.1, 1.4, 0.35), (-2.2, 3.3, 0.3), (4.3, -2.9, 0.2))
    return 0.011 * sum(a * math.sin(1.7 * (p * x + q * y) + 2.1 * i) for i, (p, q, a) in enumerate(waves))


def water(surface, steps_x: int = 240, steps_y: int = 100) -> None:
    vertices = [
        (x, y, LEVEL + height(x, y))
        for x in (-HALF_X + 2 * HALF_X * i / steps_x for i in range(steps_x + 1))
        for y in (-HALF_Y + 2 * HALF_Y * j / steps_y for j in range(steps_y + 1))
    ]
    n = steps_y + 1
    faces = [
        (i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1) for i in range(steps_x) for j in range(steps_y)
    ]
    c.mesh("water", vertices, faces, surface, smooth=True)


def basin(tiles) -> None:
    z = (LEVEL - DEPTH) / 2
    half = (DEPTH - LEVEL) / 2
    c.quad("floor", (0, 0, LEVEL - DEPTH), (HALF_X, 0, 0), (0, HALF_Y, 0), tiles)
    for sign in (-1, 1):
        c.quad(f"side_x{sign}", (sign * HALF_X, 0, z), (0, HALF_Y, 0), (0, 0, half), tiles)
        c.quad(f"side_y{sign}", (0, sign * HALF_Y, z), (HALF_X, 0, 0), (0, 0, half), tiles)


def yard(stone, size: float = 40.0) -> None:
    """The ground around the basin: four quads."""
    for sign in (-1, 1):
        rest = (size - HALF_X) / 2
        c.quad(f"ground_x{sign}", (sign * (HALF_X + rest), 0, 0), (rest, 0, 0), (0, size, 0), stone)
        rest = (size - HALF_Y) / 2
        c.quad(f"ground_y{sign}", (0, sign * (HALF_Y + rest), 0), (HALF_X, 0, 0), (0, rest, 0), stone)


def build() -> None:
    c.start(640, 400)
    tiles = c.material("tiles", "BsdfDiffuse", Color=(0.42, 0.68, 0.72))
    stone = c.material("stone", "BsdfDiffuse", Color=(0.58, 0.54, 0.48))
    basin(tiles)
    yard(stone)
    water(c.material("water", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=1.33, distribution="SHARP"))
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = 4.0, math.radians(0.526), (1.0, 0.94, 0.84)
    c.aim(c.add(lamp, "sun", (-6, -4, 12)), (0, 0, 0))
    c.world((0.30, 0.48, 0.80), 0.4)
    c.camera((-8.2, -0.6, 1.9), (-4.4, 0.1, -0.9), 32)
    c.save(c.output_path("pool_sun.blend"))


build()
