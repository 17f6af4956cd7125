# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangle meshes of simple bodies as arrays: vertices (n, 3) in metres, triangles (m, 3), texture coordinates (n, 2).

Triangles are counter-clockwise seen from outside. Texture coordinates never overlap within a mesh: light that arrives
is recorded over them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

ICOSAHEDRON = (
    *(0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8),
    *(3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1),
)
"""Corners of its triangles among the golden rectangles in the planes z, x and y = 0."""


@dataclass(frozen=True)
class Body:
    vertices: np.ndarray
    triangles: np.ndarray
    uv: np.ndarray | None = None
    smooth: bool = False
    """Shaded with interpolated normals."""

    def moved(self, offset: tuple[float, float, float]) -> Body:
        return Body(self.vertices + np.array(offset), self.triangles, self.uv, self.smooth)


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Unit normals (n, 3) as Blender makes them for smooth faces: each face weighs with its angle at the vertex."""
    corners = vertices[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    face /= np.linalg.norm(face, axis=1, keepdims=True)
    normals = np.zeros_like(vertices)
    for here in range(3):
        one = corners[:, (here + 1) % 3] - corners[:, here]
        other = corners[:, (here + 2) % 3] - corners[:, here]
        lengths = np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)
        angle = np.arccos(np.clip((one * other).sum(1) / lengths, -1.0, 1.0))
        np.add.at(normals, triangles[:, here], face * angle[:, None])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def sphere(centre: tuple[float, float, float], radius: float, level: int = 5) -> Body:
    """An icosahedron, each triangle split into four `level` times, pushed out to the sphere."""
    g = (1 + 5**0.5) / 2
    signs = np.array([(-1, 1), (1, 1), (-1, -1), (1, -1)])
    plane = np.column_stack([signs * (1, g), np.zeros(4)])
    points = np.concatenate([np.roll(plane, turn, axis=1) for turn in range(3)])
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    faces = np.array(ICOSAHEDRON).reshape(-1, 3)
    for _ in range(level):
        points, faces = split(points, faces)
    return Body(points * radius + np.array(centre), faces.astype(np.int32), None, True)


def split(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Every triangle becomes four; new points lie on the unit sphere."""
    edges = np.sort(np.concatenate([faces[:, (0, 1)], faces[:, (1, 2)], faces[:, (2, 0)]]), axis=1)
    edges, index = np.unique(edges, axis=0, return_inverse=True)
    middle = points[edges[:, 0]] + points[edges[:, 1]]
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    a, b, c = faces.T
    ab, bc, ca = len(points) + index.reshape(3, -1)
    quarters = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return np.concatenate([points, middle]), np.concatenate([np.stack(one, 1) for one in quarters])


def turned(profile: np.ndarray, segments: int) -> Body:
    """A closed profile (n, 2) of radius and height, counter-clockwise, turned around the z axis."""
    count = len(profile)
    angle = np.arange(segments)[:, None] * 2 * np.pi / segments
    radius, height = profile[None, :, 0], np.broadcast_to(profile[None, :, 1], (segments, count))
    vertices = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], -1).reshape(-1, 3)
    i, k = np.meshgrid(np.arange(segments), np.arange(count), indexing="ij")
    j, after = (i + 1) % segments, (k + 1) % count
    one, two = i * count + k, j * count + k
    three, four = j * count + after, i * count + after
    triangles = np.stack([np.stack([one, two, three], -1), np.stack([one, three, four], -1)], 2)
    return Body(vertices, triangles.reshape(-1, 3).astype(np.int32), None, True)


def band(inner: float, outer: float, height: float, fillet: float = 0.02, steps: int = 6, floor: float = 0.002) -> Body:
    """A ring with rounded edges that lies on the floor.

    A further vertex beside each end of a rounding keeps the averaged normals of its flat neighbours flat; without it
    the light that the ring throws would be another.
    """
    near, far = inner + fillet, outer - fillet
    low, high = floor + fillet, floor + height - fillet
    profile: list[np.ndarray] = []
    for corner, start in (((far, low), -90), ((far, high), 0), ((near, high), 90), ((near, low), 180)):
        angle = np.radians(start + 90 * np.arange(steps + 1) / steps)
        arc = np.array(corner) + fillet * np.stack([np.cos(angle), np.sin(angle)], 1)
        along = 0.05 * fillet * np.stack([-np.sin(angle), np.cos(angle)], 1)
        profile += [arc[:1] - along[:1], arc, arc[-1:] + along[-1:]]
    return turned(np.concatenate(profile), 512)


def torus(centre: tuple[float, float, float], radius: float, tube: float) -> Body:
    angle = np.arange(64) * 2 * np.pi / 64
    return turned(np.stack([radius + tube * np.cos(angle), tube * np.sin(angle)], 1), 256).moved(centre)


def quad(centre, u, v) -> Body:
    """A rectangle with half edges u and v; its front looks along u × v."""
    centre, u, v = np.array(centre, float), np.array(u, float), np.array(v, float)
    vertices = np.array([centre - u - v, centre + u - v, centre + u + v, centre - u + v])
    uv = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    return Body(vertices, np.array([(0, 1, 2), (0, 2, 3)], np.int32), uv)


def joined(bodies: list[Body]) -> Body:
    """Flat bodies as one mesh; texture coordinates are kept as they are."""
    first = np.cumsum([0] + [len(body.vertices) for body in bodies])
    triangles = np.concatenate([body.triangles + start for body, start in zip(bodies, first)]).astype(np.int32)
    uv = np.concatenate([body.uv for body in bodies])
    return Body(np.concatenate([body.vertices for body in bodies]), triangles, uv)


def box(centre: tuple[float, float, float], half: tuple[float, float, float], turn: float) -> Body:
    """Six rectangles, turned around z by degrees; each has its own cell of a 3 × 2 grid of texture coordinates."""
    angle = np.radians(turn)
    rotation = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    axes, sides = np.diag(np.array(half, float)), []
    for axis in range(3):
        for sign in (1, -1):
            side = quad(sign * axes[axis], axes[(axis + 1) % 3], sign * axes[(axis + 2) % 3])
            cell = np.array([len(sides) % 3, len(sides) // 3], float)
            uv = (side.uv * 0.999 + 0.0005 + cell) / np.array([3.0, 2.0])
            sides.append(Body(side.vertices @ rotation.T, side.triangles, uv))
    return joined(sides).moved(centre)


def chequers(half: float, count: int) -> tuple[Body, Body]:
    """The even and the odd squares of a floor; texture coordinates of both span the whole of it."""
    squares: tuple[list[Body], list[Body]] = ([], [])
    lines = -half + 2 * half * np.arange(count + 1) / count
    for i in range(count):
        for j in range(count):
            cells = np.array([(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)])
            vertices = np.column_stack([lines[cells], np.zeros(4)])
            triangles = np.array([(0, 1, 2), (0, 2, 3)], np.int32)
            squares[(i + j) % 2].append(Body(vertices, triangles, cells / count))
    return joined(squares[0]), joined(squares[1])
