# SPDX-License-Identifier: GPL-3.0-or-later
"""The filtered picture goes to the unfiltered one as samples are added."""

from __future__ import annotations

import numpy as np

from . import exr, filter_methods, filter_runs, metrics

NAMES = ("coloured_grid", "glossy_spheres")
WIDTH, COUNTS = 96, (4, 16, 64, 256, 1024, 4096)
COLUMNS = {
    "scene": ["scene", ""],
    "samples": ["samples", "d"],
    "raw": ["relMSE of raw", ".2e"],
    "filtered": ["relMSE of filtered", ".2e"],
    "apart": ["relMSE between them", ".2e"],
    "energy": ["filtered light over raw", ".5f"],
    "withheld": ["light withheld", ".3%"],
    "cpu": ["CPU s, filter included", ".2f"],
}


def picture(records, options, engine, scene, samples: int, seed: int) -> filter_runs.Film:
    return filter_runs.Film(records, options.cache, engine, scene.job(samples, seed, WIDTH, options.threads))


def rows_of(records, options, engine, scene, counts: tuple[int, ...]) -> list[dict]:
    """Errors against a render of the most samples with another seed, whose own error is taken off."""
    other = filter_methods.plain(picture(records, options, engine, scene, counts[-1], 2), counts[-1])
    if other is None:
        return []
    rows, own = [], 0.0
    for samples in reversed(counts):
        film = picture(records, options, engine, scene, samples, 1)
        done = film.filtered(filter_methods.CLUSTERS)
        film.forget()
        if done is None:
            break
        raw, filtered = (exr.load(done[1], layer) for layer in ("Raw", "Filtered"))
        error = metrics.evaluate(raw, other.pixels)["relmse"]
        own = own or error / 2
        row = {"scene": scene.name, "samples": samples, "raw": error - own}
        row["filtered"] = metrics.evaluate(filtered, other.pixels)["relmse"] - own
        row["apart"] = metrics.evaluate(filtered, raw)["relmse"]
        row |= {"energy": float(np.mean(filtered) / np.mean(raw)), "withheld": done[0]["withheld_share"]}
        row["cpu"] = film.raw()[0]["cpu"] + done[0]["cpu_seconds"]
        rows.append(row)
    return rows[::-1]
