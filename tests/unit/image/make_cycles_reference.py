# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes cycles_reference.txt: what Cycles' Image Texture gives for a small picture, at exact coordinates.

Run in Blender or in the bpy module, which must know the extension MIRROR (3.5 or later) to write all cases:
    python make_cycles_reference.py OUT.txt        (with bpy)
    blender -b --factory-startup --python make_cycles_reference.py -- OUT.txt
Every pixel shows one object; the object's colour carries the coordinates, so sampling does not blur them.
"""

from __future__ import annotations

import itertools
import os
import random
import struct
import sys
import tempfile
import zlib

import bpy

SIDE = 8
SIZE = (5, 3)
OFFSET = 2  # object colours cannot be negative


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def picture(folder: str, depth: str) -> tuple[str, list[int]]:
    """A PNG with straight alpha, written by hand so that nothing is converted; its values, bottom row first."""
    rng = random.Random(5)
    values = []
    for _ in range(SIZE[0] * SIZE[1]):
        values += [rng.randrange(256), rng.randrange(256), rng.randrange(256), rng.choice((0, 255, rng.randrange(256)))]
    width = 4 * SIZE[0]
    rows = [values[i : i + width] for i in range(0, len(values), width)][::-1]
    # Twice the byte is the same fraction in 16 bits.
    data = b"".join(b"\0" + bytes(v for value in row for v in [value] * (int(depth) // 8)) for row in rows)
    header = struct.pack(">IIBBBBB", *SIZE, int(depth), 6, 0, 0, 0)
    path = os.path.join(folder, f"a{depth}.png")
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
        file.write(chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))
    return path, values


def build(coordinates: list[tuple[float, float]]) -> bpy.types.Material:
    scene = bpy.context.scene
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    mesh = bpy.data.meshes.new("quad")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("m")
    material.use_nodes = True
    mesh.materials.append(material)
    for i, (u, v) in enumerate(coordinates):
        obj = bpy.data.objects.new(f"o{i}", mesh)
        obj.location = (i % SIDE, i // SIDE, 0)
        obj.color = (u + OFFSET, v + OFFSET, OFFSET, 1)
        scene.collection.objects.link(obj)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = SIDE
    camera.location = (SIDE / 2, SIDE / 2, 5)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.world = None
    return material


def nodes(tree: bpy.types.NodeTree, image: bpy.types.Image, interpolation: str, extension: str, output: str) -> None:
    tree.nodes.clear()
    info = tree.nodes.new("ShaderNodeObjectInfo")
    texture = tree.nodes.new("ShaderNodeTexImage")
    emission = tree.nodes.new("ShaderNodeEmission")
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    texture.image = image
    texture.interpolation = interpolation
    texture.extension = extension
    subtract = tree.nodes.new("ShaderNodeVectorMath")
    subtract.operation = "SUBTRACT"
    subtract.inputs[1].default_value = (OFFSET, OFFSET, OFFSET)
    tree.links.new(info.outputs["Color"], subtract.inputs[0])
    tree.links.new(subtract.outputs[0], texture.inputs["Vector"])
    tree.links.new(emission.outputs[0], out.inputs["Surface"])
    tree.links.new(texture.outputs["Alpha" if output == "alpha" else "Color"], emission.inputs["Color"])
    if output == "straight":
        # Linking Alpha changes the colour: it is divided by alpha. The strength is divided out again.
        add = tree.nodes.new("ShaderNodeMath")
        add.operation = "ADD"
        add.inputs[1].default_value = 1
        tree.links.new(texture.outputs["Alpha"], add.inputs[0])
        tree.links.new(add.outputs[0], emission.inputs["Strength"])


def render(folder: str) -> list[float]:
    scene = bpy.context.scene
    scene.render.filepath = os.path.join(folder, "out.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    pixels = list(image.pixels)
    bpy.data.images.remove(image)
    return pixels


def coordinates() -> list[tuple[float, float]]:
    rng = random.Random(7)
    # Multiples of 1/1024, so that the offset can be taken off exactly.
    return [(rng.randrange(-1600, 2600) / 1024, rng.randrange(-1600, 2600) / 1024) for _ in range(SIDE * SIDE)]


def cases() -> list[tuple[str, str, str, str, str]]:
    extensions = ["REPEAT", "EXTEND", "CLIP"] + (["MIRROR"] if bpy.app.version >= (3, 5, 0) else [])
    interpolations = ("Closest", "Linear", "Cubic")
    out = [("8", "sRGB", "CHANNEL_PACKED", i, e) for i, e in itertools.product(interpolations, extensions)]
    modes = ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE")
    for depth, space, alpha in itertools.product(("8", "16"), ("sRGB", "Non-Color", "Filmic Log"), modes):
        out.append((depth, space, alpha, "Linear", "REPEAT"))
    return out


def main(path: str) -> None:
    points = coordinates()
    with tempfile.TemporaryDirectory() as folder, open(path, "w", encoding="ascii") as file:
        files = {depth: picture(folder, depth) for depth in ("8", "16")}
        material = build(points)
        file.write(f"# Cycles of Blender {bpy.app.version_string}; written by make_cycles_reference.py\n")
        file.write(f"{SIZE[0]} {SIZE[1]}\n" + " ".join(map(str, files["8"][1])) + "\n")
        file.write(" ".join(f"{x:.9g}" for point in points for x in point) + "\n")
        for depth, space, alpha, interpolation, extension in cases():
            image = bpy.data.images.load(files[depth][0])
            image.colorspace_settings.name = space
            image.alpha_mode = alpha
            result = {}
            for output in ("associated", "straight", "alpha"):
                nodes(material.node_tree, image, interpolation, extension, output)
                result[output] = render(folder)
            file.write(f"{depth} {space.replace(' ', '_')} {alpha} {interpolation} {extension}\n")
            row: list[float] = []
            for i in range(SIDE * SIDE):
                a = result["alpha"][4 * i]
                row += result["associated"][4 * i : 4 * i + 3]
                row += [c / (1 + a) for c in result["straight"][4 * i : 4 * i + 3]]
                row.append(a)
            file.write(" ".join(f"{x:.5g}" for x in row) + "\n")
            bpy.data.images.remove(image)


if __name__ == "__main__":
    main(sys.argv[-1])
