# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a list of jobs in one Blender; run.py starts it.

    blender -b --factory-startup --python-exit-code 1 -P worker.py -- JOBS.json
    python worker.py -- JOBS.json          (with the bpy wheel)

JOBS.json: {"engine": "CYCLES" or "CARDIOID", "threads": n, "progress": path, "jobs": [{"case", "seed", "out"}]}. Each
job's picture goes through an EXR file, as an artist's does, and is kept as float32 (h, w, 4) in `out` (.npy), bottom
row first. The progress file gets a line when a job starts and when it ends, so that a crash has a name.
"""

from __future__ import annotations

import hashlib
import inspect
import json
import os
import sys
import time
import traceback
from pathlib import Path

import bpy  # first: in a wheel its libraries must load before the engine's

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "scenes"), str(ROOT / "addon")]

import addon_utils  # noqa: E402
import cases  # noqa: E402, F401
import kit  # noqa: E402
import numpy as np  # noqa: E402


def read_exr(path: str) -> np.ndarray:
    """The file's own numbers, without colour management."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)
    bpy.data.images.remove(image)
    return pixels


def select(scene: bpy.types.Scene, engine: str, threads: int, seed: int) -> None:
    scene.render.engine = engine
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.cycles.seed = seed
    if engine == "CARDIOID":
        scene.cardioid.integrator = "PT"


def render(job: dict, engine: str, threads: int) -> float:
    """Renders one job; returns the process's CPU seconds for it."""
    case = kit.CASES[job["case"]]
    scene = kit.start(case.samples)
    if engine == "CARDIOID":
        addon_utils.enable("cardioid", persistent=True)
    case.build(scene)
    select(scene, engine, threads, job["seed"])
    scene.render.filepath = job["out"] + ".exr"
    before = time.process_time()
    bpy.ops.render.render(write_still=True)
    spent = time.process_time() - before
    np.save(job["out"], read_exr(job["out"] + ".exr"))
    os.remove(job["out"] + ".exr")
    return spent


def main() -> None:
    task = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    addon_utils.enable("cycles", persistent=True)
    with open(task["progress"], "a") as progress:

        def tell(**line) -> None:
            print(json.dumps(line), file=progress, flush=True)

        for job in task["jobs"]:
            tell(start=job["case"], seed=job["seed"])
            try:
                tell(done=job["case"], seed=job["seed"], cpu=render(job, task["engine"], task["threads"]))
            except Exception:
                traceback.print_exc()
                tell(error=job["case"], seed=job["seed"], text=traceback.format_exc(limit=-1).strip().splitlines()[-1])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)  # some wheels crash or hang in their own exit while a class is registered


def listing() -> dict:
    """This Blender's cases, each with a fingerprint of all that its picture depends on besides Blender."""
    old = bpy.app.version < (3, 5)
    shared = b"".join(Path(m.__file__).read_bytes() for m in (kit, kit.common))
    found = {}
    for case in kit.CASES.values():
        if (old or case.wheels) and bpy.app.version >= case.since:
            source = shared + inspect.getsource(case.build).encode()
            found[case.name] = {"about": case.build.__doc__, "hash": hashlib.sha256(source).hexdigest()[:16]}
    return {"version": bpy.app.version_string, "cases": found}


if __name__ == "__main__":
    if sys.argv[-1] == "--list":
        print("CASES " + json.dumps(listing()), flush=True)
        os._exit(0)
    main()
