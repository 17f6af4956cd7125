# SPDX-License-Identifier: GPL-3.0-or-later
"""scene.cardioid: names, following Cycles, and what the engine is told."""

from __future__ import annotations

import re
from pathlib import Path

import addon_utils
import bpy
import pytest

k_headers = Path(__file__).resolve().parents[3] / "engine_cpp" / "scene"

# property of scene.cardioid: (scene.cycles property, a value that is not the default, another one)
k_followed = {
    "samples": ("samples", 77, 5),
    "time_limit": ("time_limit", 12.0, 3.0),
    "use_adaptive_sampling": ("use_adaptive_sampling", False, True),
    "adaptive_threshold": ("adaptive_threshold", 0.25, 0.125),
    "adaptive_min_samples": ("adaptive_min_samples", 32, 16),
    "use_filter": ("use_denoising", False, True),
    "seed": ("seed", 9, 4),
    "use_animated_seed": ("use_animated_seed", True, False),
    "sample_offset": ("sample_offset", 16, 8),
    "max_bounces": ("max_bounces", 31, 7),
    "diffuse_bounces": ("diffuse_bounces", 6, 2),
    "glossy_bounces": ("glossy_bounces", 9, 3),
    "transmission_bounces": ("transmission_bounces", 20, 4),
    "volume_bounces": ("volume_bounces", 3, 2),
    "transparent_bounces": ("transparent_max_bounces", 33, 5),
    "clamp_direct": ("sample_clamp_direct", 4.0, 2.0),
    "clamp_indirect": ("sample_clamp_indirect", 3.0, 0.0),
    "reflective_caustics": ("caustics_reflective", False, True),
    "refractive_caustics": ("caustics_refractive", False, True),
    "filter_glossy": ("blur_glossy", 0.25, 0.0),
    "pixel_filter": ("pixel_filter_type", "GAUSSIAN", "BOX"),
    "filter_width": ("filter_width", 2.25, 3.0),
    "exposure": ("film_exposure", 1.75, 2.0),
    "transparent_glass": ("film_transparent_glass", True, False),
    "transparent_roughness": ("film_transparent_roughness", 0.375, 0.25),
}


@pytest.fixture
def settings(addon):
    bpy.context.scene.cardioid.follow("samples")
    return bpy.context.scene.cardioid


def resolved(**keywords):
    from cardioid.resolve import resolve

    return resolve(bpy.context.scene, bpy.context.view_layer, **keywords)


def test_every_followed_setting_is_tested(addon):
    from cardioid.settings_table import k_settings

    assert {setting.name: setting.cycles for setting in k_settings if setting.cycles} == {
        name: rule[0] for name, rule in k_followed.items()}


@pytest.mark.parametrize("name", k_followed)
def test_follows_cycles_until_changed(settings, name):
    cycles = bpy.context.scene.cycles
    source, first, second = k_followed[name]
    assert getattr(settings, name) == getattr(cycles, source) and not settings.is_own(name)
    setattr(cycles, source, first)
    assert getattr(settings, name) == first
    setattr(settings, name, second)
    assert getattr(settings, name) == second and settings.is_own(name) and name in settings.own_names()
    setattr(cycles, source, getattr(type(cycles).bl_rna.properties[source], "default", first))
    assert getattr(settings, name) == second
    bpy.ops.cardioid.follow_cycles(setting=name)
    assert not settings.is_own(name) and getattr(settings, name) == getattr(cycles, source)


@pytest.mark.parametrize("name", k_followed)
def test_default_is_cycles_default(settings, name):
    from cardioid.settings_table import k_by_name

    source = bpy.types.Scene.bl_rna.properties["cycles"].fixed_type.properties[k_followed[name][0]]
    default = source.default
    assert k_by_name[name].default == (pytest.approx(default) if isinstance(default, float) else default)


def test_reset_all(settings):
    settings.samples, settings.exposure = 3, 2.0
    assert sorted(settings.own_names()) == ["exposure", "samples"]
    bpy.ops.cardioid.follow_cycles()
    assert settings.own_names() == [] and settings.samples == bpy.context.scene.cycles.samples


