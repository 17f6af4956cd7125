# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameters of one shading node: its own properties by their RNA names, ramps and curves as tables."""

from __future__ import annotations

from typing import Any

import bpy

from . import compat
from .image import Images
from .image_files import absolute
from .names import affine

TABLE = 257 if compat.has("tables_2") else 256  # entries of a curve table

_BASE = frozenset(bpy.types.ShaderNode.bl_rna.properties.keys()) | {"node_tree", "is_active_output"}
_VALUE_NODES = ("ShaderNodeRGB", "ShaderNodeValue", "ShaderNodeNormal")  # the value sits in the output socket
_CURVES = {"ShaderNodeRGBCurve": "rgb", "ShaderNodeVectorCurve": "xyz", "ShaderNodeFloatCurve": "v"}


def params(node: Any, images: Images) -> dict[str, Any]:
    """Keywords of NodeDesc::params."""
    found: dict[str, Any] = dict(compat.node_versions(node.bl_idname))
    for prop in node.bl_rna.properties:
        name = prop.identifier
        if name in _BASE:
            continue
        if prop.type in ("BOOLEAN", "INT", "FLOAT"):
            found[name] = _number(getattr(node, name))
        elif prop.type in ("ENUM", "STRING"):
            found[name] = _text(node, name)
        elif prop.type == "POINTER":
            found.update(_pointer(node, name, images))
    if node.bl_idname in _VALUE_NODES:
        found["value"] = _number(node.outputs[0].default_value)
    return found


def _number(value: Any) -> bool | float | list[float]:
    if isinstance(value, (bool, int, float)):
        return value
    return [float(v) for v in value]


def _text(node: Any, name: str) -> str:
    value = getattr(node, name)
    if isinstance(value, set):
        return " ".join(sorted(value))
    return absolute(value, node.id_data.library) if name == "filepath" else value


def _pointer(node: Any, name: str, images: Images) -> dict[str, Any]:
    value = getattr(node, name)
    if name == "image":
        return images.params(value, getattr(node, "image_user", None))
    if value is None:
        return {}
    if isinstance(value, bpy.types.ColorRamp):
        return _ramp(value)
    if isinstance(value, bpy.types.CurveMapping):
        return _curves(value, _CURVES.get(node.bl_idname, "rgb"))
    if isinstance(value, bpy.types.TexMapping):
        return _texture_mapping(value)
    if isinstance(value, bpy.types.Object):
        return {f"{name}_matrix": [float(v) for v in affine(value.matrix_world)]}
    if isinstance(value, bpy.types.Text):
        return {f"{name}_text": value.as_string()}
    return {}


def _ramp(ramp: Any) -> dict[str, Any]:
    stops = [v for e in ramp.elements for v in (e.position, *e.color)]
    return {"ramp": stops, "ramp_interpolation": ramp.interpolation, "ramp_color_mode": ramp.color_mode,
            "ramp_hue": ramp.hue_interpolation}


def _curves(mapping: Any, channels: str) -> dict[str, Any]:
    """One table per channel over [curve_min, curve_max]; an RGB node's combined curve is applied first."""
    mapping.initialize()
    curves = list(mapping.curves)
    low = min(c.points[0].location[0] for c in curves)
    high = max(c.points[-1].location[0] for c in curves)
    places = [low + (high - low) * i / (TABLE - 1) for i in range(TABLE)]
    if channels == "rgb" and len(curves) > 3:
        places = [mapping.evaluate(curves[3], x) for x in places]
    found: dict[str, Any] = {f"curve_table_{c}": [mapping.evaluate(curve, x) for x in places]
                             for c, curve in zip(channels, curves)}
    found.update(curve_min=low, curve_max=high, curve_extrapolate=mapping.extend == "EXTRAPOLATED")
    return found


def _texture_mapping(mapping: Any) -> dict[str, Any]:
    """The old mapping panel of texture nodes; nothing when it does nothing."""
    axes = [mapping.mapping_x, mapping.mapping_y, mapping.mapping_z]
    moved = any(mapping.translation) or any(mapping.rotation) or any(s != 1 for s in mapping.scale)
    if not moved and axes == ["X", "Y", "Z"]:
        return {}
    return {"texture_mapping_type": mapping.vector_type, "texture_mapping_axes": "".join(a[0] for a in axes),
            "texture_mapping_translation": list(mapping.translation),
            "texture_mapping_rotation": list(mapping.rotation), "texture_mapping_scale": list(mapping.scale)}
