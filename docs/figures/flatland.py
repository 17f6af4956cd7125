# SPDX-License-Identifier: GPL-3.0-or-later
"""A world of two dimensions, to draw light as it goes: a glass disc over a floor between two walls. Rays are refracted
by Snell's law without Fresnel losses; the drawings show directions, not brightness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Disc:
    """A glass disc."""

    center: tuple[float, float]
    radius: float
    ior: float = 1.5


@dataclass(frozen=True)
class Room:
    """Floor at y = 0, walls at x = ±half, ceiling at `height`."""

    disc: Disc
    half: float = 2.0
    height: float = 2.6


def meet_disc(p: np.ndarray, d: np.ndarray, disc: Disc) -> float:
    """Distance to the disc along the unit direction d; infinite where it is missed."""
    to = np.asarray(disc.center) - p
    along = float(to @ d)
    gap = disc.radius**2 - (float(to @ to) - along**2)
    if gap < 0:
        return np.inf
    for t in (along - np.sqrt(gap), along + np.sqrt(gap)):
        if t > 1e-6:
            return float(t)
    return np.inf


def meet_room(p: np.ndarray, d: np.ndarray, room: Room) -> float:
    """Distance to floor, walls or ceiling."""
    best = np.inf
    for axis, values in ((0, (-room.half, room.half)), (1, (0.0, room.height))):
        for value in values:
            if abs(d[axis]) > 1e-9:
                t = (value - p[axis]) / d[axis]
                if 1e-6 < t < best:
                    best = t
    return float(best)


def refract(d: np.ndarray, n: np.ndarray, eta: float) -> np.ndarray:
    """Direction after the surface; n faces the ray, eta: ratio of the indices from / to. Total reflection mirrors."""
    cos = -float(n @ d)
    sin2 = eta**2 * (1 - cos**2)
    if sin2 > 1:
        return d + 2 * cos * n
    return eta * d + (eta * cos - np.sqrt(1 - sin2)) * n


def trace(p: np.ndarray, angle: float, room: Room) -> tuple[list[np.ndarray], bool]:
    """A ray from p until it meets the room: its points, and whether it met the glass. angle 0: straight down."""
    p, d = np.asarray(p, float), np.array([np.sin(angle), -np.cos(angle)])
    points, glass, inside = [p], False, False
    for _ in range(6):
        t_disc, t_room = meet_disc(p, d, room.disc), meet_room(p, d, room)
        if not inside and t_room <= t_disc:
            points.append(p + t_room * d)
            return points, glass
        p = p + t_disc * d
        points.append(p)
        n = (p - np.asarray(room.disc.center)) / room.disc.radius
        glass = True
        d = refract(d, -n if inside else n, room.disc.ior if inside else 1 / room.disc.ior)
        inside = bool(d @ n < 0)
    return points, glass
