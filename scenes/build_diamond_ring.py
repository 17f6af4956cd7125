# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds diamond_ring.blend: a brilliant in a gold ring, loose stones beside it, on slate under three tiny lamps.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_diamond_ring.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402
import gems  # noqa: E402
import numpy as np  # noqa: E402
import turned  # noqa: E402

MM = 0.001
STONE, INNER, THICK = 4.8 * MM, 8.6 * MM, 1.7 * MM
"""Radius of the stone's girdle, of the finger's hole, and the shank's thickness."""


def slate() -> bpy.types.Material:
    """Honed dark stone: clouds, fine grain, pale veins."""
    g = c.Graph(bpy.data.materials.new("slate"))
    at = g.node("TexCoord").outputs["Object"]
    clouds = g.node("TexNoise", {"Vector": at, "Scale": 38.0, "Detail": 8.0, "Roughness": 0.65}).outputs["Fac"]
    grain = g.node("TexNoise", {"Vector": at, "Scale": 1500.0, "Detail": 3.0}).outputs["Fac"]
    bent = g.vector_math("MULTIPLY_ADD", clouds, (0.03, 0.03, 0.0), at)
    vein = g.node("TexNoise", {"Vector": bent, "Scale": 17.0, "Detail": 6.0}).outputs["Fac"]
    ridge = g.math("ABSOLUTE", g.math("SUBTRACT", vein, 0.5))
    base = g.ramp(clouds, [(0.34, (0.010, 0.011, 0.014)), (0.66, (0.026, 0.028, 0.033))])
    veined = g.mix_color(1.0, base, g.ramp(ridge, [(0.0, (2.1, 2.0, 1.9)), (0.012, (1, 1, 1))]), "MULTIPLY")
    color = g.mix_color(1.0, veined, g.ramp(grain, [(0.35, (0.72, 0.72, 0.72)), (0.65, (1, 1, 1))]), "MULTIPLY")
    bump = g.node("Bump", {"Height": grain, "Strength": 0.30, "Distance": 0.0002}).outputs["Normal"]
    rough = g.math("MULTIPLY_ADD", clouds, 0.3, 0.30)
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": color, "Roughness": rough, "Specular": 0.25, "Normal": bump})
    )


def metal(name: str, color, roughness: float) -> bpy.types.Material:
    return c.material(name, "BsdfPrincipled", Base_Color=color, Metallic=1.0, Roughness=roughness)


def shank() -> np.ndarray:
    """The band's outline (radius, half width): flat and rounded inside, a dome outside, counter-clockwise."""
    half, points = 1.25 * MM, []
    for t in np.linspace(0, 2 * np.pi, 28, endpoint=False):
        x, y = math.cos(t), math.sin(t)
        power = 0.9 if x > 0 else 0.35
        reach = 1.1 * MM if x > 0 else 0.6 * MM
        points.append(
            (INNER + 0.6 * MM + reach * math.copysign(abs(x) ** power, x), half * math.copysign(abs(y) ** 0.8, y))
        )
    return np.array(points)


def stone(name: str, radius: float, surface, at, rotation=(0, 0, 0)) -> bpy.types.Object:
    vertices, faces = gems.brilliant()
    return c.mesh(name, vertices * radius, faces, surface, location=at, rotation=rotation)


