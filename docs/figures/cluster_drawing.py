# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/clusters.svg: samples of a pixel as clusters of incident light, and what becomes of a firefly.

The samples are made up; they are clustered by the rule of film/cluster_editor.cpp, less its rules on merging.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from style import CLASSES, FAINT, INK, save

REACH = 0.5  # μ: luminances within this share are alike
BLUE, RED = CLASSES["D2"], CLASSES["C1"]


def made_up_samples() -> np.ndarray:
    """Luminances of incident light: a lamp half hidden, a bright wall, and one path that found a caustic."""
    dice = np.random.default_rng(11)
    return np.concatenate([dice.normal(0.10, 0.012, 6), dice.normal(0.42, 0.04, 7), dice.normal(1.6, 0.12, 5), [38.0]])


def cluster(samples: np.ndarray) -> list[list[float]]:
    """Each sample joins the nearest cluster that holds it or has a bound within REACH of it; else it is a new one."""
    lists: list[list[float]] = []
    for y in samples:
        near = [one for one in lists if min(one) - REACH * y <= y <= max(one) + REACH * y]
        best = min(near, key=lambda one: min(abs(min(one) - y), abs(max(one) - y)), default=None)
        if best is None:
            lists.append([y])
        else:
            best.append(y)
    return sorted(lists, key=min)


def draw_clusters(axes: plt.Axes, clusters: list[list[float]]) -> None:
    for number, one in enumerate(clusters):
        color = RED if max(one) > 10 else BLUE
        for row, y in enumerate(sorted(one)):
            axes.plot(y, 0.16 + 0.085 * row, "o", ms=7, color=color, alpha=0.8, mew=0)
        axes.plot([min(one) * 0.93, max(one) * 1.07], [0.06, 0.06], color=color, lw=7, solid_capstyle="butt")
        count = f"{len(one)} sample{'s' if len(one) > 1 else ''}"
        axes.text(
            np.sqrt(min(one) * max(one)), -0.06, f"cluster {number + 1}\n{count}", ha="center", va="top", fontsize=9
        )
    axes.annotate(
        "one sample, bright, and\nnobody around has the like:\nwithheld",
        (38, 0.2),
        (9, 0.62),
        color=RED,
        fontsize=9.5,
        ha="center",
        arrowprops={"arrowstyle": "->", "color": RED},
    )
    axes.set_xscale("log")
    axes.set(xlim=(0.05, 90), ylim=(-0.24, 0.98))
    axes.set_xlabel("luminance of the light that arrives (texture is not in it)")
    axes.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
    axes.minorticks_off()
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_title("One pixel: its light as clusters", loc="left", weight="bold")


def draw_neighbourhood(axes: plt.Axes) -> None:
    """11 × 11 pixels around the firefly: how many samples each has in its cluster's range; and around a real glint."""
    dice = np.random.default_rng(3)
    firefly = np.zeros((11, 11))
    firefly[5, 5] = 1
    y, x = np.mgrid[0:11, 0:11] - 5
    glint = dice.poisson(1.6 * np.exp(-((x - y) ** 2) / 4.0 - (x + y) ** 2 / 60.0)).astype(float)
    glint[5, 5] = max(glint[5, 5], 1)
    for at, (grid, title, verdict) in enumerate(((firefly, "alone", "withheld"), (glint, "one of many", "stays"))):
        left = at * 13.5
        axes.imshow(grid, cmap="inferno", vmin=0, vmax=3, extent=(left, left + 11, 0, 11))
        axes.add_patch(plt.Rectangle((left + 5, 5), 1, 1, fill=False, edgecolor="white", lw=1.4))
        axes.text(left + 5.5, -0.7, f"{title}: {verdict}", ha="center", va="top", fontsize=9.5, color=INK)
    axes.set(xlim=(-0.3, 24.8), ylim=(-2.6, 11.2))
    axes.axis("off")
    axes.set_title("11 × 11 pixels: samples of like brightness", loc="left", weight="bold")


def draw() -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(12.4, 3.7), width_ratios=(1.35, 1))
    draw_clusters(left, cluster(made_up_samples()))
    draw_neighbourhood(right)
    figure.text(0.995, 0.005, "a drawing: made-up samples", ha="right", fontsize=8, color=FAINT)
    save(figure, "clusters")
