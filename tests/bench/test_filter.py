# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of filtered pictures on pictures whose errors are known, and the film reader on a film made here."""

import json
import struct

import numpy as np
import pytest

from bench import film_reader, quality, regions

SIZE = (96, 96)


def checker(size=SIZE, cell: int = 3) -> np.ndarray:
    """0.2 and 0.6 in squares."""
    y, x = np.indices(size)
    return np.where((x // cell + y // cell) % 2, 0.6, 0.2)


def rgb(values: np.ndarray) -> np.ndarray:
    return np.repeat(values[..., None], 3, -1)


def flat_surface(albedo: np.ndarray) -> regions.Surface:
    normal = np.zeros((*albedo.shape, 3))
    normal[..., 2] = 1.0
    return regions.Surface(rgb(albedo), normal, np.full(albedo.shape, 4.0))


def referee(picture: np.ndarray, noise: float = 0.0, parts: int = 4, **masks) -> quality.Referee:
    stack = picture + noise * np.random.default_rng(3).normal(size=(parts, *picture.shape))
    everywhere = np.ones(picture.shape[:2], bool)
    return quality.Referee(stack, {"texture": everywhere, "light edges": everywhere} | masks)


def test_blur_keeps_constants_and_sums():
    assert regions.blur(np.full((20, 30), 0.7), 2.0) == pytest.approx(0.7)
    spot = np.zeros((41, 41))
    spot[20, 20] = 1.0
    spread = regions.blur(spot, 2.0)
    assert spread.sum() == pytest.approx(1.0)
    assert spread[20, 20] == pytest.approx(1 / (2 * np.pi * 4), rel=0.02)


def test_grown_masks_reach_as_far_as_asked():
    mask = np.zeros((20, 20), bool)
    mask[10, 10] = True
    assert regions.grown(mask, 3).sum() == 49
    mask = np.zeros((20, 20), bool)
    mask[0, 19] = True
    assert regions.grown(mask, 3).sum() == 16


def test_texture_is_found_where_the_albedo_varies_alone():
    albedo = np.full(SIZE, 0.5)
    albedo[:, 48:] = checker((96, 48))
    light = rgb(albedo)
    found = regions.regions((light, light), flat_surface(albedo))
    assert found["texture"][10:-10, 60:90].all()
    assert not found["texture"][:, :30].any()
    assert not found["light edges"][:, :40].any()


def test_edges_of_light_are_found_by_colour_and_not_by_noise():
    albedo = np.full(SIZE, 0.5)
    light = rgb(np.full(SIZE, 0.5))
    light[:, 48:, 2] = 0.1
    noise = np.random.default_rng(1).normal(size=(2, *light.shape)) * 0.1
    found = regions.regions((light + noise[0], light + noise[1]), flat_surface(albedo))
    assert found["light edges"][:, 46:50].all()
    assert found["light edges"][:, :36].mean() < 0.1
    assert not found["texture"].any()


def test_objects_edges_belong_to_no_region():
    surface = flat_surface(np.where(np.arange(96) < 48, 0.2, 0.6) * np.ones(SIZE))
    surface.depth[:, 48:] = 8.0
    found = regions.regions((surface.albedo, surface.albedo), surface)
    assert not found["texture"].any()
    assert not found["light edges"].any()


def test_the_references_noise_is_taken_off():
    truth = rgb(np.full(SIZE, 0.5))
    judged = referee(truth, 0.05)
    offset = quality.evaluate(truth + 0.05, judged)
    assert offset["reference"] > 7e-4
    assert offset["relmse"] == pytest.approx(0.05**2 / (0.25 + 0.01), abs=3e-4)
    assert offset["light_edges"] == pytest.approx(offset["relmse"])


def test_texture_kept_is_one_for_the_truth_whatever_the_references_noise():
    truth = rgb(checker())
    for noise in (0.0, 0.1):
        judged = referee(truth, noise)
        mask = judged.masks["texture"]
        assert quality.texture_kept(truth, judged, mask) == pytest.approx(1.0, abs=0.01)
        assert quality.texture_kept(2 * truth, judged, mask) == pytest.approx(1.0, abs=0.01)


def test_noise_and_lost_texture_both_lower_what_is_kept():
    truth = rgb(checker())
    judged = referee(truth)
    mask = judged.masks["texture"]
    noisy = truth + 0.2 * np.random.default_rng(5).normal(size=(*SIZE, 1))
    fine = np.std(quality.high_pass(truth, np.float64(0.4))[mask])
    grain = np.std(quality.high_pass(noisy - truth, np.float64(0.4))[mask])
    expected = fine / np.hypot(fine, grain)
    assert quality.texture_kept(noisy, judged, mask) == pytest.approx(expected, abs=0.02)
    smeared = np.full(SIZE, 0.4)
    smeared[:, :48] = truth[:, :48, 0]
    assert quality.texture_kept(rgb(smeared), judged, mask) == pytest.approx(np.sqrt(0.5), abs=0.03)


def test_fireflies_are_pixels_far_above_everything_near_in_the_reference():
    reference = rgb(np.full(SIZE, 0.5))
    reference[20:30, 20:30] = 4.0
    picture = reference.copy()
    picture[50, 50] = 3.0
    picture[31, 31] = 3.9
    picture[60, 60] = 0.7
    assert quality.fireflies(picture, reference) == 1
    assert quality.fireflies(reference, reference) == 0


def test_small_regions_are_not_judged():
    few = np.zeros(SIZE, bool)
    few[:3] = True
    got = quality.evaluate(rgb(checker()), referee(rgb(checker()), texture=few))
    assert "texture_kept" not in got
    assert "light_edges" in got


def film_bytes(width: int = 10, height: int = 9) -> bytes:
    """A film whose pixel (9, 8) alone has clusters: two of direct light, one of deep light."""
    contents = {"region": [0, 0, width, height], "clusters": True, "photons": False}
    text = json.dumps(contents).encode()
    text += b" " * (-len(text) % 16)
    pixels = np.zeros((height, width), film_reader.PIXEL)
    pixels["samples"] = 4
    pixels["detail"][0, 0] = (2.0, 1.0, 0.4)
    counts = np.zeros((4, 192), np.uint8)
    place = (8 % 8 * 8 + 9 % 8) * 3
    counts[3, place], counts[3, place + 2] = 2, 1
    clusters = np.zeros(3, film_reader.CLUSTER)
    clusters["radiance"][:, 0] = (1.0, 3.0, 8.0)
    clusters["min"], clusters["max"], clusters["samples"] = (0.1, 1.0, 5.0), (0.2, 2.0, 6.0), (1, 2, 1)
    data = film_reader.HEADER.pack(film_reader.MAGIC, 1, 0, len(text), 3) + text
    data += pixels.tobytes() + counts.tobytes() + clusters.tobytes()
    return data + struct.pack("<Q", film_reader.checksum(data))


def test_a_film_is_read_pixel_by_pixel(tmp_path):
    path = tmp_path / "a.cardioid"
    path.write_bytes(film_bytes())
    film = film_reader.read(path)
    assert film.shape == (9, 10)
    assert film.of_pixel(9, 8, 0)["max"].tolist() == pytest.approx([0.2, 2.0])
    assert film.of_pixel(9, 8, 2)["samples"].tolist() == [1]
    assert len(film.of_pixel(9, 8, 1)) == len(film.of_pixel(0, 0, 0)) == 0
    assert film.layer(0)[0, 9].tolist() == [1.0, 0.0, 0.0]
    assert film.layer(0).sum() == 1.0
    assert film.detail()[-1, 0] == pytest.approx([0.5, 0.25, 0.1])


def test_a_film_of_one_layer_keeps_the_rest(tmp_path):
    (tmp_path / "a.cardioid").write_bytes(film_bytes())
    film_reader.read(tmp_path / "a.cardioid").only(2, tmp_path / "b.cardioid")
    film = film_reader.read(tmp_path / "b.cardioid")
    assert film.layer(2)[0, 9, 0] == 2.0
    assert not film.layer(0).any()
    assert film.detail()[-1, 0] == pytest.approx([0.5, 0.25, 0.1])


def test_pixels_of_another_layout_are_refused(tmp_path):
    path = tmp_path / "a.cardioid"
    path.write_bytes(film_bytes().replace(b'"photons": false', b'"photons": true '))
    with pytest.raises(ValueError, match="another layout"):
        film_reader.read(path)


def test_other_files_are_refused(tmp_path):
    path = tmp_path / "a.cardioid"
    path.write_bytes(b"CARDSCN\n" + bytes(100))
    with pytest.raises(ValueError, match="no film file"):
        film_reader.read(path)