def test_own_values_are_saved_and_the_rest_follows_on(settings, tmp_path):
    settings.seed = 123
    path = str(tmp_path / "file.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    loaded = bpy.context.scene.cardioid
    assert loaded.seed == 123 and loaded.own_names() == ["seed"]
    bpy.context.scene.cycles.samples = 21
    assert loaded.samples == 21


def test_without_cycles_its_defaults_and_what_the_file_stored(settings, tmp_path):
    cycles = bpy.context.scene.cycles
    cycles.max_bounces, cycles.pixel_filter_type = 5, "GAUSSIAN"
    addon_utils.disable("cycles")
    try:
        assert not hasattr(bpy.types.Scene, "cycles")
        assert settings.samples == 4096 and settings.clamp_indirect == 10 and settings.reflective_caustics is True
        assert settings.max_bounces == 5 and settings.pixel_filter == "GAUSSIAN"
        assert resolved()["max_bounces"] == 5
    finally:
        addon_utils.enable("cycles")


def test_clamp_sets_both(settings):
    settings.clamp = 2.5
    assert (settings.clamp_direct, settings.clamp_indirect, settings.clamp) == (2.5, 2.5, 2.5)
    settings.clamp = 0
    assert resolved()["clamp_direct"] == resolved()["clamp_indirect"] == 0


def test_names_that_scripts_rely_on(settings):
    settings.integrator = "PT"
    settings.time_limit = 1.5
    settings.threads = 3
    settings.filter_width = 2.0
    settings.pixel_filter = "BLACKMAN_HARRIS"
    told = resolved()
    assert told["integrator"] == "path_tracing" and told["time_limit"] == 1.5 and told["threads"] == 3
    assert told["pixel_filter"] == "blackman_harris" and told["filter_width"] == 2.0
    for name in ("integrator", "samples", "time_limit", "max_bounces", "seed", "threads", "clamp", "pixel_filter",
                 "filter_width"):
        assert settings.bl_rna.properties[name].description, name


def test_ptppm_is_the_default(settings):
    assert settings.integrator == "PTPPM"
    assert resolved()["integrator"] == "hybrid"


def test_only_integrators_that_exist_are_offered(fresh_file, fake):
    import cardioid

    cardioid.register()
    try:
        bpy.context.scene.cardioid.integrator = "SPPM"
        assert resolved()["integrator"] == "photon_mapping"
    finally:
        cardioid.unregister()
    fake.behaviour.integrators = ["PT"]
    cardioid.core.forget()
    cardioid.register()
    try:  # the file still says SPPM
        with pytest.raises(ValueError, match="choose another"):
            resolved()
        with pytest.raises(TypeError, match="PTPPM"):
            bpy.context.scene.cardioid.integrator = "PTPPM"
        bpy.context.scene.cardioid.integrator = "PT"
        assert resolved()["integrator"] == "path_tracing"
    finally:
        cardioid.unregister()


def engine_defaults():
    """Field of the engine's Settings to its default as it is written in C++ ("" without one). Those of the filter stand
    beside the others."""
    fields = declared("scene_desc.h", "Settings")
    assert "filter" in fields
    del fields["filter"]
    return fields | declared("filter_settings.h", "FilterSettings")


def declared(header, name):
    body = re.search(rf"struct {name} \{{(.*?)\n\}};", (k_headers / header).read_text(), re.S).group(1)
    body = re.sub(r"//.*", "", body)
    fields = {}
    for statement in body.split(";"):
        declaration = re.sub(r"\{[^}]*\}", "", statement).strip()
        if declaration:
            names = re.sub(r"^[\w:]+(<[^>]*>)?\s+", "", declaration)
            fields.update(re.match(r"\s*(\w+)(?:\s*=\s*(\S+))?", part).groups("") for part in names.split(","))
    return fields


def test_own_settings_have_the_engines_defaults(settings):
    """Settings that follow Cycles have Cycles' defaults instead (test_default_is_cycles_default)."""
    from cardioid.settings_table import k_settings

    written = engine_defaults()
    own = [setting for setting in k_settings if setting.cycles is None and setting.key]
    assert {"photons", "photon_radius", "caustic_roughness", "indirect_caustics", "guided_emission"} <= {
        setting.name for setting in own}
    for setting in own:
        text = written[setting.key]
        if setting.kind == "enum":
            assert text.split("::")[-1] == setting.default.lower(), setting.name
        elif setting.kind == "bool":
            assert text == str(setting.default).lower(), setting.name
        else:
            assert float(text.rstrip("f")) == pytest.approx(setting.default, rel=1e-6), setting.name
        assert getattr(settings, setting.name) == (
            pytest.approx(setting.default, rel=1e-6) if setting.kind == "float" else setting.default)


def test_caustics_settings_reach_the_engine(settings):
    settings.indirect_caustics, settings.radius_schedule = "PATH_TRACING", "PER_PIXEL"
    settings.photons, settings.photon_radius, settings.caustic_roughness = 123456, 3.5, 0.25
    settings.radius_shrink, settings.guided_emission = 0.5, False
    settings.blend_caustic_hits, settings.physical_refraction = False, True
    wanted = {"indirect_caustics": "path_tracing", "radius_schedule": "per_pixel", "photons": 123456,
              "photon_radius": 3.5, "caustic_roughness": 0.25, "radius_shrink": 0.5, "guided_emission": False,
              "blend_caustic_hits": False, "physical_refraction": True}
    for integrator in ("PTPPM", "SPPM"):
        settings.integrator = integrator
        told = resolved()
        assert {key: told[key] for key in wanted} == wanted
    settings.integrator = "PT"
    assert resolved()["caustic_roughness"] == 0
    assert resolved(overrides={"integrator": "SPPM"})["caustic_roughness"] == 0.25


def test_every_key_of_the_engines_settings(settings):
    fields = set(engine_defaults())
    assert {"integrator", "max_glossy_bounces", "clamp_indirect", "ocio_config"} <= fields
    by_exporter = {"width", "height", "crop"}
    assert set(resolved()) == fields - by_exporter


def test_blenders_threads(settings):
    render = bpy.context.scene.render
    assert resolved()["threads"] == 0
    render.threads_mode, render.threads = "FIXED", 3
    assert resolved()["threads"] == 3
    settings.threads = 5
    assert resolved()["threads"] == 5


def test_box_filter_is_one_pixel_wide(settings):
    settings.pixel_filter, settings.filter_width = "BOX", 4.0
    assert resolved()["filter_width"] == 1.0


def test_layer_samples(settings):
    layer, cycles = bpy.context.view_layer, bpy.context.scene.cycles
    cycles.samples, layer.samples = 50, 80
    assert resolved()["samples"] == 80
    cycles.use_layer_samples = "BOUNDED"
    assert resolved()["samples"] == 50
    cycles.use_layer_samples = "IGNORE"
    assert resolved()["samples"] == 50
    cycles.use_layer_samples, settings.samples = "USE", 6
    assert resolved()["samples"] == 6


def test_sample_offset(settings):
    cycles = bpy.context.scene.cycles
    cycles.sample_offset = 10
    if hasattr(cycles, "use_sample_subset"):
        assert resolved()["first_sample"] == 0
        cycles.use_sample_subset, cycles.sample_subset_length, cycles.samples = True, 20, 100
        assert (resolved()["first_sample"], resolved()["samples"]) == (10, 20)
    else:
        assert resolved()["first_sample"] == 10
    settings.sample_offset = 3
    assert resolved()["first_sample"] == 3


def test_animated_seed(settings):
    scene = bpy.context.scene
    settings.seed = 5
    scene.frame_set(1)
    still = resolved()["seed"]
    assert still == 5
    settings.use_animated_seed = True
    seeds = []
    for frame in (1, 2, 3):
        scene.frame_set(frame)
        seeds.append(resolved()["seed"])
    assert len(set(seeds)) == 3 and all(0 <= seed < 1 << 31 for seed in seeds)


def test_zero_samples_become_one(settings):
    settings.samples = 0
    assert settings.samples == 1 and resolved()["samples"] == 1


def test_preview_is_short(settings):
    told = resolved(preview=True)
    assert told["samples"] <= 32 and 0 < told["time_limit"] <= 5


def test_overrides_win(settings):
    settings.samples = 10
    assert resolved(overrides={"samples": 3, "integrator": "PT"})["samples"] == 3


def test_colour_configuration_is_blenders(settings, monkeypatch):
    assert resolved()["ocio_config"].endswith("config.ocio")
    monkeypatch.setenv("OCIO", "/somewhere/else.ocio")
    assert resolved()["ocio_config"] == "/somewhere/else.ocio"


def test_fast_gi_is_followed(settings):
    scene = bpy.context.scene
    assert resolved()["fast_gi"] == "off"
    scene.cycles.use_fast_gi, scene.cycles.ao_bounces_render = True, 2
    scene.world = bpy.data.worlds.new("sky")
    scene.world.light_settings.ao_factor, scene.world.light_settings.distance = 0.5, 3.0
    wanted = {"fast_gi": "replace", "fast_gi_bounces": 2, "fast_gi_factor": 0.5, "fast_gi_distance": 3.0}
    assert {key: resolved()[key] for key in wanted} == wanted
    scene.cycles.fast_gi_method = "ADD"
    assert resolved()["fast_gi"] == "off"


def test_what_is_not_followed_is_told(settings):
    from cardioid.resolve import unsupported

    scene, layer = bpy.context.scene, bpy.context.view_layer
    scene.cycles.use_fast_gi, scene.render.use_motion_blur, scene.render.use_simplify = False, False, False
    assert unsupported(scene, layer) == []
    scene.cycles.use_fast_gi, scene.cycles.fast_gi_method = True, "ADD"
    scene.render.use_motion_blur = scene.render.use_simplify = scene.cycles.use_camera_cull = True
    assert [told.split()[0] for told in unsupported(scene, layer)] == ["Fast", "Motion", "Simplify:"]
