# SPDX-License-Identifier: GPL-3.0-or-later
"""Sculpting with signed distances on a grid: smooth unions of round shapes, and the surface as a mesh of quads."""

from __future__ import annotations

import numpy as np


class Clay:
    """Distances on a regular grid; shapes are added to it and cut out of it. `blend` is the width of the seam."""

    def __init__(self, low, high, cell: float):
        self.low, self.cell = np.array(low, np.float64), cell
        self.shape = tuple(round((b - a) / cell) + 1 for a, b in zip(low, high))
        axes = [np.float32(a + cell * np.arange(n)) for a, n in zip(low, self.shape)]
        self.x, self.y, self.z = np.meshgrid(*axes, indexing="ij")
        self.d = np.full(self.shape, 10.0, np.float32)

    def add(self, distance, blend: float = 0.0) -> None:
        self.d = smooth_min(self.d, distance, blend)

    def cut(self, distance, blend: float = 0.0) -> None:
        self.d = -smooth_min(-self.d, distance, blend)

    def ellipsoid(self, center, radii, tilt: float = 0.0):
        """Distance to an ellipsoid (good near its surface), turned by `tilt` around x."""
        x, y, z = self.x - center[0], self.y - center[1], self.z - center[2]
        cosine, sine = np.cos(tilt), np.sin(tilt)
        y, z = cosine * y + sine * z, cosine * z - sine * y
        a, b, c = radii
        inner = np.sqrt((x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2) + 1e-6
        slope = np.sqrt((x / a**2) ** 2 + (y / b**2) ** 2 + (z / c**2) ** 2) + 1e-6
        return inner * (inner - 1.0) / slope

    def sphere(self, center, radius: float):
        return self.ellipsoid(center, (radius,) * 3)

    def capsule(self, start, end, radius: float, radius_end: float | None = None):
        """A rod from start to end with round ends; the radius may change along it."""
        start, way = np.array(start), np.array(end, float) - np.array(start)
        x, y, z = self.x - start[0], self.y - start[1], self.z - start[2]
        along = np.clip((x * way[0] + y * way[1] + z * way[2]) / float(way @ way), 0.0, 1.0)
        reach = np.sqrt((x - along * way[0]) ** 2 + (y - along * way[1]) ** 2 + (z - along * way[2]) ** 2)
        return reach - (radius + along * ((radius if radius_end is None else radius_end) - radius))

    def drum(self, center, radius: float, half: float, edge: float):
        """An upright cylinder with rounded edges."""
        out = np.hypot(self.x - center[0], self.y - center[1]) - radius + edge
        up = np.abs(self.z - center[2]) - half + edge
        return np.minimum(np.maximum(out, up), 0.0) + np.hypot(np.maximum(out, 0), np.maximum(up, 0)) - edge

    def surface(self):
        """Vertices and quads where the distance is 0 (surface nets: a vertex in each cell that the surface crosses)."""
        d, (nx, ny, nz) = self.d, self.shape
        corners = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        cut = {c: d[c[0] : nx - 1 + c[0], c[1] : ny - 1 + c[1], c[2] : nz - 1 + c[2]] for c in corners}
        inside = sum((v < 0).astype(np.int8) for v in cut.values())
        cells = np.argwhere((inside > 0) & (inside < 8))
        index = np.full((nx - 1, ny - 1, nz - 1), -1, np.int64)
        index[tuple(cells.T)] = np.arange(len(cells))
        total, count = np.zeros((len(cells), 3)), np.zeros(len(cells))
        for a in corners:
            for b in corners:
                if sum(abs(p - q) for p, q in zip(a, b)) != 1 or b < a:
                    continue
                da, db = cut[a][tuple(cells.T)].astype(float), cut[b][tuple(cells.T)].astype(float)
                crosses = (da < 0) != (db < 0)
                share = np.where(crosses, da / np.where(crosses, da - db, 1.0), 0.0)[:, None]
                total += crosses[:, None] * (np.array(a) + share * (np.array(b) - np.array(a)))
                count += crosses
        vertices = self.low + self.cell * (cells + total / count[:, None])
        return vertices, np.concatenate([self._quads(index, axis) for axis in range(3)])

    def _quads(self, index: np.ndarray, axis: int) -> np.ndarray:
        """The faces across grid edges along an axis, facing outwards."""
        d = np.moveaxis(self.d, axis, 0)
        cells = np.moveaxis(index, axis, 0)
        here, there = d[:-1, 1:-1, 1:-1] < 0, d[1:, 1:-1, 1:-1] < 0
        around = [cells[:, :-1, :-1], cells[:, 1:, :-1], cells[:, 1:, 1:], cells[:, :-1, 1:]]
        out = []
        for chosen, order in ((here & ~there, (0, 1, 2, 3)), (there & ~here, (3, 2, 1, 0))):
            order = order if axis != 1 else order[::-1]
            out.append(np.stack([around[i][chosen] for i in order], -1))
        return np.concatenate(out)


def smooth_min(a, b, width: float):
    if width <= 0.0:
        return np.minimum(a, b)
    near = np.maximum(width - np.abs(a - b), 0.0) / width
    return np.minimum(a, b) - near * near * width * 0.25
