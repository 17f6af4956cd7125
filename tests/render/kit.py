# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: the registry of cases and the stage that most of them share. Works in Blender 3.4 to 5.0."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy
import common
import numpy as np

SIZE = 96
GLOSSY = "BsdfGlossy" if hasattr(bpy.types, "ShaderNodeBsdfGlossy") else "BsdfAnisotropic"


@dataclass
class Case:
    """A scene of the suite. `wheels`: it is also rendered by the bpy wheels, where Blender changed since 3.4."""

    name: str
    build: Callable[[bpy.types.Scene], None]
    samples: int
    wheels: bool
    since: tuple[int, int]


CASES: dict[str, Case] = {}


def case(samples: int = 32, wheels: bool = False, since: tuple[int, int] = (3, 4)):
    """Registers a function that fills an empty scene. Its docstring says what it tests."""

    def register(build: Callable[[bpy.types.Scene], None]):
        CASES[build.__name__] = Case(build.__name__, build, samples, wheels, since)
        return build

    return register


def start(samples: int) -> bpy.types.Scene:
    """An empty scene with the settings of every comparison: nothing clamped, blurred or cut short in either engine."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    render = scene.render
    render.resolution_x = render.resolution_y = SIZE
    render.resolution_percentage = 100
    render.dither_intensity = 0.0
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGBA"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"
    cycles = scene.cycles
    cycles.samples = samples
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = 8
    cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = cycles.transparent_max_bounces = 8
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.blur_glossy = 0.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    if bpy.app.version < (3, 5):
        cycles.sampling_pattern = "SOBOL"
    else:
        cycles.sampling_pattern = "TABULATED_SOBOL"
        cycles.use_light_tree = False
        cycles.use_guiding = False
    return scene


def diffuse(color=(0.5, 0.5, 0.5), roughness: float = 0.0, name: str = "diffuse") -> bpy.types.Material:
    return common.material(name, "BsdfDiffuse", Color=color, Roughness=roughness)


def camera(location=(0, -5, 1.9), target=(0, 0, 0.65), lens: float = 50.0) -> bpy.types.Object:
    return common.camera(location, target, lens)


def floor(material=None, half: float = 4.0) -> bpy.types.Object:
    return common.quad(
        "floor", (0, 0, 0), (half, 0, 0), (0, half, 0), material or diffuse((0.55, 0.5, 0.45), name="floor")
    )


def lamp(kind: str, location, target=(0, 0, 0.5), color=(1, 1, 1), **settings) -> bpy.types.Object:
    data = bpy.data.lights.new("lamp", kind)
    data.color = color
    for name, value in settings.items():
        setattr(data, name, value)
    return common.aim(common.add(data, "lamp", location), target)


def world(color=(0, 0, 0), strength: float = 1.0) -> None:
    common.world(color, strength)


def lamp_stage() -> None:
    """Things that cast and catch shadows, in the dark: each lamp case adds its lamp."""
    world()
    camera()
    floor()
    common.sphere("ball", (0.55, 0.1, 0.5), 0.5, diffuse((0.7, 0.25, 0.15), name="ball"), 48, 24)
    common.box(
        "box",
        (0.35, 0.35, 0.6),
        diffuse((0.2, 0.35, 0.7), name="box"),
        location=(-0.65, 0.2, 0.6),
        rotation=(0, 0, 0.5),
    )


def ball_stage(material: bpy.types.Material, light: bool = True) -> bpy.types.Object:
    """A ball of the material under a wide lamp and a dim sky, two coloured blocks beside it."""
    world((0.35, 0.42, 0.55), 0.5)
    camera()
    floor()
    common.box("left", (0.15, 0.4, 0.5), diffuse((0.75, 0.2, 0.1), name="left"), location=(-1.25, 0.3, 0.5))
    common.box("right", (0.15, 0.4, 0.5), diffuse((0.1, 0.3, 0.7), name="right"), location=(1.25, 0.3, 0.5))
    if light:
        lamp("AREA", (1.5, -2.0, 3.2), size=2.0, energy=220.0, color=(1.0, 0.9, 0.75))
    return common.sphere("ball", (0, 0, 0.8), 0.8, material, 64, 32)


def card_stage(material: bpy.types.Material) -> bpy.types.Object:
    """An upright card two metres wide that fills the picture, UVs from 0 to 2, under a soft lamp."""
    world((0.4, 0.4, 0.4), 0.5)
    camera((0, -5.2, 1), (0, 0, 1), 90)
    lamp("AREA", (1.2, -2.5, 2.6), (0, 0, 1), size=1.5, energy=160.0)
    return common.quad("card", (0, 0, 1), (1, 0, 0), (0, 0, 1), material)


def image(name: str, pixels: np.ndarray, colorspace: str = "sRGB", is_float: bool = False) -> bpy.types.Image:
    """A packed image from (h, w, 4) values, bottom row first."""
    h, w = pixels.shape[:2]
    data = bpy.data.images.new(name, w, h, alpha=True, float_buffer=is_float)
    data.colorspace_settings.name = colorspace
    data.pixels.foreach_set(np.ascontiguousarray(pixels, dtype=np.float32).ravel())
    data.update()
    data.pack()
    return data


def picture(size: int = 32) -> np.ndarray:
    """A colourful picture without symmetry, so that a turned or mirrored texture shows."""
    v, u = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 4))
    out[..., 0] = 0.15 + 0.8 * u
    out[..., 1] = 0.15 + 0.7 * v * (1 - u)
    out[..., 2] = np.where((u > 0.5) & (v > 0.5), 0.9, 0.2)
    return out


def graph(name: str) -> common.Graph:
    return common.Graph(bpy.data.materials.new(name))


def first(node, *names: str):
    """A node's input under the first of several names that it has: sockets were renamed between versions."""
    return next(node.inputs[n] for n in names if n in node.inputs)


