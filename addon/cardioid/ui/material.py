# SPDX-License-Identifier: GPL-3.0-or-later
"""Material Properties: the node tree by socket, and the settings that Cardioid reads."""

from __future__ import annotations

import bpy

from .common import CardioidPanel, existing, node_editor_copy, node_input, register_all, split, unregister_all


class MaterialPanel(CardioidPanel):
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        material = getattr(context, "material", None)
        return bool(material) and not material.grease_pencil and CardioidPanel.poll(context)


class CARDIOID_MATERIAL_PT_surface(MaterialPanel, bpy.types.Panel):
    bl_label = "Surface"

    def draw(self, context):
        self.layout.use_property_split = True
        if not node_input(self.layout, context.material, "Surface"):
            self.layout.prop(context.material, "diffuse_color", text="Base Color")
            self.layout.prop(context.material, "metallic")
            self.layout.prop(context.material, "roughness")


class CARDIOID_MATERIAL_PT_settings(MaterialPanel, bpy.types.Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, material = split(self.layout), context.material
        cycles = getattr(material, "cycles", None)
        layout.prop(material, "pass_index")
        column = layout.column()
        if hasattr(cycles, "emission_sampling"):
            column.prop(cycles, "emission_sampling", text="Emission Sampling")
        else:
            existing(column, cycles, "sample_as_light", text="Multiple Importance")
        if hasattr(cycles, "use_transparent_shadow"):
            column.prop(cycles, "use_transparent_shadow")
        else:
            existing(column, material, "use_transparent_shadow")
        column.prop(material, "use_backface_culling")


_panels = (CARDIOID_MATERIAL_PT_surface, CARDIOID_MATERIAL_PT_settings)
_classes = (*_panels, node_editor_copy(CARDIOID_MATERIAL_PT_settings))


def register() -> None:
    register_all(_classes)


def unregister() -> None:
    unregister_all(_classes)
