# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/path-classes.svg: one path of each class in a small room with a glass ball, read from the light."""

from __future__ import annotations

import itertools

import matplotlib.pyplot as plt
import numpy as np
from flatland import Disc, Room, trace
from matplotlib.patches import Circle, Rectangle
from style import CLASSES, FAINT, FLOOR, GLASS, INK, LAMP, save

ROOM = Room(Disc((0.35, 0.98), 0.42), half=2.0, height=2.5)
LAMP_AT = np.array([0.2, 2.42])
EYE = np.array([-1.55, 1.15])
TEXTS = {
    "D1": ("L S* E", "lamps, and lamps\nin mirrors and glass"),
    "D2": ("L D S* E", "light straight\nfrom lamps"),
    "D3": ("L D D (S|D)* E", "light that surfaces\nhave scattered"),
    "C1": ("L S⁺ D (S|D)* E", "caustics: lamp,\nglass, surface"),
    "C2": ("L D S⁺ D (S|D)* E", "indirect caustics: surface,\nglass, surface"),
}


def through_ball(start: np.ndarray, angle: float) -> list[np.ndarray]:
    """The path from `start` through the ball to what lies behind it."""
    points, glass = trace(start, angle, ROOM)
    assert glass, "the ray misses the ball"
    return points


def paths() -> dict[str, tuple[list[np.ndarray], list[tuple[np.ndarray, str]]]]:
    """For each class its points from the lamp to the eye, and the letters at vertices."""
    floor_near, floor_far = np.array([-0.85, 0.0]), np.array([1.05, 0.0])
    wall, wall_low = np.array([2.0, 1.95]), np.array([2.0, 0.6])
    caustic = through_ball(LAMP_AT, np.arctan2(0.36, LAMP_AT[1] - ROOM.disc.center[1]))
    toward = np.array(ROOM.disc.center) + np.array([0.0, 0.03]) - wall
    second = through_ball(wall, np.arctan2(toward[0], -toward[1]))
    return {
        "D1": ([LAMP_AT, EYE], []),
        "D2": ([LAMP_AT, floor_near, EYE], [(floor_near, "D")]),
        "D3": ([LAMP_AT, wall_low, floor_far, EYE], [(wall_low, "D"), (floor_far, "D")]),
        "C1": ([*caustic, EYE], [(caustic[1], "S"), (caustic[2], "S"), (caustic[-1], "D")]),
        "C2": ([LAMP_AT, *second, EYE], [(wall, "D"), (second[1], "S"), (second[2], "S"), (second[-1], "D")]),
    }


def draw_room(axes: plt.Axes) -> None:
    half, height = ROOM.half, ROOM.height
    axes.add_patch(Rectangle((-half, -0.1), 2 * half, 0.1, color=FLOOR))
    axes.add_patch(Rectangle((half, -0.1), 0.1, height + 0.1, color=FLOOR))
    axes.add_patch(Circle(ROOM.disc.center, ROOM.disc.radius, facecolor=GLASS, edgecolor="#2a7fa8", alpha=0.55))
    axes.add_patch(Circle(LAMP_AT, 0.11, facecolor=LAMP, edgecolor=INK, lw=0.8, zorder=5))
    axes.plot([EYE[0] - 0.32, EYE[0], EYE[0] - 0.32], [EYE[1] + 0.2, EYE[1], EYE[1] - 0.2], color=INK, lw=2)
    axes.text(EYE[0] - 0.28, EYE[1] + 0.27, "E", ha="center", fontsize=9)
    axes.text(LAMP_AT[0] + 0.2, LAMP_AT[1] - 0.02, "L", va="center", fontsize=9)
    axes.set(xlim=(-2.05, 2.15), ylim=(-1.12, 2.95), aspect="equal")
    axes.axis("off")


def draw_path(axes: plt.Axes, points: list[np.ndarray], color: str) -> None:
    for a, b in itertools.pairwise(points):
        axes.plot([a[0], b[0]], [a[1], b[1]], color=color, lw=2.2, zorder=4, solid_capstyle="round")
        middle, along = (a + b) / 2, (b - a) / np.linalg.norm(b - a)
        if np.linalg.norm(b - a) > 0.5:
            axes.annotate(
                "",
                middle + 0.06 * along,
                middle - 0.06 * along,
                arrowprops={"arrowstyle": "-|>", "color": color, "lw": 2},
                zorder=4,
            )


def draw() -> None:
    figure, rows = plt.subplots(1, 5, figsize=(13.6, 3.1))
    for axes, (name, (points, letters)) in zip(rows, paths().items()):
        color, (string, words) = CLASSES[name], TEXTS[name]
        draw_room(axes)
        draw_path(axes, points, color)
        for at, letter in letters:
            axes.plot(*at, "o", ms=5, color="white", mec=color, mew=1.6, zorder=6)
            side = 1 if at[0] < 1.9 else -1
            axes.text(
                at[0] + 0.12 * side,
                at[1] + 0.13,
                letter,
                color=INK,
                fontsize=9.5,
                weight="bold",
                zorder=7,
                ha="left" if side > 0 else "right",
            )
        axes.text(-2.0, 2.72, name, color=color, fontsize=15, weight="bold")
        axes.text(-1.3, 2.74, string, color=INK, fontsize=9.5, family="DejaVu Sans Mono")
        axes.text(0.05, -0.35, words, ha="center", va="top", fontsize=9.5, color=INK)
    figure.text(0.995, 0.01, "S: mirror-like or clear   D: all else", ha="right", fontsize=8.5, color=FAINT)
    save(figure, "path-classes")
