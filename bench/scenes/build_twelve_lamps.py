# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds twelve_lamps.blend: a gallery of twelve bays with a lamp each; a glass sphere stands in one of them.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_twelve_lamps.py -- OUT.blend
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import common as c  # noqa: E402

BAYS, WIDTH, TALL, DEEP = 12, 2.4, 2.6, 2.4
CASTER = 5


def bay(number: int, plaster) -> None:
    """Bay number 0 … 11 along x: its right wall, and a lamp under the ceiling."""
    left = (number - BAYS / 2) * WIDTH
    c.quad(f"wall{number}", (left + WIDTH, 0, TALL / 2), (0, DEEP / 2, 0), (0, 0, TALL / 2), plaster)
    c.area_lamp(f"lamp{number}", (left + 0.5 * WIDTH, 0.1, TALL - 0.05), (left + 0.5 * WIDTH, 0.1, 0), 0.16, 60.0)


def build() -> None:
    c.start(640, 400)
    plaster = c.material("plaster", "BsdfDiffuse", Color=(0.72, 0.70, 0.66))
    ground = c.material("ground", "BsdfDiffuse", Color=(0.45, 0.38, 0.30))
    long = BAYS * WIDTH / 2
    c.quad("floor", (0, 0, 0), (long, 0, 0), (0, 3 * DEEP, 0), ground)
    c.quad("back", (0, DEEP / 2, TALL / 2), (long, 0, 0), (0, 0, TALL / 2), plaster)
    c.quad("ceiling", (0, 0, TALL), (long, 0, 0), (0, DEEP / 2, 0), plaster)
    c.quad("end", (-long, 0, TALL / 2), (0, DEEP / 2, 0), (0, 0, TALL / 2), plaster)
    for number in range(BAYS):
        bay(number, plaster)
    middle = (CASTER - BAYS / 2 + 0.5) * WIDTH
    glass = c.material("glass", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=1.5, distribution="SHARP")
    c.sphere("glass", (middle + 0.2, -0.1, 0.42), 0.4, glass)
    c.world((0, 0, 0))
    c.camera((middle, -5.2, 1.5), (middle, 0, 0.9), 42)
    c.save(c.output_path("twelve_lamps.blend"))


build()
