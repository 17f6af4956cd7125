# SPDX-License-Identifier: GPL-3.0-or-later
"""Films after the render, on the fake engine: how long they live, where they are saved, and filtering them again."""

from __future__ import annotations

import gc
import sys
import threading
import time

import bpy
import numpy as np
import pictures
import pytest


@pytest.fixture
def films(addon):
    from cardioid import films

    films.clear()
    yield films
    films.clear()


@pytest.fixture
def told(monkeypatch):
    """What the info bar says."""
    from cardioid import messages

    said = []
    monkeypatch.setattr(messages, "warn", lambda engine, texts: said.extend(texts))
    return said


def alive(fake) -> int:
    gc.collect()
    return fake.Film.alive


def blue(channels, name="Combined", layer="ViewLayer") -> float:
    values = np.unique(channels[f"{layer}.{name}.B"])
    assert len(values) == 1
    return float(values[0])


def filter_again(tmp_path, name="again"):
    pictures.set_exr(bpy.context.scene, True)
    bpy.context.scene.render.filepath = str(tmp_path / f"{name}.exr")
    assert bpy.ops.cardioid.filter_again(write_still=True) == {"FINISHED"}
    return pictures.read(tmp_path / f"{name}.exr")


def test_a_film_is_kept_and_gives_way_to_the_next(films, fake):
    before = alive(fake)
    for _ in range(3):
        bpy.ops.render.render()
    kept = films.get("Scene", "ViewLayer", "")
    assert alive(fake) == before + 1 and (kept.film.width, kept.film.height) == (40, 24)
    assert kept.settings["filter_size"] == 11 and kept.settings["use_filter"] is True


def test_the_old_film_is_freed_before_the_new_render_needs_memory(films, fake):
    bpy.ops.render.render()
    before, during = alive(fake), []
    fake.behaviour.on_sample = lambda session: during.append(fake.Film.alive)
    bpy.ops.render.render()
    assert during and max(during) == before - 1


def test_films_go_with_the_file_the_switch_and_the_add_on(films, fake, addon):
    bpy.ops.render.render()
    with_film = alive(fake)
    bpy.ops.cardioid.free_film()
    assert alive(fake) == with_film - 1 and not films.of_scene("Scene")
    bpy.context.scene.cardioid.keep_film = False
    bpy.ops.render.render()
    assert alive(fake) == with_film - 1
    bpy.context.scene.cardioid.keep_film = True
    bpy.ops.render.render()
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert alive(fake) == with_film - 1
    bpy.context.scene.render.engine = "CARDIOID"
    bpy.context.scene.cardioid.samples = 1
    bpy.ops.render.render()
    addon.unregister()
    assert alive(fake) == with_film - 1
    addon.register()


def test_previews_keep_nothing(films, fake, monkeypatch):
    from cardioid import final_render
    from test_running import Watched

    original = final_render.render
    monkeypatch.setattr(final_render, "render",
                        lambda engine, graph: original(Watched(engine, {"is_preview": True}), graph))
    bpy.ops.render.render()
    assert fake.sessions and not films.of_scene("Scene")


def test_a_cancelled_render_keeps_its_film(films, fake):
    from cardioid import sessions

    bpy.context.scene.cardioid.samples = 100000
    fake.behaviour.sample_seconds = 0.01
    threading.Timer(0.4, sessions.cancel_all).start()
    bpy.ops.render.render()
    assert films.get("Scene", "ViewLayer", "").film.samples < 100000


def test_filtering_again_neither_exports_nor_traces(films, fake, tmp_path):
    bpy.ops.render.render()
    bpy.context.scene.cardioid.filter_size = 21
    for name in ("raw", "filtered", "withheld"):  # the passes need no new render either
        setattr(bpy.context.view_layer.cardioid, f"use_pass_{name}", True)
    channels = filter_again(tmp_path)
    assert len(fake.scenes) == len(fake.sessions) == 1
    assert blue(channels) == 21 and blue(channels, "Cardioid Raw") == -1 and blue(channels, "Cardioid Filtered") == 21
    job = fake.fake_film.jobs[-1]
    assert job.film is films.get("Scene", "ViewLayer", "").film and job.settings["filter_size"] == 21
    assert films.get("Scene", "ViewLayer", "").settings["filter_size"] == 21


