# SPDX-License-Identifier: GPL-3.0-or-later
"""What floats in the pool and stands around it: ladder, swim ring, beach ball, agaves in pots, garden wall."""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np
import shapes
import surfaces
from pool import HALF_Y, LEVEL


def gores(name: str, colors, roughness: float = 0.22) -> bpy.types.Material:
    """Glossy vinyl in as many equal sectors around the object's z as there are colours."""
    g = c.Graph(bpy.data.materials.new(name))
    at = g.node("SeparateXYZ", {"Vector": g.node("TexCoord").outputs["Object"]})
    turn = g.math("ARCTAN2", at.outputs["Y"], at.outputs["X"])
    share = g.math("FRACT", g.math("MULTIPLY_ADD", turn, 0.5 / math.pi, 1.0))
    color = g.ramp(share, [(k / len(colors), v) for k, v in enumerate(colors)], "CONSTANT")
    return g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": roughness, "Specular": 0.5}))


WHITE, RED, YELLOW, BLUE = (0.78, 0.77, 0.74), (0.70, 0.045, 0.030), (0.86, 0.50, 0.035), (0.030, 0.20, 0.50)


def ring(location, rotation=(0, 0, 0)) -> None:
    surface = gores("ring vinyl", [RED, WHITE] * 4)
    shapes.torus("swim ring", 0.33, 0.125, surface, location=location, rotation=rotation)


def ball(location, rotation, radius: float = 0.20) -> None:
    surface = gores("ball vinyl", [RED, WHITE, YELLOW, WHITE, BLUE, WHITE])
    sphere = c.sphere("beach ball", (0, 0, 0), radius, surface, 96, 48)
    sphere.location, sphere.rotation_euler = location, rotation
    plug = c.sphere("ball plug", (0, 0, 0), 0.035, c.material("plug", "BsdfPrincipled", Base_Color=WHITE), 48, 24)
    plug.scale = (1, 1, 0.25)
    plug.parent, plug.location = sphere, (0, 0, radius)


def steel() -> bpy.types.Material:
    return c.material("polished steel", "BsdfPrincipled", Base_Color=(0.66, 0.65, 0.63), Metallic=1.0, Roughness=0.06)


def ladder(x: float, inward: float) -> None:
    """A steel ladder with three steps; `inward` (±1) is the way along y from its wall to the water."""
    metal = steel()
    wall, half = -inward * HALF_Y, 0.25
    for side in (-1, 1):
        at = x + side * half
        line = [
            (at, wall - inward * 0.62, 0.0),
            (at, wall - inward * 0.62, 0.74),
            (at, wall + inward * 0.14, 0.74),
            (at, wall + inward * 0.14, LEVEL - 1.02),
            (at, wall, LEVEL - 1.12),
        ]
        shapes.tube(f"ladder rail {side}", shapes.round_corners(line, 0.21, 12), 0.0215, metal, 32)
        c.revolve(
            f"rail rosette {side}",
            [(0.0, 0.0), (0.055, 0.0), (0.055, 0.008), (0.045, 0.016), (0.0, 0.016)],
            metal,
            48,
            location=(at, wall - inward * 0.62, 0.0),
        )
    for k in range(3):
        z = LEVEL - 0.22 - 0.29 * k
        c.box(f"ladder step {k}", (half, 0.04, 0.013), metal, 0.008, location=(x, wall + inward * 0.14, z))


def agave(location, height: float, seed: int, leaf) -> None:
    """A rosette of pointed, channelled leaves; height of the longest in metres."""
    random = np.random.default_rng(seed)
    vertices, faces = [], []
    leaves, parts = 34, 10
    for k in range(leaves):
        age = k / (leaves - 1)
        turn, lean = 2.39996 * k + random.normal(0, 0.08), 0.12 + 1.15 * age**1.2 + random.normal(0, 0.05)
        length = height * (1.0 - 0.25 * age) * random.uniform(0.9, 1.05)
        out = np.array((math.cos(turn), math.sin(turn), 0.0))
        across = np.array((-out[1], out[0], 0.0))
        point, first = np.array((0.0, 0.0, 0.0)) + out * 0.02, len(vertices)
        for s in np.linspace(0, 1, parts + 1):
            bend = lean + 0.45 * s * s * age
            way = out * math.sin(bend) + np.array((0, 0, 1.0)) * math.cos(bend)
            up = -out * math.cos(bend) + np.array((0, 0, 1.0)) * math.sin(bend)
            width = 0.085 * length * (0.75 + 1.3 * s - 2.05 * s**2.2) + 0.001
            for side, lift in ((-1.0, 0.35), (-0.5, 0.08), (0.0, 0.0), (0.5, 0.08), (1.0, 0.35)):
                vertices.append(point + side * width * across + lift * width * up)
            point = point + way * (length / parts)
        faces += [
            (first + 5 * r + q, first + 5 * r + q + 1, first + 5 * r + q + 6, first + 5 * r + q + 5)
            for r in range(parts)
            for q in range(4)
        ]
    c.mesh(f"agave {seed}", np.round(vertices, 4), faces, leaf, smooth=True, location=location)


