# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: one HTML file with its pictures, style and script inside."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
from markupsafe import Markup, escape
from PIL import Image

from . import encode, view
from .collect import DEMO, Collected
from .scenes import Comparison, compare, inside

HERE = Path(__file__).resolve().parent
QUALITIES = (92, 85, 75, 60)
"""Of WebP: the first whose page is small enough is taken."""
SIZE_LIMIT = 15_000_000
"""Bytes of a page that every browser opens at once."""


@dataclass
class Page:
    """The page's text, the quality of its pictures, and what the reader should know about the results."""

    html: str
    quality: int
    comparisons: list[Comparison]
    problems: list[str] = field(default_factory=list)

    @property
    def size(self) -> int:
        """Bytes."""
        return len(self.html.encode())


def _with_code(text: str) -> Markup:
    """Escaped, with what stands between backticks set as code."""
    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", str(escape(text))))


def _environment() -> jinja2.Environment:
    """Templates escape whatever comes from results; an unknown name is an error."""
    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.globals.update(
        table_rows=view.table_rows, numeric=view.numeric, figures=view.figures, first_pair=view.first_pair
    )
    made.filters.update(slug=view.slug, day=view.day, with_code=_with_code)
    made.globals["inline"] = lambda name: Markup((HERE / "templates" / name).read_text())
    return made


def _plots(found: Collected, quality: int) -> tuple[dict[str, list[tuple[str, str]]], list[str]]:
    """Of each result: its plots' names and data URIs; then what is wrong with the others."""
    out: dict[str, list[tuple[str, str]]] = {}
    problems = []
    for one in found.results:
        for file in one.plots:
            try:
                uri = encode.plot(inside(found.folders[one.name], file), quality)
            except (OSError, ValueError, Image.DecompressionBombError) as error:
                problems.append(f"{one.name}: the plot {file} cannot be shown ({error})")
                continue
            out.setdefault(one.name, []).append((file, uri))
    return out, problems


def _crop(comparison: Comparison, shot, place: tuple[int, int]) -> str:
    """A crop's data URI, every pixel as it was."""
    x, y = place
    return encode.webp(shot.image.crop((x, y, x + comparison.side, y + comparison.side)), 100)


def _by_scene(comparisons: list[Comparison]) -> dict[str, list[Comparison]]:
    """In the order in which scenes first come; `cornell, direct light` belongs to `cornell`."""
    out: dict[str, list[Comparison]] = {}
    for one in comparisons:
        out.setdefault(one.scene.split(", ")[0], []).append(one)
    return out


def _render(found: Collected, comparisons: list[Comparison], crops: dict, quality: int) -> Page:
    """The page with pictures of this quality."""
    plots, unseen = _plots(found, quality)
    scenes = _by_scene([c for c in comparisons if c.result != DEMO])
    html = (
        _environment()
        .get_template("page.html.j2")
        .render(
            results=found.results,
            titles={one.name: one.title for one in found.results},
            problems=found.problems + unseen,
            **view.summary(found.results),
            plots=plots,
            demo=[c for c in comparisons if c.result == DEMO],
            scenes=scenes,
            thumbs={scene: encode.thumb(view.shown(group[0])) for scene, group in scenes.items()},
            pictures={c.key: [encode.webp(shot.image, quality) for shot in c.shots] for c in comparisons},
            crops=crops,
            counts=view.verdict_counts(found.results),
            chords=view.curve(),
            quality=quality,
            max_side=encode.MAX_SIDE,
            tolerance=view.ENERGY_TOLERANCE,
        )
    )
    return Page(html, quality, comparisons, found.problems + unseen)


def build(found: Collected) -> Page:
    """Opens every picture, chooses crops, and fills the template; pictures lose quality if the page is too large."""
    comparisons: list[Comparison] = []
    for one in found.results:
        comparisons += compare(one, found.folders[one.name], found.problems)
    crops = {c.key: [[_crop(c, shot, at) for at in c.places] for shot in c.shots] for c in comparisons}
    for quality in QUALITIES:
        page = _render(found, comparisons, crops, quality)
        if page.size <= SIZE_LIMIT:
            break
    return page
