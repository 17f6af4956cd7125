# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds cornell_sky.blend: two spheres in a box that is open to an even sky.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_cornell_sky.py -- OUT.blend
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import common as c  # noqa: E402
import soft_box  # noqa: E402

soft_box.box(open_top=True)
c.save(c.output_path("cornell_sky.blend"))
