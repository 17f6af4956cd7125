# SPDX-License-Identifier: GPL-3.0-or-later
"""Glasses, bottles and what is in them. Walls have an inside and an outside; a drink reaches a little into the wall.

The overlap is how artists nest glass and liquid: no gap of air, so no false mirror, and no faces in the same place.
"""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np
import turned


def tinted(name: str, ior: float, passes, over: float, color=(1, 1, 1)) -> bpy.types.Material:
    """Clear glass or liquid whose volume lets `passes` (red, green, blue) of the light through `over` metres."""
    g = c.Graph(bpy.data.materials.new(name))
    glass = g.node("BsdfGlass", {"Color": color, "Roughness": 0.0, "IOR": ior}, distribution="SHARP")
    loss = [-math.log(share) / over for share in passes]
    density = max(loss) * 1.02
    volume = g.node("VolumeAbsorption", {"Color": tuple(1 - k / density for k in loss), "Density": density})
    g.tree.links.new(volume.outputs[0], g.output.inputs["Volume"])
    g.surface(glass)
    g.owner.diffuse_color = (*passes, 1.0)
    return g.owner


def clear(name: str = "glass", ior: float = 1.5) -> bpy.types.Material:
    return c.material(name, "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=ior, distribution="SHARP")


def below(outline: np.ndarray, level: float) -> np.ndarray:
    """The part of an outline that runs upwards below a level, with its last point on it."""
    cut = int(np.argmax(outline[:, 1] > level))
    (r0, z0), (r1, z1) = outline[cut - 1], outline[cut]
    return np.concatenate([outline[:cut], [(r0 + (r1 - r0) * (level - z0) / (z1 - z0), level)]])


def drink(name: str, inside: np.ndarray, level: float, surface, overlap: float, climb: float = 0.0012, **place):
    """What fills the inside of a wall (an outline from the axis upwards) to a level, with a meniscus at the wall."""
    wall = below(turned.offset(inside, -overlap), level + climb)
    wall[0, 0] = 0.0
    edge = wall[-1, 0]
    reach = np.linspace(0.0, 4 * climb, 6)[1:]
    top = [(edge - d, level + climb * math.exp(-d / climb)) for d in reach] + [(0.5 * edge, level), (0.0, level)]
    return turned.turn(name, np.concatenate([wall, top]), surface, **place)


def wine_glass(surface, **place) -> np.ndarray:
    """A red wine glass, 20 cm high, 1.1 mm thin. Returns the outline of the bowl's inside, from the axis to the rim."""
    foot = [(0.0, 0.0009), (0.030, 0.0006), (0.0385, 0.0), (0.0398, 0.0010), (0.0385, 0.0020)]
    top = turned.curve([(0.0385, 0.0020), (0.020, 0.0042), (0.0085, 0.0105), (0.0044, 0.024), (0.0038, 0.042)], 3)
    bowl = turned.curve(
        [
            (0.0038, 0.042),
            (0.0042, 0.064),
            (0.0092, 0.0745),
            (0.0290, 0.0870),
            (0.0450, 0.1120),
            (0.0480, 0.1320),
            (0.0450, 0.1620),
            (0.0390, 0.1920),
            (0.0365, 0.2040),
        ],
        4,
    )
    inside = turned.offset(bowl[bowl[:, 1] > 0.0760], 0.0011)
    bottom = turned.curve([(0.0, 0.0785), (0.008, 0.0790), inside[2]], 2)
    inside = np.concatenate([bottom[:-1], inside[2:]])
    end = np.array([(0.0365, 0.2040), inside[-1]])
    rim = end.mean(0) + [(0.00055 * math.cos(a), 0.0006 * math.sin(a)) for a in np.linspace(0, math.pi, 5)]
    outline = np.concatenate([foot[:-1], top[:-1], bowl[:-1], rim, inside[::-1][1:]])
    turned.turn("wine_glass", outline, surface, **place)
    return inside


def bottle(surface, **place) -> np.ndarray:
    """A Bordeaux bottle, 30 cm high, walls of 2.6 mm. Returns the outline of its inside, from the axis upwards."""
    punt = turned.curve([(0.0, 0.022), (0.012, 0.018), (0.024, 0.007), (0.030, 0.0012)], 3)
    heel = turned.curve([(0.030, 0.0012), (0.0325, 0.0), (0.0360, 0.0016), (0.0375, 0.0060), (0.0376, 0.0120)], 2)
    side = turned.curve(
        [(0.0376, 0.0120), (0.0378, 0.100), (0.0378, 0.186), (0.0345, 0.204), (0.0215, 0.222), (0.0152, 0.240)], 4
    )
    neck = turned.curve(
        [(0.0152, 0.240), (0.0145, 0.262), (0.0142, 0.2800), (0.0150, 0.2815), (0.0163, 0.2830), (0.0163, 0.2900)], 2
    )
    base = turned.curve([(0.0, 0.0255), (0.013, 0.0220), (0.026, 0.0105), (0.0318, 0.0080), (0.0348, 0.0140)], 3)
    up = np.concatenate([side[(side[:, 1] > 0.02)], neck[1:]])
    inner = turned.offset(up, 0.0026)
    inner[:, 0] = np.minimum(inner[:, 0], np.where(inner[:, 1] > 0.255, 0.0100, 1.0))
    inside = np.concatenate([base, inner[inner[:, 1] > 0.020]])
    mouth = [(0.0161, 0.2925), (0.0150, 0.2945), (0.0128, 0.2950), (0.0108, 0.2940)]
    turned.turn(
        "bottle", np.concatenate([punt[:-1], heel[:-1], side[:-1], neck, mouth, inside[::-1]]), surface, **place
    )
    return inside