def test_the_filter_switched_off_shows_the_raw_picture(films, fake, tmp_path):
    bpy.ops.render.render()
    bpy.context.scene.cardioid.use_filter = False
    assert blue(filter_again(tmp_path)) == -1


def test_metadata_keeps_the_render_and_has_the_new_filter(films, tmp_path):
    bpy.context.scene.cardioid.seed = 17
    bpy.ops.render.render()
    bpy.context.scene.cardioid.seed = 18
    filter_again(tmp_path)
    stamped = pictures.metadata(tmp_path / "again.exr")
    assert stamped["cardioid.ViewLayer.seed"] == "17" and stamped["cardioid.ViewLayer.samples"] == "4"
    assert stamped["cardioid.ViewLayer.filter.withheld_share"] == "0.012500"


def test_layers_and_views(films, fake, tmp_path):
    scene = bpy.context.scene
    scene.view_layers.new("Second")
    bpy.ops.render.render()
    assert set(films.of_scene("Scene")) == {("ViewLayer", ""), ("Second", "")}
    scene.cardioid.filter_size = 5
    channels = filter_again(tmp_path)
    assert blue(channels) == blue(channels, layer="Second") == 5 and len(fake.sessions) == 2
    scene.view_layers.remove(scene.view_layers["Second"])
    scene.render.use_multiview = True
    bpy.ops.render.render()
    assert set(films.of_scene("Scene")) == {("ViewLayer", "left"), ("ViewLayer", "right")}
    assert bpy.ops.cardioid.filter_again() == {"FINISHED"} and len(fake.sessions) == 4


def test_the_compositor_has_the_new_picture(films, fake, tmp_path):
    """Blue of the composite: that of the filter, doubled."""
    scene = bpy.context.scene
    bpy.ops.render.render()
    double_by_compositor(scene)
    scene.cardioid.filter_size = 9
    pictures.set_exr(scene, False)
    scene.render.filepath = str(tmp_path / "composite.exr")
    assert bpy.ops.cardioid.filter_again(write_still=True) == {"FINISHED"}
    assert set(np.unique(pictures.read(tmp_path / "composite.exr")["B"])) == {18.0}


def double_by_compositor(scene) -> None:
    scene.render.use_compositing = True
    if hasattr(scene, "node_tree"):
        scene.use_nodes = True
        tree = scene.node_tree
        tree.nodes.clear()
        output = tree.nodes.new("CompositorNodeComposite")
    else:
        tree = bpy.data.node_groups.new("compositor", "CompositorNodeTree")
        scene.compositing_node_group = tree
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        output = tree.nodes.new("NodeGroupOutput")
    layers, mix = tree.nodes.new("CompositorNodeRLayers"), mix_node(tree)
    tree.links.new(layers.outputs["Image"], mix[0])
    tree.links.new(layers.outputs["Image"], mix[1])
    tree.links.new(mix[2], output.inputs[0])


def mix_node(tree):
    """An adding node's two inputs and its output."""
    if bpy.app.version >= (5, 0):
        node = tree.nodes.new("ShaderNodeMix")
        node.data_type, node.blend_type, node.clamp_result = "RGBA", "ADD", False
        node.inputs[0].default_value = 1.0
        return node.inputs[6], node.inputs[7], node.outputs[2]
    node = tree.nodes.new("CompositorNodeMixRGB")
    node.blend_type = "ADD"
    return node.inputs[1], node.inputs[2], node.outputs[0]


def test_what_is_in_the_way(films, fake):
    scene = bpy.context.scene
    with pytest.raises(RuntimeError, match="poll"):
        bpy.ops.cardioid.filter_again()
    bpy.ops.render.render()
    scene.render.resolution_x = 60
    with pytest.raises(RuntimeError, match="size or border of the frame has changed"):
        bpy.ops.cardioid.filter_again()
    scene.render.resolution_x = 40
    scene.view_layers.new("Second")
    with pytest.raises(RuntimeError, match="View layers or views have changed"):
        bpy.ops.cardioid.filter_again()
    scene.view_layers["Second"].use = False
    assert bpy.ops.cardioid.filter_again() == {"FINISHED"} and len(fake.sessions) == 1


