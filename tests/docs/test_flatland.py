# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/figures/flatland.py: the drawings' light goes as light does."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs" / "figures"))
import flatland

ROOM = flatland.Room(flatland.Disc((0.5, 1.0), 0.4, ior=1.5))


@pytest.mark.parametrize("degrees", [0, 20, 50, 80])
def test_snell(degrees: float):
    angle = np.radians(degrees)
    d = flatland.refract(np.array([np.sin(angle), -np.cos(angle)]), np.array([0.0, 1.0]), 1 / 1.5)
    assert np.hypot(*d) == pytest.approx(1)
    assert d[0] == pytest.approx(np.sin(angle) / 1.5)
    assert d[1] < 0


def test_total_reflection():
    d = flatland.refract(np.array([np.sin(1.0), -np.cos(1.0)]), np.array([0.0, 1.0]), 1.5)
    assert d == pytest.approx([np.sin(1.0), np.cos(1.0)])


def test_a_ray_through_the_centre_is_not_bent():
    points, glass = flatland.trace(np.array([0.5, 2.5]), 0.0, ROOM)
    assert glass
    assert np.array(points)[:, 0] == pytest.approx([0.5] * 4)
    assert points[-1] == pytest.approx([0.5, 0.0])


def test_a_ray_that_misses_ends_on_the_floor():
    points, glass = flatland.trace(np.array([-1.0, 2.5]), 0.0, ROOM)
    assert not glass
    assert points[-1] == pytest.approx([-1.0, 0.0])


def test_parallel_rays_meet_near_the_focus_of_a_ball_lens():
    """Focal length of a ball lens from its middle: n r / (2 (n - 1)), for rays near the axis."""
    low = flatland.Room(flatland.Disc((0.0, 2.0), 0.4, ior=1.5))
    points, _ = flatland.trace(np.array([0.01, 2.55]), 0.0, low)
    out, end = points[-2], points[-1]
    crossing = out[1] + (end[1] - out[1]) * out[0] / (out[0] - end[0])
    assert 2.0 - crossing == pytest.approx(1.5 * 0.4 / (2 * 0.5), rel=0.01)
