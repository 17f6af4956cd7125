# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m bench filter --part convergence`: the filtered picture goes to the unfiltered one as samples are added."""

from __future__ import annotations

import numpy as np

from . import exr, filter_methods, filter_runs, filter_scenes, metrics, store

NAMES = ("coloured_grid", "glossy_spheres")
WIDTH, COUNTS = 96, (4, 16, 64, 256, 1024, 4096)
COLUMNS = {
    "scene": "",
    "samples": "d",
    "raw": ".2e",
    "filtered": ".2e",
    "apart": ".2e",
    "energy": ".5f",
    "withheld": ".3%",
}
"""Errors of raw and filtered picture, how far they are apart (relmse); filtered light over raw; light withheld."""


def picture(records, options, engine, scene, samples: int, seed: int) -> filter_runs.Film:
    return filter_runs.Film(records, options.cache, engine, scene.job(samples, seed, WIDTH, options.threads))


def rows_of(records, options, engine, scene) -> list[dict]:
    """Errors against a render of the most samples with another seed, whose own error is taken off."""
    other = filter_methods.plain(picture(records, options, engine, scene, COUNTS[-1], 2), COUNTS[-1])
    if other is None:
        return []
    rows, own = [], 0.0
    for samples in reversed(COUNTS):
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
        rows.append(row)
    return rows[::-1]


def run(options, records: store.Store, engine, referee_engine) -> int:
    rows = []
    for name in options.scene or NAMES:
        rows += rows_of(records, options, engine, filter_scenes.SCENES[name])
    store.publish(rows, COLUMNS, options.cache / "filter-convergence")
    return 0 if rows else 1
