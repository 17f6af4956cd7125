# SPDX-License-Identifier: GPL-3.0-or-later
"""Are two engines' pictures the same? Seeds are the replicates: every figure is a mean over seeds with an interval.

A value passes when its whole 98 % interval (Student, Welch) lies inside the bound: two one-sided tests at 1 %. It fails
when its interval lies outside and is inconclusive between, which is not a pass. Several values pass together only
if all do, which keeps the level. Bounds: 1 % for each channel's mean over the picture, 3 % for each of 8×8 blocks.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

MEAN_BOUND = 0.01
BLOCK_BOUND = 0.03
GRID = 8
LEVEL = 0.01
DARK = 0.2
"""Blocks darker than this share of the picture's mean are measured against that share instead of their own value."""


def incomplete_beta(a: float, b: float, x: float) -> float:
    """The regularised incomplete beta function I_x(a, b), by its continued fraction (Lentz)."""
    if x <= 0.0 or x >= 1.0:
        return 0.0 if x <= 0.0 else 1.0
    if x > (a + 1.0) / (a + b + 2.0):
        return 1.0 - incomplete_beta(b, a, 1.0 - x)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)) / a
    tiny = 1e-300
    c, d = 1.0, 1.0 / max(1.0 - (a + b) * x / (a + 1.0), tiny)
    value = d
    for m in range(1, 300):
        even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        for term in (even, odd):
            d = 1.0 + term * d
            d = 1.0 / (d if abs(d) > tiny else tiny)
            c = 1.0 + term / c
            c = c if abs(c) > tiny else tiny
            value *= c * d
        if abs(c * d - 1.0) < 1e-13:
            break
    return front * value


def student_tail(t: float, dof: float) -> float:
    """P(T > t) for Student's distribution."""
    half = 0.5 * incomplete_beta(0.5 * dof, 0.5, dof / (dof + t * t))
    return half if t >= 0.0 else 1.0 - half


def student_quantile(p: float, dof: float) -> float:
    """The t with P(T > t) = p, 0 < p < 0.5, by bisection."""
    low, high = 0.0, 1e3
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if student_tail(middle, dof) > p else (low, middle)
    return 0.5 * (low + high)


@dataclass
class Estimate:
    """(a - b) / scale with half the width of its interval, and Welch's two-sided p of "no difference"."""

    difference: float
    half_width: float
    p_value: float

    def verdict(self, bound: float) -> str:
        if not math.isfinite(self.difference) or not math.isfinite(self.half_width):
            return "fail"
        if abs(self.difference) + self.half_width <= bound:
            return "pass"
        return "fail" if abs(self.difference) - self.half_width > bound else "inconclusive"


def welch(a: np.ndarray, b: np.ndarray, scale: float) -> Estimate:
    """Welch's comparison of two sets of replicates, as a share of `scale`."""
    na, nb = len(a), len(b)
    difference = float(a.mean() - b.mean()) / scale
    va, vb = float(a.var(ddof=1)) / na / scale**2, float(b.var(ddof=1)) / nb / scale**2
    variance = va + vb
    if not math.isfinite(variance):
        return Estimate(math.nan, math.nan, 0.0)
    if variance == 0.0:
        return Estimate(difference, 0.0, 1.0 if difference == 0.0 else 0.0)
    dof = variance**2 / (va**2 / (na - 1) + vb**2 / (nb - 1))
    error = math.sqrt(variance)
    return Estimate(difference, student_quantile(LEVEL, dof) * error, 2.0 * student_tail(abs(difference) / error, dof))


@dataclass
class Comparison:
    verdict: str
    means: dict[str, Estimate] = field(default_factory=dict)
    blocks: list[list[Estimate]] = field(default_factory=list)
    problem: str = ""

    def means_agree(self) -> bool:
        """Every channel's mean passes, whatever the blocks do."""
        return bool(self.means) and all(e.verdict(MEAN_BOUND) == "pass" for e in self.means.values())

    def worst_mean(self) -> tuple[str, Estimate]:
        return max(self.means.items(), key=lambda item: abs(item[1].difference) + item[1].half_width)

    def worst_block(self) -> tuple[tuple[int, int], Estimate]:
        """(column, row from the bottom) and its estimate."""
        cells = [((x, y), e) for y, row in enumerate(self.blocks) for x, e in enumerate(row)]
        return max(cells, key=lambda item: abs(item[1].difference) + item[1].half_width)


def block_means(images: np.ndarray, grid: int = GRID) -> np.ndarray:
    """(seeds, h, w) to (seeds, grid, grid); the picture's sides are multiples of the grid."""
    n, h, w = images.shape
    return images.reshape(n, grid, h // grid, grid, w // grid).mean(axis=(2, 4))


def compare(a: np.ndarray, b: np.ndarray) -> Comparison:
    """Compares (seeds, h, w, 4) replicates of an engine with those of the reference engine."""
    if a.shape[1:] != b.shape[1:]:
        return Comparison("fail", problem=f"sizes differ: {a.shape[1:]} and {b.shape[1:]}")
    if not np.isfinite(a).all():
        return Comparison("fail", problem="not finite")
    if a[..., :3].max() <= 0.0 < b[..., :3].max():
        return Comparison("fail", problem="black picture")
    a, b = a.astype(np.float64), b.astype(np.float64)
    mean = max(float(b[..., :3].mean()), 1e-9)
    means = {}
    for i, name in enumerate("RGBA"):
        x, y = a[..., i].mean(axis=(1, 2)), b[..., i].mean(axis=(1, 2))
        if name == "A" or y.mean() > 0.02 * mean:
            means[name] = welch(x, y, max(abs(float(y.mean())), 1e-9))
    x, y = block_means(a[..., :3].mean(-1)), block_means(b[..., :3].mean(-1))
    scale = np.maximum(y.mean(0), DARK * mean)
    blocks = [[welch(x[:, j, i], y[:, j, i], float(scale[j, i])) for i in range(GRID)] for j in range(GRID)]
    verdicts = {e.verdict(MEAN_BOUND) for e in means.values()} | {e.verdict(BLOCK_BOUND) for row in blocks for e in row}
    verdict = next(v for v in ("fail", "inconclusive", "pass") if v in verdicts)
    return Comparison(verdict, means, blocks)


def mutants(a: np.ndarray) -> dict[str, np.ndarray]:
    """Pictures that must never pass when `a` does: all of it 2.5 % brighter, and its brightest block 8 % darker."""
    h, w = a.shape[1] // GRID, a.shape[2] // GRID
    y, x = np.unravel_index(block_means(a[..., :3].mean(-1)).mean(0).argmax(), (GRID, GRID))
    block, brighter = a.copy(), a.copy()
    block[:, y * h : (y + 1) * h, x * w : (x + 1) * w, :3] *= 0.92
    brighter[..., :3] *= 1.025
    return {"2.5 % brighter": brighter, "one block 8 % darker": block}
