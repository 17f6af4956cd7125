# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a script in another process of the Blender that the tests run in."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import bpy

k_here = Path(__file__).parent

k_start = f"""
import os, sys, threading, time
sys.path[:0] = [{str(k_here.parents[2] / "addon")!r}, {str(k_here)!r}]
import bpy
import cardioid
import fake_engine

def use(engine):
    if engine == "fake":
        sys.modules["cardioid._core"] = fake_engine
    cardioid.register()
    scene = bpy.context.scene
    scene.render.engine = "CARDIOID"
    scene.render.resolution_percentage = 100
    return scene

"""


def run(script: Path, text: str, seconds: float = 100) -> subprocess.CompletedProcess:
    """`text` runs after the add-on was imported; `use("fake" or "real")` registers it and returns the scene."""
    script.write_text(k_start + text)
    if getattr(bpy.app, "module", False):
        command = [sys.executable, str(script)]
    else:
        command = [bpy.app.binary_path, "--background", "--factory-startup", "-noaudio", "--python", str(script)]
    return subprocess.run(command, capture_output=True, text=True, timeout=seconds, stdin=subprocess.DEVNULL)