def head(surface, top: float) -> list[bpy.types.Object]:
    """Six claws that hold the stone's girdle at height `top` above the ring's middle, and two rings between them."""
    foot = INNER + 0.9 * THICK
    parts = []
    for k in range(6):
        a = math.radians(60 * k + 30)
        way = [(1.3 * MM, foot), (2.2 * MM, foot + 1.2 * MM), (0.99 * STONE, top - 1.0 * MM), (STONE + 0.42 * MM, top)]
        way += [(STONE + 0.30 * MM, top + 0.55 * MM), (STONE - 0.30 * MM, top + 1.00 * MM)]
        line = turned.curve(way, 4)
        path = np.stack([line[:, 0] * math.cos(a), line[:, 0] * math.sin(a), line[:, 1]], -1)
        width = np.interp(np.linspace(0, 1, len(path)), [0, 0.6, 0.9, 1], [0.55, 0.46, 0.45, 0.30]) * MM
        parts.append(turned.subdivide(turned.tube(f"claw_{k}", path, width, surface, 10), 1))
    for name, share in (("gallery_low", 0.16), ("gallery_high", 0.55)):
        height = foot + share * (top - foot)
        reach = np.interp(height, [foot, foot + 1.2 * MM, top - 1.0 * MM], [1.3 * MM, 2.2 * MM, 0.99 * STONE])
        ring = [(reach + 0.42 * MM * math.cos(t), height + 0.42 * MM * math.sin(t)) for t in np.arange(8) * math.pi / 4]
        parts.append(turned.turn(name, ring, surface, closed=True))
    return parts


def ring(diamond) -> None:
    """The ring lies as it falls: on the head's claws and the far edge of its shank, the stone looking at the camera."""
    gold = metal("gold", (0.95, 0.70, 0.33), 0.04)
    platinum = metal("platinum", (0.70, 0.68, 0.65), 0.06)
    band = turned.turn("shank", shank(), gold, segments=64, closed=True)
    band.rotation_euler = (math.radians(90), 0, 0)
    top = INNER + THICK + 3.55 * MM
    parts = [band, *head(platinum, top), stone("diamond", STONE, diamond, (0, 0, top), (0, 0, math.radians(11)))]
    pose = c.add(None, "ring_pose", (0, 0, 3.1 * MM), (math.radians(79.6), 0, math.radians(-24)))
    for part in parts:
        part.parent = pose


def loose(diamond) -> None:
    """Stones that lie on a facet of their pavilions: 40.8° off upright."""
    for i, (x, y, radius, turn) in enumerate(
        (
            (14.5, -9.0, 2.3, 200),
            (21.0, 3.0, 1.7, 75),
            (-17.5, -13.5, 1.9, 318),
            (7.0, -17.5, 1.4, 20),
            (-16.5, 7.0, 2.1, 140),
        )
    ):
        at = (x * MM, y * MM, 0.676 * radius * MM)
        stone(f"loose_{i}", radius * MM, diamond, at, (0, math.radians(40.8), math.radians(turn)))


def lamp(name: str, at, watts: float, radius: float, color) -> None:
    data = bpy.data.lights.new(name, "POINT")
    data.energy, data.shadow_soft_size, data.color = watts, radius, color
    c.add(data, name, at)


def build() -> None:
    scene = c.start(1200, 900, 256)
    c.quad("ground", (0, 0.10, 0), (0.3, 0, 0), (0, 0.3, 0), slate())
    diamond = c.material("diamond", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=2.417, distribution="SHARP")
    ring(diamond)
    loose(diamond)
    lamp("lamp_left", (-0.125, 0.050, 0.025), 2.6, 0.0007, (1.0, 0.80, 0.56))
    lamp("lamp_right", (0.115, 0.020, 0.022), 1.9, 0.0007, (0.66, 0.82, 1.0))
    lamp("lamp_front", (0.05, -0.14, 0.060), 0.45, 0.0008, (1.0, 0.95, 0.90))
    c.area_lamp("softbox_left", (-0.12, -0.14, 0.10), (0, 0, 0.005), 0.07, 0.045, (1.0, 0.93, 0.85))
    c.area_lamp("softbox_back", (0.06, 0.20, 0.10), (0, 0, 0.005), 0.08, 0.02, (0.85, 0.92, 1.0))
    c.world((0.20, 0.24, 0.32), 0.05)
    c.camera((0.006, -0.130, 0.088), (0.0005, -0.0065, 0.003), 118, focus=(-0.006, -0.016, 0.007), fstop=22.0)
    scene.camera.data.clip_start = 0.001
    scene.view_settings.exposure = 1.2
    c.save(c.output_path(os.path.join(HERE, "diamond_ring.blend")))


build()
