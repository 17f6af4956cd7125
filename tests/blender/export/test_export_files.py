# SPDX-License-Identifier: GPL-3.0-or-later
"""Every real .blend file at hand goes through the exporter without an exception or an object lost to one."""

from pathlib import Path

import addon_utils
import bpy
import pytest

from .kit import add, export

_FOLDER = Path(__file__).resolve().parents[4] / "shared" / "blends"
_FILES = sorted(_FOLDER.glob("**/*.blend"))


@pytest.mark.skipif(not _FILES, reason=f"no .blend files in {_FOLDER}")
@pytest.mark.parametrize("path", _FILES, ids=lambda p: getattr(p, "stem", "none"))
def test_file_exports(path):
    if path.parent.name == "needs-4" and bpy.app.version < (4, 0):
        pytest.skip("needs Blender 4")
    addon_utils.enable("cycles")
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path), use_scripts=False)
    except RuntimeError as error:
        pytest.skip(f"this Blender cannot open it: {error}")
    if bpy.context.scene.camera is None:
        bpy.context.scene.camera = add(bpy.data.cameras.new("Camera"))
    exported = export((240, 135))
    scene = exported.scene
    print(f"\n{path.name}: {len(scene.meshes)} meshes, {len(scene.instances)} instances, {len(scene.lights)} lights, "
          f"{len(scene.materials)} materials, {len(scene.images)} images, {exported.timings['total']:.2f} s, "
          f"{exported.warnings}")
    assert scene.meshes and scene.instances
    assert not [w for w in exported.warnings if "left out:" in w or "cannot be read" in w]
