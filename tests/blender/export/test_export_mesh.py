# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of meshes: triangles, normals, layers, slots, texture space."""

import time

import bpy
import numpy as np
import pytest
from cardioid.export import arrays, compat
from cardioid.export import mesh as mesh_export

from .kit import add, export, material, quad

pytestmark = pytest.mark.usefixtures("scene")


def only_mesh(exported=None):
    meshes = (exported or export()).scene.meshes
    assert len(meshes) == 1
    return meshes[0]


def read_attribute(name):
    """A material that reads this attribute, so that the exporter takes it along."""
    _, tree = material()
    tree.nodes.new("ShaderNodeAttribute").attribute_name = name


def test_quad_becomes_two_triangles_that_face_up():
    add(quad())
    mesh = only_mesh()
    points = mesh["positions"][mesh["triangles"]]
    normals = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    assert mesh["triangles"].shape == (2, 3)
    assert np.allclose(normals.sum(axis=0) / 2, (0, 0, 1))
    assert mesh["slots"] is None


def test_mesh_without_faces_is_not_placed():
    mesh = bpy.data.meshes.new("Edge")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    add(mesh)
    exported = export()
    assert not exported.scene.meshes and not exported.scene.instances and not exported.warnings


def test_single_triangle():
    mesh = bpy.data.meshes.new("One")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    add(mesh)
    assert sorted(only_mesh()["triangles"][0]) == [0, 1, 2]


def test_modifiers_count():
    obj = add(quad())
    obj.modifiers.new("Solid", "SOLIDIFY").thickness = 0.5
    assert len(only_mesh()["triangles"]) == 12


def test_not_a_number_is_passed_on_to_the_engine():
    mesh = quad()
    mesh.vertices[0].co.x = float("nan")
    add(mesh)
    assert np.isnan(only_mesh()["positions"]).any()


def ball(smooth):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=6)
    mesh = bpy.context.object.data
    mesh.polygons.foreach_set("use_smooth", np.full(len(mesh.polygons), smooth))
    mesh.update()
    return mesh


def test_flat_mesh_has_no_corner_normals():
    ball(False)
    assert only_mesh()["corner_normals"] is None


def test_smooth_sphere_has_radial_normals():
    ball(True)
    mesh = only_mesh()
    points = mesh["positions"][mesh["triangles"]]
    assert np.allclose(np.sum(points * mesh["corner_normals"], axis=2), 1, atol=0.02)
    assert np.allclose(np.linalg.norm(mesh["corner_normals"], axis=2), 1, atol=1e-3)


def test_flat_faces_among_smooth_ones_keep_their_plane():
    mesh = ball(True)
    mesh.polygons[0].use_smooth = False
    found = only_mesh()
    points = found["positions"][found["triangles"]]
    plane = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    plane /= np.linalg.norm(plane, axis=1, keepdims=True)
    flat = np.abs(np.sum(plane[:, None] * found["corner_normals"], axis=2) - 1).max(axis=1) < 1e-5
    triangles_of_first = len(mesh.polygons[0].vertices) - 2
    assert flat.sum() == triangles_of_first


def test_auto_smooth_splits_normals_at_sharp_edges():
    bpy.ops.mesh.primitive_cube_add()
    mesh = bpy.context.object.data
    if compat.has("corner_normals"):
        mesh.shade_smooth()
        mesh.set_sharp_from_angle(angle=0.5)
    else:
        mesh.polygons.foreach_set("use_smooth", np.ones(6, np.bool_))
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, 0.5
    normals = only_mesh()["corner_normals"]
    assert np.allclose(np.abs(normals).max(axis=2), 1, atol=1e-4)


def test_custom_normals_are_kept():
    mesh = quad()
    mesh.polygons[0].use_smooth = True
    wanted = np.array([(0.6, 0, 0.8)] * 4)
    if not compat.has("corner_normals"):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(wanted)
    add(mesh)
    assert np.allclose(only_mesh()["corner_normals"], (0.6, 0, 0.8), atol=2e-3)


def test_uv_maps_follow_their_corners():
    mesh = quad()
    for name, scale in (("A", 1), ("B", 3)):
        layer = mesh.uv_layers.new(name=name)
        for corner in range(4):
            position = mesh.vertices[mesh.loops[corner].vertex_index].co
            layer.data[corner].uv = (position.x * scale, position.y * scale)
    mesh.uv_layers["B"].active_render = True
    add(mesh)
    found = only_mesh()
    points = found["positions"][found["triangles"]]
    for name, scale in (("A", 1), ("B", 3)):
        domain, data = found["attributes"][name]
        assert domain == "corner" and np.allclose(data, points[..., :2] * scale)
    assert found["active_uv"] == "B"


