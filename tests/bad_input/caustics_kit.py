# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: a lamp over a floor with something between that throws a caustic; renders with counts."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import bpy
from scene_kit import add_square, node_material, output_of, render, reset

LAMP_HEIGHT = 2.0


def glass(name: str, *, ior: float = 1.45, roughness: float = 0.0) -> bpy.types.Material:
    return _surface(name, "ShaderNodeBsdfGlass", IOR=ior, Roughness=roughness)


def metal(name: str, roughness: float) -> bpy.types.Material:
    return _surface(name, "ShaderNodeBsdfGlossy", Roughness=roughness)


def grey(name: str) -> bpy.types.Material:
    return _surface(name, "ShaderNodeBsdfDiffuse")


def _surface(name: str, kind: str, **inputs: float) -> bpy.types.Material:
    material = node_material(name)
    tree = material.node_tree
    node = tree.nodes.new(kind)
    if hasattr(node, "distribution"):
        node.distribution = "GGX"
    node.inputs["Color"].default_value = (0.8, 0.8, 0.8, 1) if kind == "ShaderNodeBsdfDiffuse" else (1, 1, 1, 1)
    for socket, value in inputs.items():
        node.inputs[socket].default_value = value
    tree.links.new(node.outputs[0], output_of(tree).inputs["Surface"])
    return material


def lamp(name: str, *, z: float = LAMP_HEIGHT, energy: float = 100.0, kind: str = "POINT", radius: float = 0.0):
    data = bpy.data.lights.new(name, kind)
    data.energy = energy
    if kind == "POINT":
        data.shadow_soft_size = radius
    obj = bpy.data.objects.new(name, data)
    obj.location.z = z
    bpy.context.scene.collection.objects.link(obj)
    return obj


def ball(name: str, material, *, radius: float = 0.3, location=(0.0, 0.0, 0.5)) -> bpy.types.Object:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=radius, location=location)
    obj = bpy.context.object
    obj.name = name
    bpy.ops.object.shade_smooth()
    obj.data.materials.append(material)
    return obj


def floor_scene(samples: int = 16) -> bpy.types.Scene:
    """A grey floor; no lamp yet. Nothing of the light that paths bring is clamped or blurred away."""
    scene = reset(samples=samples)
    scene.cardioid.clamp = scene.cardioid.filter_glossy = 0
    add_square("Floor", size=2).data.materials.append(grey("Grey"))
    return scene


def told(name: str) -> dict:
    """Renders and adds what the engine counted, as "photons" and "dropped"."""
    folder = Path(bpy.app.tempdir)
    stats = folder / f"{name}.json"
    stats.unlink(missing_ok=True)
    words = list(sys.argv)
    sys.argv[:] = ["blender", "--", "--cardioid-stats", str(stats)]
    try:
        result = render(folder / f"{name}.exr")
    finally:
        sys.argv[:] = words
    if stats.exists():
        engine = json.loads(stats.read_text())["renders"][-1]["engine"]
        result.update(photons=engine.get("photons", {}), dropped=engine["counts"]["non_finite_dropped"])
    return result


def in_modes(name: str, *modes: str) -> dict:
    """told() in the first mode, and the mean of the others under their names."""
    scene = bpy.context.scene
    results = {}
    for mode in modes:
        scene.cardioid.integrator = mode
        results[mode] = told(f"{name}_{mode}")
    first, *others = modes
    return {**results[first], **{mode: results[mode].get("mean") for mode in others}}
