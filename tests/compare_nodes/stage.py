# SPDX-License-Identifier: GPL-3.0-or-later
"""Tiles before the camera: one mesh per stage, one object per case, and the settings that make samples agree.

A tile is a square of one metre and PIXELS² pixels; each pixel has a face of its own. The camera looks down at the
centres of the pixels: Cycles' first sample is there, and a narrow filter keeps Cardioid's within FILTER. Stages: `flat`
lies in the plane; `facets` has faces turned as on a dome, `back` the same seen from behind; `dome` is one smooth
surface, `coarse` one of few faces; `placed` is a dome whose object is turned and stretched; `roof` is folded, `sheet`
flat and joined; `through` lies behind a transparent plane, `glass` behind a refracting one without effect, `mirror`
stands and is seen in a mirror; `instances` and `particles` have sixteen small copies.
"""

from __future__ import annotations

import math

import bpy
import numpy as np
from mathutils import Matrix, Vector

PIXELS = 32
FILTER = 0.01
"""Width of the pixel filter, in pixels; the camera moves by as much to see how firmly a value stands."""
NUDGE = 2e-6
"""The share by which swept values are moved to see how firmly a pixel's value stands."""
PLACE = Matrix.Rotation(0.4, 4, "Z") @ Matrix.Rotation(0.3, 4, "X") @ Matrix.Diagonal((1.5, 0.8, 1.2, 1.0))
KINDS = ("flat", "facets", "back", "dome", "coarse", "placed", "roof", "sheet", "through", "glass", "mirror")
JOINED = ("dome", "coarse", "placed", "roof", "sheet")
COARSE, FINE = 5, 24
"""Faces along a side of `coarse`, and of the other surfaces whose faces share points."""


def side(kind: str) -> int:
    """Faces along a side."""
    return COARSE if kind == "coarse" else FINE if kind in JOINED else PIXELS


def values(n: int = PIXELS) -> dict[str, np.ndarray]:
    """The UV layers that do not change within a face: (faces, 2), faces row by row from the bottom."""
    row, column = np.divmod(np.arange(n * n), n)
    unit = np.stack([column, row], 1) / (n - 1)
    mixed = np.stack([(column * 19 + row * 7) % n, (column * 5 + row * 13 + 3) % n], 1) / (n - 1)

    def wide(x: np.ndarray) -> np.ndarray:
        y = 5.0 * x - 2.0
        return np.where(np.abs(y) < 2.5 / (n - 1), 0.0, y)

    return {"UVMap": unit, "Wide": wide(unit), "Mixed": wide(mixed), "MixedUnit": mixed}


