# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender for `./scripts/bench nodes`: CPU seconds of shading a material, by both engines in turn.

A plane of one material fills the frame under a constant sky; no light but the sky's, no bounce. The seconds of a sample
are the slope between two renders of different length, less the slope of a plain diffuse plane: export, compiling,
textures and tracing drop out. Or: 1000 different materials, and what the engine says it took to compile them.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np

TASK = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
sys.path.insert(0, TASK["addon"])

import addon_utils  # noqa: E402

SIZE = 256


def start() -> bpy.types.Scene:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles", persistent=True)
    addon_utils.enable("cardioid", persistent=True)
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.resolution_x = render.resolution_y = SIZE
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", TASK["threads"]
    render.image_settings.file_format = "OPEN_EXR"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    if hasattr(cycles, "sampling_pattern") and bpy.app.version < (3, 5):
        cycles.sampling_pattern = "SOBOL"
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 2.0
    camera.location = (0, 0, 5)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return scene


def plane(scene: bpy.types.Scene, material, name: str = "plane", place=(0, 0, 0), half: float = 1.0) -> None:
    data = bpy.data.meshes.new(name)
    corners = [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]
    data.from_pydata(corners, [], [(0, 1, 2, 3)])
    data.uv_layers.new(name="UVMap").data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
    data.materials.append(material)
    obj = bpy.data.objects.new(name, data)
    obj.location = place
    scene.collection.objects.link(obj)


def cpu_seconds(scene: bpy.types.Scene, engine: str, samples: int) -> float:
    """User and system seconds of this process for a render."""
    scene.render.engine, scene.cycles.samples = engine, samples
    if engine == "CARDIOID":
        scene.cardioid.integrator = "PT"
    before = time.process_time()
    bpy.ops.render.render()
    return time.process_time() - before


def slope(scene: bpy.types.Scene, engine: str) -> float:
    """CPU seconds of a shaded point, everything included."""
    short, long = 4, 4 + TASK["samples"]
    first = cpu_seconds(scene, engine, short)
    return (cpu_seconds(scene, engine, long) - first) / ((long - short) * SIZE * SIZE)


def diffuse(_scene) -> bpy.types.Material:
    material = bpy.data.materials.new("diffuse")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs[0])
    return material


def mean_of_picture(scene: bpy.types.Scene) -> float:
    """Of the last render, linear: through a file, since a background Blender does not hand out its pixels."""
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "picture.exr")
        bpy.data.images["Render Result"].save_render(path, scene=scene)
        image = bpy.data.images.load(path)
        pixels = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
    return float(pixels.reshape(-1, 4)[:, :3].mean())


def measure(make) -> tuple[dict[str, list[float]], dict[str, float]]:
    """Both engines in turn over the same scene; make(scene) gives the material. Seconds of a point; mean pixels."""
    scene = start()
    plane(scene, make(scene))
    seconds: dict[str, list[float]] = {"CARDIOID": [], "CYCLES": []}
    means = {}
    for turn in range(TASK["runs"]):
        for engine in sorted(seconds, reverse=turn % 2 == 1):
            seconds[engine].append(slope(scene, engine))
            means[engine] = mean_of_picture(scene)
    return seconds, means


def from_file(path: str, name: str):
    def make(_scene) -> bpy.types.Material:
        with bpy.data.libraries.load(path) as (_have, want):
            want.materials = [name]
        return want.materials[0]

    return make


