# SPDX-License-Identifier: GPL-3.0-or-later
"""`blender -b file -E CARDIOID -f 1 -- --cardioid-…` as a farm runs it, with the add-on in the user's folder."""

from __future__ import annotations

import json
import os
import subprocess

import bpy
import conftest
import pytest

pytestmark = [
    pytest.mark.skipif(getattr(bpy.app, "module", False), reason="Blender as a module has no command line"),
    conftest.needs_engine,
]


@pytest.fixture
def blender(tmp_path):
    """blender(*arguments) -> CompletedProcess, in a user folder of its own that has the add-on."""
    addons = tmp_path / "scripts" / "addons"
    addons.mkdir(parents=True)
    (addons / "cardioid").symlink_to(conftest.k_root / "addon" / "cardioid")
    environment = {**os.environ, "BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"),
                   "BLENDER_USER_CONFIG": str(tmp_path / "config")}

    def run(*arguments):
        command = [bpy.app.binary_path, "--background", "--factory-startup", "-noaudio", "--addons", "cardioid"]
        return subprocess.run([*command, *map(str, arguments)], capture_output=True, text=True, timeout=100,
                              env=environment, stdin=subprocess.DEVNULL, cwd=tmp_path)

    return run


@pytest.fixture
def file(tmp_path, fresh_file):
    """A small file that says Cycles."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = 32, 18
    path = tmp_path / "file.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_frame_and_statistics(blender, file, tmp_path):
    done = blender(file, "-E", "CARDIOID", "-o", tmp_path / "out_####", "-F", "PNG", "-f", "2", "--",
                   "--cardioid-samples", "3", "--cardioid-seed", "5", "--cardioid-stats", tmp_path / "stats.json")
    assert done.returncode == 0 and "Traceback" not in done.stdout + done.stderr, done.stdout + done.stderr
    assert (tmp_path / "out_0002.png").stat().st_size > 100
    render = json.loads((tmp_path / "stats.json").read_text())["renders"][0]
    assert (render["frame"], render["samples"], render["settings"]["seed"]) == (2, 3, 5)


def test_wrong_value_is_one_sentence(blender, file, tmp_path):
    done = blender(file, "-E", "CARDIOID", "-o", tmp_path / "out_####", "-f", "1", "--", "--cardioid-samples", "none")
    text = done.stdout + done.stderr
    assert "'none' is not a whole number of at least 1" in text and "Traceback" not in text


def test_engine_is_listed(blender):
    assert "CARDIOID" in blender("-E", "help").stdout
