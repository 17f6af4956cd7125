# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers shared by the scripts that build the scenes of this folder and of bench/scenes.

Written for Debian 12's Blender 3.4.1. A scene starts from `start()`, gets objects and materials, ends with `save()`.
"""

from __future__ import annotations

import gzip
import math
import os
import sys

import bpy
from mathutils import Vector


def start(width: int, height: int, samples: int = 128) -> bpy.types.Scene:
    """An empty file with the render settings that make engines comparable."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.quality = "PNG", 86
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = "Medium High Contrast"
    cycles = scene.cycles
    cycles.samples = samples
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 16
    cycles.transparent_max_bounces = 16
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = 0.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    if hasattr(cycles, "sampling_pattern"):
        cycles.sampling_pattern = "SOBOL"
    return scene


class Graph:
    """A material's or world's node tree, emptied, with short ways to add nodes and links."""

    def __init__(self, owner: bpy.types.ID, output: str = "ShaderNodeOutputMaterial"):
        owner.use_nodes = True
        self.owner = owner
        self.tree = owner.node_tree
        self.tree.nodes.clear()
        self.output = self.tree.nodes.new(output)
        self.column = 0

    def node(self, kind: str, inputs: dict | None = None, **properties):
        """Adds a node; an input's value is a constant or an output socket to link from."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        self.column += 1
        node.location = (-220.0 * (self.column % 8) - 240.0, -260.0 * (self.column // 8))
        for name, value in properties.items():
            setattr(node, name, value)
        for key, value in (inputs or {}).items():
            self.feed(node.inputs[key], value)
        return node

    def feed(self, socket, value) -> None:
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif hasattr(value, "__len__") and socket.type == "RGBA" and len(value) == 3:
            socket.default_value = (*value, 1.0)
        else:
            socket.default_value = value

    def ramp(self, factor, stops: list[tuple[float, tuple[float, float, float]]], interpolation: str = "LINEAR"):
        """A Color Ramp's colour output for stops of (position, colour)."""
        node = self.node("ValToRGB", {"Fac": factor})
        elements = node.color_ramp.elements
        node.color_ramp.interpolation = interpolation
        while len(elements) < len(stops):
            elements.new(1.0)
        for element, (position, color) in zip(elements, stops):
            element.position, element.color = position, (*color, 1.0)
        return node.outputs["Color"]

    def math(self, operation: str, *values):
        node = self.node("Math", operation=operation)
        for socket, value in zip(node.inputs, values):
            self.feed(socket, value)
        return node.outputs[0]

    def vector_math(self, operation: str, *values):
        node = self.node("VectorMath", operation=operation)
        for socket, value in zip(node.inputs, values):
            self.feed(socket, value)
        return node.outputs[0]

    def mix_color(self, factor, a, b, blend: str = "MIX"):
        """The Mix node in colour mode (Blender 3.4's successor of MixRGB)."""
        node = self.node("Mix", data_type="RGBA", blend_type=blend)
        sockets = {socket.identifier: socket for socket in node.inputs}
        for name, value in (("Factor_Float", factor), ("A_Color", a), ("B_Color", b)):
            self.feed(sockets[name], value)
        return next(socket for socket in node.outputs if socket.identifier == "Result_Color")

    def surface(self, node) -> bpy.types.ID:
        self.tree.links.new(node.outputs[0], self.output.inputs["Surface"])
        return self.owner


def material(name: str, kind: str, **inputs) -> bpy.types.Material:
    """A material of one BSDF node; input names with underscores for blanks."""
    graph = Graph(bpy.data.materials.new(name))
    properties = {key: inputs.pop(key) for key in ("distribution",) if key in inputs}
    node = graph.node(kind, {key.replace("_", " "): value for key, value in inputs.items()}, **properties)
    result = graph.surface(node)
    color = inputs.get("Color") or inputs.get("Base_Color")
    if color:
        result.diffuse_color = (*color, 1.0)
    return result


def add(data: bpy.types.ID | None, name: str, location=(0, 0, 0), rotation=(0, 0, 0)) -> bpy.types.Object:
    obj = bpy.data.objects.new(name, data)
    obj.location, obj.rotation_euler = location, rotation
    bpy.context.scene.collection.objects.link(obj)
    return obj


def mesh(name: str, vertices, faces, surface: bpy.types.Material, smooth: bool = False, uvs=None, **place):
    """A mesh object; `uvs` holds one pair per face corner."""
    data = bpy.data.meshes.new(name)
    data.from_pydata([tuple(map(float, v)) for v in vertices], [], [tuple(map(int, f)) for f in faces])
    data.materials.append(surface)
    if smooth:
        data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
    if uvs is not None:
        layer = data.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", [float(x) for uv in uvs for x in uv])
    data.update()
    return add(data, name, **place)


def quad(name: str, center, u, v, surface: bpy.types.Material):
    """A rectangle with half sides u and v, facing u × v; its UVs are in metres."""
    c, u, v = Vector(center), Vector(u), Vector(v)
    w, h = 2 * u.length, 2 * v.length
    return mesh(
        name,
        [c - u - v, c + u - v, c + u + v, c - u + v],
        [(0, 1, 2, 3)],
        surface,
        uvs=[(0, 0), (w, 0), (w, h), (0, h)],
    )


