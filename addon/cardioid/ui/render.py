# SPDX-License-Identifier: GPL-3.0-or-later
"""Render Properties: Sampling, Light Paths, Film, Performance. Noise Filter and Caustics have files of their own."""

from __future__ import annotations

import bpy

from .. import core
from . import caustics, noise_filter
from .common import (
    CardioidPanel,
    follow_button,
    k_engine,
    register_all,
    renamed_copy,
    setting,
    split,
    unregister_all,
    wrapped,
)

k_simplify = "RENDER_PT_simplify"

_copies: list[type] = []


def draw_engine_problem(self, context):
    """Under the engine's name: why nothing can be rendered, if so."""
    if context.engine == k_engine and core.problem():
        wrapped(self.layout.box(), core.problem(), "ERROR")


class CARDIOID_RENDER_PT_sampling(CardioidPanel, bpy.types.Panel):
    bl_label = "Sampling"

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        layout.prop(settings, "integrator")
        _draw_noise_threshold(layout, settings)
        column = layout.column(align=True)
        setting(column, settings, "samples")
        setting(column, settings, "time_limit")
        changed = len(settings.own_names())
        if changed == 0:
            wrapped(layout, "Settings follow Cycles' until you change them", "LINKED")
            return
        row = layout.row()
        row.label(text=f"{changed} changed here, the others follow Cycles", icon="LINKED")
        row.operator("cardioid.follow_cycles", text="", icon="LOOP_BACK").setting = ""


def _draw_noise_threshold(layout: bpy.types.UILayout, settings) -> None:
    """As in Cycles: a switch and its value in one line."""
    row = layout.column(heading="Noise Threshold", align=True).row(align=True)
    row.prop(settings, "use_adaptive_sampling", text="")
    value = row.row(align=True)
    value.active = settings.use_adaptive_sampling
    value.prop(settings, "adaptive_threshold", text="")
    for name in ("use_adaptive_sampling", "adaptive_threshold"):
        follow_button(row, settings, name)
    if settings.use_adaptive_sampling:
        setting(layout, settings, "adaptive_min_samples")


class CARDIOID_RENDER_PT_sampling_advanced(CardioidPanel, bpy.types.Panel):
    bl_label = "Advanced"
    bl_parent_id = "CARDIOID_RENDER_PT_sampling"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        setting(layout, settings, "seed")
        setting(layout, settings, "use_animated_seed")
        setting(layout, settings, "sample_offset")


class CARDIOID_RENDER_PT_light_paths(CardioidPanel, bpy.types.Panel):
    bl_label = "Light Paths"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Only a heading."""


class CARDIOID_RENDER_PT_bounces(CardioidPanel, bpy.types.Panel):
    bl_label = "Max Bounces"
    bl_parent_id = "CARDIOID_RENDER_PT_light_paths"

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        setting(layout, settings, "max_bounces")
        column = layout.column(align=True)
        for name in ("diffuse_bounces", "glossy_bounces", "transmission_bounces", "volume_bounces"):
            setting(column, settings, name)
        setting(layout, settings, "transparent_bounces")


class CARDIOID_RENDER_PT_clamping(CardioidPanel, bpy.types.Panel):
    bl_label = "Clamping"
    bl_parent_id = "CARDIOID_RENDER_PT_light_paths"

    def draw(self, context):
        column = split(self.layout).column(align=True)
        settings = context.scene.cardioid
        setting(column, settings, "clamp_direct")
        setting(column, settings, "clamp_indirect")
        if settings.integrator != "PT":
            wrapped(column, "Light that photons bring is never clamped", "INFO")


class CARDIOID_RENDER_PT_film(CardioidPanel, bpy.types.Panel):
    bl_label = "Film"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        setting(split(self.layout), context.scene.cardioid, "exposure")


class CARDIOID_RENDER_PT_transparent(CardioidPanel, bpy.types.Panel):
    bl_label = "Transparent"
    bl_parent_id = "CARDIOID_RENDER_PT_film"

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "film_transparent", text="")

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        layout.active = context.scene.render.film_transparent
        setting(layout, settings, "transparent_glass")
        column = layout.column()
        column.active = settings.transparent_glass
        setting(column, settings, "transparent_roughness")


class CARDIOID_RENDER_PT_pixel_filter(CardioidPanel, bpy.types.Panel):
    bl_label = "Pixel Filter"
    bl_parent_id = "CARDIOID_RENDER_PT_film"

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        setting(layout, settings, "pixel_filter")
        if settings.pixel_filter != "BOX":
            setting(layout, settings, "filter_width")


class CARDIOID_RENDER_PT_performance(CardioidPanel, bpy.types.Panel):
    bl_label = "Performance"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Only a heading."""


class CARDIOID_RENDER_PT_threads(CardioidPanel, bpy.types.Panel):
    bl_label = "Threads"
    bl_parent_id = "CARDIOID_RENDER_PT_performance"

    def draw(self, context):
        layout = split(self.layout)
        settings, render = context.scene.cardioid, context.scene.render
        layout.prop(settings, "threads", text="Cardioid")
        column = layout.column(align=True)
        column.active = settings.threads == 0
        column.prop(render, "threads_mode", text="Blender")
        row = column.row()
        row.enabled = render.threads_mode == "FIXED"
        row.prop(render, "threads")


class CARDIOID_RENDER_PT_memory(CardioidPanel, bpy.types.Panel):
    bl_label = "Memory and Geometry"
    bl_parent_id = "CARDIOID_RENDER_PT_performance"

    def draw(self, context):
        layout = split(self.layout)
        settings = context.scene.cardioid
        column = layout.column(align=True)
        column.prop(settings, "memory_limit")
        column.prop(settings, "texture_cache")
        layout.prop(settings, "robust_intersection")


_classes = (
    CARDIOID_RENDER_PT_sampling, CARDIOID_RENDER_PT_sampling_advanced, *noise_filter.k_panels,
    CARDIOID_RENDER_PT_light_paths, CARDIOID_RENDER_PT_bounces, CARDIOID_RENDER_PT_clamping, *caustics.k_classes,
    CARDIOID_RENDER_PT_film,
    CARDIOID_RENDER_PT_transparent, CARDIOID_RENDER_PT_pixel_filter, CARDIOID_RENDER_PT_performance,
    CARDIOID_RENDER_PT_threads, CARDIOID_RENDER_PT_memory)


def _simplify_panels() -> list[type]:
    """Copies of Blender's Simplify panels: the originals would stand above Sampling, because they were there first."""
    originals = [panel for panel in bpy.types.Panel.__subclasses__() if panel.__name__.startswith(k_simplify)]
    return [renamed_copy(panel, "CARDIOID_", COMPAT_ENGINES={k_engine})
            for panel in sorted(originals, key=lambda panel: len(panel.__name__))]


def register() -> None:
    _copies[:] = _simplify_panels()
    register_all((*_classes[:-3], *_copies, *_classes[-3:]))
    bpy.types.RENDER_PT_context.append(draw_engine_problem)


def unregister() -> None:
    bpy.types.RENDER_PT_context.remove(draw_engine_problem)
    unregister_all((*_classes, *_copies))
    _copies.clear()
