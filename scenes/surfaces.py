# SPDX-License-Identifier: GPL-3.0-or-later
"""Procedural surfaces that several scenes share: planks, bricks, a marble checker. UVs are in metres."""

from __future__ import annotations

import bpy
import common as c


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


def marble_checker(tile: float = 0.5) -> bpy.types.Material:
    """Polished marble tiles, light and dark, each with faint veins of its own."""
    g = c.Graph(bpy.data.materials.new("marble checker"))
    uv = g.node("UVMap").outputs["UV"]
    checks = g.node("TexChecker", {"Vector": uv, "Color1": (0, 0, 0), "Color2": (1, 1, 1), "Scale": 1.0 / tile})
    light = checks.outputs["Fac"]
    own = g.vector_math("MULTIPLY_ADD", g.vector_math("SNAP", uv, (tile, tile, 1.0)), (3.7, 5.3, 0.0), uv)
    bend = g.node("TexNoise", {"Vector": own, "Scale": 3.0, "Detail": 6.0, "Roughness": 0.6}).outputs["Color"]
    bent = g.vector_math("MULTIPLY_ADD", bend, (0.55, 0.55, 0.55), own)
    vein = g.node("TexNoise", {"Vector": bent, "Scale": 4.5, "Detail": 8.0, "Roughness": 0.62}).outputs["Fac"]
    ridge = g.math("ABSOLUTE", g.math("SUBTRACT", vein, 0.5))
    pale = g.ramp(ridge, [(0.0, (0.36, 0.35, 0.36)), (0.035, (0.60, 0.585, 0.56)), (0.16, (0.74, 0.72, 0.69))])
    dark = g.ramp(ridge, [(0.0, (0.34, 0.34, 0.31)), (0.018, (0.085, 0.10, 0.095)), (0.14, (0.030, 0.040, 0.038))])
    color = g.mix_color(light, dark, pale)
    return g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.3, "Specular": 0.4}))


def travertine(name: str, brightness: float = 1.0) -> bpy.types.Material:
    """Honed pale limestone: soft bands, pores that are darker and deeper; each object a cut of its own."""
    g = c.Graph(bpy.data.materials.new(name))
    at = g.node("TexCoord").outputs["Object"]
    own = g.node("ObjectInfo").outputs["Random"]
    here = g.vector_math("MULTIPLY_ADD", own, (31.0, 17.0, 23.0), at)
    stretched = g.node("Mapping", {"Vector": here, "Scale": (2.2, 9.0, 9.0)}).outputs["Vector"]
    bands = g.node("TexNoise", {"Vector": stretched, "Scale": 1.0, "Detail": 6.0, "Distortion": 0.6}).outputs["Fac"]
    holes = g.node("TexNoise", {"Vector": stretched, "Scale": 9.0, "Detail": 3.0}).outputs["Fac"]
    dark, pale = (0.50, 0.43, 0.33), (0.70, 0.645, 0.55)
    stone = g.ramp(bands, [(0.30, tuple(brightness * v for v in dark)), (0.68, tuple(brightness * v for v in pale))])
    pore = g.ramp(holes, [(0.30, (0.45, 0.42, 0.38)), (0.38, (1, 1, 1))])
    color = g.mix_color(1.0, stone, pore, "MULTIPLY")
    toned = g.node("HueSaturation", {"Color": color, "Value": g.math("MULTIPLY_ADD", own, 0.22, 0.88)})
    bump = g.node("Bump", {"Height": pore, "Strength": 0.4, "Distance": 0.002}).outputs["Normal"]
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": toned.outputs[0], "Roughness": 0.55, "Specular": 0.3, "Normal": bump})
    )


def paving() -> bpy.types.Material:
    """Sandstone slabs, 60 × 40 cm, each of its own tone, with sandy joints."""
    g = c.Graph(bpy.data.materials.new("paving"))
    uv = g.node("UVMap").outputs["UV"]
    slabs = g.node(
        "TexBrick",
        {
            "Vector": uv,
            "Color1": (0.50, 0.43, 0.34),
            "Color2": (0.61, 0.55, 0.46),
            "Mortar": (0.30, 0.26, 0.21),
            "Scale": 1.0,
            "Mortar Size": 0.004,
            "Mortar Smooth": 0.3,
            "Bias": 0.0,
            "Brick Width": 0.6,
            "Row Height": 0.4,
        },
        offset=0.5,
    )
    grain = g.node("TexNoise", {"Vector": uv, "Scale": 38.0, "Detail": 5.0, "Roughness": 0.65}).outputs["Fac"]
    stain = g.node("TexNoise", {"Vector": uv, "Scale": 0.9, "Detail": 5.0}).outputs["Fac"]
    speckled = g.mix_color(
        0.6, slabs.outputs["Color"], g.ramp(grain, [(0.3, (0.72, 0.70, 0.67)), (0.65, (1, 1, 1))]), "MULTIPLY"
    )
    color = g.mix_color(0.6, speckled, g.ramp(stain, [(0.35, (0.72, 0.70, 0.68)), (0.6, (1, 1, 1))]), "MULTIPLY")
    height = g.math("MULTIPLY_ADD", grain, 0.2, g.math("MULTIPLY", slabs.outputs["Fac"], -1.0))
    bump = g.node("Bump", {"Height": height, "Strength": 0.6, "Distance": 0.005}).outputs["Normal"]
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.7, "Specular": 0.25, "Normal": bump})
    )


