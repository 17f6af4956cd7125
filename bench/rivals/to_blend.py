# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: writes a scene as a .blend file that Cycles and Cardioid render.

    blender -b --factory-startup --python-exit-code 1 -P bench/rivals/to_blend.py -- SCENE OUT.blend

A square lamp of Blender with energy E (watts) and area A radiates E / (4 A) in Cycles. Objects keep the kind of their
material under `kind`, so that a runner knows what casts and what receives caustics.
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bench.rivals import scenes

NODES = {
    scenes.DIFFUSE: "ShaderNodeBsdfDiffuse",
    scenes.GLASS: "ShaderNodeBsdfGlass",
    scenes.MIRROR: "ShaderNodeBsdfGlossy",
}


def material_of(name: str, made: scenes.Material) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface, out = tree.nodes.new(NODES[made.kind]), tree.nodes.new("ShaderNodeOutputMaterial")
    surface.inputs["Color"].default_value = (*made.color, 1.0)
    surface.inputs["Roughness"].default_value = 0.0
    if made.kind == scenes.GLASS:
        surface.inputs["IOR"].default_value = made.ior
    if made.kind != scenes.DIFFUSE and bpy.app.version < (4, 0):
        surface.distribution = "SHARP"
    tree.links.new(surface.outputs[0], out.inputs["Surface"])
    return material


def add_mesh(made: scenes.Mesh, kind: str, material: bpy.types.Material) -> None:
    mesh = bpy.data.meshes.new(made.name)
    mesh.from_pydata(made.body.vertices.tolist(), [], made.body.triangles.tolist())
    mesh.materials.append(material)
    mesh.polygons.foreach_set("use_smooth", [made.body.smooth] * len(mesh.polygons))
    mesh.update()
    thing = bpy.data.objects.new(made.name, mesh)
    thing["kind"] = kind
    bpy.context.scene.collection.objects.link(thing)


def add_lamp(made: scenes.Lamp) -> None:
    light = bpy.data.lights.new("lamp", "AREA")
    light.shape, light.size = "SQUARE", made.side
    peak = max(made.radiance)
    light.color = [value / peak for value in made.radiance]
    light.energy = peak * 4 * made.side**2
    thing = bpy.data.objects.new("lamp", light)
    back, across = Vector(-made.normal), Vector(made.u).normalized()
    matrix = Matrix((across, back.cross(across), back)).transposed().to_4x4()
    matrix.translation = Vector(made.centre)
    thing.matrix_world = matrix
    bpy.context.scene.collection.objects.link(thing)


def add_camera(made: scenes.Camera) -> None:
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.clip_start = "HORIZONTAL", 1e-3
    camera.angle = made.fov / 180 * 3.141592653589793
    thing = bpy.data.objects.new("camera", camera)
    thing.location = made.origin
    thing.rotation_euler = (Vector(made.target) - Vector(made.origin)).to_track_quat("-Z", "Y").to_euler()
    scene = bpy.context.scene
    scene.collection.objects.link(thing)
    scene.camera = thing


def settings() -> None:
    """What all renderers share: a box filter of one pixel, full depth, nothing clamped or blurred, a black world."""
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0.0, 0.0, 0.0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = scenes.SIZE
    render.resolution_percentage = 100
    render.dither_intensity = 0.0
    scene.view_settings.view_transform = "Standard"
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.max_bounces = cycles.diffuse_bounces = scenes.BOUNCES
    cycles.glossy_bounces = cycles.transmission_bounces = scenes.BOUNCES
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.use_denoising = cycles.use_adaptive_sampling = False


def main() -> None:
    name, path = sys.argv[sys.argv.index("--") + 1 :][:2]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    made = scenes.ALL[name]()
    materials = {key: material_of(key, one) for key, one in made.materials.items()}
    for mesh in made.meshes:
        add_mesh(mesh, made.materials[mesh.material].kind, materials[mesh.material])
    add_lamp(made.lamp)
    add_camera(made.camera)
    settings()
    bpy.context.scene["digest"] = made.digest()
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(path).resolve()), compress=True, check_existing=False)


main()
