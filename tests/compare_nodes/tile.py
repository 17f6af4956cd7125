# SPDX-License-Identifier: GPL-3.0-or-later
"""The material of one tile: nodes by short names, and the values that are swept over the tile's pixels.

Every pixel of a tile has a face of its own with constant UVs (stage.py), so that swept values are the same in both
engines wherever within the pixel they sample.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
from registry import Skip

Source = Callable[["Tile"], Any]


class Tile:
    """Builds into an empty node tree."""

    def __init__(self, material: bpy.types.Material, folder: str) -> None:
        material.use_nodes = True
        self.material, self.tree, self.folder = material, material.node_tree, folder
        self.tree.nodes.clear()
        self._known: dict[Any, Any] = {}
        self.displacement: Any = None

    def node(self, kind: str, inputs: dict | None = None, setup: Callable[[Any], None] | None = None, **properties):
        """Adds ShaderNode<kind>; inputs by identifier, name or number; values are constants, sockets or sources."""
        if not hasattr(bpy.types, "ShaderNode" + kind):
            raise Skip(f"no node {kind}")
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in properties.items():
            assign(node, name, value)
        if setup:
            setup(node)
        for key, value in (inputs or {}).items():
            self.feed(find(node.inputs, key), value)
        return node

    def output(self, node, key: Any = None):
        return find(node.outputs, key) if key is not None else next(o for o in node.outputs if o.enabled)

    def feed(self, socket, value: Any) -> None:
        if callable(value) and not isinstance(value, bpy.types.NodeSocket):
            value = value(self)
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif isinstance(value, tuple) and len(value) == 3 and socket.type == "RGBA":
            socket.default_value = (*value, 1.0)
        else:
            socket.default_value = value

    def known(self, key: Any, make: Callable[[], Any]) -> Any:
        if key not in self._known:
            self._known[key] = make()
        return self._known[key]

    def math(self, operation: str, *values: Any):
        return self.node("Math", dict(enumerate(values)), operation=operation).outputs[0]

    def vector(self, operation: str, *values: Any):
        """An operation of Vector Math; Scale's factor is its fourth input."""
        return self.output(self.node("VectorMath", dict(enumerate(values)), operation=operation))

    def displace(self, value, method: str = "BUMP") -> None:
        """Links the material's displacement; method: BUMP, DISPLACEMENT or BOTH."""
        self.displacement = value
        owner = self.material if hasattr(self.material, "displacement_method") else self.material.cycles
        assign(owner, "displacement_method", method)

    def emit(self, value) -> None:
        emission = self.node("Emission", {"Color": value, "Strength": 1.0})
        end = self.node("OutputMaterial")
        if self.displacement is not None:
            self.tree.links.new(self.displacement, end.inputs["Displacement"])
        self.tree.links.new(emission.outputs[0], end.inputs["Surface"])


def assign(owner: Any, name: str, value: Any) -> None:
    if not hasattr(owner, name):
        raise Skip(f"{owner.bl_rna.identifier} has no {name}")
    try:
        setattr(owner, name, value)
    except TypeError as error:
        if "enum" in str(error):
            raise Skip(f"{owner.bl_rna.identifier} has no {name} {value}") from None
        raise


def find(sockets: Any, key: Any):
    """A socket that can be used, by number, identifier or name."""
    if isinstance(key, int):
        return sockets[key]
    usable = [s for s in sockets if s.enabled and not s.is_unavailable]
    for socket in (*(s for s in usable if s.identifier == key), *(s for s in usable if s.name == key)):
        return socket
    raise Skip(f"no socket {key}")


# Values that change over the tile ------------------------------------------------------------------------------


def _layer(name: str, axis: int) -> Source:
    def source(tile: Tile):
        def make():
            uv = tile.known(("uv", name), lambda: tile.node("UVMap", uv_map=name).outputs[0])
            return tile.known(("split", name), lambda: tile.node("SeparateXYZ", {0: uv})).outputs[axis]

        return tile.known((name, axis), make)

    return source


def combined(x: Any, y: Any, z: Any) -> Source:
    def source(tile: Tile):
        return tile.known(("combined", x, y, z), lambda: tile.node("CombineXYZ", {0: x, 1: y, 2: z}).outputs[0])

    return source


def scaled(value: Any, low: float, high: float) -> Source:
    """A unit source, in [low, high]."""

    def source(tile: Tile):
        key = ("scaled", value, low, high)
        return tile.known(key, lambda: tile.math("MULTIPLY_ADD", value, high - low, low))

    return source


def op(operation: str, *values: Any) -> Source:
    return lambda tile: tile.known((operation, *values), lambda: tile.math(operation, *values))


def vector_op(operation: str, *values: Any) -> Source:
    return lambda tile: tile.known(("vector", operation, *values), lambda: tile.vector(operation, *values))


U, V = _layer("Wide", 0), _layer("Wide", 1)
"""Columns and rows of the tile, in [-2, 3]; one of each is 0."""
P, Q = _layer("Mixed", 0), _layer("Mixed", 1)
"""Two more numbers in [-2, 3], without order over the tile."""
U1, V1 = _layer("UVMap", 0), _layer("UVMap", 1)
P1, Q1 = _layer("MixedUnit", 0), _layer("MixedUnit", 1)
"""The same in [0, 1]."""
VEC, VEC2, VEC3 = combined(U, V, P), combined(Q, U, V), combined(P, Q, U)
COL, COL2 = combined(U1, V1, P1), combined(Q1, P1, V1)
WHOLE = combined(op("ROUND", op("MULTIPLY", U, 3.0)), op("ROUND", op("MULTIPLY", V, 3.0)), op("ROUND", P))
"""Whole numbers: for hashes, where the last bit of a number changes everything."""
UNIT = vector_op("NORMALIZE", combined(scaled(U1, -0.9, 0.9), scaled(V1, -0.8, 0.85), 1.0))
"""Unit vectors around +Z."""
AROUND = vector_op("NORMALIZE", combined(scaled(P1, -1.0, 1.0), scaled(U1, -1.0, 1.0), scaled(V1, -1.0, 1.0)))
"""Unit vectors of all directions."""
SMOOTH = _layer("Smooth", 0)
