# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds swimming_pool.blend: a tiled pool in the sun; light that the waves gather on its floor, seen through them.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_swimming_pool.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import common as c  # noqa: E402
import pool  # noqa: E402
import pool_things as things  # noqa: E402
import surfaces  # noqa: E402


def build() -> None:
    scene = c.start(960, 640, 128)
    pool.build()
    things.ladder(1.35, -1)
    things.ring((-1.05, -0.30, pool.LEVEL + 0.055), (math.radians(3), math.radians(-2), 0.4))
    things.ball((1.35, 0.55, pool.LEVEL + 0.13), (0.7, 0.35, 0.5))
    things.garden_walls(4.6, 7.2)
    clay, leaf = (
        surfaces.stucco("terracotta", (0.52, 0.20, 0.095)),
        things.leaf_green("agave leaf", (0.055, 0.13, 0.075), (0.15, 0.25, 0.15)),
    )
    for x, y, size, seed in ((-2.6, 4.1, 0.85, 3), (1.35, 4.1, 0.6, 5), (6.4, 3.9, 0.95, 8), (6.5, 1.4, 0.8, 11)):
        things.potted_agave(x, y, size, seed, clay, leaf)
    fir = things.leaf_green("cypress leaf", (0.012, 0.035, 0.014), (0.035, 0.075, 0.025))
    things.cypresses(((-1.2, 6.3, 4.3), (0.6, 6.6, 5.0), (2.2, 6.4, 4.5), (9.3, 5.4, 5.2), (9.2, 3.2, 4.4)), fir)
    wood, cloth = surfaces.teak(), c.material("canvas", "BsdfDiffuse", Color=(0.74, 0.71, 0.64))
    things.bench(-0.1, 4.1, wood)
    things.parasol(5.05, 3.35, cloth, wood)
    things.lounger(3.95, 3.05, 0.25, wood, cloth)
    c.camera((-4.15, -2.75, 1.28), (0.25, 0.62, -0.42), 27)
    scene.view_settings.exposure = -0.2
    c.save(c.output_path(os.path.join(HERE, "swimming_pool.blend")))


build()
