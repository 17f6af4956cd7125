# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that scenes share beyond those of common.py: tubes along a line, tori, one mesh of many slabs."""

from __future__ import annotations

import math

import bpy
import common as c
import numpy as np


def smooth_line(points, steps: int = 10) -> np.ndarray:
    """Points of a Catmull–Rom spline through `points`, `steps` for each piece."""
    p = np.asarray(points, float)
    p = np.concatenate([2 * p[:1] - p[1:2], p, 2 * p[-1:] - p[-2:-1]])
    t = np.linspace(0, 1, steps, endpoint=False)[:, None]
    pieces = [
        0.5 * (2 * b + (d - a) * t + (2 * a - 5 * b + 4 * d - e) * t**2 + (3 * b - a - 3 * d + e) * t**3)
        for a, b, d, e in zip(p[:-3], p[1:-2], p[2:-1], p[3:])
    ]
    return np.concatenate([*pieces, p[-2:-1]])


def round_corners(points, radius: float, steps: int = 8) -> np.ndarray:
    """A line of straight pieces whose inner corners are arcs, as of a bent pipe."""
    p = [np.asarray(q, float) for q in points]
    out = [p[0]]
    for a, b, d in zip(p[:-2], p[1:-1], p[2:]):
        start, end = b + radius * _unit(a - b), b + radius * _unit(d - b)
        out += [(1 - t) ** 2 * start + 2 * t * (1 - t) * b + t * t * end for t in np.linspace(0, 1, steps + 1)]
    return np.array([*out, p[-1]])


def _unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v)


def tube(name: str, line: np.ndarray, radius: float, surface, sides: int = 24, **place) -> bpy.types.Object:
    """A round tube of `radius` along a line of points, with closed ends."""
    line = np.asarray(line, float)
    way = np.gradient(line, axis=0)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    side = _unit(np.cross(way[0], (0.0, 0.0, 1.0) if abs(way[0][2]) < 0.9 else (1.0, 0.0, 0.0)))
    angles = 2 * math.pi * np.arange(sides) / sides
    vertices = []
    for point, t in zip(line, way):
        side = _unit(side - t * (side @ t))
        up = np.cross(t, side)
        vertices += [point + radius * (math.cos(a) * side + math.sin(a) * up) for a in angles]
    rings = len(line)
    faces = [
        (r * sides + k, r * sides + (k + 1) % sides, (r + 1) * sides + (k + 1) % sides, (r + 1) * sides + k)
        for r in range(rings - 1)
        for k in range(sides)
    ]
    faces += [tuple(range(sides))[::-1], tuple(range((rings - 1) * sides, rings * sides))]
    return c.mesh(name, vertices, faces, surface, smooth=True, **place)


def torus(name: str, major: float, minor: float, surface, segments: int = 96, **place) -> bpy.types.Object:
    """A ring around z; `major` is the radius of its middle, `minor` that of the tube."""
    profile = [(major + minor * math.cos(a), minor * math.sin(a)) for a in (2 * math.pi * k / 48 for k in range(48))]
    return c.revolve(name, profile, surface, segments=segments, **place)