def principled(name: str = "principled", **values) -> bpy.types.Material:
    """A Principled BSDF by the names of Blender 4 and later; in 3.4 they become the old ones."""
    old = {"Specular_IOR_Level": "Specular", "Coat_Weight": "Clearcoat", "Coat_Roughness": "Clearcoat Roughness"}
    old |= {"Transmission_Weight": "Transmission", "Emission_Color": "Emission"}
    g = graph(name)
    node = g.node("BsdfPrincipled")
    for key, value in values.items():
        g.feed(first(node, key.replace("_", " "), old.get(key, key)), value)
    return g.surface(node)


def ball(kind: str, **inputs) -> None:
    """The ball stage with a ball of one BSDF node."""
    ball_stage(common.material("ball", kind, **inputs))


def bare_sky() -> None:
    """Swaps the ball stage's lamp for a bright sky, so that mirror and glass throw no caustics with fireflies."""
    bpy.data.objects.remove(bpy.data.objects["lamp"])
    world((0.6, 0.7, 0.9), 1.0)


def card(color, g: common.Graph, normal=None) -> None:
    """The card stage with a diffuse card of this colour and normal."""
    card_stage(g.surface(g.node("BsdfDiffuse", {"Color": color} | ({} if normal is None else {"Normal": normal}))))


def light_stage() -> None:
    """Floor, camera, a lamp and a dim sky for cases that bring their own objects."""
    world((0.4, 0.45, 0.5), 0.6)
    camera()
    floor()
    lamp("AREA", (1.5, -2.0, 3.0), size=1.0, energy=160.0)


def linear_name() -> str:
    """What this Blender calls scene-linear Rec.709."""
    names = bpy.types.ColorManagedInputColorspaceSettings.bl_rna.properties["name"].enum_items.keys()
    return next((n for n in ("Linear Rec.709", "Linear") if n in names), "Non-Color")


def sky_image(height: int = 32) -> bpy.types.Image:
    """An equirectangular sky with a small, bright sun, as floats."""
    v = np.mgrid[0:height, 0 : 2 * height][0]
    up = np.sin(np.pi * ((v + 0.5) / height - 0.5))[..., None]
    pixels = np.where(up > 0, (0.25, 0.4, 0.8) * (0.6 + 0.4 * up), (0.2, 0.15, 0.1)) + 0.0
    pixels[height * 3 // 4 - 1 : height * 3 // 4 + 1, height // 2 : height // 2 + 2] = (25, 21, 15)
    return image("sky", np.concatenate([pixels, np.ones((height, 2 * height, 1))], -1), linear_name(), True)
