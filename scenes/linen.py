# SPDX-License-Identifier: GPL-3.0-or-later
"""A linen cloth with woven stripes over a table's edge, and paper and print wrapped around a cylinder."""

from __future__ import annotations

import bpy
import common as c
import numpy as np


def weave(stripe=(0.035, 0.055, 0.15), ground=(0.40, 0.355, 0.285)) -> bpy.types.Material:
    """Linen in metres of UV: threads of uneven thickness each way, a group of stripes along v at every 0.44 m of u."""
    g = c.Graph(bpy.data.materials.new("linen"))
    uv = g.node("UVMap").outputs["UV"]
    threads = []
    for scale in ((50.0, 1500.0, 1.0), (1500.0, 50.0, 1.0)):
        along = g.node("Mapping", {"Vector": uv, "Scale": scale}).outputs["Vector"]
        threads.append(g.node("TexNoise", {"Vector": along, "Scale": 0.5, "Detail": 2.0}).outputs["Fac"])
    both = g.math("ADD", *threads)
    u = g.node("SeparateXYZ", {"Vector": uv}).outputs["X"]
    place = g.math("ABSOLUTE", g.math("SUBTRACT", g.math("MODULO", g.math("ADD", u, 4.4), 0.44), 0.22))
    wide = g.math("LESS_THAN", place, 0.011)
    thin = g.math("COMPARE", place, 0.0195, 0.0019)
    tint = g.math("MULTIPLY", g.math("MAXIMUM", wide, thin), g.math("MULTIPLY_ADD", threads[1], 0.5, 0.65))
    slubs = g.ramp(both, [(0.75, (0.62, 0.59, 0.55)), (1.15, (1, 1, 1))])
    color = g.mix_color(1.0, g.mix_color(tint, ground, stripe), slubs, "MULTIPLY")
    bump = g.node("Bump", {"Height": both, "Strength": 0.5, "Distance": 0.0008}).outputs["Normal"]
    return g.surface(
        g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.9, "Specular": 0.2, "Sheen": 0.3, "Normal": bump})
    )


def cloth(surface, half: tuple[float, float], hang: float, cells: int = 120, seed: int = 4):
    """A cloth over a table's top at z = 0: creases of ironing, soft waves, and its far edge falling by `hang`."""
    random = np.random.default_rng(seed)
    (w, d), round_by = half, 0.02
    s = np.linspace(-w, w, cells + 1)
    t = np.linspace(-d, d + hang, cells + 1)
    s, t = np.meshgrid(s, t, indexing="ij")
    over = np.maximum(t - d, 0.0)
    turn = np.minimum(over / round_by, np.pi / 2)
    fall = np.maximum(over - round_by * np.pi / 2, 0.0)
    y = np.minimum(t, d) + round_by * np.sin(turn)
    z = round_by * (np.cos(turn) - 1.0) - fall
    waves = np.zeros_like(s)
    for _ in range(14):
        k = random.normal(0, 9, 2)
        waves += random.uniform(0.2, 1.0) * np.sin(k[0] * s + k[1] * t + random.uniform(0, 6.3))
    creases = sum(np.exp(-np.abs(x - at) / 0.006) for x, at in ((s, -0.34), (s, 0.36), (t, 0.27), (t, -0.30)))
    z = z + 0.0007 * waves + 0.0022 * creases
    y = y + (0.010 + 0.05 * fall) * np.sin(31 * s + 2 * np.sin(7 * s)) * np.minimum(fall / 0.08, 1.0)
    n = cells
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.stack([first, first + n + 1, first + n + 2, first + 1], -1)
    flat = np.stack([s, t], -1).reshape(-1, 2)
    uvs = [flat[i] for face in faces for i in face]
    return c.mesh("cloth", np.round(np.stack([s, y, z], -1), 5).reshape(-1, 3), faces, surface, smooth=True, uvs=uvs)


def wrap(name: str, radius: float, low: float, high: float, turn: float, surface, **place):
    """A paper of `turn` radians around a cylinder, its middle toward -y."""
    n = 48
    angles = np.linspace(-turn / 2, turn / 2, n + 1) - np.pi / 2
    vertices = [(radius * np.cos(a), radius * np.sin(a), z) for a in angles for z in (low, high)]
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(n)]
    return c.mesh(name, vertices, faces, surface, smooth=True, **place)


def lettering(text: str, size: float, height: float, radius: float, surface, **place):
    """Letters of Blender's own font, `size` metres high, printed around a cylinder at a height, toward -y."""
    font = bpy.data.curves.new(text, "FONT")
    font.body, font.size, font.align_x, font.resolution_u = text, size, "CENTER", 3
    letters = bpy.data.objects.new(text, font)
    bpy.context.scene.collection.objects.link(letters)
    flat = letters.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    angles = [(v.co.x / radius - np.pi / 2, v.co.y) for v in flat.vertices]
    vertices = [(radius * np.cos(a), radius * np.sin(a), height + up) for a, up in angles]
    faces = [tuple(face.vertices) for face in flat.polygons]
    bpy.data.objects.remove(letters)
    bpy.data.curves.remove(font)
    return c.mesh(text, vertices, faces, surface, **place)
