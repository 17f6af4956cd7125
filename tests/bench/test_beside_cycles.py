# SPDX-License-Identifier: GPL-3.0-or-later
"""Arithmetic of rays, start, memory and nodes on runs whose outcome is known; their plots are files."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from bench import charts, memory, nodes, rays, start

SCENE = SimpleNamespace(name="room")
PAIR = [SimpleNamespace(key="cardioid", title="Cardioid"), SimpleNamespace(key="cycles", title="Cycles")]


def run(cpu: float, mean: float = 0.5, **counts) -> dict:
    return {"cpu": cpu, "mean": mean, "pixels": 1000, "counters": {"counts": counts} if counts else {}}


def rows_of_rays() -> list[dict]:
    counts = {"rays": 6000, "shadow_rays": 4000, "camera_paths": 2000}
    ours = rays.figures([run(3.0, **counts), run(5.0, **counts)], [run(1.0), run(1.0)], 30)
    theirs = rays.figures([run(7.0)], [run(1.0)], 30)
    return rays.rows_of(SCENE, PAIR, {"cardioid": ours, "cycles": theirs}, {"share_of_bare_embree": 0.4})


def test_rays_are_counted_without_start_up_and_cycles_gets_ours_a_path():
    ours, theirs = rows_of_rays()
    assert ours["cpu"] == pytest.approx(3.0) and ours["paths"] == pytest.approx(10_000)
    assert ours["rays"] == pytest.approx(50_000) and theirs["rays"] == pytest.approx(25_000)
    assert ours["of_rival"] == pytest.approx(2.0) and theirs["of_rival"] == 1.0
    assert ours["of_embree"] == 0.4 and "of_embree" not in theirs


def test_missing_light_is_told_beside_speed():
    rows = rows_of_rays()
    rows[0]["energy"] = 0.9
    faster, even = rays.verdicts(rows, "cardioid")
    assert faster.holds and not even.holds
    assert "energy 0.9000" in faster.figures


def test_start_waits_for_the_first_line_after_f12():
    lines = [(0.5, "Sample 1/8"), (1.0, "F12"), (1.5, "Sample 0/8"), (3.0, "Sample 1/8")]
    assert start.since_f12(lines, start.BUILT) == pytest.approx(0.5)
    assert start.since_f12(lines, start.FIRST_SAMPLE) == pytest.approx(2.0)
    assert start.since_f12(lines[:1], start.BUILT) is None


def test_starts_are_medians_of_what_was_told():
    found = [{"built": None, "first_tile": t, "one_sample": 2.0, "cpu": 1.0, "mean": 0.5} for t in (1.0, 3.0, 9.0)]
    row = start.row_of("room", PAIR[0], found)
    assert row["first_tile"] == 3.0 and row["built"] is None and row["runs"] == 3


def test_table_6_2_counts_the_buffers_that_the_thesis_counts():
    found = {"clusters": 4_000_000, "singles": 1, "cluster_bytes": 120e6, "film_bytes": 200e6, "outlier_share": 0.001}
    row = memory.sizes_row("bust_in_water", found)
    assert row["megabytes"] == pytest.approx(120 + 28 * 768**2 / 1e6)
    assert row["per_cluster"] == pytest.approx(30.0)


def test_more_memory_than_cycles_does_not_hold():
    rows = [
        {"engine": "cardioid", "per_triangle": 300.0, "per_pixel": 50.0},
        {"engine": "cycles", "per_triangle": 200.0, "per_pixel": 60.0},
    ]
    assert [one.holds for one in memory.verdicts(rows, [], "cardioid")] == [False, True]


def shaded(name: str, ours: list[float], theirs: list[float]) -> dict:
    means = {"CARDIOID": 0.4, "CYCLES": 0.5}
    return {"material": name, "seconds": {"CARDIOID": ours, "CYCLES": theirs}, "means": means, "cpu": 3.0}


def test_a_materials_time_is_beyond_the_plain_ones():
    found = [shaded(nodes.PLAIN, [1e-7], [2e-7]), shaded("wood", [2e-7, 4e-7, 3e-7], [6e-7, 5e-7, 4e-7])]
    plain, wood = nodes.rows(found)
    assert plain["cardioid_ns"] == pytest.approx(100)
    assert wood["cardioid_ns"] == pytest.approx(200) and wood["cycles_ns"] == pytest.approx(300)
    assert wood["ratio"] == pytest.approx(2 / 3)
    assert (wood["low"], wood["high"]) == (pytest.approx(0.25), pytest.approx(1.5))
    assert wood["energy"] == pytest.approx(0.8)


def test_nothing_is_told_without_the_plain_material():
    assert nodes.rows([shaded("wood", [1e-7], [1e-7])]) == []


def test_slow_shading_and_slow_compiling_do_not_hold():
    table = [{"material": "wood", "ratio": 1.2}, {"material": "rock", "ratio": 1.4}]
    compiled = [{"count": 1000, "seconds": 1.4, "each_ms": 1.4}]
    assert [one.holds for one in nodes.verdicts(table, compiled)] == [False, False]


def test_plots_are_written(tmp_path):
    pytest.importorskip("matplotlib")
    sizes = [{"scene": "bust", "who": who, "megabytes": 100.0} for who in ("ours", "thesis")]
    engines = [{"who": one.title, "per_triangle": 300.0, "per_pixel": 60.0} for one in PAIR]
    rejected = [{"scene": "bust", "n": n, "seconds": 0.1, "rejected": 0.01 * n} for n in (1, 2, 4)]
    apart = [{"scene": "bust", "samples": n, "raw": 1 / n, "filtered": 1 / n, "apart": 0.1 / n} for n in (4, 16)]
    methods = [
        {"scene": "bust", "samples": n, "method": m, "taken": n, "cpu": float(n), "relmse": 1 / n}
        for n in (4, 16)
        for m in charts.STYLES
    ]
    drawn = [
        charts.bars(rows_of_rays(), {"paths": "paths", "rays": "rays"}, tmp_path / "rays.png", unit=1e3),
        charts.memory(engines, sizes, tmp_path / "memory.png"),
        charts.nodes([{"material": "wood", "cardioid_ns": 90.0, "cycles_ns": 120.0}], tmp_path / "nodes.png"),
        charts.rejection(rejected, tmp_path / "rejection.png"),
        charts.vanishing(apart, tmp_path / "vanishing.png"),
        charts.methods(methods, tmp_path / "methods.png"),
    ]
    assert all(drawn)
    assert len([path for path in tmp_path.glob("*.png") if path.stat().st_size > 5000]) == len(drawn)
