# SPDX-License-Identifier: GPL-3.0-or-later
"""Mapping, Vector Rotate, Vector Transform, Normal, and the conversions between sockets, groups and muted nodes."""

from __future__ import annotations

from itertools import product
from typing import Any

import bpy
from mathutils import Vector
from registry import case, row
from tile import AROUND, COL, P1, Q1, U1, UNIT, V1, VEC, VEC2, P, U, V, combined, op, scaled

TURN = (0.4, -0.7, 1.1)
for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL"):
    moved = {"Vector": VEC, "Rotation": TURN, "Scale": (1.5, 0.7, -1.2)}
    if kind in ("POINT", "TEXTURE"):
        moved["Location"] = (0.3, -0.2, 0.5)
    row(f"mapping/{kind}", "Mapping", moved, vector_type=kind)
    row(f"mapping/{kind}/linked", "Mapping", {**moved, "Rotation": VEC2, "Scale": combined(V, P, U)}, vector_type=kind)
row("mapping/zero scale", "Mapping", {"Vector": VEC, "Scale": (0.0, 1.0, 2.0)}, vector_type="TEXTURE")
row("mapping/constants", "Mapping", {"Vector": (0.2, 0.5, -0.4), "Rotation": TURN, "Scale": (2.0, 1.0, 0.5)})

for kind, invert in product(("AXIS_ANGLE", "X_AXIS", "Y_AXIS", "Z_AXIS", "EULER_XYZ"), (False, True)):
    turn: dict[str, Any] = {"Vector": VEC, "Center": (0.3, -0.4, 0.2)}
    turn |= {"Rotation": VEC2} if kind == "EULER_XYZ" else {"Angle": scaled(P1, -3.0, 4.0)}
    turn |= {"Axis": (0.5, -0.3, 0.8)} if kind == "AXIS_ANGLE" else {}
    row(f"vector rotate/{kind}{'/invert' if invert else ''}", "VectorRotate", turn, rotation_type=kind, invert=invert)
row("vector rotate/axis linked", "VectorRotate", {"Vector": VEC, "Axis": VEC2, "Angle": U})
row("vector rotate/no axis", "VectorRotate", {"Vector": VEC, "Axis": (0.0, 0.0, 0.0), "Angle": U})

SPACES = ("WORLD", "OBJECT", "CAMERA")
for kind, old, new in product(("POINT", "VECTOR", "NORMAL"), SPACES, SPACES):
    row(f"vector transform/{kind}/{old} to {new}", "VectorTransform", {"Vector": VEC}, stage="placed",
        vector_type=kind, convert_from=old, convert_to=new)  # fmt: skip


def direction(node) -> None:
    node.outputs[0].default_value = Vector((0.4, -0.5, 0.7)).normalized()


row("normal/normal", "Normal", {"Normal": VEC}, "Normal", setup=direction)
row("normal/dot", "Normal", {"Normal": VEC}, "Dot", setup=direction)
row("normal/dot unit", "Normal", {"Normal": AROUND}, "Dot", setup=direction)

for mode in ("RGB", "HSV", "HSL"):
    for i in range(3):
        row(f"separate color/{mode}/{i}", "SeparateColor", {0: COL}, i, mode=mode)
    row(f"separate color/{mode}/wide", "SeparateColor", {0: VEC}, 0, mode=mode)
    row(f"combine color/{mode}", "CombineColor", {0: U1, 1: V1, 2: P1}, mode=mode)
    row(f"combine color/{mode}/wide", "CombineColor", {0: U, 1: V, 2: P}, mode=mode)
    row(f"combine color/{mode}/constant", "CombineColor", {0: 0.3, 1: 0.6, 2: 0.8}, mode=mode)
for i in range(3):
    row(f"separate xyz/{i}", "SeparateXYZ", {0: VEC}, i)
    row(f"separate rgb/{i}", "SeparateRGB", {0: COL}, i)
    row(f"separate hsv/{i}", "SeparateHSV", {0: COL}, i)
row("combine xyz", "CombineXYZ", {0: U, 1: -0.5, 2: P})
row("combine rgb", "CombineRGB", {0: U, 1: 0.25, 2: P})
row("combine hsv", "CombineHSV", {0: U1, 1: V1, 2: P1})


# Conversions: what a link of one type means at a socket of another ------------------------------------------------


@case("convert/color to number", "Math")
def color_to_number(tile):
    color = tile.node("MixRGB", {"Fac": 0.3, "Color1": VEC, "Color2": COL}).outputs[0]
    return tile.math("ADD", color, 0.0)


@case("convert/vector to number", "Math")
def vector_to_number(tile):
    return tile.math("ADD", VEC, 0.0)


@case("convert/number to vector", "VectorMath")
def number_to_vector(tile):
    return tile.vector("MULTIPLY", U, (1.0, -2.0, 0.5))


@case("convert/number to color", "MixRGB")
def number_to_color(tile):
    return tile.node("MixRGB", {"Fac": 0.4, "Color1": U, "Color2": (0.1, 0.5, 0.9)}).outputs[0]


@case("convert/color to vector", "VectorMath")
def color_to_vector(tile):
    color = tile.node("MixRGB", {"Fac": 0.4, "Color1": COL, "Color2": (0.1, 0.5, 0.9)}).outputs[0]
    return tile.vector("ADD", color, (0.1, 0.2, 0.3))


