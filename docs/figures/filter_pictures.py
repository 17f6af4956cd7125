# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/filter-steps.jpg: what the filter does with 16 samples of glossy spheres, path traced."""

from __future__ import annotations

import numpy as np
from renders import enlarge, filtered, load, render, save, show
from strips import strip

PART = (slice(150, 330), slice(130, 370))
SETTINGS = {
    "integrator": "path_tracing",
    "caustic_roughness": 0,
    "width": 480,
    "height": 480,
    "record_clusters": "true",
}


def draw() -> None:
    film = render("glossy_spheres", 16, film=True, **SETTINGS).with_suffix(".film")
    kept = filtered(film, filter_method="none")
    smooth = filtered(film, filter_method="clusters")
    long_film = render("glossy_spheres", 256, film=True, **SETTINGS).with_suffix(".film")
    long_smooth = filtered(long_film, filter_method="clusters")

    def part(pixels: np.ndarray) -> np.ndarray:
        return enlarge(show(pixels[PART], 1.5), 2)

    panels = [
        ("as traced, 16 samples", part(load(kept, "Raw"))),
        ("fireflies withheld", part(load(kept))),
        ("what is withheld", part(load(kept, "Withheld"))),
        ("filtered (default), 16 samples", part(load(smooth))),
        ("as traced, 256 samples", part(load(long_smooth, "Raw"))),
        ("filtered, 256 samples", part(load(long_smooth))),
    ]
    save(strip(panels, 3), "filter-steps")
