# SPDX-License-Identifier: GPL-3.0-or-later
"""Shading normals of triangle corners: smooth, flat, or custom."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import compat
from .arrays import foreach


def corner_normals(mesh: Any, positions: np.ndarray, tris: Any) -> np.ndarray | None:
    """(T, 3, 3), or None when every triangle is flat. Flat faces among smooth ones get their triangle's normal."""
    flat = _flat_polygons(mesh)
    if flat.all():
        return None
    normals = _smooth_normals(mesh, tris)
    if flat.any():
        flat_tris = flat[tris.polygon]
        normals[flat_tris] = triangle_normals(positions[tris.vertices[flat_tris]])[:, None, :]
    return normals


def _flat_polygons(mesh: Any) -> np.ndarray:
    if compat.has("corner_normals"):
        sharp = mesh.attributes.get("sharp_face")
        if sharp is None or sharp.domain != "FACE":
            return np.zeros(len(mesh.polygons), np.bool_)
        return foreach(sharp.data, "value", np.bool_)
    return ~foreach(mesh.polygons, "use_smooth", np.bool_)


def _smooth_normals(mesh: Any, tris: Any) -> np.ndarray:
    if compat.has("corner_normals"):
        if mesh.normals_domain == "POINT":
            return foreach(mesh.vertex_normals, "vector", np.float32, 3)[tris.vertices]
        return foreach(mesh.corner_normals, "vector", np.float32, 3)[tris.corners]
    if not mesh.use_auto_smooth:
        return foreach(mesh.vertex_normals, "vector", np.float32, 3)[tris.vertices]
    mesh.calc_normals_split()
    normals = foreach(mesh.loops, "normal", np.float32, 3)[tris.corners]
    mesh.free_normals_split()
    return normals


def triangle_normals(points: np.ndarray) -> np.ndarray:
    """Unit normals of (n, 3, 3) triangles; of degenerate ones, zero."""
    normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
