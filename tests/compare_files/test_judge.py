# SPDX-License-Identifier: GPL-3.0-or-later
"""The bounds: equal pictures pass, a shift beyond the bound fails in the figure that it touches, noise is told."""

import sys
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render")]

import census  # noqa: E402
import judge  # noqa: E402


def pictures(seed: int, scatter: float = 0.01, seeds: int = 3, color=(0.8, 0.4, 0.2)) -> np.ndarray:
    rng = np.random.default_rng(seed)
    noise = 1.0 + scatter * rng.standard_normal((seeds, 40, 48, 1))
    return np.concatenate([np.array(color) * noise, np.ones((seeds, 40, 48, 1))], axis=-1).astype(np.float32)


def test_equal_pictures_pass():
    assert judge.judge(pictures(1), pictures(2)).verdict == "pass"


@pytest.mark.parametrize(("channel", "name"), [(0, "R"), (1, "G"), (2, "B"), (3, "A")])
def test_one_channel_off_by_four_per_cent_fails(channel, name):
    ours = pictures(1)
    ours[..., channel] *= 1.04
    judged = judge.judge(ours, pictures(2))
    assert judged.verdict == "fail"
    assert [n for n, f in judged.means.items() if f.verdict == "fail"] == [name]


def test_blocks_fail_where_means_agree():
    ours = pictures(1)
    ours[:, :, :24, :3] *= 1.08
    ours[:, :, 24:, :3] *= 0.92
    judged = judge.judge(ours, pictures(2))
    assert judged.block.verdict == "fail"
    assert all(f.verdict == "pass" for f in judged.means.values())


def test_a_nearly_black_channel_is_measured_against_the_brightest():
    ours, reference = pictures(1, color=(1.0, 1.0, 0.01)), pictures(2, color=(1.0, 1.0, 0.01))
    ours[..., 2] *= 2.0
    assert judge.judge(ours, reference).means["B"].value == pytest.approx(0.01, rel=0.05)


def test_noise_is_told_and_is_no_pass():
    rng = np.random.default_rng(3)
    ours, reference = (np.ones((3, 40, 48, 4), np.float32) for _ in range(2))
    for images in (ours, reference):
        images *= rng.normal(1.0, 0.1, (3, 1, 1, 1)).astype(np.float32)
    ours[..., :3] *= 1.0 + 0.05 - float(ours[..., 0].mean() / reference[..., 0].mean() - 1.0)
    assert judge.judge(ours, reference).means["R"].verdict == "noise"


def test_broken_pictures_fail():
    ours = pictures(1)
    ours[0, 3, 3, 0] = np.nan
    assert judge.judge(ours, pictures(2)).problem == "not finite"
    assert judge.judge(np.zeros_like(ours), pictures(2)).problem == "black picture"
    assert "sizes differ" in judge.judge(pictures(1)[:, 1:], pictures(2)).problem


def test_cells_are_found_by_rows_from_the_top():
    ours, reference = pictures(1, color=(1, 1, 1)), pictures(2, color=(1, 1, 1))
    ours[:, 24:, 24:, :3] *= 1.5  # rows count from the bottom: this is the upper right
    judged = judge.cells(ours[:, :, :48], reference[:, :, :48], ["a", "b"], 24)
    assert [judged[n].verdict for n in "ab"] == ["pass", "fail"]


def test_shares_count_instances():
    known = {"A": "same", "B": "approximated"}
    assert census.shares({"A": 6, "B": 3, "C": 1}, known) == (10, 9, 6, {"C": 1})
