# SPDX-License-Identifier: GPL-3.0-or-later
"""The bench's figures on pictures whose errors are known."""

import importlib.util

import numpy as np
import pytest

from bench import metrics


def flat(value, size=(40, 50)) -> np.ndarray:
    return np.full((*size, 3), value, np.float64)


def test_relative_squared_error_of_a_constant_offset():
    got = metrics.evaluate(flat(0.6), flat(0.5))
    assert got["relmse"] == pytest.approx(0.01 / (0.25 + 0.01))
    assert got["rmse"] == pytest.approx(0.1)
    assert got["energy"] == pytest.approx(1.2)


def test_the_trimmed_error_drops_one_pixel_in_a_thousand():
    image = flat(0.5)
    image[3, 4] = 100.0
    image[5, 6] = 100.0
    got = metrics.evaluate(image, flat(0.5))
    assert got["relmse"] > 1.0
    assert got["relmse_trim"] == 0.0
    image[7, 8] = 100.0
    assert metrics.evaluate(image, flat(0.5))["relmse_trim"] > 1.0


def test_only_the_masks_pixels_count():
    image, mask = flat(0.5), np.zeros((40, 50), bool)
    image[:10] = 0.9
    mask[10:] = True
    assert metrics.evaluate(image, flat(0.5), mask)["relmse"] == 0.0
    assert metrics.evaluate(image, flat(0.5), ~mask)["energy"] == pytest.approx(1.8)


def test_channels_are_averaged_before_the_relative_error():
    image = flat(0.5)
    image[..., 0] += 0.1
    image[..., 2] -= 0.1
    got = metrics.evaluate(image, flat(0.5))
    assert got["relmse"] == pytest.approx(0.0, abs=1e-20)
    assert got["rmse"] == pytest.approx(np.sqrt(2 * 0.01 / 3))


def test_the_references_own_error_is_that_of_its_mean():
    rng = np.random.default_rng(1)
    stack = 0.5 + 0.1 * np.repeat(rng.standard_normal((16, 60, 60, 1)), 3, axis=-1)
    got = metrics.reference_error(stack)
    assert got["mse"] == pytest.approx(0.01 / 16, rel=0.05)
    assert got["relmse"] == pytest.approx(0.01 / 16 / 0.26, rel=0.05)
    assert metrics.evaluate(stack.mean(0), flat(0.5, (60, 60)))["rmse"] ** 2 == pytest.approx(got["mse"], rel=0.1)


@pytest.mark.skipif(importlib.util.find_spec("flip_evaluator") is None, reason="flip-evaluator is not installed")
def test_flip_is_zero_for_equal_pictures_and_grows_with_the_error():
    reference = np.linspace(0.1, 1.0, 50)[None, :, None] * np.ones((40, 1, 3))
    errors = [metrics.flip(reference * f, reference) for f in (1.0, 1.1, 1.5)]
    assert errors[0] == pytest.approx(0.0, abs=1e-6)
    assert errors[0] < errors[1] < errors[2]


@pytest.mark.skipif(importlib.util.find_spec("OpenEXR") is None, reason="OpenEXR is not installed")
def test_a_picture_survives_its_file(tmp_path):
    from bench import exr

    pixels = np.random.default_rng(2).random((12, 17, 3)).astype(np.float32) * 100
    exr.save(tmp_path / "a.exr", pixels)
    assert np.array_equal(exr.load(tmp_path / "a.exr"), pixels)
