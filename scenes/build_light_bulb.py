# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds light_bulb.blend: a clear bulb over a desk; all light leaves a glowing filament through the bulb's glass.

blender -b --factory-startup --python-exit-code 1 -P scenes/build_light_bulb.py [-- OUT.blend]
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import common as c  # noqa: E402
import numpy as np  # noqa: E402
import surfaces  # noqa: E402
import turned  # noqa: E402
import vessels  # noqa: E402

BULB = (0.060, 0.02, 0.190)
"""Where the lowest point of the bulb hangs, in metres."""


def bulb(glass) -> list[bpy.types.Object]:
    """An A60 bulb, cap upwards, from its tip at the origin: envelope, glass mount, wires, filament, brass cap."""
    shape = [(0.0, 0.0), (0.012, 0.0022), (0.0235, 0.0105), (0.0298, 0.0270), (0.0285, 0.0420)]
    shape += [(0.0215, 0.0610), (0.0152, 0.0760), (0.0132, 0.0920)]
    outside = turned.curve(shape, 3)
    inside = turned.offset(outside, 0.0007)
    inside[0] = (0.0, 0.0007)
    parts = [turned.turn("envelope", np.concatenate([outside, inside[::-1]]), glass)]
    mount = [(0.0, 0.0475), (0.0022, 0.0480), (0.0026, 0.0510), (0.0017, 0.0545), (0.0022, 0.070), (0.0080, 0.0900)]
    parts.append(turned.turn("mount", [*mount, (0.0, 0.0905)], glass, segments=20))
    steel = c.material("wire", "BsdfPrincipled", Base_Color=(0.55, 0.53, 0.50), Metallic=1.0, Roughness=0.25)
    for side in (-1, 1):
        wire = turned.curve([(side * 0.0020, 0, 0.0540), (side * 0.0065, 0, 0.0420), (side * 0.0130, 0, 0.0345)], 6)
        parts.append(turned.tube(f"wire_{side}", wire, 0.00035, steel, 8))
    parts.append(turned.tube("support", [(0, 0, 0.0480), (0, 0, 0.0300)], 0.00018, steel, 6))
    brass = c.material("brass", "BsdfPrincipled", Base_Color=(0.86, 0.63, 0.28), Metallic=1.0, Roughness=0.22)
    screw = [(0.0135 + 0.0006 * math.sin(2 * math.pi * k / 4), 0.0835 + 0.0009 * k) for k in range(25)]
    parts.append(turned.turn("cap", [(0.0, 0.0833), *screw, (0.009, 0.1085), (0.0, 0.1090)], brass))
    return [*parts, filament()]


def filament() -> bpy.types.Object:
    """A coil of 34 turns on an arc between the wires."""
    t = np.linspace(0, 1, 34 * 10 + 1)
    angle = 2 * np.pi * 34 * t
    x, sag = 0.013 * (2 * t - 1), 0.0045 * (1 - (2 * t - 1) ** 2)
    path = np.stack([x, 0.00065 * np.cos(angle), 0.0345 - sag + 0.00065 * np.sin(angle)], -1)
    g = c.Graph(bpy.data.materials.new("glowing tungsten"))
    color = g.node("Blackbody", {"Temperature": 3300.0}).outputs["Color"]
    return turned.tube(
        "filament", path, 0.00014, g.surface(g.node("Emission", {"Color": color, "Strength": 9000.0})), 6
    )


def pendant(glass) -> None:
    """The bulb in its porcelain socket on a textile cord."""
    x, y, z = BULB
    pose = c.add(None, "pendant", BULB, (0, 0, math.radians(24)))
    for part in bulb(glass):
        part.parent = pose
    porcelain = c.material("porcelain", "BsdfPrincipled", Base_Color=(0.045, 0.042, 0.040), Roughness=0.25)
    socket = [
        (0.0150, 0.0915),
        (0.0185, 0.0905),
        (0.0205, 0.0930),
        (0.0205, 0.1250),
        (0.0170, 0.1370),
        (0.0065, 0.1450),
    ]
    holder = turned.turn("socket", [*socket, (0.0, 0.1455), (0.0, 0.1100), (0.0150, 0.1095)], porcelain)
    holder.parent = pose
    cord = c.material("cord", "BsdfPrincipled", Base_Color=(0.30, 0.045, 0.030), Roughness=0.9)
    turned.tube(
        "cord", turned.curve([(x, y, z + 0.145), (x - 0.001, y, z + 0.3), (x - 0.004, y, z + 0.6)], 8), 0.0031, cord
    )


def tumbler(glass, at) -> None:
    """A glass of water with a thick bottom."""
    outside = turned.curve([(0.0, 0.0006), (0.026, 0.0004), (0.0305, 0.0020), (0.0320, 0.0080), (0.0375, 0.0960)], 3)
    inside = turned.curve([(0.0, 0.0120), (0.024, 0.0125), (0.0292, 0.0170), (0.0354, 0.0960)], 3)
    rim = [(0.0372, 0.0972), (0.0365, 0.0976), (0.0357, 0.0972)]
    turned.turn("tumbler", np.concatenate([outside, rim, inside[::-1]]), glass, location=at)
    water = vessels.clear("water", 1.333)
    vessels.drink("water", inside, 0.064, water, 0.0004, location=at)


