# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the path classes are parts of a whole: they add up, each is made by whom it should be, none loses light."""

from __future__ import annotations

import numpy as np

from .result import Verdict

CLASSES = ("D1", "D2", "D3", "C1", "C2")
ROUNDING = 4
"""Units of float32's last place (2⁻²³ of a value) that a sum of five may be off."""
UNIT = 2.0**-23
SIGMAS, BIAS = 3.0, 0.01


def all_of(scenes: list, rows: list[dict]) -> list[Verdict]:
    """For the scenes that were measured; nothing without any."""
    if not scenes:
        return []
    return [sums(scenes), owners(scenes), *energies(scenes), *caustic_noise(rows)]


def excess(planes: dict[str, np.ndarray]) -> float:
    """The largest difference between the sum of the classes and the picture, in units of the classes' last place."""
    whole = sum(planes[name].astype(np.float64) for name in CLASSES)
    size = sum(np.abs(planes[name].astype(np.float64)) for name in CLASSES)
    return float((np.abs(whole - planes["Combined"]) / np.maximum(size * UNIT, 1e-30)).max())


def sums(scenes: list) -> Verdict:
    """Of every pixel and colour of every picture."""
    pictures = [one for scene in scenes for found in (*scene.methods.values(), scene.long) for one in found]
    worst = max(excess(one.planes) for one in pictures)
    figures = f"{len(pictures)} pictures, at most {worst:.2g} units of the last place of float32"
    return Verdict("D1 + D2 + D3 + C1 + C2 is the picture, to float rounding", "thesis 5.4", worst <= ROUNDING, figures)


def beyond(value: np.ndarray, low: np.ndarray, high: np.ndarray, size: np.ndarray) -> float:
    """How far a part leaves its bounds, over the mean of the whole."""
    over = np.maximum(np.maximum(low - value, value - high), 0.0)
    return float(over.max() / max(size.mean(), 1e-12))


def stray(method: str, picture) -> float:
    """How far the photons' part is from what the method gives them, over the picture's mean: all but D1 in SPPM,
    nothing in path tracing, between nothing and C1 in the hybrid."""
    planes, part = picture.planes, picture.photons
    zero = np.zeros_like(planes["C1"])
    if method == "SPPM":
        theirs = sum(planes[name] for name in CLASSES[1:])
        return beyond(part, theirs, theirs, planes["Combined"])
    return beyond(part, zero, planes["C1"] if method == "PTPPM" else zero, planes["Combined"])


def owners(scenes: list) -> Verdict:
    claim = "photons bring nothing in PT, only C1 in PTPPM, all but D1 in SPPM, pixel by pixel"
    known = [
        (scene.name, method, stray(method, found[0]))
        for scene in scenes
        for method, found in scene.methods.items()
        if found[0].photons is not None
    ]
    if not known:
        return Verdict(claim, "thesis 5.4", None, "no film was kept")
    name, method, worst = max(known, key=lambda one: one[2])
    figures = f"at most {worst:.1e} of the mean beside it ({name}, {method})"
    return Verdict(claim, "thesis 5.4", worst <= 1e-3, figures)


def scatter(pictures: list, plane: str) -> float:
    """Squared standard error of the mean of a plane, by the difference of two pictures, as if pixels were independent:
    photons that several pixels share make it somewhat too small."""
    if len(pictures) < 2:
        return 0.0
    spread = np.array([one.planes[plane].mean(-1) for one in pictures], np.float64).var(0, ddof=1)
    return float(spread.mean() / spread.size / len(pictures))


def energies(scenes: list) -> list[Verdict]:
    return [energy(scene, method) for scene in scenes for method in ("PTPPM", "SPPM")]


def energy(scene, method: str) -> Verdict:
    """Each class's light against that by long path tracing; SPPM is biased while its radii are wide."""
    pictures, said, holds = scene.methods[method], [], True
    whole = np.mean([one.planes["Combined"].mean() for one in scene.long])
    for name in CLASSES:
        ours, theirs = (np.mean([one.planes[name].mean() for one in found]) for found in (pictures, scene.long))
        if theirs <= 0.0:
            continue
        error = np.sqrt(scatter(pictures, name) + scatter(scene.long, name))
        fits = abs(ours - theirs) <= SIGMAS * error + BIAS * theirs
        holds = holds and fits
        said.append(f"{name} {ours / theirs:.3f} ± {error / theirs:.3f}" + ("" if fits else " (off)"))
    total = np.mean([one.planes["Combined"].mean() for one in pictures]) / whole
    claim = f"{scene.name}: every class has as much light by {method} as by path tracing"
    figures = f"{', '.join(said)}; all {total:.4f} (within {SIGMAS:g} standard errors and {BIAS:.0%})"
    return Verdict(claim, "thesis 5.4: no overlap, no gap", bool(holds), figures)


def caustic_noise(rows: list[dict]) -> list[Verdict]:
    """Thesis 5.1: caustics hold path tracing's noise; and what the hybrid makes of them."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = {(row["method"], row["class"]): row for row in rows if row["scene"] == scene}
        caustic = {method: sum(own[method, name]["noise"] for name in ("C1", "C2")) for method in ("PT", "PTPPM")}
        share = sum(own["PT", name]["noise_share"] for name in ("C1", "C2"))
        light = sum(own["PT", name]["share"] for name in ("C1", "C2"))
        claim = f"{scene}: caustic paths hold most of path tracing's error (relMSE)"
        out.append(Verdict(claim, "thesis 5.1, Fig. 5.3", share > 0.5, f"{share:.1%}, with {light:.1%} of the light"))
        ratio = caustic["PTPPM"] / max(caustic["PT"], 1e-30)
        claim = f"{scene}: PTPPM's error of caustics is under path tracing's in the same CPU seconds"
        out.append(Verdict(claim, "thesis 5.4, Fig. 5.3", ratio < 1.0, f"{ratio:.3g} of it"))
    return out
