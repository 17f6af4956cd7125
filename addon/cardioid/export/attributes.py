# SPDX-License-Identifier: GPL-3.0-or-later
"""Named layers of a mesh: UV maps, colours, and whatever attributes materials ask for."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

import numpy as np

from . import compat
from .arrays import foreach

Layer = tuple[str, str, np.ndarray]

# data_type: (property, dtype, channels)
_TYPES = {
    "FLOAT": ("value", np.float32, 1),
    "INT": ("value", np.int32, 1),
    "INT8": ("value", np.int8, 1),
    "BOOLEAN": ("value", np.bool_, 1),
    "FLOAT2": ("vector", np.float32, 2),
    "FLOAT_VECTOR": ("vector", np.float32, 3),
    "FLOAT_COLOR": ("color", np.float32, 4),
    "BYTE_COLOR": ("color", np.float32, 4),
    "QUATERNION": ("value", np.float32, 4),
}
_COLORS = ("FLOAT_COLOR", "BYTE_COLOR")
_DOMAINS = {"POINT": "point", "CORNER": "corner", "FACE": "face"}


def layers(mesh: Any, tris: Any, wanted: Set[str], owner: str, warnings: list[str]) -> list[Layer]:
    """All UV maps and colours, and the attributes in `wanted`, on triangles' own corners, points or faces."""
    found = [(uv.name, "corner", _corners(_uv(uv), tris)) for uv in mesh.uv_layers]
    taken = {layer[0] for layer in found}
    for attribute in mesh.attributes:
        color = attribute.data_type in _COLORS
        if attribute.name in taken or not (color or attribute.name in wanted):
            continue
        if attribute.data_type not in _TYPES or attribute.domain not in _DOMAINS:
            warnings.append(f"Mesh “{owner}”: attribute “{attribute.name}” ({attribute.data_type.lower()} on "
                            f"{attribute.domain.lower()}s) is not supported")
            continue
        found.append(_layer(attribute, tris))
    return found


def _uv(layer: Any) -> np.ndarray:
    if compat.has("array_attributes"):
        return foreach(layer.uv, "vector", np.float32, 2)
    return foreach(layer.data, "uv", np.float32, 2)


def _layer(attribute: Any, tris: Any) -> Layer:
    name, dtype, channels = _TYPES[attribute.data_type]
    values = foreach(attribute.data, name, dtype, channels).reshape(-1, channels).astype(np.float32, copy=False)
    if attribute.domain == "CORNER":
        values = _corners(values, tris)
    elif attribute.domain == "FACE":
        values = values[tris.polygon]
    return attribute.name, _DOMAINS[attribute.domain], values


def _corners(values: np.ndarray, tris: Any) -> np.ndarray:
    """(corners, c) of the mesh → (T, 3, c) of its triangles."""
    return values[tris.corners]
