# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept references: what comes back, whose they are, and how good they say they are."""

from __future__ import annotations

import json

import numpy as np
import pytest

from bench import references

pytest.importorskip("OpenEXR")
SIGMA = 0.05


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "ring.blend"
    path.write_bytes(b"a ring")
    return path


def pictures(count: int = 8) -> np.ndarray:
    rng = np.random.default_rng(7)
    truth = np.linspace(0.2, 2.0, 64)[None, :, None] * np.ones((64, 64, 3))
    return truth + SIGMA * rng.standard_normal((count, 64, 64, 1))


def test_a_reference_comes_back_with_its_halves_and_error(tmp_path, scene):
    made = pictures()
    references.save("ring", made, scene, "test", 800, folder=tmp_path)
    kept = references.load("ring", references.digest(scene), folder=tmp_path)
    assert kept.mean == pytest.approx(made.mean(0), rel=1e-3)
    assert kept.about.samples == 800 and kept.about.size == (64, 64)
    assert kept.error["mse"] == pytest.approx(SIGMA**2 / 8, rel=0.1)
    from_halves = references.metrics.reference_error(kept.parts)
    assert from_halves["relmse"] == pytest.approx(kept.error["relmse"], rel=0.1)


def test_another_scene_is_refused_in_one_sentence(tmp_path, scene):
    references.save("ring", pictures(2), scene, "test", 8, folder=tmp_path)
    scene.write_bytes(b"another ring")
    with pytest.raises(references.Refused, match=r"ring\.exr is of another scene") as refused:
        references.load("ring", references.digest(scene), folder=tmp_path)
    assert "\n" not in str(refused.value)


def test_another_size_is_refused(tmp_path, scene):
    references.save("ring", pictures(2), scene, "test", 8, folder=tmp_path)
    with pytest.raises(references.Refused, match="64 pixels wide, not 256"):
        references.load("ring", references.digest(scene), width=256, folder=tmp_path)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"format": 1, "size": [1, 2], "colour": 3}'])
def test_broken_files_are_refused(tmp_path, scene, text):
    (tmp_path / "ring.json").write_text(text)
    with pytest.raises(references.Refused, match="cannot be read"):
        references.load("ring", references.digest(scene), folder=tmp_path)


def test_a_torn_picture_is_refused(tmp_path, scene):
    references.save("ring", pictures(2), scene, "test", 8, folder=tmp_path)
    path = tmp_path / "ring.exr"
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(references.Refused, match="cannot be read"):
        references.load("ring", references.digest(scene), folder=tmp_path)


def test_a_missing_one_is_refused(tmp_path):
    with pytest.raises(references.Refused, match="there is no reference"):
        references.load("ring", "0" * 16, folder=tmp_path)


def test_halves_need_an_even_number():
    with pytest.raises(ValueError, match="even number"):
        references.halves(pictures(3))


def test_a_tenth_is_the_limit():
    assert references.good_enough(0.001, 0.02)[0]
    ok, words = references.good_enough(0.001, 0.005)
    assert not ok and "20.0%" in words
    assert not references.good_enough(0.001, 0.0)[0]


def test_the_repositorys_own_references_can_be_read():
    for path in references.FOLDER.glob("*.json"):
        about = json.loads(path.read_text())
        kept = references.load(path.stem, about["digest"])
        assert np.isfinite(kept.parts).all()
        assert path.with_suffix(".exr").stat().st_size <= 600_000, path
