# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise, Musgrave, White Noise and Gabor."""

from __future__ import annotations

from registry import NOISE, row
from tile import P1, Q1, U1, V1, VEC, WHOLE, P, Q, U, V, op, scaled

DIMENSIONS = ("1D", "2D", "3D", "4D")
TYPES = ("MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "FBM", "HETERO_TERRAIN")


def place(size: str, w=U) -> dict:
    """Where a texture of so many dimensions is looked up."""
    return {"1D": {"W": w}, "4D": {"Vector": VEC, "W": Q}}.get(size, {"Vector": VEC})


for size in DIMENSIONS:
    at = place(size)
    common = {"noise_dimensions": size, "tolerance": NOISE}
    for detail in (0.0, 3.4):
        for output in ("Fac", "Color"):
            row(f"noise/{size}/{output}/detail {detail:g}", "TexNoise",
                {**at, "Scale": 2.3, "Detail": detail, "Roughness": 0.6}, output, **common)  # fmt: skip
    row(f"noise/{size}/distortion", "TexNoise", {**at, "Scale": 1.3, "Detail": 2.0, "Distortion": 0.8}, **common)
    row(f"noise/{size}/linked", "TexNoise",
        {**at, "Scale": scaled(V1, -1.0, 3.0), "Detail": scaled(U1, -1.0, 16.0), "Roughness": scaled(P1, -0.2, 1.2)},
        **common)  # fmt: skip
    for kind in TYPES:
        for normalize in (False, True) if kind == "FBM" else (True,):
            row(f"noise/{size}/{kind}{'' if normalize else ' raw'}", "TexNoise",
                {**at, "Scale": 2.0, "Detail": 2.7, "Roughness": 0.7, "Lacunarity": 1.8,
                 **({"Offset": 0.3} if "RIDGED" in kind or "HYBRID" in kind or "HETERO" in kind else {}),
                 **({"Gain": 1.4} if "RIDGED" in kind or "HYBRID" in kind else {})},
                noise_type=kind, normalize=normalize, **common)  # fmt: skip
        row(f"musgrave/{size}/{kind}", "TexMusgrave",
            {**at, "Scale": 2.0, "Detail": 3.4, "Dimension": 0.8, "Lacunarity": 1.9,
             **({"Offset": 0.3} if kind not in ("MULTIFRACTAL", "FBM") else {}),
             **({"Gain": 1.4} if "RIDGED" in kind or "HYBRID" in kind else {})},
            musgrave_dimensions=size, musgrave_type=kind, tolerance=NOISE)  # fmt: skip
    row(f"noise/{size}/color type", "TexNoise", {**at, "Scale": 2.0, "Lacunarity": 2.2}, "Color",
        noise_type="HYBRID_MULTIFRACTAL", **common)  # fmt: skip
    whole = place(size, op("ROUND", op("MULTIPLY", U, 5.0)))
    whole = {"1D": whole, "4D": {"Vector": WHOLE, "W": 0.75}}.get(size, {"Vector": WHOLE})
    for output in ("Value", "Color"):
        row(f"white noise/{size}/{output}", "TexWhiteNoise", whole, output, noise_dimensions=size)
row("noise/far away", "TexNoise", {"Vector": VEC, "Scale": -300.0}, tolerance=NOISE)
row("noise/linked lacunarity", "TexNoise",
    {"Vector": VEC, "Scale": 2.0, "Detail": 4.0, "Lacunarity": scaled(P1, 0.0, 3.0)}, tolerance=NOISE)  # fmt: skip
row("noise/no vector", "TexNoise", {"Scale": 3.0}, tolerance=NOISE, floor=0.5, stage="placed")
row("musgrave/linked", "TexMusgrave",
    {"Vector": VEC, "Scale": 2.0, "Detail": scaled(U1, -1.0, 9.0), "Dimension": scaled(V1, 0.0, 2.0),
     "Lacunarity": scaled(P1, 0.0, 2.2)}, tolerance=NOISE)  # fmt: skip
row("musgrave/ridged linked", "TexMusgrave",
    {"Vector": VEC, "Detail": scaled(U1, -1.0, 15.0), "Dimension": P, "Offset": V, "Gain": Q},
    musgrave_type="RIDGED_MULTIFRACTAL", tolerance=NOISE)  # fmt: skip

for size in ("2D", "3D"):
    turn = "Orientation 2D" if size == "2D" else "Orientation 3D"
    for output in ("Value", "Phase", "Intensity"):
        row(f"gabor/{size}/{output}", "TexGabor",
            {"Vector": VEC, "Scale": 2.2, "Frequency": 1.7, "Anisotropy": 0.8}, output, gabor_type=size,
            tolerance=NOISE)  # fmt: skip
    row(f"gabor/{size}/linked", "TexGabor",
        {"Vector": VEC, "Scale": 1.5, "Frequency": scaled(Q1, -0.5, 3.0), "Anisotropy": scaled(P1, -0.2, 1.2)}, "Value",
        gabor_type=size, tolerance=NOISE)  # fmt: skip
    row(f"gabor/{size}/turned", "TexGabor",
        {"Vector": VEC, turn: 1.1 if size == "2D" else (0.3, -0.8, 0.5), "Anisotropy": 1.0}, "Value", gabor_type=size,
        tolerance=NOISE)  # fmt: skip
