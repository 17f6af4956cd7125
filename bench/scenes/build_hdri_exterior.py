# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds hdri_exterior.blend: a courtyard under a sky picture with a sun in it.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_hdri_exterior.py -- OUT.blend
"""

import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import bpy  # noqa: E402
import common as c  # noqa: E402
import pixels  # noqa: E402


def sky() -> None:
    data = bpy.data.worlds.new("sky")
    g = c.Graph(data, "ShaderNodeOutputWorld")
    color = g.node("TexEnvironment", image=pixels.image("sky", pixels.sky(1024, 5), linear=True)).outputs["Color"]
    g.surface(g.node("Background", {"Color": color, "Strength": 1.0}))
    bpy.context.scene.world = data


def stone():
    g = c.Graph(bpy.data.materials.new("stone"))
    at = g.node("TexCoord").outputs["Object"]
    value = g.node("TexNoise", {"Vector": at, "Scale": 2.5, "Detail": 8.0, "Roughness": 0.6}).outputs["Fac"]
    color = g.ramp(value, [(0.3, (0.32, 0.28, 0.23)), (0.55, (0.58, 0.53, 0.45)), (0.75, (0.70, 0.66, 0.60))])
    normal = g.node("Bump", {"Height": value, "Strength": 0.4, "Distance": 0.05}).outputs["Normal"]
    return g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.8, "Normal": normal}))


def columns(surface) -> None:
    """A ring of twelve columns under a lintel; instances of one mesh."""
    profile = [
        (0.0001, 0),
        (0.36, 0),
        (0.36, 0.15),
        (0.26, 0.25),
        (0.23, 1.6),
        (0.21, 2.9),
        (0.32, 3.0),
        (0.34, 3.15),
        (0.0001, 3.15),
    ]
    first = c.revolve("column", profile, surface, 48, location=(4, 0, 0))
    for i in range(1, 12):
        a = 2 * math.pi * i / 12
        c.add(first.data, f"column {i}", (4 * math.cos(a), 4 * math.sin(a), 0))
    c.revolve("lintel", [(3.6, 3.15), (4.4, 3.15), (4.4, 3.6), (3.6, 3.6)], surface, 96)


def build() -> None:
    c.start(1280, 800)
    rock = stone()
    tiles = c.Graph(bpy.data.materials.new("paving"))
    uv = tiles.node("Mapping", {"Vector": tiles.node("UVMap").outputs["UV"], "Scale": (0.35, 0.35, 1)}).outputs[
        "Vector"
    ]
    color = tiles.node("TexImage", {"Vector": uv}, image=pixels.image("paving", pixels.tiles(512, 7))).outputs["Color"]
    c.quad(
        "ground",
        (0, 0, 0),
        (30, 0, 0),
        (0, 30, 0),
        tiles.surface(tiles.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.5})),
    )
    columns(rock)
    c.box("plinth", (0.7, 0.7, 0.3), rock, 0.03, location=(0, 0, 0.3))
    c.sphere(
        "bronze",
        (0, 0, 1.25),
        0.65,
        c.material("bronze", "BsdfPrincipled", Base_Color=(0.70, 0.42, 0.20), Metallic=1.0, Roughness=0.28),
    )
    c.sphere(
        "marble",
        (1.5, -1.6, 0.4),
        0.4,
        c.material("marble", "BsdfPrincipled", Base_Color=(0.8, 0.78, 0.74), Roughness=0.15),
    )
    c.sphere("hedge", (-1.9, -0.7, 0.5), 0.5, c.material("hedge", "BsdfDiffuse", Color=(0.06, 0.15, 0.03)), 48, 24)
    sky()
    c.camera((2.6, -8.6, 1.9), (0, 0.3, 1.5), 30)
    c.save(c.output_path("hdri_exterior.blend"))


build()
