# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of node sockets, and Blender's conversions between socket types."""

from __future__ import annotations

from typing import Any

_LUMINANCE = (0.2126729, 0.7151522, 0.0721750)  # Rec.709, as Blender turns a colour into a number
_NUMBERS = ("VALUE", "INT", "BOOLEAN")
_GEOMETRIC = ("Normal", "Clearcoat Normal", "Coat Normal", "Tangent", "Position", "Direction", "Random")

Value = float | list[float]


def is_number(socket_type: str) -> bool:
    return socket_type in _NUMBERS


def is_geometric(socket: Any) -> bool:
    """Unlinked, this input takes the shaded point's own normal, tangent or coordinates: the engine has them."""
    return socket.hide_value and (socket.identifier in _GEOMETRIC or socket.node.bl_idname.startswith("ShaderNodeTex"))


def own_value(socket: Any) -> Value | None:
    """The value that the artist typed into the socket; None when it has none (shaders, text, menus)."""
    value = getattr(socket, "default_value", None)
    if value is None or isinstance(value, str):
        return None
    if isinstance(value, (bool, int, float)):
        return float(value)
    return [float(v) for v in value] if hasattr(value, "__len__") else None


def zero(socket_type: str) -> Value | None:
    """What an unlinked reroute or an empty group hands on."""
    if socket_type in _NUMBERS:
        return 0.0
    return {"VECTOR": [0.0, 0.0, 0.0], "RGBA": [0.0, 0.0, 0.0, 1.0]}.get(socket_type)


def convert(value: Value | None, source: str, target: str) -> Value | None:
    """`value` of a socket of type `source` as seen by one of type `target`; None when the types have no conversion."""
    if value is None or source == target or (source in _NUMBERS and target in _NUMBERS):
        return value
    if not isinstance(value, list):
        return {"VECTOR": [value] * 3, "RGBA": [value, value, value, 1.0]}.get(target)
    if target in _NUMBERS:
        weights = _LUMINANCE if source == "RGBA" else (1 / 3, 1 / 3, 1 / 3)
        return sum(w * v for w, v in zip(weights, value))
    return {"VECTOR": value[:3], "RGBA": [*value[:3], 1.0]}.get(target)
