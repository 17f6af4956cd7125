# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad node trees and pictures: Blender lives, the message says what was wrong, the rest of the picture is right. What
each scene shows was checked with Cycles (CARDIOID_TEST_ENGINE=CYCLES). The scenes: cases_nodes.py, cases_images.py."""

from __future__ import annotations

import pytest
from conftest import finished

LIGHT = [0.25, 0.5, 0.75]
PINK = [1.0, 0.0, 1.0]


def near(values: list[float], expected: list[float], tolerance: float = 2e-3) -> None:
    assert values[:3] == pytest.approx(expected, abs=tolerance)


@pytest.mark.parametrize(
    ("name", "mentions"),
    [
        ("library_that_is_gone", ["lib.blend", "Linked"]),
        ("shader_into_a_colour", []),
        ("colour_into_the_surface", []),
        ("link_from_a_hidden_socket", []),
        ("link_of_a_tree_to_itself", []),
        ("ramp_with_one_stop", []),
        ("ramp_with_equal_stops", []),
        ("node_of_a_newer_blender", ["From the future", "Tomorrow"]),
    ],
)
def test_the_light_is_as_without_the_mistake(cases, name: str, mentions: list[str]) -> None:
    near(finished(cases, name, *mentions)["mean"], LIGHT)


@pytest.mark.parametrize(
    ("name", "value"),
    [("curve_with_equal_points", 0.5), ("curve_with_equal_places", 0.96952), ("ten_thousand_nodes", 1.0)],
)
def test_values_of_odd_graphs(cases, name: str, value: float) -> None:
    near(finished(cases, name)["mean"], [value] * 3, 1e-3)


def test_ten_thousand_nodes_take_seconds(cases) -> None:
    assert finished(cases, "ten_thousand_nodes")["seconds"] < 20


@pytest.mark.parametrize(
    ("name", "file"), [("truncated_png", "cut.png"), ("empty_file", "empty.png"), ("image_of_no_size", "none.png")]
)
def test_a_picture_that_cannot_be_read_is_pink(cases, name: str, file: str) -> None:
    data = finished(cases, name, file)
    near(data["left"], PINK, 0.01)
    near(data["right"], LIGHT, 0.01)


@pytest.mark.parametrize(
    ("name", "color"),
    [("sixteen_bit_png", [0.5, 0.25, 0]), ("grey_png", [0.503, 0.503, 0.503]), ("cmyk_picture", [1, 0, 0])],
)
def test_odd_pictures_are_read(cases, name: str, color: list[float]) -> None:
    data = finished(cases, name)
    near(data["left"], color, 0.01)
    near(data["right"], LIGHT, 0.01)


def test_holes_in_an_hdri_do_not_spread(cases) -> None:
    """White over grey of 0.5, a handful of its pixels missing."""
    near(finished(cases, "nan_in_an_hdri")["mean"], [0.5] * 3, 0.03)


def test_missing_tiles_are_pink(cases) -> None:
    data = finished(cases, "missing_tiles", "skin", "1002")
    near(data["left"], [1, 0, 0], 0.02)
    near(data["right"], PINK, 0.02)


def test_textures_over_the_memory_bound_are_seen(cases) -> None:
    """Eight red squares of half a metre, in a picture of 1.9 by 1.425 metres: the outer ones are cut by its border."""
    data = finished(cases, "textures_over_the_memory_bound")
    near(data["mean"], [0.65, 0, 0], 0.02)
    assert data["highest"] == pytest.approx(1, abs=1e-3)
