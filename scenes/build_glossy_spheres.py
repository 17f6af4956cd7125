# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds glossy_spheres.blend: aluminium and copper spheres of several roughnesses under three small lamps.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_glossy_spheres.py [-- OUT.blend]
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402
import surfaces  # noqa: E402

ALUMINIUM = ((1.6575, 0.8804, 0.5212), (9.2239, 6.2695, 4.8370))
COPPER = ((0.2004, 0.9240, 1.1022), (3.9129, 2.4528, 2.1422))
"""n and k for red, green and blue: the measured spectra that pbrt carries (thesis's [PH10]), brought to linear RGB."""


def facing(metal) -> tuple[float, ...]:
    """Reflectance at normal incidence from n and k, by Fresnel's equations."""
    return tuple(((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k) for n, k in zip(*metal))


def metal(name: str, index, roughness: float) -> bpy.types.Material:
    title = f"{name}, roughness {roughness:g}"
    return c.material(title, "BsdfPrincipled", Base_Color=facing(index), Metallic=1.0, Roughness=roughness)


def panels() -> bpy.types.Material:
    """Tall wooden panels: the planks of the floor, darker and upright."""
    g = c.Graph(bpy.data.materials.new("wooden panels"))
    uv = g.node("UVMap").outputs["UV"]
    upright = g.node("Mapping", {"Vector": uv, "Rotation": (0.0, 0.0, 1.5707963)}).outputs["Vector"]
    boards = g.node(
        "TexBrick",
        {
            "Vector": upright,
            "Color1": (0, 0, 0),
            "Color2": (1, 1, 1),
            "Mortar": (0.5, 0.5, 0.5),
            "Scale": 1.0,
            "Mortar Size": 0.004,
            "Mortar Smooth": 0.3,
            "Brick Width": 3.1,
            "Row Height": 0.21,
        },
    )
    tone = boards.outputs["Color"]
    shifted = g.vector_math("MULTIPLY_ADD", tone, (5.1, 2.7, 3.9), upright)
    along = g.node("Mapping", {"Vector": shifted, "Scale": (1.3, 30.0, 1.0)}).outputs["Vector"]
    grain = g.node("TexNoise", {"Vector": along, "Scale": 1.0, "Detail": 8.0, "Roughness": 0.66, "Distortion": 1.4})
    base = g.ramp(
        grain.outputs["Fac"],
        [(0.28, (0.10, 0.048, 0.022)), (0.50, (0.21, 0.108, 0.052)), (0.72, (0.33, 0.185, 0.095))],
    )
    tinted = g.node("HueSaturation", {"Color": base, "Value": g.math("MULTIPLY_ADD", tone, 0.7, 0.7)}).outputs["Color"]
    color = g.mix_color(boards.outputs["Fac"], tinted, (0.012, 0.006, 0.003))
    height = g.math("SUBTRACT", g.math("MULTIPLY", grain.outputs["Fac"], 0.15), boards.outputs["Fac"])
    bump = g.node("Bump", {"Height": height, "Strength": 0.5, "Distance": 0.006}).outputs["Normal"]
    return g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.4, "Specular": 0.4, "Normal": bump}))


def room() -> None:
    """4.4 m wide, bricks behind, wooden panels at the sides, planks below."""
    plaster = c.material("plaster", "BsdfDiffuse", Color=(0.70, 0.68, 0.64))
    bricks, wood = surfaces.bricks(), panels()
    c.quad("floor", (0, 0, 0), (2.2, 0, 0), (0, 3.4, 0), surfaces.wood())
    c.quad("ceiling", (0, 0, 2.8), (2.2, 0, 0), (0, -3.4, 0), plaster)
    c.quad("wall_back", (0, 2.0, 1.4), (2.2, 0, 0), (0, 0, 1.4), bricks)
    c.quad("wall_front", (0, -3.4, 1.4), (-2.2, 0, 0), (0, 0, 1.4), plaster)
    c.quad("wall_left", (-2.2, 0, 1.4), (0, 3.4, 0), (0, 0, 1.4), wood)
    c.quad("wall_right", (2.2, 0, 1.4), (0, -3.4, 0), (0, 0, 1.4), wood)
    skirting = c.material("skirting", "BsdfPrincipled", Base_Color=(0.05, 0.025, 0.012), Roughness=0.4)
    c.box("skirting_back", (2.2, 0.012, 0.055), skirting, bevel=0.006, location=(0, 1.988, 0.055))


def spheres() -> None:
    aluminium = {r: metal("aluminium", ALUMINIUM, r) for r in (0.0, 0.12, 0.35)}
    copper = {r: metal("copper", COPPER, r) for r in (0.0, 0.2, 0.45)}
    c.sphere("aluminium_glossy", (-0.78, 0.70, 0.58), 0.58, aluminium[0.12])
    c.sphere("copper_glossy", (0.72, 0.72, 0.52), 0.52, copper[0.2])
    c.sphere("aluminium_satin", (-0.06, -0.20, 0.32), 0.32, aluminium[0.35])
    c.sphere("copper_mirror", (0.86, -0.52, 0.27), 0.27, copper[0.0])
    c.sphere("aluminium_mirror", (-0.92, -0.58, 0.24), 0.24, aluminium[0.0])
    c.sphere("copper_satin", (1.50, 0.10, 0.25), 0.25, copper[0.45])
    paint = c.material("blue paint", "BsdfDiffuse", Color=(0.045, 0.16, 0.42))
    c.sphere("painted", (0.34, -0.92, 0.15), 0.15, paint)


def build() -> None:
    scene = c.start(768, 768, 16)
    room()
    spheres()
    c.area_lamp("lamp_left", (-1.9, 0.9, 1.95), (0.2, -0.1, 0.0), 0.14, 40.0, (1.0, 0.80, 0.58))
    c.area_lamp("lamp_right", (1.8, 1.2, 2.1), (-0.1, -0.2, 0.0), 0.08, 44.0, (0.76, 0.87, 1.0))
    c.area_lamp("lamp_front", (-0.7, -2.4, 2.45), (0.0, 0.9, 0.4), 0.20, 38.0, (1.0, 0.95, 0.88))
    c.world((0, 0, 0))
    c.camera((0.05, -2.95, 1.30), (0.06, 0.25, 0.50), 32)
    scene.view_settings.exposure = 0.25
    c.save(c.output_path(os.path.join(HERE, "glossy_spheres.blend")))


build()
