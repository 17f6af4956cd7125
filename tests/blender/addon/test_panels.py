# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels draw: every panel in every mode, and the few settings of the Caustics panel."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest


class Layout:
    """Stands in for a UILayout (a background Blender draws no panels): records, and insists on what exists."""

    def __init__(self, drawn):
        object.__setattr__(self, "drawn", drawn)

    def __setattr__(self, name, _value):
        assert name in bpy.types.UILayout.bl_rna.properties, name

    def _part(self, **_keywords):
        return Layout(self.drawn)

    row = column = box = _part

    def prop(self, owner, name, **_keywords):
        assert name in owner.bl_rna.properties, name
        self.drawn.append(name)

    def operator(self, name, **_keywords):
        group, operator = name.split(".")
        assert hasattr(getattr(bpy.ops, group), operator), name
        self.drawn.append(name)
        return SimpleNamespace()

    def label(self, text="", icon="NONE"):
        assert icon in bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
        self.drawn.append(("label", text))


def drawn_by(panel) -> list:
    """What a panel draws in the present file: names of properties and operators, and ("label", text)."""
    drawn = []
    shown = SimpleNamespace(layout=Layout(drawn), bl_space_type=panel.bl_space_type)
    for part in ("draw_header", "draw_header_preset", "draw"):
        if hasattr(panel, part):
            getattr(panel, part)(shown, bpy.context)
    return drawn


def names_of(panel) -> list[str]:
    return [one for one in drawn_by(panel) if isinstance(one, str)]


def sentences_of(panel) -> str:
    return " ".join(one[1] for one in drawn_by(panel) if isinstance(one, tuple))


@pytest.fixture
def settings(addon):
    return bpy.context.scene.cardioid


@pytest.mark.parametrize("mode", ["PTPPM", "PT", "SPPM"])
def test_every_panel_of_the_render_tab_draws(settings, mode):
    from cardioid.ui import render

    settings.integrator = mode
    for panel in render._classes:
        drawn_by(panel)


def test_caustics_panel_by_mode(settings):
    from cardioid.ui import caustics

    few = ["photons", "photon_radius", "caustic_roughness"]
    switches = ["filter_glossy", "reflective_caustics", "refractive_caustics"]
    panel = caustics.CARDIOID_RENDER_PT_caustics
    assert names_of(panel) == ["indirect_caustics", *few]
    assert "Filter Glossy" in sentences_of(panel)
    settings.integrator = "SPPM"
    assert names_of(panel) == few
    settings.integrator = "PT"
    assert names_of(panel) == switches
    assert "Path Tracing + Photons" in sentences_of(panel)


def test_caustics_panel_of_an_engine_without_photons(settings, fake):
    from cardioid.ui import caustics

    settings.integrator = "PT"
    fake.behaviour.integrators = ["PT"]
    assert "Photons" not in sentences_of(caustics.CARDIOID_RENDER_PT_caustics)


def test_advanced_caustics_settings(settings):
    from cardioid.ui import caustics

    panel = caustics.CARDIOID_RENDER_PT_caustics_advanced
    assert panel.bl_options == {"DEFAULT_CLOSED"}
    assert names_of(panel) == ["radius_shrink", "radius_schedule", "guided_emission", "blend_caustic_hits",
                               "physical_refraction"]
    settings.integrator = "PT"
    assert names_of(panel) == ["physical_refraction"]


def test_every_caustics_setting_is_in_a_panel_and_has_a_tooltip(settings):
    from cardioid.settings_table import k_settings
    from cardioid.ui import caustics

    shown = set()
    for mode in ("PTPPM", "PT"):
        settings.integrator = mode
        for panel in caustics.k_classes:
            shown |= set(names_of(panel))
    own = {setting.name for setting in k_settings if setting.cycles is None}
    tuning = {setting.name for setting in k_settings if setting.tunes} | {"keep_film", "live_filter", "save_film"}
    assert own - shown - tuning == {"threads", "memory_limit", "texture_cache", "robust_intersection"}
    for name in shown:
        described = settings.bl_rna.properties[name]
        assert len(described.description) > 20 and not described.description.endswith("."), name
        for item in getattr(described, "enum_items", ()):
            assert item.description, (name, item.identifier)


def test_clamping_says_that_photons_are_left_alone(settings):
    from cardioid.ui import render

    panel = render.CARDIOID_RENDER_PT_clamping
    assert "never clamped" in sentences_of(panel)
    settings.integrator = "PT"
    assert "clamped" not in sentences_of(panel)


def test_light_passes_are_offered_by_class(settings):
    from cardioid.ui import view_layer

    assert names_of(view_layer.CARDIOID_VIEWLAYER_PT_passes_light) == [
        f"use_pass_{name}" for name in ("d1", "d2", "d3", "c1", "c2", "raw", "filtered", "withheld")]
