# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds bust_in_water.blend: a bearded head in a helmet, half under water, over marble, under a large lamp.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_bust_in_water.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402
import numpy as np  # noqa: E402
import surfaces  # noqa: E402
from sculpt import Clay  # noqa: E402

WATER = 0.72
SIDES = (-1, 1)


def curls(clay: Clay, size: float, seed: float):
    """Locks of hair: bent waves, between -1 and 1."""
    x, y, z = clay.x / size + seed, clay.y / size - seed, clay.z / size
    bend = np.sin(0.55 * z + 0.8 * np.sin(0.9 * x) + seed) + 0.7 * np.sin(0.7 * y + 0.5 * z)
    return np.sin(1.9 * x + 2.1 * bend) * (0.6 + 0.4 * np.cos(0.8 * z + 1.3 * bend + y))


def torso(clay: Clay) -> None:
    """Neck, shoulders, chest in a folded cloth, and the pedestal."""
    clay.add(clay.ellipsoid((0, 0.035, 0.02), (0.31, 0.13, 0.115)))
    clay.add(clay.ellipsoid((0, 0.0, -0.12), (0.245, 0.15, 0.24)), 0.08)
    clay.add(clay.capsule((0, 0.02, 0.36), (0, 0.035, 0.08), 0.070, 0.085), 0.06)
    for side in SIDES:
        clay.add(clay.capsule((side * 0.03, -0.07, 0.09), (side * 0.23, 0.0, 0.125), 0.014), 0.04)
    folds = 0.010 * np.sin(46 * (clay.x * 0.8 + clay.z * 0.6) + 5 * np.sin(7 * clay.z)) * (1.0 - 0.4 * clay.x)
    cloth = clay.ellipsoid((0.03, 0.02, -0.10), (0.30, 0.165, 0.215)) - folds
    across = clay.z - 0.55 * clay.x + 0.02 * np.sin(18 * clay.x)
    clay.add(np.maximum(cloth, across - 0.02), 0.015)
    clay.add(clay.drum((0, 0.02, -0.40), 0.16, 0.10, 0.02), 0.05)
    clay.add(clay.drum((0, 0.02, -0.52), 0.22, 0.05, 0.015), 0.02)


def face(clay: Clay) -> None:
    clay.add(clay.ellipsoid((0, 0.01, 0.465), (0.104, 0.128, 0.130)), 0.03)
    clay.add(clay.ellipsoid((0, -0.040, 0.395), (0.082, 0.082, 0.118)), 0.03)
    for side in SIDES:
        clay.add(clay.sphere((side * 0.056, -0.082, 0.398), 0.028), 0.025)
        clay.add(clay.ellipsoid((side * 0.104, 0.012, 0.415), (0.014, 0.028, 0.040)), 0.012)
    clay.add(clay.capsule((-0.060, -0.102, 0.456), (0.060, -0.102, 0.456), 0.021), 0.02)
    for side in SIDES:
        clay.cut(clay.ellipsoid((side * 0.037, -0.122, 0.428), (0.027, 0.034, 0.021)), 0.012)
        clay.add(clay.sphere((side * 0.037, -0.088, 0.427), 0.0195), 0.003)
        clay.add(clay.capsule((side * 0.019, -0.106, 0.4385), (side * 0.056, -0.096, 0.437), 0.007), 0.006)
        clay.add(clay.capsule((side * 0.020, -0.104, 0.415), (side * 0.054, -0.096, 0.416), 0.006), 0.006)
        clay.add(clay.sphere((side * 0.0185, -0.131, 0.382), 0.0135), 0.008)
    clay.add(clay.capsule((0, -0.112, 0.455), (0, -0.158, 0.388), 0.0125, 0.0185), 0.012)
    clay.add(clay.capsule((-0.026, -0.110, 0.349), (0.026, -0.110, 0.349), 0.010), 0.012)
    clay.add(clay.capsule((-0.020, -0.112, 0.330), (0.020, -0.112, 0.330), 0.0105), 0.008)


def hair(clay: Clay) -> None:
    """Beard, moustache and the hair below the helmet's rim."""
    locks = 0.0085 * curls(clay, 0.016, 1.7)
    beard = clay.ellipsoid((0, -0.070, 0.262), (0.086, 0.066, 0.085))
    for side in SIDES:
        beard = np.minimum(
            beard, clay.capsule((side * 0.086, -0.012, 0.40), (side * 0.060, -0.060, 0.29), 0.020, 0.035)
        )
    clay.add(beard - locks, 0.012)
    for side in SIDES:
        clay.add(clay.capsule((side * 0.006, -0.128, 0.3635), (side * 0.058, -0.108, 0.330), 0.011, 0.006), 0.006)
    clay.add(clay.ellipsoid((0, 0.062, 0.375), (0.108, 0.088, 0.140)) - locks, 0.012)


