# SPDX-License-Identifier: GPL-3.0-or-later
"""The Render tab in a real window: Blender's own layouts take what the panels draw, in each mode."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import bpy
import conftest
import pytest

pytestmark = [
    pytest.mark.skipif(getattr(bpy.app, "module", False), reason="Blender as a module has no window"),
    pytest.mark.skipif(not shutil.which("xvfb-run"), reason="needs Xvfb"),
    conftest.needs_engine,
]


def test_render_tab_draws_in_every_mode(tmp_path):
    addons = tmp_path / "scripts" / "addons"
    addons.mkdir(parents=True)
    (addons / "cardioid").symlink_to(conftest.k_root / "addon" / "cardioid")
    environment = {**os.environ, "BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"), "LIBGL_ALWAYS_SOFTWARE": "1",
                   "BLENDER_USER_CONFIG": str(tmp_path / "config")}
    command = ["xvfb-run", "-a", "-s", "-screen 0 600x1600x24 +extension GLX", bpy.app.binary_path,
               "--factory-startup", "-noaudio", "--addons", "cardioid", "--window-geometry", "0", "0", "600", "1600",
               "--python", str(Path(__file__).parent / "panel_window.py"), "--", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment,
                          stdin=subprocess.DEVNULL)
    text = done.stdout + done.stderr
    assert "PANELS DRAWN" in text and "Traceback" not in text and "Error" not in text, text[-3000:]
    pictures = {path.stem: path.read_bytes() for path in tmp_path.glob("*.png")}
    assert len(pictures) == 3 and len(set(pictures.values())) == 3