def test_a_filter_that_fails(films, fake, tmp_path):
    from cardioid import retune

    bpy.ops.render.render()
    fake.fake_film.behaviour.fail = "there is not enough memory to filter"
    bpy.context.scene.render.filepath = str(tmp_path / "failed.exr")
    pictures.set_exr(bpy.context.scene, True)
    with pytest.raises(RuntimeError, match="Error: Cardioid: there is not enough memory to filter"):
        bpy.ops.cardioid.filter_again(write_still=True)
    assert retune.current() is None and "not enough memory" in retune.problem("Scene")
    assert films.get("Scene", "ViewLayer", "").settings["use_filter"] is False  # the noisy picture is shown
    if (tmp_path / "failed.exr").exists():
        assert blue(pictures.read(tmp_path / "failed.exr")) == -1
    fake.fake_film.behaviour.fail = ""
    bpy.ops.render.render()
    assert len(fake.sessions) == 2  # renders again, as F12 should


def test_latest_change_wins(films, fake):
    from cardioid import refilter

    bpy.ops.render.render()
    fake.fake_film.behaviour.filter_seconds = 0.3
    kept = films.get("Scene", "ViewLayer", "")
    work = refilter.Refilter(fake, kept, {"use_filter": True, "filter_size": 3})
    shown, wishes = [], [5, 7, 9]

    def tell(share):
        if wishes:
            work.want({"use_filter": True, "filter_size": wishes.pop(0)})

    refilter.run(work, lambda frame: shown.append(frame.array("Combined")[0, 0, 2]), lambda: False, tell, 0.2)
    assert shown == [9] and kept.settings["filter_size"] == 9
    assert [job.cancelled for job in fake.fake_film.jobs] == [True, True, True, False]


def test_esc_leaves_the_noisy_picture_and_the_film(films, fake, tmp_path, monkeypatch):
    from cardioid import final_render
    from test_running import Watched

    bpy.ops.render.render()
    fake.fake_film.behaviour.filter_seconds = 60
    original, start = final_render.render, time.monotonic()
    stop = {"test_break": lambda: time.monotonic() - start > 0.3}
    monkeypatch.setattr(final_render, "render", lambda engine, graph: original(Watched(engine, stop), graph))
    channels = filter_again(tmp_path)
    assert time.monotonic() - start < 3 and blue(channels) == -1
    kept = films.get("Scene", "ViewLayer", "")
    assert kept.settings["use_filter"] is False and fake.fake_film.jobs[-2].cancelled
    last = fake.fake_film.jobs[-1].settings  # nothing that takes time
    assert last["filter_method"] == "none" and last["firefly_density"] == 0


def test_films_of_an_animation_lie_beside_the_frames(films, fake, tmp_path):
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.cardioid.save_film = 1, 3, True
    scene.render.filepath = str(tmp_path / "frame_###")
    before, during = alive(fake), []
    fake.behaviour.on_sample = lambda session: during.append(fake.Film.alive)
    bpy.ops.render.render(animation=True)
    assert during and max(during) == before  # each frame's film gives way to the next one's
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        f"frame_00{number}.{kind}" for number in (1, 2, 3) for kind in ("cardioid", "png")]
    assert alive(fake) == before + 1


@pytest.mark.parametrize("filepath, animation, expected", [
    ("/r/shot.v2", True, "/r/shot.v20007.cardioid"), ("/r/shot_", True, "/r/shot_0007.cardioid"),
    ("/r/shot_##.exr", True, "/r/shot_07.cardioid"), ("/r/still.png", False, "/r/still.cardioid"),
    ("/r/still.v2", False, "/r/still.v2.cardioid"), ("/r/", False, "/r/0007.cardioid"),
    ("/r/still_###", False, "/r/still_007.cardioid")])
def test_paths(films, filepath, animation, expected):
    from cardioid import film_files

    scene = bpy.context.scene
    scene.frame_current, scene.render.filepath = 7, filepath
    assert film_files.path_of(scene, "ViewLayer", "", animation=animation) == expected


def test_paths_of_layers_views_movies_and_the_command_line(films):
    from cardioid import film_files

    scene = bpy.context.scene
    scene.frame_current, scene.render.filepath = 7, "/r/f_"
    scene.view_layers.new("Far away")
    scene.render.use_multiview = True
    assert film_files.path_of(scene, "Far away", "left", animation=True) == "/r/f_0007_Far_away_L.cardioid"
    scene.view_layers["Far away"].use = False
    assert film_files.path_of(scene, "ViewLayer", "", animation=True, given="/r/x#.cardioid") == "/r/x7.cardioid"
    if hasattr(scene.render.image_settings, "media_type"):
        scene.render.image_settings.media_type = "VIDEO"
    scene.render.image_settings.file_format = "FFMPEG"
    assert film_files.path_of(scene, "ViewLayer", "", animation=True) == "/r/f_0007.cardioid"


