# SPDX-License-Identifier: GPL-3.0-or-later
"""Water that moves by itself: a height field of many small waves, and bodies of revolution swept along a line."""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np


def heights(x: np.ndarray, y: np.ndarray, rms_curvature: float, seed: int, count: int = 48) -> np.ndarray:
    """Height in metres at (x, y) in metres of `count` sine waves of 0.24 to 1.5 m in all directions.

    Water of depth d focuses parallel light from above on its floor where the curvature is about 4 / d (n = 1.33), so
    `rms_curvature`, in 1/m, says how sharp the net of light on the floor is.
    """
    random = np.random.default_rng(seed)
    length = np.exp(random.uniform(math.log(0.24), math.log(1.5), count))
    number = 2 * math.pi / length
    way, phase = random.uniform(0, 2 * math.pi, count), random.uniform(0, 2 * math.pi, count)
    share = length**0.25 / number**2
    bent = math.sqrt(0.5 * float(np.sum((share * number**2) ** 2)))
    z = np.zeros_like(x)
    for k in range(count):
        turn = number[k] * (x * math.cos(way[k]) + y * math.sin(way[k])) + phase[k]
        z += share[k] * np.sin(turn)
    return z * (rms_curvature / bent)


def sheet(name: str, half, level: float, cell: float, rms_curvature: float, seed: int, surface) -> bpy.types.Object:
    """A smooth sheet of 2·half metres with waves around z = level; subdivided once more where it is rendered."""
    nx, ny = (max(2, round(2 * h / cell)) for h in half)
    x, y = np.meshgrid(np.linspace(-half[0], half[0], nx + 1), np.linspace(-half[1], half[1], ny + 1), indexing="ij")
    z = level + heights(x, y, rms_curvature, seed)
    vertices = np.round(np.stack([x, y, z], -1).reshape(-1, 3), 5)
    first = (np.arange(nx)[:, None] * (ny + 1) + np.arange(ny)).ravel()
    faces = np.stack([first, first + ny + 1, first + ny + 2, first + 1], -1)
    obj = c.mesh(name, vertices, faces, surface, smooth=True)
    fine = obj.modifiers.new("Subdivision", "SUBSURF")
    fine.levels, fine.render_levels = 0, 1
    return obj


def water(tint=(0.58, 0.925, 0.955), density: float = 1.0) -> bpy.types.Material:
    """Clear water that swallows (1 − tint)·density of red, green and blue light a metre. One sheet is its boundary."""
    g = c.Graph(bpy.data.materials.new("water"))
    glass = g.node("BsdfGlass", {"Color": (1, 1, 1), "Roughness": 0.0, "IOR": 1.333}, distribution="SHARP")
    body = g.node("VolumeAbsorption", {"Color": tint, "Density": density})
    g.tree.links.new(body.outputs[0], g.output.inputs["Volume"])
    result = g.surface(glass)
    result.cycles.homogeneous_volume = True
    result.diffuse_color = (0.35, 0.75, 0.85, 0.5)
    return result
