# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of shading nodes as Cycles computes them, for golden_test.cpp.

    blender -b --factory-startup -P tests/unit/nodes/make_golden.py -- tests/unit/nodes/golden/blender_3_4.json
    python tests/unit/nodes/make_golden.py -- tests/unit/nodes/golden/blender_5_0.json        (with the bpy wheel)

Every case is one small tilted tile with an emission of the node's output, 4×4 pixels, one sample; all tiles are in
one picture. A second picture with the positions tells where exactly Cycles sampled. The graph of each case is written
as the add-on exports it.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Vector

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "..", "addon"))
sys.path.insert(0, HERE)

from golden_cases import cases  # noqa: E402

TILE = 4  # pixels
SIZE = 2.0  # of a tile, in scene units
VERSION = tuple(bpy.app.version)


class Tile:
    """The material of one case."""

    def __init__(self, case: dict, center: tuple[float, float]) -> None:
        self.case = case
        self.material = bpy.data.materials.new(case["name"])
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.tree.nodes.clear()
        self.center = center
        self._sources: dict[str, object] = {}

    def new(self, kind: str, **params: object):
        node = self.tree.nodes.new(kind)
        for key, value in params.items():
            setattr(node, key, value)
        return node

    def link(self, a, b) -> None:
        self.tree.links.new(a, b)

    def vector(self):
        """Position relative to about the tile's centre: x, y in [-1, 1], z in [-0.5, 0.5]."""
        if "v" not in self._sources:
            geometry = self.new("ShaderNodeNewGeometry")
            minus = self.new("ShaderNodeVectorMath", operation="SUBTRACT")
            minus.inputs[1].default_value = (self.center[0] + 0.0137, self.center[1] - 0.0291, 0.0)
            self.link(geometry.outputs["Position"], minus.inputs[0])
            self._sources["v"] = minus.outputs["Vector"]
        return self._sources["v"]

    def source(self, word: str):
        """v: vector; x y z: components; u: (x + 1)/2; c: colour; n: unit vector around +z; f: whole numbers."""
        if word in self._sources:
            return self._sources[word]
        vector = self.vector()
        if word in "xyz":
            split = self.new("ShaderNodeSeparateXYZ")
            self.link(vector, split.inputs[0])
            out = split.outputs["xyz".index(word)]
        elif word == "u":
            half = self.new("ShaderNodeMath", operation="MULTIPLY_ADD")
            half.inputs[1].default_value = half.inputs[2].default_value = 0.5
            self.link(self.source("x"), half.inputs[0])
            out = half.outputs[0]
        elif word == "c":
            half = self.new("ShaderNodeVectorMath", operation="MULTIPLY_ADD")
            half.inputs[1].default_value = half.inputs[2].default_value = (0.5, 0.5, 0.5)
            self.link(vector, half.inputs[0])
            out = half.outputs[0]
        elif word == "f":
            big = self.new("ShaderNodeVectorMath", operation="SCALE")
            big.inputs["Scale"].default_value = 4.0
            self.link(vector, big.inputs[0])
            whole = self.new("ShaderNodeVectorMath", operation="FLOOR")
            self.link(big.outputs[0], whole.inputs[0])
            out = whole.outputs[0]
        elif word == "n":
            up = self.new("ShaderNodeVectorMath", operation="ADD")
            up.inputs[1].default_value = (0.0, 0.0, 1.0)
            self.link(vector, up.inputs[0])
            unit = self.new("ShaderNodeVectorMath", operation="NORMALIZE")
            self.link(up.outputs[0], unit.inputs[0])
            out = unit.outputs[0]
        else:
            out = vector
        self._sources[word] = out
        return out

    def build(self) -> None:
        node = self.new(self.case["type"], **self.case.get("params", {}))
        if "setup" in self.case:
            self.case["setup"](node)
        for identifier, value in self.case.get("inputs", {}).items():
            socket = next(s for s in node.inputs if s.identifier == identifier)
            if isinstance(value, str):
                self.link(self.source(value), socket)
            else:
                socket.default_value = value
        result = next(s for s in node.outputs if s.identifier == self.case["output"])
        emission = self.new("ShaderNodeEmission")
        output = self.new("ShaderNodeOutputMaterial")
        self.link(result, emission.inputs["Color"])
        self.link(emission.outputs[0], output.inputs["Surface"])
        self.emission = emission

    def show_position(self) -> None:
        geometry = self.new("ShaderNodeNewGeometry")
        self.link(geometry.outputs["Position"], self.emission.inputs["Color"])


