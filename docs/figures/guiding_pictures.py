# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/guiding.jpg: the caustics of an open plane with the same number of photons, as they leave and guided."""

from __future__ import annotations

from renders import load, render, save, show, stats
from strips import strip


def draw() -> None:
    panels = []
    for title, guided in (("not guided", "false"), ("guided (default)", "true")):
        exr = render("open_plane", 32, width=640, height=400, photons=40_000, guided_emission=guided)
        photons = stats(exr)["photons"]
        panels.append(
            (
                f"{title}: {photons['gathered'] / photons['emitted']:.2f} gathered for each photon sent",
                show(load(exr, "C1"), 4),
            )
        )
    save(strip(panels), "guiding")
