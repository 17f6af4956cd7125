# SPDX-License-Identifier: GPL-3.0-or-later
"""Directional albedos of Cycles' closures under a white world, for the table in test_cycles_albedos.cpp.

Run in any Blender: `blender -b -P record_cycles_albedos.py` or `python record_cycles_albedos.py` with a bpy wheel.
ALBEDOS=word,word records only the closures with such a word in their name. Prints one line per material: albedo at
cosines 1, 0.6 and 0.25 (red, green, blue).
"""
import math
import os
import tempfile

import bpy
from mathutils import Vector

OLD = bpy.app.version < (4, 0, 0)
COSINES = (1.0, 0.6, 0.25)
GLOSSY = "Glossy" if OLD else "Anisotropic"

COMMON = [
    ("diffuse", "Diffuse", {"Color": 1, "Roughness": 1.0}, False),
    ("diffuse grey", "Diffuse", {"Color": 0.5, "Roughness": 1.0}, False),
    ("glossy 0.3", GLOSSY, {"Color": 1, "Roughness": 0.3, "distribution": "GGX"}, False),
    ("glossy 0.7", GLOSSY, {"Color": 1, "Roughness": 0.7, "distribution": "GGX"}, False),
    ("glossy multi grey", GLOSSY, {"Color": 0.5, "Roughness": 0.7, "distribution": "MULTI_GGX"}, False),
    ("glass", "Glass", {"Color": 1, "Roughness": 0.5, "IOR": 1.5, "distribution": "GGX"}, False),
    ("glass inside", "Glass", {"Color": 1, "Roughness": 0.5, "IOR": 1.5, "distribution": "GGX"}, True),
    ("refraction", "Refraction", {"Color": 1, "Roughness": 0.5, "IOR": 1.5, "distribution": "GGX"}, False),
]
BLACK = {"Base Color": 0}
BECKMANN_GLASS = {"Color": 1, "Roughness": 0.5, "IOR": 1.5, "distribution": "BECKMANN"}
FACETS = [
    (f"{name} {roughness}", GLOSSY, {"Color": 1, "Roughness": roughness, "distribution": distribution}, False)
    for name, distribution in (("beckmann", "BECKMANN"), ("ashikhmin", "ASHIKHMIN_SHIRLEY"))
    for roughness in (0.3, 0.6, 1.0)
]
COMMON += [
    *FACETS,
    ("beckmann refraction", "Refraction", BECKMANN_GLASS, False),
    ("beckmann glass", "Glass", BECKMANN_GLASS, False),
    ("toon diffuse", "Toon", {"Color": 1, "Size": 0.4, "Smooth": 0.3, "component": "DIFFUSE"}, False),
    ("toon glossy", "Toon", {"Color": 1, "Size": 0.4, "Smooth": 0.3, "component": "GLOSSY"}, False),
    ("toon sharp", "Toon", {"Color": 1, "Size": 0.6, "Smooth": 0.0, "component": "GLOSSY"}, False),
    ("translucent", "Translucent", {"Color": 1}, False),
    ("hair reflection", "Hair", {"Color": 1, "RoughnessU": 0.3, "RoughnessV": 0.4, "component": "Reflection"}, False),
    ("hair transmission", "Hair", {"Color": 1, "RoughnessU": 0.3, "RoughnessV": 0.4, "component": "Transmission"},
     False),
    ("principled hair 0.3", "HairPrincipled", {"parametrization": "ABSORPTION", "Roughness": 0.3,
                                               "Radial Roughness": 0.3}, False),
    ("principled hair 0.7", "HairPrincipled", {"parametrization": "ABSORPTION", "Roughness": 0.7,
                                               "Radial Roughness": 0.5, "Coat": 0.5}, False),
]
V1 = {"Specular": 0.0}
ONLY_OLD = [
    ("velvet", "Velvet", {"Color": 1, "Sigma": 0.5}, False),
    ("burley 0.5", "Principled", {"Base Color": 1, "Roughness": 0.5, **V1}, False),
    ("burley 1", "Principled", {"Base Color": 1, "Roughness": 1.0, **V1}, False),
    ("sheen v1", "Principled", {"Base Color": 0, "Sheen": 1.0, "Sheen Tint": 0.0, **V1}, False),
    ("clearcoat 0.2", "Principled", {**BLACK, **V1, "Clearcoat": 1.0, "Clearcoat Roughness": 0.2}, False),
    ("clearcoat 0.6", "Principled", {**BLACK, **V1, "Clearcoat": 1.0, "Clearcoat Roughness": 0.6}, False),
    ("specular v1", "Principled", {"Base Color": 0, "Specular": 0.5, "Roughness": 0.5}, False),
]
MULTI_GLASS = {"Color": 1, "Roughness": 0.5, "IOR": 1.5, "distribution": "MULTI_GGX"}
ONLY_NEW = [
    ("glass multi", "Glass", MULTI_GLASS, False),
    ("glass multi inside", "Glass", MULTI_GLASS, True),
    ("sheen 0.3", "Sheen", {"Color": 1, "Roughness": 0.3, "distribution": "MICROFIBER"}, False),
    ("sheen 0.6", "Sheen", {"Color": 1, "Roughness": 0.6, "distribution": "MICROFIBER"}, False),
    ("sheen 1", "Sheen", {"Color": 1, "Roughness": 1.0, "distribution": "MICROFIBER"}, False),
    ("specular v2", "Principled", {"Base Color": 0, "Roughness": 0.5}, False),
    ("coat", "Principled", {"Base Color": 0, "Specular IOR Level": 0.0, "Coat Weight": 1.0,
                            "Coat Roughness": 0.3}, False),
    ("metal", "Principled", {"Base Color": (0.9, 0.6, 0.3, 1), "Metallic": 1.0, "Roughness": 0.5,
                             "Specular Tint": (0.8, 0.9, 0.5, 1)}, False),
    ("conductor", "Metallic", {"Roughness": 0.3, "fresnel_type": "PHYSICAL_CONDUCTOR", "distribution": "GGX"}, False),
]
FILM = {"Thin Film Thickness": 400.0, "Thin Film IOR": 1.8}
ONLY_NEW += [
    ("beckmann metal", "Metallic", {"Roughness": 0.6, "distribution": "BECKMANN"}, False),
    ("film specular", "Principled", {**BLACK, "Roughness": 0.2, "distribution": "GGX", **FILM}, False),
    ("film glass v2", "Principled", {"Base Color": 1, "Roughness": 0.2, "Transmission Weight": 1.0,
                                     "distribution": "GGX", **FILM}, False),
]
if bpy.app.version >= (5, 0, 0):
    ONLY_NEW += [
        ("film metal", "Metallic", {"Roughness": 0.2, "distribution": "GGX", **FILM}, False),
        ("film conductor", "Metallic", {"Roughness": 0.2, "distribution": "GGX", "fresnel_type": "PHYSICAL_CONDUCTOR",
                                        **FILM}, False),
        ("film glass", "Glass", {"Color": 1, "Roughness": 0.2, "distribution": "GGX", **FILM}, False),
    ]


