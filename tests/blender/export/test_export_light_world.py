# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps and the world."""

import bpy
import pytest
from cardioid.export import compat, names

from .kit import add, by_name, export

pytestmark = pytest.mark.usefixtures("scene")


def lamp(kind, **properties):
    data = bpy.data.lights.new("Lamp", kind)
    for key, value in properties.items():
        setattr(data, key, value)
    return add(data)


def only_light():
    lights = export().scene.lights
    assert len(lights) == 1
    return lights[0]


def test_point_lamp():
    lamp("POINT", energy=12, color=(1, 0.5, 0.25), shadow_soft_size=0.3).location = (1, 2, 3)
    found = only_light()
    assert (found["kind"], found["energy"]) == ("point", 12) and found["color"] == pytest.approx([1, 0.5, 0.25])
    assert found["radius"] == pytest.approx(0.3) and found["transform"][3::4] == pytest.approx((1, 2, 3))
    assert found["legacy_lamp"] is (bpy.app.version < (4, 0))


def test_spot_lamp():
    lamp("SPOT", spot_size=1.2, spot_blend=0.4)
    found = only_light()
    assert found["kind"] == "spot"
    assert found["spot_angle"] == pytest.approx(1.2) and found["spot_blend"] == pytest.approx(0.4)


def test_sun():
    lamp("SUN", energy=-3, angle=0.1)
    found = only_light()
    assert (found["kind"], found["energy"]) == ("sun", -3) and found["angle"] == pytest.approx(0.1)


@pytest.mark.parametrize(("shape", "size_y"), [("SQUARE", 2), ("DISK", 2), ("RECTANGLE", 5), ("ELLIPSE", 5)])
def test_area_lamp(shape, size_y):
    lamp("AREA", shape=shape, size=2, size_y=5, spread=1.0)
    found = only_light()
    assert (found["shape"], found["size_x"], found["size_y"]) == (shape.lower(), 2, size_y)
    assert found["spread"] == pytest.approx(1.0) and found["portal"] is False


def test_cycles_settings_of_lamps():
    data = lamp("AREA").data
    data.cycles.max_bounces, data.cycles.is_portal = 3, True
    data.cycles.use_multiple_importance_sampling = False
    if compat.has("light_use_shadow"):
        data.use_shadow = False
    else:
        data.cycles.cast_shadow = False
    found = only_light()
    assert (found["max_bounces"], found["portal"], found["use_mis"], found["cast_shadow"]) == (3, True, False, False)


def test_lamps_are_hidden_from_the_camera_unless_asked():
    obj = lamp("POINT")
    assert only_light()["visibility"] == names.ALL & ~names.CAMERA
    obj.visible_camera, obj.visible_glossy = True, False
    assert only_light()["visibility"] == names.ALL & ~names.GLOSSY


@pytest.mark.skipif(bpy.app.version < (4, 5, 0), reason="exposure, temperature and normalize came with 4.5")
def test_exposure_temperature_and_normalize():
    data = lamp("POINT", energy=10, exposure=2, use_temperature=True, temperature=3000, normalize=False).data
    found = only_light()
    assert found["energy"] == pytest.approx(40) and found["normalize"] is False
    assert found["color"] == pytest.approx(list(data.temperature_color)) and found["color"][0] > found["color"][2]


def test_lamp_nodes():
    data = lamp("POINT").data
    assert "graph" not in only_light()
    data.use_nodes = True
    graph = only_light()["graph"]
    assert graph["nodes"][graph["surface"][0]]["type"] == "ShaderNodeEmission"


def test_lamps_in_instanced_collections():
    inner = bpy.data.collections.new("Inner")
    inner.objects.link(bpy.data.objects.new("In", bpy.data.lights.new("In", "POINT")))
    for x in (1, 2):
        add(None, f"Place{x}", instance_type="COLLECTION", instance_collection=inner, location=(x, 0, 0))
    assert sorted(light["transform"][3] for light in export().scene.lights) == [1, 2]


def test_no_world():
    assert export().scene.world is None


def test_world_without_nodes(scene):
    scene.world = bpy.data.worlds.new("Sky")
    if compat.has("nodes_always_on"):
        scene.world.node_tree.nodes.clear()
    scene.world.color = (0.1, 0.2, 0.3)
    found = export().scene.world
    assert found["name"] == "Sky" and found["color"] == pytest.approx([0.1, 0.2, 0.3])
    assert found.get("graph", {"surface": None})["surface"] is None


def test_world_settings(scene):
    world = scene.world = bpy.data.worlds.new("Sky")
    if world.node_tree is None:
        world.use_nodes = True
    world.cycles.sampling_method, world.cycles.sample_map_resolution, world.cycles.max_bounces = "MANUAL", 256, 2
    world.cycles_visibility.camera = world.cycles_visibility.scatter = False
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 3
    found = export().scene.world
    assert (found["sampling"], found["map_resolution"], found["max_bounces"]) == ("manual", 256, 2)
    assert found["visibility"] == names.ALL & ~names.CAMERA & ~names.VOLUME
    assert by_name(found["graph"]["nodes"], "Background")["inputs"]["Strength"] == 3


def test_without_the_cycles_addon_defaults_are_used(scene):
    import addon_utils
    addon_utils.disable("cycles")
    scene.world = bpy.data.worlds.new("Sky")
    lamp("AREA")
    found = export().scene
    assert found.world["sampling"] == "automatic" and found.world["visibility"] == names.ALL
    assert found.lights[0]["max_bounces"] == 1024 and found.lights[0]["use_mis"] is True
