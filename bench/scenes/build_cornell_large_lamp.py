# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds cornell_large_lamp.blend: two spheres in a box under a lamp as wide as most of its ceiling.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_cornell_large_lamp.py -- OUT.blend
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import common as c  # noqa: E402
import soft_box  # noqa: E402

soft_box.box(open_top=False)
c.area_lamp("lamp", (0, 0, 1.99), (0, 0, 0), 1.6, 60.0, (1.0, 0.9, 0.75))
c.save(c.output_path("cornell_large_lamp.blend"))
