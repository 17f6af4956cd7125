# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a list of cases in one Blender, all in one picture; run.py starts it.

    blender -b --factory-startup --python-exit-code 1 -P worker.py -- TASK.json
    python worker.py -- TASK.json          (with the bpy wheel)

TASK.json: {"engine": "CYCLES" or "CARDIOID", "cases": [names], "samples": n, "moved": bool, "out": path}. `out` (.npz)
gets `pixels` (renders, cases, h, w, 4), bottom row first: the picture and, if `moved`, more with the swept
values and the camera moved by MOVES. Beside it `out`.json: the cases in order, and those that this
Blender cannot build with the reason.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import traceback
from pathlib import Path

import bpy  # first: in a wheel its libraries must load before the engine's

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ADDON = os.environ.get("CARDIOID_ADDON", str(ROOT / "addon"))
sys.path[:0] = [str(HERE), str(ROOT / "tests" / "render"), str(ROOT / "scenes"), ADDON]

import addon_utils  # noqa: E402
import kit  # noqa: E402
import numpy as np  # noqa: E402
import registry  # noqa: E402
import stage  # noqa: E402
from nodes import load_all  # noqa: E402
from tile import Tile  # noqa: E402

MOVES = ((1.0, 1.2, 1.0), (-1.0, -1.0, -1.2), (0.0, 1.0, -1.0), (0.0, -1.0, 1.0))
"""Of the swept values in units of NUDGE, and of the camera in units of FILTER."""


def settings(scene: bpy.types.Scene, engine: str) -> None:
    cycles = scene.cycles
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", stage.FILTER
    scene.view_settings.view_transform = "Standard"
    scene.render.use_persistent_data = False
    scene.render.film_transparent = True  # alpha tells what there is to be seen
    scene.render.engine = engine
    if engine == "CARDIOID":
        scene.cardioid.integrator = "PT"


def quiet_emission(material: bpy.types.Material) -> None:
    """Tiles do not light each other, and are no lamps."""
    if hasattr(material.cycles, "emission_sampling"):
        material.cycles.emission_sampling = "NONE"
    else:
        material.cycles.sample_as_light = False


def build(names: list[str], folder: str) -> tuple[list[str], dict[str, str], dict[str, str], dict]:
    """Tiles of the cases that this Blender has; reasons for the others; problems; the meshes."""
    built, skipped, broken = [], {}, {}
    meshes: dict = {}
    materials = {}
    for name in names:
        material = bpy.data.materials.new(name)
        try:
            tile = Tile(material, folder)
            tile.emit(registry.CASES[name].build(tile))
        except registry.Skip as reason:
            skipped[name] = str(reason)
            continue
        except Exception:
            broken[name] = traceback.format_exc(limit=-3)
            continue
        quiet_emission(material)
        material.pass_index = 3
        materials[name] = material
        built.append(name)
    scene = bpy.context.scene
    scene["of_scene"], scene.world["of_world"], bpy.context.view_layer["of_layer"] = 0.4, 0.7, (0.2, 0.5, 0.3)
    columns, _ = stage.grid(len(built))
    for i, name in enumerate(built):
        stage.place(name, registry.CASES[name].stage, materials[name], i % columns, i // columns, meshes)
    return built, skipped, broken, meshes


def picture(folder: str, count: int) -> np.ndarray:
    """Renders; (cases, h, w, 4)."""
    scene = bpy.context.scene
    scene.render.filepath = os.path.join(folder, "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    n = stage.PIXELS
    tiles = pixels.reshape(height // n, n, width // n, n, -1).swapaxes(1, 2)
    return tiles.reshape(-1, n, n, 4)[:count]


def run(task: dict, folder: str) -> None:
    addon_utils.enable("cycles", persistent=True)
    scene = kit.start(task["samples"])
    if task["engine"] == "CARDIOID":
        addon_utils.enable("cardioid", persistent=True)
    kit.world()
    built, skipped, broken, meshes = build(task["cases"], folder)
    Path(task["out"] + ".json").write_text(json.dumps({"built": built, "skipped": skipped, "broken": broken}))
    if not built:
        return
    stage.camera(*stage.grid(len(built)), perspective=registry.CASES[built[0]].perspective)
    settings(scene, task["engine"])
    pictures = [picture(folder, len(built))]
    for amount, x, y in MOVES if task["moved"] else ():
        stage.move_camera(x, y)
        for kind in stage.KINDS:
            if kind in meshes:
                stage.nudge(meshes[kind], amount * stage.NUDGE)
        pictures.append(picture(folder, len(built)))
    np.savez(task["out"], pixels=np.array(pictures))


def listing() -> dict[str, dict]:
    """Every case with what the judge must know of it; `quick`: the first of its node."""
    seen: set[str] = set()
    found = {}
    for case in registry.CASES.values():
        found[case.name] = {"uses": case.uses, "tolerance": case.tolerance, "floor": case.floor, "group": case.group,
                            "quick": case.uses not in seen and not case.noisy}  # fmt: skip
        seen.add(case.uses)
    return found


def main() -> None:
    load_all()
    if sys.argv[-1] == "--list":
        print("CASES " + json.dumps(listing()), flush=True)
        return
    task = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    with tempfile.TemporaryDirectory() as folder:
        run(task, folder)


if __name__ == "__main__":
    code = 0
    try:
        main()
    except Exception:
        traceback.print_exc()
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # some wheels crash or hang in their own exit while a class is registered
