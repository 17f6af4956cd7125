# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds bathroom_mirror.blend: glass on a glass shelf before a mirror, under small lamps; caustics seen twice.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_bathroom_mirror.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bathroom as b  # noqa: E402
import bpy  # noqa: E402
import common as c  # noqa: E402
import pool_things as garden  # noqa: E402
import surfaces  # noqa: E402
import windows  # noqa: E402

COUNTER, SHELF = 0.86, 1.13


def room() -> None:
    """Tiled wall with the mirror, and the walls, floor and ceiling that the mirror shows."""
    sage = [(0.1, (0.13, 0.22, 0.19)), (0.5, (0.19, 0.30, 0.255)), (0.95, (0.29, 0.40, 0.34))]
    tiles = surfaces.mosaic("sage tiles", sage, (0.52, 0.50, 0.46), 0.10, 0.16)
    plaster = c.material("plaster", "BsdfDiffuse", Color=(0.56, 0.48, 0.40))
    c.quad("wall tiles", (0, 0, 1.25), (1.9, 0, 0), (0, 0, 1.25), tiles)
    c.quad("wall left", (-1.9, -1.4, 1.25), (0, 1.4, 0), (0, 0, 1.25), plaster)
    c.quad("wall right", (1.9, -1.4, 1.25), (0, -1.4, 0), (0, 0, 1.25), plaster)
    c.quad("wall behind", (0, -2.8, 1.25), (-1.9, 0, 0), (0, 0, 1.25), plaster)
    c.quad("wainscot", (0, -2.79, 0.55), (-1.9, 0, 0), (0, 0, 0.55), tiles)
    c.quad("ceiling", (0, -1.4, 2.5), (-1.9, 0, 0), (0, 1.4, 0), plaster)
    c.quad("floor", (0, -1.4, 0), (1.9, 0, 0), (0, 1.4, 0), surfaces.marble_checker(0.3))


def towels(metal) -> None:
    """A towel on a rail at the wall behind: seen in the mirror."""
    cloth = windows.linen()
    rail = [(x, -2.70, 1.50) for x in (-0.95, -0.6, -0.3, 0.05)]
    b.shapes.tube("towel rail", b.np.array(rail), 0.009, metal)
    for y, low in ((-2.685, 0.85), (-2.715, 1.0)):
        c.box("towel", (0.24, 0.012, (1.51 - low) / 2), cloth, 0.01, location=(-0.45, y, (1.51 + low) / 2))


def vanity(metal) -> None:
    """Marble counter over a teak cabinet, basin, tap, soap and a plant."""
    marble = surfaces.travertine("counter stone", 0.45)
    c.box("counter", (0.95, 0.27, 0.02), marble, 0.005, location=(0, -0.27, COUNTER - 0.02))
    c.box("cabinet", (0.90, 0.25, 0.30), surfaces.teak(), 0.004, location=(0, -0.25, 0.535))
    ceramic = c.material("ceramic", "BsdfPrincipled", Base_Color=(0.80, 0.79, 0.77), Roughness=0.12)
    b.basin(0.42, -0.285, COUNTER, ceramic, metal)
    b.tap(0.42, -0.055, COUNTER, metal)
    soap = c.material("soap", "BsdfPrincipled", Base_Color=(0.74, 0.50, 0.36), Roughness=0.35)
    dish = [(0.0, 0.0), (0.045, 0.0), (0.062, 0.012), (0.060, 0.014), (0.044, 0.005), (0.0, 0.004)]
    b.turned.turn("soap dish", dish, b.glass("dish glass", (0.93, 0.98, 0.97)), 48, location=(0.10, -0.40, COUNTER))
    c.box("soap", (0.037, 0.024, 0.011), soap, 0.010, location=(0.10, -0.40, COUNTER + 0.017), rotation=(0, 0, 0.35))
    clay = surfaces.stucco("pot", (0.60, 0.55, 0.48))
    leaf = garden.leaf_green("leaf", (0.045, 0.11, 0.05), (0.11, 0.21, 0.09))
    garden.agave((-0.72, -0.20, COUNTER + 0.115), 0.24, 5, leaf)
    pot = [(0.0, 0.0), (0.055, 0.0), (0.068, 0.118), (0.062, 0.120), (0.058, 0.105), (0.0, 0.10)]
    b.turned.turn("pot", pot, clay, 48, fine=1, location=(-0.72, -0.20, COUNTER))


def shelf_and_flacons(metal) -> None:
    brass = c.material("brass", "BsdfPrincipled", Base_Color=(0.82, 0.60, 0.27), Metallic=1.0, Roughness=0.12)
    clear, top = b.glass("clear glass"), SHELF + 0.0042
    b.shelf(-0.10, -0.012, SHELF, 0.44, b.glass("shelf glass", (0.90, 0.975, 0.955)), metal)
    b.flacon("blue flacon", -0.44, -0.10, top, 0.036, 0.165, b.glass("blue glass", (0.86, 0.945, 0.985)), metal)
    b.square_bottle(-0.325, -0.105, top, b.glass("amber block", (0.99, 0.86, 0.60)), brass, 0.35)
    b.tumbler(-0.205, -0.095, top, clear)
    b.jar(-0.075, -0.10, top, clear, metal)
    b.flacon("rose flacon", 0.055, -0.095, top, 0.028, 0.125, b.glass("rose glass", (0.99, 0.89, 0.88)), brass)
    b.tumbler(-0.20, -0.33, COUNTER + 0.0002, b.glass("green glass", (0.86, 0.97, 0.91)), 0.095)


def build() -> None:
    scene = c.start(960, 720, 256)
    metal = b.chrome()
    room()
    towels(metal)
    vanity(metal)
    mirror = c.material("mirror", "BsdfGlossy", Color=(0.93, 0.945, 0.94), Roughness=0.0, distribution="SHARP")
    c.box("mirror", (0.60, 0.006, 0.46), mirror, 0.003, location=(0, -0.0065, 1.43))
    shelf_and_flacons(metal)
    for name, x in (("left", -0.50), ("right", 0.36)):
        b.globe_lamp(f"lamp {name}", x, -0.012, 1.43, 2.2, metal)
    spot = bpy.data.lights.new("halogen", "SPOT")
    spot.energy, spot.shadow_soft_size, spot.color = 190.0, 0.012, (1.0, 0.86, 0.68)
    spot.spot_size, spot.spot_blend = math.radians(52), 0.5
    c.aim(c.add(spot, "halogen", (0.22, -0.66, 2.40)), (-0.12, -0.10, 1.0))
    c.world((0, 0, 0))
    c.camera((0.14, -1.16, 1.38), (-0.11, 0.0, 1.045), 43)
    scene.view_settings.exposure = 0.6
    c.save(c.output_path(os.path.join(HERE, "bathroom_mirror.blend")))


build()
