# SPDX-License-Identifier: GPL-3.0-or-later
"""The view plane against Blender's own projection, depth of field, and cameras that are not supported."""

import math

import bpy
import pytest
from bpy_extras.object_utils import world_to_camera_view
from cardioid.export import ExportError
from mathutils import Vector

from .kit import add, export

pytestmark = pytest.mark.usefixtures("scene")


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("fit", ["AUTO", "HORIZONTAL", "VERTICAL"])
@pytest.mark.parametrize("size", [(200, 100), (100, 200), (100, 100)])
@pytest.mark.parametrize("aspect", [(1, 1), (2, 1), (1, 1.5)])
def test_points_land_where_blender_puts_them(scene, kind, fit, size, aspect):
    camera = scene.camera
    data = camera.data
    data.type, data.sensor_fit, data.shift_x, data.shift_y = kind, fit, 0.13, -0.21
    data.sensor_width, data.sensor_height, data.lens, data.ortho_scale = 30, 20, 42, 5
    render = scene.render
    render.resolution_x, render.resolution_y = size
    render.pixel_aspect_x, render.pixel_aspect_y = aspect
    bpy.context.view_layer.update()
    left, right, bottom, top = export(size).scene.camera["view_plane"]
    for point in (Vector((0.3, -0.2, -3)), Vector((-0.7, 0.5, -2))):
        expected = world_to_camera_view(scene, camera, point)
        scale = 1 if kind == "ORTHO" else -1 / point.z
        x, y = point.x * scale, point.y * scale
        assert (x - left) / (right - left) == pytest.approx(expected.x, abs=1e-5)
        assert (y - bottom) / (top - bottom) == pytest.approx(expected.y, abs=1e-5)


def test_kinds_and_clipping(scene):
    scene.camera.data.clip_start, scene.camera.data.clip_end = 0.5, 77
    found = export().scene.camera
    assert (found["kind"], found["clip_start"], found["clip_end"]) == ("perspective", 0.5, 77)
    scene.camera.data.type = "ORTHO"
    assert export().scene.camera["kind"] == "orthographic"


def test_scale_of_the_camera_object_does_not_matter(scene):
    scene.camera.scale = (3, 3, 3)
    scene.camera.location = (1, 2, 3)
    assert export().scene.camera["transform"] == pytest.approx((1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3))


def test_depth_of_field(scene):
    data = scene.camera.data
    data.lens, data.dof.use_dof, data.dof.aperture_fstop = 50, True, 2.0
    data.dof.aperture_blades, data.dof.aperture_rotation, data.dof.aperture_ratio = 6, 0.3, 1.5
    data.dof.focus_distance = 4
    found = export().scene.camera
    assert found["aperture_radius"] == pytest.approx(0.05 / 4)
    assert (found["blades"], found["focus_distance"]) == (6, 4)
    assert found["blade_rotation"] == pytest.approx(0.3) and found["aperture_ratio"] == pytest.approx(1.5)
    data.dof.use_dof = False
    assert export().scene.camera["aperture_radius"] == 0


def test_focus_on_an_object_is_measured_along_the_axis(scene):
    scene.camera.data.dof.use_dof = True
    scene.camera.data.dof.focus_object = add(None, "Target", location=(5, 0, -7))
    assert export().scene.camera["focus_distance"] == pytest.approx(7)


def test_panoramic_camera_is_named_and_rendered_as_perspective(scene):
    scene.camera.data.type = "PANO"
    exported = export()
    assert exported.scene.camera["kind"] == "perspective"
    assert any("Camera" in w and "Panoramic" in w for w in exported.warnings)


def test_no_camera_is_an_error(scene):
    scene.camera = None
    with pytest.raises(ExportError, match="no camera"):
        export()


def test_looking_through_a_spot_lamp(scene):
    lamp = bpy.data.lights.new("Spot", "SPOT")
    lamp.spot_size = math.radians(90)
    scene.camera = add(lamp)
    left, right, *_ = export((100, 100)).scene.camera["view_plane"]
    assert right - left == pytest.approx(36 / 16, rel=1e-3)


def test_settings_get_the_frame():
    found = export((320, 240), crop=(10, 20, 30, 40), settings={"samples": 5}).scene.settings
    assert (found["width"], found["height"], found["crop"], found["samples"]) == (320, 240, [10, 20, 30, 40], 5)
