# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes (inside Blender): pictures that are damaged, odd, missing in part, or too large."""

import tempfile
from pathlib import Path

import bpy
import numpy as np
from odd_files import GREY, cmyk_tiff, png
from scene_kit import (
    ENGINE,
    add_square,
    case,
    emission,
    image_emission,
    output_of,
    reset,
    square_with,
)

SRGB_HALF = 188  # of 255: 0.5 scene-linear


_FOLDER = tempfile.TemporaryDirectory()  # Blender's own is emptied when a file is opened


def folder() -> Path:
    return Path(_FOLDER.name)


def shown(path: Path, *, raw: bool = False) -> bpy.types.Image:
    """A square that emits the file's colours beside a good one: left the file, right the known light."""
    image = bpy.data.images.load(str(path))
    if raw:
        image.colorspace_settings.name = "Non-Color"
    beside(image_emission("Under test", image))
    return image


def beside(material: bpy.types.Material) -> None:
    for name, x, given in (("Left", -1, material), ("Right", 1, emission("Light"))):
        obj = add_square(name)
        obj.location.x = x
        obj.data.materials.append(given)


@case
def truncated_png():
    reset()
    path = png(folder() / "cut.png", 64, 64, bytes((255, 0, 0)))
    path.write_bytes(path.read_bytes()[:60])
    shown(path)


@case
def empty_file():
    reset()
    path = folder() / "empty.png"
    path.write_bytes(b"")
    shown(path)


@case
def image_of_no_size():
    reset()
    shown(png(folder() / "none.png", 0, 0, b""))


@case
def sixteen_bit_png():
    reset()
    shown(png(folder() / "deep.png", 8, 8, b"\x80\x00\x40\x00\x00\x00", bits=16), raw=True)


@case
def grey_png():
    reset()
    shown(png(folder() / "grey.png", 8, 8, bytes((SRGB_HALF,)), color=GREY))


@case
def cmyk_picture():
    reset()
    shown(cmyk_tiff(folder() / "inks.tif", 8, 8, (0, 255, 255, 0)))


@case
def nan_in_an_hdri():
    """A world whose picture has a hole of NaN and infinity; the rest is white."""
    scene = reset(samples=16)
    image = bpy.data.images.new("hole", 64, 32, float_buffer=True)
    pixels = np.ones((32, 64, 4), np.float32)
    pixels[10:14, 10:14, :3], pixels[20:22, 30:32, :3] = np.nan, np.inf
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = str(folder() / "hole.exr"), "OPEN_EXR"
    image.save()
    bpy.data.images.remove(image)
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    node = tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = bpy.data.images.load(str(folder() / "hole.exr"))
    background = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBackground")
    tree.links.new(node.outputs[0], background.inputs[0])
    material = emission("Grey")
    diffuse = material.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs[0].default_value = (0.5, 0.5, 0.5, 1)
    material.node_tree.links.new(diffuse.outputs[0], output_of(material.node_tree).inputs["Surface"])
    square_with(material)


@case
def missing_tiles():
    """Tiles 1001 and 1002 are listed, only 1001 has a file: red on the left half, magenta on the right."""
    reset()
    png(folder() / "skin.1001.png", 8, 8, bytes((255, 0, 0)))
    image = bpy.data.images.new("skin", 8, 8, tiled=True)
    image.filepath = str(folder() / "skin.<UDIM>.png")
    image.tiles.new(1002)
    square = square_with(image_emission("Tiled", image))
    for loop in square.data.uv_layers[0].data:
        loop.uv.x *= 2


@case
def textures_over_the_memory_bound():
    """Eight pictures of 16 MB each, a bound of 16 MB: all are read through the cache."""
    scene = reset()
    if ENGINE == "CARDIOID":
        scene.cardioid.texture_cache = 16
    for number in range(8):
        path = png(folder() / f"large{number}.png", 2048, 2048, bytes((255, 0, 0)))
        obj = add_square(f"Square {number}", size=0.25)
        obj.location = (-0.75 + 0.5 * (number % 4), 0.5 - number // 4, 0)
        obj.data.materials.append(image_emission(f"Large {number}", bpy.data.images.load(str(path))))


@case
def library_that_is_gone():
    """A linked object, its material and its image, whose file was removed: the rest renders."""
    lib = folder() / "lib.blend"
    reset()
    add_square("Linked").data.materials.append(emission("Linked material"))
    bpy.data.libraries.write(str(lib), {bpy.data.objects["Linked"]})
    reset()
    square_with(emission("Light"))
    with bpy.data.libraries.load(str(lib), link=True) as (source, target):
        target.objects = list(source.objects)
    bpy.context.scene.collection.objects.link(target.objects[0])
    path = folder() / "user.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    lib.unlink()
    bpy.ops.wm.open_mainfile(filepath=str(path))
