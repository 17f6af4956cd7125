# SPDX-License-Identifier: GPL-3.0-or-later
"""Object Data Properties of a lamp."""

from __future__ import annotations

import bpy

from .common import CardioidPanel, existing, node_editor_copy, node_input, register_all, unregister_all


def _is_portal(light: bpy.types.Light) -> bool:
    cycles = getattr(light, "cycles", None)
    return light.type == "AREA" and bool(getattr(cycles, "is_portal", False))


class LightPanel(CardioidPanel):
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return bool(getattr(context, "light", None)) and CardioidPanel.poll(context)


class CARDIOID_LIGHT_PT_light(LightPanel, bpy.types.Panel):
    bl_label = "Light"

    def draw(self, context):
        layout, light = self.layout, context.light
        if self.bl_space_type == "PROPERTIES":
            layout.row().prop(light, "type", expand=True)
        layout.use_property_split = True
        if self.bl_space_type != "PROPERTIES":
            layout.prop(light, "type")
        column = layout.column()
        existing(column, light, "use_temperature", text="Use Temperature")
        if getattr(light, "use_temperature", False):
            column.prop(light, "temperature")
        column.prop(light, "color")
        column.prop(light, "energy")
        existing(column, light, "exposure")
        existing(column, light, "normalize")
        self._draw_shape(layout.column(), light)
        self._draw_options(layout.column(), light)

    @staticmethod
    def _draw_shape(column, light):
        if light.type in {"POINT", "SPOT"}:
            existing(column, light, "use_soft_falloff")
            column.prop(light, "shadow_soft_size", text="Radius")
        elif light.type == "SUN":
            column.prop(light, "angle")
        elif light.type == "AREA":
            column.prop(light, "shape")
            sizes = column.column(align=True)
            if light.shape in {"RECTANGLE", "ELLIPSE"}:
                sizes.prop(light, "size", text="Size X")
                sizes.prop(light, "size_y", text="Y")
            else:
                sizes.prop(light, "size")

    @staticmethod
    def _draw_options(column, light):
        cycles = getattr(light, "cycles", None)
        options = column.column()
        options.active = not _is_portal(light)
        existing(options, cycles, "max_bounces")
        if hasattr(cycles, "cast_shadow"):
            options.prop(cycles, "cast_shadow")
        else:
            existing(options, light, "use_shadow", text="Cast Shadow")
        existing(options, cycles, "use_multiple_importance_sampling", text="Multiple Importance")
        if light.type == "AREA":
            existing(column, cycles, "is_portal", text="Portal")


class CARDIOID_LIGHT_PT_beam_shape(LightPanel, bpy.types.Panel):
    bl_label = "Beam Shape"
    bl_parent_id = "CARDIOID_LIGHT_PT_light"

    @classmethod
    def poll(cls, context):
        return LightPanel.poll(context) and context.light.type in {"SPOT", "AREA"}

    def draw(self, context):
        layout, light = self.layout, context.light
        layout.use_property_split = True
        if light.type == "SPOT":
            layout.prop(light, "spot_size", text="Spot Size")
            layout.prop(light, "spot_blend", text="Blend", slider=True)
            layout.prop(light, "show_cone")
        else:
            layout.prop(light, "spread")


class CARDIOID_LIGHT_PT_nodes(LightPanel, bpy.types.Panel):
    bl_label = "Nodes"

    @classmethod
    def poll(cls, context):
        return LightPanel.poll(context) and not _is_portal(context.light)

    def draw(self, context):
        self.layout.use_property_split = True
        node_input(self.layout, context.light, "Surface")


_panels = (CARDIOID_LIGHT_PT_light, CARDIOID_LIGHT_PT_beam_shape, CARDIOID_LIGHT_PT_nodes)
_classes = (*_panels, *(node_editor_copy(panel) for panel in _panels[:2]))


def register() -> None:
    register_all(_classes)


def unregister() -> None:
    unregister_all(_classes)
