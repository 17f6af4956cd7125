# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds metallic_ring.blend: a gold ring on a wooden floor between brick walls, a small lamp above it.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_metallic_ring.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402


def wood() -> bpy.types.Material:
    """Planks by a Brick Texture; each shifts the stretched noise of the grain by its own random tone."""
    g = c.Graph(bpy.data.materials.new("wood planks"))
    uv = g.node("UVMap").outputs["UV"]
    planks = g.node(
        "TexBrick",
        {
            "Vector": uv,
            "Color1": (0, 0, 0),
            "Color2": (1, 1, 1),
            "Mortar": (0.5, 0.5, 0.5),
            "Scale": 1.0,
            "Mortar Size": 0.0022,
            "Mortar Smooth": 0.2,
            "Bias": 0.0,
            "Brick Width": 1.35,
            "Row Height": 0.15,
        },
        offset=0.37,
        offset_frequency=2,
    )
    tone = planks.outputs["Color"]
    shifted = g.vector_math("MULTIPLY_ADD", tone, (7.3, 3.1, 5.7), uv)
    stretched = g.node("Mapping", {"Vector": shifted, "Scale": (1.6, 26.0, 1.0)}).outputs["Vector"]
    grain = g.node(
        "TexNoise", {"Vector": stretched, "Scale": 1.0, "Detail": 7.0, "Roughness": 0.62, "Distortion": 0.9}
    ).outputs["Fac"]
    fine = g.node("Mapping", {"Vector": shifted, "Scale": (9.0, 240.0, 1.0)}).outputs["Vector"]
    pores = g.node("TexNoise", {"Vector": fine, "Scale": 1.0, "Detail": 2.0, "Roughness": 0.5}).outputs["Fac"]
    base = g.ramp(
        grain,
        [
            (0.26, (0.215, 0.140, 0.086)),
            (0.44, (0.30, 0.205, 0.130)),
            (0.58, (0.36, 0.252, 0.162)),
            (0.76, (0.43, 0.315, 0.21)),
        ],
    )
    dark = g.ramp(pores, [(0.36, (0.45, 0.42, 0.40)), (0.52, (1, 1, 1))])
    pored = g.mix_color(0.55, base, dark, "MULTIPLY")
    tinted = g.node(
        "HueSaturation", {"Color": pored, "Value": g.math("MULTIPLY_ADD", tone, 0.5, 0.72), "Saturation": 0.9}
    ).outputs["Color"]
    color = g.mix_color(planks.outputs["Fac"], tinted, (0.012, 0.006, 0.003))
    height = g.math("SUBTRACT", g.math("MULTIPLY", pores, 0.12), planks.outputs["Fac"])
    bump = g.node("Bump", {"Height": height, "Strength": 0.35, "Distance": 0.004}).outputs["Normal"]
    rough = g.math("MULTIPLY_ADD", grain, 0.25, 0.28)
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": color, "Roughness": rough, "Specular": 0.4, "Normal": bump})
    )


def bricks() -> bpy.types.Material:
    """Weathered bricks: two tones, noise over both, mortar set back by a bump."""
    g = c.Graph(bpy.data.materials.new("bricks"))
    uv = g.node("UVMap").outputs["UV"]
    wobble = g.node("TexNoise", {"Vector": uv, "Scale": 14.0, "Detail": 3.0}).outputs["Color"]
    bent = g.vector_math("MULTIPLY_ADD", wobble, (0.010, 0.010, 0.0), uv)
    wall = g.node(
        "TexBrick",
        {
            "Vector": bent,
            "Color1": (0.36, 0.115, 0.060),
            "Color2": (0.20, 0.060, 0.038),
            "Mortar": (0.34, 0.30, 0.26),
            "Scale": 1.0,
            "Mortar Size": 0.0085,
            "Mortar Smooth": 0.35,
            "Bias": -0.1,
            "Brick Width": 0.235,
            "Row Height": 0.082,
        },
    )
    grit = g.node("TexNoise", {"Vector": uv, "Scale": 55.0, "Detail": 6.0, "Roughness": 0.65}).outputs["Fac"]
    stain = g.node("TexNoise", {"Vector": uv, "Scale": 2.3, "Detail": 4.0}).outputs["Fac"]
    gritty = g.mix_color(
        0.7, wall.outputs["Color"], g.ramp(grit, [(0.30, (0.52, 0.50, 0.48)), (0.66, (1.0, 0.98, 0.95))]), "MULTIPLY"
    )
    color = g.mix_color(0.55, gritty, g.ramp(stain, [(0.35, (0.55, 0.53, 0.52)), (0.62, (1, 1, 1))]), "MULTIPLY")
    height = g.math("MULTIPLY_ADD", grit, 0.35, g.math("MULTIPLY", wall.outputs["Fac"], -1.0))
    bump = g.node("Bump", {"Height": height, "Strength": 0.8, "Distance": 0.010}).outputs["Normal"]
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.85, "Specular": 0.25, "Normal": bump})
    )


def band(inner: float, outer: float, height: float, steps: int = 72) -> list[tuple[float, float]]:
    """The ring's profile: its inside, almost flat, throws the cardioid; its outside bulges and mirrors the room."""
    middle, points = inner + 0.3 * (outer - inner), []
    for k in range(steps):
        t = 2 * math.pi * k / steps
        power = 2 / 2.3 if math.cos(t) > 0 else 2 / 9.0
        reach = outer - middle if math.cos(t) > 0 else middle - inner
        points.append(
            (
                middle + reach * math.copysign(abs(math.cos(t)) ** power, math.cos(t)),
                height * (0.5 + 0.5 * math.copysign(abs(math.sin(t)) ** power, math.sin(t))) + 0.001,
            )
        )
    return points


def build() -> None:
    scene = c.start(1152, 864)
    planks, wall = wood(), bricks()
    c.quad("floor", (0, 0, 0), (2.2, 0, 0), (0, 2.2, 0), planks)
    c.quad("wall_back", (0, 1.55, 1.3), (-2.2, 0, 0), (0, 0, 1.3), wall).data.flip_normals()
    c.quad("wall_left", (-1.55, 0, 1.3), (0, 2.2, 0), (0, 0, 1.3), wall)
    c.quad("wall_right", (2.1, 0, 1.3), (0, -2.2, 0), (0, 0, 1.3), wall)
    c.quad("wall_front", (0, -2.2, 1.3), (2.2, 0, 0), (0, 0, 1.3), wall).data.flip_normals()
    skirting = c.material("skirting", "BsdfPrincipled", Base_Color=(0.045, 0.02, 0.01), Roughness=0.4)
    c.box("skirting_back", (2.2, 0.012, 0.055), skirting, bevel=0.006, location=(0, 1.538, 0.055))
    c.box("skirting_left", (0.012, 2.2, 0.055), skirting, bevel=0.006, location=(-1.538, 0, 0.055))
    gold = c.material("gold", "BsdfPrincipled", Base_Color=(0.98, 0.76, 0.40), Metallic=1.0, Roughness=0.0)
    c.revolve("ring", band(0.50, 0.575, 0.22), gold, segments=256)
    c.area_lamp("lamp", (1.12, 0.70, 1.06), (0, 0, 0.05), 0.13, 26.0, (1.0, 0.84, 0.64))
    c.world((0.34, 0.46, 0.66), 0.12)
    c.camera((0.22, -2.05, 1.20), (-0.05, 0.20, 0.17), 45, focus=(0.0, -0.2, 0.1), fstop=4.0)
    scene.view_settings.exposure = 0.75
    c.save(c.output_path(os.path.join(HERE, "metallic_ring.blend")))


build()