def add_plane(tile: Tile) -> None:
    """A turned and stretched object whose corners are those of the tile (golden_tile.h builds the same)."""
    mesh = bpy.data.meshes.new(tile.case["name"])
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    matrix = Matrix.Translation((*tile.center, 0)) @ Matrix.Rotation(0.4, 4, "Z") @ Matrix.Diagonal((1.5, 0.8, 1.2, 1))
    inverse = matrix.inverted()
    world = [Vector((tile.center[0] + x, tile.center[1] + y, 0.3 * x + 0.2 * y)) for x, y in corners]
    mesh.from_pydata([inverse @ p for p in world], [], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new(name="UVMap")
    for loop, (x, y) in zip(layer.data, corners):
        loop.uv = (x * 0.7 + y * 0.2, y * 0.6)
    colors = mesh.color_attributes.new("Col", "FLOAT_COLOR", "POINT")
    for k, entry in enumerate(colors.data):
        entry.color = (0.2 * k, 0.9 - 0.1 * k, 0.3, 1 - 0.2 * k)
    mesh.materials.append(tile.material)
    item = bpy.data.objects.new(tile.case["name"], mesh)
    item.matrix_world = matrix
    item.pass_index = 7
    bpy.context.collection.objects.link(item)


def set_up_render(columns: int, rows: int) -> None:
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01
    scene.cycles.max_bounces = 0
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
    scene.render.resolution_x, scene.render.resolution_y = columns * TILE, rows * TILE
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    scene.world = None
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type = "ORTHO"
    camera.data.sensor_fit = "HORIZONTAL"
    camera.data.ortho_scale = columns * SIZE
    camera.location = (0, 0, 10)
    scene.collection.objects.link(camera)
    scene.camera = camera


def render() -> np.ndarray:
    scene = bpy.context.scene
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "golden.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
        image.pixels.foreach_get(pixels)
        shape = (image.size[1], image.size[0], 4)
        bpy.data.images.remove(image)
    return pixels.reshape(shape)[..., :3]


def graph_of(tile: Tile) -> dict:
    from cardioid.export.graph import GraphWalk
    from cardioid.export.image import Images

    graph = GraphWalk(tile.case["name"], tile.tree, Images(None, 1, []), lambda message: None).run()
    if VERSION >= (5, 0):
        for node in graph["nodes"]:
            if node["type"] == "ShaderNodeTexVoronoi":
                node["params"].setdefault("version", 2)
    return graph


def rounded(values: np.ndarray) -> list[float]:
    return [float(f"{v:.8g}") for v in values.reshape(-1)]


def main() -> None:
    target = sys.argv[sys.argv.index("--") + 1]
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    todo = [case for case in cases(VERSION) if hasattr(bpy.types, case["type"])]
    columns = 16
    rows = (len(todo) + columns - 1) // columns
    set_up_render(columns, rows)
    tiles = []
    for k, case in enumerate(todo):
        column, row = k % columns, k // columns
        center = ((column - columns / 2 + 0.5) * SIZE, (row - rows / 2 + 0.5) * SIZE)
        tile = Tile(case, center)
        tile.build()
        add_plane(tile)
        tiles.append(tile)
    graphs = [graph_of(tile) for tile in tiles]
    values = render()
    for tile in tiles:
        tile.show_position()
    positions = render()
    found = []
    for k, (tile, graph) in enumerate(zip(tiles, graphs)):
        x, y = k % columns * TILE, k // columns * TILE
        part = (slice(y, y + TILE), slice(x, x + TILE))
        entry = {
            "name": tile.case["name"],
            "tolerance": tile.case.get("tolerance", 1e-3),
            "center": tile.center,
            "graph": graph,
            "points": rounded(positions[part]),
            "values": rounded(values[part]),
        }
        found.append(entry)
    with open(target, "w", encoding="utf-8") as file:
        rows_text = ",\n".join(json.dumps(entry, separators=(",", ":")) for entry in found)
        head = json.dumps({"blender": bpy.app.version_string, "pixel": SIZE / TILE, "half_height": rows * SIZE / 2})
        file.write(f'{head[:-1]}, "cases": [\n{rows_text}\n]}}\n')
    print(f"{len(found)} cases written to {target}")


if not bpy.app.background or bpy.data.objects:
    bpy.ops.wm.read_factory_settings(use_empty=True)
main()
sys.stdout.flush()
os._exit(0)  # some wheels hang on the way out
