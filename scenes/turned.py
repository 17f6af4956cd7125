# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of lathe and wire: outlines turned around z, tubes along a path, curves through points. Lengths in metres."""

from __future__ import annotations

import itertools

import bpy
import common as c
import numpy as np


def curve(points, steps: int = 10) -> np.ndarray:
    """A centripetal Catmull-Rom curve through the points (n × d), with `steps` pieces between two of them."""
    p = np.asarray(points, float)
    p = np.concatenate([2 * p[:1] - p[1:2], p, 2 * p[-1:] - p[-2:-1]])
    out = [p[1]]
    for a, b, e, f in zip(p[:-3], p[1:-2], p[2:-1], p[3:]):
        knots = np.cumsum([0.0] + [max(np.linalg.norm(v - u), 1e-9) ** 0.5 for u, v in ((a, b), (b, e), (e, f))])
        for t in np.linspace(knots[1], knots[2], steps + 1)[1:]:
            out.append(_barry_goldman((a, b, e, f), knots, t))
    return np.array(out)


def _barry_goldman(points, knots, t: float) -> np.ndarray:
    """The curve's point at t, by repeated interpolation between neighbours."""
    level = list(points)
    for span in (1, 2):
        level = [
            ((knots[i + span] - t) * level[i] + (t - knots[i]) * level[i + 1]) / (knots[i + span] - knots[i])
            for i in range(len(level) - 1)
        ]
    return ((knots[2] - t) * level[0] + (t - knots[1]) * level[1]) / (knots[2] - knots[1])


def offset(outline: np.ndarray, distance: float) -> np.ndarray:
    """The outline (n × 2: radius, height) moved to its left by a distance: inwards where it runs upwards."""
    along = np.gradient(outline, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    moved = outline + distance * np.stack([-along[:, 1], along[:, 0]], 1)
    moved[:, 0] = np.maximum(moved[:, 0], 0.0)
    return moved


def turn(name: str, outline, surface: bpy.types.Material, segments: int = 36, closed: bool = False, fine=2, **place):
    """Turns an outline (n × 2: radius, height) around z, facing its right. Points on the axis become poles.

    `closed` joins the last point to the first, for rings that do not touch the axis. `fine` is the level of a
    Subdivision modifier, so that the file stays small and curved glass is smooth.
    """
    outline = np.round(np.asarray(outline, float), 6)
    angles = 2 * np.pi * np.arange(segments) / segments
    vertices, rows = [], []
    for r, z in outline:
        first = len(vertices)
        if r <= 1e-7:
            vertices.append((0.0, 0.0, z))
            rows.append([first] * segments)
        else:
            vertices += [(r * np.cos(a), r * np.sin(a), z) for a in angles]
            rows.append(list(range(first, first + segments)))
    pairs = list(itertools.pairwise(rows)) + ([(rows[-1], rows[0])] if closed else [])
    faces = []
    for low, high in pairs:
        for j in range(segments):
            k = (j + 1) % segments
            corners = list(dict.fromkeys((low[j], low[k], high[k], high[j])))
            if len(corners) > 2:
                faces.append(corners)
    return subdivide(c.mesh(name, np.round(vertices, 6), faces, surface, smooth=True, **place), fine)


def subdivide(obj: bpy.types.Object, level: int) -> bpy.types.Object:
    """Adds a Subdivision modifier, if the level is not 0."""
    if level > 0:
        modifier = obj.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = level
    return obj


def tube(name: str, path, radius, surface: bpy.types.Material, segments: int = 12, **place):
    """A closed tube along a path (n × 3); `radius` is one number or one for each point. Its ends are flat fans."""
    path = np.asarray(path, float)
    radii = np.broadcast_to(np.asarray(radius, float), (len(path),))
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side = _frame(along)
    up = np.cross(along, side)
    angles = 2 * np.pi * np.arange(segments) / segments
    ring = np.cos(angles)[None, :, None] * side[:, None] + np.sin(angles)[None, :, None] * up[:, None]
    vertices = (path[:, None] + radii[:, None, None] * ring).reshape(-1, 3)
    n, faces = len(path), []
    for i in range(n - 1):
        a, b = i * segments, (i + 1) * segments
        faces += [(a + j, a + (j + 1) % segments, b + (j + 1) % segments, b + j) for j in range(segments)]
    vertices = np.concatenate([vertices, path[:1], path[-1:]])
    for j in range(segments):
        k = (j + 1) % segments
        faces.append((n * segments, k, j))
        faces.append((n * segments + 1, (n - 1) * segments + j, (n - 1) * segments + k))
    return c.mesh(name, vertices, faces, surface, smooth=True, **place)


def _frame(along: np.ndarray) -> np.ndarray:
    """A direction across the path at each point, carried on without twist."""
    side = np.zeros_like(along)
    start = np.cross(along[0], np.eye(3)[np.argmin(np.abs(along[0]))])
    side[0] = start / np.linalg.norm(start)
    for i in range(1, len(along)):
        carried = side[i - 1] - along[i] * (side[i - 1] @ along[i])
        side[i] = carried / np.linalg.norm(carried)
    return side
