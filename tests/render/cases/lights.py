# SPDX-License-Identifier: GPL-3.0-or-later
"""Each kind of lamp, an emissive mesh, many lamps at once."""

import math

import common
import kit
from kit import case


@case()
def point_hard(scene):
    """A point lamp of radius 0: hard shadows, 1/r² falloff, E/(4π²) watts per steradian."""
    kit.lamp_stage()
    kit.lamp("POINT", (0.4, -1.3, 2.2), energy=120.0, shadow_soft_size=0.0)


@case(wheels=True)
def point_soft(scene):
    """A point lamp with a radius; Blender 4 made it a sphere light."""
    kit.lamp_stage()
    kit.lamp("POINT", (0.4, -1.3, 2.2), energy=120.0, shadow_soft_size=0.5)


@case(samples=96)
def spot_hard(scene):
    """A spot without blend."""
    kit.lamp_stage()
    kit.lamp("SPOT", (1.6, -1.6, 2.6), energy=500.0, shadow_soft_size=0.0, spot_size=math.radians(42), spot_blend=0.0)


@case(samples=96, wheels=True)
def spot_soft(scene):
    """A spot with radius and a wide blend."""
    kit.lamp_stage()
    kit.lamp("SPOT", (1.6, -1.6, 2.6), energy=500.0, shadow_soft_size=0.3, spot_size=math.radians(60), spot_blend=0.6)


@case()
def sun_hard(scene):
    """A sun of angle 0."""
    kit.lamp_stage()
    kit.lamp("SUN", (2, -2, 3), energy=2.5, angle=0.0)


@case(wheels=True)
def sun_soft(scene):
    """A sun 15° wide."""
    kit.lamp_stage()
    kit.lamp("SUN", (2, -2, 3), energy=2.5, angle=math.radians(15))


@case(wheels=True)
def area_square(scene):
    """A square area lamp."""
    kit.lamp_stage()
    kit.lamp("AREA", (1.2, -1.6, 2.4), shape="SQUARE", size=1.0, energy=110.0)


@case()
def area_rectangle(scene):
    """A rectangular area lamp, long and narrow, turned."""
    kit.lamp_stage()
    lamp = kit.lamp("AREA", (1.2, -1.6, 2.4), shape="RECTANGLE", size=1.8, size_y=0.3, energy=110.0)
    lamp.rotation_euler.rotate_axis("Z", 0.6)


@case()
def area_disk(scene):
    """A disk area lamp."""
    kit.lamp_stage()
    kit.lamp("AREA", (1.2, -1.6, 2.4), shape="DISK", size=1.2, energy=110.0)


@case()
def area_ellipse(scene):
    """An elliptical area lamp."""
    kit.lamp_stage()
    kit.lamp("AREA", (1.2, -1.6, 2.4), shape="ELLIPSE", size=1.6, size_y=0.5, energy=110.0)


@case(samples=96)
def area_spread(scene):
    """An area lamp whose spread is 60°."""
    kit.lamp_stage()
    kit.lamp("AREA", (1.2, -1.6, 2.4), shape="SQUARE", size=0.8, energy=90.0, spread=math.radians(60))


@case()
def area_scaled(scene):
    """An area lamp under an object scale that is not uniform: a larger lamp of the same power."""
    kit.lamp_stage()
    lamp = kit.lamp("AREA", (1.2, -1.6, 2.4), shape="SQUARE", size=0.6, energy=110.0)
    lamp.scale = (2.5, 0.8, 1.0)


@case(samples=96)
def many_lamps(scene):
    """Twelve lamps of different colours and strengths: choosing between them must not change the picture."""
    kit.lamp_stage()
    for i in range(12):
        a = 2 * math.pi * i / 12
        color = (0.5 + 0.5 * math.cos(a), 0.5 + 0.5 * math.cos(a + 2), 0.5 + 0.5 * math.cos(a + 4))
        at = (2.2 * math.cos(a), 2.2 * math.sin(a), 1.2 + 0.1 * i)
        kit.lamp("POINT", at, energy=6.0 * (1 + i % 4), color=color, shadow_soft_size=0.15)


@case(samples=48)
def lamp_mixed(scene):
    """A hard point, a sun and an area lamp together, one of them without shadows."""
    kit.lamp_stage()
    kit.lamp("POINT", (-1.6, -1.2, 1.8), energy=60.0, color=(1, 0.6, 0.3), shadow_soft_size=0.0)
    kit.lamp("SUN", (2, -2, 3), energy=0.8, angle=0.1, color=(0.6, 0.8, 1.0))
    bare = kit.lamp("AREA", (0.5, 2.0, 2.5), size=0.7, energy=50.0)
    if hasattr(bare.data, "use_shadow"):
        bare.data.use_shadow = False


@case(samples=96, wheels=True)
def emissive_mesh(scene):
    """A ball and a panel that emit, as meshes."""
    kit.lamp_stage()
    glow = common.material("glow", "Emission", Color=(1.0, 0.8, 0.5), Strength=9.0)
    common.quad("panel", (-0.2, -1.0, 2.6), (-0.6, 0, 0), (0, 0.4, 0), glow)
    common.sphere(
        "bulb", (0.05, -0.9, 0.25), 0.16, common.material("bulb", "Emission", Color=(0.3, 0.6, 1), Strength=6.0), 24, 12
    )


@case()
def lamp_strength_nodes(scene):
    """A lamp whose own nodes set colour and strength."""
    kit.lamp_stage()
    lamp = kit.lamp("AREA", (1.2, -1.6, 2.4), size=1.0, energy=60.0)
    g = common.Graph(lamp.data, "ShaderNodeOutputLight")
    g.surface(g.node("Emission", {"Color": (0.4, 1.0, 0.6), "Strength": 2.0}))


@case(samples=96)
def lamp_visibility(scene):
    """A lamp hidden from diffuse rays and a block hidden from shadow and glossy rays."""
    kit.ball_stage(common.material("mirror", "BsdfGlossy", Color=(0.9, 0.9, 0.9), Roughness=0.15, distribution="GGX"))
    kit.lamp("AREA", (-1.6, -1.8, 2.6), size=1.0, energy=150.0).visible_diffuse = False
    block = common.box(
        "block", (0.25, 0.25, 0.25), kit.diffuse((0.2, 0.6, 0.2), name="block"), location=(0.5, -1.1, 0.25)
    )
    block.visible_shadow = block.visible_glossy = False
