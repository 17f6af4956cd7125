# SPDX-License-Identifier: GPL-3.0-or-later
"""What clusters, rejection and filter cost, beside the thesis's tables."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from . import filter_methods, filter_runs, metrics, runs

SAMPLES, REPEATS = 16, 5
NAMES = ("glossy_spheres", "bust_in_water", "coloured_grid")
SIGMA, MU = 11, 0.5
COUNTS = (1, 2, 4, 8, 16, 32, 64)
"""n = d σ² μ of Fig. 6.10: like samples that a cluster needs."""
OVERHEAD = {
    "scene": ["scene", ""],
    "pairs": ["pairs", "d"],
    "plain_cpu": ["CPU s without", ".2f"],
    "overhead": ["clusters add", ".1%"],
    "low": ["lower quartile", ".1%"],
    "high": ["upper quartile", ".1%"],
}
OVER_N = {
    "scene": ["scene", ""],
    "n": ["n = d σ² μ", "d"],
    "seconds": ["seconds", ".4f"],
    "rejected": ["samples rejected", ".4%"],
    "withheld": ["light withheld", ".3%"],
}


def repeated(film: filter_runs.Film, settings: tuple[str, ...]) -> dict | None:
    """The record of filtering on all threads, its seconds the medians of several runs."""
    done = [film.filtered(settings, run) for run in range(REPEATS)]
    if any(one is None for one in done):
        return None
    times = {
        key: float(np.median([one[0][key] for one in done])) for key in ("seconds", "rejection_seconds", "cpu_seconds")
    }
    return done[-1][0] | times


def tables(film: filter_runs.Film, name: str) -> tuple[dict, dict] | None:
    """One scene's rows of tables 6.1 and 6.2."""
    found = repeated(film, filter_methods.CLUSTERS)
    if found is None:
        return None
    record = film.raw()[0]
    cpu = record["cpu"] + found["cpu_seconds"]
    plain = filter_methods.plain(film, SAMPLES)
    times = {"scene": name, "who": "ours", "samples": SAMPLES, "render_cpu": record["cpu"]}
    times |= {"equal_samples": round(SAMPLES * cpu / plain.cpu) if plain else None}
    times |= {"render": record["stats"]["seconds"]["render"]}
    times |= {"rejection": found["rejection_seconds"], "filter": found["seconds"] - found["rejection_seconds"]}
    times["filter_cpu"] = found["cpu_seconds"]
    sizes = {"scene": name, "who": "ours", "clusters": found["clusters"], "singles": found["singles"]}
    sizes |= {"megabytes": found["film_bytes"] / 1e6, "outliers": found["outlier_share"]}
    return times, sizes


def over_n(film: filter_runs.Film, name: str) -> list[dict]:
    """Fig. 6.10: seconds of rejection over the count that a cluster needs."""
    rows = []
    for n in COUNTS:
        density = f"firefly_density={n / (SIGMA * SIGMA * MU):.7g}"
        found = repeated(film, (*filter_methods.FILTERS["rejection"], density))
        if found is None:
            break
        rows.append({"scene": name, "n": n, "seconds": found["rejection_seconds"], "rejected": found["outlier_share"]})
        rows[-1]["withheld"] = found["withheld_share"]
    return rows


def overhead(records, options, engine, scene) -> dict | None:
    """CPU seconds with clusters over those without, less 1: the median of interleaved pairs, the first alternating."""
    ratios, plain = [], []
    for pair in range(options.pairs):
        job = scene.job(SAMPLES, 1, options.pair_width, options.threads)
        found = {}
        for kept in ("false", "true") if pair % 2 else ("true", "false"):
            one = replace(job, settings=(*job.settings, f"record_clusters={kept}"))
            run = runs.measured(records, options.cache, engine, one, f"pair{pair}")
            if run is None:
                return None
            found[kept] = run["stats"]["cpu_seconds"]
        ratios.append(found["true"] / found["false"] - 1)
        plain.append(found["false"])
    middle, low, high = metrics.median_with_range(ratios)
    row = {"scene": scene.name, "pairs": options.pairs, "plain_cpu": float(np.median(plain))}
    return row | {"overhead": middle, "low": low, "high": high}


def large_film(records, options, engine, scene) -> list[dict]:
    """Memory at 1920 × 1080."""
    job = scene.job(SAMPLES, 1, 0, options.threads, ("width=1920", "height=1080"))
    film = filter_runs.Film(records, options.cache, engine, job)
    found = film.raw()
    film.forget()
    if found is None:
        return []
    return [{"scene": scene.name, "megabytes_1080p": found[0]["stats"]["bytes"]["film"] / 1e6}]
