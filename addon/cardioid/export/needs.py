# SPDX-License-Identifier: GPL-3.0-or-later
"""What shading nodes read from the objects they are on, so that only that is handed over."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import bpy

_NAMED_LAYERS = ("attribute_name", "layer_name", "uv_map")
_OF_EDGES = ("Pointiness", "Random Per Island")
_INSTANCE_SOURCES = {"OBJECT": "object", "INSTANCER": "instancer"}


@dataclass(frozen=True)
class Needs:
    """attributes: of the mesh. values: (source, name) of the instance, source "object" or "instancer". tangents: of
    these UV maps, "" is the render-active one. particles: Particle Info is used. edges: Pointiness or Random Per
    Island is."""

    attributes: frozenset[str] = frozenset()
    values: frozenset[tuple[str, str]] = frozenset()
    tangents: frozenset[str] = frozenset()
    particles: bool = False
    edges: bool = False

    def __or__(self, other: Needs) -> Needs:
        return Needs(self.attributes | other.attributes, self.values | other.values, self.tangents | other.tangents,
                     self.particles or other.particles, self.edges or other.edges)


NOTHING = Needs()


def of_file() -> Needs:
    """Of all materials of the file together: what one of them could read."""
    found = Needs()
    for tree in _trees():
        for node in tree.nodes:
            found |= _of_node(node)
    return found


def of_material(material: Any) -> Needs:
    """Of one material with the groups that it enters."""
    found, open_trees, seen = Needs(), [material.node_tree if material else None], set()
    while open_trees:
        tree = open_trees.pop()
        if tree is None or tree.as_pointer() in seen:
            continue
        seen.add(tree.as_pointer())
        for node in tree.nodes:
            found |= _of_node(node)
            open_trees.append(getattr(node, "node_tree", None))
    return found


def _of_node(node: Any) -> Needs:
    kind = node.bl_idname
    if kind == "ShaderNodeAttribute" and node.attribute_type in _INSTANCE_SOURCES:
        return Needs(values=frozenset({(_INSTANCE_SOURCES[node.attribute_type], node.attribute_name)}))
    if kind == "ShaderNodeParticleInfo":
        return Needs(particles=True)
    if kind == "ShaderNodeNewGeometry":
        return Needs(edges=any(node.outputs[name].is_linked for name in _OF_EDGES))
    names = frozenset(name for key in _NAMED_LAYERS if (name := getattr(node, key, "")))
    uses_tangents = ((kind == "ShaderNodeNormalMap" and node.space == "TANGENT")
                     or (kind == "ShaderNodeTangent" and node.direction_type == "UV_MAP"))
    return Needs(names, tangents=frozenset({node.uv_map}) if uses_tangents else frozenset())


def _trees() -> Iterator[Any]:
    yield from (m.node_tree for m in bpy.data.materials if m.node_tree)
    yield from (g for g in bpy.data.node_groups if g.type == "SHADER")
