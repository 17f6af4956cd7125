# SPDX-License-Identifier: GPL-3.0-or-later
"""Cardioid, a render engine for Blender. Where its engine cannot be loaded it registers and says what is missing."""

import atexit

import bpy

from . import core, engine, film_images, films, messages, passes, retune, sessions, settings, ui

bl_info = {
    "name": "Cardioid",
    "author": "The Cardioid authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render Properties, Render Engine",
    "description": "Path tracing with correct caustics, for files made with Cycles",
    "category": "Render",
}

_modules = (messages, sessions, films, film_images, retune, settings, passes, ui, engine)


def register() -> None:
    core.forget()
    for module in _modules:
        module.register()
    if getattr(bpy.app, "module", False):
        # Blender as a Python module crashes or hangs at exit while classes of add-ons are registered (4.2, 4.5)
        atexit.register(unregister)


def unregister() -> None:
    atexit.unregister(unregister)
    for module in reversed(_modules):
        module.unregister()
