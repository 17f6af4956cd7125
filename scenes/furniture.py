# SPDX-License-Identifier: GPL-3.0-or-later
"""Furniture of window_room.blend: armchair, round table, sideboard, rug, picture, carafe, books."""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np
import shapes


def fabric(name: str, color, scale: float = 420.0) -> bpy.types.Material:
    """Woven cloth with a sheen: a fine weave as bump and tone."""
    g = c.Graph(bpy.data.materials.new(name))
    at = g.node("TexCoord").outputs["Object"]
    weave = g.node("TexVoronoi", {"Vector": at, "Scale": scale}).outputs["Distance"]
    patch = g.node("TexNoise", {"Vector": at, "Scale": 7.0, "Detail": 4.0}).outputs["Fac"]
    tone = g.math("MULTIPLY_ADD", patch, 0.35, g.math("MULTIPLY", weave, 0.5))
    shade = g.ramp(tone, [(0.15, tuple(0.72 * v for v in color)), (0.6, color)])
    bump = g.node("Bump", {"Height": weave, "Strength": 0.35, "Distance": 0.002}, invert=True).outputs["Normal"]
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": shade, "Roughness": 0.9, "Specular": 0.1, "Sheen": 0.4, "Normal": bump})
    )


def cushion(name: str, half, surface, location, rotation=(0, 0, 0), puff: float = 0.12) -> bpy.types.Object:
    """A box whose faces bulge and whose edges are soft, with a seam around."""
    u, v = np.meshgrid(np.linspace(-1, 1, 25), np.linspace(-1, 1, 25), indexing="ij")
    top = (1 - np.abs(u) ** 6) ** (1 / 3.2) * (1 - np.abs(v) ** 6) ** (1 / 3.2)
    crown = 1.0 + puff * (1 - u * u) * (1 - v * v)
    vertices, faces = [], []
    for sign in (1, -1):
        z = sign * half[2] * (0.06 + 0.94 * top) * crown
        vertices += np.stack([half[0] * u, half[1] * v, z], -1).reshape(-1, 3).tolist()
    n = 25
    for layer, flip in ((0, False), (n * n, True)):
        for i in range(n - 1):
            for k in range(n - 1):
                face = [layer + i * n + k, layer + (i + 1) * n + k, layer + (i + 1) * n + k + 1, layer + i * n + k + 1]
                faces.append(face[::-1] if flip else face)
    rim = [i * n for i in range(n)] + [(n - 1) * n + k for k in range(1, n)]
    rim += [i * n + n - 1 for i in range(n - 2, -1, -1)] + list(range(n - 2, 0, -1))
    faces += [(b, a, a + n * n, b + n * n) for a, b in zip(rim, rim[1:] + rim[:1])]
    obj = c.mesh(name, np.round(vertices, 4), faces, surface, smooth=True, location=location, rotation=rotation)
    fine = obj.modifiers.new("Subdivision", "SUBSURF")
    fine.levels, fine.render_levels = 0, 1
    return obj


def armchair(x: float, y: float, turn: float, cloth, wood) -> None:
    """A lounge chair of bent wood with two cushions; it looks along its own −y."""
    root = c.add(None, "armchair", (x, y, 0), (0, 0, turn))
    parts = [
        cushion("chair seat", (0.31, 0.32, 0.085), cloth, (0, -0.02, 0.40), (0.10, 0, 0)),
        cushion("chair back", (0.31, 0.33, 0.075), cloth, (0, 0.34, 0.69), (1.28, 0, 0)),
        cushion(
            "chair pillow",
            (0.20, 0.13, 0.055),
            fabric("pillow", (0.62, 0.33, 0.10)),
            (0.03, 0.19, 0.60),
            (1.1, 0.1, 0.15),
        ),
        c.box("chair bar", (0.34, 0.02, 0.025), wood, 0.01, location=(0, -0.27, 0.315)),
        c.box("chair bar", (0.34, 0.02, 0.025), wood, 0.01, location=(0, 0.27, 0.265)),
    ]
    for side in (-1, 1):
        at = side * 0.36
        frame = [(at, -0.40, 0.0), (at, -0.33, 0.60), (at, 0.36, 0.53), (at, 0.50, 0.0)]
        parts.append(shapes.tube("chair frame", shapes.round_corners(frame, 0.09), 0.019, wood))
        back = [(at * 0.93, 0.24, 0.27), (at * 0.93, 0.50, 0.98)]
        parts.append(shapes.tube("chair post", np.linspace(*map(np.array, back), 6), 0.016, wood))
    for part in parts:
        part.parent = root


def round_table(x: float, y: float, height: float, radius: float, wood) -> None:
    top = [(0.0, 0.0), (radius - 0.02, 0.0), (radius, 0.012), (radius, 0.022), (radius - 0.008, 0.028), (0.0, 0.028)]
    c.revolve("table top", top, wood, 128, location=(x, y, height - 0.028))
    for k in range(3):
        a = 2 * math.pi * k / 3 + 0.5
        out = np.array((math.cos(a), math.sin(a), 0.0))
        foot, knee = np.array((x, y, 0)) + 1.0 * radius * out, np.array((x, y, height - 0.03)) + 0.45 * radius * out
        shapes.tube("table leg", np.linspace(foot, knee, 6), 0.017, wood)


