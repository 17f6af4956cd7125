# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects and instances: each once, real instances, visibility, and what is left out by name."""

import time

import bpy
import pytest
from cardioid.export import ExportCancelled, build_scene, compat, names

from .kit import add, by_name, export, material, quad

pytestmark = pytest.mark.usefixtures("scene")


def curve(name="Curve"):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions, data.bevel_depth = "3D", 0.1
    data.splines.new("POLY").points.add(2)
    for i, point in enumerate(data.splines[0].points):
        point.co = (i, 0, 0, 1)
    return data


def text():
    data = bpy.data.curves.new("Text", "FONT")
    data.body = "C"
    return data


def meta():
    data = bpy.data.metaballs.new("Meta")
    data.elements.new()
    return data


def surface():
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    data = bpy.context.object.data
    bpy.data.objects.remove(bpy.context.object)
    return data


@pytest.mark.parametrize("make", [quad, curve, text, meta, surface])
def test_every_kind_of_geometry_comes_once(make):
    add(make(), "Thing")
    found = export().scene
    assert len(found.meshes) == len(found.instances) == 1
    assert found.instances[0]["name"] == "Thing" and len(found.meshes[0]["triangles"]) > 1


def test_a_curve_with_a_modifier_comes_once():
    add(curve()).modifiers.new("Solid", "SOLIDIFY")
    assert len(export().scene.instances) == 1


def test_objects_that_share_a_mesh_share_the_export():
    mesh = quad()
    add(mesh, "A")
    add(mesh, "B", location=(0, 0, 3))
    add(mesh, "C").modifiers.new("Solid", "SOLIDIFY")
    found = export().scene
    assert len(found.meshes) == 2 and len(found.instances) == 3
    assert by_name(found.instances, "A")["mesh"] == by_name(found.instances, "B")["mesh"]
    assert by_name(found.instances, "B")["transform"][11] == 3


def test_collection_instances():
    inner = bpy.data.collections.new("Inner")
    inner.objects.link(bpy.data.objects.new("Mesh", quad()))
    inner.objects.link(bpy.data.objects.new("Pipe", curve()))
    outer = bpy.data.collections.new("Outer")
    nested = bpy.data.objects.new("Nested", None)
    nested.instance_type, nested.instance_collection, nested.location = "COLLECTION", inner, (0, 0, 10)
    outer.objects.link(nested)
    for x in range(5):
        add(None, f"Place{x}", instance_type="COLLECTION", instance_collection=outer, location=(x, 0, 0))
    found = export().scene
    assert len(found.meshes) == 2 and len(found.instances) == 10
    assert {i["transform"][3] for i in found.instances} == {0, 1, 2, 3, 4}
    assert {i["transform"][11] for i in found.instances} == {10}
    assert len({i["random"] for i in found.instances}) == 10


@pytest.mark.parametrize("kind", ["VERTS", "FACES"])
def test_duplication_on_vertices_and_faces(kind):
    parent, child = add(quad(), "Parent"), add(quad("Child"), "Child")
    child.parent, parent.instance_type = parent, kind
    found = export().scene
    placed = [i for i in found.instances if i["name"] == "Child"]
    expected = sum(i.is_instance and i.object.name == "Child"
                   for i in bpy.context.evaluated_depsgraph_get().object_instances)
    assert expected == {"VERTS": 4, "FACES": 1}[kind] and len(placed) >= expected
    assert len(found.meshes) == 2


def geometry_nodes(*steps):
    """A modifier tree whose nodes are chained by `steps(tree, geometry socket) -> geometry socket`."""
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    if hasattr(tree, "interface"):
        tree.interface.new_socket("In", in_out="INPUT", socket_type="NodeSocketGeometry")
        tree.interface.new_socket("Out", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "In")
        tree.outputs.new("NodeSocketGeometry", "Out")
    link = tree.nodes.new("NodeGroupInput").outputs[0]
    for step in steps:
        link = step(tree, link)
    tree.links.new(link, tree.nodes.new("NodeGroupOutput").inputs[0])
    return tree


def scatter(tree, points):
    node = tree.nodes.new("GeometryNodeInstanceOnPoints")
    tree.links.new(points, node.inputs["Points"])
    tree.links.new(tree.nodes.new("GeometryNodeMeshCube").outputs["Mesh"], node.inputs["Instance"])
    return node.outputs["Instances"]


def paint(new):
    def step(tree, geometry):
        node = tree.nodes.new("GeometryNodeSetMaterial")
        node.inputs["Material"].default_value = new
        tree.links.new(geometry, node.inputs["Geometry"])
        return node.outputs["Geometry"]

    return step


def test_geometry_nodes_instances():
    obj = add(quad(), "Field")
    obj.modifiers.new("Nodes", "NODES").node_group = geometry_nodes(scatter)
    found = export().scene
    assert len(found.meshes) == 1 and len(found.instances) == 4 and len(found.meshes[0]["triangles"]) == 12
    assert {i["transform"][3:8:4] for i in found.instances} == {(0, 0), (1, 0), (1, 1), (0, 1)}


