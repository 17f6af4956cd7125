# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels, laid out as Cycles' are, and the parts of Blender's own interface that Cardioid takes part in."""

from . import (
    blender_panels,
    light,
    material,
    node_menu,
    noise_filter,
    object_panels,
    operators,
    render,
    view_layer,
    world,
)

_modules = (operators, noise_filter, render, view_layer, light, material, world, object_panels, blender_panels,
            node_menu)


def register() -> None:
    for module in _modules:
        module.register()


def unregister() -> None:
    for module in reversed(_modules):
        module.unregister()
