# SPDX-License-Identifier: GPL-3.0-or-later
"""A box with a chrome and a glass sphere, for lights so large that camera paths find their caustics by themselves."""

import common as c


def box(open_top: bool) -> None:
    """Two metres wide, seen from -y; an open top lets a sky in."""
    c.start(256, 256)
    white = c.material("white", "BsdfDiffuse", Color=(0.75, 0.75, 0.75))
    red = c.material("red", "BsdfDiffuse", Color=(0.63, 0.065, 0.05))
    green = c.material("green", "BsdfDiffuse", Color=(0.14, 0.45, 0.091))
    c.quad("floor", (0, 0, 0), (1, 0, 0), (0, 1, 0), white)
    c.quad("back", (0, 1, 1), (1, 0, 0), (0, 0, 1), white)
    c.quad("left", (-1, 0, 1), (0, 1, 0), (0, 0, 1), red)
    c.quad("right", (1, 0, 1), (0, -1, 0), (0, 0, 1), green)
    if not open_top:
        c.quad("ceiling", (0, 0, 2), (-1, 0, 0), (0, 1, 0), white)
    chrome = c.material("chrome", "BsdfGlossy", Color=(0.9, 0.9, 0.9), Roughness=0.0, distribution="SHARP")
    glass = c.material("glass", "BsdfGlass", Color=(1, 1, 1), Roughness=0.0, IOR=1.5, distribution="SHARP")
    c.sphere("chrome", (-0.43, 0.3, 0.402), 0.4, chrome)
    c.sphere("glass", (0.43, -0.25, 0.402), 0.4, glass)
    c.world((0.6, 0.75, 1.0) if open_top else (0, 0, 0), 1.0 if open_top else 0.0)
    c.camera((0, -3.9, 1.0), (0, 0, 1.0), 50)
