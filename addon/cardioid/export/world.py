# SPDX-License-Identifier: GPL-3.0-or-later
"""The world's shader and how it is sampled."""

from __future__ import annotations

from typing import Any

from . import compat
from .names import world_visibility


def current(scene: Any, view_layer: Any) -> Any:
    """The world of this view layer, or None: black."""
    return getattr(view_layer, "world_override", None) or scene.world


def describe(world: Any, graph: dict[str, Any] | None) -> dict[str, Any]:
    """Keywords of `Scene.set_world`."""
    desc: dict[str, Any] = {
        "name": world.name,
        "color": list(world.color),
        "sampling": compat.cycles(world, "sampling_method", "AUTOMATIC").lower(),
        "map_resolution": compat.cycles(world, "sample_map_resolution", 1024),
        "max_bounces": compat.cycles(world, "max_bounces", 1024),
        "visibility": world_visibility(world),
    }
    if graph is not None:
        desc["graph"] = graph
    return desc
