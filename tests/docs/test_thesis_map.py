# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/thesis-map.md: each named file exists, and each name beside it is in it."""

from __future__ import annotations

import re

import pages
import pytest

FILE = re.compile(r"^(?:[\w.-]+/)+[\w.-]+\.\w+$")
ROWS = [line for line in (pages.DOCS / "thesis-map.md").read_text().splitlines() if line.startswith("| ")]


def named(row: str) -> list[tuple[str, list[str]]]:
    """(file, names) of a row's last cell: the names that stand behind a file, up to the next one."""
    found: list[tuple[str, list[str]]] = []
    for span in re.findall(r"`([^`]+)`", row.rstrip("| ").rpartition(" | ")[2]):
        if FILE.match(span):
            found.append((span, []))
        elif found and not span.startswith("./"):
            found[-1][1].append(span)
    return found


NAMED = [one for row in ROWS for one in named(row)]


def test_the_table_is_read():
    assert len(NAMED) > 50
    assert ("engine_cpp/filter/reject.cpp", ["supported", "reject_pixel"]) in NAMED


@pytest.mark.parametrize("file, names", NAMED, ids=[f"{file} {' '.join(names)}" for file, names in NAMED])
def test_names_are_where_the_page_says(file: str, names: list[str]):
    path = pages.ROOT / file
    assert path.is_file()
    text = path.read_text()
    assert [name for name in names if not re.search(rf"\b{re.escape(name)}\b", text)] == []


def test_every_equation_of_both_chapters_has_a_row():
    """Chapter 5 has the equations 5.1 to 5.5, chapter 6 those from 6.3 to 6.15 (the two before restate rendering)."""
    text = "\n".join(ROWS)
    wanted = {f"5.{n}" for n in range(1, 6)} | {f"6.{n}" for n in range(3, 16)}
    covered = set(re.findall(r"\((\d\.\d+)\)", text))
    for chapter, first, last in re.findall(r"\((\d)\.(\d+)\) to \(\d\.(\d+)\)", text):
        covered |= {f"{chapter}.{n}" for n in range(int(first), int(last) + 1)}
    assert wanted - covered == set()
    assert {f"Algorithm {n}" for n in range(1, 7)} - set(re.findall(r"Algorithm \d", text)) == set()