def test_material_that_geometry_nodes_set():
    new, _ = material("Paint")
    obj = add(quad(), "Field")
    obj.modifiers.new("Nodes", "NODES").node_group = geometry_nodes(scatter, paint(new))
    found = export().scene
    assert found.materials[found.instances[0]["materials"][0]]["name"] == "Paint"


def test_particles_as_objects():
    emitter, grain = add(quad(), "Emitter"), add(quad("Grain"), "Grain", location=(0, 0, 9))
    settings = emitter.modifiers.new("Particles", "PARTICLE_SYSTEM").particle_system.settings
    settings.count, settings.frame_start, settings.frame_end = 20, 1, 1
    settings.render_type, settings.instance_object = "OBJECT", grain
    settings.physics_type = "NO"
    bpy.context.scene.frame_set(2)
    found = export().scene
    assert len([i for i in found.instances if i["name"] == "Grain"]) == 21
    assert len(found.meshes) == 2 and len([i for i in found.instances if i["name"] == "Emitter"]) == 1


@pytest.mark.parametrize(("kind", "collection"), [("VOLUME", "volumes")])
def test_unsupported_objects_are_named(kind, collection):
    add(getattr(bpy.data, collection).new("Odd"), "Strange")
    exported = export()
    assert any("Strange" in w and "not supported" in w for w in exported.warnings)
    assert not exported.scene.instances


def test_smoke_is_named():
    modifier = add(quad(), "Chimney").modifiers.new("Fluid", "FLUID")
    modifier.fluid_type = "DOMAIN"
    modifier.domain_settings.domain_type = "GAS"
    assert any("Chimney" in w and "smoke" in w for w in export().warnings)


@pytest.mark.parametrize(("name", "number"), [("Cube", 0x502A11DF), ("Sphere.001", 0x43EA4365), ("Würfel", 0x071854B1)])
def test_random_number_of_a_plain_object_is_cycles_hash(name, number):
    # the numbers come from Cycles' own hash_uint2(hash_string(name), 0), compiled and run
    add(quad(), name)
    assert export().scene.instances[0]["random"] == pytest.approx(number / 0xFFFFFFFF, abs=1e-9)


def test_numbers_of_an_object():
    obj = add(quad(), "Thing", pass_index=7, color=(0.1, 0.2, 0.3, 0.4))
    found = export().scene.instances[0]
    assert found["pass_index"] == 7 and found["color"] == pytest.approx([0.1, 0.2, 0.3, 0.4])
    assert found["visibility"] == names.ALL and found["holdout"] is False
    assert found["materials"] == [-1] and obj.data is not None


@pytest.mark.parametrize(("name", "bit"), [
    ("visible_camera", names.CAMERA), ("visible_diffuse", names.DIFFUSE), ("visible_glossy", names.GLOSSY),
    ("visible_transmission", names.TRANSMISSION), ("visible_volume_scatter", names.VOLUME),
    ("visible_shadow", names.SHADOW)])
def test_visibility_by_kind_of_ray(name, bit):
    add(quad(), "Thing", **{name: False})
    assert export().scene.instances[0]["visibility"] == names.ALL & ~bit


def test_visibility_of_the_instancer_counts_too():
    inner = bpy.data.collections.new("Inner")
    inner.objects.link(bpy.data.objects.new("Mesh", quad()))
    inner.objects[0].visible_glossy = False
    add(None, "Place", instance_type="COLLECTION", instance_collection=inner, visible_diffuse=False)
    assert export().scene.instances[0]["visibility"] == names.ALL & ~names.DIFFUSE & ~names.GLOSSY


def test_objects_that_no_ray_sees_are_left_out():
    add(quad(), "Thing", **{name: False for name, _ in names._OBJECT_BITS})
    exported = export()
    assert not exported.scene.meshes and not exported.scene.instances


def test_holdout_object_and_collections_of_the_view_layer(scene):
    add(quad(), "Plain")
    add(quad(), "Held", is_holdout=True)
    for name, flag in (("H", "holdout"), ("I", "indirect_only")):
        collection = bpy.data.collections.new(name)
        scene.collection.children.link(collection)
        collection.objects.link(bpy.data.objects.new(f"In{name}", quad()))
        setattr(bpy.context.view_layer.layer_collection.children[name], flag, True)
    found = export().scene.instances
    assert {i["name"] for i in found if i["holdout"]} == {"Held", "InH"}
    assert by_name(found, "InI")["visibility"] == names.ALL & ~names.CAMERA
    assert by_name(found, "Plain")["visibility"] == names.ALL


def test_filters_of_the_view_layer(scene):
    scene.world = bpy.data.worlds.new("Sky")
    add(quad())
    add(bpy.data.lights.new("Lamp", "POINT"))
    bpy.context.view_layer.use_sky = bpy.context.view_layer.use_solid = False
    found = export().scene
    assert found.world is None and not found.instances and len(found.lights) == 1


