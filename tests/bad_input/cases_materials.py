# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes (inside Blender): images, UV maps, material slots and node trees."""

from pathlib import Path

import bpy
import numpy as np
from scene_kit import (
    add_mesh,
    add_square,
    case,
    emission,
    image_emission,
    lit_world,
    node_material,
    output_of,
    reset,
    square_with,
)

NAN = float("nan")


def two_colours(name: str) -> bpy.types.Image:
    """16×16, left half (1, 0, 0), right half (0, 0, 1): the same in every colour space of interest."""
    image = bpy.data.images.new(name, 16, 16)
    pixels = np.zeros((16, 16, 4), np.float32)
    pixels[:, :8, 0] = pixels[:, 8:, 2] = pixels[..., 3] = 1
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image


@case
def missing_image():
    reset()
    image = bpy.data.images.new("gone.png", 4, 4)
    image.source = "FILE"
    image.filepath = "/nowhere/at/all/gone.png"
    square_with(image_emission("Lost", image))


@case
def image_node_without_image():
    reset()
    square_with(image_emission("No image", None))


@case
def file_that_is_no_image():
    reset()
    path = Path(bpy.app.tempdir) / "text.png"
    path.write_text("this is no picture")
    square_with(image_emission("Text", bpy.data.images.load(str(path))))


@case
def packed_image():
    reset()
    image = two_colours("packed")
    image.filepath_raw = str(Path(bpy.app.tempdir) / "packed.png")
    image.file_format = "PNG"
    image.save()
    image.source = "FILE"
    image.pack()
    Path(image.filepath_raw).unlink()
    square_with(image_emission("Packed", image))


@case
def painted_image():
    reset()
    square_with(image_emission("Painted", two_colours("painted")))


@case
def generated_image():
    reset()
    image = bpy.data.images.new("generated", 32, 32)
    image.generated_color = (0, 1, 0, 1)
    square_with(image_emission("Generated", image))


def normal_mapped(name: str) -> bpy.types.Material:
    """Diffuse under a tangent-space normal map that needs usable UVs."""
    material = node_material(name)
    tree = material.node_tree
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
    normal = tree.nodes.new("ShaderNodeNormalMap")
    normal.inputs["Color"].default_value = (0.7, 0.6, 0.9, 1)
    tree.links.new(normal.outputs[0], diffuse.inputs["Normal"])
    tree.links.new(diffuse.outputs[0], output_of(tree).inputs["Surface"])
    return material


@case
def degenerate_uvs():
    reset(samples=16)
    lit_world()
    obj = square_with(normal_mapped("Mapped"))
    for loop in obj.data.uv_layers[0].data:
        loop.uv = (0.25, 0.25)


@case
def nan_uvs():
    reset(samples=16)
    lit_world()
    obj = square_with(normal_mapped("Mapped"))
    for loop in obj.data.uv_layers[0].data:
        loop.uv = (NAN, NAN)


@case
def no_uv_map():
    reset()
    obj = square_with(image_emission("Unmapped", two_colours("unmapped")))
    obj.data.uv_layers.remove(obj.data.uv_layers[0])


@case
def slot_without_material():
    reset(samples=16)
    lit_world()
    vertices = [(-1, -1, 0), (0, -1, 0), (0, 1, 0), (-1, 1, 0), (1, -1, 0), (1, 1, 0)]
    obj = add_mesh("Two slots", vertices, [(0, 1, 2, 3), (1, 4, 5, 2)])
    obj.data.materials.append(None)
    obj.data.materials.append(emission("Light"))
    obj.data.polygons[1].material_index = 1


@case
def slot_index_out_of_range():
    reset()
    obj = square_with(emission("Light"))
    obj.data.polygons[0].material_index = 7


@case
def loop_through_groups():
    """A group whose output feeds its own input, through a reroute outside it."""
    reset()
    group = bpy.data.node_groups.new("Circle", "ShaderNodeTree")
    group.inputs.new("NodeSocketColor", "In")
    group.outputs.new("NodeSocketColor", "Out")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    group.links.new(start.outputs[0], end.inputs[0])
    material = emission("Looped")
    tree = material.node_tree
    light = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeEmission")
    user, reroute = tree.nodes.new("ShaderNodeGroup"), tree.nodes.new("NodeReroute")
    user.node_tree = group
    tree.links.new(user.outputs[0], reroute.inputs[0])
    tree.links.new(reroute.outputs[0], user.inputs[0])
    tree.links.new(user.outputs[0], light.inputs["Color"])
    square = square_with(material)
    square.location.x = -1
    add_square("Beside").location.x = 1
    bpy.data.objects["Beside"].data.materials.append(emission("Light"))


@case
def group_inside_itself():
    reset()
    outer = bpy.data.node_groups.new("Outer", "ShaderNodeTree")
    inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    for tree, content in ((outer, inner), (inner, outer)):
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = content
    material = emission("Nested")
    material.node_tree.nodes.new("ShaderNodeGroup").node_tree = outer
    square_with(material)


@case
def empty_node_group():
    reset()
    material = emission("Empty group")
    group = material.node_tree.nodes.new("ShaderNodeGroup")
    light = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeEmission")
    group.node_tree = bpy.data.node_groups.new("Void", "ShaderNodeTree")
    group.node_tree.outputs.new("NodeSocketColor", "Out")
    material.node_tree.links.new(group.outputs[0], light.inputs["Color"])
    square = square_with(material)
    square.location.x = -1
    add_square("Beside").location.x = 1
    bpy.data.objects["Beside"].data.materials.append(emission("Light"))


@case
def unknown_node():
    reset()
    material = emission("Strange")
    tree = material.node_tree
    light = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeEmission")
    strange = tree.nodes.new("ShaderNodeTexPointDensity")
    tree.links.new(strange.outputs["Density"], light.inputs["Strength"])
    for name, x in (("First", -1), ("Second", 1)):
        obj = add_square(name)
        obj.location.x = x
        obj.data.materials.append(material if x < 0 else emission("Light"))


@case
def material_without_output():
    reset(samples=16)
    lit_world()
    material = bpy.data.materials.new("No output")
    material.use_nodes = True
    material.node_tree.nodes.clear()
    square_with(material)
