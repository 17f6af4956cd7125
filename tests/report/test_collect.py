# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that are wrong, missing or mixed are told, and do not keep the others from the page."""

from __future__ import annotations

import json
from pathlib import Path

import conftest
import pytest

from bench.result import Picture, Result, save
from report import collect, page


def edit(cache: Path, change) -> None:
    """Changes the stored result's JSON by a function of it."""
    path = cache / "results" / "peers" / "result.json"
    raw = json.loads(path.read_text())
    change(raw)
    path.write_text(json.dumps(raw))


def other(cache: Path, **values) -> None:
    """Saves a second result, `rays`, of the same machine and commit unless told otherwise."""
    made = {"machine": conftest.MACHINE, "commit": "abc1234", "made": "2026-01-02T03:04:05+0000", **values}
    save(Result("rays", "Rays", "./scripts/bench rays --full", False, **made), cache)


def test_sound_results_have_no_problems(cache: Path) -> None:
    other(cache)
    found = collect.collect(cache)
    assert [one.name for one in found.results] == ["peers", "rays"]
    assert found.problems == []


def test_an_empty_cache_says_how_to_run_the_bench(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"run \./scripts/bench first"):
        collect.collect(tmp_path)


@pytest.mark.parametrize("text", ["", "{", "[]", '"text"', "{}", '{"format": 99}', '{"format": 1, "name": "peers"}'])
def test_a_corrupt_result_is_told_and_the_others_stay(cache: Path, text: str) -> None:
    other(cache)
    (cache / "results" / "peers" / "result.json").write_text(text)
    found = collect.collect(cache)
    assert [one.name for one in found.results] == ["rays"]
    assert len(found.problems) == 1
    assert "peers" in found.problems[0]


def test_a_folder_without_result_is_told(cache: Path) -> None:
    (cache / "results" / "memory").mkdir()
    assert any("memory: no result.json" in text for text in collect.collect(cache).problems)


@pytest.mark.parametrize(
    "change",
    [
        lambda raw: raw.update(missing=[1]),
        lambda raw: raw.update(title=None),
        lambda raw: raw.update(machine="a PC"),
        lambda raw: raw["tables"][0].update(rows=[3]),
        lambda raw: raw["tables"][0].update(columns={"a": "b"}),
        lambda raw: raw["pictures"][0].update(error="small"),
        lambda raw: raw["verdicts"][0].update(holds="yes"),
    ],
)
def test_values_of_wrong_types_are_told(cache: Path, change) -> None:
    edit(cache, change)
    found = collect.collect(cache)
    assert found.results == []
    assert "wrong types" in found.problems[0]


def test_other_commits_and_machines_are_told(cache: Path) -> None:
    other(cache, commit="fff0000+", machine={**conftest.MACHINE, "cpu": "Other 1"})
    problems = " ".join(collect.collect(cache).problems)
    assert "different commits. abc1234: peers; fff0000+: rays" in problems
    assert "different machines. Testron 9" in problems
    assert "Files differed from the commit when these ran: rays" in problems


def test_incomplete_runs_are_named(cache: Path) -> None:
    other(cache, complete=False)
    assert any("Incomplete" in text and "rays" in text for text in collect.collect(cache).problems)


def test_a_missing_picture_and_plot_are_told(cache: Path) -> None:
    where = cache / "results" / "peers"
    (where / "cornell-cycles.png").unlink()
    (where / "wine_glass-ours.png").write_bytes(b"no picture")
    (where / "plot.png").unlink()
    made = page.build(collect.collect(cache))
    assert [len(c.shots) for c in made.comparisons] == [2, 2, 2]
    assert len(made.problems) == 3
    for text in ("a picture of cornell cannot be shown: Cycles 3.4.1", "wine_glass", "plot.png"):
        assert any(text in problem for problem in made.problems)


def test_pictures_outside_of_the_folder_are_refused(cache: Path, tmp_path: Path) -> None:
    conftest.store(tmp_path / "secret.png", conftest.gradient(0.3))
    edit(cache, lambda raw: raw["pictures"][0].update(file="../../../secret.png"))
    assert any("outside" in problem for problem in page.build(collect.collect(cache)).problems)


def test_pictures_of_other_sizes_are_not_compared(cache: Path) -> None:
    where = cache / "results" / "peers"
    result = conftest.peers(cache)
    small = conftest.store(where / "small.png", conftest.gradient(0.4)[:50, :60])
    result.pictures.append(Picture("cornell", "LuxCore", small))
    save(result, cache)
    made = page.build(collect.collect(cache))
    assert [(c.scene, c.size, len(c.shots)) for c in made.comparisons] == [
        ("cornell", (192, 144), 3),
        ("cornell", (60, 50), 1),
        ("wine_glass", (192, 144), 3),
        ("wine_glass, direct light", (192, 144), 2),
    ]
    assert any("different sizes" in problem and "60 × 50: LuxCore" in problem for problem in made.problems)