@pytest.mark.parametrize("kind", ["FLOAT_COLOR", "BYTE_COLOR"])
@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
def test_colors_are_linear(kind, domain):
    mesh = quad()
    layer = mesh.color_attributes.new("Col", kind, domain)
    for element in layer.data:
        element.color = (0.5, 0.25, 1.0, 0.75)
    mesh.color_attributes.render_color_index = 0
    add(mesh)
    found = only_mesh()
    exported_domain, data = found["attributes"]["Col"]
    assert exported_domain == domain.lower() and data.shape[-1] == 4
    assert np.allclose(data, (0.5, 0.25, 1.0, 0.75), atol=0.01)
    assert found["active_color"] == "Col"


@pytest.mark.parametrize(("kind", "name", "value", "expected"), [
    ("FLOAT", "value", 0.5, [0.5]), ("INT", "value", 7, [7]), ("BOOLEAN", "value", True, [1]),
    ("FLOAT_VECTOR", "vector", (1, 2, 3), [1, 2, 3]), ("FLOAT2", "vector", (1, 2), [1, 2]),
])
@pytest.mark.parametrize("domain", ["POINT", "FACE", "CORNER"])
def test_attributes_that_a_material_names(kind, name, value, expected, domain):
    mesh = quad()
    layer = mesh.attributes.new("mine", kind, domain)
    for element in layer.data:
        setattr(element, name, value)
    add(mesh)
    read_attribute("mine")
    exported_domain, data = only_mesh()["attributes"]["mine"]
    assert exported_domain == domain.lower() and np.allclose(data, expected)


def test_attributes_that_nobody_names_stay_behind():
    mesh = quad()
    mesh.attributes.new("mine", "FLOAT", "POINT")
    add(mesh)
    assert "mine" not in only_mesh()["attributes"]


def test_attribute_on_edges_is_named_in_a_warning():
    mesh = quad()
    mesh.attributes.new("mine", "FLOAT", "EDGE")
    add(mesh)
    read_attribute("mine")
    assert any("mine" in w and "Quad" in w for w in export().warnings)


def test_material_slots_of_triangles():
    mesh = bpy.data.meshes.new("Two")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0)], [], [(0, 1, 2, 3), (1, 4, 2)])
    for name in "AB":
        mesh.materials.append(material(name)[0])
    mesh.polygons[1].material_index = 1
    add(mesh)
    assert sorted(only_mesh()["slots"]) == [0, 0, 1]


def test_texture_space_is_the_box_of_the_mesh():
    mesh = quad()
    for vertex in mesh.vertices:
        vertex.co.x = vertex.co.x * 4 - 1
    add(mesh)
    found = only_mesh()
    assert np.allclose(found["generated_min"][:2], (-1, 0)) and np.allclose(found["generated_size"][:2], (4, 1))
    assert (found["generated_size"] > 0).all()


def test_views_of_memory_and_foreach_agree(monkeypatch):
    bpy.ops.mesh.primitive_monkey_add()
    mesh = bpy.context.object.data
    mesh.calc_loop_triangles()
    fast = mesh_export.triangles(mesh)
    monkeypatch.setattr(mesh_export, "memory", lambda *_: None)
    slow = mesh_export.triangles(mesh)
    assert (fast.corners == slow.corners).all() and (fast.vertices == slow.vertices).all()
    assert (fast.polygon == slow.polygon).all()


def test_memory_of_another_layout_is_refused():
    mesh = quad()
    assert arrays.memory(mesh.vertices, np.dtype((np.int8, 5))) is None


def test_a_million_triangles():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=707, y_subdivisions=707)
    obj = bpy.context.object
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), np.bool_))
    obj.modifiers.new("Wave", "WAVE")
    depsgraph = bpy.context.evaluated_depsgraph_get()
    start = time.perf_counter()
    exported = export(depsgraph=depsgraph)
    seconds = time.perf_counter() - start
    count = len(only_mesh(exported)["triangles"])
    print(f"\n{count} triangles with UV and normals: {seconds:.2f} s (with the recorder's copies and checks)")
    assert count > 990_000 and seconds < 20