def carafe(x: float, y: float, z: float, glass) -> None:
    """A round-bellied carafe with a thick foot, three millimetres thick, and a tumbler beside it."""
    outer = shapes.smooth_line(
        [(0.052, 0.0), (0.078, 0.05), (0.072, 0.10), (0.034, 0.165), (0.030, 0.21), (0.040, 0.245)], 8
    )
    inner = shapes.smooth_line(
        [(0.037, 0.245), (0.027, 0.21), (0.031, 0.165), (0.069, 0.10), (0.074, 0.052), (0.045, 0.012)], 8
    )
    c.revolve("carafe", [(0.0, 0.0), *outer, *inner, (0.0, 0.011)], glass, 128, location=(x, y, z))
    cup = [
        (0.0, 0.0),
        (0.030, 0.0),
        (0.034, 0.004),
        (0.038, 0.088),
        (0.0365, 0.090),
        (0.035, 0.088),
        (0.0315, 0.012),
        (0.0, 0.010),
    ]
    tumbler = c.revolve("tumbler", cup, glass, 128, location=(x + 0.14, y - 0.09, z))
    c.round_edges(tumbler, 0.0012, 2)


def sideboard(x: float, y: float, wood, front, metal) -> None:
    """A low cabinet of three doors on legs, its back toward +y."""
    c.box("sideboard", (0.80, 0.21, 0.24), wood, 0.008, location=(x, y, 0.44))
    for k in (-1, 0, 1):
        c.box(f"door {k}", (0.255, 0.008, 0.205), front, 0.004, location=(x + 0.522 * k, y - 0.213, 0.44))
        c.sphere(f"knob {k}", (x + 0.522 * k + 0.20, y - 0.236, 0.44), 0.013, metal, 32, 16)
    for side in (-1, 1):
        for end in (-1, 1):
            line = np.linspace((x + side * 0.74, y + end * 0.16, 0.0), (x + side * 0.70, y + end * 0.15, 0.21), 4)
            shapes.tube("sideboard leg", line, 0.016, wood)


def picture(x: float, y: float, z: float, half, wood) -> None:
    """A framed print of soft overlapping discs, drawn by distances on its own plane."""
    g = c.Graph(bpy.data.materials.new("print"))
    at = g.node("TexCoord").outputs["Object"]
    color = (0.70, 0.66, 0.58)
    for place, size, tone in (
        ((-0.10, 0.0, 0.10), 0.21, (0.60, 0.20, 0.08)),
        ((0.12, 0.0, -0.02), 0.17, (0.06, 0.14, 0.19)),
        ((-0.04, 0.0, -0.20), 0.13, (0.66, 0.42, 0.12)),
    ):
        far = g.node("VectorMath", {0: at, 1: place}, operation="DISTANCE").outputs["Value"]
        color = g.mix_color(g.math("MULTIPLY", g.math("LESS_THAN", far, size), 0.92), color, tone)
    paper = g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.8, "Specular": 0.2}))
    c.box("print", (half[0], 0.004, half[1]), paper, location=(x, y - 0.012, z))
    for side in (-1, 1):
        rail = (x, y - 0.016, z + side * (half[1] + 0.012))
        c.box("frame rail", (half[0] + 0.024, 0.016, 0.012), wood, 0.002, location=rail)
        stile = (x + side * (half[0] + 0.012), y - 0.016, z)
        c.box("frame stile", (0.012, 0.0155, half[1]), wood, 0.002, location=stile)


def books(x: float, y: float, z: float) -> None:
    random = np.random.default_rng(4)
    for k, tone in enumerate(((0.30, 0.06, 0.04), (0.07, 0.12, 0.15), (0.55, 0.48, 0.36))):
        cover = c.material(f"book {k}", "BsdfPrincipled", Base_Color=tone, Roughness=0.6)
        half = (0.14 - 0.012 * k, 0.10 - 0.008 * k, 0.014)
        c.box(
            f"book {k}",
            half,
            cover,
            0.002,
            location=(x, y, z + 0.014 + 0.0285 * k),
            rotation=(0, 0, random.normal(0, 0.12)),
        )


def rug(x: float, y: float, half, turn: float) -> None:
    """A woven rug, a centimetre thick, with bands at its ends."""
    g = c.Graph(bpy.data.materials.new("rug"))
    at = g.node("TexCoord").outputs["Object"]
    along = g.math("ABSOLUTE", g.node("SeparateXYZ", {"Vector": at}).outputs["X"])
    wool = g.node("TexNoise", {"Vector": at, "Scale": 190.0, "Detail": 3.0, "Roughness": 0.7}).outputs["Fac"]
    end = half[0]
    bands = g.ramp(
        g.math("DIVIDE", along, end),
        [
            (0.0, (0.58, 0.53, 0.45)),
            (0.72, (0.18, 0.10, 0.075)),
            (0.76, (0.58, 0.53, 0.45)),
            (0.82, (0.33, 0.12, 0.06)),
            (0.90, (0.58, 0.53, 0.45)),
        ],
        "CONSTANT",
    )
    color = g.mix_color(0.75, bands, g.ramp(wool, [(0.3, (0.55, 0.53, 0.50)), (0.7, (1, 1, 1))]), "MULTIPLY")
    bump = g.node("Bump", {"Height": wool, "Strength": 0.8, "Distance": 0.006}).outputs["Normal"]
    surface = g.surface(
        g.node(
            "BsdfPrincipled", {"Base Color": color, "Roughness": 1.0, "Specular": 0.05, "Sheen": 0.3, "Normal": bump}
        )
    )
    c.box("rug", (*half, 0.005), surface, 0.004, location=(x, y, 0.0055), rotation=(0, 0, turn))
