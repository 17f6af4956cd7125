# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands in for `cardioid._core` in exporter tests: records what it is given and refuses what the contract refuses.

The contract is docs/python-api.md with the fields of engine_cpp/scene/scene_desc.h. Recorded dictionaries are in
`Scene.images`, `.materials`, `.meshes`, `.instances`, `.lights`, `.world`, `.camera`, `.settings`.
"""

from __future__ import annotations

import math
import numbers

import numpy as np

NUMBER, TEXT, FLAG, WHOLE = "number", "text", "flag", "whole"


class Error(Exception):
    def __init__(self, problems):
        super().__init__("; ".join(problems))
        self.problems = list(problems)


def numbers_of(count):
    return ("numbers", count)


def one_of(*names):
    return ("one of", names)


_AFFINE = numbers_of(12)
_COLOR = numbers_of(3)
INSTANCE = {"name": TEXT, "mesh": WHOLE, "group": WHOLE, "transform": _AFFINE, "materials": "wholes",
            "visibility": WHOLE, "holdout": FLAG, "pass_index": WHOLE, "random": NUMBER, "color": numbers_of(4),
            "dupli_generated": _COLOR, "dupli_uv": numbers_of(2), "values": "values",
            "terminator_geometry": NUMBER, "terminator_shading": NUMBER}
MATERIAL = {"name": TEXT, "graph": "graph", "viewport_color": _COLOR, "metallic": NUMBER, "roughness": NUMBER,
            "use_transparent_shadow": FLAG, "sample_emission": FLAG, "pass_index": WHOLE,
            "displacement_method": one_of("bump", "displacement", "both")}
LIGHT = {"name": TEXT, "kind": one_of("point", "spot", "sun", "area"), "transform": _AFFINE, "color": _COLOR,
         "energy": NUMBER, "radius": NUMBER, "spot_angle": NUMBER, "spot_blend": NUMBER, "angle": NUMBER,
         "shape": one_of("square", "rectangle", "disk", "ellipse"), "size_x": NUMBER, "size_y": NUMBER,
         "spread": NUMBER, "cast_shadow": FLAG, "use_mis": FLAG, "legacy_lamp": FLAG,
         "soft_falloff": FLAG, "normalize": FLAG,
         "max_bounces": WHOLE, "visibility": WHOLE, "portal": FLAG, "object_space": FLAG, "random": NUMBER,
         "graph": "graph"}
WORLD = {"name": TEXT, "graph": "graph", "color": _COLOR, "sampling": one_of("none", "automatic", "manual"),
         "map_resolution": WHOLE, "visibility": WHOLE, "max_bounces": WHOLE}
CAMERA = {"name": TEXT, "kind": one_of("perspective", "orthographic"), "transform": _AFFINE,
          "view_plane": numbers_of(4), "clip_start": NUMBER, "clip_end": NUMBER, "aperture_radius": NUMBER,
          "focus_distance": NUMBER, "blades": WHOLE, "blade_rotation": NUMBER, "aperture_ratio": NUMBER}
IMAGE = {"name": TEXT, "source": one_of("file", "packed", "pixels"), "path": TEXT, "packed": "bytes",
         "pixels": "pixels", "colorspace": TEXT,
         "alpha_mode": one_of("straight", "premultiplied", "channel_packed", "none")}
SETTINGS = {"width": WHOLE, "height": WHOLE, "crop": numbers_of(4), "samples": WHOLE}
_INPUT_TYPES = ("VALUE", "INT", "BOOLEAN", "VECTOR", "RGBA", "SHADER")


def _finite(value, count):
    values = [value] if count is None else list(value)
    return (count is None or len(values) == count) and all(
        isinstance(v, numbers.Real) and math.isfinite(v) for v in values)


def _fits(value, kind):
    if isinstance(kind, tuple):
        return value in kind[1] if kind[0] == "one of" else _finite(value, kind[1])
    return {
        NUMBER: lambda: not isinstance(value, bool) and _finite(value, None),
        TEXT: lambda: isinstance(value, str),
        FLAG: lambda: isinstance(value, bool),
        WHOLE: lambda: isinstance(value, int) and not isinstance(value, bool),
        "wholes": lambda: all(isinstance(v, int) for v in value),
        "values": lambda: all(set(v) == {"name", "value"} and _finite(v["value"], 4) for v in value),
        "bytes": lambda: isinstance(value, bytes) and len(value) > 0,
        "pixels": lambda: (isinstance(value, np.ndarray) and value.dtype == np.float32 and value.ndim == 3
                           and value.flags.c_contiguous and 1 <= value.shape[2] <= 4),
        "graph": lambda: check_graph(value) or True,
    }[kind]()


def _check(what, given, fields, required=("name",)):
    name = given.get("name", "")
    problems = [f"{what} {name}: unknown key {key}" for key in given if key not in fields]
    problems += [f"{what} {name}: {key} is missing" for key in required if key not in given]
    problems += [f"{what} {name}: {key} = {given[key]!r} is not {fields[key]}" for key in given
                 if key in fields and not _fits(given[key], fields[key])]
    if problems:
        raise Error(problems)


def check_graph(graph):
    """Raises Error unless the dictionary has the form of docs/python-api.md."""
    problems = []
    if set(graph) != {"nodes", "surface", "volume", "displacement"}:
        problems.append(f"graph: keys {sorted(graph)}")
    count = len(graph["nodes"])
    for node in graph["nodes"]:
        if set(node) != {"name", "type", "params", "inputs"}:
            problems.append(f"node {node.get('name')}: keys {sorted(node)}")
        problems += [f"node {node['name']}: input {key} = {value!r}" for key, value in node["inputs"].items()
                     if not _is_input(value, count)]
        problems += [f"node {node['name']}: param {key} = {value!r}" for key, value in node["params"].items()
                     if not _is_param(value)]
    for slot in ("surface", "volume", "displacement"):
        end = graph[slot]
        if end is not None and not (len(end) == 2 and 0 <= end[0] < count and isinstance(end[1], str)):
            problems.append(f"graph: {slot} = {end!r}")
    if problems:
        raise Error(problems)


def _is_input(value, count):
    if isinstance(value, dict):
        return (set(value) == {"node", "socket", "type"} and 0 <= value["node"] < count
                and value["type"] in _INPUT_TYPES)
    if isinstance(value, list):
        return 1 <= len(value) <= 4 and _finite(value, len(value))
    return isinstance(value, (int, float)) and math.isfinite(value)


def _is_param(value):
    if isinstance(value, list):
        return all(isinstance(v, float) and math.isfinite(v) for v in value)
    return isinstance(value, (bool, str)) or (isinstance(value, (int, float)) and math.isfinite(value))


class Scene:
    def __init__(self):
        self.images, self.materials, self.meshes, self.instances, self.lights = [], [], [], [], []
        self.world = self.camera = self.settings = None

    def add_image(self, desc):
        source = desc.get("source")
        content = {"file": "path", "packed": "packed", "pixels": "pixels"}.get(source, "source")
        _check("image", desc, IMAGE, ("name", content, "colorspace", "alpha_mode"))
        return self._append(self.images, desc)

    def add_material(self, desc):
        _check("material", desc, MATERIAL)
        for node in desc.get("graph", {}).get("nodes", []):
            image = node["params"].get("image", -1)
            if not -1 <= image < len(self.images):
                raise Error([f"material {desc['name']}: image {image} does not exist"])
        return self._append(self.materials, desc)

    def add_mesh(self, name, positions, triangles, slots=None, corner_normals=None, attributes=(), active_uv="",
                 active_color="", generated_min=None, generated_size=None, edges=None):
        count = len(triangles)
        _array(name, "positions", positions, (None, 3), (np.float32,))
        _array(name, "triangles", triangles, (None, 3), (np.uint32, np.int32))
        if count == 0 or triangles.min() < 0 or triangles.max() >= len(positions):
            raise Error([f"mesh {name}: triangles point outside"])
        if slots is not None:
            _array(name, "slots", slots, (count,), (np.int32,))
        if corner_normals is not None:
            _array(name, "corner_normals", corner_normals, (count, 3, 3), (np.float32,))
        if edges is not None:
            _array(name, "edges", edges, (None, 2), (np.uint32, np.int32))
        for layer, domain, data in attributes:
            self._attribute(name, layer, domain, data, len(positions), count)
        for what, value in (("generated_min", generated_min), ("generated_size", generated_size)):
            if value is not None and (len(value) != 3 or not np.isfinite(value).all()):
                raise Error([f"mesh {name}: {what}"])
        layers = {layer: (domain, np.array(data)) for layer, domain, data in attributes}
        if len(layers) != len(attributes):
            raise Error([f"mesh {name}: two attributes have one name"])
        for active in (active_uv, active_color):
            if active and active not in layers:
                raise Error([f"mesh {name}: no layer {active}"])
        return self._append(self.meshes, {
            "name": name, "positions": np.array(positions), "triangles": np.array(triangles),
            "slots": None if slots is None else np.array(slots),
            "corner_normals": None if corner_normals is None else np.array(corner_normals), "attributes": layers,
            "active_uv": active_uv, "active_color": active_color, "generated_min": generated_min,
            "generated_size": generated_size, "edges": edges})

    @staticmethod
    def _attribute(mesh, layer, domain, data, points, count):
        shapes = {"corner": (count, 3, None), "point": (points, None), "face": (count, None)}
        if domain not in shapes or not layer:
            raise Error([f"mesh {mesh}: attribute {layer!r} on {domain}"])
        _array(mesh, f"attribute {layer}", data, shapes[domain], (np.float32,))

    def add_instance(self, desc, group=-1):
        _check("instance", desc, INSTANCE, ("name", "mesh", "transform"))
        problems = []
        if not 0 <= desc["mesh"] < len(self.meshes):
            problems.append(f"instance {desc['name']}: no mesh {desc['mesh']}")
        if not all(-1 <= m < len(self.materials) for m in desc["materials"]):
            problems.append(f"instance {desc['name']}: materials {desc['materials']}")
        if not 0 <= desc["visibility"] < 64 or not 0 <= desc["random"] < 1:
            problems.append(f"instance {desc['name']}: visibility or random out of range")
        if problems:
            raise Error(problems)
        return self._append(self.instances, desc)

    def add_light(self, desc):
        _check("light", desc, LIGHT, ("name", "kind", "transform", "energy"))
        return self._append(self.lights, desc)

    def set_world(self, desc):
        _check("world", desc, WORLD)
        self.world = desc

    def set_camera(self, desc):
        _check("camera", desc, CAMERA, ("name", "kind", "transform", "view_plane"))
        self.camera = desc

    def set_settings(self, desc):
        _check("settings", {k: v for k, v in desc.items() if k in SETTINGS}, SETTINGS, ("width", "height", "crop"))
        self.settings = desc

    def problems(self):
        return []

    @staticmethod
    def _append(items, value):
        items.append(value)
        return len(items) - 1


def _array(owner, what, value, shape, dtypes):
    if not isinstance(value, np.ndarray) or value.dtype not in dtypes or not value.flags.c_contiguous:
        raise Error([f"mesh {owner}: {what} is not a contiguous array of {dtypes[0].__name__}"])
    if value.ndim != len(shape) or any(s is not None and s != v for s, v in zip(shape, value.shape)):
        raise Error([f"mesh {owner}: {what} has shape {value.shape}, not {shape}"])
