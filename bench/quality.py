# SPDX-License-Identifier: GPL-3.0-or-later
"""How good a filtered picture is: error, energy, fireflies, texture, edges of light; net of the reference's noise."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from . import metrics, regions

FIREFLY, FIREFLY_FLOOR, FIREFLY_REACH = 0.5, 0.1, 2
"""A firefly is brighter by this share than the brightest reference pixel within so many pixels, and by this share of
the reference's mean."""
FEWEST = 0.05
"""The share of the picture that a region must have to be judged."""


@dataclass
class Referee:
    """A reference of independent parts, (n, h, w, 3), n even, and the masks of its regions."""

    parts: np.ndarray
    masks: dict[str, np.ndarray]
    paths: list[Path] = field(default_factory=list)
    """Of the parts' pictures, which hold the path classes too."""

    def __post_init__(self):
        self.mean = self.parts.mean(0)
        self.halves = self.parts[0::2].mean(0), self.parts[1::2].mean(0)

    def own_error(self, mask: np.ndarray | None = None) -> float:
        """The reference's expected relmse: it comes on top of every picture's and is taken off."""
        return metrics.reference_error(self.parts, mask)["relmse"]


def high_pass(picture: np.ndarray, level: np.ndarray) -> np.ndarray:
    """Fine detail as a share of the reference's local level."""
    tone = regions.luminance(picture)
    return (tone - regions.blur(tone, regions.TEXTURE_WIDTH)) / level


def texture_kept(picture: np.ndarray, referee: Referee, mask: np.ndarray) -> float:
    """Correlation of fine detail with the noise-free reference's, whose variance is the halves' covariance.

    1: all texture and no noise; blurring and noise both take from it.
    """
    level = regions.blur(regions.luminance(referee.mean), regions.TEXTURE_WIDTH) + 0.01
    own = high_pass(picture, level)[mask]
    first, second = (high_pass(half, level)[mask] for half in referee.halves)
    truth = float(np.cov(first, second)[0, 1])
    shared = float(np.cov(own, (first + second) / 2)[0, 1])
    return shared / np.sqrt(max(truth * float(own.var()), 1e-30))


def fireflies(picture: np.ndarray, reference: np.ndarray) -> int:
    """How many pixels are far brighter than anything near them in the reference."""
    tone, truth = regions.luminance(picture), regions.luminance(reference)
    reach = FIREFLY_REACH
    padded = np.pad(truth, reach, "edge")
    height, width = truth.shape
    steps = range(2 * reach + 1)
    brightest = np.max([padded[i : i + height, j : j + width] for i in steps for j in steps], axis=0)
    return int((tone > (1 + FIREFLY) * brightest + FIREFLY_FLOOR * truth.mean()).sum())


def evaluate(picture: np.ndarray, referee: Referee) -> dict[str, float | None]:
    """All figures of a picture; errors but relmse_trim are net of the reference's own; small regions are left out."""
    found = metrics.evaluate(picture, referee.mean)
    out: dict[str, float | None] = {
        "relmse": found["relmse"] - referee.own_error(),
        "relmse_trim": found["relmse_trim"],
        "reference": referee.own_error(),
        "flip": metrics.flip(picture, referee.mean),
        "energy": found["energy"],
        "fireflies": fireflies(picture, referee.mean),
    }
    lit, textured = referee.masks["light edges"], referee.masks["texture"]
    if lit.mean() > FEWEST:
        out["light_edges"] = metrics.evaluate(picture, referee.mean, lit)["relmse"] - referee.own_error(lit)
    if textured.mean() > FEWEST:
        out["texture_kept"] = texture_kept(picture, referee, textured)
    return out
