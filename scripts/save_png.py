# SPDX-License-Identifier: GPL-3.0-or-later
"""Run inside Blender after a render: the EXR that was saved once more as PNG, through the scene's view transform.

usage: blender -b scene.blend ... -f 1 --python save_png.py -- FILE.exr FILE.png
"""

import sys

import bpy


def main(exr: str, png: str) -> None:
    scene = bpy.context.scene
    settings = scene.render.image_settings
    settings.file_format = "PNG"
    settings.color_mode = "RGBA" if scene.render.film_transparent else "RGB"
    settings.color_depth = "8"
    bpy.data.images.load(exr).save_render(png, scene=scene)


main(*sys.argv[-2:])
