# SPDX-License-Identifier: GPL-3.0-or-later
"""Render settings and visibility of objects."""

import bpy
import common
import kit
from kit import case


def _sheen_ball(roughness=0.05):
    return common.material("metal", kit.GLOSSY, Color=(0.9, 0.8, 0.6), Roughness=roughness)


@case(samples=64)
def clamps(scene):
    """Direct and indirect light clamped."""
    kit.ball_stage(_sheen_ball(0.3))
    kit.world()
    scene.cycles.caustics_reflective = True
    scene.cycles.sample_clamp_direct, scene.cycles.sample_clamp_indirect = 0.9, 0.25


@case(samples=64, wheels=True)
def blur_glossy(scene):
    """Filter Glossy with caustics on: reflections behind diffuse bounces are blurred."""
    kit.ball_stage(_sheen_ball(0.02))
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = True
    scene.cycles.blur_glossy = 1.0


@case(samples=64, wheels=True)
def caustics_by_kind(scene):
    """A glass and a metal ball with reflective caustics off and refractive ones on."""
    kit.world((0.6, 0.7, 0.9), 1.0)
    kit.camera()
    kit.floor()
    glass = common.material("glass", "BsdfGlass", Color=(0.9, 1.0, 0.9), Roughness=0.3, IOR=1.4, distribution="GGX")
    common.sphere("glass", (-0.75, 0, 0.6), 0.6, glass, 48, 24)
    common.sphere("metal", (0.75, 0, 0.6), 0.6, _sheen_ball(0.3), 48, 24)
    scene.cycles.caustics_reflective, scene.cycles.caustics_refractive = False, True


@case(samples=96)
def light_threshold(scene):
    """Light Threshold ends dim shadow rays by roulette: the picture is the same."""
    kit.lamp_stage()
    for i in range(6):
        kit.lamp("POINT", (-2.5 + i, -1.4, 2.0), energy=4.0, shadow_soft_size=0.1)
    scene.cycles.light_sampling_threshold = 0.05


@case(samples=96)
def fewest_bounces(scene):
    """Min Light and Transparent Bounces move where paths may end early: the picture is the same."""
    kit.lamp_stage()
    kit.lamp("AREA", (1.2, -1.6, 2.4), size=1.0, energy=110.0)
    scene.cycles.min_light_bounces = scene.cycles.min_transparent_bounces = 4


@case(samples=288, wheels=True)
def visible_by_kind(scene):
    """Blocks hidden from camera, diffuse, glossy, transmission and shadow rays, between a mirror and a glass ball."""
    kit.world((0.5, 0.55, 0.6), 1.0)
    kit.camera()
    kit.floor()
    kit.lamp("AREA", (1, -2, 3), size=2.0, energy=150.0)
    common.sphere("mirror", (-0.9, 0.4, 0.6), 0.6, _sheen_ball(0.3), 48, 24)
    glass = common.material("glass", "BsdfRefraction", Color=(0.9, 1, 0.9), Roughness=0.4, IOR=1.2, distribution="GGX")
    common.sphere("glass", (0.9, -0.6, 0.6), 0.6, glass, 48, 24)
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    kinds = ("camera", "diffuse", "glossy", "transmission", "shadow")
    for i, kind in enumerate(kinds):
        color = ((0.8, 0.1, 0.1), (0.1, 0.7, 0.1), (0.1, 0.2, 0.8), (0.8, 0.7, 0.1), (0.6, 0.1, 0.7))[i]
        block = common.box(
            kind, (0.2, 0.2, 0.4), kit.diffuse(color, name=kind), location=(-1.4 + 0.7 * i, -1.2 + 0.5 * (i % 3), 0.4)
        )
        setattr(block, "visible_" + kind, False)


@case(samples=64, wheels=True)
def terminator_default(scene):
    """A coarse smooth ball under a hard lamp: its faces do not show, as Blender's default offset wants it."""
    kit.lamp_stage()
    kit.lamp("POINT", (1.6, -0.6, 1.2), energy=60.0, shadow_soft_size=0.0)
    common.sphere("coarse", (-0.2, -1.2, 0.4), 0.4, kit.diffuse((0.6, 0.6, 0.6), name="coarse"), 12, 8)


@case(samples=64, wheels=True)
def terminator(scene):
    """Shadow terminator offsets on a coarse ball."""
    kit.lamp_stage()
    kit.lamp("POINT", (1.6, -0.6, 1.2), energy=60.0, shadow_soft_size=0.0)
    ball = common.sphere("coarse", (-0.2, -1.2, 0.4), 0.4, kit.diffuse((0.6, 0.6, 0.6), name="coarse"), 12, 8)
    if hasattr(ball, "shadow_terminator_geometry_offset"):
        ball.shadow_terminator_geometry_offset, ball.shadow_terminator_shading_offset = 0.3, 0.2
    else:
        ball.cycles.shadow_terminator_geometry_offset, ball.cycles.shadow_terminator_offset = 0.3, 0.2


@case(samples=64, wheels=True)
def holdout_object(scene):
    """A held out ball over a transparent film."""
    kit.lamp_stage()
    kit.world((0.5, 0.6, 0.8), 1.0)
    bpy.data.objects["ball"].is_holdout = True
    scene.render.film_transparent = True


@case(samples=768, wheels=True)
def glass_film(scene):
    """Transparent Glass on a transparent film, one ball clear and one rough."""
    kit.world((0.6, 0.7, 0.9), 1.0)
    kit.camera()
    for x, roughness in ((-0.75, 0.0), (0.75, 0.5)):
        glass = common.material(f"glass {x}", "BsdfGlass", Roughness=roughness, IOR=1.3, distribution="GGX")
        common.sphere(f"ball {x}", (x, 0, 0.7), 0.65, glass, 48, 24)
    scene.render.film_transparent = scene.cycles.film_transparent_glass = True
    scene.cycles.film_transparent_roughness = 0.2


def _fast_gi_stage(scene, method):
    kit.lamp_stage()
    kit.world((0.5, 0.6, 0.8), 1.0)
    kit.lamp("SUN", (2, -2, 3), energy=1.5, angle=0.2)
    scene.cycles.use_fast_gi, scene.cycles.fast_gi_method = True, method
    scene.cycles.ao_bounces_render = 1
    scene.world.light_settings.ao_factor, scene.world.light_settings.distance = 0.8, 0.6


@case(samples=64, wheels=True)
def fast_gi_replace(scene):
    """Fast GI in place of bounced light: after one bounce rays see what is near, and the sky beyond."""
    _fast_gi_stage(scene, "REPLACE")


@case(samples=48)
def gaussian_filter(scene):
    """A wide Gaussian pixel filter."""
    kit.lamp_stage()
    kit.world((0.5, 0.6, 0.8), 1.0)
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 4.0


@case(samples=64)
def bounces_by_kind(scene):
    """One glossy and two transmission bounces."""
    kit.world((0.6, 0.7, 0.9), 1.0)
    kit.camera()
    kit.floor(common.material("floor", kit.GLOSSY, Color=(0.8, 0.7, 0.6), Roughness=0.2))
    glass = common.material("glass", "BsdfGlass", Roughness=0.05, IOR=1.4, distribution="GGX")
    common.sphere("glass", (-0.75, 0, 0.7), 0.65, glass, 48, 24)
    common.sphere("metal", (0.75, 0, 0.6), 0.6, _sheen_ball(0.1), 48, 24)
    scene.cycles.glossy_bounces, scene.cycles.transmission_bounces = 1, 2
