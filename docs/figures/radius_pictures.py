# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/radius.jpg: the ring's caustic after 16 samples, with first radii from a quarter of a pixel to 16."""

from __future__ import annotations

from renders import load, render, save, show
from strips import strip

CROP = (slice(200, 440), slice(90, 410))


def draw() -> None:
    panels = []
    for radius in (0.25, 1, 4, 16):
        exr = render("metallic_ring", 16, width=480, height=480, photon_radius=radius)
        title = f"{radius:g} pixel{'s' if radius > 1 else ''}" + (" (default)" if radius == 1 else "")
        panels.append((title, show(load(exr, "C1")[CROP], 2)))
    save(strip(panels, 2), "radius")
