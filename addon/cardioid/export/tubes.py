# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands of hair as triangles: thin tubes, or ribbons that face a point where there are too many for tubes.

A tube of n sides is widened so that the mean width it shows is that of the round strand: a convex outline shows
perimeter / π (Cauchy), so the corners are at r·π / (n sin(π/n)).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

LIMIT = 4_000_000  # triangles of one object's hair
_RIBBON = 2
# Sides, halvings of segments; the first that fits is taken.
_LEVELS = ((8, 1), (6, 1), (6, 0), (4, 0), (3, 0), (_RIBBON, 0))


@dataclass
class Strands:
    """Strands of one number of keys: keys (n, k, 3), radii (n, k), slot (n,), random (n,) in [0, 1]; `own` has further
    values of each strand by layer name, (n, c), and `along` of each key, (n, k, c)."""

    keys: np.ndarray
    radii: np.ndarray
    slot: np.ndarray
    random: np.ndarray
    own: dict[str, np.ndarray] = field(default_factory=dict)
    along: dict[str, np.ndarray] = field(default_factory=dict)

    @property
    def segments(self) -> int:
        return len(self.keys) * (self.keys.shape[1] - 1)

    def every(self, step: int) -> Strands:
        """Each `step`-th strand, wider to cover as much."""
        return Strands(self.keys[::step], self.radii[::step] * np.float32(step), self.slot[::step], self.random[::step],
                       {name: values[::step] for name, values in self.own.items()},
                       {name: values[::step] for name, values in self.along.items()})


@dataclass
class Tubes:
    """positions (v, 3), triangles (t, 3), slots (t,), normals (v, 3); layers: by name, (v, c)."""

    positions: np.ndarray
    triangles: np.ndarray
    slots: np.ndarray
    normals: np.ndarray
    layers: dict[str, np.ndarray]


