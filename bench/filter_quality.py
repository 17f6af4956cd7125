# SPDX-License-Identifier: GPL-3.0-or-later
"""Every method on a scene at a number of samples: error, energy, cost, texture, edges of light."""

from __future__ import annotations

from . import filter_methods, filter_runs, quality, regions

COLUMNS = {
    "scene": ["scene", ""],
    "samples": ["samples", "d"],
    "method": ["method", ""],
    "taken": ["taken", "d"],
    "cpu": ["CPU s", ".2f"],
    "relmse": ["relMSE", ".5f"],
    "relmse_trim": ["relMSE, trimmed", ".5f"],
    "of_equal_time": ["of equal time's", ".2f"],
    "flip": ["FLIP", ".4f"],
    "energy": ["energy", ".4f"],
    "of_raw": ["light over raw", ".4f"],
    "fireflies": ["fireflies", "d"],
    "texture_kept": ["texture kept", ".3f"],
    "light_edges": ["relMSE at edges of light", ".5f"],
    "reference": ["reference's own", ".5f"],
}
JUDGED = 16
"""Samples at which the thesis compares, and at which renders of equal time and clamped ones are made."""


def pictures_of(film: filter_runs.Film, surface: regions.Surface) -> dict[str, filter_methods.Picture]:
    """By method; fewer if time runs out."""
    found = filter_methods.of_film(film, surface)
    if film.job.samples == JUDGED and "clusters" in found:
        found |= filter_methods.rendered_again(film, found["clusters"].cpu)
    return found


def rows_of(found: dict[str, filter_methods.Picture], scene: str, samples: int, referee: quality.Referee) -> list[dict]:
    """A row for each picture."""
    rows = []
    for method, picture in found.items():
        row = {"scene": scene, "samples": samples, "method": method, "taken": picture.samples}
        row |= {"cpu": picture.cpu, **quality.evaluate(picture.pixels, referee)}
        row["of_raw"] = float(picture.pixels.mean() / found["raw"].pixels.mean())
        rows.append(row)
    equal = next((row["relmse"] for row in rows if row["method"] == "equal time"), None)
    for row in rows:
        row["of_equal_time"] = row["relmse"] / equal if equal else None
    return rows
