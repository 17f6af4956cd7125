# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures and the nodes that shape them, on an upright card."""

import kit
import numpy as np
from kit import case


@case(wheels=True)
def image_texture(scene):
    """A packed sRGB image by UVs, linear interpolation."""
    g = kit.graph("card")
    kit.card(g.node("TexImage", image=kit.image("picture", kit.picture())).outputs["Color"], g)


@case(samples=96)
def image_mapping(scene):
    """A Non-Color image, nearest, clipped, under a Mapping node that scales, turns and moves."""
    g = kit.graph("card")
    uv = g.node("TexCoord").outputs["UV"]
    at = g.node("Mapping", {"Vector": uv, "Location": (0.1, 0.3, 0), "Rotation": (0, 0, 0.4), "Scale": (0.7, 0.9, 1)})
    picture = kit.image("data", kit.picture(16), "Non-Color")
    node = g.node("TexImage", {"Vector": at.outputs[0]}, image=picture, interpolation="Closest", extension="CLIP")
    kit.card(node.outputs["Color"], g)


@case()
def image_alpha(scene):
    """Alpha of an image cuts holes into a card with a block behind it."""
    pixels = kit.picture()
    v, u = np.mgrid[0:32, 0:32] / 32
    pixels[..., 3] = (u - 0.5) ** 2 + (v - 0.5) ** 2 < 0.12
    g = kit.graph("card")
    node = g.node("TexImage", image=kit.image("holes", pixels))
    solid = g.node("BsdfDiffuse", {"Color": node.outputs["Color"]})
    mix = g.node("MixShader", {0: node.outputs["Alpha"], 1: g.node("BsdfTransparent").outputs[0], 2: solid.outputs[0]})
    kit.card_stage(g.surface(mix))
    kit.common.box("block", (0.8, 0.1, 0.8), kit.diffuse((0.1, 0.6, 0.2)), location=(0, 0.6, 1))


@case()
def noise(scene):
    """Noise texture with detail, roughness and distortion, through a Color Ramp."""
    g = kit.graph("card")
    at = g.node("TexCoord").outputs["Object"]
    value = g.node("TexNoise", {"Vector": at, "Scale": 4.0, "Detail": 3.5, "Roughness": 0.6, "Distortion": 0.7})
    color = g.ramp(value.outputs["Fac"], [(0.3, (0.1, 0.2, 0.5)), (0.5, (0.8, 0.6, 0.2)), (0.7, (0.9, 0.9, 0.9))])
    kit.card(color, g)


@case()
def noise_color(scene):
    """The Noise texture's colour output, on Generated coordinates."""
    g = kit.graph("card")
    at = g.node("TexCoord").outputs["Generated"]
    kit.card(g.node("TexNoise", {"Vector": at, "Scale": 6.0, "Detail": 0.0}).outputs["Color"], g)


@case()
def checker(scene):
    """Checker texture."""
    g = kit.graph("card")
    uv = g.node("UVMap").outputs["UV"]
    kit.card(
        g.node(
            "TexChecker", {"Vector": uv, "Color1": (0.8, 0.2, 0.1), "Color2": (0.1, 0.3, 0.7), "Scale": 3.3}
        ).outputs["Color"],
        g,
    )


@case()
def brick(scene):
    """Brick texture with offset, squash and mortar smoothing."""
    g = kit.graph("card")
    uv = g.node("TexCoord").outputs["UV"]
    values = {
        "Vector": uv,
        "Color1": (0.6, 0.2, 0.1),
        "Color2": (0.3, 0.1, 0.08),
        "Mortar": (0.6, 0.6, 0.55),
        "Scale": 3.0,
    }
    values |= {"Mortar Size": 0.03, "Mortar Smooth": 0.3, "Bias": 0.1, "Brick Width": 0.6, "Row Height": 0.25}
    kit.card(g.node("TexBrick", values, offset=0.4, squash=0.7, squash_frequency=3).outputs["Color"], g)


@case()
def gradients(scene):
    """Linear, spherical and radial gradients in the three channels."""
    g = kit.graph("card")
    at = g.node("TexCoord").outputs["Object"]
    moved = g.node("Mapping", {"Vector": at, "Location": (0.1, 0.3, -0.9)}).outputs["Vector"]
    channels = [
        g.node("TexGradient", {"Vector": moved}, gradient_type=kind).outputs["Fac"]
        for kind in ("LINEAR", "SPHERICAL", "RADIAL")
    ]
    node = g.node("CombineColor")
    for socket, value in zip(node.inputs, channels):
        g.feed(socket, value)
    kit.card(node.outputs["Color"], g)


