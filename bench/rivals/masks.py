# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pixels of a reference see the lamp, and which a caustic."""

from __future__ import annotations

import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
LAMP_SHARE, CAUSTIC_SHARE = 0.005, 0.1
"""Of a pixel's luminance, from which on it counts as one that sees the lamp, or a caustic."""


def neighbours(mask: np.ndarray) -> np.ndarray:
    """How many of a pixel and its eight neighbours are set."""
    whole = np.pad(mask.astype(int), 1)
    height, width = mask.shape
    return sum(whole[dy : dy + height, dx : dx + width] for dy in range(3) for dx in range(3))


def of(picture: np.ndarray, caustics: np.ndarray, lamp: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """From the picture (h, w, 3) and its parts: pixels that see the lamp, with a border of one; those with a caustic,
    by the majority around each."""
    bright, focused, shining = (image @ LUMINANCE for image in (picture, caustics, lamp))
    emit = neighbours(shining > LAMP_SHARE * np.maximum(bright, 1e-6)) > 0
    caustic = neighbours((focused > CAUSTIC_SHARE * bright) & ~emit) >= 5
    return emit, caustic & ~emit
