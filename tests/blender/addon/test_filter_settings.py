# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter's and adaptive sampling's settings: what the engine is told, and when it records a film."""

from __future__ import annotations

import bpy
import pytest


@pytest.fixture
def settings(addon):
    return bpy.context.scene.cardioid


def resolved(**keywords):
    from cardioid.resolve import resolve

    return resolve(bpy.context.scene, bpy.context.view_layer, **keywords)


def test_the_factory_file_is_filtered(settings):
    assert bpy.context.scene.cycles.use_denoising and settings.use_filter
    told = resolved()
    assert told["use_filter"] is True and told["filter_method"] == "clusters" and told["record_clusters"] is True


def test_filter_settings_reach_the_engine(settings):
    from cardioid.resolve import filter_settings

    settings.use_filter, settings.filter_method, settings.firefly_density = True, "CROSS_BILATERAL", 0.25
    settings.luminance_sensitivity, settings.filter_size, settings.texture_width = 0.25, 7, 0.5
    settings.filter_direct = settings.filter_indirect = settings.filter_deep = False
    wanted = {"use_filter": True, "filter_method": "cross_bilateral", "firefly_density": 0.25,
              "luminance_sensitivity": 0.25, "filter_size": 7, "texture_width": 0.5, "filter_direct": False,
              "filter_indirect": False, "filter_deep": False}
    told = resolved()
    assert {key: told[key] for key in wanted} == wanted == filter_settings(bpy.context.scene)
    assert filter_settings(bpy.context.scene, {"filter_method": "NONE", "samples": 3})["filter_method"] == "none"


@pytest.mark.parametrize("name, below, above", [
    ("firefly_density", (-1, 0), (1e9, 10)), ("luminance_sensitivity", (-1, 0), (1, 0.99)),
    ("filter_size", (0, 1), (1000, 63)), ("texture_width", (0, 0.0001), (1e9, 1000))])
def test_limits(settings, name, below, above):
    for given, kept in (below, above):
        setattr(settings, name, given)
        assert getattr(settings, name) == pytest.approx(kept)


def test_an_even_size_is_the_next_odd_one(settings):
    from cardioid.resolve import filter_settings

    for given, told in ((1, 1), (2, 3), (12, 13), (63, 63)):
        settings.filter_size = given
        assert resolved()["filter_size"] == filter_settings(bpy.context.scene)["filter_size"] == told


def test_a_film_is_recorded_where_it_has_a_use(settings):
    """This Blender has no window: a film for tuning alone would be memory for nothing."""
    assert bpy.app.background
    settings.use_filter = False
    assert settings.keep_film and resolved()["record_clusters"] is False
    settings.save_film = True
    assert resolved()["record_clusters"] is True
    settings.save_film = False
    bpy.context.view_layer.cardioid.use_pass_withheld = True
    assert resolved()["record_clusters"] is True
    bpy.context.view_layer.cardioid.use_pass_withheld = False
    bpy.context.view_layer.cardioid.use_pass_d1 = True
    assert resolved()["record_clusters"] is False
    assert resolved(overrides={"use_filter": True})["record_clusters"] is True


def test_a_window_keeps_films_for_tuning(settings, monkeypatch):
    from types import SimpleNamespace

    from cardioid import resolve

    monkeypatch.setattr(resolve, "bpy", SimpleNamespace(app=SimpleNamespace(background=False)))
    values = {"use_filter": False, "save_film": False, "keep_film": True}
    assert resolve.records_film(values) and not resolve.records_film({**values, "keep_film": False})


def test_noise_threshold(settings):
    cycles = bpy.context.scene.cycles
    assert resolved()["adaptive_threshold"] == pytest.approx(0.01) and resolved()["adaptive_min_samples"] == 0
    cycles.use_adaptive_sampling = False
    assert resolved()["adaptive_threshold"] == 0
    settings.use_adaptive_sampling, settings.adaptive_threshold = True, 0.125
    cycles.adaptive_min_samples = 24
    assert (resolved()["adaptive_threshold"], resolved()["adaptive_min_samples"]) == (0.125, 24)
    assert resolved(preview=True)["adaptive_threshold"] == 0


@pytest.mark.parametrize("samples, threshold", [(16, 1 / 16), (250, 0.004), (100000, 0.001)])
def test_a_noise_threshold_of_zero_is_automatic_as_in_cycles(settings, samples, threshold):
    settings.samples, settings.adaptive_threshold = samples, 0.0
    assert resolved()["adaptive_threshold"] == pytest.approx(threshold)


def test_command_line(addon):
    from cardioid import cli_args

    found = cli_args.parse(["--", "--cardioid-filter", "off", "--cardioid-filter-method", "none",
                            "--cardioid-firefly-density", "0.1", "--cardioid-luminance-sensitivity", "0.3",
                            "--cardioid-filter-size", "9", "--cardioid-filter-direct", "off",
                            "--cardioid-filter-indirect", "on", "--cardioid-filter-deep", "off",
                            "--cardioid-texture-width", "0.2", "--cardioid-adaptive-sampling", "on",
                            "--cardioid-adaptive-threshold", "0.02", "--cardioid-adaptive-min-samples", "8",
                            "--cardioid-save-film", "on", "--cardioid-film", "/tmp/#.cardioid"])
    assert found.problems == () and found.film == "/tmp/#.cardioid"
    assert found.overrides == {
        "use_filter": False, "filter_method": "NONE", "firefly_density": 0.1, "luminance_sensitivity": 0.3,
        "filter_size": 9, "filter_direct": False, "filter_indirect": True, "filter_deep": False, "texture_width": 0.2,
        "use_adaptive_sampling": True, "adaptive_threshold": 0.02, "adaptive_min_samples": 8, "save_film": True}


@pytest.mark.parametrize("words, expected", [
    (("--cardioid-filter", "maybe"), "--cardioid-filter: 'maybe' is not one of on, off"),
    (("--cardioid-filter-method", "oidn"), "'oidn' is not one of clusters, thesis, cross_bilateral, none"),
    (("--cardioid-luminance-sensitivity", "1"), "'1' is not a number from 0 to 0.99"),
    (("--cardioid-filter-size", "0"), "--cardioid-filter-size: '0' is not a whole number from 1 to 63"),
    (("--cardioid-filter-size", "64"), "'64' is not a whole number from 1 to 63"),
    (("--cardioid-firefly-density", "inf"), "'inf' is not a number from 0 to 10"),
])
def test_wrong_values_are_told(addon, words, expected):
    from cardioid import cli_args

    problems = cli_args.parse(["--", *words]).problems
    assert len(problems) == 1 and expected in problems[0]
