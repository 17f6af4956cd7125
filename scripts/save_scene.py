# SPDX-License-Identifier: GPL-3.0-or-later
"""Run inside Blender: saves what Cardioid would render as a scene file for `cardioid-render`.

usage: blender -b scene.blend --addons cardioid --python-exit-code 1 --python scripts/save_scene.py -- OUT.cardioid
"""

import sys
import traceback
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).resolve().parents[1] / "addon"))

from cardioid import core, export, frame_size, passes, resolve

saved: list[str] = []


class SceneSaver(bpy.types.RenderEngine):
    """A render engine that writes a file instead of a picture: only an engine gets the depsgraph as rendered."""

    bl_idname = "CARDIOID_SAVER"
    bl_label = "Save a Cardioid scene"

    def render(self, depsgraph):
        try:
            self.save(depsgraph, sys.argv[-1])
        except Exception:
            traceback.print_exc()

    def save(self, depsgraph, path: str) -> None:
        engine = core.load()
        if engine is None:
            raise RuntimeError(core.problem())
        scene, layer = depsgraph.scene_eval, depsgraph.view_layer_eval
        options = export.ExportOptions(
            resolution=frame_size.resolution(scene.render),
            crop=frame_size.crop(scene.render),
            settings=resolve.resolve(scene, layer, {}, preview=False),
            passes=tuple(one.engine for one in passes.enabled(layer)),
            engine=self,
        )
        exported = export.build_scene(engine, depsgraph, layer, options)
        exported.scene.save(path)
        saved.append(path)
        for warning in [*exported.warnings, *exported.scene.problems()]:
            print(f"Warning: {warning}")


def main() -> None:
    bpy.utils.register_class(SceneSaver)
    bpy.context.scene.render.engine = SceneSaver.bl_idname
    bpy.ops.render.render()
    bpy.utils.unregister_class(SceneSaver)
    if not saved:
        raise SystemExit("Error: no scene was saved")
    print(saved[0])


main()
