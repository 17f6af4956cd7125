# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows and verdicts of the thesis's tables, from made-up records."""

import pytest

from bench import photons, tables, thesis


def stage(method, stored, emitted, camera=0.7):
    row = {"scene": "cornell", "method": method, "stored": stored, "emitted": emitted, "camera": camera}
    return row | {"stored_of_emitted": stored / emitted if emitted else None}


def rows(stored=50):
    made = [stage("PT", 0, 0), stage("PTPPM", 600, 1000), stage("SPPM", 2000, 1000)]
    made += [stage("PTPPM unguided", stored, 1000), stage("SPPM unguided", 1000, 1000)]
    return tables.with_sppm([*made, *photons.thesis_rows("cornell")])


def test_the_hybrids_map_is_compared_with_what_sppm_would_keep_of_as_many_photons():
    by = {row["method"]: row for row in rows()}
    assert by["PTPPM unguided"]["of_sppm"] == pytest.approx(0.05)
    assert "of_sppm" not in by["PTPPM"]
    assert {row["method"] for row in tables.photon_rows(list(by.values()))} == {
        "PTPPM",
        "SPPM",
        "PTPPM unguided",
        "SPPM unguided",
        "PTPPM (thesis)",
    }
    assert not any("unguided" in row["method"] for row in tables.stage_rows(list(by.values())))


@pytest.mark.parametrize(("stored", "holds"), ((100, True), (151, False)))
def test_the_share_of_caustic_photons_is_judged_by_the_thesis(stored, holds):
    first, second, guided, camera = tables.chapter_5(rows(stored))
    assert (first.holds, second.holds, guided.holds, camera.holds) == (holds, holds, True, True)
    assert f"{stored / 1000:.1%}" in first.figures and "9.0%" in first.figures


def test_without_runs_nothing_is_claimed():
    assert [verdict.holds for verdict in tables.chapter_5(photons.thesis_rows("ring"))] == [None] * 4


def times(filter_cpu):
    ours = {"scene": "glossy_spheres", "who": "ours", "render_cpu": 30.0, "filter_cpu": filter_cpu}
    theirs = {"scene": "glossy_spheres", "who": "thesis", **thesis.TABLE_6_1["glossy_spheres"]}
    return tables.with_shares([ours, theirs])


@pytest.mark.parametrize(("cpu", "megabytes", "holds"), ((3.0, 200.0, True), (20.0, 300.0, False)))
def test_the_filters_share_and_memory_are_judged_by_the_thesis(cpu, megabytes, holds):
    made = times(cpu)
    assert made[0]["share"] == pytest.approx(cpu / (30.0 + cpu))
    assert made[1]["share"] == pytest.approx(9.11 / 41.81, rel=1e-3)
    sizes = [{"scene": "glossy_spheres", "who": "ours", "megabytes": megabytes}]
    share, memory = tables.chapter_6(made, sizes)
    assert share.holds == holds and memory.holds == holds
    assert "236 MB" in memory.figures
