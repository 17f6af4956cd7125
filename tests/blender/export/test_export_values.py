# SPDX-License-Identifier: GPL-3.0-or-later
"""What shading nodes read by name: from objects, instancers, particles and the view layer; tangents of UV maps."""

import bpy
import numpy as np
import pytest
from cardioid.export import needs
from cardioid.export.tangents import corner_tangents

from .kit import add, by_name, export, material, quad

pytestmark = pytest.mark.usefixtures("scene")


def attribute(kind, name, tree):
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_type, node.attribute_name = kind, name
    end, light = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeEmission")
    tree.links.new(node.outputs["Color"], light.inputs["Color"])
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    return node


def placed(name="Quad"):
    """A quad with a new material; returns the object and the material's tree."""
    new, tree = material()
    mesh = quad(name)
    mesh.materials.append(new)
    return add(mesh), tree


def values(exported=None, name="Quad"):
    found = by_name((exported or export()).scene.instances, name)
    return {v["name"]: v["value"] for v in found.get("values", [])}


def test_nothing_is_handed_over_that_nothing_reads():
    obj, _ = placed()
    obj["wetness"] = 0.5
    assert values() == {}


@pytest.mark.parametrize(("value", "expected"), [
    (0.5, [0.5, 0.5, 0.5, 1]), (3, [3, 3, 3, 1]), ([0.25, 0.5], [0.25, 0.5, 0, 1]),
    ([0.25, 0.5, 1, 0.75], [0.25, 0.5, 1, 0.75]), ("text", [0, 0, 0, 0])])
def test_custom_property_of_the_object(value, expected):
    obj, tree = placed()
    attribute("OBJECT", "wetness", tree)
    obj["wetness"] = value
    assert values() == {"object:wetness": expected}


def test_property_of_the_data_and_built_in_path():
    obj, tree = placed()
    attribute("OBJECT", "of_mesh", tree)
    attribute("OBJECT", "location", tree)
    attribute("OBJECT", "gone", tree)
    obj.data["of_mesh"] = 2.0
    obj.location = (1, 2, 3)
    assert values() == {"object:of_mesh": [2, 2, 2, 1], "object:location": [1, 2, 3, 1], "object:gone": [0, 0, 0, 0]}


def test_property_of_the_object_hides_that_of_its_mesh():
    obj, tree = placed()
    attribute("OBJECT", "both", tree)
    obj.data["both"], obj["both"] = 2.0, 1.0
    assert values()["object:both"][0] == 1


def test_instancer_comes_first_and_falls_back_to_the_object():
    obj, tree = placed()
    attribute("INSTANCER", "shared", tree)
    attribute("INSTANCER", "own", tree)
    obj["shared"], obj["own"] = 1.0, 3.0
    base = add(quad("Base"))
    base.instance_type, obj.parent = "VERTS", base
    base["shared"] = 2.0
    found = [i for i in export().scene.instances if i["name"] == "Quad" and "dupli_uv" in i]
    assert len(found) == 4
    for instance in found:
        by = {v["name"]: v["value"] for v in instance["values"]}
        assert by["instancer:shared"][0] == 2 and by["instancer:own"][0] == 3


@pytest.mark.skipif(not hasattr(bpy.types.Object, "evaluated_geometry"), reason="can be read since 4.5")
def test_instance_attribute_of_geometry_nodes():
    grain, tree = placed("Grain")
    attribute("INSTANCER", "shade", tree)
    host = add(quad("Host"))
    group = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    kinds = ("NodeGroupInput", "GeometryNodeInstanceOnPoints", "GeometryNodeObjectInfo",
             "GeometryNodeStoreNamedAttribute", "GeometryNodeInputIndex", "NodeGroupOutput")
    begin, scatter, info, store, index, end = (group.nodes.new(kind) for kind in kinds)
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = grain, True
    store.domain, store.inputs["Name"].default_value = "INSTANCE", "shade"
    for first, second in ((begin.outputs[0], scatter.inputs["Points"]),
                          (info.outputs["Geometry"], scatter.inputs["Instance"]),
                          (scatter.outputs[0], store.inputs["Geometry"]), (index.outputs[0], store.inputs["Value"]),
                          (store.outputs[0], end.inputs[0])):
        group.links.new(first, second)
    host.modifiers.new("Nodes", "NODES").node_group = group
    found = [i["values"][0]["value"] for i in export().scene.instances if "dupli_uv" in i]
    assert sorted(found) == [[n, n, n, 1] for n in range(4)]


def test_view_layer_looks_in_layer_scene_and_world(scene):
    _, tree = placed()
    for name in ("a", "b", "c", "d"):
        attribute("VIEW_LAYER", name, tree)
    scene.world = bpy.data.worlds.new("World")
    scene.world["c"] = 3.0
    scene["b"] = scene["a"] = 2.0
    bpy.context.view_layer["a"] = [0.25, 0.5, 1.0]
    output = tree.nodes["Material Output"]
    found = {}
    for node in [n for n in tree.nodes if n.bl_idname == "ShaderNodeAttribute"]:
        light = next(li.to_node for li in tree.links if li.from_node == node)
        tree.links.new(light.outputs[0], output.inputs["Surface"])
        nodes = export().scene.materials[0]["graph"]["nodes"]
        found[node.attribute_name] = next(n for n in nodes if n["type"] == "ShaderNodeAttribute")["params"]["value"]
    assert found == {"a": [0.25, 0.5, 1, 1], "b": [2, 2, 2, 1], "c": [3, 3, 3, 1], "d": [0, 0, 0, 0]}


