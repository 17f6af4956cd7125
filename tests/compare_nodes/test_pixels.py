# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison of tiles must pass equal tiles and fail small changes."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))

import pixels


def tile(seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-2.0, 3.0, (32, 32, 3)).astype(np.float32)


def check(ours: np.ndarray, *references: np.ndarray, tolerance: float = 1e-3) -> pixels.Verdict:
    return pixels.compare(ours, np.array(references), tolerance, 1e-2)


def test_equal_tiles_pass():
    verdict = check(tile(), tile(), tile(), tile())
    assert verdict.passed and verdict.within == 1.0 and verdict.explained == 0.0


def test_last_bits_pass():
    assert check(tile() * np.float32(1 + 3e-7), tile()).passed


@pytest.mark.parametrize("tolerance", [1e-3, 2e-3])
def test_mutant_fails(tolerance):
    """0.3 % brighter everywhere fails at both bounds, also where the picture is black."""
    assert not check(pixels.mutant(tile()), tile(), tolerance=tolerance).passed
    black = np.zeros_like(tile())
    assert not check(pixels.mutant(black), black, tolerance=tolerance).passed


def test_one_pixel_is_allowed_and_two_are_not():
    a = tile()
    a[3, 4] += 1.0
    one = check(a, tile())
    assert one.passed and one.within < 1.0 and one.at == (4, 3)
    a[9, 9, 1] += 1.0
    assert not check(a, tile()).passed


def test_unfirm_pixels_are_explained_up_to_a_share():
    a, moved = tile(), tile()
    a[:1] += 1.0
    moved[:1] -= 1.0
    verdict = check(a, tile(), moved, tile())
    assert verdict.passed and verdict.explained == pytest.approx(1 / 32)
    a[:3] += 1.0
    moved[:3] -= 1.0
    assert not check(a, tile(), moved, tile()).passed


def test_firm_pixels_are_never_explained():
    a, moved = tile(), tile()
    a[:1] += 1.0
    moved[5:6] -= 1.0
    assert not check(a, tile(), moved, tile()).passed


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_values_that_are_not_finite_fail(value):
    a, moved = tile(), tile()
    a[:1] = value
    moved[:1] -= 1.0
    assert not check(a, tile(), moved, tile()).passed


def test_noisy_tiles_compare_means():
    assert pixels.compare_noisy(tile(1) + 10, tile(2) + 10, 1e-2).passed
    assert not pixels.compare_noisy((tile(1) + 10) * 1.03, tile(2) + 10, 1e-2).passed