def test_shadow_catcher_is_named_for_meshes_only():
    add(quad(), "Catcher", is_shadow_catcher=True)
    add(bpy.data.lights.new("Lamp", "POINT"))
    warnings = export().warnings
    assert len(warnings) == 1 and "Catcher" in warnings[0]


def test_slots_linked_to_the_object():
    first, second = material("First")[0], material("Second")[0]
    mesh = quad()
    mesh.materials.append(first)
    add(mesh, "A")
    obj = add(mesh, "B")
    obj.material_slots[0].link, obj.material_slots[0].material = "OBJECT", second
    found = export().scene
    assert len(found.meshes) == 1
    assert {i["name"]: found.materials[i["materials"][0]]["name"] for i in found.instances} == {
        "A": "First", "B": "Second"}


def test_empty_slots_and_the_view_layers_override():
    new = material("Over")[0]
    mesh = quad()
    mesh.materials.append(None)
    add(mesh, "A")
    add(quad(), "B")
    assert [i["materials"] for i in export().scene.instances] == [[-1], [-1]]
    bpy.context.view_layer.material_override = new
    found = export().scene
    assert [i["materials"] for i in found.instances] == [[0], [0]] and found.materials[0]["name"] == "Over"


def test_a_failing_object_is_named_once_and_the_rest_is_placed(monkeypatch):
    from cardioid.export import mesh as mesh_export
    real = mesh_export.add

    def fragile(scene, name, *rest):
        if name == "Bad":
            raise ValueError("broken on purpose")
        return real(scene, name, *rest)

    monkeypatch.setattr(mesh_export, "add", fragile)
    bad, good = quad("Bad"), quad("Good")
    for x in range(3):
        add(bad, f"Bad{x}")
        add(good, f"Good{x}")
    exported = export()
    assert sorted(i["name"] for i in exported.scene.instances) == ["Good0", "Good1", "Good2"]
    assert [w for w in exported.warnings if "broken on purpose" in w and "Bad" in w]


@pytest.mark.parametrize("levels", [0, 1])
def test_a_mesh_in_edit_mode_is_there(levels):
    import bmesh
    obj = add(quad(), "Thing")
    if levels:
        obj.modifiers.new("Sub", "SUBSURF").levels = levels
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    mesh = bmesh.from_edit_mesh(obj.data)
    bmesh.ops.poke(mesh, faces=mesh.faces)
    bmesh.update_edit_mesh(obj.data)
    found = export().scene
    assert len(found.meshes[0]["triangles"]) == (24 if levels else 4)


@pytest.mark.skipif(bpy.app.version < (4, 0, 0), reason="light linking came with 4.0")
def test_light_linking_is_named():
    add(bpy.data.lights.new("Lamp", "POINT")).light_linking.receiver_collection = bpy.data.collections.new("R")
    assert any("Lamp" in w and "light linking" in w for w in export().warnings)


def test_the_export_can_be_stopped():
    add(quad())
    with pytest.raises(ExportCancelled):
        export(should_stop=lambda: True)


def test_many_instances():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=212, y_subdivisions=212)
    obj = bpy.context.object
    obj.modifiers.new("Nodes", "NODES").node_group = geometry_nodes(scatter)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    start = time.perf_counter()
    found = export(depsgraph=depsgraph).scene
    print(f"\n{len(found.instances)} instances: {time.perf_counter() - start:.2f} s (with the recorder's checks)")
    assert len(found.instances) > 44_000 and len(found.meshes) == 1


def test_render_visibility_modifier_levels_and_camera_of_a_real_render(scene):
    add(quad(), "HiddenInViewport", hide_viewport=True)
    add(quad(), "HiddenInRender", hide_render=True)
    levels = add(quad(), "Levels").modifiers.new("Sub", "SUBSURF")
    levels.levels, levels.render_levels = 0, 2
    scene.camera.scale = (2, 2, 2)
    seen = {}

    class Probe(bpy.types.RenderEngine):
        bl_idname, bl_label = "CARDIOID_TEST_PROBE", "Probe"

        def render(self, depsgraph):
            import fake_core
            from cardioid.export import ExportOptions
            try:
                options = ExportOptions((16, 16), engine=self)
                seen["scene"] = build_scene(fake_core, depsgraph, depsgraph.view_layer_eval, options).scene
            except Exception as error:
                seen["error"] = error

    bpy.utils.register_class(Probe)
    try:
        scene.render.engine = Probe.bl_idname
        scene.render.resolution_x = scene.render.resolution_y = 16
        bpy.ops.render.render()
    finally:
        scene.render.engine = "CYCLES"
        bpy.utils.unregister_class(Probe)
    assert "error" not in seen, seen["error"]
    assert sorted(i["name"] for i in seen["scene"].instances) == ["HiddenInViewport", "Levels"]
    placed = by_name(seen["scene"].instances, "Levels")
    assert len(seen["scene"].meshes[placed["mesh"]]["triangles"]) == 32
    assert seen["scene"].camera["transform"][0] == pytest.approx(1)


def test_version_table_is_readable():
    assert all(isinstance(compat.has(key), bool) for key in compat.SINCE)
