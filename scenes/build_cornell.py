# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds cornell.blend: a Cornell box with a glass and a chrome sphere under a bright panel.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_cornell.py [-- OUT.blend]
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import common as c  # noqa: E402

WHITE, RED, GREEN = (0.76, 0.74, 0.69), (0.60, 0.052, 0.040), (0.105, 0.42, 0.115)


def frame(surface) -> None:
    """The box's shell seen from the front: four bevelled bars around the opening."""
    t = 0.05
    for name, half, at in (  # in front of the walls: coplanar faces would belong to either by chance
        ("frame_left", (t, t, 1.0 + 2 * t), (-1 - t, -1 - t, 1)),
        ("frame_right", (t, t, 1.0 + 2 * t), (1 + t, -1 - t, 1)),
        ("frame_top", (1.0, t, t), (0, -1 - t, 2 + t)),
        ("frame_bottom", (1.0, t, t), (0, -1 - t, -t)),
    ):
        c.box(name, half, surface, bevel=0.012, location=at)


def build() -> None:
    scene = c.start(1024, 1024)
    white = c.material("white", "BsdfDiffuse", Color=WHITE)
    red = c.material("red", "BsdfDiffuse", Color=RED)
    green = c.material("green", "BsdfDiffuse", Color=GREEN)
    c.quad("floor", (0, 0, 0), (1, 0, 0), (0, 1, 0), white)
    c.quad("ceiling", (0, 0, 2), (-1, 0, 0), (0, 1, 0), white)
    c.quad("back", (0, 1, 1), (-1, 0, 0), (0, 0, 1), white).data.flip_normals()
    c.quad("left", (-1, 0, 1), (0, 1, 0), (0, 0, 1), red)
    c.quad("right", (1, 0, 1), (0, -1, 0), (0, 0, 1), green)
    frame(c.material("frame", "BsdfPrincipled", Base_Color=(0.10, 0.10, 0.11), Roughness=0.3))
    c.quad(
        "panel",
        (0, 0.05, 1.985),
        (-0.26, 0, 0),
        (0, 0.26, 0),
        c.material("panel", "Emission", Color=(1.0, 0.83, 0.62), Strength=17.0),
    )
    trim = c.material("trim", "BsdfDiffuse", Color=(0.30, 0.29, 0.28))
    for name, half, at in (  # in front of the walls: coplanar faces would belong to either by chance
        ("trim_n", (0.29, 0.015, 0.012), (0, 0.325, 1.988)),
        ("trim_s", (0.29, 0.015, 0.012), (0, -0.225, 1.988)),
        ("trim_w", (0.015, 0.26, 0.012), (-0.275, 0.05, 1.988)),
        ("trim_e", (0.015, 0.26, 0.012), (0.275, 0.05, 1.988)),
    ):
        c.box(name, half, trim, bevel=0.003, location=at)
    c.sphere(
        "chrome",
        (-0.44, 0.30, 0.42),
        0.42,
        c.material("chrome", "BsdfGlossy", Color=(0.92, 0.92, 0.93), Roughness=0.0, distribution="SHARP"),
    )
    c.sphere(
        "glass",
        (0.40, -0.32, 0.36),
        0.36,
        c.material("glass", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=1.5, distribution="SHARP"),
    )
    c.world((0.55, 0.66, 0.85), 0.02)
    c.camera((0, -4.9, 1.02), (0, 0, 0.99), 62, focus=(0.2, -0.45, 0.5), fstop=4.0)
    scene.view_settings.exposure = 0.7
    c.save(c.output_path(os.path.join(HERE, "cornell.blend")))


build()
