# SPDX-License-Identifier: GPL-3.0-or-later
"""A wall along y with windows of real panes, and the curtains before them. The room is on the side of +x."""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np
import shapes

THICK, PANE = 0.26, 0.006


def wall(x: float, reach, top: float, windows, sill: float, head: float, plaster) -> None:
    """A wall THICK metres thick behind x from reach[0] to reach[1]; `windows` are (middle, width) along y."""

    def block(name: str, low, high):
        half = [(b - a) / 2 for a, b in zip(low, high)]
        c.box(f"wall {name}", half, plaster, location=[(a + b) / 2 for a, b in zip(low, high)])

    block("below", (x - THICK, reach[0], -0.05), (x, reach[1], sill))
    block("above", (x - THICK, reach[0], head), (x, reach[1], top + 0.05))
    edges = [reach[0], *(y for middle, width in windows for y in (middle - width / 2, middle + width / 2)), reach[1]]
    for k in range(0, len(edges), 2):
        block(f"pier {k // 2}", (x - THICK, edges[k], sill), (x, edges[k + 1], head))


def window(name: str, x: float, middle: float, width: float, sill: float, head: float, paint, glass, board) -> None:
    """A frame with two by three panes set back in the wall, and a board inside. Panes are closed boxes of glass."""
    at, half, height = x - 0.15, width / 2, head - sill
    frame, bar = 0.032, 0.014
    for side in (-1, 1):
        place = (at, middle + side * (half - frame), (sill + head) / 2)
        c.box(f"{name} stile", (0.03, frame, height / 2), paint, 0.004, location=place)
        place = (at, middle, (sill + frame) if side < 0 else head - frame)
        c.box(f"{name} rail", (0.0295, half - 2 * frame, frame), paint, 0.004, location=place)
    low, high = sill + 2 * frame, head - 2 * frame
    c.box(f"{name} mullion", (0.028, 0.026, (high - low) / 2), paint, 0.004, location=(at, middle, (low + high) / 2))
    clear_y, clear_z = (half - 2 * frame - 0.026) / 2, (high - low - 2 * 2 * bar) / 6
    for column in (-1, 1):
        y = middle + column * (0.026 + clear_y)
        for row in range(3):
            z = low + clear_z + row * 2 * (clear_z + bar)
            size = (PANE / 2, clear_y + 0.006, clear_z + 0.006)
            c.box(f"{name} pane {column} {row}", size, glass, location=(at, y, z))
            if row:
                c.box(f"{name} bar", (0.018, clear_y, bar), paint, 0.003, location=(at, y, z - clear_z - bar))
    c.box(f"{name} board", (0.115, half + 0.05, 0.016), board, 0.006, location=(x - 0.06, middle, sill + 0.008))


def curtain(name: str, x: float, y: float, width: float, low: float, high: float, cloth, seed: int) -> None:
    """Gathered cloth that hangs at x around y: folds that grow and wander toward the hem."""
    random = np.random.default_rng(seed)
    u, v = np.meshgrid(np.linspace(0, 1, 121), np.linspace(0, 1, 41), indexing="ij")
    phase, folds = random.uniform(0, 6.28, 3), 5.0 + random.uniform(0, 0.8)
    wander = 0.06 * np.sin(2.1 * v + phase[0]) * v
    turn = 2 * math.pi * folds * (u + wander) + phase[1]
    depth = (0.026 + 0.016 * v) * (1.0 + 0.25 * np.sin(6 * u + phase[2]))
    px = x + depth * np.sin(turn) + 0.006 * np.sin(2 * turn + 3 * v)
    py = y + width * (u - 0.5) * (1.0 + 0.08 * v) + 0.012 * np.cos(turn) * v
    pz = high + (low - high) * v
    vertices = np.round(np.stack([px, py, pz], -1).reshape(-1, 3), 4)
    n = 41
    faces = [(i * n + k, i * n + k + 1, (i + 1) * n + k + 1, (i + 1) * n + k) for i in range(120) for k in range(n - 1)]
    obj = c.mesh(name, vertices, faces, cloth, smooth=True)
    fine = obj.modifiers.new("Subdivision", "SUBSURF")
    fine.levels, fine.render_levels = 0, 1


def rod(x: float, reach, z: float, metal) -> None:
    shapes.tube("curtain rod", np.array([(x, y, z) for y in np.linspace(reach[0], reach[1], 12)]), 0.011, metal)
    for y in reach:
        c.sphere("rod end", (x, y, z), 0.022, metal, 48, 24)


def linen() -> bpy.types.Material:
    """Thin woven cloth: half of the light passes, threads show as a fine bump."""
    g = c.Graph(bpy.data.materials.new("linen"))
    at = g.node("TexCoord").outputs["Object"]
    warp = g.node("Mapping", {"Vector": at, "Scale": (40.0, 260.0, 8.0)}).outputs["Vector"]
    weft = g.node("Mapping", {"Vector": at, "Scale": (40.0, 8.0, 260.0)}).outputs["Vector"]
    threads = g.math(
        "ADD",
        g.node("TexNoise", {"Vector": warp, "Scale": 1.0, "Detail": 2.0}).outputs["Fac"],
        g.node("TexNoise", {"Vector": weft, "Scale": 1.0, "Detail": 2.0}).outputs["Fac"],
    )
    tone = g.ramp(g.math("MULTIPLY", threads, 0.5), [(0.35, (0.60, 0.56, 0.49)), (0.65, (0.76, 0.73, 0.67))])
    bump = g.node("Bump", {"Height": threads, "Strength": 0.25, "Distance": 0.0012}).outputs["Normal"]
    front = g.node("BsdfDiffuse", {"Color": tone, "Normal": bump})
    through = g.node("BsdfTranslucent", {"Color": tone, "Normal": bump})
    return g.surface(g.node("MixShader", {0: 0.45, 1: front.outputs[0], 2: through.outputs[0]}))
