# SPDX-License-Identifier: GPL-3.0-or-later
"""Do two engines' pictures of a file agree? Bounds: 3 % for each channel's mean, 5 % for the median block of 8×8.

A difference beyond its bound still agrees when it is within the noise: for a mean its 98 % interval (Student, Welch,
seeds are the replicates), for the median block 1.5 times the median that noise alone would give. Such a figure is
marked: more samples would settle it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import compare
import numpy as np

MEAN_BOUND = 0.03
BLOCK_BOUND = 0.05
BLOCK = 8
NEARLY_BLACK = 0.05
"""A channel under this share of the brightest one is measured against the brightest."""
DARK = 0.05
"""Blocks under this share of the picture's mean are measured against that share."""


@dataclass
class Figure:
    """A difference as a share, what noise alone explains, and the bound."""

    value: float
    noise: float
    bound: float

    @property
    def verdict(self) -> str:
        if not np.isfinite(self.value):
            return "fail"
        if abs(self.value) <= self.bound:
            return "pass"
        return "noise" if abs(self.value) <= self.noise else "fail"


@dataclass
class Judgement:
    means: dict[str, Figure] = field(default_factory=dict)
    block: Figure | None = None
    worst_blocks: float = 0.0
    """95th percentile of the blocks' differences."""
    problem: str = ""

    @property
    def verdict(self) -> str:
        if self.problem or self.block is None:
            return "fail"
        found = {f.verdict for f in (*self.means.values(), self.block)}
        return next(v for v in ("fail", "noise", "pass") if v in found)


def blocks(images: np.ndarray) -> np.ndarray:
    """(seeds, h, w) to means over blocks; a rest at the right and upper edges that fills no block is left out, unless
    the picture is smaller than one."""
    n, h, w = images.shape
    side = min(BLOCK, h, w)
    rows, columns = h // side, w // side
    cut = images[:, : rows * side, : columns * side]
    return cut.reshape(n, rows, side, columns, side).mean(axis=(2, 4))


def judge(ours: np.ndarray, reference: np.ndarray, alpha: bool = True) -> Judgement:
    """Compares (seeds, h, w, 4) pictures, at least two seeds each."""
    if ours.shape[1:] != reference.shape[1:]:
        return Judgement(problem=f"sizes differ: {ours.shape[1:]} and {reference.shape[1:]}")
    if not np.isfinite(ours).all():
        return Judgement(problem="not finite")
    a, b = ours.astype(np.float64), reference.astype(np.float64)
    if a[..., :3].max() <= 0.0 < b[..., :3].max():
        return Judgement(problem="black picture")
    means = {}
    brightest = max(float(b[..., c].mean()) for c in range(3))
    for i, name in enumerate("RGBA" if alpha else "RGB"):
        x, y = a[..., i].mean(axis=(1, 2)), b[..., i].mean(axis=(1, 2))
        own = float(y.mean())
        scale = max(own if name == "A" or own >= NEARLY_BLACK * brightest else brightest, 1e-9)
        estimate = compare.welch(x, y, scale)
        means[name] = Figure(estimate.difference, estimate.half_width, MEAN_BOUND)
    x, y = blocks(a[..., :3].mean(-1)), blocks(b[..., :3].mean(-1))
    scale = np.maximum(y.mean(0), max(DARK * float(b[..., :3].mean()), 1e-9))
    difference = np.abs(x.mean(0) - y.mean(0)) / scale
    error = np.sqrt(x.var(0, ddof=1) / len(x) + y.var(0, ddof=1) / len(y)) / scale
    noise = 1.5 * 0.6745 * float(np.median(error))
    median = Figure(float(np.median(difference)), noise, BLOCK_BOUND)
    return Judgement(means, median, float(np.quantile(difference, 0.95)))


def cells(ours: np.ndarray, reference: np.ndarray, names: list[str], side: int) -> dict[str, Judgement]:
    """Each ball of a library's picture by itself, cells by rows from the top: the middle 3/4, mostly the ball."""
    columns, height = ours.shape[2] // side, ours.shape[1]
    edge, found = side // 8, {}
    for i, name in enumerate(names):
        left, top = i % columns * side, height - i // columns * side
        part = np.s_[:, top - side + edge : top - edge, left + edge : left + side - edge]
        found[name] = judge(ours[part], reference[part], alpha=False)
    return found