def leaf_green(name: str, dark, pale) -> bpy.types.Material:
    """Waxy leaves between two tones."""
    g = c.Graph(bpy.data.materials.new(name))
    noise = g.node("TexNoise", {"Vector": g.node("TexCoord").outputs["Object"], "Scale": 6.0, "Detail": 3.0})
    color = g.ramp(noise.outputs["Fac"], [(0.3, dark), (0.7, pale)])
    return g.surface(g.node("BsdfPrincipled", {"Base Color": color, "Roughness": 0.42, "Specular": 0.4}))


def potted_agave(x: float, y: float, size: float, seed: int, clay, leaf) -> None:
    """An agave in a terracotta pot; `size` 1 is 0.78 m wide at the rim's top and about 1.5 m high."""
    profile = [
        (0.0, 0.0),
        (0.62, 0.0),
        (0.80, 0.88),
        (0.90, 0.90),
        (0.92, 1.06),
        (0.80, 1.08),
        (0.76, 0.94),
        (0.0, 0.9),
    ]
    outline = [(0.42 * size * r, 0.62 * size * z) for r, z in profile]
    pot = c.revolve(f"pot {seed}", outline, clay, 96, location=(x, y, 0))
    c.round_edges(pot, 0.012 * size, 3)
    agave((x, y, 0.56 * size), 0.95 * size, seed, leaf)


def cypress(leaf) -> bpy.types.Mesh:
    """A spindle of 2600 pointed sprays, four metres high, as a mesh that several trees share."""
    random = np.random.default_rng(21)
    vertices, faces = [], []
    for _ in range(2600):
        z = random.uniform(0.02, 1.0) ** 0.85
        turn = random.uniform(0, 2 * math.pi)
        reach = 0.42 * (1.0 - z) ** 0.6 * min(1.0, 0.55 + 3.0 * z) * random.uniform(0.75, 1.05)
        out = np.array((math.cos(turn), math.sin(turn), 0.0))
        across = np.array((-out[1], out[0], 0.0))
        root = reach * 0.72 * out + np.array((0, 0, 4.0 * z - 0.16))
        tip = reach * out * random.uniform(0.95, 1.15) + np.array((0, 0, 4.0 * z + random.uniform(0.1, 0.25)))
        first = len(vertices)
        width = random.uniform(0.02, 0.045)
        vertices += [root, (root + tip) / 2 - width * across, tip, (root + tip) / 2 + width * across + 0.02 * out]
        faces.append((first, first + 1, first + 2, first + 3))
    obj = c.mesh("cypress", np.round(vertices, 3), faces, leaf)
    bpy.context.scene.collection.objects.unlink(obj)
    return obj.data


def cypresses(places, leaf) -> None:
    """Trees of one mesh at places (x, y, height in metres)."""
    data = cypress(leaf)
    for k, (x, y, height) in enumerate(places):
        tree = c.add(data, f"cypress {k}", (x, y, 0), (0, 0, 1.7 * k))
        tree.scale = (height / 4.0, height / 4.0, height / 4.0)


