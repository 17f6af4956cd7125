# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds open_plane.blend: glass, metal and painted shapes on an open plane at dusk, one area lamp.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_open_plane.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402


def dusk() -> None:
    """A sky from warm at the horizon to deep blue above, by the Gradient Texture over the view's height."""
    data = bpy.data.worlds.new("dusk")
    g = c.Graph(data, "ShaderNodeOutputWorld")
    direction = g.node("TexCoord").outputs["Generated"]
    height = g.node("SeparateXYZ", {"Vector": direction}).outputs["Z"]
    along = g.node("CombineXYZ", {"X": height}).outputs["Vector"]
    gradient = g.node("TexGradient", {"Vector": along}, gradient_type="LINEAR").outputs["Fac"]
    color = g.ramp(
        gradient,
        [(0.0, (0.62, 0.36, 0.24)), (0.10, (0.42, 0.34, 0.36)), (0.35, (0.115, 0.17, 0.30)), (1.0, (0.03, 0.06, 0.14))],
    )
    g.surface(g.node("Background", {"Color": color, "Strength": 0.55}))
    bpy.context.scene.world = data


def ground() -> bpy.types.Material:
    """Smooth concrete: two scales of noise in tone, a faint bump."""
    g = c.Graph(bpy.data.materials.new("concrete"))
    at = g.node("TexCoord").outputs["Object"]
    large = g.node("TexNoise", {"Vector": at, "Scale": 0.9, "Detail": 6.0, "Roughness": 0.6}).outputs["Fac"]
    small = g.node("TexNoise", {"Vector": at, "Scale": 34.0, "Detail": 4.0}).outputs["Fac"]
    tone = g.ramp(large, [(0.30, (0.40, 0.385, 0.37)), (0.70, (0.56, 0.54, 0.515))])
    color = g.mix_color(0.35, tone, g.ramp(small, [(0.35, (0.72, 0.72, 0.72)), (0.60, (1, 1, 1))]), "MULTIPLY")
    bump = g.node("Bump", {"Height": small, "Strength": 0.15, "Distance": 0.004}).outputs["Normal"]
    return g.surface(g.node("BsdfDiffuse", {"Color": color, "Roughness": 0.0, "Normal": bump}))


def torus(name: str, major: float, minor: float, surface, **place):
    profile = [(major + minor * math.cos(a), minor * math.sin(a)) for a in (2 * math.pi * k / 64 for k in range(48))]
    return c.revolve(name, profile, surface, segments=144, **place)


def cone(name: str, radius: float, height: float, surface, **place):
    """A cone with a rounded rim and tip."""
    slope = math.atan2(height, radius)
    fillet, tip, points = 0.03, 0.04, []
    inset = radius - fillet / math.tan(slope / 2)
    points.append((1e-4, 0.0))
    points.append((inset * 0.97, 0.0))
    for k in range(9):
        a = -math.pi / 2 + (math.pi - slope) * k / 8
        points.append((inset + fillet * math.cos(a), fillet + fillet * math.sin(a)))
    top = height - tip / math.cos(slope) + tip * 0.35
    for k in range(9):
        a = math.pi / 2 - slope + slope * k / 8
        points.append((max(tip * math.cos(a), 1e-4), top - tip * 0.35 + tip * math.sin(a)))
    return c.revolve(name, points, surface, segments=96, **place)


def build() -> None:
    scene = c.start(1280, 800)
    c.quad("plane", (0, 0, 0), (60, 0, 0), (0, 60, 0), ground())
    blue = c.material("blue paint", "BsdfPrincipled", Base_Color=(0.030, 0.115, 0.42), Roughness=0.45)
    coral = c.material("coral", "BsdfDiffuse", Color=(0.72, 0.155, 0.085))
    cream = c.material("cream", "BsdfDiffuse", Color=(0.74, 0.66, 0.50))
    glass = c.material("glass", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=1.5, distribution="SHARP")
    aqua = c.material("aqua glass", "BsdfGlass", Color=(0.72, 0.95, 0.93), Roughness=0.0, IOR=1.5, distribution="SHARP")
    chrome = c.material("chrome", "BsdfGlossy", Color=(0.92, 0.92, 0.93), Roughness=0.0, distribution="SHARP")
    copper = c.material("copper", "BsdfPrincipled", Base_Color=(0.93, 0.50, 0.34), Metallic=1.0, Roughness=0.16)
    gold = c.material("gold", "BsdfPrincipled", Base_Color=(0.96, 0.74, 0.36), Metallic=1.0, Roughness=0.0)
    c.box(
        "blue_box",
        (0.42, 0.42, 0.42),
        blue,
        bevel=0.035,
        location=(-0.75, 0.95, 0.42),
        rotation=(0, 0, math.radians(27)),
    )
    c.sphere("chrome_sphere", (0.62, 1.05, 0.55), 0.55, chrome)
    c.sphere("glass_sphere", (-0.28, -0.18, 0.36), 0.36, glass)
    torus("gold_ring", 0.40, 0.085, gold, location=(0.78, -0.20, 0.0855))
    torus(
        "aqua_torus", 0.27, 0.10, aqua, location=(-1.22, -0.28, 0.27), rotation=(math.radians(78), 0, math.radians(38))
    )
    cone("cream_cone", 0.36, 0.92, cream, location=(1.62, 0.62, 0.001))
    c.sphere("copper_sphere", (0.20, -0.72, 0.17), 0.17, copper, 96, 48)
    c.sphere("coral_sphere", (-1.78, 0.62, 0.30), 0.30, coral, 96, 48)
    c.sphere("coral_marble", (1.42, -0.62, 0.13), 0.13, coral, 96, 48)
    c.area_lamp("lamp", (-2.6, 2.2, 3.6), (0, 0.1, 0.2), 0.8, 420.0, (1.0, 0.86, 0.68))
    dusk()
    c.camera((0.30, -5.5, 1.18), (0.02, 0.2, 0.52), 50, focus=(0.0, -0.2, 0.35), fstop=2.8)
    scene.view_settings.exposure = 0.1
    c.save(c.output_path(os.path.join(HERE, "open_plane.blend")))


build()