def magnifier(glass, at, turn: float) -> None:
    """A reading glass that leans on the books, over the paper."""
    pose = c.add(None, "magnifier", at, (math.radians(17), math.radians(-6), turn))
    brass = bpy.data.materials["brass"]
    bow = [(0.0, -0.0055), (0.014, -0.0046), (0.027, -0.0021), (0.0352, 0.0), (0.027, 0.0021), (0.014, 0.0046)]
    lens = turned.turn("lens", [*bow, (0.0, 0.0055)], glass, segments=48)
    ring = [(0.0362 + 0.0019 * math.cos(a), 0.0032 * math.sin(a)) for a in np.arange(10) * math.pi / 5]
    handle = c.material("ebony", "BsdfPrincipled", Base_Color=(0.018, 0.012, 0.009), Roughness=0.3)
    path, width = np.linspace((0, -0.040, 0), (0, -0.135, 0), 9), [4.0, 4.4, 4.2, 4.8, 5.6, 6.2, 6.4, 6.0, 3.8]
    grip = turned.subdivide(turned.tube("grip", path, 0.001 * np.array(width), handle, 12), 2)
    for part in (lens, turned.turn("bow", ring, brass, segments=48, closed=True), grip):
        part.parent = pose


def books() -> None:
    """Two cloth-bound books, their pages a little inside the covers."""
    pages = c.material("pages", "BsdfDiffuse", Color=(0.68, 0.62, 0.50))
    for i, (color, half, z, turn) in enumerate(
        (
            ((0.030, 0.095, 0.105), (0.110, 0.075, 0.0160), 0.0, 9),
            ((0.260, 0.060, 0.030), (0.098, 0.066, 0.0125), 0.0325, -4),
        )
    ):
        cover = c.material(f"book cloth {i}", "BsdfPrincipled", Base_Color=color, Roughness=0.75)
        pose = c.add(None, f"book_{i}", (-0.165, 0.105, z + half[2]), (0, 0, math.radians(turn)))
        w, d, h = half
        board = 0.0015
        for name, size, place, surface in (
            ("pages", (w - 0.004, d - 0.004, h - 2 * board), (0, 0.002, 0), pages),
            ("front", (w, d, board), (0, 0, h - board), cover),
            ("back", (w, d, board), (0, 0, board - h), cover),
            ("spine", (w, board, h - 2 * board), (0, board - d, 0), cover),
        ):
            c.box(f"book_{i}_{name}", size, surface, bevel=0.0008, location=place).parent = pose


def wall() -> None:
    """Painted plaster behind the desk."""
    g = c.Graph(bpy.data.materials.new("painted plaster"))
    at = g.node("TexCoord").outputs["Object"]
    rough = g.node("TexNoise", {"Vector": at, "Scale": 34.0, "Detail": 7.0}).outputs["Fac"]
    clouds = g.node("TexNoise", {"Vector": at, "Scale": 3.0, "Detail": 4.0}).outputs["Fac"]
    tone = g.ramp(clouds, [(0.3, (0.10, 0.17, 0.18)), (0.7, (0.14, 0.22, 0.23))])
    bump = g.node("Bump", {"Height": rough, "Strength": 0.25, "Distance": 0.004}).outputs["Normal"]
    plaster = g.surface(g.node("BsdfPrincipled", {"Base Color": tone, "Roughness": 0.7, "Normal": bump}))
    c.quad("wall", (0, 0.40, 0.6), (0.9, 0, 0), (0, 0, 0.6), plaster)


def desk() -> None:
    """Desk top, two sheets of paper, a pen."""
    c.quad("desk", (0, -0.10, 0), (0.9, 0, 0), (0, 0.50, 0), surfaces.wood())
    paper = c.material("paper", "BsdfDiffuse", Color=(0.72, 0.69, 0.62))
    for i, (x, y, turn) in enumerate(((-0.055, -0.105, 12), (-0.035, -0.095, 4))):
        place = {"location": (x, y, 0.0004 + 0.0007 * i), "rotation": (0, 0, math.radians(turn))}
        c.box(f"paper_{i}", (0.105, 0.0745, 0.0003), paper, **place)
    pen = [(0.0, 0.0), (0.0008, 0.001), (0.0038, 0.016), (0.0046, 0.030), (0.0050, 0.132), (0.0030, 0.136)]
    lying = {"location": (0.055, -0.145, 0.0065), "rotation": (math.radians(90), 0, math.radians(-124))}
    turned.turn("pen", [*pen, (0.0, 0.1363)], bpy.data.materials["brass"], **lying)


def glow(scene) -> None:
    """The halo of a lens around what is brighter than white, by the compositor."""
    scene.use_nodes = True
    tree = scene.node_tree
    glare = tree.nodes.new("CompositorNodeGlare")
    glare.glare_type, glare.quality, glare.threshold, glare.size, glare.mix = "FOG_GLOW", "HIGH", 40.0, 7, -0.96
    picture, out = tree.nodes["Render Layers"], tree.nodes["Composite"]
    tree.links.new(picture.outputs["Image"], glare.inputs["Image"])
    tree.links.new(glare.outputs["Image"], out.inputs["Image"])


def build() -> None:
    scene = c.start(1200, 900, 256)
    glass = vessels.clear()
    pendant(vessels.clear("bulb glass", 1.5))
    wall()
    desk()
    books()
    tumbler(glass, (0.175, -0.005, 0.0))
    magnifier(glass, (-0.045, -0.055, 0.062), math.radians(-62))
    c.sphere("paperweight", (0.085, -0.075, 0.0256), 0.025, glass, 96, 48)
    c.world((0.30, 0.42, 0.70), 0.03)
    c.camera((0.02, -0.82, 0.33), (0.010, 0.0, 0.125), 52, focus=(0.04, -0.03, 0.12), fstop=8.0)
    scene.view_settings.exposure = 0.7
    glow(scene)
    c.save(c.output_path(os.path.join(HERE, "light_bulb.blend")))


build()
