# SPDX-License-Identifier: GPL-3.0-or-later
"""The checks on path classes, on made-up pictures: what they let through and what they catch."""

import numpy as np
import pytest

from bench import class_figures, class_rows, class_verdicts, classes, film_reader, pictures

SIZE = (40, 50, 3)
MEANS = {"D1": 0.1, "D2": 0.4, "D3": 0.2, "C1": 0.1, "C2": 0.05}


def planes(seed, noise=0.01, **scaled):
    rng = np.random.default_rng(seed)
    made = {
        name: (mean * scaled.get(name, 1.0) + noise * rng.standard_normal(SIZE)).astype(np.float32)
        for name, mean in MEANS.items()
    }
    return made | {"Combined": sum(made.values())}


def picture(seed, method="PTPPM", **scaled):
    made = planes(seed, **scaled)
    part = {"PT": 0.0 * made["C1"], "PTPPM": 0.9 * made["C1"], "SPPM": made["Combined"] - made["D1"]}[method]
    return classes.Pictures(made, 2.0, 16, part)


def scene(**scaled):
    made = classes.Scene("s")
    for method in classes.METHODS:
        made.methods[method] = [picture(seed, method, **(scaled if method == "PTPPM" else {})) for seed in (1, 2)]
    made.long = [picture(seed, "PT") for seed in (11, 12)]
    return made


def test_a_sum_that_is_off_by_more_than_rounding_is_caught():
    made = scene()
    assert class_verdicts.sums([made]).holds
    made.methods["SPPM"][1].planes["Combined"][3, 4, 0] *= 1.0 + 2.0**-18
    assert not class_verdicts.sums([made]).holds


@pytest.mark.parametrize("method", classes.METHODS)
def test_light_of_the_wrong_estimator_is_caught(method):
    made = scene()
    for one in made.methods.values():
        np.maximum(one[0].planes["C1"], 0.0, out=one[0].planes["C1"])
    assert class_verdicts.owners([made]).holds
    made.methods[method][0].photons[5, 6] += 0.2
    verdict = class_verdicts.owners([made])
    assert not verdict.holds and method in verdict.figures


def test_ownership_is_not_claimed_without_films():
    made = scene()
    for found in made.methods.values():
        found[0].photons = None
    assert class_verdicts.owners([made]).holds is None


def test_missing_light_of_one_class_is_caught_and_noise_is_not():
    assert class_verdicts.energy(scene(), "PTPPM").holds
    verdict = class_verdicts.energy(scene(C2=0.95), "PTPPM")
    assert not verdict.holds and "C2 0.9" in verdict.figures and verdict.figures.count("(off)") == 1


def test_rows_hold_shares_of_light_and_of_error():
    rows = {(row["method"], row["class"]): row for row in class_rows.of_scene(scene())}
    assert sum(rows["PT", name]["share"] for name in MEANS) == pytest.approx(1.0, abs=1e-5)
    assert sum(rows["PTPPM", name]["noise_share"] for name in MEANS) == pytest.approx(1.0)
    assert rows["PT", "D2"]["share"] == pytest.approx(0.4 / 0.85, rel=0.02)
    assert rows["PT", "D2"]["noise"] == pytest.approx(0.01**2 / 3 / (0.85**2 + 0.01), rel=0.1)
    assert rows["PTPPM", "C1"]["photons"] == pytest.approx(0.9, rel=1e-3)
    assert (rows["SPPM", "D1"]["photons"], rows["SPPM", "D3"]["photons"]) == (0.0, 1.0)


def test_every_class_has_an_estimator_in_every_method():
    for owners in class_rows.OWNERS.values():
        assert tuple(owners) == class_rows.CLASSES == class_verdicts.CLASSES


def test_the_photons_part_is_what_no_layer_holds_without_emission():
    pixels = np.zeros((2, 1), film_reader.PIXEL)
    pixels["samples"], pixels["unfiltered"] = 4, [[[4.0, 8.0, 12.0]], [[0.0, 0.0, 4.0]]]
    film = film_reader.FilmFile({}, pixels, b"", np.zeros((1, 192), np.uint8), np.zeros(0, film_reader.CLUSTER))
    part = classes.photon_part(film, np.full((2, 1, 3), 0.5, np.float32))
    assert part[:, 0].tolist() == [[-0.5, -0.5, 0.5], [0.5, 1.5, 2.5]]


def test_dim_classes_are_shown_brighter_by_powers_of_two():
    assert class_figures.gain(np.full((4, 4, 3), 0.05), 1.0) == 8
    assert class_figures.gain(np.full((4, 4, 3), 2.0), 1.0) == 1
    assert class_figures.gain(np.zeros((4, 4, 3)), 1.0) == 1


def test_the_shoulder_keeps_order_and_leaves_the_rest_alone():
    ramp = np.repeat(np.linspace(0.0, 3.0, 200)[:, None, None], 3, -1)
    shown = pictures.display(ramp, 1.0)[:, 0, 0]
    assert shown[0] == 0.0 and shown[-1] <= 1.0 and (np.diff(shown) >= 0.0).all()
    below = ramp[:, 0, 0] < pictures.SHOULDER
    assert shown[below][20] == pytest.approx(1.055 * ramp[20, 0, 0] ** (1 / 2.4) - 0.055, rel=1e-5)
    assert pictures.display(np.full((1, 1, 3), 1.0), 1.0)[0, 0, 0] < 1.0
