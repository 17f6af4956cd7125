# SPDX-License-Identifier: GPL-3.0-or-later
"""A real window: Blender's own layouts take what the panels draw, and a picture follows its filter."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
from pathlib import Path

import bpy
import conftest
import numpy as np
import pictures
import pytest

pytestmark = [
    pytest.mark.skipif(getattr(bpy.app, "module", False), reason="Blender as a module has no window"),
    pytest.mark.skipif(not shutil.which("xvfb-run"), reason="needs Xvfb"),
    conftest.needs_engine,
]


@pytest.fixture
def in_window(tmp_path):
    """in_window(script, width, height) -> what a Blender with a window of that size printed."""
    addons = tmp_path / "scripts" / "addons"
    addons.mkdir(parents=True)
    (addons / "cardioid").symlink_to(conftest.k_root / "addon" / "cardioid")
    environment = {**os.environ, "BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"), "LIBGL_ALWAYS_SOFTWARE": "1",
                   "BLENDER_USER_CONFIG": str(tmp_path / "config")}

    def run(script, width, height):
        size = [str(width), str(height)]
        command = ["xvfb-run", "-a", "-s", f"-screen 0 {width}x{height}x24 +extension GLX", bpy.app.binary_path,
                   "--factory-startup", "-noaudio", "--addons", "cardioid", "--window-geometry", "0", "0", *size,
                   "--python", str(Path(__file__).parent / script), "--", str(tmp_path)]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   env=environment, stdin=subprocess.DEVNULL, start_new_session=True)
        try:
            text, _ = process.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # with Blender and the screen
            text, _ = process.communicate()
            pytest.fail(f"the window did not close:\n{text[-3000:]}")
        assert "Traceback" not in text and "Error" not in text, text[-3000:]
        return text

    return run


def test_render_tab_draws_in_every_mode(in_window, tmp_path):
    assert "PANELS DRAWN" in in_window("panel_window.py", 600, 1600)
    shots = {path.stem: path.read_bytes() for path in tmp_path.glob("*.png")}
    assert len(shots) == 3 and len(set(shots.values())) == 3


def test_a_picture_follows_its_filter(in_window, tmp_path):
    """While an Image Editor shows it the Render Result takes each change by itself, as F12 would have made it."""
    text = in_window("film_window.py", 900, 600)
    told = dict(line.removeprefix("WINDOW ").partition(" ")[::2] for line in text.splitlines() if "WINDOW " in line)
    assert "DONE" in told, text[-3000:]
    assert told["UNSEEN"] == "11 1"         # nobody looks: no render
    assert told["LIVE"] == "5 True True"    # the latest of four changes; every render but the first was a filter's
    assert told["WINDOWS"] == "0 WINDOW"    # none opened, the preference is as it was
    assert told["F12"] == "False" and told["STALE"] == "False"
    assert told["IMAGE"] == "film (320, 180) True"
    saved = {path.stem: pictures.read(path)["R"] for path in tmp_path.glob("*.exr")}
    np.testing.assert_array_equal(saved["live"], saved["fresh"])
    np.testing.assert_array_equal(saved["again"], saved["fresh"])
    for other in ("first", "off"):
        assert not np.array_equal(saved[other], saved["fresh"])
    assert (tmp_path / "panel.png").stat().st_size > 1000
