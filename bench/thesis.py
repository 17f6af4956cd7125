# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the thesis (M. Doidge, 2014) that ours are shown beside: tables 5.1 and 5.2."""

from __future__ import annotations

TABLE_5_1 = {
    "cornell": {"deposited": 4.71e6, "emitted": 52.2e6, "share": 0.090},
    "ring": {"deposited": 5.40e6, "emitted": 37.7e6, "share": 0.143},
    "shapes": {"deposited": 6.22e6, "emitted": 81.1e6, "share": 0.0766},
}
"""PTPPM, five minutes on each scene."""

TABLE_5_2 = {
    ("cornell", "PTPPM"): (1640, 820, 1420.0, 289.0, 70.5, 18.3),
    ("cornell", "PT"): (2034, 0, 1800.0, 0.0, 0.0, 0.0),
    ("cornell", "SPPM"): (0, 1282, 271.0, 479.0, 1040.0, 12.4),
    ("ring", "PTPPM"): (1172, 586, 1410.0, 325.0, 51.5, 12.4),
    ("ring", "PT"): (1446, 0, 1800.0, 0.0, 0.0, 0.0),
    ("ring", "SPPM"): (0, 929, 370.0, 721.0, 689.0, 11.5),
    ("shapes", "PTPPM"): (340, 170, 139.0, 56.3, 32.2, 5.05),
    ("shapes", "PT"): (458, 0, 240.0, 0.0, 0.0, 0.0),
    ("shapes", "SPPM"): (0, 186, 63.5, 80.6, 92.0, 4.85),
}
"""Paths a pixel, photon passes; seconds of path tracing, photon tracing, gathering, picture. 30 minutes; shapes: 4."""


def shares(scene: str, method: str) -> dict[str, float]:
    """The stages' shares of Table 5.2's time."""
    _, _, camera, trace, gather, picture = TABLE_5_2[scene, method]
    total = camera + trace + gather + picture
    return {
        "camera": camera / total,
        "trace": trace / total,
        "gather": gather / total,
        "picture": picture / total,
    }


TABLE_6_1 = {
    "glossy_spheres": {"samples": 16, "equal_samples": 22, "render": 32.7, "rejection": 0.51, "filter": 8.6},
    "bust_in_water": {"samples": 16, "equal_samples": 21, "render": 35.1, "rejection": 0.74, "filter": 7.4},
}
"""Seconds at 768 × 768 on eight threads; `equal_samples`: of plain path tracing in the time of all three."""

TABLE_6_2 = {
    "glossy_spheres": {"clusters": 6.19e6, "singles": 1.67e6, "megabytes": 236.0, "outliers": 0.00109},
    "bust_in_water": {"clusters": 5.56e6, "singles": 1.91e6, "megabytes": 223.0, "outliers": 0.00274},
}
"""Memory with the texture, depth and normal buffers. Scenes and samples as in Table 6.1."""
