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
    axes.text(LAMP_AT[0] - 0.16, LAMP_AT[1] + 0.06, "L", va="center", ha="right", fontsize=9)
    axes.set(xlim=(-2.05, 2.15), ylim=(-0.85, 3.0), aspect="equal")
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


def draw_panel(axes: plt.Axes, name: str, points: list[np.ndarray], letters: list[tuple[np.ndarray, str]]) -> None:
    color, (string, words) = CLASSES[name], TEXTS[name]
    draw_room(axes)
    draw_path(axes, points, color)
    for at, letter in letters:
        axes.plot(*at, "o", ms=5, color="white", mec=color, mew=1.6, zorder=6)
        side = 1 if at[0] < 1.9 else -1
        place = {"ha": "left" if side > 0 else "right", "zorder": 7, "weight": "bold"}
        axes.text(at[0] + 0.12 * side, at[1] + 0.13, letter, color=INK, fontsize=9.5, **place)
    axes.text(-2.0, 2.72, name, color=color, fontsize=15, weight="bold")
    axes.text(-1.3, 2.74, string, color=INK, fontsize=9.5, family="DejaVu Sans Mono")
    axes.text(0.05, -0.3, words, ha="center", va="top", fontsize=9.5, color=INK)


def draw_legend(axes: plt.Axes) -> None:
    axes.set(xlim=(0, 1), ylim=(0, 1))
    axes.axis("off")
    lines = (
        ("L", "lamp, shining surface, sun, sky"),
        ("S", "mirror-like or clear lobe,\nroughness up to the limit"),
        ("D", "every other lobe"),
        ("E", "eye"),
        ("*", "any number"),
        ("⁺", "one or more"),
        ("|", "either"),
    )
    y = 0.88
    for sign, text in lines:
        axes.text(0.1, y, sign, fontsize=11, weight="bold", family="DejaVu Sans Mono", va="top")
        axes.text(0.22, y, text, fontsize=9.5, color=FAINT, va="top")
        y -= 0.165 if "\n" in text else 0.105


def draw() -> None:
    figure, rows = plt.subplots(2, 3, figsize=(10, 6))
    for axes, (name, (points, letters)) in zip(rows.flat, paths().items()):
        draw_panel(axes, name, points, letters)
    draw_legend(rows[1, 2])
    save(figure, "path-classes")
