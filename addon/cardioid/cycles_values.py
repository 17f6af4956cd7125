# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads Cycles' settings of a scene, whether or not Cycles' add-on is enabled."""

from __future__ import annotations

from typing import Any

import bpy

from .settings_table import Setting


def group(scene: bpy.types.Scene) -> Any:
    """scene.cycles; without the add-on what the file stored of it (dictionary-like); None when there is nothing."""
    live = getattr(scene, "cycles", None)
    if live is not None:
        return live
    stored = getattr(scene, "bl_system_properties_get", None)
    properties = stored() if stored else scene
    return properties.get("cycles") if properties else None


def value(scene: bpy.types.Scene, name: str, default: Any) -> Any:
    """scene.cycles.<name>; enums by identifier with the add-on, by number without."""
    source = group(scene)
    if source is None:
        return default
    if isinstance(source, bpy.types.bpy_struct):
        return getattr(source, name, default)
    return source.get(name, default)


def read(scene: bpy.types.Scene, setting: Setting) -> Any:
    """The value that `setting` follows, in the form that a property's get callback returns (enums: the number)."""
    found = value(scene, setting.cycles, setting.default)
    if setting.kind == "enum":
        if isinstance(found, int):
            known = {item[2] for item in setting.items.values()}
            return found if found in known else setting.items[setting.default][2]
        return setting.items.get(found, setting.items[setting.default])[2]
    return {"int": int, "float": float, "bool": bool}[setting.kind](found)
