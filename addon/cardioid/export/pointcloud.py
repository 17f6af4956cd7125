# SPDX-License-Identifier: GPL-3.0-or-later
"""Point clouds as one mesh of small balls: smooth icospheres, coarser where there are many points."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

import numpy as np

from .arrays import foreach
from .strands import values_of
from .tubes import LIMIT

_RADIUS = 0.01  # of points without an attribute "radius"


def add(scene: Any, data: Any, wanted: Set[str]) -> int:
    """Adds a point cloud; -1 when it is empty."""
    count = len(data.points)
    if count == 0:
        return -1
    centers = foreach(data.points, "co", np.float32, 3)
    radius = data.attributes.get("radius")
    radii = np.full(count, _RADIUS, np.float32) if radius is None else foreach(radius.data, "value", np.float32)
    corners, faces = _ball(next((level for level in (2, 1) if count * 20 * 4 ** level <= LIMIT), 0))
    positions = (centers[:, None] + corners * radii[:, None, None]).reshape(-1, 3)
    triangles = (faces + (np.arange(count) * len(corners))[:, None, None]).reshape(-1, 3).astype(np.int32)
    normals = np.tile(corners[faces], (count, 1, 1))
    low, size = positions.min(0), np.ptp(positions, 0)
    layers = {a.name: found for a in data.attributes if a.name in wanted and (found := values_of(a)) is not None}
    return scene.add_mesh(
        data.name, positions, triangles, corner_normals=np.ascontiguousarray(normals, np.float32),
        attributes=[(name, "point", np.repeat(values, len(corners), 0)) for name, values in layers.items()],
        generated_min=low, generated_size=np.where(size > 0, size, 1).astype(np.float32))


def _ball(level: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit icosphere of 20 · 4^level triangles: (v, 3) corners, (t, 3) indices that turn outwards."""
    g = (1 + 5 ** 0.5) / 2
    corners = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
                        (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)], np.float64)
    faces = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                      (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
                      (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])
    for _ in range(level):
        corners, faces = _finer(corners, faces)
    return (corners / np.linalg.norm(corners, axis=1, keepdims=True)).astype(np.float32), faces


def _finer(corners: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    corners = corners / np.linalg.norm(corners, axis=1, keepdims=True)
    a, b, c = faces.T
    sides = np.sort(np.concatenate([np.stack(pair, 1) for pair in ((a, b), (b, c), (c, a))]), 1)
    unique, middle = np.unique(sides, axis=0, return_inverse=True)
    ab, bc, ca = middle.reshape(3, -1) + len(corners)
    faces = np.concatenate([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return np.concatenate([corners, corners[unique].sum(1) / 2]), faces
