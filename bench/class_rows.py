# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of `classes`: light, error and estimator of each class in each method."""

from __future__ import annotations

import numpy as np

from . import metrics
from .class_verdicts import CLASSES

OWNERS = {
    "PT": dict.fromkeys(CLASSES, "camera paths"),
    "PTPPM": dict.fromkeys(CLASSES, "camera paths") | {"C1": "photons and camera paths, weighed"},
    "SPPM": dict.fromkeys(CLASSES, "photons") | {"D1": "camera paths"},
}
"""engine_cpp/path/partition.h with the add-on's defaults."""
COLUMNS = {
    "scene": ["scene", ""],
    "method": ["method", ""],
    "class": ["class", ""],
    "by": ["estimated by", ""],
    "cpu": ["CPU s", ".1f"],
    "samples": ["samples", "d"],
    "noise": ["relMSE by scatter", ".5f"],
    "noise_share": ["of all error", ".1%"],
    "energy": ["energy over path tracing's", ".4f"],
    "share": ["of the light", ".2%"],
    "photons": ["of it by photons", ".1%"],
}
NOTE = (
    "Equal CPU seconds, two seeds. Error: the scatter of the seeds over the whole picture's brightness; it sees no "
    "bias. Energy sees it: the class's mean over that of path tracing with eight times the samples, whose noise is "
    "in it too. Photons' share: from the film of the first seed, which keeps what they bring apart."
)


def error(pictures: list, plane: str, whole: np.ndarray) -> float:
    """relMSE of one picture of a class by the scatter of several, over the brightness of the whole; 0 with one."""
    stack = np.array([one.planes[plane].mean(-1) for one in pictures], np.float64)
    return float((stack.var(0, ddof=1) / (whole * whole + metrics.EPSILON)).mean()) if len(stack) > 1 else 0.0


def of_scene(scene) -> list[dict]:
    """A row a method and class, and one of the sum."""
    rows = []
    truth = {name: np.mean([one.planes[name].mean() for one in scene.long]) for name in (*CLASSES, "Combined")}
    whole = np.mean([one.planes["Combined"] for one in scene.long], 0).mean(-1)
    for method, pictures in scene.methods.items():
        squares = {name: error(pictures, name, whole) for name in (*CLASSES, "Combined")}
        means = {name: float(np.mean([one.planes[name].mean() for one in pictures])) for name in squares}
        parts = sum(squares[name] for name in CLASSES)
        for name in squares:
            row = {"scene": scene.name, "method": method, "class": name, "by": OWNERS[method].get(name, "")}
            row |= {"cpu": float(np.mean([one.cpu for one in pictures])), "samples": pictures[0].samples}
            row |= {"noise": squares[name], "energy": float(means[name] / max(truth[name], 1e-12))}
            row |= {"share": means[name] / max(means["Combined"], 1e-12)}
            if name in CLASSES:
                row["noise_share"] = squares[name] / max(parts, 1e-30)
            row["photons"] = photon_share(method, name, pictures[0])
            rows.append(row)
    return rows


def photon_share(method: str, name: str, picture) -> float | None:
    """Which share of a class's light photons brought; None where the film does not tell classes apart."""
    if picture.photons is None:
        return None
    if name == "Combined" or (method == "PTPPM" and name == "C1"):
        return float(picture.photons.mean() / max(picture.planes[name].mean(), 1e-12))
    return 1.0 if OWNERS[method][name] == "photons" else 0.0
