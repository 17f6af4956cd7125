# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes: each renders without a crash or a traceback, the rest of the scene is right, and the message says what
was wrong. The scenes are in cases_materials.py and cases_objects.py; all run in one Blender (fixture `cases`)."""

from __future__ import annotations

import pytest
from conftest import IS_CARDIOID, finished

LIGHT = [0.25, 0.5, 0.75]
PINK = [1.0, 0.0, 1.0]
BLACK = [0.0, 0.0, 0.0]


def near(values: list[float], expected: list[float], tolerance: float = 2e-3) -> None:
    assert values[:3] == pytest.approx(expected, abs=tolerance)


@pytest.mark.parametrize(
    ("name", "mentions"),
    [
        ("good_scene", []),
        ("mesh_without_faces", []),
        ("nan_vertices", ["Broken"]),
        ("infinite_vertices", ["Endless"]),
        ("nan_transform", ["Lost object"]),
        ("flat_transform", []),
        ("degenerate_triangles", []),
        ("slot_index_out_of_range", []),
        ("group_inside_itself", []),
        ("collection_inside_itself", []),
        ("nan_lamp", ["Broken lamp"]),
        ("one_pixel", []),
        ("one_pixel_border", []),
        ("two_renders_in_a_row", []),
        ("render_from_a_handler", []),
        ("scene_after_all_that", []),
    ],
)
def test_the_rest_of_the_scene_is_right(cases, name: str, mentions: list[str]) -> None:
    data = finished(cases, name, *mentions)
    near(data["mean"], LIGHT)


@pytest.mark.parametrize("name", ["one_pixel", "one_pixel_border"])
def test_a_picture_of_one_pixel(cases, name: str) -> None:
    assert finished(cases, name)["size"] == [1, 1]


@pytest.mark.parametrize(
    ("name", "mentions"),
    [("missing_image", ["gone.png"]), ("file_that_is_no_image", ["text.png"]), ("image_node_without_image", [])],
)
def test_an_image_that_cannot_be_read_is_pink(cases, name: str, mentions: list[str]) -> None:
    near(finished(cases, name, *mentions)["mean"], PINK)


@pytest.mark.parametrize("name", ["packed_image", "painted_image"])
def test_images_inside_the_blend_file(cases, name: str) -> None:
    data = finished(cases, name)
    near(data["left"], [1, 0, 0], 0.05)
    near(data["right"], [0, 0, 1], 0.05)


def test_generated_image(cases) -> None:
    near(finished(cases, "generated_image")["mean"], [0, 1, 0])


def test_no_uv_map_reads_the_corner_of_the_image(cases) -> None:
    data = finished(cases, "no_uv_map")
    assert data["highest"] - data["lowest"] > 0.1
    near(data["left"], data["right"][:3])


def test_no_camera_is_one_clear_error(cases) -> None:
    case = cases["no_camera"]
    case.check_clean()
    assert "no camera" in case.data["status"].lower()
    assert not case.data["written"]


def test_a_mesh_as_camera(cases) -> None:
    """Blender allows any object as a camera; there is nothing to see in the square that looks down from itself."""
    finished(cases, "camera_is_a_mesh")


@pytest.mark.parametrize("name", ["no_light", "nothing_at_all", "material_without_output"])
def test_black_where_nothing_shines(cases, name: str) -> None:
    data = finished(cases, name)
    near(data["mean"], BLACK, 0)
    assert data["mean"][3] == pytest.approx(1)


def test_empty_scene_shows_the_world(cases) -> None:
    data = finished(cases, "empty_scene")
    near([data["lowest"], data["highest"]], [0.5, 0.5], 1e-4)


@pytest.mark.parametrize("name", ["degenerate_uvs", "nan_uvs"])
def test_useless_uvs_still_shade(cases, name: str) -> None:
    """Grey 0.5 under a white sky: the bent normal may lose some light, but no more than a third of it."""
    data = finished(cases, name)
    assert all(1 / 3 <= x <= 0.51 for x in data["mean"][:3]), data["mean"]


def test_slot_without_material_is_the_default_grey(cases) -> None:
    data = finished(cases, "slot_without_material")
    near(data["left"], [0.8, 0.8, 0.8], 0.02)
    near(data["right"], LIGHT, 0.02)


@pytest.mark.parametrize(
    ("name", "mentions"),
    [("loop_through_groups", []), ("empty_node_group", []), ("unknown_node", ["Point Density"])],
)
def test_the_object_beside_a_broken_material_is_right(cases, name: str, mentions: list[str]) -> None:
    near(finished(cases, name, *mentions)["right"], LIGHT, 0.02)


def test_an_unknown_node_is_named_once(cases) -> None:
    finished(cases, "unknown_node")
    lines = [line for line in cases["unknown_node"].text.splitlines() if "point density" in line.lower()]
    assert len(lines) == 1 or not IS_CARDIOID, lines


def test_lamps_of_size_zero(cases) -> None:
    data = finished(cases, "lamps_of_size_zero")
    assert data["mean"][0] > 0.5
    assert data["highest"] < 1000


def test_two_renders_give_the_same_picture(cases) -> None:
    assert finished(cases, "two_renders_in_a_row")["same"]


def test_a_picture_that_cannot_be_saved_is_kept(cases) -> None:
    case = cases["save_into_a_missing_folder"]
    case.check_clean()
    assert "cannot save" in case.data["status"]
    near(case.data["mean"], LIGHT)
