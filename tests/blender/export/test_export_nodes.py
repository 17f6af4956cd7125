# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials' own settings, and the parameters of single nodes."""

import bpy
import pytest
from cardioid.export import compat

from .kit import add, by_name, export, material, quad

pytestmark = pytest.mark.usefixtures("scene")


def use(new):
    mesh = quad()
    mesh.materials.append(new)
    return add(mesh)


def exported_node(kind, output=0, target="Color", **properties):
    """The exported form of a node that is linked to a Diffuse BSDF."""
    new, tree = material()
    use(new)
    node = tree.nodes.new(kind)
    for key, value in properties.items():
        setattr(node, key, value)
    diffuse, end = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[output], diffuse.inputs[target])
    tree.links.new(diffuse.outputs[0], end.inputs[0])
    return node, lambda: by_name(by_name(export().scene.materials, "Material")["graph"]["nodes"], node.name)


def test_material_without_nodes():
    new = bpy.data.materials.new("Plain")
    if compat.has("nodes_always_on"):
        pytest.skip("materials always have nodes from 5.0")
    new.diffuse_color, new.metallic, new.roughness = (0.1, 0.2, 0.3, 1), 0.75, 0.25
    use(new)
    found = by_name(export().scene.materials, "Plain")
    assert "graph" not in found and found["viewport_color"] == pytest.approx([0.1, 0.2, 0.3])
    assert (found["metallic"], found["roughness"]) == (0.75, 0.25)


def test_material_settings():
    new, _ = material("Set")
    new.pass_index = 4
    use(new)
    found = by_name(export().scene.materials, "Set")
    assert found["use_transparent_shadow"] is True and found["sample_emission"] is True and found["pass_index"] == 4
    if compat.has("material_transparent_shadow"):
        new.use_transparent_shadow = False
    else:
        new.cycles.use_transparent_shadow = False
    if compat.has("emission_sampling"):
        new.cycles.emission_sampling = "NONE"
    else:
        new.cycles.sample_as_light = False
    new.update_tag()
    found = by_name(export().scene.materials, "Set")
    assert found["use_transparent_shadow"] is False and found["sample_emission"] is False


def test_principled_tells_its_version():
    new = bpy.data.materials.new("Default")
    if new.node_tree is None or not new.node_tree.nodes:
        new.use_nodes = True
    use(new)
    node = by_name(by_name(export().scene.materials, "Default")["graph"]["nodes"], "Principled BSDF")
    assert node["params"]["version"] == 1 + (bpy.app.version >= (4, 0)) + (bpy.app.version >= (5, 0))
    assert node["params"]["distribution"] in ("GGX", "MULTI_GGX")
    assert ("Coat Weight" in node["inputs"]) == (bpy.app.version >= (4, 0))


def test_value_node():
    node, found = exported_node("ShaderNodeValue", target="Roughness")
    node.outputs[0].default_value = 0.375
    assert found()["params"]["value"] == 0.375


def test_color_ramp():
    node, found = exported_node("ShaderNodeValToRGB")
    ramp = node.color_ramp
    ramp.interpolation = "CONSTANT"
    ramp.elements.new(0.25).color = (1, 0.5, 0, 0.5)
    params = found()["params"]
    assert params["ramp"] == pytest.approx([0, 0, 0, 0, 1, 0.25, 1, 0.5, 0, 0.5, 1, 1, 1, 1, 1])
    assert (params["ramp_interpolation"], params["ramp_color_mode"], params["ramp_hue"]) == ("CONSTANT", "RGB", "NEAR")


def test_rgb_curves_apply_the_combined_curve_first():
    node, found = exported_node("ShaderNodeRGBCurve")
    red, combined = node.mapping.curves[0], node.mapping.curves[3]
    combined.points[1].location = (1, 0.5)
    red.points[1].location = (1, 0.5)
    node.mapping.update()
    params = found()["params"]
    tables = [params[f"curve_table_{c}"] for c in "rgb"]
    assert all(len(t) == (257 if bpy.app.version >= (4, 5) else 256) for t in tables)
    assert tables[0][-1] == pytest.approx(0.25, abs=0.01) and tables[1][-1] == pytest.approx(0.5, abs=0.01)
    assert (params["curve_min"], params["curve_max"], params["curve_extrapolate"]) == (0, 1, True)


