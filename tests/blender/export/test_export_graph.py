# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as flat graphs: links, groups, reroutes, muting, outputs."""

import bpy
import pytest

from .kit import add, by_name, export, material, quad

pytestmark = pytest.mark.usefixtures("scene")


@pytest.fixture
def tree():
    """The node tree of a material on a quad, with a Diffuse BSDF “D” linked to the output."""
    new, nodes = material()
    mesh = quad()
    mesh.materials.append(new)
    add(mesh)
    diffuse = node(nodes, "ShaderNodeBsdfDiffuse", "D")
    end = node(nodes, "ShaderNodeOutputMaterial", "Out")
    nodes.links.new(diffuse.outputs[0], end.inputs["Surface"])
    return nodes


def node(tree, kind, name=None, **properties):
    new = tree.nodes.new(kind)
    new.name = name or kind
    for key, value in properties.items():
        setattr(new, key, value)
    return new


def graph(exported=None):
    return by_name((exported or export()).scene.materials, "Material")["graph"]


def inputs(name="D"):
    return by_name(graph()["nodes"], name)["inputs"]


def group_tree(name="Group"):
    """A group with a colour input “C”, and an output “R” that is linked to it."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    socket(tree, "C", "NodeSocketColor", True)
    socket(tree, "R", "NodeSocketColor", False)
    begin, end = node(tree, "NodeGroupInput"), node(tree, "NodeGroupOutput")
    tree.links.new(begin.outputs[0], end.inputs[0])
    return tree


def socket(tree, name, kind, is_input):
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out="INPUT" if is_input else "OUTPUT", socket_type=kind)
    return (tree.inputs if is_input else tree.outputs).new(kind, name)


def test_values_links_and_identifiers(tree):
    math = node(tree, "ShaderNodeMath", "M", operation="SUBTRACT", use_clamp=True)
    math.inputs[0].default_value, math.inputs[1].default_value = 3, 2
    diffuse = tree.nodes["D"]
    diffuse.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1)
    tree.links.new(math.outputs[0], diffuse.inputs["Roughness"])
    found = graph()
    assert found["surface"] == [0, "BSDF"] and found["volume"] is None and found["displacement"] is None
    assert inputs()["Color"] == pytest.approx([0.1, 0.2, 0.3, 1])
    index = inputs()["Roughness"]["node"]
    assert inputs()["Roughness"] == {"node": index, "socket": "Value", "type": "VALUE"}
    assert found["nodes"][index]["params"] == {"operation": "SUBTRACT", "use_clamp": True}
    assert found["nodes"][index]["inputs"] == {"Value": 3, "Value_001": 2}


def test_unlinked_normals_are_left_to_the_engine(tree):
    assert "Normal" not in inputs()


def test_nodes_that_reach_nothing_stay_behind(tree):
    node(tree, "ShaderNodeTexNoise")
    assert len(graph()["nodes"]) == 1


def test_volume_and_displacement(tree):
    end = tree.nodes["Out"]
    tree.links.new(node(tree, "ShaderNodeVolumeAbsorption", "V").outputs[0], end.inputs["Volume"])
    tree.links.new(node(tree, "ShaderNodeDisplacement", "X").outputs[0], end.inputs["Displacement"])
    found = graph()
    assert found["nodes"][found["volume"][0]]["name"] == "V"
    assert found["nodes"][found["displacement"][0]]["name"] == "X"


def test_the_active_output_for_cycles_counts(tree):
    other = node(tree, "ShaderNodeOutputMaterial", "Other")
    glossy = node(tree, "ShaderNodeBsdfGlossy" if bpy.app.version < (4, 0) else "ShaderNodeBsdfAnisotropic", "G")
    tree.links.new(glossy.outputs[0], other.inputs["Surface"])
    tree.nodes["Out"].is_active_output = True
    assert graph()["nodes"][0]["name"] == "D"
    other.is_active_output = True
    assert graph()["nodes"][0]["name"] == "G"
    tree.nodes["Out"].target = "CYCLES"
    assert graph()["nodes"][0]["name"] == "D"
    tree.nodes["Out"].target = "EEVEE"
    assert graph()["nodes"][0]["name"] == "G"


def test_no_output_is_named(tree):
    tree.nodes.remove(tree.nodes["Out"])
    exported = export()
    found = graph(exported)
    assert (found["surface"], found["volume"], found["displacement"]) == (None, None, None)
    assert found["nodes"], "a graph without nodes would mean a material without a tree"
    assert any("Material" in w and "no active output" in w for w in exported.warnings)


def test_reroutes_vanish(tree):
    rgb = node(tree, "ShaderNodeRGB", "C")
    rgb.outputs[0].default_value = (1, 0.5, 0, 1)
    previous = rgb.outputs[0]
    for _ in range(50):
        reroute = node(tree, "NodeReroute")
        tree.links.new(previous, reroute.inputs[0])
        previous = reroute.outputs[0]
    tree.links.new(previous, tree.nodes["D"].inputs["Color"])
    found = graph()
    assert [n["name"] for n in found["nodes"]] == ["D", "C"]
    assert inputs()["Color"] == {"node": 1, "socket": "Color", "type": "RGBA"}
    assert found["nodes"][1]["params"]["value"] == pytest.approx([1, 0.5, 0, 1])


def test_a_reroute_without_a_source_is_black(tree):
    tree.links.new(node(tree, "NodeReroute").outputs[0], tree.nodes["D"].inputs["Color"])
    assert inputs()["Color"][:3] == [0, 0, 0]


def test_muted_nodes_hand_on_their_main_input(tree):
    rgb, gamma = node(tree, "ShaderNodeRGB", "C"), node(tree, "ShaderNodeGamma", "G")
    tree.links.new(rgb.outputs[0], gamma.inputs["Color"])
    tree.links.new(gamma.outputs[0], tree.nodes["D"].inputs["Color"])
    gamma.mute = True
    found = graph()
    assert [n["name"] for n in found["nodes"]] == ["D", "C"]
    tree.links.remove(gamma.inputs["Color"].links[0])
    gamma.inputs["Color"].default_value = (0.5, 0.25, 0, 1)
    assert inputs()["Color"] == pytest.approx([0.5, 0.25, 0, 1])


def test_muted_links_and_muted_sources_count_as_unlinked(tree):
    rgb = node(tree, "ShaderNodeRGB", "C")
    tree.nodes["D"].inputs["Color"].default_value = (0.3, 0.3, 0.3, 1)
    link = tree.links.new(rgb.outputs[0], tree.nodes["D"].inputs["Color"])
    rgb.mute = True
    assert inputs()["Color"] == pytest.approx([0.3, 0.3, 0.3, 1])
    rgb.mute, link.is_muted = False, True
    assert inputs()["Color"] == pytest.approx([0.3, 0.3, 0.3, 1])


def test_unavailable_sockets_are_left_out(tree):
    mix = node(tree, "ShaderNodeMix", "Mix", data_type="RGBA", blend_type="MULTIPLY")
    tree.links.new(mix.outputs["Result_Color" if "Result_Color" in mix.outputs else 2],
                   tree.nodes["D"].inputs["Color"])
    assert set(inputs("Mix")) == {"Factor_Float", "A_Color", "B_Color"}
    assert inputs()["Color"]["socket"] == "Result_Color"
    assert by_name(graph()["nodes"], "Mix")["params"]["blend_type"] == "MULTIPLY"


def place_group(tree, group, name="Use"):
    use = node(tree, "ShaderNodeGroup", name)
    use.node_tree = group
    return use


def test_an_output_inside_of_a_group_counts(tree):
    tree.nodes.remove(tree.nodes["Out"])
    group = bpy.data.node_groups.new("Whole", "ShaderNodeTree")
    glossy = node(group, "ShaderNodeEmission", "Inside")
    group.links.new(glossy.outputs[0], node(group, "ShaderNodeOutputMaterial").inputs["Surface"])
    place_group(tree, group)
    found = graph()
    assert [n["name"] for n in found["nodes"]] == ["Inside"]
    assert found["surface"][0] == 0


def test_groups_are_inlined_each_time(tree):
    group = group_tree()
    gamma = node(group, "ShaderNodeGamma", "Inside")
    group.links.new(group.nodes["NodeGroupInput"].outputs[0], gamma.inputs["Color"])
    group.links.new(gamma.outputs[0], group.nodes["NodeGroupOutput"].inputs[0])
    first, second = place_group(tree, group, "One"), place_group(tree, group, "Two")
    first.inputs[0].default_value = (0.1, 0.2, 0.3, 1)
    tree.links.new(first.outputs[0], second.inputs[0])
    tree.links.new(second.outputs[0], tree.nodes["D"].inputs["Color"])
    found = graph()["nodes"]
    assert [n["name"] for n in found] == ["D", "Inside", "Inside"]
    assert found[1]["inputs"]["Color"]["node"] == 2
    assert found[2]["inputs"]["Color"] == pytest.approx([0.1, 0.2, 0.3, 1])


def test_nested_groups_hand_values_through(tree):
    inner, outer = group_tree("Inner"), group_tree("Outer")
    use = place_group(outer, inner)
    outer.links.new(outer.nodes["NodeGroupInput"].outputs[0], use.inputs[0])
    outer.links.new(use.outputs[0], outer.nodes["NodeGroupOutput"].inputs[0])
    place = place_group(tree, outer)
    place.inputs[0].default_value = (0.5, 0.25, 0.125, 1)
    tree.links.new(place.outputs[0], tree.nodes["D"].inputs["Color"])
    assert inputs()["Color"] == pytest.approx([0.5, 0.25, 0.125, 1])
    tree.links.new(node(tree, "ShaderNodeRGB", "C").outputs[0], place.inputs[0])
    assert inputs()["Color"] == {"node": 1, "socket": "Color", "type": "RGBA"}


def test_unlinked_output_of_a_group_gives_its_value(tree):
    group = group_tree()
    group.links.clear()
    group.nodes["NodeGroupOutput"].inputs[0].default_value = (0.7, 0.6, 0.5, 1)
    tree.links.new(place_group(tree, group).outputs[0], tree.nodes["D"].inputs["Color"])
    assert inputs()["Color"] == pytest.approx([0.7, 0.6, 0.5, 1])


def test_muted_group(tree):
    group = group_tree()
    use = place_group(tree, group)
    use.inputs[0].default_value = (0.9, 0.8, 0.7, 1)
    group.links.clear()
    tree.links.new(use.outputs[0], tree.nodes["D"].inputs["Color"])
    use.mute = True
    assert inputs()["Color"] == pytest.approx([0.9, 0.8, 0.7, 1])


def test_group_without_a_tree_is_named(tree):
    use = place_group(tree, group_tree())
    tree.links.new(use.outputs[0], tree.nodes["D"].inputs["Color"])
    bpy.data.node_groups.remove(use.node_tree)
    exported = export()
    assert graph(exported)["surface"] == [0, "BSDF"]


def test_a_group_that_contains_itself_does_not_hang(tree, monkeypatch):
    # Blender refuses to build one, but damaged files have them: pretend that a group's tree is its parent.
    from cardioid.export import graph as walk
    outer, inner = group_tree("Outer"), group_tree("Inner")
    use = place_group(outer, inner)
    outer.links.new(use.outputs[0], outer.nodes["NodeGroupOutput"].inputs[0])
    tree.links.new(place_group(tree, outer).outputs[0], tree.nodes["D"].inputs["Color"])
    monkeypatch.setattr(walk._Place, "contains", lambda self, key: self.tree.name == "Outer")
    exported = export()
    assert any("contains itself" in w and "Inner" in w for w in exported.warnings)
    assert graph(exported)["surface"] == [0, "BSDF"]


def test_loops_of_links_end(tree):
    one, two = node(tree, "ShaderNodeGamma", "One"), node(tree, "ShaderNodeGamma", "Two")
    tree.links.new(one.outputs[0], two.inputs[0])
    tree.links.new(two.outputs[0], one.inputs[0])
    tree.links.new(two.outputs[0], tree.nodes["D"].inputs["Color"])
    found = graph()["nodes"]
    order = {i: [v["node"] for v in n["inputs"].values() if isinstance(v, dict)] for i, n in enumerate(found)}

    def reaches(start, goal, depth=0):
        return depth < 9 and any(i == goal or reaches(i, goal, depth + 1) for i in order[start])

    assert not any(reaches(i, i) for i in order)


def test_a_loop_of_reroutes_ends(tree):
    one, two = node(tree, "NodeReroute"), node(tree, "NodeReroute")
    tree.links.new(one.outputs[0], two.inputs[0])
    tree.links.new(two.outputs[0], one.inputs[0])
    tree.links.new(two.outputs[0], tree.nodes["D"].inputs["Color"])
    assert len(graph()["nodes"]) == 1


def test_a_colour_through_a_number_socket_is_grey(tree):
    group = bpy.data.node_groups.new("Number", "ShaderNodeTree")
    socket(group, "F", "NodeSocketFloat", True)
    socket(group, "R", "NodeSocketColor", False)
    begin, end = node(group, "NodeGroupInput"), node(group, "NodeGroupOutput")
    group.links.new(begin.outputs[0], end.inputs[0])
    use = place_group(tree, group)
    tree.links.new(node(tree, "ShaderNodeRGB", "C").outputs[0], use.inputs[0])
    tree.links.new(use.outputs[0], tree.nodes["D"].inputs["Color"])
    found = graph()["nodes"]
    source = found[inputs()["Color"]["node"]]
    assert source["type"] == "ShaderNodeRGBToBW" and inputs()["Color"]["type"] == "VALUE"
    assert found[source["inputs"]["Color"]["node"]]["name"] == "C"


def test_unlinked_group_inputs_are_converted(tree):
    group = bpy.data.node_groups.new("Number", "ShaderNodeTree")
    socket(group, "F", "NodeSocketFloat", True)
    socket(group, "R", "NodeSocketColor", False)
    begin, end = node(group, "NodeGroupInput"), node(group, "NodeGroupOutput")
    group.links.new(begin.outputs[0], end.inputs[0])
    use = place_group(tree, group)
    use.inputs[0].default_value = 0.5
    tree.links.new(use.outputs[0], tree.nodes["D"].inputs["Color"])
    assert inputs()["Color"] == [0.5, 0.5, 0.5, 1]


def test_frames_are_skipped(tree):
    frame = node(tree, "NodeFrame", "Frame")
    tree.nodes["D"].parent = frame
    assert [n["name"] for n in graph()["nodes"]] == ["D"]


def test_labels_are_the_names_in_messages(tree):
    tree.nodes["D"].label = "Paint"
    assert graph()["nodes"][0]["name"] == "Paint"


def test_a_long_chain_does_not_overflow(tree):
    previous = node(tree, "ShaderNodeRGB").outputs[0]
    for _ in range(700):
        gamma = tree.nodes.new("ShaderNodeGamma")
        tree.links.new(previous, gamma.inputs[0])
        previous = gamma.outputs[0]
    tree.links.new(previous, tree.nodes["D"].inputs["Color"])
    assert len(graph()["nodes"]) == 702


class NodeOfTomorrow(bpy.types.ShaderNodeCustomGroup):
    bl_idname = "ShaderNodeOfTomorrow"
    bl_label = "Tomorrow"


def test_a_node_of_an_unknown_type_is_named_and_its_link_ignored(tree):
    bpy.utils.register_class(NodeOfTomorrow)
    tree.nodes["D"].inputs["Color"].default_value = (0.25, 0.5, 0.75, 1)
    new = node(tree, "ShaderNodeOfTomorrow", "Tomorrow", node_tree=group_tree())
    tree.links.new(new.outputs[0], tree.nodes["D"].inputs["Color"])
    bpy.utils.unregister_class(NodeOfTomorrow)
    exported = export()
    found = graph(exported)["nodes"]
    assert [n["name"] for n in found] == ["D"] and found[0]["inputs"]["Color"] == [0.25, 0.5, 0.75, 1]
    assert any("Tomorrow" in w and "Material" in w for w in exported.warnings)