def stucco(name: str = "stucco", color=(0.66, 0.62, 0.55)) -> bpy.types.Material:
    """Lime plaster by hand: a rough bump, faint clouds in its tone."""
    g = c.Graph(bpy.data.materials.new(name))
    at = g.node("TexCoord").outputs["Object"]
    coarse = g.node("TexNoise", {"Vector": at, "Scale": 5.0, "Detail": 4.0}).outputs["Fac"]
    fine = g.node("TexNoise", {"Vector": at, "Scale": 70.0, "Detail": 4.0, "Roughness": 0.6}).outputs["Fac"]
    clouds = g.node("TexNoise", {"Vector": at, "Scale": 0.8, "Detail": 5.0}).outputs["Fac"]
    tone = g.ramp(clouds, [(0.3, tuple(0.86 * v for v in color)), (0.65, color)])
    height = g.math("MULTIPLY_ADD", fine, 0.35, coarse)
    bump = g.node("Bump", {"Height": height, "Strength": 0.35, "Distance": 0.012}).outputs["Normal"]
    return g.surface(g.node("BsdfPrincipled", {"Base Color": tone, "Roughness": 0.9, "Specular": 0.15, "Normal": bump}))


def teak() -> bpy.types.Material:
    """Oiled wood, grain along the object's x."""
    g = c.Graph(bpy.data.materials.new("teak"))
    own = g.node("ObjectInfo").outputs["Random"]
    at = g.vector_math("MULTIPLY_ADD", own, (9.0, 5.0, 7.0), g.node("TexCoord").outputs["Object"])
    stretched = g.node("Mapping", {"Vector": at, "Scale": (1.4, 34.0, 34.0)}).outputs["Vector"]
    grain = g.node("TexNoise", {"Vector": stretched, "Scale": 1.0, "Detail": 6.0, "Distortion": 0.8}).outputs["Fac"]
    color = g.ramp(grain, [(0.3, (0.155, 0.070, 0.030)), (0.5, (0.27, 0.135, 0.062)), (0.72, (0.36, 0.195, 0.095))])
    bump = g.node("Bump", {"Height": grain, "Strength": 0.2, "Distance": 0.002}).outputs["Normal"]
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.42, "Specular": 0.4, "Normal": bump})
    )


def mosaic(name: str, tones, joint, size: float = 0.05, roughness: float = 0.28) -> bpy.types.Material:
    """Glazed square tiles, each of its own tone between `tones`, with a joint that lies a little deeper."""
    g = c.Graph(bpy.data.materials.new(name))
    uv = g.node("UVMap").outputs["UV"]
    tiles = g.node(
        "TexBrick",
        {
            "Vector": uv,
            "Color1": (0, 0, 0),
            "Color2": (1, 1, 1),
            "Mortar": (0.5, 0.5, 0.5),
            "Scale": 1.0,
            "Mortar Size": 0.035 * size,
            "Mortar Smooth": 0.3,
            "Bias": 0.0,
            "Brick Width": size,
            "Row Height": size,
        },
        offset=0.0,
        squash=1.0,
    )
    cloud = g.node("TexNoise", {"Vector": uv, "Scale": 0.7, "Detail": 3.0}).outputs["Fac"]
    tone = g.math("MULTIPLY_ADD", cloud, 0.5, g.math("MULTIPLY", tiles.outputs["Color"], 0.75))
    color = g.mix_color(tiles.outputs["Fac"], g.ramp(tone, tones), joint)
    bump = g.node("Bump", {"Height": tiles.outputs["Fac"], "Strength": 0.5, "Distance": 0.003}, invert=True)
    return g.surface(
        g.node(
            "BsdfPrincipled",
            {"Base Color": color, "Roughness": roughness, "Specular": 0.3, "Normal": bump.outputs["Normal"]},
        )
    )
