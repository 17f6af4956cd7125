# SPDX-License-Identifier: GPL-3.0-or-later
"""The export from start to end."""

from __future__ import annotations

from typing import Any

from .options import Exported, ExportOptions


def build_scene(core: Any, depsgraph: Any, view_layer: Any, options: ExportOptions) -> Exported:
    """Fills a new `core.Scene` from `depsgraph`. Raises ExportError when there is nothing to look through."""
    scene = core.Scene()
    scene.set_settings({**options.settings, "width": options.resolution[0], "height": options.resolution[1],
                        "crop": options.crop})
    return Exported(scene)