def build(groups: list[Strands], viewer: np.ndarray) -> tuple[Tubes, int]:
    """All strands as one mesh; `viewer` is the point that ribbons face. Also: one strand of how many was taken."""
    segments = sum(g.segments for g in groups)
    level = next((v for v in _LEVELS if _triangles(segments, *v) <= LIMIT), _LEVELS[-1])
    step = max(1, -(-_triangles(segments, *level) // LIMIT))
    parts = [_tubes(g.every(step) if step > 1 else g, *level, viewer) for g in groups]
    return _joined(parts), step


def _triangles(segments: int, sides: int, halvings: int) -> int:
    return segments * 2 ** halvings * (2 if sides == _RIBBON else 2 * sides)


def _tubes(strands: Strands, sides: int, halvings: int, viewer: np.ndarray) -> Tubes:
    keys, radii, along = strands.keys, strands.radii[..., None], strands.along
    for _ in range(halvings):
        keys, radii = _halved(keys), _halved(radii)
        along = {name: _halved(values) for name, values in along.items()}
    tangents = _tangents(keys)
    across = _facing(keys, tangents, viewer) if sides == _RIBBON else _transported(tangents)
    normals = _rings(tangents, across, sides)
    width = radii[:, :, None] * np.float32(1 if sides == _RIBBON else np.pi / (sides * np.sin(np.pi / sides)))
    offsets = across[:, :, None] * np.float32([[-1], [1]]) if sides == _RIBBON else normals
    count, rows, ring = normals.shape[:3]
    place = _intercepts(keys)
    own = {**{name: values[:, None] for name, values in strands.own.items()},
           "#curve_length": place[:, -1:, None], "#curve_random": strands.random[:, None, None],
           "#curve_intercept": (place / np.maximum(place[:, -1:], 1e-20))[..., None], "#curve_tangent": tangents,
           "#curve_thickness": 2 * radii, **along}
    layers = {name: np.broadcast_to(v[:, :, None], (count, rows, ring, v.shape[-1])).reshape(-1, v.shape[-1])
              for name, v in own.items()}
    return Tubes((keys[:, :, None] + offsets * width).reshape(-1, 3), _quads(count, rows, ring),
                 np.repeat(strands.slot, (rows - 1) * (2 if ring == 2 else 2 * ring)), normals.reshape(-1, 3), layers)


def _halved(keys: np.ndarray) -> np.ndarray:
    """A Catmull-Rom curve through the keys, with a point in the middle of each segment, as Cycles draws it."""
    padded = np.concatenate([keys[:, :1], keys, keys[:, -1:]], 1)
    middle = (9 * (padded[:, 1:-2] + padded[:, 2:-1]) - padded[:, :-3] - padded[:, 3:]) / 16
    found = np.empty((keys.shape[0], 2 * keys.shape[1] - 1, keys.shape[2]), np.float32)
    found[:, ::2], found[:, 1::2] = keys, middle
    return found


def _tangents(keys: np.ndarray) -> np.ndarray:
    """Unit directions from root to tip; where a strand stands still, that of the whole strand."""
    ends = np.concatenate([keys[:, :1], keys, keys[:, -1:]], 1)
    whole = _unit(keys[:, -1:] - keys[:, :1], np.float32([0, 0, 1]))
    return _unit(ends[:, 2:] - ends[:, :-2], whole)


def _transported(tangents: np.ndarray) -> np.ndarray:
    """Unit vectors across the strand that turn with it and do not twist around it."""
    axis = np.eye(3, dtype=np.float32)[np.abs(tangents[:, 0]).argmin(1)]
    found = np.empty_like(tangents)
    for row in range(tangents.shape[1]):
        t = tangents[:, row]
        axis = _unit(axis - t * np.sum(axis * t, 1, keepdims=True), _any_across(t))
        found[:, row] = axis
    return found


def _any_across(t: np.ndarray) -> np.ndarray:
    return _unit(np.cross(t, np.eye(3, dtype=np.float32)[np.abs(t).argmin(1)]), np.float32([1, 0, 0]))


def _facing(keys: np.ndarray, tangents: np.ndarray, viewer: np.ndarray) -> np.ndarray:
    """Across the strand as seen from `viewer`."""
    return _unit(np.cross(tangents, viewer - keys), _transported(tangents))


def _rings(tangents: np.ndarray, across: np.ndarray, sides: int) -> np.ndarray:
    """(n, k, sides, 3): normals around each key. Those of a ribbon lean outwards by 60 degrees: it looks round."""
    if sides == _RIBBON:
        first, second = np.cross(across, tangents), across
        turns = np.float32([-np.pi / 3, np.pi / 3])[:, None]
    else:
        first, second = across, np.cross(tangents, across)
        turns = np.arange(sides, dtype=np.float32)[:, None] * np.float32(2 * np.pi / sides)
    return first[:, :, None] * np.cos(turns) + second[:, :, None] * np.sin(turns)


def _intercepts(keys: np.ndarray) -> np.ndarray:
    """(n, k): distance from the root along the strand."""
    found = np.zeros(keys.shape[:2], np.float32)
    np.cumsum(np.linalg.norm(np.diff(keys, axis=1), axis=2), axis=1, out=found[:, 1:])
    return found


def _quads(count: int, rows: int, ring: int) -> np.ndarray:
    """Two triangles for each side of each segment; ring 2 is open."""
    sides = np.arange(1 if ring == 2 else ring)
    low, high = np.meshgrid(np.arange(rows - 1) * ring, sides, indexing="ij")
    a, b = (low + high).ravel(), (low + (high + 1) % ring).ravel()
    one = np.stack([np.stack([a, b, b + ring], 1), np.stack([a, b + ring, a + ring], 1)], 1).reshape(-1, 3)
    return (one[None] + (np.arange(count) * rows * ring)[:, None, None]).reshape(-1, 3).astype(np.int32)


def _joined(parts: list[Tubes]) -> Tubes:
    starts = np.cumsum([0] + [len(p.positions) for p in parts])
    names = list(dict.fromkeys(name for p in parts for name in p.layers))
    layers = {name: _floats([_layer(p, name, parts) for p in parts]) for name in names}
    triangles = np.concatenate([p.triangles + np.int32(s) for p, s in zip(parts, starts)])
    return Tubes(_floats([p.positions for p in parts]), triangles,
                 np.concatenate([p.slots for p in parts]).astype(np.int32), _floats([p.normals for p in parts]), layers)


def _floats(arrays: list[np.ndarray]) -> np.ndarray:
    return np.ascontiguousarray(np.concatenate(arrays), np.float32)


def _layer(part: Tubes, name: str, parts: list[Tubes]) -> np.ndarray:
    """A part that lacks a layer has zeros there."""
    if name in part.layers:
        return part.layers[name]
    return np.zeros((len(part.positions), next(p for p in parts if name in p.layers).layers[name].shape[1]), np.float32)


def _unit(vectors: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.where(length > 1e-12, vectors / np.maximum(length, 1e-12), otherwise).astype(np.float32)
