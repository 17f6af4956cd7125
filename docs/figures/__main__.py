# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of the documentation: ./scripts/docs figures [NAME ...]

Drawings need matplotlib alone. Pictures are renders of scenes/ by cardioid-render: CARDIOID_RENDER names it, or it is
taken from build/release.
"""

from __future__ import annotations

import importlib
import sys

FIGURES = (
    "path_classes",
    "photon_pass",
    "radius_shrink",
    "cluster_drawing",
    "class_pictures",
    "integrator_pictures",
    "guiding_pictures",
    "radius_pictures",
    "filter_pictures",
)


def main(names: list[str]) -> int:
    unknown = [name for name in names if name not in FIGURES]
    if unknown:
        print(f"no such figure: {', '.join(unknown)}; there are {', '.join(FIGURES)}")
        return 2
    for name in names or FIGURES:
        print(name, flush=True)
        importlib.import_module(name).draw()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
