# SPDX-License-Identifier: GPL-3.0-or-later
"""World Properties."""

from __future__ import annotations

import bpy

from .common import CardioidPanel, existing, node_editor_copy, node_input, register_all, split, unregister_all


class WorldPanel(CardioidPanel):
    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return bool(getattr(context, "world", None)) and CardioidPanel.poll(context)


class CARDIOID_WORLD_PT_preview(WorldPanel, bpy.types.Panel):
    bl_label = "Preview"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.template_preview(context.world)


class CARDIOID_WORLD_PT_surface(WorldPanel, bpy.types.Panel):
    bl_label = "Surface"

    def draw(self, context):
        self.layout.use_property_split = True
        if not node_input(self.layout, context.world, "Surface"):
            self.layout.prop(context.world, "color")


class CARDIOID_WORLD_PT_ray_visibility(WorldPanel, bpy.types.Panel):
    bl_label = "Ray Visibility"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return WorldPanel.poll(context) and hasattr(context.world, "cycles_visibility")

    def draw(self, context):
        column = split(self.layout).column()
        for name in ("camera", "diffuse", "glossy", "transmission", "scatter"):
            column.prop(context.world.cycles_visibility, name)


class CARDIOID_WORLD_PT_settings(WorldPanel, bpy.types.Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return WorldPanel.poll(context) and hasattr(context.world, "cycles")

    def draw(self, context):
        layout, cycles = split(self.layout), context.world.cycles
        column = layout.column()
        column.prop(cycles, "sampling_method", text="Sampling")
        row = column.row()
        row.active = cycles.sampling_method == "MANUAL"
        row.prop(cycles, "sample_map_resolution")
        existing(column, cycles, "max_bounces")


_panels = (CARDIOID_WORLD_PT_preview, CARDIOID_WORLD_PT_surface, CARDIOID_WORLD_PT_ray_visibility,
           CARDIOID_WORLD_PT_settings)
_classes = (*_panels, *(node_editor_copy(panel) for panel in _panels[2:]))


def register() -> None:
    register_all(_classes)


def unregister() -> None:
    unregister_all(_classes)
