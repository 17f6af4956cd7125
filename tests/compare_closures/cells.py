# SPDX-License-Identifier: GPL-3.0-or-later
"""A sheet's pictures, ball by ball: each channel's mean within 1 %, each of 4×4 blocks within 3 %, whole 98 % intervals
inside the bounds (tests/render/compare.py says how)."""

from __future__ import annotations

from dataclasses import dataclass, field

import compare
import numpy as np

GRID = 4


@dataclass
class Cell:
    host: str
    sheet: str
    label: str
    means: dict[str, compare.Estimate] = field(default_factory=dict)
    block: compare.Estimate | None = None
    problem: str = ""

    @property
    def verdict(self) -> str:
        if self.problem or self.block is None:
            return "fail"
        found = {e.verdict(compare.MEAN_BOUND) for e in self.means.values()} | {self.block.verdict(compare.BLOCK_BOUND)}
        return next(v for v in ("fail", "inconclusive", "pass") if v in found)

    @property
    def size(self) -> float:
        """Of the difference, for sorting."""
        return max([abs(e.difference) for e in self.means.values()], default=np.inf)

    def line(self) -> str:
        text = f"{self.verdict.upper():12} {self.host:5} {self.label:58}"
        if self.problem or self.block is None:
            return f"{text} {self.problem}"
        means = " ".join(f"{n} {e.difference:+6.2%}±{e.half_width:.2%}" for n, e in self.means.items())
        return f"{text} {means}   block {self.block.difference:+.1%}±{self.block.half_width:.1%}"


def part(images: np.ndarray, index: int, cell: int, ball: int) -> np.ndarray:
    """A ball's own pixels, (seeds, ball, ball, 4); cells count by rows from the top, pictures from the bottom."""
    columns, edge = images.shape[2] // cell, (cell - ball) // 2
    left, bottom = index % columns * cell + edge, images.shape[1] - (index // columns + 1) * cell + edge
    return images[:, bottom : bottom + ball, left : left + ball]


def judge(cell: Cell, ours: np.ndarray, reference: np.ndarray) -> Cell:
    """Fills a cell from (seeds, h, w, 4) crops."""
    if not np.isfinite(ours).all():
        cell.problem = "not finite"
        return cell
    a, b = ours.astype(np.float64), reference.astype(np.float64)
    brightest = max(float(b[..., c].mean()) for c in range(3))
    for i, name in enumerate("RGBA"):
        x, y = a[..., i].mean(axis=(1, 2)), b[..., i].mean(axis=(1, 2))
        cell.means[name] = compare.welch(x, y, max(float(y.mean()), 0.05 * brightest, 1e-9))
    x, y = (compare.block_means(v[..., :3].mean(-1), GRID) for v in (a, b))
    scale = np.maximum(y.mean(0), max(compare.DARK * float(y.mean()), 1e-9))
    found = [compare.welch(x[:, j, i], y[:, j, i], float(scale[j, i])) for j in range(GRID) for i in range(GRID)]
    cell.block = max(found, key=lambda e: abs(e.difference) + e.half_width)
    return cell
