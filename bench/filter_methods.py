# SPDX-License-Identifier: GPL-3.0-or-later
"""The ways to a picture of few samples that are compared; each gives pictures with their CPU seconds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from . import denoise, exr, filter_runs, regions, runs

PLAIN = ("record_clusters=false",)
CLUSTERS = ("filter_method=clusters",)
FILTERS = {
    "rejection": ("filter_method=none",),
    "cross-bilateral wide": ("filter_method=cross_bilateral", "texture_width=0.5"),
    "cross-bilateral narrow": ("filter_method=cross_bilateral", "texture_width=0.05"),
    "thesis": ("filter_method=thesis",),
    "clusters, no rejection": (*CLUSTERS, "firefly_density=0"),
    "clusters": CLUSTERS,
}
CLAMPS = (1, 10)


@dataclass
class Picture:
    pixels: np.ndarray
    cpu: float
    samples: int


def of_film(film: filter_runs.Film, surface: regions.Surface) -> dict[str, Picture]:
    """Raw, filtered and denoised pictures of one film; fewer if time ran out."""
    taken = film.raw()
    if taken is None:
        return {}
    record, path = taken
    samples = film.job.samples
    out = {"raw": Picture(exr.load(path, "Raw"), record["cpu"], samples)}
    for name, settings in FILTERS.items():
        done = film.filtered(settings)
        if done is None:
            return out
        out[name] = Picture(exr.load(done[1], "Filtered"), record["cpu"] + done[0]["cpu_seconds"], samples)
    if not denoise.problem():
        for name, source in (("OIDN", "raw"), ("clusters, OIDN", "clusters")):
            pixels, cpu = denoise.oidn(out[source].pixels, surface)
            out[name] = Picture(pixels, out[source].cpu + cpu, samples)
    return out


def plain(film: filter_runs.Film, samples: int, settings: tuple[str, ...] = ()) -> Picture | None:
    """A render without clusters, the film's but for these settings."""
    job = replace(film.job, samples=samples, settings=(*film.job.settings, *PLAIN, *settings))
    run = runs.measured(film.records, film.cache, film.engine, job, "plain")
    if run is None:
        return None
    return Picture(exr.load(Path(run["path"])), run["stats"]["cpu_seconds"], samples)


def equal_time(film: filter_runs.Film, seconds: float) -> Picture | None:
    """As many samples as fit the CPU seconds of another way, at least as many as it had."""
    probe = plain(film, film.job.samples)
    if probe is None:
        return None
    samples = round(film.job.samples * seconds / probe.cpu)
    return plain(film, samples) if samples > film.job.samples else probe


def rendered_again(film: filter_runs.Film, seconds: float) -> dict[str, Picture]:
    """Equal time without a filter, and indirect light clamped as artists do."""
    found = {"equal time": equal_time(film, seconds)}
    for limit in CLAMPS:
        found[f"clamped at {limit}"] = plain(film, film.job.samples, (f"clamp_indirect={limit}",))
    return {name: picture for name, picture in found.items() if picture is not None}
