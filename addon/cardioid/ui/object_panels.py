# SPDX-License-Identifier: GPL-3.0-or-later
"""Object Properties: visibility, by kind of ray too."""

from __future__ import annotations

import bpy

from .common import CardioidPanel, existing, register_all, split, unregister_all

k_with_geometry = {"MESH", "CURVE", "SURFACE", "FONT", "META", "LIGHT", "CURVES", "POINTCLOUD", "VOLUME"}

k_rays = (("visible_camera", "Camera"), ("visible_diffuse", "Diffuse"), ("visible_glossy", "Glossy"),
          ("visible_transmission", "Transmission"), ("visible_volume_scatter", "Volume Scatter"))


def _is_seen(thing: bpy.types.Object | None) -> bool:
    if thing is None:
        return False
    places_collection = thing.instance_type == "COLLECTION" and thing.instance_collection is not None
    return thing.type in k_with_geometry or places_collection


class ObjectPanel(CardioidPanel):
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and CardioidPanel.poll(context)


class CARDIOID_OBJECT_PT_visibility(ObjectPanel, bpy.types.Panel):
    bl_label = "Visibility"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, thing = split(self.layout), context.object
        layout.prop(thing, "hide_select", text="Selectable", invert_checkbox=True, toggle=False)
        column = layout.column(heading="Show In")
        column.prop(thing, "hide_viewport", text="Viewports", invert_checkbox=True, toggle=False)
        column.prop(thing, "hide_render", text="Renders", invert_checkbox=True, toggle=False)
        if _is_seen(thing):
            existing(layout.column(heading="Mask"), thing, "is_holdout")


class CARDIOID_OBJECT_PT_ray_visibility(ObjectPanel, bpy.types.Panel):
    bl_label = "Ray Visibility"
    bl_parent_id = "CARDIOID_OBJECT_PT_visibility"

    @classmethod
    def poll(cls, context):
        return ObjectPanel.poll(context) and _is_seen(context.object)

    def draw(self, context):
        column = split(self.layout).column()
        for name, text in k_rays:
            column.prop(context.object, name, text=text)
        if context.object.type != "LIGHT":
            column.prop(context.object, "visible_shadow", text="Shadow")


_classes = (CARDIOID_OBJECT_PT_visibility, CARDIOID_OBJECT_PT_ray_visibility)


def register() -> None:
    register_all(_classes)


def unregister() -> None:
    unregister_all(_classes)