def garden_walls(y: float, x: float, height: float = 1.7) -> None:
    """Plastered walls with caps of stone behind the pool, along x at `y` and along y at `x`."""
    plaster, cap = surfaces.stucco(), surfaces.travertine("wall cap")
    for name, at, turn in (("back", (x - 8.86, y, 0), 0.0), ("right", (x, y - 8.86, 0), math.pi / 2)):
        middle = (at[0], at[1], height / 2)
        c.box(f"wall {name}", (9.0, 0.14, height / 2), plaster, 0.015, location=middle, rotation=(0, 0, turn))
        for k in range(-6, 6):
            along = 1.5 * k + 0.75
            place = (at[0] + along * math.cos(turn), at[1] + along * math.sin(turn), height + 0.03)
            half = (0.748 + (0.19 if k == 5 else 0.0), 0.19, 0.03)
            c.box(f"cap {name} {k}", half, cap, 0.012, location=place, rotation=(0, 0, turn))


def bench(x: float, y: float, wood) -> None:
    """A low bench of slats before the wall, with two rolled towels."""
    for k in range(5):
        c.box(f"slat {k}", (0.9, 0.042, 0.016), wood, 0.006, location=(x, y + 0.1 * (k - 2), 0.42))
    for side in (-1, 1):
        c.box(f"bench leg {side}", (0.035, 0.22, 0.20), wood, 0.006, location=(x + side * 0.7, y, 0.203))
    towel = c.material("towel", "BsdfDiffuse", Color=(0.72, 0.70, 0.66))
    for k, place in enumerate(((-0.62, 0.525, -0.06), (-0.42, 0.525, 0.03), (-0.52, 0.66, 0.0))):
        roll = [(0.002, -0.2), (0.072, -0.2), (0.085, -0.187), (0.085, 0.187), (0.072, 0.2), (0.002, 0.2)]
        at = (x + place[0], y + place[2], place[1])
        c.revolve(f"towel {k}", roll, towel, 64, location=at, rotation=(math.pi / 2, 0, 0.06 * k))


def parasol(x: float, y: float, cloth, wood, height: float = 2.35, radius: float = 1.25) -> None:
    """A white eight-sided sunshade with a short valance, on a wooden pole in a round foot."""
    sides, vertices, faces = 8, [(0.0, 0.0, height + 0.02)], []
    rim = [(math.cos(2 * math.pi * k / sides), math.sin(2 * math.pi * k / sides)) for k in range(sides)]
    for share, drop in ((0.35, 0.16), (0.7, 0.36), (1.0, 0.50), (1.0, 0.62)):
        vertices += [(radius * share * px, radius * share * py, height - drop) for px, py in rim]
    faces += [(0, 1 + k, 1 + (k + 1) % sides) for k in range(sides)]
    for r in range(3):
        a, b = 1 + r * sides, 1 + (r + 1) * sides
        faces += [(a + k, b + k, b + (k + 1) % sides, a + (k + 1) % sides) for k in range(sides)]
    canopy = c.mesh("parasol", vertices, faces, cloth, location=(x, y, 0), rotation=(0, 0, 0.3))
    thick = canopy.modifiers.new("Solidify", "SOLIDIFY")
    thick.thickness = 0.004
    shapes.tube("parasol pole", np.array([(x, y, z) for z in np.linspace(0.0, height + 0.12, 8)]), 0.024, wood)
    foot = [(0.0, 0.0), (0.26, 0.0), (0.26, 0.05), (0.24, 0.065), (0.03, 0.07), (0.0, 0.07)]
    c.revolve("parasol foot", foot, steel(), 96, location=(x, y, 0))


def lounger(x: float, y: float, turn: float, wood, cloth) -> None:
    """A slatted deck chair two metres long with a cushion; its back is raised."""
    root = c.add(None, "lounger", (x, y, 0), (0, 0, turn))

    def part(name, half, surface, bevel, location, lean=0.0):
        c.box(name, half, surface, bevel, location=location, rotation=(0, lean, 0)).parent = root

    for side in (-1, 1):
        part("lounger beam", (1.0, 0.022, 0.04), wood, 0.008, (0, side * 0.31, 0.30))
        for end in (-0.85, 0.85):
            part("lounger leg", (0.03, 0.022, 0.15), wood, 0.008, (end, side * 0.31, 0.15))
    for k in range(13):
        part("lounger slat", (0.035, 0.29, 0.009), wood, 0.004, (-0.93 + 0.1 * k, 0, 0.335))
    part("lounger cushion", (0.66, 0.29, 0.035), cloth, 0.03, (-0.33, 0, 0.38))
    part("lounger back", (0.37, 0.29, 0.035), cloth, 0.03, (0.62, 0, 0.575), -0.62)
