# SPDX-License-Identifier: GPL-3.0-or-later
"""F12 on the fake engine: pictures, passes, layers, border, percentage, animation."""

from __future__ import annotations

import bpy
import numpy as np
import pictures


def combined(channels, layer="ViewLayer"):
    return np.stack([channels[f"{layer}.Combined.{letter}"] for letter in "RGBA"], axis=2)


def test_f12_gives_the_engines_picture(addon, render):
    picture = combined(render())
    height, width = 24, 40
    assert picture.shape == (height, width, 4)
    assert np.isfinite(picture).all()
    y, x = np.mgrid[0:height, 0:width]
    np.testing.assert_allclose(picture[..., 0], (x + 0.5) / width, atol=1e-6)
    np.testing.assert_allclose(picture[..., 1], (y + 0.5) / height, atol=1e-6)
    np.testing.assert_allclose(picture[..., 2], 4)  # all samples


def test_plain_exr_and_png(addon, render, tmp_path):
    channels = render("plain", multilayer=False)
    assert channels["R"].max() > 0.9 and channels["A"].min() == 1
    settings = bpy.context.scene.render.image_settings
    settings.file_format = "PNG"
    bpy.context.scene.render.filepath = str(tmp_path / "picture.png")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(tmp_path / "picture.png"))
    assert tuple(image.size) == (40, 24) and max(image.pixels) > 0.5


def test_resolution_percentage(addon, render):
    bpy.context.scene.render.resolution_percentage = 50
    assert combined(render()).shape[:2] == (12, 20)


def test_border_cropped(addon, render, fake):
    rendering = bpy.context.scene.render
    rendering.use_border = rendering.use_crop_to_border = True
    rendering.border_min_x, rendering.border_max_x = 0.25, 0.75
    rendering.border_min_y, rendering.border_max_y = 0.5, 1.0
    picture = combined(render())
    assert picture.shape[:2] == (12, 20)
    assert tuple(fake.scenes[-1].settings["crop"]) == (10, 12, 20, 12)
    np.testing.assert_allclose(picture[0, 0, :2], [0.5 / 20, 0.5 / 12], atol=1e-6)


def test_border_inside_the_frame(addon, render, fake):
    fake.behaviour.whole_frame = True
    rendering = bpy.context.scene.render
    rendering.use_border = True
    rendering.border_min_x, rendering.border_max_x = 0.25, 0.75
    rendering.border_min_y, rendering.border_max_y = 0.5, 1.0
    picture = combined(render())
    assert picture.shape[:2] == (24, 40)
    assert (picture[:12] == 0).all() and (picture[:, :10] == 0).all() and (picture[:, 30:] == 0).all()
    np.testing.assert_allclose(picture[12, 10, :2], [10.5 / 40, 12.5 / 24], atol=1e-6)


def test_odd_borders_fit_blenders_rounding(addon, render):
    rendering = bpy.context.scene.render
    rendering.use_border = rendering.use_crop_to_border = True
    for edge in (0.1, 0.7, 0.3333, 0.9):
        for size in (10, 33, 40):
            rendering.resolution_x = rendering.resolution_y = size
            rendering.border_min_x = rendering.border_min_y = edge - 0.1
            rendering.border_max_x = rendering.border_max_y = edge
            picture = combined(render())
            assert picture[..., 3].min() == 1, (edge, size)


def test_passes(addon, render):
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = True
    layer.cardioid.use_pass_d1 = layer.cardioid.use_pass_d3 = True
    layer.cardioid.use_pass_c1 = layer.cardioid.use_pass_c2 = True
    channels = render()
    assert channels["ViewLayer.Depth.Z"][2, 3] == 5
    np.testing.assert_allclose(channels["ViewLayer.Normal.X"][0, 0], 0.5 / 40, atol=1e-6)
    assert (channels["ViewLayer.Normal.Z"] == 1).all()
    assert (channels["ViewLayer.Cardioid D1.B"] == 10).all() and (channels["ViewLayer.Cardioid D3.B"] == 30).all()
    assert (channels["ViewLayer.Cardioid C1.R"] == channels["ViewLayer.Cardioid D1.R"]).all()
    assert (channels["ViewLayer.Cardioid C1.B"] == 40).all() and (channels["ViewLayer.Cardioid C2.B"] == 50).all()
    assert not any("D2" in name for name in channels)


