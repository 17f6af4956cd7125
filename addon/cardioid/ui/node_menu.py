# SPDX-License-Identifier: GPL-3.0-or-later
"""The shader editor's Add menu.

Up to Blender 4.1 it offers BSDFs, Emission and the outputs to Cycles and EEVEE only. The test for Cycles is one
function that the menu looks up by name each time it is drawn; while Cardioid is registered it says yes to Cardioid too.
"""

from __future__ import annotations

import importlib
from types import ModuleType

import bpy

from .common import k_engine

k_poll = "cycles_shader_nodes_poll"
k_menu_modules = ("nodeitems_builtins", "bl_ui.node_add_menu_shader")

_patched: list[tuple[ModuleType, object, object]] = []


def _asks_cycles(original):
    def poll(context):
        return context.engine == k_engine or original(context)

    return poll


def register() -> None:
    if bpy.app.version >= (4, 2):
        return
    for name in k_menu_modules:
        try:
            module = importlib.import_module(name)
        except ImportError:
            continue
        original = getattr(module, k_poll, None)
        if original is not None:
            replacement = _asks_cycles(original)
            setattr(module, k_poll, replacement)
            _patched.append((module, original, replacement))


def unregister() -> None:
    for module, original, replacement in reversed(_patched):
        # Another add-on may have wrapped it since; then leave its function alone
        if getattr(module, k_poll) is replacement:
            setattr(module, k_poll, original)
    _patched.clear()
