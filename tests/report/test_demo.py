# SPDX-License-Identifier: GPL-3.0-or-later
"""Demo pictures: rendered once, again after a change of the command or the scene, kept beside others."""

from __future__ import annotations

import os
import shlex
from pathlib import Path

import conftest
import pytest

from report import collect, demo, gallery, page


@pytest.fixture
def rendered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Stands in for Blender: the scenes that were rendered."""
    names: list[str] = []

    def render(scene: str, words: list[str], target: Path) -> float:
        names.append(scene)
        conftest.store(target, conftest.gradient(0.3))
        return 12.0

    monkeypatch.setattr(demo, "render", render)
    monkeypatch.setattr(demo.shutil, "which", lambda name: f"/usr/bin/{name}")
    (tmp_path / "addon").mkdir()
    (tmp_path / "addon" / "_core.so").touch()
    monkeypatch.setattr(demo, "ADDON", tmp_path / "addon")
    return names


def test_pictures_that_are_there_stay(tmp_path: Path, rendered: list[str]) -> None:
    for _ in range(2):
        demo.render_all(tmp_path, ["cornell", "open_plane"], 4, 100)
    assert rendered == ["cornell", "open_plane"]
    demo.render_all(tmp_path, ["cornell"], 8, 100)
    assert rendered == ["cornell", "open_plane", "cornell"]
    os.utime(tmp_path / "results" / "demo" / "open_plane.png", (0, 0))
    demo.render_all(tmp_path, ["open_plane"], 4, 100)
    assert rendered[3:] == ["open_plane"]
    found = collect.collect(tmp_path).results[0]
    assert [p.scene for p in found.pictures] == ["cornell", "open_plane"]
    assert not found.reduced


def test_the_command_is_under_the_picture(tmp_path: Path, rendered: list[str]) -> None:
    demo.render_all(tmp_path, ["cornell"], 4, 50)
    made = page.build(collect.collect(tmp_path))
    gallery.write(tmp_path / "docs", made.comparisons)
    words = shlex.join(demo.command("cornell", 4, 50))
    text = (tmp_path / "docs" / "gallery.md").read_text()
    assert f"\n    {words}\n" in text
    without = next(line for line in text.splitlines() if line.startswith("No picture yet: "))
    assert "Open plane" in without
    assert "Cornell" not in without
    assert (tmp_path / "docs" / "images" / "gallery" / "cornell.jpg").stat().st_size > 0
    assert "resolution_percentage = 50" in words
    assert collect.collect(tmp_path).results[0].reduced


def test_an_unknown_scene_is_refused(tmp_path: Path, rendered: list[str]) -> None:
    with pytest.raises(ValueError, match="no such scene: nothing"):
        demo.render_all(tmp_path, ["nothing"], 4, 100)
    assert rendered == []


def test_blender_that_writes_nothing_is_told(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="no picture of cornell"):
        demo.render("cornell", ["/bin/echo", "no engine"], tmp_path / "x.png")
    assert not (tmp_path / "x.png").exists()
