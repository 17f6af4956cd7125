# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds window_room.blend: a living room whose only light is sun and sky through closed windows of real glass.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_window_room.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402
import furniture as f  # noqa: E402
import pool_things as garden  # noqa: E402
import surfaces  # noqa: E402
import windows as w  # noqa: E402
from mathutils import Vector  # noqa: E402

LEFT, RIGHT, FRONT, BACK, TOP = -2.2, 2.3, -2.9, 2.5, 2.75
SILL, HEAD = 0.42, 2.36
WINDOWS = ((-0.42, 1.15), (1.25, 1.15))
SUN = Vector((-0.80, -0.17, 0.60)).normalized()


def shell(plaster, paint, floor) -> None:
    """Floor, ceiling and walls as thick slabs, so that nothing leaks at their seams; skirting boards."""
    x, y = (LEFT + RIGHT) / 2, (FRONT + BACK) / 2
    half_x, half_y = (RIGHT - LEFT) / 2, (BACK - FRONT) / 2
    c.quad("floor", (x, y, 0), (0, half_y, 0), (-half_x, 0, 0), floor)
    c.box("ground slab", (half_x + 0.3, half_y + 0.3, 0.1), plaster, location=(x, y, -0.102))
    c.box("ceiling", (half_x + 0.3, half_y + 0.3, 0.1), plaster, location=(x, y, TOP + 0.1))
    c.box("wall back", (half_x + 0.3, 0.1, TOP / 2 + 0.04), plaster, location=(x, BACK + 0.1, TOP / 2))
    c.box("wall front", (half_x + 0.3, 0.1, TOP / 2 + 0.04), plaster, location=(x, FRONT - 0.1, TOP / 2))
    c.box("wall right", (0.1, half_y + 0.3, TOP / 2 + 0.04), plaster, location=(RIGHT + 0.1, y, TOP / 2))
    w.wall(LEFT, (FRONT - 0.1, BACK + 0.1), TOP, WINDOWS, SILL, HEAD, plaster)
    c.box("skirting back", (half_x, 0.008, 0.055), paint, 0.004, location=(x, BACK - 0.008, 0.055))
    c.box("skirting right", (0.008, half_y, 0.055), paint, 0.004, location=(RIGHT - 0.008, y, 0.055))
    c.box("skirting left", (0.008, half_y, 0.055), paint, 0.004, location=(LEFT + 0.008, y, 0.055))


def outside() -> None:
    """Sun, sky, a lawn and a few trees: what the windows show."""
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = 17.0, math.radians(0.53), (1.0, 0.88, 0.70)
    c.aim(c.add(lamp, "sun", SUN * 9), (0, 0, 0))
    grass = garden.leaf_green("grass", (0.045, 0.085, 0.022), (0.085, 0.14, 0.045))
    c.quad("lawn", (-8.6, 2, -0.35), (6, 0, 0), (0, 9, 0), grass)
    leaf = garden.leaf_green("cypress leaf", (0.020, 0.045, 0.020), (0.050, 0.10, 0.035))
    garden.cypresses(((-8.5, 6.5, 5.0), (-7.5, 9.5, 5.5), (-10.5, 3.0, 4.5)), leaf)
    data = bpy.data.worlds.new("sky")
    g = c.Graph(data, "ShaderNodeOutputWorld")
    sky = g.node("TexSky", sky_type="NISHITA", sun_disc=False)
    sky.sun_elevation, sky.sun_rotation = math.asin(SUN.z), math.atan2(SUN.x, SUN.y)
    g.surface(g.node("Background", {"Color": sky.outputs[0], "Strength": 0.35}))
    bpy.context.scene.world = data


def furnish(wood, dark) -> None:
    brass = c.material("brass", "BsdfPrincipled", Base_Color=(0.78, 0.57, 0.26), Metallic=1.0, Roughness=0.22)
    glass = c.material("glass", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=1.5, distribution="SHARP")
    f.armchair(1.22, 0.95, -0.62, f.fabric("chair cloth", (0.12, 0.20, 0.22)), wood)
    f.round_table(-0.32, 1.48, 0.47, 0.30, wood)
    f.carafe(-0.38, 1.52, 0.47, glass)
    f.sideboard(0.45, 2.27, wood, dark, brass)
    f.books(-0.05, 2.24, 0.68)
    f.picture(0.45, BACK, 1.52, (0.38, 0.48), wood)
    f.rug(0.15, 0.55, (1.15, 0.75), 0.12)
    clay = surfaces.stucco("clay", (0.56, 0.50, 0.43))
    garden.potted_agave(-1.72, 2.12, 0.62, 5, clay, garden.leaf_green("leaf", (0.045, 0.11, 0.05), (0.11, 0.21, 0.09)))
    rod_x = LEFT + 0.085
    cloth = w.linen()
    w.rod(rod_x, (-1.55, 2.38), 2.52, brass)
    for k, y in enumerate((-1.18, 0.34, 0.52, 2.06)):
        w.curtain(f"curtain {k}", rod_x, y, 0.36, 0.02, 2.50, cloth, k + 1)


def build() -> None:
    scene = c.start(960, 640, 256)
    plaster = c.material("plaster", "BsdfDiffuse", Color=(0.77, 0.745, 0.70))
    paint = c.material("white paint", "BsdfPrincipled", Base_Color=(0.74, 0.73, 0.70), Roughness=0.4)
    clear = c.material("pane", "BsdfGlass", Color=(0.985, 1.0, 0.99), Roughness=0.0, IOR=1.5, distribution="SHARP")
    oak = surfaces.teak()
    shell(plaster, paint, surfaces.wood())
    for k, (middle, width) in enumerate(WINDOWS):
        w.window(f"window {k}", LEFT, middle, width, SILL, HEAD, paint, clear, paint)
    outside()
    furnish(oak, c.material("door paint", "BsdfPrincipled", Base_Color=(0.60, 0.56, 0.48), Roughness=0.45))
    c.camera((1.30, -2.45, 1.25), (-0.30, 1.6, 0.98), 23)
    scene.view_settings.exposure = 0.5
    c.save(c.output_path(os.path.join(HERE, "window_room.blend")))


build()
