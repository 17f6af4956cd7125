# SPDX-License-Identifier: GPL-3.0-or-later
"""Render Properties: Caustics. A few settings for photons; with path tracing alone Cycles' switches in their place."""

from __future__ import annotations

import bpy

from .. import core
from .common import CardioidPanel, setting, split, wrapped

k_no_switches = (
    "Every lamp, mirror and glass throws caustics. Filter Glossy and Cycles' caustics switches are for Path Tracing")
k_use_photons = (
    "Caustics of small lamps stay noisy or are missing. Path Tracing + Photons, in Sampling, makes them clean")


class CARDIOID_RENDER_PT_caustics(CardioidPanel, bpy.types.Panel):
    bl_label = "Caustics"

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        if settings.integrator == "PT":
            _draw_path_tracing(layout, settings)
            return
        if settings.integrator == "PTPPM":
            layout.prop(settings, "indirect_caustics", text="Indirect")
        column = layout.column(align=True)
        column.prop(settings, "photons", text="Photons" if settings.photons else "Photons (0: Automatic)")
        column.prop(settings, "photon_radius")
        layout.prop(settings, "caustic_roughness")
        wrapped(layout, k_no_switches, "INFO")


def _draw_path_tracing(layout: bpy.types.UILayout, settings) -> None:
    """The panel that Cycles has."""
    setting(layout, settings, "filter_glossy")
    column = layout.column(heading="Caustics", align=True)
    setting(column, settings, "reflective_caustics")
    setting(column, settings, "refractive_caustics")
    if "PTPPM" in core.integrators():
        wrapped(layout, k_use_photons, "INFO")


class CARDIOID_RENDER_PT_caustics_advanced(CardioidPanel, bpy.types.Panel):
    bl_label = "Advanced"
    bl_parent_id = "CARDIOID_RENDER_PT_caustics"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        if settings.integrator != "PT":
            column = layout.column(align=True)
            column.prop(settings, "radius_shrink")
            column.prop(settings, "radius_schedule", text="Schedule")
            column = layout.column(align=True)
            column.prop(settings, "guided_emission")
            column.prop(settings, "blend_caustic_hits")
        layout.prop(settings, "physical_refraction")


k_classes = (CARDIOID_RENDER_PT_caustics, CARDIOID_RENDER_PT_caustics_advanced)
