# SPDX-License-Identifier: GPL-3.0-or-later
"""Is a tile of one engine the same as the other's? Pixel by pixel, without statistics.

A pixel agrees when each channel has |a - b| <= tolerance · max(|a|, |b|, floor). One that does not is explained when
Cycles does not keep to its own value either: when its inputs move by two millionths, or its sample by a hundredth of a
pixel (the step of a floor, a hash of a fraction, the pole of a tangent). A tile passes when 99.9 % of its pixels agree
or are explained, and no more than 5 % had to be explained. Noisy tiles (ambient occlusion, bevel) compare their means.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

SHARE = 0.999
EXPLAINED = 0.05
NOISY_MEAN = 0.02
MUTANT = 1.003


def agree(a: np.ndarray, b: np.ndarray, tolerance: float, floor: float) -> np.ndarray:
    """(h, w, 3) twice to (h, w): True where all channels agree."""
    scale = np.maximum(np.maximum(np.abs(a), np.abs(b)), floor)
    with np.errstate(invalid="ignore"):
        return ((np.abs(a - b) <= tolerance * scale) & np.isfinite(scale)).all(-1)


def error(a: np.ndarray, b: np.ndarray, floor: float) -> np.ndarray:
    """(h, w): the largest relative difference of a channel; infinite where a value is not finite."""
    scale = np.maximum(np.maximum(np.abs(a), np.abs(b)), floor)
    with np.errstate(invalid="ignore"):
        return np.nan_to_num((np.abs(a - b) / scale).max(-1), nan=np.inf)


@dataclass
class Verdict:
    """Shares of pixels, and the worst of those that neither agree nor are explained."""

    passed: bool
    within: float
    explained: float = 0.0
    worst: float = 0.0
    at: tuple[int, int] = (0, 0)
    ours: list[float] = field(default_factory=list)
    reference: list[float] = field(default_factory=list)


def compare(ours: np.ndarray, references: np.ndarray, tolerance: float, floor: float) -> Verdict:
    """(h, w, 3) against (renders, h, w, 3), of which the first is the picture and the others were moved."""
    a, b = ours.astype(np.float64), references.astype(np.float64)
    good = agree(a, b[0], tolerance, floor)
    firm = np.ones_like(good)
    for moved in b[1:]:
        firm &= agree(b[0], moved, tolerance, floor)
    excused = ~good & ~firm & np.isfinite(a).all(-1)
    wrong = ~good & ~excused
    error_of = np.where(wrong, error(a, b[0], floor), -1.0)
    y, x = np.unravel_index(error_of.argmax(), error_of.shape)
    within, explained = float(good.mean()), float(excused.mean())
    passed = within + explained >= SHARE and explained <= EXPLAINED
    return Verdict(passed, within, explained, float(max(error_of[y, x], 0.0)), (int(x), int(y)), a[y, x].tolist(),
                   b[0, y, x].tolist())  # fmt: skip


def compare_noisy(ours: np.ndarray, reference: np.ndarray, floor: float) -> Verdict:
    """Means over the tile of what only integrals tell."""
    a, b = ours.astype(np.float64).mean((0, 1)), reference.astype(np.float64).mean((0, 1))
    worst = float((np.abs(a - b) / np.maximum(np.abs(b), floor)).max())
    passed = bool(np.isfinite(a).all()) and worst <= NOISY_MEAN
    return Verdict(passed, float(passed), 0.0, worst, (0, 0), a.tolist(), b.tolist())


def mutant(ours: np.ndarray) -> np.ndarray:
    """A picture that must fail where `ours` passes: 0.3 % brighter, and not black where it is black."""
    return np.where(np.abs(ours) > 1e-2, ours * MUTANT, ours + 3e-3)