def test_a_film_that_cannot_be_saved_costs_no_picture(films, fake, told, tmp_path):
    scene = bpy.context.scene
    scene.cardioid.save_film, fake.fake_film.behaviour.full_disk = True, True
    scene.render.filepath = str(tmp_path / "still.png")
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    assert (tmp_path / "still.png").exists() and not list(tmp_path.glob("*.cardioid"))
    assert len(told) == 1 and "could not be saved" in told[0] and "no space left" in told[0]
    fake.fake_film.behaviour.full_disk = False
    (tmp_path / "blocked").touch()
    scene.render.filepath = str(tmp_path / "blocked" / "still.png")
    bpy.ops.render.render()
    assert len(told) == 2 and "blocked" in told[1]


def test_film_of_the_command_line(films, fake, tmp_path, monkeypatch):
    bpy.context.scene.cardioid.use_filter = False
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-film", str(tmp_path / "at_#.cardioid")])
    bpy.ops.render.render()
    assert [path.name for path in tmp_path.iterdir()] == ["at_1.cardioid"]
    assert fake.scenes[-1].settings["record_clusters"] is True


def test_saved_and_opened_again_into_the_render_result(films, fake, tmp_path):
    bpy.ops.render.render()
    path = str(tmp_path / "frame.cardioid")
    assert bpy.ops.cardioid.save_film(filepath=path) == {"FINISHED"}
    bpy.ops.cardioid.free_film()
    bpy.context.scene.cardioid.filter_size = 13
    assert bpy.ops.cardioid.open_film(filepath=path) == {"FINISHED"}
    kept = films.get("Scene", "ViewLayer", "")
    assert kept.source == "frame.cardioid" and kept.settings["filter_size"] == 13 and len(fake.sessions) == 1
    assert blue(filter_again(tmp_path)) == 13


def test_a_film_of_another_size_is_shown_as_an_image(films, fake, tmp_path):
    bpy.ops.render.render()
    path = str(tmp_path / "frame.cardioid")
    bpy.ops.cardioid.save_film(filepath=path)
    bpy.context.scene.render.resolution_x = 80
    assert bpy.ops.cardioid.open_film(filepath=path) == {"FINISHED"}
    image = bpy.data.images["frame"]
    pixels = np.array(image.pixels[:]).reshape(24, 40, 4)
    assert image.is_float and image.use_view_as_render and np.all(pixels[..., 2] == 11) and np.all(pixels[..., 3] == 1)
    np.testing.assert_allclose(pixels[0, 0, :2], [0.5 / 40, 0.5 / 24], rtol=1e-5)
    assert films.of_image("frame").settings["filter_size"] == 11
    assert films.get("Scene", "ViewLayer", "").film is not films.of_image("frame").film
    bpy.data.images.remove(image)
    films.drop_orphans()
    assert films.of_image("frame") is None


def test_files_that_are_no_films(films, fake, tmp_path):
    bpy.ops.render.render()
    kept = films.get("Scene", "ViewLayer", "")
    (tmp_path / "damaged.cardioid").write_text("{")
    (tmp_path / "empty.cardioid").write_text("[40, 24, 4, {}, false]")
    for name, sentence in (("damaged", "is damaged"), ("absent", "cannot be read"), ("empty", "without what")):
        with pytest.raises(RuntimeError, match=sentence):
            bpy.ops.cardioid.open_film(filepath=str(tmp_path / f"{name}.cardioid"))
    assert films.get("Scene", "ViewLayer", "") is kept
    fake.fake_film.behaviour.full_disk = True
    with pytest.raises(RuntimeError, match="no space left"):
        bpy.ops.cardioid.save_film(filepath=str(tmp_path / "new.cardioid"))


def test_freestyle_strokes_keep_no_film_and_are_not_filtered(films, fake):
    scene = bpy.context.scene
    scene.render.use_freestyle = True
    bpy.ops.render.render()
    assert len(fake.scenes) == 2
    assert [one.settings["use_filter"] for one in fake.scenes] == [True, False]
    assert set(films._kept) == {("Scene", "ViewLayer", "")}
    assert bpy.ops.cardioid.filter_again() == {"FINISHED"}
