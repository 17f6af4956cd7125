# SPDX-License-Identifier: GPL-3.0-or-later
"""Exporter tests see Blender, the add-on's export package and the recorder, never the compiled engine."""

import sys
from pathlib import Path

import bpy
import pytest

_ADDON = str(Path(__file__).resolve().parents[3] / "addon")
if _ADDON not in sys.path:
    sys.path.insert(0, _ADDON)


@pytest.fixture
def scene():
    """An empty scene with a camera and Cycles' properties."""
    import addon_utils

    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles")
    current = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    current.collection.objects.link(camera)
    current.camera = camera
    return current
