# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, and the graphs of materials, worlds and lamps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from . import compat, needs
from .graph import GraphWalk
from .image import Images


class Materials:
    """Indices of materials in `scene`, each added when it is first asked for."""

    def __init__(self, scene: Any, images: Images, override: Any, warnings: list[str],
                 layer_value: Callable[[str], list[float]] | None = None) -> None:
        self._scene, self._images, self._override, self._warnings = scene, images, override, warnings
        self._layer_value = layer_value
        self._known: dict[int, int] = {}
        self._needs: dict[int, needs.Needs] = {}
        self._graphs: dict[int, dict[str, Any] | None] = {}

    def indices(self, obj: Any) -> list[int]:
        """One for each slot of an evaluated object; -1: the default grey."""
        return [self.index(m) for m in self._of(obj)]

    def needs(self, obj: Any) -> needs.Needs:
        """What the materials of an evaluated object read from it."""
        found = needs.Needs()
        for material in self._of(obj):
            key = 0 if material is None else material.as_pointer()
            if key not in self._needs:
                self._needs[key] = needs.of_material(material)
            found |= self._needs[key]
        return found

    def _of(self, obj: Any) -> list[Any]:
        return [self._override or slot.material for slot in obj.material_slots] or [self._override]

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
            return GraphWalk(owner, tree, self._images, self._warnings.append, self._layer_value).run()
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
            "displacement_method": compat.displacement_method(material),
        }
        graph = self.graph(material, "Material")
        if graph is not None:
            desc["graph"] = graph
        try:
            return self._scene.add_material(desc)
        except Exception as error:
            self._warnings.append(f"Material “{material.name}”: {error}")
            return -1
