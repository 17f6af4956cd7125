# SPDX-License-Identifier: GPL-3.0-or-later
"""What lamps and the world are seen by, and shader nodes on lamps."""

import math

import bpy
import common
import kit
from kit import case


def _mirror_stage():
    """A ball that reflects almost sharply and a rougher floor."""
    kit.ball_stage(common.material("mirror", kit.GLOSSY, Color=(0.9, 0.9, 0.9), Roughness=0.35), light=False)


@case(samples=128, wheels=True)
def lamps_in_mirrors(scene):
    """Three lamps that a mirror shows, one that glossy rays do not see, one without multiple importance."""
    _mirror_stage()
    kit.lamp("AREA", (-1.6, -1.8, 2.2), size=0.8, energy=60.0, color=(1, 0.5, 0.3))
    kit.lamp("POINT", (1.4, -1.5, 1.8), energy=40.0, shadow_soft_size=0.3, color=(0.3, 0.5, 1))
    kit.lamp("SUN", (0, -2, 2), energy=0.5, angle=math.radians(12), color=(0.4, 1, 0.5))
    kit.lamp("AREA", (0, -2.2, 3.0), size=0.8, energy=90.0).visible_glossy = False
    kit.lamp("AREA", (2.2, -1.0, 1.2), size=0.6, energy=20.0).data.cycles.use_multiple_importance_sampling = False


@case(samples=192, wheels=True)
def lamps_seen(scene):
    """Lamps that the camera sees: area, point, spot and sun; one of them hidden from diffuse rays."""
    kit.lamp_stage()
    kit.lamp("AREA", (-0.9, 1.2, 1.4), (0, -2, 1), size=0.7, energy=15.0, color=(1, 0.5, 0.3))
    kit.lamp("POINT", (0.9, 0.6, 1.5), energy=8.0, shadow_soft_size=0.2, color=(0.3, 0.5, 1))
    kit.lamp("SPOT", (0.1, -1.2, 1.0), (0.0, -5.0, 1.9), energy=6.0, shadow_soft_size=0.15, spot_size=2.0)
    kit.lamp("SUN", (0.6, 5.0, 1.05), (0, 0, 0.65), energy=0.3, angle=math.radians(6))
    for lamp in bpy.data.objects:
        lamp.visible_camera = True
    bpy.data.objects["lamp"].visible_diffuse = False


@case(samples=64, wheels=True)
def lamps_without_shadow(scene):
    """Lamps that cast no shadow: area, point, sun."""
    kit.lamp_stage()
    for lamp in (
        kit.lamp("AREA", (1.2, -1.6, 2.4), size=1.0, energy=60.0),
        kit.lamp("POINT", (-1.4, -1.3, 2.0), energy=40.0, shadow_soft_size=0.0, color=(1, 0.6, 0.3)),
        kit.lamp("SUN", (-2, -1, 3), energy=0.5, angle=0.1, color=(0.4, 0.6, 1)),
    ):
        if hasattr(lamp.data, "use_shadow") and bpy.app.version >= (4, 2):
            lamp.data.use_shadow = False
        else:
            lamp.data.cycles.cast_shadow = False


@case(samples=64)
def lamp_bounces(scene):
    """A lamp without size that gives direct light only, another one that bounces once."""
    kit.lamp_stage()
    common.quad("wall", (0, 1.4, 1.0), (3, 0, 0), (0, 0, 1.0), kit.diffuse((0.8, 0.8, 0.8), name="wall"))
    for place, bounces in (((1.2, -1.6, 2.4), 0), ((-1.2, -1.6, 2.4), 1)):
        lamp = kit.lamp("POINT", place, energy=60.0, shadow_soft_size=0.0)
        lamp.data.cycles.max_bounces = bounces


@case(samples=64)
def lamp_negative(scene):
    """A lamp that takes light away."""
    kit.lamp_stage()
    kit.lamp("SUN", (1, -2, 3), energy=2.0, angle=0.1)
    kit.lamp("AREA", (-1.2, -1.6, 1.4), size=0.5, energy=-12.0)


@case(wheels=True)
def lamp_portal(scene):
    """An area lamp as a portal: it gives no light of its own."""
    kit.lamp_stage()
    kit.world((0.4, 0.55, 0.8), 1.2)
    lamp = kit.lamp("AREA", (0.6, -1.6, 2.4), size=2.0, energy=100.0)
    lamp.data.cycles.is_portal = True


