# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds under_water.blend: the pool of swimming_pool.blend from inside: the net of light, and Snell's window above.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_under_water.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import common as c  # noqa: E402
import pool  # noqa: E402
import pool_things as things  # noqa: E402
from swimmer import swimmer  # noqa: E402


def build() -> None:
    scene = c.start(960, 720, 128)
    pool.build()
    things.ladder(1.35, -1)
    things.ring((0.9, 1.0, pool.LEVEL + 0.055), (0.05, -0.03, 0.4))
    things.ball((-0.2, -0.5, pool.LEVEL + 0.10), (2.3, 0.35, 0.5))
    things.garden_walls(4.6, 7.2)
    swimmer((-1.35, -0.05, -1.30), (-0.25, -0.12, math.radians(140)))
    c.camera((-3.2, -1.2, -1.05), (0.5, 0.75, -0.50), 15)
    scene.view_settings.exposure = 0.6
    c.save(c.output_path(os.path.join(HERE, "under_water.blend")))


build()