def empty(name: str):
    """A material without nodes, and what adds one: `node(kind, input=value or socket)`."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()

    def node(kind: str, **inputs):
        made = tree.nodes.new("ShaderNode" + kind)
        for key, value in inputs.items():
            target = made.inputs[key]
            if isinstance(value, bpy.types.NodeSocket):
                tree.links.new(value, target)
            else:
                target.default_value = value
        return made

    return material, node


def procedural(i: int) -> bpy.types.Material:
    """What files use most (node-frequency): coordinates, mapping, noise, ramp, mix, bump, Principled."""
    material, node = empty(f"procedural {i}")
    at = node("Mapping", Vector=node("TexCoord").outputs["Object"], Scale=(1 + i * 1e-3, 2, 1)).outputs[0]
    noise = node("TexNoise", Vector=at, Scale=4.0 + i * 0.01, Detail=3.0)
    ramp = node("ValToRGB", Fac=noise.outputs["Fac"])
    ramp.color_ramp.elements[0].color = (0.1 + i * 1e-4, 0.2, 0.3, 1)
    bump = node("Bump", Height=noise.outputs["Fac"], Strength=0.3)
    shader = node("BsdfPrincipled", Roughness=0.4, Normal=bump.outputs[0], **{"Base Color": ramp.outputs[0]})
    node("OutputMaterial", Surface=shader.outputs[0])
    return material


def mixed(_scene) -> bpy.types.Material:
    """Two shaders mixed by cells."""
    material, node = empty("mixed")
    at = node("TexCoord").outputs["Object"]
    cells = node("TexVoronoi", Vector=at, Scale=12.0)
    tint = node("HueSaturation", Hue=0.4, Color=cells.outputs["Color"])
    rough = node("BsdfDiffuse", Color=tint.outputs[0], Roughness=0.5)
    smooth = node("BsdfGlossy", Color=(0.9, 0.8, 0.6, 1), Roughness=0.3)
    shader = node("MixShader", Fac=cells.outputs["Distance"])
    shader.id_data.links.new(rough.outputs[0], shader.inputs[1])
    shader.id_data.links.new(smooth.outputs[0], shader.inputs[2])
    node("OutputMaterial", Surface=shader.outputs[0])
    return material


def tiles(_scene) -> bpy.types.Material:
    """Waves drive the colours and the roughness of bricks."""
    material, node = empty("tiles")
    at = node("TexCoord").outputs["Object"]
    wave = node("TexWave", Vector=at, Scale=3.0, Distortion=4.0, Detail=2.0)
    ramp = node("ValToRGB", Fac=wave.outputs["Fac"])
    brick = node("TexBrick", Vector=at, Color1=ramp.outputs["Color"], Scale=6.0)
    rough = node("MapRange", Value=brick.outputs["Fac"])
    bump = node("Bump", Height=brick.outputs["Fac"], Strength=0.4)
    shader = node("BsdfGlossy", Color=brick.outputs["Color"], Roughness=rough.outputs[0], Normal=bump.outputs[0])
    node("OutputMaterial", Surface=shader.outputs[0])
    return material


def frosted(_scene) -> bpy.types.Material:
    """Glass whose roughness and normal come from noise."""
    material, node = empty("frosted")
    noise = node("TexNoise", Vector=node("TexCoord").outputs["Object"], Scale=9.0, Detail=4.0)
    bump = node("Bump", Height=noise.outputs["Fac"], Strength=0.2)
    shader = node("BsdfGlass", Roughness=noise.outputs["Fac"], IOR=1.5, Normal=bump.outputs[0])
    node("OutputMaterial", Surface=shader.outputs[0])
    return material


OWN = {
    "plain diffuse": diffuse,
    "noise, ramp, bump, Principled": lambda _scene: procedural(0),
    "voronoi, mixed shaders": mixed,
    "wave and bricks, glossy": tiles,
    "clear glass, noise": frosted,
}


def compile_many(count: int) -> dict:
    """The engine's own seconds for a scene of `count` different materials."""
    import cardioid.final_render

    scene = start()
    for i in range(count):
        plane(scene, procedural(i), f"plane {i}", (i % 40 / 20 - 1, i // 40 / 20 - 1, 0), 0.02)
    stats: list[dict] = []
    tell = cardioid.final_render._tell
    cardioid.final_render._tell = lambda engine, arguments, entry: (stats.append(entry), tell(engine, arguments, entry))
    cpu_seconds(scene, "CARDIOID", 1)
    cardioid.final_render._tell = tell
    engine = stats[-1]["engine"]
    return {"count": count, "seconds": engine["seconds"]["materials"], "export": stats[-1]["export_seconds"]}


def main() -> None:
    addon_utils.enable("cycles", persistent=True)
    if "compile" in TASK:
        found = {"compiled": compile_many(TASK["compile"])}
    else:
        path, name = TASK["material"]
        seconds, means = measure(from_file(path, name) if path else OWN[name])
        found = {"material": name, "seconds": seconds, "means": means}
    print("NODES " + json.dumps(found), flush=True)
    sys.stdout.flush()
    os._exit(0)


main()
