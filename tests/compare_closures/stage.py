# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: a sheet as a scene. Balls far apart before an orthographic camera, under a sky with a small sun
and a small area lamp; nothing is seen behind them (but behind media), so that a cell's mean is its ball's."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import common
import kit
from sheets import SHEETS, Row

CELL = 40
"""Pixels between balls."""
BALL = 24
"""Pixels of a ball, and of the part of its cell that is compared."""
COLUMNS = 10


@dataclass
class Ball:
    label: str
    material: bpy.types.Material


def socket(node, names: str):
    """A node's input under the first of several names; of inputs with one name, the first that is in use."""
    found = [s for n in names.split("|") for s in node.inputs if s.name == n and s.enabled]
    return found[0] if found else None


def make(row: Row, value, name: str) -> bpy.types.Material | None:
    """A material of the row's node; None when this Blender has none of the kind."""
    kinds = [k for k in row.kind.split("|") if hasattr(bpy.types, f"ShaderNode{k}")]
    if not kinds:
        return None
    graph = kit.graph(name)
    node = graph.node(kinds[0])
    try:
        for choice, wanted in row.choices.items():
            setattr(node, choice, wanted)
    except (AttributeError, TypeError):
        return None
    if socket(node, row.sweep[0]) is None:
        return None
    for names, wanted in [*row.inputs.items(), (row.sweep[0], value)]:
        target = socket(node, names)
        if target is not None:
            graph.feed(target, (wanted, wanted, wanted, 1.0) if target.type == "RGBA" and isinstance(wanted, float)
                       else wanted)
    graph.tree.links.new(node.outputs[0], graph.output.inputs[row.socket])
    return graph.owner


def balls(name: str) -> list[Ball]:
    """Of the rows of a sheet that this Blender has."""
    found = []
    for row in SHEETS[name]:
        for value in row.sweep[1]:
            text = f"{value:g}" if isinstance(value, (int, float)) else "/".join(f"{v:g}" for v in value[:3])
            label = f"{row.label} {row.sweep[0].split('|')[0]}={text}"
            material = make(row, value, label)
            if material is not None:
                found.append(Ball(label, material))
    return found


def build(name: str, scene: bpy.types.Scene) -> list[str]:
    """Fills an empty scene; the balls' labels by rows from the top."""
    placed = balls(name)
    columns, rows = COLUMNS, max(1, -(-len(placed) // COLUMNS))
    for i, ball in enumerate(placed):
        x, z = i % columns - (columns - 1) / 2, (rows - 1) / 2 - i // columns
        common.sphere(f"ball {i}", (x, 0, z), 0.5 * BALL / CELL, ball.material, 96, 48)
    scene.world = bpy.data.worlds.new("sky")
    sky = common.Graph(scene.world, "ShaderNodeOutputWorld")
    image = sky.node("TexEnvironment", image=kit.sky_image())
    sky.surface(sky.node("Background", {"Color": image.outputs["Color"], "Strength": 0.7}))
    kit.lamp("AREA", (4.0, -9.0, 6.0), (0, 0, 0), size=0.5, energy=900.0)
    camera = common.camera((0, -20, 0), (0, 0, 0), 50.0)
    camera.data.type, camera.data.ortho_scale = "ORTHO", max(columns, rows)
    scene.render.resolution_x, scene.render.resolution_y = columns * CELL, rows * CELL
    scene.render.film_transparent = name != "volume"  # what a medium absorbs is seen before the sky
    scene.cycles.max_bounces = scene.cycles.transmission_bounces = scene.cycles.glossy_bounces = 12
    scene.cycles.volume_bounces = scene.cycles.diffuse_bounces = scene.cycles.transparent_max_bounces = 12
    return [ball.label for ball in placed]
