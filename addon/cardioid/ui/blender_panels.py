# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's own panels that suit Cardioid: those for any engine, less the ones that Cardioid replaces, and a few that
are marked for EEVEE only."""

from __future__ import annotations

import bpy

from .common import k_engine

k_any_engine = "BLENDER_RENDER"

k_replaced = {
    "DATA_PT_area", "DATA_PT_falloff_curve", "DATA_PT_light", "DATA_PT_spot", "NODE_DATA_PT_light", "NODE_DATA_PT_spot",
    "OBJECT_PT_visibility", "VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes",
    "RENDER_PT_simplify", "RENDER_PT_simplify_viewport", "RENDER_PT_simplify_render", "RENDER_PT_simplify_greasepencil",
    "OBJECT_PT_shading",  # light linking, which Cardioid does not have
}

k_added = {
    "DATA_PT_camera_dof", "DATA_PT_camera_dof_aperture", "EEVEE_MATERIAL_PT_context_material", "MATERIAL_PT_preview",
}

_joined: list[type] = []


def suitable() -> list[type]:
    """Panels that appear while Cardioid is the render engine."""
    return [panel for panel in bpy.types.Panel.__subclasses__() if _suits(panel)]


def _suits(panel: type) -> bool:
    engines = getattr(panel, "COMPAT_ENGINES", None)
    if not engines or panel.__name__ in k_replaced:
        return False
    return k_any_engine in engines or panel.__name__ in k_added


def register() -> None:
    for panel in suitable():
        if k_engine not in panel.COMPAT_ENGINES:
            panel.COMPAT_ENGINES.add(k_engine)
            _joined.append(panel)


def unregister() -> None:
    for panel in _joined:
        panel.COMPAT_ENGINES.discard(k_engine)
    _joined.clear()
