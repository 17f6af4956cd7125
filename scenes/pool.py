# SPDX-License-Identifier: GPL-3.0-or-later
"""The pool of swimming_pool.blend and under_water.blend: tiled basin, coping, water, terrace, sun and sky."""

from __future__ import annotations

import math

import bpy
import common as c
import surfaces
import waves
from mathutils import Vector

HALF_X, HALF_Y, DEPTH, LEVEL = 3.6, 1.9, 1.75, -0.15
COPING = 0.34
SUN = Vector((2.2, -4.3, 6.6)).normalized()


def blue_tiles() -> bpy.types.Material:
    tones = [(0.1, (0.34, 0.60, 0.66)), (0.5, (0.47, 0.71, 0.75)), (0.95, (0.62, 0.81, 0.83))]
    return surfaces.mosaic("pool tiles", tones, (0.70, 0.76, 0.76))


def band_tiles() -> bpy.types.Material:
    tones = [(0.1, (0.012, 0.050, 0.115)), (0.5, (0.022, 0.095, 0.19)), (0.95, (0.060, 0.20, 0.30))]
    return surfaces.mosaic("band tiles", tones, (0.55, 0.60, 0.62))


def basin() -> None:
    """Floor with a dark lane line, four walls with a dark band at the waterline."""
    tiles, band = blue_tiles(), band_tiles()
    bottom, edge, top = LEVEL - DEPTH, LEVEL - 0.16, -0.045
    c.quad("floor", (0, 0, bottom), (HALF_X, 0, 0), (0, HALF_Y, 0), tiles)
    c.quad("lane line", (0, 0, bottom + 0.002), (HALF_X - 0.7, 0, 0), (0, 0.125, 0), band)
    for sign in (-1, 1):
        for name, low, high, surface in (("wall", bottom, edge, tiles), ("band", edge, top, band)):
            z, half = (low + high) / 2, (high - low) / 2
            c.quad(f"{name} x {sign}", (sign * HALF_X, 0, z), (0, -sign * HALF_Y, 0), (0, 0, half), surface)
            c.quad(f"{name} y {sign}", (0, sign * HALF_Y, z), (sign * HALF_X, 0, 0), (0, 0, half), surface)


def coping(stone) -> None:
    """Slabs with rounded edges around the basin, 4 mm apart; they overhang the water by 4 cm."""
    middle, half = COPING / 2 - 0.04, COPING / 2
    along_x, along_y = 12, 6
    for sign in (-1, 1):
        for k in range(along_x):
            step = 2 * (HALF_X - 0.04) / along_x
            at = -HALF_X + 0.04 + step * (k + 0.5)
            c.box(
                f"coping y {sign} {k}",
                (step / 2 - 0.002, half, 0.025),
                stone,
                0.014,
                location=(at, sign * (HALF_Y + middle), -0.022),
            )
        for k in range(-1, along_y + 1):
            step = 2 * (HALF_Y - 0.04) / along_y
            corner = k in (-1, along_y)
            at = math.copysign(HALF_Y + middle, k) if corner else -HALF_Y + 0.04 + step * (k + 0.5)
            size = (half, half if corner else step / 2 - 0.002, 0.025)
            c.box(f"coping x {sign} {k}", size, stone, 0.014, location=(sign * (HALF_X + middle), at, -0.022))


def terrace(slabs, far: float = 14.0) -> None:
    """Paving around the coping, and a bed below the joints."""
    x, y = HALF_X + COPING - 0.036, HALF_Y + COPING - 0.036
    for sign in (-1, 1):
        rest = (far - x) / 2
        c.quad(f"paving x {sign}", (sign * (x + rest), 0, 0), (rest, 0, 0), (0, far, 0), slabs)
        rest = (far - y) / 2
        c.quad(f"paving y {sign}", (0, sign * (y + rest), 0), (x, 0, 0), (0, rest, 0), slabs)
        bed = surfaces.travertine("bed", 0.4)
        c.quad(f"bed x {sign}", (sign * (HALF_X + 0.25), 0, -0.046), (0.25, 0, 0), (0, HALF_Y + 0.5, 0), bed)
        c.quad(f"bed y {sign}", (0, sign * (HALF_Y + 0.25), -0.046), (HALF_X, 0, 0), (0, 0.25, 0), bed)


def water() -> None:
    waves.sheet("water", (HALF_X + 0.03, HALF_Y + 0.03), LEVEL, 0.04, 1.45, 7, waves.water())


def daylight(sky_strength: float = 0.12) -> None:
    """Sun (a lamp half a degree wide) and the Sky texture without its sun disc, from the same side."""
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = 6.0, math.radians(0.53), (1.0, 0.925, 0.80)
    c.aim(c.add(lamp, "sun", SUN * 12), (0, 0, 0))
    data = bpy.data.worlds.new("sky")
    g = c.Graph(data, "ShaderNodeOutputWorld")
    sky = g.node("TexSky", sky_type="NISHITA", sun_disc=False)
    sky.sun_elevation = math.asin(SUN.z)
    sky.sun_rotation = math.atan2(SUN.x, SUN.y)
    sky.air_density, sky.dust_density, sky.ozone_density = 1.0, 0.2, 3.0
    g.surface(g.node("Background", {"Color": sky.outputs[0], "Strength": sky_strength}))
    bpy.context.scene.world = data


def build() -> None:
    basin()
    coping(surfaces.travertine("coping stone"))
    terrace(surfaces.paving())
    water()
    daylight()
