# SPDX-License-Identifier: GPL-3.0-or-later
"""One render with Cycles, in Debian's Blender or in a bpy wheel, of a file that to_blend.py wrote.

    blender -b --factory-startup --python-exit-code 1 -P bench/rivals/render_cycles.py -- --blend F.blend --mode path \\
        --samples 64 --out OUT.exr
    .venv/bpy50/bin/python bench/rivals/render_cycles.py -- …

Modes: `default` (bounces, clamping, Filter Glossy and light threshold as Blender sets them in a new file), `path` (the
file's: full depth, nothing clamped), `shadow` (the same with shadow caustics), `guided` (with path guiding), `denoised`
(with OpenImageDenoise).
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

import addon_utils

from bench.rivals import runner, scenes

MODES = ("default", "path", "shadow", "guided", "denoised")
FACTORY = (
    *("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces"),
    *("blur_glossy", "sample_clamp_direct", "sample_clamp_indirect", "light_sampling_threshold"),
)


def built_with(what: str) -> bool:
    import _cycles

    return bool(getattr(_cycles, what, False))


def choose(mode: str) -> None:
    """Sets what the mode asks for. RuntimeError: this Blender cannot."""
    scene = bpy.context.scene
    cycles = scene.cycles
    if hasattr(cycles, "use_guiding"):
        cycles.use_guiding = mode == "guided"
    if mode == "default":
        for name in FACTORY:
            setattr(cycles, name, cycles.bl_rna.properties[name].default)
    elif mode == "guided" and not (hasattr(cycles, "use_guiding") and built_with("with_path_guiding")):
        raise RuntimeError("this build of Blender has no path guiding")
    elif mode == "denoised":
        if not built_with("with_openimagedenoise"):
            raise RuntimeError("this build of Blender has no OpenImageDenoise")
        cycles.use_denoising, cycles.denoiser = True, "OPENIMAGEDENOISE"
    elif mode == "shadow":
        shadow_caustics(scene)


def shadow_caustics(scene: bpy.types.Scene) -> None:
    """Every glass body casts, every diffuse one receives. RuntimeError: nothing casts."""
    casters = [thing for thing in scene.objects if thing.get("kind") == scenes.GLASS]
    if not casters:
        raise RuntimeError("there is no glass: shadow caustics are refractive alone")
    for thing in casters:
        thing.cycles.is_caustics_caster = True
    for thing in scene.objects:
        if thing.type == "LIGHT":
            thing.data.cycles.is_caustics_light = True
        elif thing.get("kind") == scenes.DIFFUSE:
            thing.cycles.is_caustics_receiver = True


def render(chosen) -> None:
    bpy.ops.wm.open_mainfile(filepath=chosen.blend, load_ui=False)
    choose(chosen.mode)
    scene = bpy.context.scene
    scene.cycles.device, scene.cycles.seed, scene.cycles.samples = "CPU", chosen.seed, chosen.samples
    settings = scene.render
    settings.threads_mode, settings.threads = "FIXED", chosen.threads
    settings.filepath = chosen.out
    image = settings.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    clock = runner.Clock()
    bpy.ops.render.render(write_still=True)
    clock.report(chosen.samples, bpy.app.version_string)


def main() -> None:
    chosen = runner.arguments(sys.argv[sys.argv.index("--") + 1 :], MODES)
    if not chosen.samples:
        sys.exit("Cycles renders by --samples alone")
    addon_utils.enable("cycles", persistent=True)
    try:
        render(chosen)
    except RuntimeError as error:
        print(error, flush=True)
        os._exit(1)
    sys.stdout.flush()
    os._exit(0)  # some wheels crash in their own end


main()
