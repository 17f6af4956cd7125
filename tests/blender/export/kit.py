# SPDX-License-Identifier: GPL-3.0-or-later
"""Short ways to build a scene and to export it into the recorder."""

import bpy
import fake_core
from cardioid.export import ExportOptions, build_scene


def add(data, name=None, **properties):
    """Links a new object with this data into the scene."""
    obj = bpy.data.objects.new(name or data.name, data)
    bpy.context.scene.collection.objects.link(obj)
    for key, value in properties.items():
        setattr(obj, key, value)
    return obj


def quad(name="Quad"):
    """Two triangles in the plane z = 0, corners at (0, 0) and (1, 1)."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
    return mesh


def material(name="Material"):
    """A material whose node tree is empty but for an output; returns the tree too."""
    new = bpy.data.materials.new(name)
    if new.node_tree is None:
        new.use_nodes = True
    new.node_tree.nodes.clear()
    return new, new.node_tree


def export(resolution=(200, 100), depsgraph=None, **options):
    """Exports the current scene; returns Exported with `.scene` a fake_core.Scene."""
    graph = depsgraph or bpy.context.evaluated_depsgraph_get()
    return build_scene(fake_core, graph, graph.view_layer_eval, ExportOptions(resolution, **options))


def by_name(items, name):
    found = [i for i in items if i["name"] == name]
    assert len(found) == 1, f"{len(found)} × {name} in {[i['name'] for i in items]}"
    return found[0]
