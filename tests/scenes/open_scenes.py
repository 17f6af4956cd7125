# SPDX-License-Identifier: GPL-3.0-or-later
"""In Blender: opens each file given after `--`, renders it at 32 pixels with the add-on, prints what was found.

A file's part of the output is between `SCENE-BEGIN name` and `SCENE-END name {facts as JSON}`.
"""

import json
import os
import sys
import tempfile

import bpy
import numpy as np

PIXELS, SAMPLES = 32, 2


def picture(folder: str) -> np.ndarray:
    """The rendered colours (pixels × 3)."""
    render = bpy.context.scene.render
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = os.path.join(folder, "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(render.filepath)
    colors = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(colors)
    bpy.data.images.remove(image)
    return colors.reshape(-1, 4)[:, :3]


def outside() -> list[str]:
    """Pictures and libraries that are not in the file, and paths that are not relative to it."""
    names = [image.name for image in bpy.data.images if image.source == "FILE" and not image.packed_files]
    names += [library.filepath for library in bpy.data.libraries]
    return names + [path for path in bpy.utils.blend_paths(packed=True) if not path.startswith("//")]


def facts(folder: str) -> dict:
    """What the tests want to know of the file that is open."""
    scene = bpy.context.scene
    found = {"outside": outside(), "camera": scene.camera is not None}
    scene.render.engine = "CARDIOID"
    width, height = scene.render.resolution_x, scene.render.resolution_y
    scene.render.resolution_percentage = 100
    scene.render.resolution_x = PIXELS * width // max(width, height)
    scene.render.resolution_y = PIXELS * height // max(width, height)
    scene.cardioid.samples = SAMPLES
    colors = picture(folder)
    finite = bool(np.isfinite(colors).all())
    return {**found, "finite": finite, "mean": float(colors.mean()), "spread": float(colors.std())}


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        for path in sys.argv[sys.argv.index("--") + 1 :]:
            name = os.path.basename(path)
            print(f"SCENE-BEGIN {name}", flush=True)
            bpy.ops.wm.open_mainfile(filepath=path)
            print(f"SCENE-END {name} {json.dumps(facts(folder))}", flush=True)


main()
