# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, and the graphs of materials, worlds and lamps."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy

from . import compat
from .graph import GraphWalk
from .image import Images

_ATTRIBUTE_PROPERTIES = ("attribute_name", "layer_name", "uv_map")


class Materials:
    """Indices of materials in `scene`, each added when it is first asked for."""

    def __init__(self, scene: Any, images: Images, override: Any, warnings: list[str]) -> None:
        self._scene, self._images, self._override, self._warnings = scene, images, override, warnings
        self._known: dict[int, int] = {}
        self._graphs: dict[int, dict[str, Any] | None] = {}

    def indices(self, obj: Any) -> list[int]:
        """One for each slot of an evaluated object; -1: the default grey."""
        slots = [self._override or slot.material for slot in obj.material_slots]
        return [self.index(m) for m in slots or [self._override]]

    def index(self, material: Any) -> int:
        if material is None:
            return -1
        key = material.original.as_pointer()
        if key not in self._known:
            self._known[key] = self._add(material)
        return self._known[key]

    def graph(self, owner: Any, kind: str) -> dict[str, Any] | None:
        """The node tree of a material, world or light; None when it does without or the tree cannot be read."""
        key = owner.as_pointer()
        if key not in self._graphs:
            tree = compat.node_tree(owner)
            self._graphs[key] = None if tree is None else self._walk(f"{kind} “{owner.name}”", tree)
        return self._graphs[key]

    def _walk(self, owner: str, tree: Any) -> dict[str, Any] | None:
        try:
            return GraphWalk(owner, tree, self._images, self._warnings.append).run()
        except Exception as error:
            self._warnings.append(f"{owner}: nodes cannot be read: {error}")
            return None

    def _add(self, material: Any) -> int:
        desc = {
            "name": material.name,
            "viewport_color": list(material.diffuse_color)[:3],
            "metallic": material.metallic,
            "roughness": material.roughness,
            "use_transparent_shadow": compat.transparent_shadow(material),
            "sample_emission": compat.samples_emission(material),
            "pass_index": material.pass_index,
        }
        graph = self.graph(material, "Material")
        if graph is not None:
            desc["graph"] = graph
            if graph["displacement"] and compat.true_displacement(material):
                self._warnings.append(f"Material “{material.name}”: true displacement is not supported, bump is used")
        try:
            return self._scene.add_material(desc)
        except Exception as error:
            self._warnings.append(f"Material “{material.name}”: {error}")
            return -1


def attribute_names() -> set[str]:
    """Names of mesh attributes that some material of the file could read."""
    return {name for tree in _trees() for node in tree.nodes for key in _ATTRIBUTE_PROPERTIES
            if (name := getattr(node, key, ""))}


def _trees() -> Iterator[Any]:
    yield from (m.node_tree for m in bpy.data.materials if m.node_tree)
    yield from (g for g in bpy.data.node_groups if g.type == "SHADER")
