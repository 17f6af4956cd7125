# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every bad scene that needs no process of its own, in one Blender (test_bad_scenes.py says what must hold).

usage: blender -b --factory-startup --python cases.py [-- case ...]
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import cases_caustics  # noqa: F401  (registers its cases)
import cases_images  # noqa: F401
import cases_materials  # noqa: F401
import cases_nodes  # noqa: F401
import cases_objects  # noqa: F401
import scene_kit

scene_kit.run_all(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
