# SPDX-License-Identifier: GPL-3.0-or-later
"""Resuming, and the arithmetic of a comparison on engines that only pretend to render."""

import json

import numpy as np
import pytest

from bench import efficiency, store
from bench.reference import Reference


def test_records_survive_and_a_torn_last_line_is_ignored(tmp_path):
    path = tmp_path / "r.jsonl"
    first = store.Store(path)
    first.add(("run", "cycles", 1), {"cpu": 2.5})
    with path.open("a") as file:
        file.write('{"key": ["run", "cyc')
    again = store.Store(path)
    assert again.get("run", "cycles", 1)["cpu"] == 2.5
    assert again.get("run", "cycles", 2) is None


def test_a_budget_ends(tmp_path):
    assert not store.Store(tmp_path / "a", 0.0).out_of_time()
    assert store.Store(tmp_path / "b", 1e-9).out_of_time()


def test_tables_are_written_whole(tmp_path):
    rows = [{"a": 1, "b": 2.5}, {"a": 2, "c": "x"}]
    store.write_table(rows, tmp_path / "t")
    assert json.loads((tmp_path / "t.json").read_text()) == rows
    assert (tmp_path / "t.csv").read_text().splitlines()[0] == "a,b,c"
    assert "2.50" in store.show_table(rows, {"a": "d", "b": ".2f"})


class Pretender:
    def __init__(self, key):
        self.key = key


def plan() -> efficiency.Plan:
    return efficiency.Plan(Pretender("slow"), Pretender("fast"), Pretender("slow"), 7, 4.0, 2, 24, False, 1.0, 24.0)


def test_half_the_error_in_half_the_time_is_four_times_the_efficiency():
    slow = [
        {"relmse": 0.02, "relmse_trim": 0.02, "rmse": 0.1, "energy": 1.0, "flip": None, "cpu": 4.0, "cpu_net": 3.0}
    ] * 7
    fast = [f | {"relmse": 0.01, "cpu": 2.0, "cpu_net": 1.0} for f in slow]
    for f in (*slow, *fast):
        f["efficiency"] = 1 / (f["relmse"] * f["cpu"])
        f["efficiency_net"] = 1 / (f["relmse"] * f["cpu_net"])
    scene = type("S", (), {"name": "s", "bar": 3.0})
    ref = Reference(np.zeros((2, 2, 3)), {"relmse": 0.0, "mse": 0.002}, 8)
    # the same pictures stand for all runs, so the median is exact
    rows = efficiency.table_rows(plan(), scene, "all", 64, ref, {"slow": slow, "fast": fast})
    assert rows[0]["ratio"] == pytest.approx(1.0)
    assert rows[1]["ratio"] == pytest.approx(4.0)
    assert rows[1]["ratio_net"] == pytest.approx(6.0)
    notes = efficiency.notes(rows, "fast")
    assert any("own error is 20%" in n for n in notes)
    assert any("bar 3: met" in n for n in notes)


def test_a_wrong_energy_is_named():
    row = {
        "scene": "s",
        "mask": "all",
        "engine": "fast",
        "reference": 0.01,
        "energy": 0.97,
        "ratio": 1,
        "ratio_net": 1,
        "bar": 3,
    }
    notes = efficiency.notes([row], "fast")
    assert any("-3.00%" in n for n in notes)
    assert any("missed" in n for n in notes)
