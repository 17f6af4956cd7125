# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/integrators.jpg: the ring by the three integrators in about the same CPU time."""

from __future__ import annotations

from renders import cpu, load, render, save, show
from strips import strip

CROP = (slice(180, 460), slice(70, 450))
RUNS = (
    ("Path Tracing", "path_tracing", 40, {"caustic_roughness": 0}),
    ("Path Tracing + Photons", "hybrid", 24, {}),
    ("Photon Mapping", "photon_mapping", 16, {}),
)


def draw() -> None:
    panels = []
    for title, integrator, samples, settings in RUNS:
        exr = render("metallic_ring", samples, width=480, height=480, integrator=integrator, **settings)
        panels.append((f"{title}, {cpu(exr):.0f} CPU s", show(load(exr)[CROP], 1.6)))
    save(strip(panels), "integrators")
