# SPDX-License-Identifier: GPL-3.0-or-later
"""A round brilliant of radius 1: 57 facets and a girdle, as the set of points inside all of their planes."""

from __future__ import annotations

import itertools

import numpy as np

TABLE, STAR, HALVES = 0.56, 0.50, 0.77
"""Shares of the radius: the table's corners; how far stars reach from the table, lower halves from the girdle."""


def planes(crown: float = 34.5, pavilion: float = 40.8, girdle: float = 0.028, sides: int = 64) -> np.ndarray:
    """Outward normals and distances (n × 4) of the facets; angles of the mains to the girdle in degrees."""
    main, deep = np.radians(crown), np.radians(pavilion)
    half, quarter = np.cos(np.pi / 8), np.cos(np.pi / 16)
    table = TABLE * half
    meet = table + STAR * (1 - table)
    upper = np.arctan((1 - meet * half) * np.tan(main) / ((1 - meet) * quarter))
    at_table, at_meet = (1 - TABLE) * np.tan(main), (1 - meet * half) * np.tan(main)
    star = np.arctan((at_table - at_meet) / (meet - table))
    low = 1 - HALVES
    lower = np.arctan((1 - low * half) * np.tan(deep) / ((1 - low) * quarter))
    out = [(0, 0, 1, girdle + at_table)]
    for k in range(8):
        a = k * np.pi / 4
        out.append(_tilted(a, main, 1, girdle, +1))
        out.append(_tilted(a + np.pi / 8, star, table, girdle + at_table, +1))
        out.append(_tilted(a, deep, 1, -girdle, -1))
        for b in (a + np.pi / 16, a - np.pi / 16):
            out.append(_tilted(b, upper, quarter, girdle, +1))
            out.append(_tilted(b, lower, quarter, -girdle, -1))
    out += [(np.cos(a), np.sin(a), 0.0, 1.0) for a in 2 * np.pi * (np.arange(sides) + 0.5) / sides]
    return np.array(out)


def _tilted(azimuth: float, angle: float, radius: float, height: float, up: int) -> tuple[float, ...]:
    """The plane through (radius, height) at an azimuth, `angle` off the girdle's plane, facing up (1) or down (-1)."""
    s, z = np.sin(angle), up * np.cos(angle)
    return (s * np.cos(azimuth), s * np.sin(azimuth), z, s * radius + z * height)


def brilliant(**cut) -> tuple[np.ndarray, list[list[int]]]:
    """Vertices (n × 3) and the faces (counter-clockwise from outside) of a brilliant with its girdle at z = 0."""
    facets = planes(**cut)
    corners = _corners(facets)
    faces = []
    for normal, distance in zip(facets[:, :3], facets[:, 3]):
        on = np.flatnonzero(np.abs(corners @ normal - distance) < 1e-6)
        if len(on) >= 3:
            faces.append(_around(corners, on, normal))
    return corners, faces


def _corners(facets: np.ndarray) -> np.ndarray:
    """The points where three planes meet that lie outside of none."""
    triples = np.array(list(itertools.combinations(range(len(facets)), 3)))
    normals = facets[triples, :3]
    triples = triples[np.abs(np.linalg.det(normals)) > 1e-7]
    points = np.linalg.solve(facets[triples, :3], facets[triples, 3][..., None])[..., 0]
    inside = np.all(points @ facets[:, :3].T <= facets[:, 3] + 1e-8, axis=1)
    return np.unique(np.round(points[inside], 7), axis=0)


def _around(corners: np.ndarray, on: np.ndarray, normal: np.ndarray) -> list[int]:
    """Corners of one facet in order around its normal."""
    flat = corners[on] - corners[on].mean(0)
    u = flat[0] / np.linalg.norm(flat[0])
    v = np.cross(normal, u)
    return [int(i) for i in on[np.argsort(np.arctan2(flat @ v, flat @ u))]]
