# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes that geometry nodes gave to instances; Blender shows them to Python since 4.5."""

from __future__ import annotations

from typing import Any

import numpy as np

from .strands import values_of

_UNUSED = 0x7FFFFFFF  # ends the levels of persistent_id


class InstanceAttributes:
    """Reads each attribute of each instancer once."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, str], tuple[np.ndarray, dict[int, int]] | None] = {}

    def find(self, instance: Any, name: str) -> list[float] | None:
        """As a colour, or None. Of instances inside instances, those of the outermost level."""
        levels = [number for number in instance.persistent_id if number != _UNUSED]
        if instance.particle_system or not levels:
            return None
        parent = instance.parent
        key = (parent.as_pointer(), name)
        if key not in self._known:
            self._known[key] = _read(parent, name)
        found = self._known[key]
        if found is None:
            return None
        colors, place = found
        index = place.get(levels[-1], levels[-1])
        return colors[index].tolist() if 0 <= index < len(colors) else None


def _read(parent: Any, name: str) -> tuple[np.ndarray, dict[int, int]] | None:
    """Colours of all instances, and where those with an id of their own are."""
    geometry = parent.evaluated_geometry() if hasattr(parent, "evaluated_geometry") else None  # owns the points
    points = geometry.instances_pointcloud() if geometry else None
    attribute = points.attributes.get(name) if points else None
    values = values_of(attribute) if attribute else None
    if values is None:
        return None
    ids = points.attributes.get("id")
    numbers = [item.value for item in ids.data] if ids else []
    return _colors(values), {number: index for index, number in reversed(list(enumerate(numbers)))}


def _colors(values: np.ndarray) -> np.ndarray:
    """Numbers spread over all components, vectors are (x, y, z, 1)."""
    channels = values.shape[1]
    found = np.repeat(values, 3, 1) if channels == 1 else np.pad(values, ((0, 0), (0, max(3 - channels, 0))))
    return found if channels == 4 else np.pad(found, ((0, 0), (0, 1)), constant_values=1)
