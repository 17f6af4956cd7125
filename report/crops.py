# SPDX-License-Identifier: GPL-3.0-or-later
"""Where pictures of one scene differ most."""

from __future__ import annotations

import numpy as np

Place = tuple[int, int]
"""Left and top corner of a square, in pixels from the top left."""


SIDE = 44
"""Of a crop's square, in pixels."""


def side(height: int, width: int) -> int:
    """Of a crop's square in a picture of this size: at most a third of it."""
    return max(1, min(SIDE, height // 3, width // 3))


def difference(pictures: list[np.ndarray], reference: np.ndarray | None) -> np.ndarray:
    """(height, width): mean distance of the pictures (height, width, 3; 0…1) to the reference, or to their own mean.

    A pixel's distance counts up to ¼, so that a region of many wrong pixels beats a few fireflies.
    """
    base = np.mean(pictures, axis=0) if reference is None else reference
    return np.mean([np.minimum(np.abs(p - base).mean(axis=2), 0.25) for p in pictures], axis=0)


def window_sums(values: np.ndarray, size: int) -> np.ndarray:
    """Sums over every size × size window of (height, width) values, by its top left corner."""
    sums = np.pad(values, ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)
    return sums[size:, size:] - sums[:-size, size:] - sums[size:, :-size] + sums[:-size, :-size]


def places(pictures: list[np.ndarray], reference: np.ndarray | None, size: int, count: int = 3) -> list[Place]:
    """Up to `count` squares where the pictures differ most, the first most.

    They are two sides apart, in large pictures a quarter of the picture, so that they show different things.
    """
    sums = window_sums(difference(pictures, reference), size)
    apart = max(2 * size, min(pictures[0].shape[:2]) // 4)
    found: list[Place] = []
    while len(found) < count and sums.max() > 1e-6 * size * size:
        y, x = np.unravel_index(int(np.argmax(sums)), sums.shape)
        found.append((int(x), int(y)))
        sums[max(y - apart + 1, 0) : y + apart, max(x - apart + 1, 0) : x + apart] = 0.0
    return found
