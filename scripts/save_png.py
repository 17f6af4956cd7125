# SPDX-License-Identifier: GPL-3.0-or-later
"""Run inside Blender after a render: saves the picture a second time as PNG, through the scene's view transform.

usage: blender -b scene.blend ... -f 1 --python save_png.py -- --png FILE
"""

import sys

import bpy


def main() -> None:
    path = sys.argv[sys.argv.index("--png") + 1]
    settings = bpy.context.scene.render.image_settings
    settings.file_format = "PNG"
    settings.color_mode = "RGBA" if bpy.context.scene.render.film_transparent else "RGB"
    settings.color_depth = "8"
    bpy.data.images["Render Result"].save_render(path)


main()
