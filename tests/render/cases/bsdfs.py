# SPDX-License-Identifier: GPL-3.0-or-later
"""Each BSDF on a ball, and the Principled BSDF's parts (version 1 in Blender 3.4, version 2 in the wheels)."""

import common
import kit
from kit import case


@case(wheels=True)
def diffuse(scene):
    """Lambert."""
    kit.ball("BsdfDiffuse", Color=(0.7, 0.4, 0.2), Roughness=0.0)


@case(wheels=True)
def diffuse_rough(scene):
    """Oren-Nayar."""
    kit.ball("BsdfDiffuse", Color=(0.7, 0.4, 0.2), Roughness=0.8)


@case()
def glossy_sharp(scene):
    """A perfect mirror, reflective caustics on."""
    scene.cycles.caustics_reflective = True
    kit.ball_stage(common.material("ball", "BsdfGlossy", Color=(0.9, 0.85, 0.8), Roughness=0.0, distribution="SHARP"))
    kit.bare_sky()


@case(samples=96, wheels=True)
def glossy_ggx(scene):
    """GGX, roughness 0.3."""
    kit.ball(kit.GLOSSY, Color=(0.9, 0.7, 0.4), Roughness=0.3, distribution="GGX")


@case()
def glossy_beckmann(scene):
    """Beckmann, roughness 0.4."""
    kit.ball(kit.GLOSSY, Color=(0.9, 0.7, 0.4), Roughness=0.4, distribution="BECKMANN")


@case(wheels=True)
def glossy_multi_ggx(scene):
    """GGX with multiple scattering, very rough."""
    kit.ball(kit.GLOSSY, Color=(0.9, 0.7, 0.4), Roughness=0.8, distribution="MULTI_GGX")


@case(samples=48)
def glass_sharp(scene):
    """Clear glass under a sky; its shadow is dark, as caustics are off."""
    kit.ball_stage(
        common.material("ball", "BsdfGlass", Color=(0.95, 1, 0.97), Roughness=0.0, IOR=1.45, distribution="SHARP")
    )
    kit.bare_sky()


@case(samples=384, wheels=True)
def glass_rough(scene):
    """Rough glass, GGX."""
    kit.ball("BsdfGlass", Color=(0.95, 1, 0.97), Roughness=0.35, IOR=1.45, distribution="GGX")


@case(samples=96, wheels=True)
def refraction(scene):
    """Refraction without reflection, slightly rough."""
    kit.ball("BsdfRefraction", Color=(1, 0.9, 0.8), Roughness=0.2, IOR=1.3, distribution="GGX")


@case(samples=96, wheels=True)
def translucent(scene):
    """A translucent ball with the lamp behind it."""
    kit.ball_stage(common.material("ball", "BsdfTranslucent", Color=(0.7, 0.6, 0.3)), light=False)
    kit.lamp("AREA", (0.5, 2.5, 2.5), size=1.2, energy=180.0)


@case(wheels=True)
def transparent(scene):
    """A half-transparent mix: light and shadow pass through it, tinted."""
    g = kit.graph("ball")
    clear = g.node("BsdfTransparent", {"Color": (0.9, 0.5, 0.3)})
    solid = g.node("BsdfDiffuse", {"Color": (0.2, 0.5, 0.7)})
    kit.ball_stage(g.surface(g.node("MixShader", {0: 0.4, 1: clear.outputs[0], 2: solid.outputs[0]})))


@case()
def add_shader(scene):
    """Diffuse and glossy added."""
    g = kit.graph("ball")
    a = g.node("BsdfDiffuse", {"Color": (0.3, 0.1, 0.1)})
    b = g.node("BsdfGlossy", {"Color": (0.2, 0.25, 0.3), "Roughness": 0.25}, distribution="GGX")
    kit.ball_stage(g.surface(g.node("AddShader", {0: a.outputs[0], 1: b.outputs[0]})))


@case()
def fresnel_mix(scene):
    """Diffuse under glossy by Fresnel, and by Layer Weight's facing."""
    g = kit.graph("ball")
    facing = g.node("LayerWeight", {"Blend": 0.4}).outputs["Facing"]
    a = g.node("BsdfDiffuse", {"Color": g.mix_color(facing, (0.1, 0.3, 0.6), (0.8, 0.7, 0.2))})
    b = g.node("BsdfGlossy", {"Color": (0.9, 0.9, 0.9), "Roughness": 0.2}, distribution="GGX")
    fresnel = g.node("Fresnel", {"IOR": 1.6}).outputs["Fac"]
    kit.ball_stage(g.surface(g.node("MixShader", {0: fresnel, 1: a.outputs[0], 2: b.outputs[0]})))


@case()
def background_light_path(scene):
    """A material that is another colour for camera rays than for the light that it bounces."""
    g = kit.graph("ball")
    seen = g.node("LightPath").outputs["Is Camera Ray"]
    kit.ball_stage(g.surface(g.node("BsdfDiffuse", {"Color": g.mix_color(seen, (0.9, 0.1, 0.1), (0.1, 0.8, 0.2))})))


@case(wheels=True)
def principled_default(scene):
    """The default Principled BSDF."""
    kit.ball_stage(kit.principled())


@case(wheels=True)
def principled_plastic(scene):
    """Coloured plastic with a clear highlight."""
    kit.ball_stage(kit.principled(Base_Color=(0.6, 0.08, 0.05), Roughness=0.25, Specular_IOR_Level=0.6))


@case(samples=96, wheels=True)
def principled_metal(scene):
    """Metal, roughness 0.35."""
    kit.ball_stage(kit.principled(Base_Color=(0.9, 0.65, 0.3), Metallic=1.0, Roughness=0.35))


@case(wheels=True)
def principled_half_metal(scene):
    """Half metallic."""
    kit.ball_stage(kit.principled(Base_Color=(0.3, 0.5, 0.7), Metallic=0.5, Roughness=0.45))


@case(wheels=True)
def principled_coat(scene):
    """A clear coat over a dark base."""
    kit.ball_stage(kit.principled(Base_Color=(0.05, 0.1, 0.3), Roughness=0.6, Coat_Weight=1.0, Coat_Roughness=0.15))


@case(samples=384, wheels=True)
def principled_glass(scene):
    """Transmission, rough."""
    kit.ball_stage(kit.principled(Base_Color=(0.9, 0.95, 1.0), Roughness=0.3, Transmission_Weight=1.0, IOR=1.45))


@case(wheels=True)
def principled_alpha(scene):
    """Alpha 0.4."""
    kit.ball_stage(kit.principled(Base_Color=(0.7, 0.3, 0.1), Roughness=0.5, Alpha=0.4))


@case(wheels=True)
def principled_emission(scene):
    """A Principled BSDF that also emits."""
    kit.ball_stage(kit.principled(Base_Color=(0.4, 0.4, 0.4), Emission_Color=(0.2, 0.6, 1.0), Emission_Strength=1.5))
