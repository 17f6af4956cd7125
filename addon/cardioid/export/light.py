# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps, in Blender's units."""

from __future__ import annotations

from typing import Any

from . import compat
from .names import affine, hash_name, object_visibility, unit_random


def describe(obj: Any, matrix: Any, graph: dict[str, Any] | None, random_id: int | None = None) -> dict[str, Any]:
    """Keywords of `Scene.add_light` for a lamp placed at `matrix`; `graph` is its node tree, if any.

    random_id: of the instance; None: the lamp is not instanced.
    """
    light = obj.data
    strength = 2.0 ** getattr(light, "exposure", 0.0)
    color = list(light.color)
    if getattr(light, "use_temperature", False):
        color = [c * t for c, t in zip(color, light.temperature_color)]
    desc: dict[str, Any] = {
        "name": obj.name,
        "kind": light.type.lower(),
        "transform": affine(matrix),
        "color": color,
        "energy": light.energy * strength,
        "cast_shadow": compat.casts_shadow(light),
        "use_mis": bool(compat.cycles(light, "use_multiple_importance_sampling", True)),
        "max_bounces": compat.cycles(light, "max_bounces", 1024),
        "legacy_lamp": not compat.has("new_lamps"),
        "soft_falloff": bool(getattr(light, "use_soft_falloff", False)),
        "normalize": bool(getattr(light, "normalize", True)),
        "visibility": object_visibility(obj),
        "object_space": compat.has("lamps_are_objects"),
        "random": unit_random(hash_name(obj.name) if random_id is None else random_id),
    }
    if graph:
        desc["graph"] = graph
    desc.update(_SHAPES[light.type](light))
    return desc


def _point(light: Any) -> dict[str, Any]:
    return {"radius": light.shadow_soft_size}


def _spot(light: Any) -> dict[str, Any]:
    return {**_point(light), "spot_angle": light.spot_size, "spot_blend": light.spot_blend}


def _sun(light: Any) -> dict[str, Any]:
    return {"angle": light.angle}


def _area(light: Any) -> dict[str, Any]:
    size_y = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    return {"shape": light.shape.lower(), "size_x": light.size, "size_y": size_y, "spread": light.spread,
            "portal": bool(compat.cycles(light, "is_portal", False))}


_SHAPES = {"POINT": _point, "SPOT": _spot, "SUN": _sun, "AREA": _area}
