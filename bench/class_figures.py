# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of `classes`: 5.1 (with and without caustics), 5.3 (classes), 5.5 (where photons land), the two halves."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import pictures, result
from .class_verdicts import CLASSES
from .pictures import Tile

NAMES = {
    "D1": "D1: emission, highlights",
    "D2": "D2: direct light",
    "D3": "D3: indirect light",
    "C1": "C1: caustics",
    "C2": "C2: indirect caustics",
}
MOST_GAIN = 64
NOT_CAUSTIC, CAUSTIC = CLASSES[:3], CLASSES[3:]


def add(out: result.Result, cache: Path, scene) -> None:
    """Writes a scene's sheets and single pictures and names them in the result."""
    where = result.folder(cache, out.name)
    where.mkdir(parents=True, exist_ok=True)
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        out.missing.append(f"{scene.name}: no pictures without matplotlib")
        return
    best = scene.methods["PTPPM"][0].planes
    scale = pictures.exposure(best["Combined"])
    gains = {name: gain(best[name], scale) for name in CLASSES}
    for file, draw in (
        (f"fig-5-1-{scene.name}.png", lambda path: with_and_without(scene, scale, path)),
        (f"fig-5-3-{scene.name}.png", lambda path: by_class(scene, scale, gains, path)),
        (f"halves-{scene.name}.png", lambda path: halves(scene, scale, path)),
        (f"fig-5-5-{scene.name}.png", lambda path: deposits(scene, path)),
    ):
        if draw(where / file):
            out.plots.append(file)
    out.pictures += singles(scene, scale, gains, where)


def gain(plane: np.ndarray, scale: float) -> int:
    """A power of two that makes a dim class visible; 1 for one that is bright or black."""
    bright = float(np.quantile(plane.mean(-1), 0.9)) * scale
    return 1 if bright <= 0 else int(np.clip(2.0 ** np.floor(np.log2(0.5 / bright)), 1, MOST_GAIN))


def times(value: int) -> str:
    return f" × {value}" if value > 1 else ""


def with_and_without(scene, scale: float, path: Path) -> bool:
    """Fig. 5.1: path tracing, the same without C1 and C2, many samples; and the hybrid in the time of the first."""
    short, hybrid = scene.methods["PT"][0], scene.methods["PTPPM"][0]
    long = np.mean([one.planes["Combined"] for one in scene.long], 0)
    seconds, samples = sum(one.cpu for one in scene.long), sum(one.samples for one in scene.long)
    without = sum(short.planes[name] for name in NOT_CAUSTIC)
    mean = long.mean()
    row = []
    for title, plane, cpu, count in (
        ("path tracing", short.planes["Combined"], short.cpu, short.samples),
        ("the same without C1, C2", without, short.cpu, short.samples),
        ("path tracing, long", long, seconds, samples),
        ("PTPPM", hybrid.planes["Combined"], hybrid.cpu, hybrid.samples),
    ):
        below = f"{cpu:.1f} CPU s, {count} samples, energy {plane.mean() / mean:.3f}"
        row.append(Tile(pictures.display(plane, scale), title, below))
    pictures.sheet([row], path, width=2.5)
    return True


def by_class(scene, scale: float, gains: dict[str, int], path: Path) -> bool:
    """Fig. 5.3: a row a method, a column a class, and the sum."""
    rows = []
    for number, found in enumerate(scene.methods.values()):
        whole = found[0].planes["Combined"].mean()
        row = []
        for name in CLASSES:
            plane = found[0].planes[name]
            title = NAMES[name] + times(gains[name]) if number == 0 else ""
            below = f"{plane.mean() / whole:.1%} of the light"
            row.append(Tile(pictures.display(plane, scale * gains[name]), title, below))
        title, below = "sum" if number == 0 else "", f"{found[0].cpu:.1f} CPU s, {found[0].samples} samples"
        row.append(Tile(pictures.display(found[0].planes["Combined"], scale), title, below))
        rows.append(row)
    pictures.sheet(rows, path, list(scene.methods), width=1.9)
    return True


def halves(scene, scale: float, path: Path) -> bool:
    """What camera paths and photons bring to the hybrid's picture."""
    one = scene.methods["PTPPM"][0]
    if one.photons is None:
        return False
    whole = one.planes["Combined"]
    row = []
    for title, plane in (("camera paths", whole - one.photons), ("photons", one.photons), ("PTPPM", whole)):
        row.append(Tile(pictures.display(plane, scale), title, f"{plane.mean() / whole.mean():.1%} of the light"))
    pictures.sheet([row], path, width=3.0)
    return True


def deposits(scene, path: Path) -> bool:
    """Fig. 5.5: photons one by one as the camera finds them, log scale, the same for all."""
    if not scene.deposits:
        return False
    lit = np.concatenate([light[light > 0] for light, _ in scene.deposits.values()])
    middle = float(np.quantile(lit, 0.5)) if lit.size else 1.0
    row = []
    for name, (light, counted) in scene.deposits.items():
        share = counted["stored"] / max(counted["emitted"], 1)
        below = f"{counted['stored']:,} deposited, {share:.0%} of {counted['emitted']:,}"
        row.append(Tile(pictures.heat(np.log1p(np.maximum(light, 0.0) / middle), 4.0), name, below))
    pictures.sheet([row], path, width=3.0)
    return True


def singles(scene, scale: float, gains: dict[str, int], where: Path) -> list[result.Picture]:
    """PNG files: each class by each method, and the pictures themselves; those of one class compare."""
    truth = {name: np.mean([one.planes[name].mean() for one in scene.long]) for name in (*CLASSES, "Combined")}
    out = []
    for method, found in scene.methods.items():
        for name in (*CLASSES, "Combined"):
            own = gains.get(name, 1)
            file = f"{scene.name}-{method}-{name}.png"
            plane = found[0].planes[name]
            pictures.save_png(pictures.display(plane, scale * own), where / file)
            title = f"{scene.name}, {NAMES.get(name, 'sum of the classes')}{times(own)}"
            energy = float(plane.mean() / truth[name]) if truth[name] > 0 else None
            out.append(result.Picture(title, method, file, f"{found[0].samples} samples", found[0].cpu, None, energy))
    return out
