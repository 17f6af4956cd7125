# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a smooth, wavy grid of side × side squares with UVs under a sun, square picture: for start and memory.

blender -b --factory-startup --python-exit-code 1 -P bench/scenes/build_grid.py -- OUT.blend SIDE
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scenes"))

import bpy  # noqa: E402
import common as c  # noqa: E402
import numpy as np  # noqa: E402


def build(path: str, side: int) -> None:
    c.start(1024, 1024)
    v, u = np.mgrid[0 : side + 1, 0 : side + 1] / side
    at = np.stack([4 * u - 2, 4 * v - 2, 0.05 * np.sin(40 * u) * np.sin(40 * v)], -1).reshape(-1, 3)
    first = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).reshape(-1, 1)
    quads = first + np.array([0, 1, side + 2, side + 1])
    data = bpy.data.meshes.new("grid")
    data.vertices.add(len(at))
    data.vertices.foreach_set("co", at.astype(np.float32).ravel())
    data.loops.add(quads.size)
    data.loops.foreach_set("vertex_index", quads.astype(np.int32).ravel())
    data.polygons.add(len(quads))
    data.polygons.foreach_set("loop_start", np.arange(0, quads.size, 4, dtype=np.int32))
    data.polygons.foreach_set("loop_total", np.full(len(quads), 4, np.int32))
    data.polygons.foreach_set("use_smooth", np.ones(len(quads), bool))
    layer = data.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", np.stack([u, v], -1).reshape(-1, 2)[quads.ravel()].astype(np.float32).ravel())
    data.update(calc_edges=True)
    data.materials.append(c.material("grid", "BsdfDiffuse", Color=(0.5, 0.5, 0.5)))
    c.add(data, "grid")
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = 3.0
    c.aim(c.add(sun, "sun", (2, -2, 4)), (0, 0, 0))
    c.world((0.2, 0.2, 0.2))
    c.camera((0, -4, 3), (0, 0, 0), 35)
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=False)


build(sys.argv[-2], int(sys.argv[-1]))
