# SPDX-License-Identifier: GPL-3.0-or-later
"""What the template shows, as plain values: cells, figures, choices; no HTML."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from datetime import datetime

from PIL import Image

from bench.result import Picture, Result, Table

from .collect import machine_text
from .scenes import Comparison, Shot

ENERGY_TOLERANCE = 0.02
"""Energy ratios further from 1 than this are marked."""


@dataclass
class Cell:
    """A table's cell; `sort`: what it is sorted by, empty for text and for what was not measured."""

    text: str
    sort: str = ""
    number: bool = False


def slug(text: str) -> str:
    """For ids in the page."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-") or "x"


def cell(value: object, form: str) -> Cell:
    """A value in its column's format; as it is where the format does not fit it."""
    if value is None:
        return Cell("–")
    if isinstance(value, bool):
        return Cell("yes" if value else "no")
    try:
        text = format(value, form)
    except (ValueError, TypeError):
        text = str(value)
    if isinstance(value, int | float):
        return Cell(text, repr(value) if math.isfinite(value) else "", True)
    return Cell(text)


def table_rows(table: Table) -> list[list[Cell]]:
    """Cells by row, in the order of the columns."""
    return [[cell(row.get(key), form) for key, (_, form) in table.columns.items()] for row in table.rows]


def numeric(table: Table) -> list[bool]:
    """Of each column: whether it holds numbers, which are set flush right."""
    return [any(type(row.get(key)) in (int, float) for row in table.rows) for key in table.columns]


def figures(picture: Picture) -> list[tuple[str, str, bool]]:
    """Error, energy ratio and CPU seconds, always the three: name, text, whether it is to be marked."""
    off = picture.energy is not None and not abs(picture.energy - 1.0) <= ENERGY_TOLERANCE
    return [
        ("relMSE", "–" if picture.error is None else f"{picture.error:.3g}", False),
        ("energy", "–" if picture.energy is None else f"{picture.energy:.3f}", off),
        ("CPU", "–" if picture.cpu is None else f"{picture.cpu:.1f} s", False),
    ]


def ours(shot: Shot) -> bool:
    """Whether Cardioid made the picture, by its label."""
    return bool(re.search(r"cardioid|ptppm|clusters", shot.picture.label, re.IGNORECASE)) and not shot.picture.reference


def filtered(shot: Shot) -> bool:
    """Whether a noise filter went over the picture, by its label."""
    return bool(re.search(r"filter|clusters|denois|oidn", shot.picture.label, re.IGNORECASE))


def first_pair(comparison: Comparison) -> tuple[int, int]:
    """Indices of the pictures that the slider begins with: a rival left, ours with the least error right.

    Unfiltered ones, where there are any. The rival is Cycles where it is there, of its runs in about the same CPU
    seconds the one with the least error; without a rival the reference.
    """
    shots = comparison.shots
    rivals = [s for s in shots if not s.picture.reference and not ours(s)]
    own = _unfiltered([s for s in shots if ours(s)])
    right = min(own or rivals[-1:] or shots[-1:], key=lambda s: _or_big(s.picture.error))
    rivals = _unfiltered([s for s in rivals if s is not right])
    cycles = [s for s in rivals if "cycles" in s.picture.label.lower()]
    others = cycles or rivals or [s for s in shots if s is not right]
    left = min(_as_long(others, right), key=lambda s: _or_big(s.picture.error))
    return shots.index(left), shots.index(right)


def _unfiltered(shots: list[Shot]) -> list[Shot]:
    """Those without a filter, or all if all have one."""
    return [s for s in shots if not filtered(s)] or shots


def _as_long(shots: list[Shot], other: Shot) -> list[Shot]:
    """Those of at most half as many CPU seconds again as another's, and not under two thirds; all if there are none."""
    wanted = other.picture.cpu or 0.0
    near = [s for s in shots if s.picture.cpu is not None and wanted / 1.5 <= s.picture.cpu <= wanted * 1.5]
    return near or shots


def _or_big(value: float | None) -> float:
    return 1e30 if value is None else value


def day(made: str) -> str:
    """A result's date as `2026-01-31 14:05`; as it is where it cannot be read."""
    try:
        return datetime.strptime(made, "%Y-%m-%dT%H:%M:%S%z").strftime("%Y-%m-%d %H:%M")
    except ValueError:
        return made


def summary(results: list[Result]) -> dict[str, object]:
    """What stands at the top: days, commits and machines, each once; how many are reduced, how many incomplete."""
    days = sorted(day(one.made)[:10] for one in results if one.made)
    return {
        "span": " to ".join(dict.fromkeys([days[0], days[-1]])) if days else "date unknown",
        "commits": list(dict.fromkeys(one.commit or "unknown" for one in results)),
        "machines": list(dict.fromkeys(machine_text(one.machine) or "unknown machine" for one in results)),
        "processors": list(dict.fromkeys(machine_text({**one.machine, "system": ""}) for one in results)),
        "reduced": sum(one.reduced for one in results),
        "incomplete": sum(not one.complete for one in results),
    }


def shown(comparison: Comparison) -> Image.Image:
    """The picture that stands for a scene: the reference, or what the slider begins with."""
    reference = comparison.reference
    return (reference or comparison.shots[first_pair(comparison)[1]]).image


def verdict_counts(results: list[Result]) -> dict[str, int]:
    """How many claims hold, do not hold, cannot be told."""
    found = [v.holds for r in results for v in r.verdicts]
    return {"holds": found.count(True), "does not hold": found.count(False), "cannot be told": found.count(None)}


def curve(chords: int = 96) -> list[tuple[float, float, float, float]]:
    """Chords of the unit circle from the angle a to 2a, x1, y1, x2, y2: their envelope is the cardioid."""
    turns = [2.0 * math.pi * i / chords for i in range(1, chords)]
    return [tuple(round(f(k * a), 4) for k in (1, 2) for f in (math.cos, math.sin)) for a in turns]
