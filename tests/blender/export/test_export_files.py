# SPDX-License-Identifier: GPL-3.0-or-later
"""Every real .blend file at hand goes through the exporter without an exception or an object lost to one."""

from pathlib import Path

import addon_utils
import bpy
import pytest

from .kit import add, export, quad

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


def test_a_library_that_is_gone_is_named(scene, tmp_path):
    quad_object = add(quad("Linked"))
    library = tmp_path / "lib.blend"
    bpy.data.libraries.write(str(library), {quad_object})
    bpy.data.objects.remove(quad_object)
    add(quad("Here"))
    with bpy.data.libraries.load(str(library), link=True) as (source, target):
        target.objects = list(source.objects)
    scene.collection.objects.link(target.objects[0])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "user.blend"))
    assert not export().warnings
    library.unlink()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "user.blend"))
    exported = export()
    assert len(exported.warnings) == 1 and "lib.blend" in exported.warnings[0] and "Linked" in exported.warnings[0]
    assert [i["name"] for i in exported.scene.instances] == ["Here"]
