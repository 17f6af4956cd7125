# SPDX-License-Identifier: GPL-3.0-or-later
"""View Layer Properties: passes and the layer's own sample count."""

from __future__ import annotations

import bpy

from .. import passes
from .common import CardioidPanel, register_all, split, unregister_all


class ViewLayerPanel(CardioidPanel):
    bl_context = "view_layer"


class CARDIOID_VIEWLAYER_PT_override(ViewLayerPanel, bpy.types.Panel):
    bl_label = "Override"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = split(self.layout)
        layout.prop(context.view_layer, "material_override")
        layout.prop(context.view_layer, "samples")


class CARDIOID_VIEWLAYER_PT_passes(ViewLayerPanel, bpy.types.Panel):
    bl_label = "Passes"

    def draw(self, context):
        """Only a heading."""


class CARDIOID_VIEWLAYER_PT_passes_data(ViewLayerPanel, bpy.types.Panel):
    bl_label = "Data"
    bl_parent_id = "CARDIOID_VIEWLAYER_PT_passes"

    def draw(self, context):
        column = split(self.layout).column(heading="Include", align=True)
        column.prop(context.view_layer, "use_pass_combined")
        for one in passes.k_passes:
            if one.switch and not one.own:
                column.prop(context.view_layer, one.switch)


class CARDIOID_VIEWLAYER_PT_passes_light(ViewLayerPanel, bpy.types.Panel):
    bl_label = "Light"
    bl_parent_id = "CARDIOID_VIEWLAYER_PT_passes"

    def draw(self, context):
        column = split(self.layout).column(heading="Path Class", align=True)
        for one in passes.k_passes:
            if one.own and not one.of_filter:
                column.prop(context.view_layer.cardioid, one.switch, text=f"{one.engine}  {one.label}")
        column = split(self.layout).column(heading="Noise Filter", align=True)
        for one in passes.k_passes:
            if one.of_filter:
                column.prop(context.view_layer.cardioid, one.switch)


_classes = (CARDIOID_VIEWLAYER_PT_override, CARDIOID_VIEWLAYER_PT_passes, CARDIOID_VIEWLAYER_PT_passes_data,
            CARDIOID_VIEWLAYER_PT_passes_light)


def register() -> None:
    register_all(_classes)


def unregister() -> None:
    unregister_all(_classes)
