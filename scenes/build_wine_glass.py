# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds wine_glass.blend: a glass of red wine and its bottle on a linen cloth, against a low sun.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_wine_glass.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402
import linen  # noqa: E402
import numpy as np  # noqa: E402
import skies  # noqa: E402
import turned  # noqa: E402
import vessels  # noqa: E402

GLASS, BOTTLE = (0.035, 0.03, 0.0015), (-0.15, -0.01, 0.0015)
SUN = (146.0, 39.0)
"""Azimuth from +x to +y and elevation, in degrees: behind the table, a little to the left."""


def wine(level_glass: float, level_bottle: float, glass: np.ndarray, bottle: np.ndarray) -> None:
    red = vessels.tinted("red wine", 1.34, (0.88, 0.03, 0.055), 0.06)
    vessels.drink("wine_in_glass", glass, level_glass, red, 0.0004, location=GLASS)
    vessels.drink("wine_in_bottle", bottle, level_bottle, red, 0.0005, location=BOTTLE)


def label() -> None:
    """A label on the bottle, turned a little away from the camera."""
    turn = {"location": BOTTLE, "rotation": (0, 0, math.radians(14))}
    paper = c.material("paper", "BsdfPrincipled", Base_Color=(0.74, 0.70, 0.60), Roughness=0.7)
    ink = c.material("ink", "BsdfPrincipled", Base_Color=(0.030, 0.022, 0.020), Roughness=0.5)
    maroon = c.material("maroon print", "BsdfPrincipled", Base_Color=(0.23, 0.014, 0.020), Roughness=0.4)
    linen.wrap("label", 0.03800, 0.058, 0.142, 2.35, paper, **turn)
    linen.wrap("label_line_top", 0.03810, 0.1365, 0.1380, 2.25, maroon, **turn)
    linen.wrap("label_line_bottom", 0.03810, 0.0620, 0.0635, 2.25, maroon, **turn)
    for text, size, height, surface in (
        ("CARDIOID", 0.0140, 0.1120, maroon),
        ("GRAND VIN DE LUMIÈRE", 0.0050, 0.1015, ink),
        ("2025", 0.0100, 0.0830, ink),
        ("MIS EN BOUTEILLE AU CHÂTEAU", 0.0036, 0.0700, ink),
    ):
        linen.lettering(text, size, height, 0.03810, surface, **turn)


def cork() -> None:
    """The cork beside the glass, one end stained."""
    g = c.Graph(bpy.data.materials.new("cork"))
    at = g.node("TexCoord").outputs["Object"]
    grain = g.node("TexNoise", {"Vector": at, "Scale": 420.0, "Detail": 4.0}).outputs["Fac"]
    pores = g.node("TexVoronoi", {"Vector": at, "Scale": 260.0}).outputs["Distance"]
    color = g.ramp(grain, [(0.3, (0.33, 0.19, 0.09)), (0.7, (0.58, 0.39, 0.21))])
    pitted = g.mix_color(1.0, color, g.ramp(pores, [(0.10, (0.35, 0.27, 0.2)), (0.30, (1, 1, 1))]), "MULTIPLY")
    end = g.ramp(g.node("SeparateXYZ", {"Vector": at}).outputs["Z"], [(0.0, (1, 1, 1)), (0.9, (1, 1, 1))])
    bump = g.node("Bump", {"Height": grain, "Strength": 0.6, "Distance": 0.001}).outputs["Normal"]
    body = g.node("BsdfPrincipled", {"Base Color": g.mix_color(1.0, pitted, end, "MULTIPLY"), "Roughness": 0.85})
    g.feed(body.inputs["Normal"], bump)
    surface = g.surface(body)
    outline = [(0, 0), (0.0108, 0.0), (0.0116, 0.0008), (0.0116, 0.0432), (0.0108, 0.044), (0, 0.044)]
    rotation = (math.radians(90), 0, math.radians(38))
    turned.turn("cork", outline, surface, 32, fine=0, location=(-0.19, -0.15, 0.0122), rotation=rotation)


def grapes() -> None:
    """A few dark grapes that lie as they fell."""
    g = c.Graph(bpy.data.materials.new("grape"))
    at = g.node("TexCoord").outputs["Object"]
    bloom = g.node("TexNoise", {"Vector": at, "Scale": 70.0, "Detail": 4.0}).outputs["Fac"]
    color = g.ramp(bloom, [(0.35, (0.035, 0.006, 0.020)), (0.70, (0.11, 0.075, 0.13))])
    rough = g.math("MULTIPLY_ADD", bloom, 0.5, 0.08)
    skin = g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": rough, "Specular": 0.5}))
    spots = [(0.150, 0.030), (0.173, 0.041), (0.160, 0.055), (0.186, 0.022), (0.141, 0.051), (0.181, 0.066)]
    spots += [(0.205, 0.045)]
    for i, (x, y) in enumerate(spots):
        radius = 0.0105 + 0.0008 * math.sin(3.1 * i)
        grape = c.sphere(f"grape_{i}", (x, y, 1.12 * radius), radius, skin, 32, 16)
        grape.scale = (1.0, 1.0, 1.12)
    for i, (x, y) in enumerate(((0.162, 0.042), (0.178, 0.054), (0.171, 0.035))):
        c.sphere(f"grape_top_{i}", (x, y, 0.0285), 0.0104, skin, 32, 16).rotation_euler = (0.5, 0.4 * i, 0)


def build() -> None:
    scene = c.start(1200, 900, 256)
    linen.cloth(linen.weave(), (0.95, 0.42), 0.25)
    bowl = vessels.wine_glass(vessels.clear(), location=GLASS)
    green = vessels.tinted("bottle glass", 1.52, (0.42, 0.74, 0.24), 0.0052)
    wine(0.152, 0.118, bowl, vessels.bottle(green, location=BOTTLE))
    label()
    cork()
    grapes()
    skies.world(skies.packed("evening_garden", skies.evening_garden(*SUN)))
    c.camera((0.08, -0.95, 0.42), (0.015, -0.02, 0.105), 58, focus=(0.04, -0.03, 0.12), fstop=4.0)
    scene.view_settings.exposure = -0.35
    c.save(c.output_path(os.path.join(HERE, "wine_glass.blend")))


build()
