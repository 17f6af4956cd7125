# SPDX-License-Identifier: GPL-3.0-or-later
"""The statistics of the comparison: known values, the rate of false alarms, and mutants that must be rejected."""

import numpy as np
import pytest
from compare import compare, mutants, student_quantile, student_tail, welch

SIZE = 96


def replicates(seed: int, count: int = 8, samples: float = 400.0, factor: float = 1.0) -> np.ndarray:
    """Pictures of a gradient with independent, skewed noise of relative variance 1/samples per pixel."""
    rng = np.random.default_rng(seed)
    base = np.linspace(0.2, 1.0, SIZE)[None, :, None, None] * np.array([1.0, 0.7, 0.4, 0.0])
    noise = rng.gamma(samples, 1.0 / samples, (count, SIZE, SIZE, 1))
    images = np.broadcast_to(base, (1, SIZE, SIZE, 4)) * noise * factor
    images[..., 3] = 1.0
    return images.astype(np.float32)


@pytest.mark.parametrize(
    ("p", "dof", "t"), [(0.01, 14, 2.624494), (0.05, 5, 2.015048), (0.25, 1, 1.0), (0.01, 1000, 2.330083)]
)
def test_student_quantile_agrees_with_the_tables(p, dof, t):
    assert student_quantile(p, dof) == pytest.approx(t, rel=1e-5)
    assert student_tail(t, dof) == pytest.approx(p, rel=1e-5)


def test_equal_distributions_pass_every_time():
    verdicts = [compare(replicates(2 * i), replicates(2 * i + 1)).verdict for i in range(20)]
    assert verdicts == ["pass"] * 20


def test_welch_rejects_no_difference_at_its_level():
    rng = np.random.default_rng(7)
    p_values = np.array([welch(rng.normal(1, 0.1, 8), rng.normal(1, 0.2, 8), 1.0).p_value for _ in range(2000)])
    assert 0.03 < (p_values < 0.05).mean() < 0.07


@pytest.mark.parametrize("factor", [0.98, 1.02, 1.0125])
def test_a_scaled_picture_is_rejected(factor):
    assert compare(replicates(1, factor=factor), replicates(2)).verdict == "fail"


def test_mutants_are_rejected():
    a, b = replicates(3), replicates(4)
    for name, mutant in mutants(a).items():
        assert compare(mutant, b).verdict == "fail", name


def test_noise_is_inconclusive_and_not_a_pass():
    assert compare(replicates(5, samples=0.2), replicates(6, samples=0.2)).verdict == "inconclusive"


def test_black_and_broken_pictures_fail():
    b = replicates(8)
    broken = b.copy()
    broken[0, 0, 0, 0] = np.nan
    assert compare(np.zeros_like(b), b).problem == "black picture"
    assert compare(broken, b).problem == "not finite"
    assert compare(b[:, :48], b).verdict == "fail"


def test_a_wrong_colour_is_rejected_even_if_the_brightness_is_right():
    a, b = replicates(9), replicates(10)
    a[..., 0] *= 0.98
    a[..., 1] *= 1.0 + 0.02 / 0.7
    assert compare(a, b).verdict == "fail"


def test_dark_blocks_are_measured_against_the_picture():
    a, b = replicates(11), replicates(12)
    for x in (a, b):
        x[:, :12, :12, :3] *= 1e-4
    a[:, :12, :12, :3] *= 1.5
    assert compare(a, b).verdict == "pass"
