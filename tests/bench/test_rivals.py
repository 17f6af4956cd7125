# SPDX-License-Identifier: GPL-3.0-or-later
"""The thesis's scenes as arrays, their references and masks; no renderer is needed."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest

from bench import exr, peer_scenes, references
from bench.rivals import masks, runner, scenes, shapes, stored

NAMES = list(scenes.ALL)


def volume(body: shapes.Body) -> float:
    """Signed: positive when the triangles look outwards."""
    a, b, c = np.moveaxis(body.vertices[body.triangles], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6)


def open_edges(body: shapes.Body) -> int:
    """Edges that are not run through once in each direction; positions count, not indices."""
    points = np.unique(np.round(body.vertices, 9), axis=0, return_inverse=True)[1].ravel()[body.triangles]
    edges = np.concatenate([points[:, (0, 1)], points[:, (1, 2)], points[:, (2, 0)]])
    there = {tuple(edge) for edge in edges.tolist()}
    return sum((b, a) not in there for a, b in there) + len(edges) - len(there)


def test_closed_bodies_are_closed_and_look_outwards():
    found = {
        "sphere": (shapes.sphere((1, 2, 3), 0.4), 4 / 3 * np.pi * 0.4**3),
        "torus": (shapes.torus((0, 0, 1), 0.35, 0.12), 2 * np.pi**2 * 0.35 * 0.12**2),
        "box": (shapes.box((1, 0, 0), (0.1, 0.2, 0.3), 25), 8 * 0.006),
        "band": (shapes.band(0.82, 0.9, 0.26), np.pi * (0.9**2 - 0.82**2) * 0.26),
    }
    for name, (body, expected) in found.items():
        assert open_edges(body) == 0, name
        assert volume(body) == pytest.approx(expected, rel=0.03), name


def test_normals_of_a_sphere_point_away_from_its_centre():
    body = shapes.sphere((1, 2, 3), 0.4, 3)
    outwards = (body.vertices - (1, 2, 3)) / 0.4
    assert (outwards * shapes.vertex_normals(body.vertices, body.triangles)).sum(1).min() > 0.999


def test_the_bands_flat_walls_have_flat_normals():
    body = shapes.band(0.82, 0.9, 0.26)
    outer = np.isclose(np.hypot(*body.vertices[:, :2].T), 0.9) & (np.abs(body.vertices[:, 2] - 0.132) < 0.1095)
    assert outer.any()
    assert np.abs(shapes.vertex_normals(body.vertices, body.triangles)[outer, 2]).max() < 0.02


def test_texture_cells_of_a_mesh_do_not_overlap():
    for name in NAMES:
        for mesh in scenes.ALL[name]().receivers():
            corners = mesh.body.uv[mesh.body.triangles]
            one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum() / 2
            assert 0 < area <= 1 + 1e-9, (name, mesh.name)
            assert corners.min() >= 0 and corners.max() <= 1


@pytest.mark.parametrize("name", NAMES)
def test_the_lamp_looks_at_the_scene_and_its_housing_is_behind(name):
    scene = scenes.ALL[name]()
    housing = next(mesh for mesh in scene.meshes if mesh.name == scenes.HOUSING)
    offset = housing.body.vertices.mean(0) - scene.lamp.centre
    assert offset @ scene.lamp.normal == pytest.approx(-scenes.HOUSING_GAP)
    things = [mesh.body.vertices.mean(0) for mesh in scene.meshes if mesh.body.smooth]
    assert all((thing - scene.lamp.centre) @ scene.lamp.normal > 0 for thing in things)
    assert scene.lamp.side == pytest.approx(2 * np.linalg.norm(scene.lamp.v))


def test_a_digest_changes_with_all_that_decides_the_picture():
    first = scenes.cornell().digest()
    assert first == scenes.cornell().digest()
    changed = [scenes.cornell() for _ in range(4)]
    changed[0].materials["glass"] = scenes.Material(scenes.GLASS, ior=1.45)
    changed[1].camera = dataclasses.replace(changed[1].camera, fov=40.0)
    changed[2].meshes[1].body.vertices[0, 2] += 1e-5
    changed[3].lamp = dataclasses.replace(changed[3].lamp, radiance=(40.0, 36.0, 31.0))
    assert len({first, *(scene.digest() for scene in changed)}) == 5
    scene = scenes.cornell()
    scene.meshes[1].body.vertices[0, 2] += 1e-12  # another processor's sine
    assert scene.digest() == first


def a_reference() -> stored.Stored:
    rng = np.random.default_rng(2)
    pixels = rng.random((8, 8, 3)).astype(np.float32)
    emit, caustic = rng.random((2, 8, 8)) < 0.3
    return stored.Stored(pixels, np.full((8, 8), 0.01), emit, caustic, {"cpu_seconds": 3})


def test_a_reference_comes_back(tmp_path):
    made = a_reference()
    stored.write(tmp_path, "ring", made)
    found = stored.read(tmp_path, "ring")
    assert found.pixels == pytest.approx(made.pixels, abs=1e-3)
    assert found.error == pytest.approx(made.error, rel=1e-3)
    assert (found.emit == made.emit).all() and (found.caustic == made.caustic).all()
    assert found.record["cpu_seconds"] == 3


def test_references_are_merged_by_their_errors():
    rng = np.random.default_rng(4)
    sigmas, truth, size = (0.1, 0.05), 0.5, (200, 200)
    nothing = np.zeros(size, bool)
    nothing[0] = True  # somewhere a caustic, so that it has an error
    counts = {"cpu_seconds": 10, "light_paths": 5, "camera_samples": 2}
    found = [
        stored.Stored(
            truth + sigma * rng.standard_normal((*size, 3)),
            np.full(size, sigma),
            ~nothing & nothing,
            nothing,
            counts | {"rmse": sigma, "seeds": [index], "made": "so"},
        )
        for index, sigma in enumerate(sigmas)
    ]
    made = stored.merged(*found)
    expected = (sum(sigma**-2 for sigma in sigmas)) ** -0.5
    assert np.sqrt(((made.pixels - truth) ** 2).mean()) == pytest.approx(expected, rel=0.02)
    assert made.record["rmse"] == pytest.approx(expected, rel=1e-3)
    assert made.record["cpu_seconds"] == 20 and made.record["seeds"] == [0, 1]


def test_a_reference_of_another_scene_is_refused_in_one_sentence(tmp_path):
    stored.write(tmp_path, "ring", a_reference())
    told = json.loads((tmp_path / "ring.json").read_text())
    (tmp_path / "ring.json").write_text(json.dumps(told | {"digest": "0" * 16}))
    with pytest.raises(references.Refused, match="belongs to another scene ring") as refused:
        stored.read(tmp_path, "ring")
    assert "\n" not in str(refused.value)
    with pytest.raises(SystemExit, match="belongs to another scene"):
        peer_scenes.load(tmp_path, "ring")


def test_a_folder_without_scenes_is_one_sentence(tmp_path):
    with pytest.raises(SystemExit, match="no reference of the scene cornell"):
        peer_scenes.load_all(tmp_path, ["cornell"])
    with pytest.raises(SystemExit, match="no scene house"):
        peer_scenes.load_all(tmp_path, ["house"])


@pytest.mark.parametrize("name", NAMES)
def test_the_repositorys_references_are_of_its_scenes(name):
    found = stored.read(stored.FOLDER, name)
    assert found.pixels.shape == (scenes.SIZE, scenes.SIZE, 3) and np.isfinite(found.pixels).all()
    assert not (found.emit & found.caustic).any()
    assert 500 < found.caustic.sum() < 10000 and 50 < found.emit.sum() < 1000
    assert (stored.FOLDER / f"{name}.exr").stat().st_size <= 600_000
    own = np.sqrt((found.error[~found.emit].astype(float) ** 2).mean())
    assert own == pytest.approx(found.record["rmse"], rel=0.02)
    assert own < 0.05 * found.pixels[~found.emit].mean()


def test_masks_know_the_lamp_with_a_border_and_caustics_by_majority():
    picture, caustics, lamp = (np.zeros((12, 12, 3)) for _ in range(3))
    picture[:] = 1.0
    lamp[2, 2] = 1.0
    caustics[6:10, 6:10] = 0.5
    caustics[3, 9] = 0.5
    emit, caustic = masks.of(picture, caustics, lamp)
    assert emit.sum() == 9 and emit[1:4, 1:4].all()
    assert caustic[7:9, 7:9].all() and not caustic[3, 9] and not (caustic & emit).any()


def test_a_runner_takes_samples_or_seconds():
    common = ["--mode", "path", "--out", "a.exr"]
    assert runner.arguments([*common, "--cpu", "3"], ("path",)).cpu == 3.0
    for words in (common, [*common, "--cpu", "3", "--samples", "4"], ["--mode", "none", "--out", "a.exr"]):
        with pytest.raises(SystemExit):
            runner.arguments(words, ("path",))


def test_a_runner_says_what_it_did_in_a_line(capsys):
    runner.Clock().report(12.5, "1.2")
    said = capsys.readouterr().out
    assert said.startswith("RESULT ") and json.loads(said[7:])["samples"] == 12.5


def test_a_picture_saved_is_a_picture_loaded(tmp_path):
    exr.save(tmp_path / "a.exr", a_reference().pixels)
    assert exr.load(tmp_path / "a.exr") == pytest.approx(a_reference().pixels)
