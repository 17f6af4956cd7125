# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: writes the .blend files of test_processes.py into the folder after `--`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
from caustics_kit import ball, floor_scene, glass, lamp
from scene_kit import add_square, emission, lit_world, reset

LONG_ENOUGH = 1 << 20  # samples that no test waits for


def save(name: str) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(sys.argv[-1]) / f"{name}.blend"))


def plain() -> None:
    """An emitting square: a picture in no time."""
    reset()
    add_square().data.materials.append(emission("Light"))
    save("plain")


def endless() -> None:
    """Sampling that would take hours."""
    reset(width=320, height=240, samples=LONG_ENOUGH)
    lit_world()
    add_square()
    save("endless")


def heavy() -> None:
    """Sixteen objects of 130 000 triangles each: time to cancel while exporting and while building."""
    reset(width=64, height=64, samples=LONG_ENOUGH)
    lit_world()
    for i in range(16):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=16, y_subdivisions=16, location=(0, 0, -0.1 * i))
        subdivision = bpy.context.object.modifiers.new("Finer", "SUBSURF")
        subdivision.subdivision_type, subdivision.render_levels = "SIMPLE", 4
    save("heavy")


def huge() -> None:
    """16 000 × 16 000 pixels with every pass."""
    reset(width=16000, height=16000, samples=1)
    add_square().data.materials.append(emission("Light"))
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = True
    save("huge")


def caustic() -> None:
    """A glass ball under a lamp, on a machine of 4 GB."""
    scene = floor_scene()
    ball("Glass", glass("Glass"))
    lamp("Lamp")
    scene.cardioid.memory_limit = 4096
    save("caustic")


plain()
endless()
caustic()
heavy()
huge()
