# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves, verdicts and bars of the caustic benchmarks, on programs that only pretend to render."""

import dataclasses

import numpy as np
import pytest

from bench import (
    choices,
    convergence,
    exr,
    guided,
    peer_scenes,
    photons,
    runs,
    thesis,
    verdicts,
)
from bench.engines import Job


def test_the_picture_is_never_one_of_its_passes():
    plain = ["A", "B", "C1.B", "C1.G", "C1.R", "Depth.Z", "G", "R"]
    assert [exr.channel(plain, "", c) for c in "RGB"] == ["R", "G", "B"]
    assert exr.channel(plain, "C1", "G") == "C1.G"
    layered = ["ViewLayer.C1.R", "ViewLayer.Combined.R"]
    assert exr.channel(layered, "", "R") == "ViewLayer.Combined.R"
    assert exr.channel(layered, "C1", "R") == "ViewLayer.C1.R"
    with pytest.raises(KeyError):
        exr.channel(["C1.R"], "", "R")


def test_samples_come_in_whole_passes():
    pace = runs.Pace(first=1.0, each=0.05)
    assert pace.samples(0.5) == 8
    assert pace.samples(5.0) == 88
    assert pace.repeated(trains=True) == 1.0
    assert pace.repeated(trains=False) == pytest.approx(0.6)


def test_a_part_that_would_overshoot_is_left_out():
    pace = runs.Pace(1.0, 0.5)
    assert convergence.next_part(0, 0.0, 4.0, pace) == 16
    assert convergence.next_part(16, 4.5, 5.0, pace) == 0
    assert convergence.next_part(16, 4.5, 8.5, pace) == 8


class Clock:
    """Start-up 0.5 s, 0.25 s a sample; a sample's picture is its number. Trains, if at all, for 8 samples."""

    key = "clock"

    def __init__(self, training: bool):
        self.training = training

    def stamp(self):
        return "stamp"

    def measured(self, records, cache, engine, job, kind="run"):
        first = next((int(s.split("=")[1]) for s in job.settings if s.startswith("first_sample")), 0)
        again = min(first, 8) if self.training else 0
        numbers = range(first, first + job.samples)
        path = cache / f"{kind}-{first}-{job.samples}-{job.seed}.npy"
        np.save(path, np.full((4, 4, 3), np.mean(numbers)))
        photons_stats = {"training_passes": 4 if self.training else 0}
        return {"cpu": 0.5 + 0.25 * (again + job.samples), "path": str(path), "stats": {"photons": photons_stats}}


@pytest.mark.parametrize("training", (True, False))
def test_a_curve_is_one_long_render_whose_repetitions_do_not_count(tmp_path, monkeypatch, training):
    clock = Clock(training)
    monkeypatch.setattr(runs, "measured", clock.measured)
    monkeypatch.setattr(convergence.exr, "load", lambda path: np.load(path))
    mask = np.ones((4, 4), bool)
    scene = peer_scenes.PeerScene("s", tmp_path / "s.blend", np.ones((4, 4, 3)), {"all": mask}, {"all": 0.0})
    points = convergence.curve(None, tmp_path, clock, scene, (), 1, [4.5, 8.5, 16.5], 2)
    for point in points:
        assert point["cpu"] == pytest.approx(0.5 + 0.25 * point["samples"])
        # the mean of the numbers 0 … n-1, whatever the parts were
        assert point["picture"].mean() == pytest.approx((point["samples"] - 1) / 2)
    assert [point["samples"] for point in points] == [16, 32, 64]


def row(method, mark, rmse, cpu=None, **more):
    figures = {"relmse": rmse * rmse, "energy": 1.0, "reference": 0.0}
    return {"scene": "s", "mark": mark, "method": method, "rmse": rmse, "cpu": cpu or mark} | figures | more


def test_ours_is_judged_against_the_best_of_the_others():
    rows = [row("PT", 4.0, 0.2), row("SPPM", 4.0, 0.1), row("PTPPM", 4.0, 0.105)]
    assert verdicts.judge(rows) == [
        {"scene": "s", "mark": 4.0, "ratio": pytest.approx(1.05), "best": "SPPM", "word": "tie"}
    ]
    rows[2]["rmse"] = 0.12
    assert verdicts.judge(rows)[0]["word"] == "over"
    assert "1 of 1 over" in verdicts.said(verdicts.judge(rows))
    rows[2]["rmse"] = 0.09
    assert verdicts.judge(rows)[0]["word"] == "under"


def test_a_mark_that_was_met_roughly_is_brought_to_our_time():
    rows = [row("SPPM", 4.0, 0.1, cpu=1.0), row("PTPPM", 4.0, 0.06, cpu=4.0)]
    # at four times the time SPPM would have had at best half of its error
    assert verdicts.judge(rows)[0]["word"] == "over"


def test_a_wrong_energy_and_a_noisy_reference_are_named():
    rows = [row("PTPPM", 4.0, 0.1, energy=0.98, reference=0.4), row("PT", 4.0, 0.2, reference=0.02)]
    assert any("-2.00%" in note for note in verdicts.notes(rows))
    assert not verdicts.energies(rows).holds
    (verdict,) = verdicts.references(rows)
    assert not verdict.holds and "40.0%" in verdict.figures and "1 of 2 rows" in verdict.figures