@case(wheels=True)
def bump(scene):
    """Bump from a noise height."""
    g = kit.graph("card")
    at = g.node("TexCoord").outputs["Object"]
    height = g.node("TexNoise", {"Vector": at, "Scale": 3.0, "Detail": 1.0}).outputs["Fac"]
    normal = g.node("Bump", {"Height": height, "Strength": 0.8, "Distance": 0.3}).outputs["Normal"]
    kit.card((0.7, 0.7, 0.7), g, normal)


@case(wheels=True)
def displacement_bump(scene):
    """Displacement as bump, so strong that waves turn away from the view, under diffuse and glossy."""
    g = kit.graph("ball")
    at = g.node("TexCoord").outputs["Generated"]
    height = g.node("TexWave", {"Vector": at, "Scale": 1.5}).outputs["Fac"]
    moved = g.node("Displacement", {"Height": height, "Midlevel": 0.0, "Scale": 0.6}).outputs["Displacement"]
    g.tree.links.new(moved, g.output.inputs["Displacement"])
    diffuse = g.node("BsdfDiffuse", {"Color": (0.8, 0.4, 0.2, 1.0)})
    glossy = g.node("BsdfGlossy", {"Color": (0.8, 0.4, 0.2, 1.0), "Roughness": 0.3})
    mixed = g.node("MixShader", {0: 0.4, 1: diffuse.outputs[0], 2: glossy.outputs[0]})
    kit.ball_stage(g.surface(mixed))


@case(wheels=True)
def normal_map(scene):
    """A tangent-space normal map of smooth bumps, strength 0.7."""
    v, u = np.mgrid[0:64, 0:64] / 64 * 4 * np.pi
    x, y = 0.5 * np.cos(u) * np.sin(v), 0.5 * np.sin(u) * np.cos(v)
    z = np.sqrt(1 - x * x - y * y)
    pixels = np.stack([x * 0.5 + 0.5, y * 0.5 + 0.5, z * 0.5 + 0.5, np.ones_like(x)], -1)
    g = kit.graph("card")
    node = g.node("TexImage", image=kit.image("normals", pixels, "Non-Color"))
    normal = g.node("NormalMap", {"Strength": 0.7, "Color": node.outputs["Color"]}).outputs["Normal"]
    kit.card((0.7, 0.7, 0.7), g, normal)


@case()
def colour_nodes(scene):
    """Hue/Saturation, Separate/Combine, Math, Vector Math and several Mix blend types in a row."""
    g = kit.graph("card")
    uv = g.node("TexCoord").outputs["UV"]
    base = g.node("TexImage", {"Vector": uv}, image=kit.image("picture", kit.picture())).outputs["Color"]
    shifted = g.node(
        "HueSaturation", {"Hue": 0.62, "Saturation": 1.2, "Value": 0.9, "Fac": 0.8, "Color": base}
    ).outputs["Color"]
    parts = g.node("SeparateXYZ", {"Vector": uv})
    wave = g.math("MULTIPLY_ADD", g.math("SINE", g.math("MULTIPLY", parts.outputs["X"], 9.0)), 0.4, 0.5)
    overlay = g.mix_color(0.7, shifted, g.vector_math("FRACTION", g.vector_math("SCALE", uv)), "OVERLAY")
    screen = g.mix_color(wave, overlay, (0.3, 0.2, 0.6), "SCREEN")
    kit.card(g.mix_color(0.5, screen, (0.9, 0.7, 0.5), "MULTIPLY"), g)


@case()
def geometry_node(scene):
    """Geometry node: position and normal as colours, backfacing on the far side."""
    g = kit.graph("ball")
    node = g.node("NewGeometry")
    color = g.vector_math("MULTIPLY_ADD", node.outputs["Normal"], (0.3, 0.3, 0.3), (0.4, 0.4, 0.4))
    shaded = g.mix_color(0.4, color, g.vector_math("FRACTION", node.outputs["Position"]))
    kit.ball_stage(g.surface(g.node("BsdfDiffuse", {"Color": shaded})))


@case(samples=96)
def roughness_texture(scene):
    """Roughness of a glossy floor from a checker, Generated coordinates on a ball."""
    g = kit.graph("ball")
    at = g.node("TexCoord").outputs["Generated"]
    rough = g.node("TexChecker", {"Vector": at, "Scale": 5.0}).outputs["Fac"]
    value = g.math("MULTIPLY_ADD", rough, 0.4, 0.2)
    kit.ball_stage(g.surface(g.node("BsdfGlossy", {"Color": (0.8, 0.8, 0.8), "Roughness": value}, distribution="GGX")))
