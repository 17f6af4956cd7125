# SPDX-License-Identifier: GPL-3.0-or-later
"""`scene.cardioid`: render settings that follow scene.cycles until the user changes them.

Each property of the table that follows Cycles is a pair: the visible one (get and set callbacks) and a hidden one that
holds the user's value. The visible one answers with Cycles' value until the hidden one is set.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from . import core, cycles_values, retune
from .settings_table import Setting, k_by_name, k_integrators, k_settings

k_property_types = {"int": IntProperty, "float": FloatProperty, "bool": BoolProperty, "enum": EnumProperty}


def own_name(name: str) -> str:
    """The hidden property that holds the user's own value of the setting `name`."""
    return f"{name}_value"


class CARDIOID_PG_render(bpy.types.PropertyGroup):
    """Render settings of a scene. The properties come from settings_table.py."""

    def is_own(self, name: str) -> bool:
        """True when the user has set `name`; False while it follows Cycles."""
        return self.is_property_set(own_name(name))

    def follow(self, name: str) -> None:
        """Lets `name` follow Cycles again."""
        self.property_unset(own_name(name))

    def own_names(self) -> list[str]:
        """Names of the settings that no longer follow Cycles."""
        return [setting.name for setting in k_settings if setting.cycles and self.is_own(setting.name)]


def _static_items(setting: Setting) -> list[tuple]:
    return [(identifier, label, text, "", number) for identifier, (label, text, number) in setting.items.items()]


def _property(setting: Setting, *, name: str, **callbacks: Any) -> Any:
    keywords = dict(setting.options, name=name, description=setting.description, **callbacks)
    if setting.kind == "enum":
        keywords["items"] = _static_items(setting)
    if "get" not in callbacks:
        keywords["default"] = setting.default
    if setting.tunes and "update" not in callbacks:
        keywords["update"] = _retune
    return k_property_types[setting.kind](**keywords)


def _retune(self, _context) -> None:
    retune.changed(self.id_data)


def _getter(setting: Setting):
    own = own_name(setting.name)

    def get(self):
        if self.is_property_set(own):
            value = getattr(self, own)
            return setting.items[value][2] if setting.kind == "enum" else value
        return cycles_values.read(self.id_data, setting)

    return get


def _setter(setting: Setting):
    own = own_name(setting.name)
    identifiers = {item[2]: identifier for identifier, item in (setting.items or {}).items()}

    def set_own(self, value):
        setattr(self, own, identifiers[value] if setting.kind == "enum" else value)

    return set_own


def _clamp_get(self) -> float:
    return self.clamp_indirect


def _clamp_set(self, value: float) -> None:
    self.clamp_direct = value
    self.clamp_indirect = value


def _integrator() -> Any:
    offered = [name for name in k_integrators if name in core.integrators()] or ["PT"]
    items = [(name, k_integrators[name][0], k_integrators[name][1], "", k_integrators[name][2]) for name in offered]
    return EnumProperty(name="Integrator", description="How light is traced", items=items, default=offered[0])


def _annotations() -> dict[str, Any]:
    properties: dict[str, Any] = {"integrator": _integrator()}
    for setting in k_settings:
        if setting.cycles is None:
            properties[setting.name] = _property(setting, name=setting.label)
            continue
        properties[own_name(setting.name)] = _property(setting, name=setting.label, update=None)
        properties[setting.name] = _property(setting, name=setting.label, get=_getter(setting), set=_setter(setting))
    properties["clamp"] = FloatProperty(
        name="Clamp", get=_clamp_get, set=_clamp_set, min=0.0, max=1e8,
        description="Brightest value that any light path may add; sets the direct and the indirect clamp together. "
                    "0: no clamping")
    return properties


class CARDIOID_OT_follow_cycles(bpy.types.Operator):
    """Let this setting follow Cycles' again"""

    bl_idname = "cardioid.follow_cycles"
    bl_label = "Follow Cycles"
    bl_options = {"REGISTER", "UNDO"}

    setting: bpy.props.StringProperty(name="Setting", description="Name of the setting; empty: all of them",
                                      options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context):
        settings = context.scene.cardioid
        if self.setting and self.setting not in k_by_name:
            self.report({"ERROR"}, f"Cardioid has no setting named {self.setting}")
            return {"CANCELLED"}
        for name in [self.setting] if self.setting else settings.own_names():
            settings.follow(name)
        retune.changed(context.scene)
        return {"FINISHED"}


def register() -> None:
    CARDIOID_PG_render.__annotations__ = _annotations()
    bpy.utils.register_class(CARDIOID_PG_render)
    bpy.utils.register_class(CARDIOID_OT_follow_cycles)
    bpy.types.Scene.cardioid = PointerProperty(name="Cardioid", description="Cardioid's render settings",
                                               type=CARDIOID_PG_render)


def unregister() -> None:
    del bpy.types.Scene.cardioid
    bpy.utils.unregister_class(CARDIOID_OT_follow_cycles)
    bpy.utils.unregister_class(CARDIOID_PG_render)
