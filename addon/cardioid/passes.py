# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes: Blender's names for them by version, the engine's names, and the switches of a view layer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import bpy
from bpy.props import BoolProperty, PointerProperty


@dataclass(frozen=True)
class Pass:
    """engine: name in a Frame. names: (first Blender version, Blender's name), newest first. channels: their letters.
    switch: property of the view layer, or of view_layer.cardioid when `own`; empty: always there. of_filter: the engine
    has it only when it records what the filter needs."""

    engine: str
    names: tuple[tuple[tuple[int, int], str], ...]
    channels: str
    kind: str
    switch: str
    own: bool = False
    label: str = ""
    description: str = ""
    of_filter: bool = False

    @property
    def name(self) -> str:
        """Blender's name of the pass in the running version."""
        return next(name for since, name in self.names if bpy.app.version[:2] >= since)


def _builtin(engine: str, name: str, channels: str, kind: str, switch: str) -> Pass:
    return Pass(engine, (((0, 0), name),), channels, kind, switch)


def _own(engine: str, label: str, description: str, *, of_filter: bool = False) -> Pass:
    return Pass(engine, (((0, 0), f"Cardioid {engine}"),), "RGB", "COLOR", f"use_pass_{engine.lower()}", True, label,
                description, of_filter)


k_passes = (
    _builtin("Combined", "Combined", "RGBA", "COLOR", ""),
    _builtin("Depth", "Depth", "Z", "VALUE", "use_pass_z"),
    _builtin("Normal", "Normal", "XYZ", "VECTOR", "use_pass_normal"),
    _own("D1", "Emission and Highlights",
         "Light that reaches the camera straight from lamps and emitters, or over mirrors and glass alone"),
    _own("D2", "Direct", "Light that was scattered by one rough surface on its way from the lamp"),
    _own("D3", "Indirect", "Light that was scattered by rough surfaces more than once"),
    _own("C1", "Caustics", "Light of lamps that mirrors, metal, glass or water throw onto rougher surfaces"),
    _own("C2", "Indirect Caustics", "Caustics of light that a rough surface has scattered first"),
    _own("Raw", "Noisy Image", "The picture as it was traced, whatever the filter does", of_filter=True),
    _own("Filtered", "Filtered Image", "The picture that the filter makes", of_filter=True),
    _own("Withheld", "Withheld Light", "Light of fireflies, which the filter keeps from the picture", of_filter=True),
)


def enabled(view_layer: bpy.types.ViewLayer) -> Iterator[Pass]:
    """The passes that are switched on in this view layer."""
    for one in k_passes:
        owner = view_layer.cardioid if one.own else view_layer
        if not one.switch or getattr(owner, one.switch):
            yield one


def _refresh(_self, context) -> None:
    if context.view_layer:
        context.view_layer.update_render_passes()


class CARDIOID_PG_view_layer(bpy.types.PropertyGroup):
    """Passes of a view layer that only Cardioid has."""

    __annotations__ = {
        one.switch: BoolProperty(name=one.label, description=one.description, default=False, update=_refresh)
        for one in k_passes if one.own
    }


def register() -> None:
    bpy.utils.register_class(CARDIOID_PG_view_layer)
    bpy.types.ViewLayer.cardioid = PointerProperty(name="Cardioid", description="Cardioid's view layer settings",
                                                   type=CARDIOID_PG_view_layer)


def unregister() -> None:
    del bpy.types.ViewLayer.cardioid
    bpy.utils.unregister_class(CARDIOID_PG_view_layer)
