# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the methods for sliders, and Figs. 6.6 (clusters across a penumbra), 6.11 (layers before and after
rejection) and 6.14 (texture detail)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import charts, exr, film_reader, filter_methods, filter_runs, filter_scenes, pictures
from .result import Picture

LAYERS = ("straight from lamps", "scattered once", "scattered more often")
PENUMBRA = (filter_scenes.GRID, (0.03, 0.42), (0.30, 0.66))
"""Scene, and two points as shares of width and height, from the top left: the line between them crosses shadows."""
SHOWN = ("raw", "cross-bilateral wide", "cross-bilateral narrow", "thesis", "clusters", "OIDN", "equal time")
OUTLIERS, DETAIL = filter_scenes.BUST, (filter_scenes.GLOSSY, filter_scenes.BUST)


def shown(picture: np.ndarray, scale: float) -> np.ndarray:
    return pictures.display(picture, scale)


def file_of(scene: str, label: str) -> str:
    return f"{scene}-{label}.png".replace(" ", "_").replace("(", "").replace(")", "")


def singles(
    scene: str, found: dict[str, filter_methods.Picture], reference: np.ndarray, rows: list[dict], place: Path
) -> list[Picture]:
    """Writes each method's picture and the reference at one exposure; `rows` have their figures."""
    scale = pictures.exposure(reference)
    by_method = {row["method"]: row for row in rows}
    out = []
    for name in (name for name in SHOWN if name in found):
        path = file_of(scene, name)
        pictures.save_png(shown(found[name].pixels, scale), place / path)
        row, taken = by_method[name], found[name].samples
        out.append(Picture(scene, name, path, f"{taken} samples", row["cpu"], row["relmse"], row["energy"]))
    path = file_of(scene, "reference")
    pictures.save_png(shown(reference, scale), place / path)
    return [*out, Picture(scene, "reference", path, reference=True)]


def figures(film: filter_runs.Film, scene: filter_scenes.FilterScene, place: Path) -> list[str]:
    """Writes the figures that belong to a scene; their names."""
    if scene.name == OUTLIERS:
        return ["layers.png"] if before_and_after(film, place / "layers.png") else []
    if scene.name == PENUMBRA[0]:
        return ["penumbra.png"] if penumbra(film, place / "penumbra.png") else []
    return []


def detail(film: filter_runs.Film, scene: filter_scenes.FilterScene) -> tuple[str, np.ndarray] | None:
    """What the filter divides by, as a titled picture; for the scenes of Fig. 6.14."""
    if scene.name not in DETAIL or film.rendered() is None:
        return None
    return scene.name.replace("_", " "), film_reader.read(film.path).detail() ** (1 / 2.2)


def grid(rows: list[list[tuple[str, np.ndarray]]], path: Path) -> bool:
    """Writes titled pictures in rows."""
    pictures.sheet(
        [[pictures.Tile(np.clip(shown, 0, 1), title) for title, shown in row] for row in rows], path, width=3.2
    )
    return True


def before_and_after(film: filter_runs.Film, path: Path) -> bool:
    """Fig. 6.11: each layer as rendered, after rejection, and what was withheld; every layer at its own exposure."""
    if film.rendered() is None:
        return False
    whole, rows = film_reader.read(film.path), []
    for layer, title in enumerate(LAYERS):
        alone = film.path.with_name(f"layer{layer}.cardioid")
        whole.only(layer, alone)
        out = alone.with_suffix(".exr")
        filter_runs.run_filter(film.engine, alone, out, filter_methods.FILTERS["rejection"], film.job.threads)
        raw, withheld = whole.layer(layer), exr.load(out, "Withheld")
        alone.unlink()
        out.unlink()
        scale = pictures.exposure(raw) if raw.any() else 1.0
        rows.append(
            [
                (f"{title}: before", shown(raw, scale)),
                ("after", shown(raw - withheld, scale)),
                (f"withheld: {withheld.sum() / max(raw.sum(), 1e-12):.1%}", shown(withheld, scale)),
            ]
        )
    return grid(rows, path)


def penumbra(film: filter_runs.Film, path: Path) -> bool:
    """Fig. 6.6: clusters of direct light in the pixels on a line: range of luminance, and samples by colour."""
    pyplot = charts.canvas()
    if pyplot is None or film.rendered() is None:
        return False
    whole = film_reader.read(film.path)
    height, width = whole.shape
    (x0, y0), (x1, y1) = PENUMBRA[1:]
    steps = 160
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(12, 4.2), layout="constrained", width_ratios=(1, 2.4))
    picture = exr.load(film.picture("-raw"), "Raw")
    left.imshow(shown(picture, pictures.exposure(picture)))
    left.plot([x0 * width, x1 * width], [y0 * height, y1 * height], "w-", linewidth=1.0)
    left.axis("off")
    for step in range(steps):
        share = step / (steps - 1)
        x, y = int((x0 + share * (x1 - x0)) * width), height - 1 - int((y0 + share * (y1 - y0)) * height)
        for cluster in whole.of_pixel(x, y, 0):
            low, high = float(cluster["min"]), float(cluster["max"])
            color = pyplot.cm.viridis(min(int(cluster["samples"]) / film.job.samples, 1.0))
            right.plot([step, step], [low, max(high, low * 1.03)], color=color, linewidth=2.2, solid_capstyle="butt")
    right.set_yscale("log")
    right.set_ylim(bottom=max(0.7 * right.dataLim.ymin, 0.01 * right.dataLim.ymax))
    right.set_xlabel("pixels along the line")
    right.set_ylabel("luminance of arriving light")
    right.set_title("clusters of direct light; yellow: all samples of the pixel, violet: one", fontsize=9)
    figure.savefig(path, dpi=130)
    pyplot.close(figure)
    return True
