# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of scenes.py in Mitsuba 3; a variant must have been set before this module is imported."""

from __future__ import annotations

import mitsuba as mi
import numpy as np

from .scenes import DIFFUSE, GLASS, SIZE, Material, Scene
from .shapes import Body


def rgb(color) -> dict:
    return {"type": "rgb", "value": [float(value) for value in color]}


def surface(material: Material) -> dict:
    """Mitsuba's diffuse and conductor have one side; the others' have two."""
    if material.kind == GLASS:
        return {"type": "dielectric", "int_ior": material.ior, "ext_ior": 1.0}
    if material.kind == DIFFUSE:
        inner = {"type": "diffuse", "reflectance": rgb(material.color)}
    else:
        inner = {"type": "conductor", "material": "none", "specular_reflectance": rgb(material.color)}
    return {"type": "twosided", "bsdf": inner}


def mesh(name: str, body: Body, normals: np.ndarray | None, surface: dict, emitter: dict | None = None) -> mi.Mesh:
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(surface)
    if emitter:
        properties["emitter"] = mi.load_dict(emitter)
    properties["face_normals"] = normals is None
    sizes = len(body.vertices), len(body.triangles)
    made = mi.Mesh(name, *sizes, properties, normals is not None, body.uv is not None)
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = mi.Float(np.float32(body.vertices).ravel())
    parameters["faces"] = mi.UInt32(np.uint32(body.triangles).ravel())
    if normals is not None:
        parameters["vertex_normals"] = mi.Float(np.float32(normals).ravel())
    if body.uv is not None:
        parameters["vertex_texcoords"] = mi.Float(np.float32(body.uv).ravel())
    parameters.update()
    return made


def load(scene: Scene) -> mi.Scene:
    """The scene; each mesh stays a shape of its own, under its name."""
    camera = scene.camera
    look = mi.ScalarTransform4f().look_at(origin=list(camera.origin), target=list(camera.target), up=[0, 0, 1])
    film = {"type": "hdrfilm", "width": SIZE, "height": SIZE, "pixel_format": "rgb", "component_format": "float32"}
    parts = {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": camera.fov,
            "near_clip": 1e-3,
            "far_clip": 1e3,
            "to_world": look,
            "film": film | {"rfilter": {"type": "box"}},
            "sampler": {"type": "independent"},
        },
    }
    for one in scene.meshes:
        parts[one.name] = mesh(one.name, one.body, one.normals(), surface(scene.materials[one.material]))
    black = {"type": "diffuse", "reflectance": rgb((0, 0, 0))}
    emitter = {"type": "area", "radiance": rgb(scene.lamp.radiance)}
    parts["lamp"] = mesh("lamp", scene.lamp.body(), None, black, emitter)
    return mi.load_dict(parts, optimize=False)
