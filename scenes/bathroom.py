# SPDX-License-Identifier: GPL-3.0-or-later
"""Things of bathroom_mirror.blend: tap, basin, glass shelf, flacons and tumblers, globe lamps. Lengths in metres."""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np
import shapes
import turned


def glass(name: str, color=(1, 1, 1)) -> bpy.types.Material:
    return c.material(name, "BsdfGlass", Color=color, Roughness=0.0, IOR=1.5, distribution="SHARP")


def chrome() -> bpy.types.Material:
    return c.material("chrome", "BsdfGlossy", Color=(0.90, 0.905, 0.915), Roughness=0.0, distribution="SHARP")


def basin(x: float, y: float, z: float, ceramic, metal) -> None:
    """A round bowl that stands on the counter, its rim 13 cm above it."""
    outer = [(0.0, 0.0), (0.10, 0.0), (0.125, 0.006), (0.185, 0.075), (0.205, 0.122), (0.204, 0.130)]
    inner = [(0.198, 0.132), (0.193, 0.122), (0.172, 0.072), (0.115, 0.024), (0.0, 0.014)]
    turned.turn("basin", [*outer, *inner], ceramic, 64, location=(x, y, z))
    turned.turn(
        "drain", [(0.0, 0.0), (0.028, 0.0), (0.030, 0.004), (0.0, 0.007)], metal, 32, location=(x, y, z + 0.0145)
    )


def tap(x: float, y: float, z: float, metal) -> None:
    """A tall mixer: column, bent spout toward −y, lever."""
    turned.turn(
        "tap foot",
        [(0.0, 0.0), (0.030, 0.0), (0.030, 0.006), (0.024, 0.010), (0.0, 0.010)],
        metal,
        48,
        location=(x, y, z),
    )
    spout = [(x, y, z), (x, y, z + 0.27), (x, y - 0.17, z + 0.27), (x, y - 0.17, z + 0.205)]
    shapes.tube("tap spout", shapes.round_corners(spout, 0.062, 14), 0.0135, metal, 40)
    column = [(0.0, 0.0), (0.0225, 0.0), (0.0225, 0.10), (0.0205, 0.106), (0.0, 0.106)]
    turned.turn("tap column", column, metal, 48, fine=0, location=(x, y, z))
    lever = np.linspace((x + 0.018, y, z + 0.082), (x + 0.105, y - 0.01, z + 0.112), 6)
    shapes.tube("tap lever", lever, 0.006, metal, 24)


def shelf(x: float, y: float, z: float, half, pane, metal) -> None:
    """A pane eight millimetres thick on two brackets at the wall."""
    c.box("glass shelf", (half, 0.068, 0.004), pane, 0.0012, location=(x, y - 0.085, z))
    for side in (-1, 1):
        at = x + side * (half - 0.09)
        rod = np.linspace((at, y, z - 0.011), (at, y - 0.10, z - 0.011), 4)
        shapes.tube("shelf bracket", rod, 0.0068, metal, 24)
        c.box("shelf clamp", (0.012, 0.014, 0.006), metal, 0.002, location=(at, y - 0.03, z + 0.0102))


def tumbler(x: float, y: float, z: float, pane, height: float = 0.105) -> None:
    """A heavy-bottomed glass with a slight cone."""
    outer = [(0.0, 0.0), (0.027, 0.0), (0.0305, 0.003), (0.0365, height - 0.001), (0.0355, height)]
    inner = [(0.0345, height - 0.001), (0.0292, 0.018), (0.025, 0.013), (0.0, 0.012)]
    turned.turn("tumbler", [*outer, *inner], pane, 48, location=(x, y, z))


def flacon(name: str, x: float, y: float, z: float, radius: float, height: float, pane, cap) -> None:
    """A round bottle with shoulders and a narrow neck, 2.5 mm thick, with a stopper."""
    r, h = radius, height
    outer = turned.curve(
        [(r * 0.9, 0.0), (r, 0.006), (r, 0.62 * h), (0.80 * r, 0.76 * h), (0.012, 0.86 * h), (0.012, h)], 4
    )
    inside = [(p, q) for p, q in turned.offset(outer, 0.0025) if q > 0.009]
    outline = [(0.0, 0.002), (r * 0.8, 0.0), *outer, *inside[::-1], (0.0, 0.0085)]
    turned.turn(name, outline, pane, 48, location=(x, y, z))
    ball = c.sphere(f"{name} stopper", (x, y, z + h + 0.012), 0.0165, cap, 64, 32)
    ball.scale = (1, 1, 0.9)


def square_bottle(x: float, y: float, z: float, pane, cap, turn: float) -> None:
    """A block of tinted glass with a heavy cap, as for scent."""
    c.box("scent", (0.030, 0.020, 0.042), pane, 0.005, location=(x, y, z + 0.0425), rotation=(0, 0, turn))
    c.box("scent cap", (0.013, 0.013, 0.014), cap, 0.003, location=(x, y, z + 0.0995), rotation=(0, 0, turn))


def jar(x: float, y: float, z: float, pane, cap) -> None:
    """A low jar of clear glass with a lid of metal, cotton balls inside."""
    outer = [(0.0, 0.0), (0.040, 0.0), (0.044, 0.004), (0.044, 0.062), (0.0425, 0.064)]
    inner = [(0.041, 0.062), (0.0405, 0.010), (0.037, 0.007), (0.0, 0.0065)]
    turned.turn("jar", [*outer, *inner], pane, 48, location=(x, y, z))
    lid = [(0.0, 0.0), (0.045, 0.0), (0.045, 0.010), (0.042, 0.013), (0.0, 0.014)]
    turned.turn("jar lid", lid, cap, 48, fine=1, location=(x, y, z + 0.0645))
    cotton = c.material("cotton", "BsdfDiffuse", Color=(0.80, 0.79, 0.77))
    for k, (dx, dy, dz) in enumerate(
        ((-0.017, 0.004, 0.024), (0.018, 0.010, 0.024), (0.004, -0.019, 0.025), (0.0, 0.002, 0.047))
    ):
        c.sphere(f"cotton {k}", (x + dx, y + dy, z + dz), 0.0165, cotton, 32, 16)


def globe_lamp(name: str, x: float, y: float, z: float, watts: float, metal) -> None:
    """A small opal globe, five centimetres wide, on an arm from the wall."""
    g = c.Graph(bpy.data.materials.new(f"{name} opal"))
    radius = 0.025
    strength = watts / (math.pi * 4 * math.pi * radius**2)
    opal = g.surface(g.node("Emission", {"Color": (1.0, 0.80, 0.56), "Strength": strength}))
    c.sphere(f"{name} globe", (x, y - 0.11, z), radius, opal, 48, 24)
    arm = [(x, y, z - 0.06), (x, y - 0.11, z - 0.06), (x, y - 0.11, z - 0.023)]
    shapes.tube(f"{name} arm", shapes.round_corners(arm, 0.03), 0.006, metal, 24)
    turned.turn(
        f"{name} rose",
        [(0.0, 0.0), (0.034, 0.0), (0.034, 0.006), (0.0, 0.012)],
        metal,
        48,
        fine=1,
        location=(x, y, z - 0.06),
        rotation=(math.pi / 2, 0, 0),
    )
    cup = [(0.0, -0.034), (0.012, -0.034), (0.018, -0.022), (0.016, -0.021), (0.0, -0.030)]
    turned.turn(f"{name} cup", cup, metal, 48, fine=1, location=(x, y - 0.11, z))
