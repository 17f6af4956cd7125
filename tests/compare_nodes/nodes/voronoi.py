# SPDX-License-Identifier: GPL-3.0-or-later
"""Voronoi: features, metrics, dimensions, outputs, and the octaves of 4.0 and later."""

from __future__ import annotations

from registry import NOISE, row
from tile import P1, Q1, U1, V1, VEC, scaled

from nodes.noise import DIMENSIONS, place

METRICS = ("EUCLIDEAN", "MANHATTAN", "CHEBYCHEV", "MINKOWSKI")


def outputs(feature: str, size: str) -> tuple[str, ...]:
    if feature in ("DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"):
        return ("Distance",) if feature == "DISTANCE_TO_EDGE" else ("Radius",)
    return ("Distance", "Color", *(("W",) if size in ("1D", "4D") else ()), *(("Position",) if size != "1D" else ()))


for size in DIMENSIONS:
    at = {**place(size), "Scale": 2.1, "Randomness": 0.9}
    for feature in ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"):
        smooth = {"Smoothness": 0.7} if feature == "SMOOTH_F1" else {}
        common = {"voronoi_dimensions": size, "feature": feature, "tolerance": NOISE}
        for output in outputs(feature, size):
            row(f"voronoi/{size}/{feature}/{output}", "TexVoronoi", {**at, **smooth}, output, **common)
        if feature != "N_SPHERE_RADIUS":
            row(f"voronoi/{size}/{feature}/octaves", "TexVoronoi",
                {**at, **smooth, "Detail": 1.6, "Roughness": 0.7, "Lacunarity": 1.9}, "Distance", normalize=True,
                **common)  # fmt: skip
        if size != "1D" and feature in ("F1", "F2", "SMOOTH_F1"):
            for metric in METRICS[1:]:
                row(f"voronoi/{size}/{feature}/{metric}", "TexVoronoi",
                    {**at, **smooth, **({"Exponent": 1.7} if metric == "MINKOWSKI" else {})}, "Distance",
                    distance=metric, **common)  # fmt: skip
    row(f"voronoi/{size}/octaves color", "TexVoronoi", {**at, "Detail": 2.3, "Roughness": 0.4, "Lacunarity": 2.2},
        "Color", voronoi_dimensions=size, tolerance=NOISE)  # fmt: skip
for metric in METRICS:
    row(f"voronoi/normalize {metric}", "TexVoronoi",
        {"Vector": VEC, "Scale": 2.0, "Detail": 1.5, **({"Exponent": 0.6} if metric == "MINKOWSKI" else {})},
        "Distance", distance=metric, normalize=True, feature="F2", tolerance=NOISE)  # fmt: skip
row("voronoi/linked", "TexVoronoi",
    {"Vector": VEC, "Scale": scaled(V1, -1.0, 3.0), "Randomness": scaled(P1, -0.3, 1.3)}, "Distance",
    tolerance=NOISE)  # fmt: skip
row("voronoi/linked octaves", "TexVoronoi",
    {"Vector": VEC, "Scale": 2.0, "Detail": scaled(U1, -1.0, 15.5), "Roughness": scaled(V1, -0.2, 1.2),
     "Lacunarity": scaled(P1, 0.0, 2.2)}, "Distance", tolerance=NOISE)  # fmt: skip
row("voronoi/smoothness", "TexVoronoi", {"Vector": VEC, "Scale": 2.0, "Smoothness": scaled(Q1, -0.2, 1.4)}, "Distance",
    feature="SMOOTH_F1", tolerance=NOISE)  # fmt: skip
row("voronoi/exponent", "TexVoronoi", {"Vector": VEC, "Scale": 2.0, "Exponent": scaled(Q1, 0.0, 32.0)}, "Distance",
    distance="MINKOWSKI", tolerance=NOISE)  # fmt: skip
row("voronoi/regular", "TexVoronoi", {"Vector": VEC, "Scale": 2.03, "Randomness": 0.0}, "Distance", tolerance=NOISE)
