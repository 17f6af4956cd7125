# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: renders one file with one engine under given settings. The harness starts it.

    blender -b --factory-startup --python-exit-code 1 -P render_blend.py -- JOB.json [--cardioid-stats FILE]
    python render_blend.py -- JOB.json                      (with the bpy wheel)

JOB.json's keys: blend (empty: the default scene), engine (CYCLES or CARDIOID), addon (folder that holds `cardioid`),
out (EXR; empty: not written), samples, seed, threads, bounces, caustics, width (0: the file's), only_load (open the
file, evaluate it, render nothing), export (write the engine's scene file there instead of rendering). Both engines get
the same settings: Cardioid's follow scene.cycles.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path

import bpy  # first: in a wheel its libraries must load before the engine's

job = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
sys.path.insert(0, job.get("addon", ""))

import addon_utils  # noqa: E402


def settings(scene: bpy.types.Scene) -> None:
    """Equal settings for both engines: full depth, nothing clamped or blurred, no adaptive sampling, no denoising."""
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = job["samples"], job["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = job["bounces"]
    cycles.transparent_max_bounces = job["bounces"]
    cycles.caustics_reflective = cycles.caustics_refractive = job["caustics"]
    cycles.blur_glossy = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.time_limit = 0.0
    cycles.sampling_pattern = "SOBOL" if bpy.app.version < (3, 5) else "TABULATED_SOBOL"
    render = scene.render
    render.engine = job["engine"]
    render.threads_mode, render.threads = "FIXED", job["threads"]
    render.use_persistent_data = False
    render.use_motion_blur = False
    render.use_compositing = render.use_sequencer = False
    if job.get("width"):
        render.resolution_y = max(1, round(render.resolution_y * job["width"] / render.resolution_x))
        render.resolution_x, render.resolution_percentage = job["width"], 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode, render.image_settings.color_depth = "RGB", "32"
    render.image_settings.exr_codec = "ZIP"
    render.dither_intensity = 0.0
    if job["engine"] == "CARDIOID":
        scene.cardioid.integrator = "PT"


def export_scene(path: str) -> None:
    """Writes what F12 would hand to the engine."""
    from cardioid import cli_args, core, export, frame_size, passes, resolve

    graph = bpy.context.evaluated_depsgraph_get()
    scene, layer = graph.scene_eval, graph.view_layer_eval
    options = export.ExportOptions(
        resolution=frame_size.resolution(scene.render),
        crop=frame_size.crop(scene.render),
        settings=resolve.resolve(scene, layer, cli_args.current().overrides, preview=False),
        passes=tuple(one.engine for one in passes.enabled(layer)),
        engine=None,
        should_stop=lambda: False,
    )
    export.build_scene(core.load(), graph, layer, options).scene.save(path)


def main() -> None:
    addon_utils.enable("cycles", persistent=True)
    if job["engine"] == "CARDIOID":
        addon_utils.enable("cardioid", persistent=True)
    if job.get("blend"):
        bpy.ops.wm.open_mainfile(filepath=job["blend"], load_ui=False)
    scene = bpy.context.scene
    settings(scene)
    scene.render.filepath = job["out"]
    if job.get("export"):
        export_scene(job["export"])
    elif job.get("only_load"):
        graph = bpy.context.evaluated_depsgraph_get()
        print("LOADED", sum(1 for _ in graph.object_instances), flush=True)
    else:
        print("F12", flush=True)
        start, before = time.monotonic(), time.process_time()
        bpy.ops.render.render(write_still=bool(job["out"]))
        size = scene.render.resolution_x * scene.render.resolution_y * (scene.render.resolution_percentage / 100) ** 2
        result = {"render_wall": time.monotonic() - start, "render_cpu": time.process_time() - before}
        result |= {"version": bpy.app.version_string, "pixels": round(size)}
        print("RESULT " + json.dumps(result), flush=True)
    sys.stdout.flush()
    os._exit(0)  # some wheels crash or hang in their own exit while a class is registered


main()
