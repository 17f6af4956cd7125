# SPDX-License-Identifier: GPL-3.0-or-later
"""Gradient, Wave, Magic, Checker, Brick, Radial Tiling, and the old mapping panel of textures."""

from __future__ import annotations

from registry import NOISE, row
from tile import COL, COL2, P1, Q1, U1, V1, VEC, P, Q, U, V, scaled

for kind in ("LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "SPHERICAL", "QUADRATIC_SPHERE", "RADIAL"):
    row(f"gradient/{kind}", "TexGradient", {"Vector": VEC}, "Fac", gradient_type=kind)
row("gradient/color", "TexGradient", {"Vector": VEC}, "Color")
row("gradient/no vector", "TexGradient", None, "Fac", stage="placed", floor=1.0)

for depth in range(11):
    row(f"magic/depth {depth}", "TexMagic", {"Vector": VEC, "Scale": 1.3, "Distortion": 1.3}, "Color",
        turbulence_depth=depth, tolerance=NOISE)  # fmt: skip
row("magic/fac", "TexMagic", {"Vector": VEC, "Scale": 2.0}, "Fac", tolerance=NOISE)
row("magic/linked", "TexMagic", {"Vector": VEC, "Scale": V, "Distortion": P}, "Color", tolerance=NOISE,
    turbulence_depth=3)  # fmt: skip

for kind, ways in (("BANDS", ("X", "Y", "Z", "DIAGONAL")), ("RINGS", ("X", "Y", "Z", "SPHERICAL"))):
    for way in ways:
        for profile in ("SIN", "SAW", "TRI"):
            row(f"wave/{kind}/{way}/{profile}", "TexWave",
                {"Vector": VEC, "Scale": 1.2, "Distortion": 0.0 if profile == "TRI" else 1.5, "Phase Offset": 0.4},
                "Fac", wave_type=kind, wave_profile=profile, tolerance=NOISE,
                **{f"{kind.lower()}_direction": way})  # fmt: skip
row("wave/linked", "TexWave",
    {"Vector": VEC, "Scale": scaled(V1, 0.2, 2.0), "Distortion": P, "Detail": scaled(U1, 0.0, 15.0),
     "Detail Scale": scaled(Q1, -1.0, 3.0), "Detail Roughness": scaled(P1, 0.0, 1.0), "Phase Offset": Q}, "Color",
    tolerance=NOISE)  # fmt: skip

checker = {"Vector": VEC, "Color1": COL, "Color2": (0.1, 0.8, 0.2)}
row("checker/color", "TexChecker", {**checker, "Scale": 3.3}, "Color")
row("checker/fac", "TexChecker", {**checker, "Scale": 3.3}, "Fac")
row("checker/linked", "TexChecker", {**checker, "Scale": scaled(Q1, -3.0, 5.0)}, "Color")
row("checker/negative", "TexChecker", {**checker, "Scale": -1.7}, "Fac")

brick = {"Vector": VEC, "Color1": COL, "Color2": COL2, "Mortar": (0.3, 0.3, 0.5), "Scale": 1.7}
row("brick/color", "TexBrick", brick, "Color")
row("brick/fac", "TexBrick", {**brick, "Mortar Size": 0.1}, "Fac")
row("brick/smooth", "TexBrick", {**brick, "Mortar Size": 0.1, "Mortar Smooth": 0.8}, "Fac")
row("brick/no smooth", "TexBrick", {**brick, "Mortar Size": 0.1, "Mortar Smooth": 0.0}, "Color")
for bias in (-1.0, -0.3, 0.7, 1.0):
    row(f"brick/bias {bias}", "TexBrick", {**brick, "Bias": bias}, "Color", offset=0.3, offset_frequency=3, squash=0.6,
        squash_frequency=2)  # fmt: skip
row("brick/squash 1", "TexBrick", {**brick, "Brick Width": 0.7, "Row Height": 0.4}, "Color", squash=1.8,
    squash_frequency=1, offset_frequency=1)  # fmt: skip
row("brick/linked", "TexBrick",
    {**brick, "Mortar Size": scaled(P1, 0.0, 0.125), "Mortar Smooth": scaled(Q1, 0.0, 1.0), "Bias": scaled(U1, -1, 1),
     "Brick Width": scaled(V1, 0.1, 1.0)}, "Color")  # fmt: skip

tiling = {"Vector": VEC, "Sides": 5.0, "Roundness": 0.3}
for output in ("Segment Coordinates", "Segment ID", "Segment Width", "Segment Rotation"):
    row(f"radial tiling/{output}", "RadialTiling", tiling, output)
    row(f"radial tiling/{output}/normalize", "RadialTiling", tiling, output, normalize=True)
row("radial tiling/linked", "RadialTiling", {"Vector": VEC, "Sides": scaled(P1, 2.0, 9.0), "Roundness": Q1})


def panel(kind: str, axes: str = "XYZ"):
    def setup(node) -> None:
        mapping = node.texture_mapping
        mapping.vector_type = kind
        mapping.translation, mapping.rotation, mapping.scale = (0.3, -0.2, 0.5), (0.4, -0.7, 1.1), (1.5, 0.7, -1.2)
        mapping.mapping_x, mapping.mapping_y, mapping.mapping_z = axes

    return setup


for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL"):
    row(f"texture mapping/{kind}", "TexGradient", {"Vector": VEC}, "Fac", setup=panel(kind), gradient_type="DIAGONAL")
row("texture mapping/axes", "TexWave", {"Vector": VEC, "Scale": 0.6}, "Fac", setup=panel("POINT", "ZXY"),
    tolerance=NOISE)  # fmt: skip
row("texture mapping/no axis", "TexMagic", {"Vector": VEC, "Scale": 0.6}, "Color",
    setup=lambda node: setattr(node.texture_mapping, "mapping_y", "NONE"), tolerance=NOISE)  # fmt: skip
row("magic/by u", "TexMagic", {"Vector": U, "Scale": 2.0}, "Color", tolerance=NOISE)
