# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input for the noise filter (inside a Blender of its own): settings at their limits, tiny and cropped pictures,
one sample, lights and values out of the ordinary. test_bad_filter.py says what must hold.

usage: blender -b --factory-startup --python cases_filter.py [-- case ...]
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
import scene_kit
from caustics_kit import ball, floor_scene, grey, lamp, metal
from scene_kit import CASES, add_square, emission, render, reset

METHODS = ("CLUSTERS", "THESIS", "CROSS_BILATERAL", "NONE")
LIMITS = {
    "smallest_size": {"filter_size": 1},
    "even_size": {"filter_size": 4},
    "odd_size": {"filter_size": 5},
    "largest_size": {"filter_size": 63},
    "no_sensitivity": {"luminance_sensitivity": 0.0},
    "most_sensitivity": {"luminance_sensitivity": 0.99},
    "no_removal": {"firefly_density": 0.0},
    "most_removal": {"firefly_density": 10.0},
    "no_layers": {"filter_direct": False, "filter_indirect": False, "filter_deep": False},
}


def lit_floor(*, samples: int = 4, width: int = 32, height: int = 24) -> bpy.types.Scene:
    """A lamp over a grey floor with a metal ball; filtered."""
    scene = floor_scene(samples)
    scene.render.resolution_x, scene.render.resolution_y = width, height
    ball("Metal", metal("Metal", 0.2))
    lamp("Lamp", radius=0.3)
    scene.cardioid.use_filter = True
    return scene


def rendered(name: str) -> dict:
    return render(Path(bpy.app.tempdir) / f"{name}.exr")


def off_and_on(name: str) -> dict:
    """The filtered picture, with the mean of the raw one as "raw"."""
    scene = bpy.context.scene
    scene.cardioid.use_filter = False
    raw = rendered(f"{name}_raw")
    scene.cardioid.use_filter = True
    return {**rendered(name), "raw": raw.get("mean")}


def register(name: str, build) -> None:
    CASES[name] = lambda: build(name)


def limit(method: str, settings: dict):
    def build(name: str) -> dict:
        scene = lit_floor()
        scene.cardioid.filter_method = method
        for key, value in settings.items():
            setattr(scene.cardioid, key, value)
        return off_and_on(name)

    return build


def size(width: int, height: int):
    def build(name: str) -> dict:
        lit_floor(width=width, height=height).cardioid.filter_size = 31
        return off_and_on(name)

    return build


def cropped(to_border: bool):
    def build(name: str) -> dict:
        scene = lit_floor()
        scene.render.use_border, scene.render.use_crop_to_border = True, to_border
        scene.render.border_min_x, scene.render.border_max_x = 0.1, 0.35
        scene.render.border_min_y, scene.render.border_max_y = 0.1, 0.95
        return off_and_on(name)

    return build


def one_sample(name: str) -> dict:
    lit_floor(samples=1)
    return off_and_on(name)


def nothing_to_see(name: str) -> dict:
    reset(samples=4).cardioid.use_filter = True
    return rendered(name)


def emission_alone(name: str) -> dict:
    """Seen directly it is in no layer: the filter must leave it alone."""
    reset(samples=2).cardioid.use_filter = True
    add_square().data.materials.append(emission("Glow"))
    return rendered(name)


def brightest_lamp(name: str) -> dict:
    lit_floor().objects["Lamp"].data.energy = 1e30
    return rendered(name)


def negative_lamp(name: str) -> dict:
    floor_scene(4).cardioid.use_filter = True
    lamp("Darkness", energy=-100, radius=0.3)
    return off_and_on(name)


def black_floor(name: str) -> dict:
    scene = lit_floor()
    material = grey("Black")
    diffuse = next(node for node in material.node_tree.nodes if "Color" in node.inputs)
    diffuse.inputs["Color"].default_value = (0, 0, 0, 1)
    scene.objects["Floor"].data.materials[0] = material
    return off_and_on(name)


def transparent_film(name: str) -> dict:
    scene = lit_floor()
    scene.render.film_transparent = True
    scene.objects["Floor"].scale = (0.3, 0.3, 1)
    return off_and_on(name)


for method in METHODS:
    for name, settings in LIMITS.items():
        register(f"{method.lower()}_{name}", limit(method, settings))
for width, height in ((1, 1), (2, 1), (1, 9), (3, 3), (9, 8)):
    register(f"size_{width}_{height}", size(width, height))
register("border", cropped(False))
register("border_cropped", cropped(True))
for build in (one_sample, nothing_to_see, emission_alone, brightest_lamp, negative_lamp, black_floor, transparent_film):
    register(build.__name__, build)

scene_kit.run_all(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