def faces_of(kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Corners of every pixel's face, (faces, 4, 3), and Smooth's UVs, (faces, 4, 2)."""
    n = side(kind)
    row, column = np.divmod(np.arange(n * n), n)
    x = (column[:, None] + np.array([0, 1, 1, 0])) / n
    y = (row[:, None] + np.array([0, 0, 1, 1])) / n
    if kind in JOINED:
        y = y - (1 / 128 if kind == "coarse" else 1 / 16) / n  # no edge through the centre of a pixel
    z = np.zeros_like(x)
    smooth = np.stack([x, y], -1)
    if kind in ("facets", "back"):
        nx, ny = 1.9 * ((column + 0.5) / n - 0.5), 1.8 * ((row + 0.5) / n - 0.47)
        length = np.maximum(np.hypot(nx, ny), 1e-9)
        sine = np.minimum(length, 1.0) * 0.985
        slope = sine / np.sqrt(1.0 - sine**2) / length
        z = -slope[:, None] * (
            nx[:, None] * (x - x.mean(1, keepdims=True)) + ny[:, None] * (y - y.mean(1, keepdims=True))
        )
    elif kind in ("dome", "coarse", "placed"):
        z = 0.6 * np.sqrt(1.02 - 1.7 * (x - 0.5) ** 2 - 1.4 * (y - 0.45) ** 2) + 0.1 * np.sin(5 * x + 3 * y)
    elif kind == "roof":
        z = 0.8 * np.abs(np.abs(x - 0.25) - 0.5)
    elif kind == "mirror":  # the wall that the mirror z = x shows: straight up at x = 0
        x, z = np.zeros_like(x), x
    corners = np.stack([x, y, z], -1)
    return corners, smooth


def mesh(kind: str) -> bpy.types.Mesh:
    corners, smooth = faces_of(kind)
    joined = kind in JOINED
    if joined:
        points, index = np.unique(corners.reshape(-1, 3).round(9), axis=0, return_inverse=True)
        index = index.reshape(-1, 4)
    else:
        points, index = corners.reshape(-1, 3), np.arange(corners.shape[0] * 4).reshape(-1, 4)
    if kind in ("back", "mirror"):  # the mirror's wall faces the mirror
        index, smooth = index[:, ::-1], smooth[:, ::-1]
    if kind == "placed":
        inverse = np.array(PLACE.inverted())
        points = points @ inverse[:3, :3].T
    points, polygons = list(map(tuple, points)), [tuple(map(int, f)) for f in index]
    cover = {"through": 0.5, "glass": 0.5, "mirror": None}
    if kind in cover:
        height = cover[kind]
        left, right = (0.0, 1.0) if height is None else (height, height)
        low, high = 0.007, 1.013  # no diagonal through the centre of a pixel
        first = len(points)
        points += [(0, low, left), (1, low, right), (1, high, right), (0, high, left)]
        polygons.append((first, first + 1, first + 2, first + 3))
    data = bpy.data.meshes.new(kind)
    data.from_pydata(points, [], polygons)
    count = len(corners)
    if joined and kind not in ("roof", "sheet"):
        data.polygons.foreach_set("use_smooth", [True] * len(polygons))
    if len(polygons) > count:
        data.polygons[count].material_index = 1
    _attributes(data, smooth, count)
    data.update()
    return data


def _attributes(data: bpy.types.Mesh, smooth: np.ndarray, count: int) -> None:
    for name in values():
        data.uv_layers.new(name=name)
    layer = data.uv_layers.new(name="Smooth")
    padded = np.zeros((len(data.loops), 2))
    padded[: count * 4] = smooth.reshape(-1, 2)
    layer.data.foreach_set("uv", padded.ravel())
    nudge(data, 0.0)
    active = data.uv_layers["Smooth" if data.name in ("dome", "coarse", "placed") else "UVMap"]
    data.uv_layers.active, active.active_render = active, True
    data["my_number"], data["of_mesh"] = 0.1, 0.35
    rng = np.random.default_rng(7)
    faces = len(data.polygons)
    for name, kind, domain in (
        ("Number", "FLOAT", "POINT"), ("Whole", "INT", "FACE"), ("Flag", "BOOLEAN", "FACE"),
        ("Place", "FLOAT_VECTOR", "POINT"), ("Paint", "FLOAT_COLOR", "CORNER"), ("Bytes", "BYTE_COLOR", "CORNER"),
        ("Flat", "FLOAT2", "CORNER"),
    ):  # fmt: skip
        try:
            attribute = data.attributes.new(name, kind, domain)
        except TypeError:
            continue
        corners = {"POINT": len(data.vertices), "CORNER": len(data.loops), "FACE": faces}[domain]
        _fill(attribute, kind, rng, corners, data)


def _fill(attribute, kind: str, rng, count: int, data: bpy.types.Mesh) -> None:
    """Values that are constant within a face where faces do not share points."""
    per_face = np.zeros(count, np.int64)
    if count == len(data.polygons):
        per_face = np.arange(count)
    elif count == len(data.loops):
        per_face = np.repeat(np.arange(len(data.polygons)), 4)
    else:
        for polygon in data.polygons:
            for vertex in polygon.vertices:
                per_face[vertex] = polygon.index
    table = rng.random((len(data.polygons), 4)).astype(np.float32)
    table = table[per_face]
    if kind == "FLOAT":
        attribute.data.foreach_set("value", table[:, 0] * 4 - 2)
    elif kind == "INT":
        attribute.data.foreach_set("value", (table[:, 0] * 100).astype(np.int32))
    elif kind == "BOOLEAN":
        attribute.data.foreach_set("value", table[:, 0] > 0.5)
    elif kind in ("FLOAT_VECTOR", "FLOAT2"):
        size = 3 if kind == "FLOAT_VECTOR" else 2
        attribute.data.foreach_set("vector", np.ascontiguousarray(table[:, :size] * 4 - 2).ravel())
    else:
        attribute.data.foreach_set("color", table.ravel())


def nudge(data: bpy.types.Mesh, amount: float) -> None:
    """Writes the swept layers, each moved by another share of about `amount`: 0 stays 0, equal values differ."""
    n = math.isqrt(len(data.polygons))
    for number, (name, plain) in enumerate(values(n).items()):
        moved = plain * (1.0 + amount * np.array([1.0 - 0.2 * number, -0.9 + 0.2 * number]))
        corners = np.zeros((len(data.loops), 2), np.float32)
        corners[: len(plain) * 4] = np.repeat(moved, 4, axis=0)
        data.uv_layers[name].data.foreach_set("uv", corners.ravel())
    data.update()


def camera(columns: int, rows: int, perspective: bool) -> None:
    """Looks at the tiles from ten metres above."""
    scene = bpy.context.scene
    data = bpy.data.cameras.new("Camera")
    data.type, data.sensor_fit = "PERSP" if perspective else "ORTHO", "HORIZONTAL"
    data.ortho_scale, data.angle = columns, 2.0 * math.atan(columns / 2 / 10.0)
    eye = bpy.data.objects.new("Camera", data)
    eye.location = (columns / 2, rows / 2, 10.0)
    scene.collection.objects.link(eye)
    scene.camera = eye
    scene.render.resolution_x, scene.render.resolution_y = columns * PIXELS, rows * PIXELS


def move_camera(x: float, y: float) -> None:
    """From where `camera` has put it, in units of FILTER."""
    scene = bpy.context.scene
    width, height = scene.render.resolution_x / PIXELS, scene.render.resolution_y / PIXELS
    scene.camera.location.xy = width / 2 + x * FILTER / PIXELS, height / 2 + y * FILTER / PIXELS


def cover_material(kind: str) -> bpy.types.Material:
    material = bpy.data.materials.new("cover " + kind)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    glossy = "ShaderNodeBsdfGlossy" if hasattr(bpy.types, "ShaderNodeBsdfGlossy") else "ShaderNodeBsdfAnisotropic"
    node = tree.nodes.new(
        {"through": "ShaderNodeBsdfTransparent", "glass": "ShaderNodeBsdfRefraction", "mirror": glossy}[kind]
    )
    node.inputs["Color"].default_value = (1, 1, 1, 1)
    if kind != "through":
        node.inputs["Roughness"].default_value = 0.0
    if kind == "glass":
        node.inputs["IOR"].default_value = 1.0
    if kind == "mirror" and hasattr(node, "distribution"):
        node.distribution = "GGX"
    tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def copies(name: str, kind: str, material: bpy.types.Material, column: int, row: int) -> bpy.types.Object:
    """Sixteen small squares in the tile: instances on vertices (`instances`) or particles of different sizes."""
    low = 1.0 / 8
    data = bpy.data.meshes.new("copy")
    corners = [(-low, -low), (low, -low), (low, low), (-low, low)]
    # these particles have their Y axis up
    shape = [(x, 0.0, y) if kind == "particles" else (x, y, 0.0) for x, y in corners]
    data.from_pydata(shape, [], [(0, 1, 2, 3)])
    data.uv_layers.new(name="UVMap")
    data.materials.append(material)
    small = bpy.data.objects.new(name, data)
    small.pass_index, small.color = 5, (0.7, 0.1, 0.3, 0.6)
    small["my_number"] = 0.2
    seeds = bpy.data.meshes.new("places")
    points = [(low + 0.25 * (i % 4), low + 0.25 * (i // 4), 0.0) for i in range(16)]
    seeds.from_pydata(points, [], [tuple(range(i, i + 3)) for i in range(0, 14)] if kind == "particles" else [])
    seeds.uv_layers.new(name="UVMap")
    parent = bpy.data.objects.new(name + " places", seeds)
    parent.location = (column, row, 0.0)
    parent["my_number"] = 0.9
    for item in (small, parent):
        bpy.context.scene.collection.objects.link(item)
    parent.show_instancer_for_render = False
    if kind == "instances":
        small.parent, parent.instance_type = parent, "VERTS"
    else:
        small.location = (-50.0, -50.0, 0.0)
        _particles(parent, small)
    return parent


def _particles(parent: bpy.types.Object, small: bpy.types.Object) -> None:
    """Sixteen that were born at frame -9 to 1, of different sizes and life times."""
    parent.modifiers.new("particles", "PARTICLE_SYSTEM")
    system = parent.particle_systems[0].settings
    system.count, system.frame_start, system.frame_end, system.lifetime = 16, -9.0, 1.0, 40.0
    system.lifetime_random, system.emit_from, system.use_emit_random = 0.5, "VERT", False
    system.physics_type, system.render_type, system.instance_object = "NO", "OBJECT", small
    system.use_rotations, system.rotation_mode = True, "GLOB_Z"
    system.particle_size, system.size_random = 1.0, 0.6


def place(name: str, kind: str, material: bpy.types.Material, column: int, row: int, meshes: dict) -> bpy.types.Object:
    """The tile's object; `meshes` keeps what tiles share."""
    if kind in ("instances", "particles"):
        return copies(name, kind, material, column, row)
    if kind not in meshes:
        meshes[kind] = mesh(kind)
        if kind in ("through", "glass", "mirror"):
            meshes[kind, "cover"] = cover_material(kind)
    data = meshes[kind]
    if kind == "placed":  # Cycles copies meshes whose material is the object's, which shows where scale is uneven
        data = data.copy()
    item = bpy.data.objects.new(name, data)
    while len(data.materials) < (2 if (kind, "cover") in meshes else 1):
        data.materials.append(None)
    item.material_slots[0].link = "OBJECT"
    item.material_slots[0].material = material
    if (kind, "cover") in meshes:
        data.materials[1] = meshes[kind, "cover"]
    item.matrix_world = Matrix.Translation(Vector((column, row, 0))) @ (PLACE if kind == "placed" else Matrix())
    item.pass_index, item.color = 7, (0.2, 0.5, 0.9, 0.7)
    item["my_number"], item["my_color"], item["my_whole"] = 0.65, (0.9, 0.3, 0.1), 12
    bpy.context.scene.collection.objects.link(item)
    return item


def grid(count: int) -> tuple[int, int]:
    columns = max(1, math.ceil(math.sqrt(count)))
    return columns, -(-count // columns)
