# SPDX-License-Identifier: GPL-3.0-or-later
"""Registering, unregistering, Blender's panels, and a Blender without the engine."""

from __future__ import annotations

import importlib
import sys

import bpy
import conftest
import pytest


def all_panels():
    return {panel for panel in bpy.types.Panel.__subclasses__() if panel.is_registered}


def engines():
    """Panel name to the engines that it is shown for."""
    return {panel.__name__: frozenset(panel.COMPAT_ENGINES) for panel in all_panels()
            if getattr(panel, "COMPAT_ENGINES", None)}


def registered_names():
    return {name for name in dir(bpy.types) if "CARDIOID" in name.upper()}


def test_register_and_unregister_twice(fresh_file, fake):
    import cardioid

    handlers = [list(getattr(bpy.app.handlers, name)) for name in ("render_init", "load_post", "depsgraph_update_post")]
    for _ in range(2):
        before = engines()
        cardioid.register()
        assert bpy.context.scene.cardioid.samples > 0 and bpy.context.view_layer.cardioid is not None
        assert registered_names()
        bpy.context.scene.render.engine = "CARDIOID"
        bpy.context.scene.render.engine = "CYCLES"
        cardioid.unregister()
        assert engines() == before
        assert not registered_names()
        assert not hasattr(bpy.types.Scene, "cardioid") and not hasattr(bpy.types.ViewLayer, "cardioid")
    assert handlers == [list(getattr(bpy.app.handlers, name))
                        for name in ("render_init", "load_post", "depsgraph_update_post")]


def test_panels_of_blender_that_suit(addon):
    """None lost: every panel for any engine is shown, unless Cardioid replaces it."""
    from cardioid.ui import blender_panels

    shown = {name for name, listed in engines().items() if "CARDIOID" in listed}
    for_any = {name for name, listed in engines().items() if "BLENDER_RENDER" in listed}
    left_out = for_any - shown
    assert left_out <= blender_panels.k_replaced
    assert len(for_any) > 280
    assert blender_panels.k_added <= shown
    assert shown >= {"RENDER_PT_format", "RENDER_PT_output", "RENDER_PT_color_management", "DATA_PT_lens",
                     "DATA_PT_context_light", "WORLD_PT_context_world", "DATA_PT_camera_dof",
                     "CARDIOID_RENDER_PT_simplify", "CARDIOID_RENDER_PT_simplify_render"}
    assert "DATA_PT_light" not in shown and "OBJECT_PT_visibility" not in shown


def test_other_engines_panels_stay_closed(addon):
    """Nothing but panels for any engine, the few that are added by name, and Cardioid's own."""
    from cardioid.ui import blender_panels

    for panel in all_panels():
        listed = getattr(panel, "COMPAT_ENGINES", None) or ()
        if "CARDIOID" in listed and "BLENDER_RENDER" not in listed:
            assert panel.__name__ in blender_panels.k_added or panel.__name__.startswith("CARDIOID_"), panel.__name__


def test_other_addons_panels_survive_unregister(fresh_file, fake):
    """A panel that already names Cardioid itself keeps it."""
    import cardioid

    class CARDIOIDTEST_PT_panel(bpy.types.Panel):
        bl_label, bl_space_type, bl_region_type, bl_context = "Test", "PROPERTIES", "WINDOW", "render"
        COMPAT_ENGINES = {"BLENDER_RENDER", "CARDIOID"}

        def draw(self, context):
            pass

    bpy.utils.register_class(CARDIOIDTEST_PT_panel)
    try:
        cardioid.register()
        cardioid.unregister()
        assert sorted(CARDIOIDTEST_PT_panel.COMPAT_ENGINES) == ["BLENDER_RENDER", "CARDIOID"]
    finally:
        bpy.utils.unregister_class(CARDIOIDTEST_PT_panel)


class _Space:
    type, tree_type, shader_type, edit_tree = "NODE_EDITOR", "ShaderNodeTree", "OBJECT", None


class _Context:
    engine, space_data, blend_data = "CARDIOID", _Space, bpy.data


@pytest.mark.skipif(bpy.app.version >= (4, 0), reason="from 4.0 on the Add menu has no node items")
def test_add_menu_offers_bsdfs_while_registered(fresh_file, fake):
    import cardioid
    import nodeitems_builtins as builtins

    def offered():
        return {item.nodetype for category in builtins.shader_node_categories for item in category.items(_Context)
                if getattr(item, "nodetype", None) and (not item.poll or item.poll(_Context))}

    wanted = {"ShaderNodeBsdfPrincipled", "ShaderNodeBsdfDiffuse", "ShaderNodeBsdfGlass", "ShaderNodeEmission",
              "ShaderNodeMixShader", "ShaderNodeOutputMaterial", "ShaderNodeBsdfTransparent"}
    assert not wanted & offered()
    cardioid.register()
    try:
        assert wanted <= offered()
    finally:
        cardioid.unregister()
    assert not wanted & offered()


def test_without_the_engine_it_registers_and_says_why(fresh_file, fake):
    import cardioid

    conftest.use_core(None)
    cardioid.register()
    try:
        problem = cardioid.core.problem()
        assert "not installed" in problem and f"{sys.version_info.major}.{sys.version_info.minor}" in problem
        scene = bpy.context.scene
        scene.render.engine = "CARDIOID"
        assert scene.cardioid.integrator == "PT" and scene.cardioid.samples > 0  # nothing else is sure to be there
        with pytest.raises(RuntimeError, match="not installed") as caught:
            bpy.ops.render.render()
        assert "Traceback" not in str(caught.value)
    finally:
        bpy.context.scene.render.engine = "CYCLES"
        cardioid.unregister()


@pytest.mark.parametrize("error", [ImportError("libembree3.so.3: cannot open shared object file"),
                                   RuntimeError("a static table is broken")])
def test_an_engine_that_cannot_start_is_explained(fake, monkeypatch, error):
    import cardioid

    def fail(*_):
        raise error

    cardioid.core.forget()
    monkeypatch.setattr(importlib, "import_module", fail)
    assert cardioid.core.load() is None
    assert str(error) in cardioid.core.problem()
    assert cardioid.core.integrators() == ("PT",)


def draw_all(panels):
    """Polls of the add-on's panels do not raise in a background Blender's context."""
    return [panel for panel in panels if panel.poll(bpy.context)]


def test_own_panels_poll(addon):
    own = [panel for panel in all_panels() if panel.__name__.startswith(("CARDIOID_", "NODE_CARDIOID_"))]
    assert len(own) >= 25
    names = {panel.__name__ for panel in draw_all(own)}
    assert {"CARDIOID_RENDER_PT_sampling", "CARDIOID_VIEWLAYER_PT_passes"} <= names
    bpy.context.scene.render.engine = "CYCLES"
    assert not draw_all(own)


def test_parents_of_panels_exist(addon):
    own = [panel for panel in all_panels() if panel.__name__.startswith(("CARDIOID_", "NODE_CARDIOID_"))]
    for panel in own:
        parent = getattr(panel, "bl_parent_id", None)
        assert parent is None or hasattr(bpy.types, parent), (panel.__name__, parent)
