# SPDX-License-Identifier: GPL-3.0-or-later
"""The export from start to end."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from . import camera, colors, values, world
from .image import Images
from .image_files import absolute
from .material import Materials
from .objects import Objects
from .options import Exported, ExportOptions

_NAMED = 5  # things that a message lists


def build_scene(core: Any, depsgraph: Any, view_layer: Any, options: ExportOptions) -> Exported:
    """Fills a new `core.Scene` from `depsgraph`, evaluated for rendering.

    Raises ExportError when there is nothing to look through, ExportCancelled when `options.should_stop` says so.
    """
    exported = Exported(core.Scene())
    target, warnings, timings = exported.scene, exported.warnings, exported.timings
    source = depsgraph.scene_eval
    layer = depsgraph.view_layer_eval or view_layer
    images = Images(target, source.frame_current, warnings)
    materials = Materials(target, images, layer.material_override, warnings,
                          lambda name: values.of_view_layer(source, layer, name))
    with _timed(timings, "total"):
        viewer = camera.camera_object(source, options)
        target.set_camera(camera.describe(viewer, source, options, warnings))
        with _timed(timings, "world"):
            _world(target, world.current(source, layer) if layer.use_sky else None, materials)
        with _timed(timings, "objects"):
            warnings += _missing_libraries()
            Objects(target, depsgraph, layer, materials, options, viewer.matrix_world.translation, warnings).export()
        target.set_settings(_settings(options, images))
    exported.warnings[:] = dict.fromkeys(warnings)
    return exported


def _missing_libraries() -> list[str]:
    """One message for each library whose file is gone, with what was linked from it."""
    found = []
    for library in bpy.data.libraries:
        path = absolute(library.filepath, library.parent)
        if not library.packed_file and not os.path.exists(path):
            lost = ", ".join(f"“{data.name}”" for data in library.users_id[:_NAMED])
            found.append(f"Library “{path}” is missing: what was linked from it ({lost}) is left out")
    return found


def _settings(options: ExportOptions, images: Images) -> dict[str, Any]:
    found = {**options.settings, "width": options.resolution[0], "height": options.resolution[1],
             "crop": list(options.crop)}
    if found.get("ocio_config"):
        found["ocio_config"] = colors.usable(found["ocio_config"], images.spaces, bpy.app.tempdir)
    return found


def _world(target: Any, background: Any, materials: Materials) -> None:
    if background is not None:
        target.set_world(world.describe(background, materials.graph(background, "World")))


@contextmanager
def _timed(timings: dict[str, float], stage: str) -> Iterator[None]:
    start = time.perf_counter()
    try:
        yield
    finally:
        timings[stage] = timings.get(stage, 0.0) + time.perf_counter() - start