def material(kind, values):
    """A material whose surface is one closure."""
    made = bpy.data.materials.new(kind)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("ShaderNodeBsdf" + kind)
    for name, value in values.items():
        if name in {socket.identifier for socket in node.inputs}:
            socket = next(s for s in node.inputs if s.identifier == name)
            is_grey = socket.type == "RGBA" and not hasattr(value, "__len__")
            socket.default_value = (value, value, value, 1) if is_grey else value
        else:
            setattr(node, name, value)
    tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return made


def build_scene():
    """A large plane under a white world, seen by an orthographic camera."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 2048
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.sample_clamp_indirect = scene.cycles.blur_glossy = 0
    scene.cycles.max_bounces = 1
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.world = bpy.data.worlds.new("white")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
    mesh = bpy.data.meshes.new("plane")
    # One triangle: its edges are the tangents of hair.
    mesh.from_pydata([(-3e3, -1e3, 0), (3e3, -1e3, 0), (0, 3e3, 0)], [], [(0, 1, 2)])
    plane = bpy.data.objects.new("plane", mesh)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 0.1
    for thing in (plane, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    return scene, plane


def albedo(scene, cosine):
    """Mean of the picture seen along a direction with this cosine."""
    toward = Vector((math.sqrt(1 - cosine * cosine), 0, cosine))
    scene.camera.location = toward * 10
    scene.camera.rotation_euler = toward.to_track_quat("Z", "Y").to_euler()
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "albedo.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        pixels = list(image.pixels)
        bpy.data.images.remove(image)
    return [sum(pixels[channel::4]) / 64 for channel in range(3)]


def main():
    """Prints the table."""
    scene, plane = build_scene()
    wanted = os.environ.get("ALBEDOS", "")
    for name, kind, values, from_inside in COMMON + (ONLY_OLD if OLD else ONLY_NEW):
        if wanted and not any(word in name for word in wanted.split(",")):
            continue
        plane.data.materials.clear()
        plane.data.materials.append(material(kind, values))
        plane.rotation_euler = (math.pi if from_inside else 0, 0, 0)
        row = [albedo(scene, cosine) for cosine in COSINES]
        print("ALBEDO", name, [[round(value, 4) for value in rgb] for rgb in row], flush=True)
    os._exit(0)


main()