def test_particle_info(scene):
    obj, tree = placed()
    tree.nodes.new("ShaderNodeParticleInfo")
    emitter = add(quad("Emitter"))
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 10, 1, 1, 50
    settings.render_type, settings.instance_object, settings.particle_size = "OBJECT", obj, 0.125
    scene.frame_set(1)
    scene.frame_set(5)
    found = [i for i in export().scene.instances if i["name"] == "Quad" and len(i["values"]) == 8]
    assert len(found) == 10
    by = [{v["name"].removeprefix("particle:"): v["value"] for v in i["values"]} for i in found]
    assert sorted(v["index"][0] for v in by) == list(range(10))
    assert {v["age"][0] for v in by} == {4} and {v["lifetime"][0] for v in by} == {50}
    assert all(v["size"][0] == pytest.approx(0.125) for v in by)
    assert len({tuple(v["location"]) for v in by}) == 10 and any(v["velocity"][2] for v in by)
    assert len({v["random"][0] for v in by}) == 10 and all(0 <= v["random"][0] <= 1 for v in by)


def normal_mapped(tree, uv_map=""):
    node = tree.nodes.new("ShaderNodeNormalMap")
    node.uv_map = uv_map
    return node


def with_uvs(obj, scale=(1, 1), name="UVMap"):
    layer = obj.data.uv_layers.new(name=name)
    for loop, uv in zip(layer.data, [(0, 0), (1, 0), (1, 1), (0, 1)]):
        loop.uv = (uv[0] * scale[0], uv[1] * scale[1])


def test_tangents_only_where_a_normal_map_is():
    obj, _ = placed()
    with_uvs(obj)
    assert not [n for n in export().scene.meshes[0]["attributes"] if n.startswith("#tangent")]


@pytest.mark.parametrize(("scale", "expected"), [
    ((1, 1), (1, 0, 0, 1)), ((-1, 1), (-1, 0, 0, -1)), ((1, -1), (1, 0, 0, -1))])
def test_tangents_of_the_active_map(scale, expected):
    obj, tree = placed()
    normal_mapped(tree)
    with_uvs(obj, scale)
    domain, tangents = export().scene.meshes[0]["attributes"]["#tangent:UVMap"]
    assert domain == "corner" and tangents.shape == (2, 3, 4)
    assert np.allclose(tangents, expected, atol=1e-6)


def test_tangents_of_a_named_map_in_a_group():
    obj, tree = placed()
    with_uvs(obj)
    with_uvs(obj, name="Second")
    group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    normal_mapped(group, "Second")
    tree.nodes.new("ShaderNodeGroup").node_tree = group
    layers = export().scene.meshes[0]["attributes"]
    assert [n for n in layers if n.startswith("#tangent")] == ["#tangent:Second"]


def test_one_mesh_with_two_materials_gets_what_each_needs():
    obj, tree = placed()
    normal_mapped(tree)
    with_uvs(obj)
    other = add(obj.data, "Other")
    other.material_slots[0].link = "OBJECT"
    other.material_slots[0].material = material("Plain")[0]
    scene = export().scene
    assert len(scene.meshes) == 2
    assert sorted("#tangent:UVMap" in m["attributes"] for m in scene.meshes) == [False, True]


def blenders_own_tangents(mesh):
    mesh.calc_tangents(uvmap="UVMap")
    tangents = np.array([(*loop.tangent, loop.bitangent_sign) for loop in mesh.loops], np.float32)
    order = np.array([t.loops for t in mesh.loop_triangles])
    return tangents[order]


@pytest.mark.parametrize("smooth", [True, False])
def test_tangents_equal_blenders_on_triangles(smooth):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12)
    obj = bpy.context.object
    obj.data.materials.append(material()[0])
    normal_mapped(obj.data.materials[0].node_tree)
    for polygon in obj.data.polygons:
        polygon.use_smooth = smooth
    obj.modifiers.new("Triangles", "TRIANGULATE")
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = export(depsgraph=depsgraph).scene.meshes[0]["attributes"]["#tangent:UVMap"][1]
    mesh = obj.evaluated_get(depsgraph).to_mesh()
    mesh.calc_loop_triangles()
    expected = blenders_own_tangents(mesh)
    close = np.abs(found - expected).max(-1) < 2e-3
    assert close.mean() > 0.99, f"{(~close).sum()} of {close.size} corners differ"


def test_tangents_of_useless_uvs_are_mikktspaces_default():
    positions = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    normals = np.tile(np.float32([0, 0, 1]), (1, 3, 1))
    for uv in (0.5, np.nan):
        found = corner_tangents(positions, np.array([[0, 1, 2]]), normals, np.full((1, 3, 2), uv, np.float32))
        assert (found[..., :3] == (1, 0, 0)).all() and np.isfinite(found).all()


def test_generated_sticks_to_a_bent_mesh():
    obj, _ = placed()
    scene = export().scene
    assert "#generated" not in scene.meshes[0]["attributes"]
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Up").data[2].co = (1, 1, 1)
    obj.data.shape_keys.key_blocks["Up"].value = 1
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = export(depsgraph=depsgraph).scene.meshes[0]
    if "#generated" in mesh["attributes"]:  # only depsgraphs evaluated for rendering keep undeformed coordinates
        assert np.allclose(mesh["attributes"]["#generated"][1][:, 2], mesh["attributes"]["#generated"][1][0, 2])


def test_needs_of_a_group_inside_itself_end():
    _, tree = placed()
    group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    tree.nodes.new("ShaderNodeGroup").node_tree = group
    normal_mapped(group, "A")
    assert needs.of_material(bpy.data.materials[0]).tangents == {"A"}
    assert needs.of_material(None) == needs.Needs()
