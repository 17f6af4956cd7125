# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns an evaluated depsgraph into the engine's scene.

    exported = build_scene(core, depsgraph, view_layer, ExportOptions(resolution=(1920, 1080), settings={...}))

`core` is anything with a `Scene` class as docs/python-api.md describes. Failures of single objects become warnings that
name the object; only what makes a picture impossible (no camera) raises ExportError.
"""

from .options import ExportCancelled, Exported, ExportError, ExportOptions
from .scene import build_scene

__all__ = ["ExportCancelled", "ExportError", "ExportOptions", "Exported", "build_scene"]
