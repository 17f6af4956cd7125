# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter by F12 and after it, on the compiled engine: the factory cube on a floor, lit by a lamp and its world."""

from __future__ import annotations

import json
import sys

import bpy
import conftest
import numpy as np
import pictures
import pytest
from test_real_engine import combined, scene  # noqa: F401  (scene is a fixture)

pytestmark = conftest.needs_engine

OWN = ("raw", "filtered", "withheld")


@pytest.fixture
def noisy(scene):  # noqa: F811
    """Filtered as the factory file wants it, with every pass of the filter."""
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 0, -1))
    for name in OWN:
        setattr(bpy.context.view_layer.cardioid, f"use_pass_{name}", True)
    scene.cardioid.follow("use_filter")
    scene.cardioid.clamp = 0
    scene.cardioid.samples = 4
    return scene


def own(channels, name: str) -> np.ndarray:
    return combined(channels, name=f"Cardioid {name}")


def filter_again(folder, name="again"):
    pictures.set_exr(bpy.context.scene, True)
    bpy.context.scene.render.filepath = str(folder / f"{name}.exr")
    assert bpy.ops.cardioid.filter_again(write_still=True) == {"FINISHED"}
    return pictures.read(folder / f"{name}.exr")


def roughness_of(picture: np.ndarray) -> float:
    """Mean step between neighbours: noise, mostly."""
    return float(np.abs(np.diff(picture, axis=1)).mean())


def test_the_factory_file_is_filtered(noisy, render):
    channels = render()
    picture, raw = combined(channels), own(channels, "Raw")
    np.testing.assert_array_equal(picture, own(channels, "Filtered"))
    assert np.isfinite(picture).all() and roughness_of(picture) < 0.7 * roughness_of(raw)
    assert picture.mean() == pytest.approx(raw.mean() - own(channels, "Withheld").mean(), rel=0.03)


def test_off_is_the_raw_picture_at_once_and_later(noisy, render, tmp_path):
    filtered = render("filtered")
    noisy.cardioid.use_filter = False
    for channels in (render("off"), filter_again(tmp_path)):
        np.testing.assert_array_equal(combined(channels), own(filtered, "Raw"))
        np.testing.assert_array_equal(own(channels, "Raw"), own(filtered, "Raw"))
        np.testing.assert_array_equal(own(channels, "Filtered"), own(filtered, "Raw"))
        assert own(channels, "Withheld").max() == 0


def test_filtering_again_is_as_rendering_with_these_settings(noisy, render, tmp_path):
    noisy.cardioid.filter_size, noisy.cardioid.firefly_density = 5, 0.2
    fresh = render("fresh")
    noisy.cardioid.filter_size, noisy.cardioid.firefly_density = 11, 0.0661157
    other = render("other")
    assert not np.array_equal(combined(fresh), combined(other))
    noisy.cardioid.filter_size, noisy.cardioid.firefly_density = 5, 0.2
    again = filter_again(tmp_path)
    assert set(again) == set(fresh)
    for name in fresh:
        np.testing.assert_array_equal(again[name], fresh[name], err_msg=name)


def test_a_film_of_last_week(noisy, render, tmp_path):
    """Saved by an animation, opened in a fresh file."""
    noisy.cardioid.save_film = True
    pictures.set_exr(noisy, True)
    noisy.render.filepath = str(tmp_path / "frame_####")
    noisy.frame_start = noisy.frame_end = 3
    bpy.ops.render.render(animation=True)
    film = tmp_path / "frame_0003.cardioid"
    rendered = combined(pictures.read(tmp_path / "frame_0003.exr"))
    bpy.ops.object.delete()
    bpy.ops.cardioid.free_film()
    assert bpy.ops.cardioid.open_film(filepath=str(film)) == {"FINISHED"}
    np.testing.assert_array_equal(combined(filter_again(tmp_path)), rendered)
    noisy.cardioid.use_filter = False
    assert roughness_of(combined(filter_again(tmp_path))) > roughness_of(rendered)


def test_a_border_keeps_its_film(noisy, render, tmp_path):
    noisy.render.use_border = True
    noisy.render.border_min_x, noisy.render.border_max_x = 0.25, 0.75
    noisy.render.border_min_y, noisy.render.border_max_y = 0.25, 0.75
    for cropped in (False, True):
        noisy.render.use_crop_to_border = cropped
        noisy.cardioid.filter_size = 7
        fresh = combined(render("fresh"))
        noisy.cardioid.filter_size = 3
        render("other")
        noisy.cardioid.filter_size = 7
        np.testing.assert_array_equal(combined(filter_again(tmp_path)), fresh)


def test_statistics_and_metadata(noisy, render, monkeypatch, tmp_path, capfd):
    path = tmp_path / "stats.json"
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-stats", str(path), "--cardioid-print-stats"])
    render("stamped")
    told = json.loads(path.read_text())["renders"][-1]["engine"]["filter"]
    assert told["seconds"] > 0 and told["clusters"] >= told["singles"] > 0 and 0 <= told["withheld_share"] < 0.5
    stamped = pictures.metadata(tmp_path / "stamped.exr")
    assert float(stamped["cardioid.ViewLayer.filter.withheld_share"]) == pytest.approx(told["withheld_share"], abs=1e-6)
    assert "Light withheld" in capfd.readouterr().out


def test_damaged_films_are_named(noisy, render, tmp_path):
    render()
    good = tmp_path / "good.cardioid"
    bpy.ops.cardioid.save_film(filepath=str(good))
    content = good.read_bytes()
    damaged = {"cut": content[: len(content) // 2], "empty": b"", "flipped": flipped(content), "foreign": b"P6 1 1 255"}
    for name, data in damaged.items():
        (tmp_path / f"{name}.cardioid").write_bytes(data)
        with pytest.raises(RuntimeError, match=f"{name}.cardioid"):
            bpy.ops.cardioid.open_film(filepath=str(tmp_path / f"{name}.cardioid"))
    assert bpy.ops.cardioid.filter_again() == {"FINISHED"}  # the film of the render is still there


def flipped(content: bytes) -> bytes:
    changed = bytearray(content)
    changed[len(changed) * 3 // 4] ^= 16
    return bytes(changed)


def test_adaptive_sampling_stops_early(scene, render, monkeypatch, tmp_path):  # noqa: F811
    """The background needs no more samples than the least."""
    path = tmp_path / "stats.json"
    scene.cardioid.samples, scene.cardioid.use_filter = 64, False
    scene.cardioid.adaptive_threshold, scene.cardioid.adaptive_min_samples = 0.2, 8
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-stats", str(path)])
    pictures_of = {}
    for adaptive in (False, True):
        scene.cardioid.use_adaptive_sampling = adaptive
        pictures_of[adaptive] = combined(render(f"adaptive_{adaptive}"))
    assert not np.array_equal(pictures_of[False], pictures_of[True])
    assert pictures_of[True].mean() == pytest.approx(pictures_of[False].mean(), rel=0.02)