@case(samples=192, wheels=True)
def lamp_coordinates(scene):
    """Nodes of turned and scaled lamps see them in their own space: parametric place, normal, object, position."""
    kit.lamp_stage()
    area = kit.lamp("AREA", (1.2, -1.6, 2.4), shape="RECTANGLE", size=1.6, size_y=0.9, energy=110.0)
    area.rotation_euler.rotate_axis("Z", 0.6)
    g = common.Graph(area.data, "ShaderNodeOutputLight")
    place = g.node("NewGeometry").outputs["Parametric"]
    g.surface(g.node("Emission", {"Color": g.node("TexChecker", {"Vector": place, "Scale": 3.0}).outputs["Color"]}))
    point = kit.lamp("POINT", (-1.5, -1.4, 1.6), energy=60.0, shadow_soft_size=0.1)
    point.scale = (1.3, 0.8, 1.0)
    g = common.Graph(point.data, "ShaderNodeOutputLight")
    turned = g.node("VectorMath", {0: g.node("TexCoord").outputs["Normal"], 1: (1.2, 1.2, 1.2)}, operation="ADD")
    g.surface(g.node("Emission", {"Color": turned.outputs[0], "Strength": 0.7}))


@case(samples=64, wheels=True)
def lamp_projector(scene):
    """A spot that projects a checker by its parametric coordinates, and a point lamp with one."""
    kit.lamp_stage()
    spot = kit.lamp("SPOT", (1.6, -2.6, 2.6), energy=300.0, shadow_soft_size=0.0, spot_size=1.0, spot_blend=0.3)
    spot.rotation_euler.rotate_axis("Z", 0.4)
    point = kit.lamp("POINT", (-1.5, -1.4, 1.6), energy=60.0, shadow_soft_size=0.0)
    point.rotation_euler = (0.3, 0.2, 0.9)
    for lamp, scale in ((spot, 6.0), (point, 12.0)):
        g = common.Graph(lamp.data, "ShaderNodeOutputLight")
        place = g.node("NewGeometry").outputs["Parametric"]
        checker = g.node("TexChecker", {"Vector": place, "Scale": scale, "Color2": (0.1, 0.1, 0.1)})
        g.surface(g.node("Emission", {"Color": checker.outputs["Color"]}))


@case(samples=64, wheels=True)
def lamp_falloff(scene):
    """Light Falloff on lamps: constant, linear, smoothed."""
    kit.lamp_stage()
    for place, output, strength, kind in (
        ((1.2, -1.6, 2.4), "Constant", 0.15, "AREA"),
        ((-1.4, -1.4, 1.6), "Linear", 0.4, "POINT"),
        ((0.1, -2.0, 1.0), "Quadratic", 1.0, "POINT"),
    ):
        lamp = kit.lamp(kind, place, energy=30.0, **({"size": 1.0} if kind == "AREA" else {"shadow_soft_size": 0.1}))
        g = common.Graph(lamp.data, "ShaderNodeOutputLight")
        falloff = g.node("LightFalloff", {"Strength": strength, "Smooth": 1.5})
        g.surface(g.node("Emission", {"Strength": falloff.outputs[output]}))


@case(samples=64, wheels=True)
def world_seen_by(scene):
    """A sky that the camera and glossy rays do not see."""
    kit.ball_stage(common.material("mirror", kit.GLOSSY, Color=(0.9, 0.9, 0.9), Roughness=0.3), light=False)
    kit.world((0.5, 0.6, 0.8), 1.0)
    scene.world.cycles_visibility.camera = scene.world.cycles_visibility.glossy = False


@case(samples=192)
def emission_of_one_side(scene):
    """Meshes that emit on one side by Backfacing, sampled and not sampled as lamps."""
    kit.lamp_stage()
    for name, place, side in (("front", (-0.9, -1.2, 1.2), 0.35), ("back", (1.1, -1.2, 1.2), -0.35)):
        g = kit.graph(name)
        back = g.node("NewGeometry").outputs["Backfacing"]
        strength = g.node("Math", {0: 1.0, 1: back}, operation="SUBTRACT").outputs[0] if side > 0 else back
        power = g.node("Math", {0: strength, 1: 12.0}, operation="MULTIPLY").outputs[0]
        g.surface(g.node("Emission", {"Strength": power}))
        common.quad(name, place, (0.35, 0, 0), (0, 0.2, 0.3), g.owner)
    material = bpy.data.materials["back"]
    if hasattr(material.cycles, "emission_sampling"):
        material.cycles.emission_sampling = "NONE"
    else:
        material.cycles.sample_as_light = False
