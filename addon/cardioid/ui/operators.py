# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that the panels need."""

from __future__ import annotations

import bpy


class CARDIOID_OT_use_nodes(bpy.types.Operator):
    """Give this material, world or lamp a node tree"""

    bl_idname = "cardioid.use_nodes"
    bl_label = "Use Nodes"
    bl_options = {"REGISTER", "UNDO"}

    @staticmethod
    def _target(context):
        return getattr(context, "material", None) or getattr(context, "world", None) or getattr(context, "light", None)

    @classmethod
    def poll(cls, context):
        return cls._target(context) is not None

    def execute(self, context):
        self._target(context).use_nodes = True
        return {"FINISHED"}


def register() -> None:
    bpy.utils.register_class(CARDIOID_OT_use_nodes)


def unregister() -> None:
    bpy.utils.unregister_class(CARDIOID_OT_use_nodes)
