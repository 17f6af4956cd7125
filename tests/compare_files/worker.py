# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders one file with one engine in one Blender; run.py starts it.

    blender -b --factory-startup -Y -P worker.py -- TASK.json      or      python worker.py -- TASK.json (bpy wheel)

TASK.json: {"blend", "engine", "threads", "width", "samples", "blur", "jobs": [[seed, out.npy], …], "progress"}. The
progress file gets a JSON line for what the file needs (`census`, `cells`), each message and each finished picture.
"""

from __future__ import annotations

import json
import os
import sys
import time
import traceback
from pathlib import Path

import bpy  # first: in a wheel its libraries must load before the engine's

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ADDON = os.environ.get("CARDIOID_ADDON", str(ROOT / "addon"))
sys.path[:0] = [str(HERE), str(ROOT / "tests" / "render"), str(ROOT / "scenes"), ADDON]

import addon_utils  # noqa: E402
import census  # noqa: E402
import numpy as np  # noqa: E402
import prepare  # noqa: E402


def read_exr(path: str) -> np.ndarray:
    """The file's own numbers, bottom row first."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, -1)


def use_cardioid(tell) -> None:
    """Switches the add-on on and hears what it tells the artist."""
    addon_utils.enable("cardioid", persistent=True)
    import cardioid.messages

    warn, fail = cardioid.messages.warn, cardioid.messages.fail

    def heard(engine, warnings) -> None:
        listed = list(warnings)
        for text in listed:
            tell(message=text)
        warn(engine, listed)

    def failed(engine, message: str) -> None:
        tell(error=message)
        fail(engine, message)

    cardioid.messages.warn, cardioid.messages.fail = heard, failed


def build(task: dict, tell) -> bpy.types.Scene:
    bpy.ops.wm.open_mainfile(filepath=task["blend"], use_scripts=False, load_ui=False)
    scene = bpy.context.scene
    width, cells = task["width"], None
    if prepare.is_library(scene):
        cells = prepare.balls(scene)
        width = scene.render.resolution_x
    elif scene.camera is None:
        prepare.add_camera(scene)
    had_blur = scene.render.use_motion_blur
    prepare.settings(scene, width, task["samples"], task["blur"])
    tell(census=dict(census.count(prepare.used(scene))), cells=cells, cell=prepare.CELL, had_blur=had_blur,
         blender=bpy.app.version_string)
    return scene


def render(scene: bpy.types.Scene, task: dict, seed: int, out: str) -> None:
    scene.render.engine = task["engine"]
    scene.render.threads_mode, scene.render.threads = "FIXED", task["threads"]
    scene.cycles.seed = seed
    scene.cycles.use_animated_seed = False
    if task["engine"] == "CARDIOID":
        scene.cardioid.integrator = "PT"
    scene.render.filepath = out + ".exr"
    bpy.ops.render.render(write_still=True)
    np.save(out, read_exr(out + ".exr"))
    os.remove(out + ".exr")


def main() -> None:
    task = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    addon_utils.enable("cycles", persistent=True)
    with open(task["progress"], "a") as progress:

        def tell(**line) -> None:
            print(json.dumps(line), file=progress, flush=True)

        try:
            if task["engine"] == "CARDIOID":
                use_cardioid(tell)
            scene = build(task, tell)
            for seed, out in task["jobs"]:
                before, clock = time.process_time(), time.monotonic()
                render(scene, task, seed, out)
                tell(done=seed, cpu=time.process_time() - before, seconds=time.monotonic() - clock)
        except Exception:
            traceback.print_exc()
            tell(error=traceback.format_exc(limit=-1).strip().splitlines()[-1])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)  # some wheels crash or hang in their own exit while a class is registered


if __name__ == "__main__":
    main()
