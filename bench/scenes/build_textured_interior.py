# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds textured_interior.blend: a furnished room, every surface textured, daylight through a window and two lamps.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_textured_interior.py -- OUT.blend
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import common as c  # noqa: E402
import pixels  # noqa: E402


def textured(name: str, image, scale: float, roughness, bump: float = 0.0):
    """A Principled material whose colour, roughness and bump come from one tiling image."""
    g = c.Graph(c.bpy.data.materials.new(name))
    at = g.node("Mapping", {"Vector": g.node("UVMap").outputs["UV"], "Scale": (scale, scale, scale)}).outputs["Vector"]
    color = g.node("TexImage", {"Vector": at}, image=image).outputs["Color"]
    grey = g.node("SeparateColor", {"Color": color}).outputs["Green"]
    inputs = {"Base Color": color, "Roughness": g.math("MULTIPLY_ADD", grey, roughness[1] - roughness[0], roughness[0])}
    if bump > 0.0:
        inputs["Normal"] = g.node("Bump", {"Height": grey, "Strength": 0.5, "Distance": bump}).outputs["Normal"]
    return g.surface(g.node("BsdfPrincipled", inputs))


def room(plaster, boards) -> None:
    """Four metres by five, 2.6 high, a window in the left wall."""
    c.quad("floor", (0, 0, 0), (2, 0, 0), (0, 2.5, 0), boards)
    c.quad("ceiling", (0, 0, 2.6), (-2, 0, 0), (0, 2.5, 0), plaster)
    c.quad("back", (0, 2.5, 1.3), (2, 0, 0), (0, 0, 1.3), plaster)
    c.quad("front", (0, -2.5, 1.3), (-2, 0, 0), (0, 0, 1.3), plaster)
    c.quad("right", (2, 0, 1.3), (0, -2.5, 0), (0, 0, 1.3), plaster)
    for name, y, z, half_y, half_z in (
        ("below", 0, 0.4, 2.5, 0.4),
        ("above", 0, 2.4, 2.5, 0.2),
        ("near", -1.6, 1.5, 0.9, 0.7),
        ("far", 1.9, 1.5, 0.6, 0.7),
    ):
        c.quad(f"left {name}", (-2, y, z), (0, half_y, 0), (0, 0, half_z), plaster)
    for y in (-0.7, 0.3, 1.3):
        c.box(f"frame {y}", (0.03, 0.03, 0.7), boards, 0.008, location=(-2, y, 1.5))


def furniture(wood, cloth, tiles) -> None:
    c.box("table", (0.8, 0.45, 0.025), wood, 0.01, location=(0.3, 0.9, 0.74))
    for x in (-0.42, 1.02):
        for y in (0.53, 1.27):
            c.box("leg", (0.03, 0.03, 0.36), wood, 0.006, location=(x, y, 0.36))
    c.box("sofa seat", (0.9, 0.4, 0.2), cloth, 0.06, location=(0.7, 2.0, 0.3))
    c.box("sofa back", (0.9, 0.12, 0.35), cloth, 0.06, location=(0.7, 2.35, 0.65))
    c.box("shelf", (0.18, 0.6, 0.9), wood, 0.008, location=(1.8, -0.2, 0.9))
    c.box("chest", (0.3, 0.3, 0.3), tiles, 0.02, location=(-1.3, 1.7, 0.3), rotation=(0, 0, 0.3))
    c.sphere("bowl", (0.1, 0.85, 0.88), 0.12, tiles, 64, 32)
    c.sphere(
        "steel",
        (0.55, 1.0, 0.865),
        0.1,
        c.material("steel", "BsdfPrincipled", Base_Color=(0.8, 0.8, 0.82), Metallic=1.0, Roughness=0.12),
        64,
        32,
    )
    c.sphere(
        "vase",
        (-1.3, 1.7, 0.78),
        0.18,
        c.material("vase", "BsdfPrincipled", Base_Color=(0.05, 0.2, 0.35), Roughness=0.08),
        64,
        32,
    )


def build() -> None:
    c.start(1024, 768)
    wood = textured("wood", pixels.image("wood", pixels.wood(1024, 1)), 0.8, (0.25, 0.5), 0.002)
    plaster = textured("plaster", pixels.image("plaster", pixels.plaster(1024, 2)), 0.6, (0.7, 0.95), 0.004)
    cloth = textured("cloth", pixels.image("cloth", pixels.cloth(512, 3)), 3.0, (0.8, 1.0), 0.002)
    tiles = textured("tiles", pixels.image("tiles", pixels.tiles(512, 4)), 2.0, (0.1, 0.3))
    room(plaster, wood)
    furniture(wood, cloth, tiles)
    for obj in c.bpy.data.objects:
        if obj.type == "MESH" and not obj.data.uv_layers:
            pixels.box_uvs(obj)
    window = c.area_lamp("daylight", (-2.3, 0.3, 1.6), (0, 0.5, 0.9), 1.4, 320.0, (0.75, 0.87, 1.0))
    window.data.shape, window.data.size, window.data.size_y = "RECTANGLE", 2.0, 1.4
    c.area_lamp("ceiling lamp", (0.3, 0.9, 2.3), (0.3, 0.9, 0), 0.35, 35.0, (1.0, 0.78, 0.52))
    point = c.bpy.data.lights.new("reading lamp", "POINT")
    point.energy, point.shadow_soft_size, point.color = 25.0, 0.06, (1.0, 0.7, 0.42)
    c.add(point, "reading lamp", (1.45, 1.6, 1.3))
    c.world((0.5, 0.65, 0.9), 0.6)
    c.camera((-0.9, -2.2, 1.5), (0.35, 1.1, 0.85), 26)
    c.save(c.output_path("textured_interior.blend"))


build()
