# SPDX-License-Identifier: GPL-3.0-or-later
"""Render Properties: Noise Filter. The same in the sidebar of an Image Editor that shows a picture of Cardioid, with
what the filter did in it and the film that it can be tuned on."""

from __future__ import annotations

import bpy

from .. import film_images, films, progress, report, retune
from . import film_operators
from .common import CardioidPanel, follow_button, k_engine, register_all, renamed_copy, split, unregister_all, wrapped

k_wide, k_narrow = 48, 24  # letters in a line
k_changed = "The picture is older than these settings"


class CARDIOID_RENDER_PT_noise_filter(CardioidPanel, bpy.types.Panel):
    bl_label = "Noise Filter"

    def draw_header(self, context):
        self.layout.prop(context.scene.cardioid, "use_filter", text="")

    def draw_header_preset(self, context):
        follow_button(self.layout, context.scene.cardioid, "use_filter")

    def draw(self, context):
        layout = _suited(self)
        settings = context.scene.cardioid
        column = layout.column(align=True)
        column.active = settings.use_filter
        column.prop(settings, "firefly_density")
        if settings.filter_method != "NONE":
            column.prop(settings, "filter_size")
        _draw_state(layout, context, k_narrow if _is_sidebar(self) else k_wide)


class CARDIOID_RENDER_PT_noise_filter_advanced(CardioidPanel, bpy.types.Panel):
    bl_label = "Advanced"
    bl_parent_id = "CARDIOID_RENDER_PT_noise_filter"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = _suited(self)
        settings = context.scene.cardioid
        layout.active = settings.use_filter
        layout.prop(settings, "filter_method")
        layout.prop(settings, "luminance_sensitivity")
        if settings.filter_method == "NONE":
            layout.prop(settings, "filter_size")
            return
        if settings.filter_method == "CROSS_BILATERAL":
            layout.prop(settings, "texture_width")
        column = layout.column(heading="Smooth", align=True)
        for name in ("filter_direct", "filter_indirect", "filter_deep"):
            column.prop(settings, name)


class CARDIOID_RENDER_PT_tuning(CardioidPanel, bpy.types.Panel):
    bl_label = "Tuning after the Render"
    bl_parent_id = "CARDIOID_RENDER_PT_noise_filter"

    def draw(self, context):
        layout = _suited(self)
        settings = context.scene.cardioid
        if not _is_sidebar(self):
            column = layout.column(heading="Film", align=True)
            column.prop(settings, "keep_film", text="Keep in Memory")
            column.prop(settings, "save_film", text="Save beside Frames")
        layout.prop(settings, "live_filter")
        _draw_film(layout, context)


def _is_sidebar(panel: bpy.types.Panel) -> bool:
    return panel.bl_space_type == "IMAGE_EDITOR"


def _suited(panel: bpy.types.Panel) -> bpy.types.UILayout:
    """The panel's layout; a sidebar is too narrow for labels at the left."""
    return panel.layout if _is_sidebar(panel) else split(panel.layout)


def _draw_state(layout: bpy.types.UILayout, context: bpy.types.Context, width: int) -> None:
    """How far the filter is, or what it did in the picture."""
    kept = film_operators.shown_film(context)
    if kept is None:
        return
    doing, share = film_images.state(kept.image) if kept.image else retune.state(context.scene.name)
    problem = "" if doing else _problem(context, kept)
    column = layout.column(align=True)
    if doing == "filtering":
        column.label(text=f"Filtering, {100 * share:.0f} %", icon="SORTTIME")
    elif problem:
        wrapped(column, problem, "INFO", width)
    else:
        for line in report.filter_lines(kept.stats, kept.samples, kept.settings):
            column.label(text=line)
    layout.operator("cardioid.filter_again", icon="FILE_REFRESH")


def _problem(context: bpy.types.Context, kept: films.Kept) -> str:
    """Why the picture is not what the settings say; empty when it is."""
    if kept.settings == retune.wanted_settings(context.scene):
        return ""
    if kept.image:
        return film_images.problem(kept.image) or k_changed
    return (retune.obstacle(context.scene, context.view_layer.name) or retune.problem(context.scene.name) or k_changed)


def _draw_film(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Buttons for the film file and its memory."""
    kept = film_operators.shown_film(context)
    column = layout.column(align=True)
    column.operator("cardioid.save_film", text="Save Film…", icon="FILE_TICK")
    column.operator("cardioid.open_film", text="Open Film…", icon="FILE_FOLDER")
    if kept is not None:
        held = [kept] if kept.image else list(films.of_scene(context.scene.name).values())
        size = progress.memory(sum(one.memory_bytes for one in held))
        column.operator("cardioid.free_film", text=f"Free Film ({size}B)", icon="TRASH")


class ImagePanel:
    """Base of the panels in the sidebar of an Image Editor: for a render result, and for an opened film."""

    @classmethod
    def poll(cls, context):
        image = context.space_data.image
        if image is None or context.scene.render.engine != k_engine:
            return False
        return image.type == "RENDER_RESULT" or films.of_image(image.name) is not None


k_panels = (CARDIOID_RENDER_PT_noise_filter, CARDIOID_RENDER_PT_noise_filter_advanced, CARDIOID_RENDER_PT_tuning)
_in_image_editor = tuple(
    renamed_copy(panel, "IMAGE_", bl_space_type="IMAGE_EDITOR", bl_region_type="UI", bl_category="Cardioid",
                 bl_context="", poll=ImagePanel.__dict__["poll"]) for panel in k_panels)
_classes = (*film_operators.k_classes, *_in_image_editor)


def register() -> None:
    """render.py registers k_panels, in the order of its tab."""
    register_all(_classes)


def unregister() -> None:
    unregister_all(_classes)
