# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/classes.jpg: the five parts of a picture, and their sum."""

from __future__ import annotations

from renders import load, render, save, show
from strips import strip

EXPOSURE = 2.2
BRIGHTER = {"C2": 8}  # a class that would be black in print


def draw() -> None:
    exr = render("cornell", 192, width=400, height=400, use_filter="false", record_clusters="true")
    panels = []
    titles = {
        "D1": "D1  lamps seen",
        "D2": "D2  direct light",
        "D3": "D3  indirect light",
        "C1": "C1  caustics",
        "C2": "C2  indirect caustics",
    }
    for name, title in titles.items():
        times = BRIGHTER.get(name, 1)
        panels.append((title + (f", {times} × brighter" if times > 1 else ""), show(load(exr, name), EXPOSURE * times)))
    panels.append(("their sum, the picture", show(load(exr), EXPOSURE)))
    save(strip(panels, 3), "classes")
