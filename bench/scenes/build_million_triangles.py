# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds million_triangles.blend: a meadow of 1.3 million triangles, instances of five meshes, under sun and sky.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_million_triangles.py -- OUT.blend
"""

import math
import os
import random
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "scenes"), os.path.dirname(os.path.abspath(__file__))]

import bpy  # noqa: E402
import common as c  # noqa: E402

TUFTS = 2600


def tuft(name: str, rng: random.Random, color) -> bpy.types.Mesh:
    """A hundred and twenty bent blades, four triangles each."""
    vertices, faces = [], []
    for _ in range(120):
        a, lean, tall = rng.uniform(0, 2 * math.pi), rng.uniform(0.05, 0.35), rng.uniform(0.18, 0.5)
        x, y, wide = rng.gauss(0, 0.10), rng.gauss(0, 0.10), rng.uniform(0.006, 0.012)
        dx, dy = math.cos(a), math.sin(a)
        first = len(vertices)
        for t in (0.0, 0.55):
            out, w = lean * t * t, wide * (1 - 0.6 * t)
            for s in (-1, 1):
                vertices.append((x + dx * out - dy * w * s, y + dy * out + dx * w * s, tall * t))
        vertices.append((x + dx * lean, y + dy * lean, tall))
        faces += [(first, first + 1, first + 3, first + 2), (first + 2, first + 3, first + 4)]
    g = c.Graph(bpy.data.materials.new(name))
    lit = g.node("BsdfDiffuse", {"Color": color})
    through = g.node("BsdfTranslucent", {"Color": tuple(0.8 * x for x in color)})
    surface = g.surface(g.node("MixShader", {0: 0.35, 1: lit.outputs[0], 2: through.outputs[0]}))
    obj = c.mesh(name, vertices, faces, surface)
    data = obj.data
    bpy.data.objects.remove(obj)
    return data


def build() -> None:
    c.start(1280, 800)
    rng = random.Random(11)
    colors = ((0.10, 0.26, 0.04), (0.16, 0.30, 0.05), (0.22, 0.30, 0.07), (0.30, 0.28, 0.09))
    meshes = [tuft(f"tuft {i}", rng, color) for i, color in enumerate(colors)]
    c.quad("soil", (0, 0, 0), (12, 0, 0), (0, 12, 0), c.material("soil", "BsdfDiffuse", Color=(0.10, 0.065, 0.04)))
    for i in range(TUFTS):
        y = rng.uniform(-3.2, 9)
        obj = c.add(rng.choice(meshes), f"tuft {i}", (rng.uniform(-1.6, 1.6) * (1 + (y + 3.5) * 0.3), y, 0))
        size = rng.uniform(0.6, 1.3)
        obj.rotation_euler, obj.scale = (0, 0, rng.uniform(0, 6.28)), (size, size, size)
    ball = c.material("ball", "BsdfPrincipled", Base_Color=(0.75, 0.13, 0.08), Roughness=0.3)
    first = c.sphere("ball", (0.4, -0.9, 0.42), 0.34, ball, 128, 64)
    for i, at in enumerate(((-1.3, 0.9, 0.4), (1.9, 1.6, 0.36), (-0.3, 3.4, 0.5))):
        c.add(first.data, f"ball {i}", at)
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle, sun.color = 4.0, math.radians(1.5), (1.0, 0.88, 0.70)
    c.aim(c.add(sun, "sun", (-4, -1.5, 4.0)), (0, 1.5, 0))
    c.world((0.42, 0.60, 0.95), 0.55)
    c.camera((0.1, -5.0, 1.5), (0, 0.6, 0.25), 40)
    graph = bpy.context.evaluated_depsgraph_get()
    total = sum(len(i.object.data.loop_triangles) for i in graph.object_instances if i.object.type == "MESH")
    if not total:
        for mesh in bpy.data.meshes:
            mesh.calc_loop_triangles()
        total = sum(len(o.data.loop_triangles) for o in bpy.data.objects if o.type == "MESH")
    print(f"{total} triangles")
    c.save(c.output_path("million_triangles.blend"))


build()
