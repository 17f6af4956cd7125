# SPDX-License-Identifier: GPL-3.0-or-later
"""A swimmer who glides under water, sculpted as in sculpt.py: head along +x, belly toward −z, about two metres long."""

from __future__ import annotations

import bpy
import common as c
import numpy as np
from sculpt import Clay


def limbs(clay: Clay, side: int) -> None:
    """One leg and one arm; the legs of the two sides are at opposite ends of the kick."""
    kick = 0.07 * side
    hip, knee, ankle = (-0.07, side * 0.082, 0.0), (-0.49, side * 0.082, kick - 0.03), (-0.90, side * 0.070, kick * 1.9)
    toe = (-1.11, side * 0.062, kick * 2.3 - 0.03)
    clay.add(clay.capsule(hip, knee, 0.085, 0.056), 0.05)
    clay.add(clay.capsule(knee, ankle, 0.055, 0.034), 0.03)
    clay.add(clay.ellipsoid((-0.62, side * 0.080, kick * 1.25 + 0.012), (0.15, 0.048, 0.052)), 0.03)
    clay.add(clay.capsule(ankle, toe, 0.034, 0.018), 0.03)
    clay.add(clay.ellipsoid((-1.02, side * 0.066, kick * 2.1 - 0.02), (0.09, 0.042, 0.022)), 0.02)
    shoulder, elbow = (0.47, side * 0.168, 0.01), (0.75, side * 0.225, -0.01)
    wrist, tips = (0.99, side * 0.140, 0.03), (1.17, side * 0.060, 0.045)
    clay.add(clay.sphere(shoulder, 0.068), 0.06)
    clay.add(clay.capsule(shoulder, elbow, 0.052, 0.038), 0.03)
    clay.add(clay.capsule(elbow, wrist, 0.041, 0.026), 0.02)
    clay.add(clay.capsule(wrist, tips, 0.024, 0.012), 0.02)
    clay.add(clay.ellipsoid((1.07, side * 0.104, 0.038), (0.062, 0.040, 0.018)), 0.02)


def body(clay: Clay) -> None:
    """Trunk with a hollow along the spine, neck, head with nose and ears."""
    clay.add(clay.ellipsoid((0.36, 0, 0.0), (0.21, 0.170, 0.108)))
    clay.add(clay.ellipsoid((0.13, 0, -0.005), (0.22, 0.135, 0.090)), 0.08)
    clay.add(clay.ellipsoid((-0.06, 0, 0.012), (0.15, 0.152, 0.104)), 0.07)
    clay.cut(clay.capsule((-0.02, 0, 0.135), (0.44, 0, 0.135), 0.030), 0.05)
    for side in (-1, 1):
        clay.add(clay.ellipsoid((0.37, side * 0.095, 0.060), (0.11, 0.060, 0.050)), 0.04)
        limbs(clay, side)
    clay.add(clay.capsule((0.50, 0, 0.015), (0.62, 0, 0.03), 0.062, 0.055), 0.05)
    clay.add(clay.ellipsoid((0.715, 0, 0.035), (0.118, 0.078, 0.098)), 0.02)
    clay.add(clay.ellipsoid((0.735, 0, -0.055), (0.065, 0.055, 0.060)), 0.03)
    clay.add(clay.sphere((0.775, 0, -0.085), 0.018), 0.02)


def clothes() -> bpy.types.Material:
    """Skin, trunks and cap, told apart by the place on the body."""
    g = c.Graph(bpy.data.materials.new("swimmer"))
    at = g.node("SeparateXYZ", {"Vector": g.node("TexCoord").outputs["Object"]})
    x, y, z = (at.outputs[k] for k in "XYZ")
    trunks = g.math("LESS_THAN", g.math("ABSOLUTE", g.math("ADD", x, 0.135)), 0.175)
    head = g.math("MULTIPLY", g.math("GREATER_THAN", x, 0.60), g.math("LESS_THAN", g.math("ABSOLUTE", y), 0.10))
    upper = g.math("GREATER_THAN", g.math("ADD", z, g.math("MULTIPLY", x, 0.55)), 0.395)
    skin = g.mix_color(trunks, (0.47, 0.255, 0.165), (0.62, 0.055, 0.030))
    color = g.mix_color(g.math("MULTIPLY", head, upper), skin, (0.72, 0.70, 0.62))
    return g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.45, "Specular": 0.2}))


def swimmer(location, rotation) -> bpy.types.Object:
    clay = Clay((-1.2, -0.34, -0.26), (1.26, 0.34, 0.26), 0.012)
    body(clay)
    vertices, faces = clay.surface()
    obj = c.mesh("swimmer", np.round(vertices, 4), faces, clothes(), smooth=True, location=location, rotation=rotation)
    fine = obj.modifiers.new("Subdivision", "SUBSURF")
    fine.levels, fine.render_levels = 0, 1
    return obj
