# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of docs/ as they are committed: links, pictures, navigation. MkDocs is not needed."""

from __future__ import annotations

import re
from pathlib import Path

import pages
import pytest

LARGEST_PICTURE = 600_000  # bytes
NAMED = re.compile(r"docs/[\w/.-]*\.(?:md|png|jpg|svg)")


@pytest.mark.parametrize("page", pages.pages(), ids=lambda page: page.name)
def test_links_resolve(page: Path):
    assert [text for text in map(pages.broken, pages.links(page)) if text] == []


def test_every_page_is_in_the_navigation_once():
    nav = pages.navigation()
    assert sorted(nav) == [page.name for page in pages.pages()]


def test_every_picture_is_shown():
    """By a page or the README, so that the folder does not grow by what nobody looks at any more. The gallery's own
    folder is kept by its writer (report/gallery.py)."""
    shown = {(link.page.parent / link.target).resolve() for page in pages.pages() for link in pages.links(page)}
    readme = (pages.ROOT / "README.md").read_text()
    kept = [p for p in (pages.DOCS / "images").rglob("*") if p.is_file() and p.parent.name != "gallery"]
    assert [p.name for p in kept if p not in shown and p.relative_to(pages.ROOT).as_posix() not in readme] == []


def test_pictures_are_small():
    assert [p.name for p in (pages.DOCS / "images").rglob("*") if p.stat().st_size > LARGEST_PICTURE] == []


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", "bench/README.md"])
def test_pages_that_the_repository_names_are_there(name: str):
    found = NAMED.findall((pages.ROOT / name).read_text())
    assert [one for one in found if not (pages.ROOT / one).exists()] == []


@pytest.mark.parametrize("page", pages.pages(), ids=lambda page: page.name)
def test_commands_are_there(page: Path):
    """Scripts that a page names, the bench's subcommands and the figures among them."""
    text = page.read_text()
    scripts = set(re.findall(r"\./scripts/(\w+)", text))
    assert {name for name in scripts if not (pages.ROOT / "scripts" / name).is_file()} == set()
    commands = set(re.findall(r"\./scripts/bench ([a-z]+)\b", text))
    assert {name for name in commands if not (pages.ROOT / "bench" / f"{name}.py").is_file()} == set()
    figures = set(re.findall(r"\./scripts/docs figures ([a-z_]+)", text))
    assert {name for name in figures if not (pages.DOCS / "figures" / f"{name}.py").is_file()} == set()


@pytest.mark.parametrize("page", pages.pages(), ids=lambda page: page.name)
def test_pages_fetch_nothing(page: Path):
    text = page.read_text()
    assert re.findall(r"!\[[^\]]*\]\(https?:|<(?:img|script|iframe)[^>]*https?:|^```mermaid", text, re.MULTILINE) == []


def test_a_broken_link_is_found(tmp_path: Path, monkeypatch):
    monkeypatch.setattr(pages, "DOCS", tmp_path)
    (tmp_path / "other.md").write_text("# Other\n\n## A heading, with *marks*\n")
    page = tmp_path / "page.md"
    page.write_text(
        "[a](other.md#a-heading-with-marks) [b](other.md#gone) ![c](none.png) `[d](none.md)`\n\n    [e](x.md)\n"
    )
    found = [text for text in map(pages.broken, pages.links(page)) if text]
    assert found == ["page.md: other.md#gone: no such heading", "page.md: none.png: no such file"]