@pytest.mark.parametrize(("ours", "scenes", "holds"), ((0.09, "s", True), (0.2, "s", False), (0.09, "st", None)))
def test_lowest_at_all_times_is_told_of_all_scenes_alone(ours, scenes, holds):
    rows = [row("PT", 4.0, 0.2), row("SPPM", 4.0, 0.1), row("PTPPM", 4.0, ours)]
    found = verdicts.lowest(rows, tuple(scenes))
    assert [verdict.holds for verdict in found if "all three" in verdict.claim] == [holds, holds]
    assert found[0].holds == (ours < 0.1)


def test_the_scatter_of_seeds_is_the_noise_of_one_picture():
    rng = np.random.default_rng(3)
    pictures = [1.0 + 0.1 * rng.standard_normal((80, 80, 3)) for _ in range(3)]
    mask = np.ones((80, 80), bool)
    assert peer_scenes.noise(pictures, mask) == pytest.approx(0.1, rel=0.03)
    assert peer_scenes.noise(pictures[:1], mask) is None


def test_stage_shares_add_up():
    seconds = {"build": 1.0, "camera": 6.0, "photon_trace": 2.0, "photon_index": 0.5, "photon_learn": 0.5, "tree": 0.9}
    counts = {"passes": 3, "emitted": 1000, "stored": 100, "gathered": 5000}
    made = photons.stage_row(
        "s",
        "PTPPM",
        {"cpu": 20.0, "stats": {"photons": counts, "seconds": seconds, "samples": 16, "bytes": {"photons": 3e6}}},
    )
    assert sum(made[stage] for stage in photons.STAGES) == pytest.approx(1.0)
    assert made["stored_of_emitted"] == pytest.approx(0.1)
    assert made["gathered_per_s"] == pytest.approx(250.0)


def test_the_thesis_figures_agree_with_each_other():
    for name, table in thesis.TABLE_5_1.items():
        assert table["deposited"] / table["emitted"] == pytest.approx(table["share"], rel=0.02)
        for method in runs.METHODS:
            assert sum(thesis.shares(name, method).values()) == pytest.approx(1.0)


def guided_rows(gathered, error, cpu):
    base = {"scene": "s", "cpu": 10.0, "relmse_trim": 0.1, "relmse_C1_trim": 0.1, "gathered_per_emitted": 0.1}
    on = base | {"cpu": cpu, "relmse_trim": error, "relmse_C1_trim": error, "gathered_per_emitted": gathered}
    return [
        base | {"photons": "half", "guided": "no"},
        base | {"photons": "auto", "guided": "no"},
        on | {"photons": "half", "guided": "yes"},
        on | {"photons": "auto", "guided": "yes"},
    ]


def test_guided_emission_is_judged_by_photons_and_by_time():
    good = guided.judge(guided_rows(1.0, 0.05, 12.0))
    assert [verdict.holds for verdict in good] == [True, True, True]
    assert "10.0 times" in good[0].figures and "0.60 to the same relmse_trim" in good[1].figures
    slow = guided.judge(guided_rows(0.4, 0.1, 12.0))
    assert [verdict.holds for verdict in slow] == [False, False, True]
    assert "1.20 to the same relmse_trim" in slow[1].figures
    assert guided.judge(guided_rows(1.0, 0.05, 12.0)[:2])[0].holds is None


def test_the_references_own_error_is_taken_off(tmp_path, monkeypatch):
    rng = np.random.default_rng(5)
    noisy = lambda: 0.5 + 0.1 * np.repeat(rng.standard_normal((90, 90, 1)), 3, axis=-1)  # noqa: E731
    parts = np.array([noisy() for _ in range(8)])
    made = guided.truth(parts, parts - 0.25, np.ones((90, 90), bool))
    image = noisy()
    monkeypatch.setattr(guided.exr, "load", lambda path, layer="": image - 0.25 if layer else image)
    counts = {"emitted": 100, "gathered": 250}
    got = made.evaluate({"path": "", "cpu": 1.0, "stats": {"photons": counts, "samples": 8}})
    for name in ("relmse", "relmse_caustic", "relmse_C1"):
        assert got[name] == pytest.approx(0.01 / 0.26, rel=0.06)
    assert got["reference"] == pytest.approx(1 / 9, rel=0.1)
    assert got["gathered_per_emitted"] == 2.5


def test_guided_and_unguided_differ_in_nothing_else():
    found = guided.variants(dataclasses.make_dataclass("S", ["width"])(256))
    assert found["half", "yes"][0] == found["half", "no"][0]
    assert found["half", "yes"][2:] == found["half", "no"][2:] == ("photons=20480",)


def test_a_choice_costs_error_times_time():
    rows = [
        {"scene": "cornell_sky", "choice": "default", "relmse": 0.1, "relmse_caustic": 0.2, "cpu": 10.0, "energy": 1.0},
        {"scene": "cornell_sky", "choice": "PT", "relmse": 0.1, "relmse_caustic": 0.2, "cpu": 5.0, "energy": 1.0},
    ]
    choices.relative(rows)
    assert rows[1]["cost"] == pytest.approx(0.5)
    (verdict,) = choices.judge(rows)
    assert not verdict.holds and verdict.figures == "relMSE · CPU s 2.00 of PT's"


def test_runs_of_other_settings_are_other_runs(tmp_path):
    blend = tmp_path / "a.blend"
    blend.touch()
    job = Job(str(blend), "", 8, 1, settings=("integrator=hybrid",))
    keys = {
        runs.identity("run", Clock(True), one)
        for one in (job, dataclasses.replace(job, settings=("a=b",)), dataclasses.replace(job, seed=2))
    }
    assert len(keys) == 3