def sphere(name: str, center, radius: float, surface: bpy.types.Material, segments: int = 128, rings: int = 64):
    """A smooth sphere with its poles on the z axis."""
    vertices = [(0, 0, radius)]
    for i in range(1, rings):
        t = math.pi * i / rings
        vertices += [
            (radius * math.sin(t) * math.cos(p), radius * math.sin(t) * math.sin(p), radius * math.cos(t))
            for p in (2 * math.pi * j / segments for j in range(segments))
        ]
    vertices.append((0, 0, -radius))
    last = len(vertices) - 1
    faces = []
    for j in range(segments):
        k = (j + 1) % segments
        faces.append((0, 1 + j, 1 + k))
        for i in range(rings - 2):
            a, b = 1 + i * segments, 1 + (i + 1) * segments
            faces.append((a + j, b + j, b + k, a + k))
        faces.append((1 + (rings - 2) * segments + j, last, 1 + (rings - 2) * segments + k))
    return mesh(name, vertices, faces, surface, smooth=True, location=center)


def revolve(name: str, profile, surface: bpy.types.Material, segments: int = 256, **place):
    """A closed profile of (radius, height), counter-clockwise, turned around z."""
    n, vertices, faces = len(profile), [], []
    for i in range(segments):
        a = 2 * math.pi * i / segments
        vertices += [(r * math.cos(a), r * math.sin(a), z) for r, z in profile]
        j = (i + 1) % segments
        faces += [(i * n + k, j * n + k, j * n + (k + 1) % n, i * n + (k + 1) % n) for k in range(n)]
    return mesh(name, vertices, faces, surface, smooth=True, **place)


def box(name: str, half, surface: bpy.types.Material, bevel: float = 0.0, **place):
    """A box with bevelled, smooth-shaded edges."""
    x, y, z = half
    vertices = [(sx * x, sy * y, sz * z) for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    obj = mesh(name, vertices, faces, surface, **place)
    if bevel > 0.0:
        round_edges(obj, bevel)
    return obj


def round_edges(obj: bpy.types.Object, width: float, segments: int = 4) -> None:
    """A Bevel modifier with normals weighted so that flat faces stay flat."""
    modifier = obj.modifiers.new("Bevel", "BEVEL")
    modifier.width, modifier.segments, modifier.limit_method = width, segments, "ANGLE"
    modifier.harden_normals = True
    obj.data.use_auto_smooth = True
    obj.data.auto_smooth_angle = math.radians(60)
    obj.data.polygons.foreach_set("use_smooth", [True] * len(obj.data.polygons))


def area_lamp(name: str, location, target, size: float, energy: float, color=(1, 1, 1)) -> bpy.types.Object:
    lamp = bpy.data.lights.new(name, "AREA")
    lamp.shape, lamp.size, lamp.energy, lamp.color = "SQUARE", size, energy, color
    return aim(add(lamp, name, location), target)


def aim(obj: bpy.types.Object, target) -> bpy.types.Object:
    """Turns a lamp or camera, which look along local -Z, to a point."""
    direction = Vector(target) - obj.location
    obj.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()
    return obj


def camera(location, target, lens: float, focus=None, fstop: float = 0.0) -> bpy.types.Object:
    """The scene's camera; `focus` is the point that is sharp, `fstop` 0 means a pinhole."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    data.clip_start = 0.01
    obj = aim(add(data, "Camera", location), target)
    if fstop > 0.0:
        data.dof.use_dof = True
        data.dof.aperture_fstop = fstop
        data.dof.focus_distance = (Vector(focus if focus is not None else target) - obj.location).length
    bpy.context.scene.camera = obj
    return obj


def world(color=(0, 0, 0), strength: float = 1.0) -> None:
    data = bpy.data.worlds.new("World")
    graph = Graph(data, "ShaderNodeOutputWorld")
    graph.surface(graph.node("Background", {"Color": color, "Strength": strength}))
    data.color = color
    bpy.context.scene.world = data


def look_through_camera() -> None:
    """Opens the file's 3D views on the camera, in Material Preview."""
    for screen in bpy.data.screens:
        for area in screen.areas:
            if area.type == "VIEW_3D":
                area.spaces[0].region_3d.view_perspective = "CAMERA"
                area.spaces[0].shading.type = "MATERIAL"


def save(path: str) -> None:
    """Saves packed and compressed, without the builder's own folders in the file."""
    look_through_camera()
    bpy.ops.file.pack_all()
    path = os.path.abspath(path)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=False)
    with open(path, "rb") as file:
        data = file.read()
    for text in (path.encode(), os.path.dirname(path).encode() + b"/", os.path.expanduser("~").encode() + b"\0"):
        data = data.replace(text, b"\0" * len(text))
    with open(path, "wb") as file:
        file.write(gzip.compress(data, 9, mtime=0))
    print(f"saved {os.path.basename(path)}: {os.path.getsize(path) / 1024:.0f} KiB")


def output_path(default: str) -> str:
    """The path after `--` on Blender's command line, or the default beside the calling script."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    return arguments[0] if arguments else default
