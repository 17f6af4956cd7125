# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair as meshes: of particle systems and of hair curves."""

from __future__ import annotations

from collections.abc import Callable, Set
from typing import Any

import numpy as np

from . import strands, tubes
from .mesh import texture_space


def of_particles(scene: Any, obj: Any, render: bool, eye: Any, tell: Callable[[str], None]) -> int:
    """Adds the hair that grows on `obj` in its space; -1 when there is none. `eye`: the camera's place in the world."""
    modifiers = strands.particle_systems(obj, "show_render" if render else "show_viewport")
    groups = strands.of_particles(obj, modifiers, len(obj.material_slots), render)
    uvs = obj.data.uv_layers if obj.type == "MESH" else ()
    active = next((layer.name for layer in uvs if layer.active_render), "")
    box = texture_space(obj.data) if obj.type == "MESH" else None
    return _add(scene, f"{obj.name} (hair)", obj, groups, eye, box, active, tell)


def of_curves(scene: Any, obj: Any, wanted: Set[str], eye: Any, tell: Callable[[str], None]) -> int:
    """Adds an object of hair curves; -1 when it has no strands."""
    groups = strands.of_curves(obj.data, wanted)
    return _add(scene, obj.data.name, obj, groups, eye, None, strands.curve_uv(obj.data), tell)


def _add(scene: Any, name: str, obj: Any, groups: list[tubes.Strands], eye: Any, box: Any, active_uv: str,
         tell: Callable[[str], None]) -> int:
    groups = [g for g in groups if g.segments]
    if not groups:
        return -1
    low, size = _box(groups) if box is None else box
    for group in groups:
        group.own["#generated"] = ((group.keys[:, 0] - low) / size).astype(np.float32)
    built, step = tubes.build(groups, np.array(obj.matrix_world.inverted_safe() @ eye, np.float32))
    if step > 1:
        tell(f"Object “{obj.name}”: there is too much hair, one strand of {step} is rendered")
    return scene.add_mesh(
        name, built.positions, built.triangles, slots=built.slots,
        corner_normals=np.ascontiguousarray(built.normals[built.triangles], np.float32),
        attributes=[(layer, "point", values) for layer, values in built.layers.items()],
        active_uv=active_uv if active_uv in built.layers else "", generated_min=low, generated_size=size)


def _box(groups: list[tubes.Strands]) -> tuple[np.ndarray, np.ndarray]:
    points = np.concatenate([g.keys.reshape(-1, 3) for g in groups])
    low, size = points.min(0), np.ptp(points, 0)
    return low, np.where(size > 0, size, 1).astype(np.float32)
