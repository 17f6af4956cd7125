# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangents of UV maps for normal mapping: MikkTSpace (Mikkelsen 2008) on triangles, as Cycles computes them.

Corners with the same place, normal and UV share a tangent per orientation of the UV triangle: the mean of the
triangles' directions, projected on the normal's plane, weighted by the triangles' angles there. Unlike the reference
code, fans that only touch in such a corner share it too. Written out because Mesh.calc_tangents refuses polygons and
splits quads in its own way.
"""

from __future__ import annotations

import numpy as np

_ODD = np.uint64(0x9E3779B97F4A7C15)


def corner_tangents(positions: np.ndarray, vertices: np.ndarray, normals: np.ndarray, uvs: np.ndarray) -> np.ndarray:
    """(T, 3, 4): unit tangent in object space and the sign of the bitangent. (1, 0, 0) where UVs have no direction.

    positions (V, 3), vertices (T, 3) indices, normals (T, 3, 3) unit, uvs (T, 3, 2); all float32.
    """
    points = positions[vertices]
    group, count = _shared(points, normals, uvs)
    direction, area = _directions(points, uvs)
    orientation = area > 0
    usable = (area != 0) & np.isfinite(direction).all(1)
    projected = _projected(direction[:, None, :], normals) * _angles(points, normals)[..., None]
    keys = 2 * group + orientation[:, None]
    sums = np.stack([np.bincount(keys[usable].ravel(), projected[usable][..., axis].ravel(), 2 * count)
                     for axis in range(3)], 1).astype(np.float32)
    # Triangles without a direction of their own take part in whatever group there is.
    positive = (np.abs(sums[1::2]).max(1) > 0)[group]
    orientation = np.where(usable[:, None], orientation[:, None], positive)
    found = np.empty((*vertices.shape, 4), np.float32)
    found[..., :3] = _unit(sums[2 * group + orientation])
    found[~found[..., :3].any(-1), 0] = 1
    found[..., 3] = np.where(orientation, 1, -1)
    return found


def _shared(points: np.ndarray, normals: np.ndarray, uvs: np.ndarray) -> tuple[np.ndarray, int]:
    """A number for each corner, equal for corners that are equal in every respect, and how many numbers there are."""
    rows = np.concatenate([points, normals, uvs], 2).reshape(-1, 8) + np.float32(0)  # -0 becomes 0
    bits = np.ascontiguousarray(rows, np.float32).view(np.uint32)
    key = np.zeros(len(rows), np.uint64)
    for column in bits.T:
        key = (key ^ column) * _ODD
        key ^= key >> np.uint64(29)
    _, number = np.unique(key, return_inverse=True)
    return number.reshape(points.shape[:2]), int(number.max()) + 1


def _directions(points: np.ndarray, uvs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit direction in which u grows, and twice the signed area in UV space, of each triangle."""
    d1, d2 = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    (s1, t1), (s2, t2) = (uvs[:, 1] - uvs[:, 0]).T, (uvs[:, 2] - uvs[:, 0]).T
    area = s1 * t2 - t1 * s2
    return _unit((t2[:, None] * d1 - t1[:, None] * d2) * np.sign(area)[:, None]), np.nan_to_num(area)


def _angles(points: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """(T, 3): angle of the triangle at each corner, seen along the normal there."""
    before = _projected(np.roll(points, 1, 1) - points, normals)
    after = _projected(np.roll(points, -1, 1) - points, normals)
    return np.arccos(np.clip(np.einsum("tci,tci->tc", before, after), -1, 1))


def _projected(vectors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    return _unit(vectors - normals * np.sum(vectors * normals, -1, keepdims=True))


def _unit(vectors: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    usable = (length > 0) & np.isfinite(length)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=usable)
