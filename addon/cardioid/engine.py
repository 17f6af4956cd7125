# SPDX-License-Identifier: GPL-3.0-or-later
"""Cardioid as a render engine of Blender."""

from __future__ import annotations

import traceback

import bpy

from . import final_render, messages, passes, viewport


class CardioidRenderEngine(bpy.types.RenderEngine):
    """Path tracing with correct caustics"""

    bl_idname = "CARDIOID"
    bl_label = "Cardioid"
    bl_use_preview = True
    bl_use_postprocess = True
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False
    bl_use_custom_freestyle = True
    bl_use_gpu_context = False
    bl_use_stereo_viewport = False
    bl_use_spherical_stereo = False

    def render(self, depsgraph):
        try:
            final_render.render(self, depsgraph)
        except messages.RenderProblem as problem:
            messages.fail(self, str(problem))
        except MemoryError:
            messages.fail(self, "there is not enough memory for this picture")
        except Exception as error:
            # The artist gets a sentence; the developer starts Blender with --debug
            if bpy.app.debug:
                traceback.print_exc()
            messages.fail(self, f"the render stopped because of a fault in the add-on: {type(error).__name__}: {error}")

    def update_render_passes(self, scene=None, renderlayer=None):
        for one in passes.enabled(renderlayer):
            self.register_pass(scene, renderlayer, one.name, len(one.channels), one.channels, one.kind)

    def view_update(self, context, depsgraph):
        """Nothing to prepare: the viewport shows a notice."""

    def view_draw(self, context, depsgraph):
        viewport.draw_notice(context.region)


def register() -> None:
    bpy.utils.register_class(CardioidRenderEngine)


def unregister() -> None:
    bpy.utils.unregister_class(CardioidRenderEngine)
