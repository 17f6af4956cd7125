# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes (inside Blender): node trees with wrong links, odd ramps and curves, too many or unknown nodes."""

import bpy
from scene_kit import case, emission, output_of, reset, square_with


def light_of(material: bpy.types.Material) -> bpy.types.Node:
    return next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeEmission")


def lit_by(name: str, kind: str):
    """An emitting square whose colour comes from a new node of this type; returns the node and its tree."""
    material = emission(name)
    tree = material.node_tree
    node = tree.nodes.new(kind)
    tree.links.new(node.outputs[0], light_of(material).inputs["Color"])
    square_with(material)
    return node, tree


@case
def shader_into_a_colour():
    """What a shader is linked to takes its own value, as in Cycles."""
    reset()
    lit_by("Wrong type", "ShaderNodeBsdfDiffuse")


@case
def colour_into_the_surface():
    """Cycles makes an emission of a colour that is linked to a shader."""
    reset()
    material = emission("Colour as surface")
    node = material.node_tree.nodes.new("ShaderNodeRGB")
    node.outputs[0].default_value = (0.25, 0.5, 0.75, 1)
    material.node_tree.links.new(node.outputs[0], output_of(material.node_tree).inputs["Surface"])
    square_with(material)


@case
def link_from_a_hidden_socket():
    """The vector output of a node that was switched to another mode: the link is there and has no effect."""
    reset()
    node, tree = lit_by("Hidden socket", "ShaderNodeVectorMath")
    light = light_of(bpy.data.materials["Hidden socket"])
    node.operation = "ADD"
    tree.links.new(node.outputs["Vector"], light.inputs["Color"])
    node.operation = "LENGTH"


@case
def link_of_a_tree_to_itself():
    reset()
    node, tree = lit_by("Own tail", "ShaderNodeMixRGB")
    node.inputs["Fac"].default_value = 0
    node.inputs["Color1"].default_value = (0.25, 0.5, 0.75, 1)
    tree.links.new(node.outputs[0], node.inputs["Color2"])


def new_output(tree: bpy.types.NodeTree, kind: str) -> None:
    if hasattr(tree, "interface"):
        tree.interface.new_socket("Out", in_out="OUTPUT", socket_type=kind)
    else:
        tree.outputs.new(kind, "Out")


def new_input(tree: bpy.types.NodeTree, kind: str) -> None:
    if hasattr(tree, "interface"):
        tree.interface.new_socket("In", in_out="INPUT", socket_type=kind)
    else:
        tree.inputs.new(kind, "In")


def chain(tree: bpy.types.NodeTree, first: bpy.types.NodeSocket, nodes: list[bpy.types.Node]) -> bpy.types.NodeSocket:
    """Links each node's first input to what comes before; returns the end."""
    for node in nodes:
        tree.links.new(first, node.inputs[0])
        first = node.outputs[0]
    return first


@case
def ten_thousand_nodes():
    """A hundred groups of a hundred additions, one behind the other: each adds a ten thousandth, the last gives one."""
    reset()
    group = bpy.data.node_groups.new("Hundred", "ShaderNodeTree")
    new_input(group, "NodeSocketFloat"), new_output(group, "NodeSocketFloat")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    additions = [group.nodes.new("ShaderNodeMath") for _ in range(100)]
    for node in additions:
        node.inputs[1].default_value = 1e-4
    group.links.new(chain(group, start.outputs[0], additions), end.inputs[0])
    first, tree = lit_by("Chain", "ShaderNodeValue")
    first.outputs[0].default_value = 0
    users = [tree.nodes.new("ShaderNodeGroup") for _ in range(100)]
    for user in users:
        user.node_tree = group
    last = chain(tree, first.outputs[0], users)
    tree.links.new(last, light_of(bpy.data.materials["Chain"]).inputs["Color"])


@case
def ramp_with_one_stop():
    reset()
    node, _ = lit_by("One stop", "ShaderNodeValToRGB")
    node.color_ramp.elements.remove(node.color_ramp.elements[0])
    node.color_ramp.elements[0].color = (0.25, 0.5, 0.75, 1)


@case
def ramp_with_equal_stops():
    reset()
    node, _ = lit_by("Equal stops", "ShaderNodeValToRGB")
    for element in node.color_ramp.elements:
        element.position, element.color = 0.5, (0.25, 0.5, 0.75, 1)


@case
def curve_with_equal_points():
    """All points in one place: there is no range to map, but the picture is finite."""
    reset()
    node, _ = lit_by("Equal points", "ShaderNodeRGBCurve")
    node.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
    for curve in node.mapping.curves:
        for point in curve.points:
            point.location = (0.5, 0.5)
    node.mapping.update()


@case
def curve_with_equal_places():
    """Two points above one another, as a step."""
    reset()
    node, _ = lit_by("Step", "ShaderNodeFloatCurve")
    node.inputs["Value"].default_value = 0.75
    curve = node.mapping.curves[0]
    curve.points.new(0.5, 0.2)
    curve.points.new(0.5, 0.8)
    node.mapping.update()


class NewNode(bpy.types.ShaderNodeCustomGroup):
    """Stands for a node of a newer Blender: registered while it is added, unknown when it is rendered."""

    bl_idname = "ShaderNodeOfTomorrow"
    bl_label = "Tomorrow"


@case
def node_of_a_newer_blender():
    """Its link has no effect: the emission keeps its own colour."""
    reset()
    bpy.utils.register_class(NewNode)
    material = emission("From the future")
    square_with(material)
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeOfTomorrow")
    node.name = "Tomorrow"
    group = bpy.data.node_groups.new("Inside", "ShaderNodeTree")
    new_output(group, "NodeSocketColor")
    node.node_tree = group
    tree.links.new(node.outputs[0], light_of(material).inputs["Color"])
    bpy.utils.unregister_class(NewNode)
