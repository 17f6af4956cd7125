# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: writes Cycles' denoising albedo, normal and depth, which look through mirrors and glass.

blender -b --factory-startup --python-exit-code 1 -P render_surface.py -- FILE.blend OUT.exr WIDTH
"""

import sys

import bpy

SAMPLES = 32


def main(blend: str, out: str, width: int) -> None:
    bpy.ops.wm.open_mainfile(filepath=blend, load_ui=False)
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_y = max(1, round(render.resolution_y * width / render.resolution_x))
    render.resolution_x, render.resolution_percentage = width, 100
    render.use_compositing = render.use_sequencer = False
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = SAMPLES, False, False
    cycles.max_bounces, cycles.diffuse_bounces = 8, 0
    scene.view_layers[0].cycles.denoising_store_passes = True
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"
    render.filepath = out
    bpy.ops.render.render(write_still=True)


arguments = sys.argv[sys.argv.index("--") + 1 :]
main(arguments[0], arguments[1], int(arguments[2]))
