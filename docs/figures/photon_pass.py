# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/photon-pass.svg: a pass of photons in three steps: as at the start, guided, and gathered by pixels."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from flatland import Disc, Room, trace
from matplotlib.patches import Circle, Rectangle
from style import CLASSES, FAINT, FLOOR, GLASS, INK, LAMP, save

ROOM = Room(Disc((0.55, 0.85), 0.4), half=2.0, height=2.6)
LAMP_AT = np.array([0.1, 2.5])
PHOTONS = 60
SHARE_AS_AT_START = 0.2  # of the guided photons: photon/guide.cpp
C1 = CLASSES["C1"]
PIXEL = CLASSES["D2"]
DISCS = ((-0.75, 0.06), (0.62, 0.15))  # where two pixels look, and their radius there


def draw_room(axes: plt.Axes, title: str) -> None:
    axes.add_patch(Rectangle((-2, -0.12), 4, 0.12, color=FLOOR))
    axes.add_patch(Circle(ROOM.disc.center, ROOM.disc.radius, facecolor=GLASS, edgecolor="#2a7fa8", alpha=0.5))
    axes.add_patch(Circle(LAMP_AT, 0.1, facecolor=LAMP, edgecolor=INK, lw=0.8, zorder=5))
    axes.set(xlim=(-2.05, 2.05), ylim=(-1.45, 3.05), aspect="equal")
    axes.axis("off")
    axes.text(-2, 2.8, title, fontsize=11, weight="bold", in_layout=False)


def caption(axes: plt.Axes, y: float, text: str) -> None:
    axes.text(0, y, text, ha="center", va="top", fontsize=9.5, in_layout=False)


def emissions(guided: bool) -> np.ndarray:
    """Stratified directions; guided: a fifth as at the start, the rest where the ball is."""
    count = round(PHOTONS * SHARE_AS_AT_START) if guided else PHOTONS
    wide = (np.arange(count) + 0.5) / count * 2.2 - 1.1
    if not guided:
        return wide
    to = np.asarray(ROOM.disc.center) - LAMP_AT
    middle, reach = np.arctan2(to[0], -to[1]), np.arcsin(ROOM.disc.radius / np.hypot(*to))
    rest = PHOTONS - count
    return np.concatenate([wide, middle + (2 * (np.arange(rest) + 0.5) / rest - 1) * reach])


def draw_photons(axes: plt.Axes, guided: bool) -> int:
    """The number that is stored: those that came through the glass."""
    stored = 0
    for angle in emissions(guided):
        points, glass = trace(LAMP_AT, angle, ROOM)
        points = np.array(points)
        glass = glass and points[-1][1] < 0.01
        axes.plot(
            points[:, 0],
            points[:, 1],
            color=C1 if glass else FAINT,
            lw=0.8 if glass else 0.6,
            alpha=0.75 if glass else 0.4,
            zorder=3 if glass else 2,
        )
        if glass:
            axes.plot(*points[-1], "o", ms=3.6, color=C1, zorder=6)
            stored += 1
    return stored


def caustic_photons() -> np.ndarray:
    """Where many photons land, on the floor."""
    to = np.asarray(ROOM.disc.center) - LAMP_AT
    middle, reach = np.arctan2(to[0], -to[1]), np.arcsin(ROOM.disc.radius / np.hypot(*to))
    ends = [trace(LAMP_AT, middle + s * reach, ROOM) for s in np.linspace(-0.97, 0.97, 46)]
    return np.array([points[-1] for points, glass in ends if glass and points[-1][1] < 0.01])


def draw_gather(axes: plt.Axes) -> None:
    eye = np.array([-1.75, 1.9])
    axes.plot([eye[0] - 0.2, eye[0], eye[0] - 0.12], [eye[1] + 0.18, eye[1], eye[1] - 0.25], color=INK, lw=2)
    photons = caustic_photons()
    axes.plot(photons[:, 0], photons[:, 1], "o", ms=3.2, color=C1, zorder=7)
    for at, half in DISCS:
        axes.fill([eye[0], at - half, at + half], [eye[1], 0, 0], color=PIXEL, alpha=0.16, lw=0)
        axes.plot([eye[0], at], [eye[1], 0], color=PIXEL, lw=1.2)
        axes.plot([at - half, at + half], [0, 0], color=PIXEL, lw=4, zorder=8, solid_capstyle="butt")
        draw_from_above(axes, at, half, photons[:, 0])


def draw_from_above(axes: plt.Axes, at: float, half: float, photons: np.ndarray) -> None:
    """The disc of a pixel on the floor from above, magnified; photons lie beside the plane of the drawing too."""
    magnified, middle = 2.2, np.array([at * 1.15 + 0.1, -0.52])
    across = np.random.default_rng(4).uniform(-0.19, 0.19, photons.size)
    inside = np.hypot(photons - at, across) < half
    near = (np.abs(photons - at) < 0.19) & (np.abs(across) < 0.17)
    for mask, alpha in ((near & ~inside, 0.3), (inside, 1.0)):
        axes.plot(
            middle[0] + magnified * (photons[mask] - at),
            middle[1] + magnified * across[mask],
            "o",
            ms=3.2,
            color=C1,
            alpha=alpha,
            mew=0,
        )
    axes.add_patch(Circle(middle, magnified * half, facecolor=PIXEL, alpha=0.15))
    axes.add_patch(Circle(middle, magnified * half, facecolor="none", edgecolor=PIXEL, lw=1.8))
    axes.plot([at, middle[0]], [-0.13, middle[1] + magnified * half], color=PIXEL, lw=0.7)


def draw() -> None:
    figure, (first, second, third) = plt.subplots(1, 3, figsize=(10.4, 4.0))
    draw_room(first, "1  Photons leave every lamp")
    draw_room(second, "2  They learn where to go")
    draw_room(third, "3  Pixels gather them")
    stored = draw_photons(first, False)
    caption(first, -0.25, f"{stored} of {PHOTONS} are kept: those that\nglass or a mirror has thrown\non a surface")
    stored = draw_photons(second, True)
    caption(second, -0.25, f"{stored} of {PHOTONS} are kept. A fifth\nleaves as at first, so that\nno light is lost")
    draw_gather(third)
    caption(third, -0.95, "on a disc of the pixel's size there,\nnear or far (below: from above)")
    save(figure, "photon-pass")