@case("convert/constant color to number", "RGB")
def constant_color_to_number(tile):
    color = tile.node("RGB")
    color.outputs[0].default_value = (0.9, 0.4, 0.1, 1.0)
    return tile.math("MULTIPLY", color.outputs[0], U)


# Groups, reroutes, muted nodes and links --------------------------------------------------------------------------


def socket(tree, name: str, kind: str, out: bool):
    """Adds a socket to a group's outside."""
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out="OUTPUT" if out else "INPUT", socket_type=kind)
    return (tree.outputs if out else tree.inputs).new(kind, name)


def group(tile, name: str, kind: str = "NodeSocketFloat") -> tuple[Any, Any]:
    """A group that multiplies its input by 1.5 and adds another, which is 0.25 unless linked."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    socket(tree, "Value", kind, False)
    socket(tree, "Other", "NodeSocketFloat", False).default_value = 0.25
    socket(tree, "Result", "NodeSocketFloat", True)
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    work = tree.nodes.new("ShaderNodeMath")
    work.operation = "MULTIPLY_ADD"
    work.inputs[1].default_value = 1.5
    tree.links.new(start.outputs[0], work.inputs[0])
    tree.links.new(start.outputs[1], work.inputs[2])
    tree.links.new(work.outputs[0], end.inputs[0])
    node = tile.node("Group", node_tree=tree)
    node.inputs["Other"].default_value = 0.25
    return node, tree


@case("group/linked", "Group")
def group_linked(tile):
    node, _ = group(tile, "linked")
    tile.feed(node.inputs[0], U)
    tile.feed(node.inputs[1], V)
    return node.outputs[0]


@case("group/own value", "Group")
def group_own_value(tile):
    node, _ = group(tile, "own value")
    tile.feed(node.inputs[0], U)
    node.inputs[1].default_value = -0.75
    return node.outputs[0]


@case("group/converts", "Group")
def group_converts(tile):
    """A vector into a colour socket into a number."""
    node, _ = group(tile, "converts", "NodeSocketColor")
    tile.feed(node.inputs[0], VEC)
    return node.outputs[0]


@case("group/nested twice", "Group")
def group_nested(tile):
    node, tree = group(tile, "inner")
    outer = bpy.data.node_groups.new("outer", "ShaderNodeTree")
    socket(outer, "Value", "NodeSocketVector", False)
    socket(outer, "Result", "NodeSocketColor", True)
    start, end = outer.nodes.new("NodeGroupInput"), outer.nodes.new("NodeGroupOutput")
    first, second = (outer.nodes.new("ShaderNodeGroup") for _ in range(2))
    first.node_tree = second.node_tree = tree
    first.inputs[1].default_value = second.inputs[1].default_value = -0.5
    outer.links.new(start.outputs[0], first.inputs[0])
    outer.links.new(first.outputs[0], second.inputs[0])
    outer.links.new(second.outputs[0], end.inputs[0])
    tile.tree.nodes.remove(node)
    node = tile.node("Group", node_tree=outer)
    tile.feed(node.inputs[0], VEC2)
    return node.outputs[0]


@case("reroute/chain", "Math")
def reroute_chain(tile):
    first, second = (tile.tree.nodes.new("NodeReroute") for _ in range(2))
    tile.feed(first.inputs[0], VEC)
    tile.tree.links.new(first.outputs[0], second.inputs[0])
    return tile.math("ADD", second.outputs[0], 0.5)


@case("muted/math", "Math")
def muted_math(tile):
    node = tile.node("Math", {0: U, 1: V}, operation="MULTIPLY")
    node.mute = True
    return node.outputs[0]


@case("muted/mix", "MixRGB")
def muted_mix(tile):
    node = tile.node("MixRGB", {"Fac": 0.7, "Color1": COL, "Color2": VEC})
    node.mute = True
    return node.outputs[0]


@case("muted/converts", "Noise")
def muted_converts(tile):
    """A muted texture hands on nothing: what it is linked to uses its own value."""
    node = tile.node("TexNoise", {"Vector": VEC})
    node.mute = True
    mix = tile.node("MixRGB", {"Fac": node.outputs[0], "Color1": COL, "Color2": VEC})
    mix.inputs["Fac"].default_value = 0.3
    return mix.outputs[0]


@case("muted/group", "Group")
def muted_group(tile):
    node, _ = group(tile, "muted")
    tile.feed(node.inputs[0], U)
    node.mute = True
    return node.outputs[0]


@case("muted/link", "Math")
def muted_link(tile):
    node = tile.node("Math", {0: U, 1: V}, operation="ADD")
    node.inputs[1].links[0].is_muted = True
    node.inputs[1].default_value = 0.3
    return node.outputs[0]


@case("chain/deep", "Math")
def deep_chain(tile):
    """Forty operations one after another."""
    value: Any = U
    for i in range(40):
        value = tile.math("MULTIPLY_ADD", value, 0.9 if i % 2 else 1.1, V if i % 3 else Q1)
    return value


row("convert/unit to color", "MixRGB", {"Fac": op("FRACT", U), "Color1": UNIT, "Color2": U})
