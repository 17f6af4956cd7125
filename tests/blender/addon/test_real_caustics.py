# SPDX-License-Identifier: GPL-3.0-or-later
"""Caustics by F12 on the compiled engine: a glass ball under a lamp without size, which path tracing cannot see."""

from __future__ import annotations

import json
import sys

import bpy
import conftest
import numpy as np
import pictures
import pytest
from test_real_engine import combined, scene, stop_after  # noqa: F401  (scene is a fixture)

pytestmark = conftest.needs_engine

CLASSES = ("D1", "D2", "D3", "C1", "C2")


def glass_ball() -> None:
    """Factory camera and a lamp without size as the only light; the cube gives way to a floor with a glass ball."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    bpy.ops.mesh.primitive_plane_add(size=20)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1, location=(0, 0, 1.1))
    bpy.ops.object.shade_smooth()
    material = bpy.data.materials.new("Glass")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output, glass = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfGlass")
    links.new(glass.outputs[0], output.inputs["Surface"])
    glass.inputs["Roughness"].default_value = 0
    bpy.context.object.data.materials.append(material)
    bpy.data.objects["Light"].data.shadow_soft_size = 0
    background = next(node for node in bpy.context.scene.world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Strength"].default_value = 0


@pytest.fixture
def ball(scene):  # noqa: F811
    """The glass ball, with every class as a pass and without clamping."""
    glass_ball()
    for name in CLASSES:
        setattr(bpy.context.view_layer.cardioid, f"use_pass_{name.lower()}", True)
    scene.cardioid.clamp = 0
    scene.cardioid.samples = 16
    return scene


def classes(channels) -> dict[str, np.ndarray]:
    return {name: combined(channels, name=f"Cardioid {name}") for name in CLASSES}


def test_photons_are_the_default(ball):
    assert ball.cardioid.integrator == "PTPPM"


def test_caustics_of_a_lamp_without_size(ball, render):
    found = {}
    for mode in ("PTPPM", "SPPM", "PT"):
        ball.cardioid.integrator = mode
        found[mode] = classes(render(mode))["C1"]
        assert np.isfinite(found[mode]).all() and found[mode].min() >= 0
    assert found["PTPPM"].mean() > 0.005 and found["PTPPM"].max() > 0.5
    assert found["SPPM"].mean() == pytest.approx(found["PTPPM"].mean(), rel=0.1)
    assert found["PT"].max() == 0


@pytest.mark.parametrize("mode", ["PTPPM", "SPPM", "PT"])
def test_classes_sum_to_the_picture(ball, render, mode):
    ball.cardioid.integrator = mode
    channels = render()
    np.testing.assert_allclose(sum(classes(channels).values()), combined(channels), rtol=1e-4, atol=1e-5)
    assert np.isfinite(combined(channels)).all()


def test_indirect_caustics_by_choice(ball, render):
    """Off leaves C2 dark and the rest as it is; photons and path tracing agree."""
    found = {}
    # C2 is a thousandth of the picture: many photons, or chance decides.
    ball.cardioid.samples, ball.cardioid.photons = 1024, 6000
    for choice in ("PHOTONS", "PATH_TRACING", "OFF"):
        ball.cardioid.indirect_caustics = choice
        found[choice] = {name: part.mean() for name, part in classes(render(choice)).items()}
    assert found["OFF"].pop("C2") == 0 < found["PHOTONS"]["C2"]
    assert found["PATH_TRACING"].pop("C2") == pytest.approx(found["PHOTONS"].pop("C2"), rel=0.25)
    for other in ("PATH_TRACING", "OFF"):
        assert found[other] == pytest.approx(found["PHOTONS"], rel=0.03, abs=1e-4)


def test_same_bits_with_one_and_two_threads(ball, render):
    ball.cardioid.threads = 1
    one = combined(render("one"))
    ball.cardioid.threads = 2
    np.testing.assert_array_equal(one, combined(render("two")))


def animation(scene, folder) -> list[np.ndarray]:  # noqa: F811
    scene.frame_start, scene.frame_end = 1, 2
    pictures.set_exr(scene, True)
    scene.render.filepath = str(folder / "frame_####")
    bpy.ops.render.render(animation=True)
    return [combined(pictures.read(path)) for path in sorted(folder.glob("frame_*.exr"))]


def test_a_still_animation_has_the_same_bits(ball, tmp_path):
    first, second = animation(ball, tmp_path)
    np.testing.assert_array_equal(first, second)


def test_an_animated_seed_changes_the_noise_alone(ball, tmp_path):
    ball.cardioid.use_animated_seed = True
    first, second = animation(ball, tmp_path)
    assert not np.array_equal(first, second)
    assert first.mean() == pytest.approx(second.mean(), rel=0.03)


def test_photons_in_statistics_and_metadata(ball, render, monkeypatch, tmp_path, capfd):
    path = tmp_path / "stats.json"
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-stats", str(path), "--cardioid-print-stats"])
    render("stamped")
    told = json.loads(path.read_text())["renders"][-1]["engine"]
    photons = told["photons"]
    assert photons["passes"] > 0 and photons["gathered"] > 0 and 0 < photons["stored"] < photons["emitted"]
    assert {"photon_trace", "photon_index", "camera"} <= set(told["seconds"])
    stamped = pictures.metadata(tmp_path / "stamped.exr")
    for name in ("passes", "emitted", "stored", "gathered"):
        assert stamped[f"cardioid.ViewLayer.photons.{name}"] == str(photons[name])
    table = capfd.readouterr().out
    assert "Photons stored" in table and f"{photons['stored']:,}".replace(",", " ") in table


def test_nothing_to_catch_nothing_to_pay(scene, render, monkeypatch, tmp_path):  # noqa: F811
    """The factory cube is too rough for caustics: no photon leaves."""
    path = tmp_path / "stats.json"
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-stats", str(path)])
    render()
    photons = json.loads(path.read_text())["renders"][-1]["engine"]["photons"]
    assert photons["emitted"] == 0 and photons["skipped_passes"] > 0


def test_photon_counts_from_the_command_line(ball, render, monkeypatch, tmp_path):
    path = tmp_path / "stats.json"
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-stats", str(path), "--cardioid-photons", "1000"])
    render()
    told = json.loads(path.read_text())["renders"][-1]
    assert told["settings"]["photons"] == 1000 and told["engine"]["photons"]["per_sample"] == 1000


@pytest.mark.parametrize("mode", ["PTPPM", "SPPM"])
def test_esc_within_a_quarter_second(ball, monkeypatch, tmp_path, mode):
    """Also while photons fly. The best of three: other processes can only delay it."""
    ball.cardioid.integrator = mode
    ball.render.resolution_x, ball.render.resolution_y = 1280, 720
    ball.cardioid.samples = 100000
    delays = []
    while len(delays) < 3 and not (delays and delays[-1] < 0.25):
        delay, picture = stop_after(1.0 + 0.6 * len(delays), monkeypatch, tmp_path / "stopped")
        delays.append(delay)
        assert np.isfinite(picture["R"]).all()
    assert min(delays) < 0.25, delays


def test_photons_that_do_not_fit_memory_are_refused(ball):
    ball.cardioid.photons, ball.cardioid.memory_limit, ball.cardioid.samples = 20_000_000, 256, 1
    with pytest.raises(RuntimeError, match=r"needs about [\d.]+ GB.*photons.*memory limit is [\d.]+ GB"):
        bpy.ops.render.render()
