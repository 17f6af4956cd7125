# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair as thin tubes, and point clouds as balls."""

import time

import bpy
import numpy as np
import pytest
from cardioid.export import pointcloud, tubes

from .kit import add, by_name, export, quad

pytestmark = pytest.mark.usefixtures("scene")


def head(count=20, **settings):
    """A quad with hair that stands on it, two material slots."""
    obj = add(quad("Head"))
    for name in ("Skin", "Fur"):
        obj.data.materials.append(bpy.data.materials.new(name))
    layer = obj.data.uv_layers.new(name="UVMap")
    for loop, uv in zip(layer.data, [(0, 0), (1, 0), (1, 1), (0, 1)]):
        loop.uv = uv
    part = obj.modifiers.new("Hair", "PARTICLE_SYSTEM").particle_system.settings
    part.type, part.count, part.hair_length, part.radius_scale = "HAIR", count, 0.5, 0.01
    part.material = 2
    for name, value in settings.items():
        setattr(part, name, value)
    return obj


def hair(exported):
    return by_name(exported.scene.meshes, "Head (hair)")


def test_hair_stands_on_its_emitter():
    head()
    exported = export()
    mesh = hair(exported)
    assert not exported.warnings and len(exported.scene.instances) == 2
    assert mesh["positions"][:, 2].max() == pytest.approx(0.5, abs=0.02)
    assert mesh["positions"][:, 2].min() == pytest.approx(0, abs=1e-4)
    assert (mesh["slots"] == 1).all()


def test_values_along_a_strand():
    head(count=3)
    layers = {name: data for name, (_, data) in hair(export())["attributes"].items()}
    assert {"#curve_tangent", "#curve_intercept", "#curve_length", "#curve_thickness", "#curve_random"} <= set(layers)
    assert np.allclose(layers["#curve_tangent"], (0, 0, 1), atol=1e-3)
    assert layers["#curve_intercept"].min() == 0 and layers["#curve_intercept"].max() == pytest.approx(1)
    assert np.allclose(layers["#curve_length"], 0.5, atol=1e-3)
    assert layers["#curve_thickness"].max() == pytest.approx(0.01, rel=1e-3)
    assert len(np.unique(layers["#curve_random"])) == 3


def test_uvs_are_those_of_the_root():
    head()
    mesh = hair(export())
    uv, positions = mesh["attributes"]["UVMap"][1], mesh["positions"]
    assert mesh["active_uv"] == "UVMap"
    assert np.abs(uv - positions[:, :2]).max() < 0.06  # the quad's UVs are its coordinates; strands may lean a little


def test_hair_moves_with_its_emitter():
    obj = head()
    obj.location = (5, 0, 0)
    bpy.context.view_layer.update()
    exported = export()
    placed = [i for i in exported.scene.instances if i["mesh"] == exported.scene.meshes.index(hair(exported))]
    assert len(placed) == 1 and placed[0]["transform"][3] == 5
    assert hair(exported)["positions"][:, 0].max() < 1.2


def test_shape_of_strands():
    head(root_radius=1.0, tip_radius=0.5, use_close_tip=True, shape=0.0)
    thickness = hair(export())["attributes"]["#curve_thickness"][1]
    assert thickness.max() == pytest.approx(0.01, rel=1e-3) and thickness.min() == pytest.approx(0, abs=1e-6)


def test_children_take_the_place_of_their_parents():
    obj = head(count=10, child_type="SIMPLE")
    settings = obj.particle_systems[0].settings
    settings.rendered_child_count = 4
    setattr(settings, "child_percent" if hasattr(settings, "child_percent") else "child_nbr", 4)
    layers = hair(export())["attributes"]
    assert len(np.unique(layers["#curve_random"][1])) == 40


def test_ten_thousand_strands_take_seconds():
    head(count=10_000)
    bpy.context.evaluated_depsgraph_get()
    start = time.perf_counter()
    mesh = hair(export())
    seconds = time.perf_counter() - start
    print(f"{len(mesh['triangles'])} triangles in {seconds:.2f} s")
    assert len(mesh["triangles"]) > 100_000 and seconds < 10


def strands(count, points=5, radius=0.01):
    keys = np.zeros((count, points, 3), np.float32)
    keys[..., 0] = np.arange(count)[:, None]
    keys[..., 2] = np.linspace(0, 1, points)
    return tubes.Strands(keys, np.full((count, points), radius, np.float32), np.zeros(count, np.int32),
                         np.zeros(count, np.float32))


def test_triangles_turn_outwards():
    built, _ = tubes.build([strands(2)], np.zeros(3))
    points = built.positions[built.triangles]
    flat = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    assert (np.einsum("ti,ti->t", flat, built.normals[built.triangles].mean(1)) > 0).all()


def test_mean_width_is_that_of_the_strand():
    """Seen from all sides, a tube covers as much as the round strand: its outline over π."""
    built, _ = tubes.build([strands(1)], np.zeros(3))
    ring = built.positions[np.isclose(built.positions[:, 2], 0)]
    outline = np.linalg.norm(ring - np.roll(ring, 1, 0), axis=1).sum()
    assert outline / np.pi == pytest.approx(0.02, rel=1e-4)


def test_too_many_strands_are_thinned_out_and_widened():
    count = tubes.LIMIT // 2
    built, step = tubes.build([strands(count, points=3)], np.float32([0, -10, 0]))
    assert step == 2 and len(built.triangles) <= tubes.LIMIT
    assert np.ptp(built.positions[:6, 0]) == pytest.approx(0.04, rel=1e-3)


def test_strands_of_no_length_have_finite_tubes():
    short = strands(2)
    short.keys[:] = 0
    built, _ = tubes.build([short], np.zeros(3))
    assert all(np.isfinite(a).all() for a in (built.positions, built.normals, *built.layers.values()))


def test_hair_curves():
    obj = add(quad("Ground"))
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.curves_random_add()
    curves = bpy.context.object
    exported = export()
    mesh = by_name(exported.scene.meshes, curves.data.name)
    assert not exported.warnings
    assert len(np.unique(mesh["attributes"]["#curve_random"][1])) == len(curves.data.curves)


def test_empty_hair_curves():
    add(bpy.data.hair_curves.new("Bald"), "Bald")
    exported = export()
    assert not exported.scene.instances and not exported.warnings


def test_a_ball_is_round():
    for level in (0, 1, 2):
        corners, faces = pointcloud._ball(level)
        points = corners[faces].astype(np.float64)
        volume = np.einsum("ti,ti->t", points[:, 0], np.cross(points[:, 1], points[:, 2])).sum() / 6
        assert len(faces) == 20 * 4 ** level and len(corners) == 10 * 4 ** level + 2
        assert volume == pytest.approx(4 / 3 * np.pi, rel=0.4 / 3 ** level)