def test_vector_and_float_curves():
    _, found = exported_node("ShaderNodeVectorCurve")
    params = found()["params"]
    assert (params["curve_min"], params["curve_max"]) == (-1, 1)
    assert params["curve_table_z"][0] == pytest.approx(-1) and params["curve_table_x"][-1] == pytest.approx(1)


def test_float_curve():
    _, found = exported_node("ShaderNodeFloatCurve", target="Roughness")
    assert found()["params"]["curve_table_v"][128] == pytest.approx(128 / 255, abs=0.01)


def test_coordinates_of_an_object_carry_its_matrix():
    node, found = exported_node("ShaderNodeTexCoord", output=3)
    assert "object_matrix" not in found()["params"]
    node.object = add(None, "Empty", location=(1, 2, 3))
    assert found()["params"]["object_matrix"] == pytest.approx([1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3])


def test_old_texture_mapping_is_told_only_when_it_does_something():
    node, found = exported_node("ShaderNodeTexNoise")
    assert not [p for p in found()["params"] if p.startswith("texture_mapping")]
    node.texture_mapping.scale = (2, 2, 2)
    node.texture_mapping.mapping_x = "NONE"
    params = found()["params"]
    assert params["texture_mapping_scale"] == [2, 2, 2] and params["texture_mapping_axes"] == "NYZ"


def test_unsupported_nodes_are_passed_through_by_type():
    _, found = exported_node("ShaderNodeWireframe")
    assert found()["type"] == "ShaderNodeWireframe" and found()["params"] == {"use_pixel_size": False}


def test_attribute_parameters():
    _, found = exported_node("ShaderNodeAttribute", attribute_name="mine")
    assert found()["params"] == {"attribute_type": "GEOMETRY", "attribute_name": "mine"}


def test_every_shader_node_can_be_exported():
    new, tree = material()
    use(new)
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    failed, count = [], 0
    for kind in sorted(k for k in dir(bpy.types) if k.startswith("ShaderNode")):
        try:
            node = tree.nodes.new(kind)
        except RuntimeError:
            continue  # an abstract type, or one of worlds and lamps
        if not node.outputs:
            continue
        socket = next((s for s in node.outputs if not s.is_unavailable), node.outputs[0])
        slot = {"SHADER": "Surface"}.get(socket.type, "Displacement")
        tree.links.new(socket, end.inputs[slot])
        exported = export()
        count += 1
        graph = by_name(exported.scene.materials, "Material").get("graph") if exported.scene.materials else None
        if graph is None or not any(n["type"] == kind for n in graph["nodes"]):
            failed.append((kind, exported.warnings))
    print(f"\n{count} types of node")
    assert not failed and count > 70


@pytest.mark.parametrize("method", ["BUMP", "DISPLACEMENT", "BOTH"])
def test_displacement_method(method):
    new, tree = material()
    use(new)
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    (new if hasattr(new, "displacement_method") else new.cycles).displacement_method = method
    tree.links.new(tree.nodes.new("ShaderNodeDisplacement").outputs[0], end.inputs["Displacement"])
    exported = export()
    assert exported.scene.materials[0]["displacement_method"] == method.lower() and not exported.warnings


def test_an_unreadable_tree_is_named_and_the_rest_renders(monkeypatch):
    from cardioid.export import nodes
    exported_node("ShaderNodeTexNoise")

    def broken(*_):
        raise ValueError("broken on purpose")

    monkeypatch.setattr(nodes, "params", broken)
    exported = export()
    assert any("Material" in w and "broken on purpose" in w for w in exported.warnings)
    assert len(exported.scene.instances) == 1