def helmet(clay: Clay) -> None:
    """A shell over the skull, a peak that shades the face, a crest with ribs."""
    shell = clay.ellipsoid((0, 0.012, 0.475), (0.126, 0.150, 0.152))
    rim = 0.485 - 0.25 * clay.y - clay.z
    clay.add(np.maximum(shell, rim), 0.006)
    clay.add(np.maximum(np.abs(shell) - 0.007, np.abs(rim) - 0.010), 0.006)
    peak = clay.ellipsoid((0, -0.105, 0.515), (0.112, 0.100, 0.013), tilt=0.25)
    clay.add(np.maximum(peak, clay.y + 0.02), 0.012)
    ribs = 0.004 * np.sin(np.arctan2(clay.z - 0.50, clay.y - 0.03) * 64)
    crest = clay.ellipsoid((0, 0.05, 0.60), (0.020, 0.185, 0.115), tilt=-0.25) - ribs
    clay.add(np.maximum(crest, -clay.ellipsoid((0, 0.012, 0.475), (0.12, 0.14, 0.145))), 0.01)
    for side in SIDES:
        scroll = np.hypot(clay.y - 0.02, clay.z - 0.545)
        turn = 0.004 * np.sin(140 * scroll + np.arctan2(clay.z - 0.545, clay.y - 0.02))
        clay.add(clay.ellipsoid((side * 0.118, 0.02, 0.545), (0.014, 0.045, 0.045)) - turn, 0.006)


def bust(surface) -> bpy.types.Object:
    """A coarse sculpture in the file; subdivision and displacement make it fine when it is rendered."""
    clay = Clay((-0.36, -0.28, -0.60), (0.36, 0.28, 0.78), 0.0075)
    for part in (torso, face, hair, helmet):
        part(clay)
    vertices, faces = clay.surface()
    obj = c.mesh("bust", np.round(vertices, 4), faces, surface, smooth=True)
    fine = obj.modifiers.new("Subdivision", "SUBSURF")
    fine.levels = fine.render_levels = 1
    for name, size, strength in (("weathering", 0.055, 0.003), ("grain", 0.012, 0.0016)):
        texture = bpy.data.textures.new(name, "CLOUDS")
        texture.noise_scale, texture.noise_depth = size, 2
        relief = obj.modifiers.new(name.capitalize(), "DISPLACE")
        relief.texture, relief.texture_coords, relief.strength = texture, "LOCAL", strength
    return obj


def water() -> None:
    """A rippled sheet from wall to wall: one surface, so light is refracted once on its way in and out."""
    n, side = 160, 2.4
    at = np.linspace(-side, side, n + 1)
    x, y = np.meshgrid(at, at, indexing="ij")
    z = WATER + 0.0030 * np.sin(5.1 * x + 2.2 * y) + 0.0022 * np.sin(8.3 * y - 4.7 * x + 1.0)
    z += 0.0016 * np.sin(21 * np.hypot(x - 0.05, y) - 0.6)
    vertices = np.round(np.stack([x, y, z], -1).reshape(-1, 3), 5)
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.stack([first, first + n + 1, first + n + 2, first + 1], -1)
    glass = c.material("water", "BsdfGlass", Color=(0.93, 0.985, 0.98), Roughness=0.0, IOR=1.33, distribution="SHARP")
    c.mesh("water", vertices, faces, glass, smooth=True)


def room() -> None:
    stone = c.material("stone", "BsdfDiffuse", Color=(0.50, 0.47, 0.42))
    plaster = c.material("ceiling", "BsdfDiffuse", Color=(0.62, 0.62, 0.62))
    c.quad("floor", (0, 0, 0), (2.4, 0, 0), (0, 2.4, 0), surfaces.marble_checker(0.3))
    c.quad("ceiling", (0, 0, 3.2), (2.4, 0, 0), (0, -2.4, 0), plaster)
    c.quad("wall_back", (0, 2.4, 1.6), (2.4, 0, 0), (0, 0, 1.6), stone)
    c.quad("wall_front", (0, -2.4, 1.6), (-2.4, 0, 0), (0, 0, 1.6), stone)
    c.quad("wall_left", (-2.4, 0, 1.6), (0, 2.4, 0), (0, 0, 1.6), stone)
    c.quad("wall_right", (2.4, 0, 1.6), (0, -2.4, 0), (0, 0, 1.6), stone)


def build() -> None:
    scene = c.start(768, 768, 16)
    room()
    water()
    figure = bust(c.material("plaster", "BsdfDiffuse", Color=(0.66, 0.62, 0.55)))
    figure.location, figure.rotation_euler = (0, 0.1, 0.57), (0, 0, math.radians(14))
    c.area_lamp("lamp", (0.85, -0.9, 3.1), (0.8, -0.8, 0.0), 1.0, 120.0, (1.0, 0.95, 0.87))
    c.world((0, 0, 0))
    c.camera((-0.12, -1.50, 1.24), (0.0, 0.06, 0.855), 62)
    scene.view_settings.exposure = 0.25
    c.save(c.output_path(os.path.join(HERE, "bust_in_water.blend")))


build()
