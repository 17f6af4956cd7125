# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes for photons (cases_caustics.py): nothing crashes, no pixel is NaN, what has no caustic costs no photon."""

from __future__ import annotations

import pytest
from conftest import IS_CARDIOID, finished

pytestmark = pytest.mark.skipif(not IS_CARDIOID, reason="only Cardioid has photons")


def rendered(cases, name: str) -> dict:
    """A finished case in which nothing had to be dropped."""
    data = finished(cases, name)
    assert data["dropped"] == 0
    return data


def brightness(data: dict, picture: str = "mean") -> float:
    return sum(data[picture][:3]) / 3


def test_no_specular_object_no_photons(cases) -> None:
    data = rendered(cases, "caustics_without_specular_object")
    assert data["photons"]["emitted"] == 0 and data["photons"]["skipped_passes"] > 0
    assert brightness(data) == pytest.approx(brightness(data, "PT"), rel=0.03)
    assert brightness(data) > 0.1


@pytest.mark.parametrize("name", ["caustics_without_light", "caustics_of_dark_lamps"])
def test_no_light_no_photons(cases, name: str) -> None:
    data = rendered(cases, name)
    assert data["highest"] == data["lowest"] == 0
    assert data["photons"]["emitted"] == 0


def test_a_lamp_inside_stone_stays_there(cases) -> None:
    assert rendered(cases, "caustics_of_a_lamp_inside_stone")["highest"] == 0


def test_many_lamps_are_as_bright_as_one(cases) -> None:
    one, many = (rendered(cases, f"caustics_of_{name}") for name in ("one_lamp", "ten_thousand_lamps"))
    assert brightness(many) == pytest.approx(brightness(one), rel=0.1)
    assert many["photons"]["stored"] > 0 and many["seconds"] < 20


def test_a_negative_lamp_takes_light_away(cases) -> None:
    one, negative = rendered(cases, "caustics_of_one_lamp"), rendered(cases, "caustics_of_a_negative_lamp")
    assert negative["highest"] <= 0
    assert brightness(negative) == pytest.approx(-brightness(one), rel=0.05)


def test_glass_that_bends_nothing_is_not_there(cases) -> None:
    data = rendered(cases, "glass_that_bends_nothing")
    assert brightness(data) == pytest.approx(brightness(data, "bare"), rel=0.03)
    assert data["photons"]["stored"] > 0


@pytest.mark.parametrize(("name", "least"), [("glass_thinner_than_air", 0.4), ("glass_without_thickness", 0.4)])
def test_impossible_glass_makes_no_light(cases, name: str, least: float) -> None:
    data = rendered(cases, name)
    assert data["lowest"] >= 0
    assert least < brightness(data) / brightness(data, "bare") < 1.3


@pytest.mark.parametrize("name", ["glass_inside_glass", "camera_inside_glass"])
def test_glass_around_glass_and_camera(cases, name: str) -> None:
    data = rendered(cases, name)
    assert data["lowest"] >= 0 and brightness(data) > 0.1
    assert data["photons"]["stored"] > 0


def test_the_roughness_limit_moves_work_and_not_light(cases) -> None:
    names = ("zero", "at_the_threshold", "over_the_threshold")
    exact, at, over = (rendered(cases, f"roughness_{name}") for name in names)
    assert exact["photons"]["stored"] > 0 and at["photons"]["stored"] > 0 and over["photons"]["emitted"] == 0
    assert brightness(at) == pytest.approx(brightness(over), rel=0.02)
    assert brightness(exact) == pytest.approx(brightness(at), rel=0.02)


def test_photon_counts(cases) -> None:
    automatic, single = rendered(cases, "photons_by_themselves"), rendered(cases, "one_photon")
    assert automatic["photons"]["emitted"] > 1000 > single["photons"]["emitted"] > 0


def test_a_grain_of_glass_has_the_caustic_of_a_ball(cases) -> None:
    """1 mm and 1 m on a plain of 10 km, in the same proportions."""
    grain, large = (rendered(cases, f"{name}_of_glass_on_a_plain") for name in ("grain", "ball"))
    assert grain["highest"] > 2 * grain["lowest"]
    assert brightness(grain) == pytest.approx(brightness(large), rel=0.02)
