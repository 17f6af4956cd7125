# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on the filter, from rows whose outcome is known."""

from __future__ import annotations

import pytest

from bench import filter_methods, filter_verdicts


def rows(**of_ours) -> list[dict]:
    base = {"scene": "room", "samples": 16, "relmse": 0.01, "energy": 1.0, "of_raw": 1.0, "cpu": 4.0, "reference": 1e-4}
    base |= {"texture_kept": 0.99}
    found = [{"method": name} | base for name in ("raw", *filter_methods.FILTERS, "OIDN")]
    found.append({"method": "equal time"} | base | {"relmse": 0.05})
    for row in found:
        if row["method"].startswith("cross"):
            row["relmse"] = 0.02
        if row["method"] == "OIDN":
            row["relmse"] = 0.005
        if row["method"] == "clusters":
            row |= {"cpu": 5.0} | of_ours
    return found


def holds(found) -> dict[str, bool | None]:
    return {one.claim: one.holds for one in found}


def test_what_is_better_holds_and_what_oidn_wins_is_said():
    got = holds(filter_verdicts.all_of(rows(), [], []))
    assert got.pop("room: clusters have less error than OIDN") is False
    assert len(got) == 5 and all(got.values())


def test_a_higher_error_does_not_hold():
    got = holds(filter_verdicts.all_of(rows(relmse=0.06), [], []))
    assert got["room: clusters have less error than cross-bilateral"] is False
    assert got["room: filtered has less error than path tracing in equal time"] is False


def test_a_lower_error_with_missing_light_does_not_hold():
    (got,) = filter_verdicts.against(rows(of_raw=0.9), "cross", "better", "here")
    assert got.holds is False and "-10.0%" in got.figures


def test_shares_of_the_time_and_texture():
    got = holds(filter_verdicts.all_of(rows(cpu=8.0, texture_kept=0.9), [], []))
    assert got["room: rejection and filter take at most a quarter of the time at 16 samples"] is False
    assert got["room: texture is kept"] is False


def test_a_noisy_reference_is_told():
    found = rows()
    for row in found:
        row["reference"] = 0.004
    got = holds(filter_verdicts.good_references(found))
    assert got == {"room: the reference is good enough at 16 samples": False}


@pytest.mark.parametrize("apart, holds", [((1e-2, 1e-3, 1e-4), True), ((1e-2, 1e-3, 2e-3), False)])
def test_converging_is_coming_closer_at_every_step(apart, holds):
    found = [{"scene": "grid", "samples": 4**i, "apart": a, "energy": 1.0} for i, a in enumerate(apart)]
    assert filter_verdicts.vanishes(found)[0].holds is holds


def test_recording_costs():
    cost = {"scene": "grid", "overhead": 0.04, "low": 0.03, "high": 0.06, "plain_cpu": 2.0}
    got = filter_verdicts.recorded([cost, cost | {"overhead": 0.2}])
    assert [one.holds for one in got] == [True, False]