def test_passes_reach_the_compositor(addon):
    """update_render_passes: the sockets are there before the first render."""
    scene, layer = bpy.context.scene, bpy.context.view_layer
    layer.use_pass_z = True
    layer.cardioid.use_pass_d2 = layer.cardioid.use_pass_c1 = True
    layer.update_render_passes()
    if hasattr(scene, "node_tree"):
        scene.use_nodes = True
        tree = scene.node_tree
    else:
        tree = bpy.data.node_groups.new("compositor", "CompositorNodeTree")
        scene.compositing_node_group = tree
    node = tree.nodes.new("CompositorNodeRLayers")
    enabled = {socket.name for socket in node.outputs if socket.enabled}
    assert {"Image", "Depth", "Cardioid D2", "Cardioid C1"} <= enabled
    assert not {"Cardioid D1", "Cardioid C2"} & enabled
    layer.cardioid.use_pass_c2 = True  # the switch alone is enough
    assert "Cardioid C2" in {socket.name for socket in node.outputs if socket.enabled}


def test_two_view_layers(addon, render, fake):
    scene = bpy.context.scene
    second = scene.view_layers.new("Second")
    second.use_pass_z = True
    channels = render()
    assert combined(channels).max() > 0 and combined(channels, "Second").max() > 0
    assert "Second.Depth.Z" in channels and "ViewLayer.Depth.Z" not in channels
    assert len(fake.sessions) == 2


def test_stereo_views(addon, fake, tmp_path):
    scene = bpy.context.scene
    scene.render.use_multiview = True
    pictures.set_exr(scene, False)
    scene.render.filepath = str(tmp_path / "stereo.exr")
    bpy.ops.render.render(write_still=True)
    assert len(fake.sessions) == 2
    for suffix in ("_L", "_R"):
        picture = pictures.read(tmp_path / f"stereo{suffix}.exr")
        assert picture["R"].max() > 0.9
    left, right = (next(call[1][0] for call in one.calls if call[0] == "set_camera") for one in fake.scenes)
    assert left["transform"] != right["transform"]


def test_transparent_film_keeps_alpha(addon, render, fake):
    bpy.context.scene.render.film_transparent = True
    render()
    assert fake.scenes[-1].settings["transparent_film"] is True


def test_animation_of_three_frames(addon, fake, tmp_path):
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    scene.cardioid.samples = 1
    scene.cardioid.keyframe_insert("samples", frame=1)
    scene.cardioid.samples = 3
    scene.cardioid.keyframe_insert("samples", frame=3)
    pictures.set_exr(scene, True)
    scene.render.filepath = str(tmp_path / "frame_####")
    bpy.ops.render.render(animation=True)
    written = sorted(tmp_path.glob("frame_*.exr"))
    assert [path.stem for path in written] == ["frame_0001", "frame_0002", "frame_0003"]
    assert [scene.settings["samples"] for scene in fake.scenes] == [1, 2, 3]
    assert combined(pictures.read(written[2]))[0, 0, 2] == 3


def test_metadata(addon, render, tmp_path):
    scene = bpy.context.scene
    scene.cardioid.seed = 17
    render("stamped")
    stamped = pictures.metadata(tmp_path / "stamped.exr")
    assert stamped["cardioid.version"] == "0.0.fake"
    assert stamped["cardioid.ViewLayer.samples"] == "4"
    assert stamped["cardioid.ViewLayer.seed"] == "17"
    assert float(stamped["cardioid.ViewLayer.render_time"]) >= 0
    photons = {name.removeprefix("cardioid.ViewLayer."): text for name, text in stamped.items()
               if name.startswith("cardioid.ViewLayer.")}
    assert photons | {
        "integrator": "hybrid", "photons.passes": "2", "photons.emitted": "1000000", "photons.stored": "150000",
        "photons.stored_share": "0.150000", "photons.gathered": "12345678", "seconds.photon_trace": "1.250",
        "seconds.photon_index": "0.500", "seconds.camera": "7.750", "bytes.photons": "3145728"} == photons


def test_path_tracing_has_no_photons_in_its_metadata(addon, render, tmp_path):
    bpy.context.scene.cardioid.integrator = "PT"
    render("stamped")
    stamped = pictures.metadata(tmp_path / "stamped.exr")
    assert stamped["cardioid.ViewLayer.integrator"] == "path_tracing"
    assert not [name for name in stamped if "photon" in name]
