# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m bench filter --part pictures`: Figs. 6.6 (clusters across a penumbra), 6.11 (layers before and after
rejection), 6.14 (texture detail), and the methods side by side."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from . import exr, film_reader, filter_methods, filter_runs, filter_scenes, metrics

SAMPLES = 16
LAYERS = ("straight from lamps", "scattered once", "scattered more often")
PENUMBRA = ("coloured_grid", (0.03, 0.42), (0.30, 0.66))
"""Scene, and two points as shares of width and height, from the top left: the line between them crosses shadows."""
SHOWN = ("raw", "cross-bilateral wide", "cross-bilateral narrow", "thesis", "clusters", "OIDN")
OUTLIERS, DETAIL = "bust_in_water", ("glossy_spheres", "bust_in_water")


def shown(picture: np.ndarray, scale: float) -> np.ndarray:
    return metrics.tone_map(picture, scale)


def exposure(picture: np.ndarray) -> float:
    return 0.8 / max(float(np.quantile(picture[..., :3].mean(-1), 0.9)), 1e-9)


def grid(rows: list[list[tuple[str, np.ndarray]]], path: Path) -> None:
    """Writes titled pictures in rows."""
    from matplotlib import pyplot

    across = max(len(row) for row in rows)
    figure, panels = pyplot.subplots(
        len(rows), across, figsize=(3.2 * across, 3.4 * len(rows)), squeeze=False, layout="constrained"
    )
    for row, axes in zip(rows, panels):
        for axis in axes:
            axis.axis("off")
        for (title, picture), axis in zip(row, axes):
            axis.imshow(np.clip(picture, 0, 1), interpolation="nearest")
            axis.set_title(title, fontsize=8)
    figure.savefig(path, dpi=150)
    pyplot.close(figure)
    print(path)


def before_and_after(film: filter_runs.Film, path: Path) -> None:
    """Fig. 6.11: each layer as rendered, after rejection, and what was withheld; every layer at its own exposure."""
    whole, rows = film_reader.read(film.path), []
    for layer, title in enumerate(LAYERS):
        alone = film.path.with_name(f"layer{layer}.cardioid")
        whole.only(layer, alone)
        out = alone.with_suffix(".exr")
        filter_runs.run_filter(film.engine, alone, out, filter_methods.FILTERS["rejection"], film.job.threads)
        raw, withheld = whole.layer(layer), exr.load(out, "Withheld")
        alone.unlink()
        out.unlink()
        scale = exposure(raw) if raw.any() else 1.0
        rows.append(
            [
                (f"{title}: before", shown(raw, scale)),
                ("after", shown(raw - withheld, scale)),
                (f"withheld: {withheld.sum() / max(raw.sum(), 1e-12):.1%}", shown(withheld, scale)),
            ]
        )
    grid(rows, path)


def penumbra(film: filter_runs.Film, path: Path) -> None:
    """Fig. 6.6: clusters of direct light in the pixels on a line: range of luminance, and samples by colour."""
    from matplotlib import pyplot

    whole = film_reader.read(film.path)
    height, width = whole.shape
    (x0, y0), (x1, y1) = PENUMBRA[1:]
    steps = 160
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(12, 4.2), layout="constrained", width_ratios=(1, 2.4))
    picture = exr.load(film.picture("-raw"), "Raw")
    left.imshow(shown(picture, exposure(picture)))
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
    right.set_ylim(bottom=0.02 * right.get_ylim()[1])
    right.set_xlabel("pixels along the line")
    right.set_ylabel("luminance of arriving light")
    right.set_title("clusters of direct light; yellow: all samples of the pixel, violet: one", fontsize=9)
    figure.savefig(path, dpi=130)
    pyplot.close(figure)
    print(path)


def run(options, records, engine, referee_engine) -> int:
    try:
        import matplotlib
    except ImportError:
        print("pictures need matplotlib")
        return 1
    matplotlib.use("Agg")
    details = []
    for name in options.scene or [*DETAIL, PENUMBRA[0]]:
        scene = filter_scenes.SCENES[name]
        job = replace(scene.job(SAMPLES, 1, options.width, options.threads))
        film = filter_runs.Film(records, options.cache, engine, job)
        if film.rendered() is None:
            print(f"{name}: out of time")
            return 1
        if name == OUTLIERS:
            before_and_after(film, options.cache / "filter-layers.png")
        if name == PENUMBRA[0]:
            penumbra(film, options.cache / "filter-penumbra.png")
        if name in DETAIL:
            details.append((name, film_reader.read(film.path).detail() ** (1 / 2.2)))
        compared(options, records, referee_engine, scene, film)
        film.forget()
    if details:
        grid([details], options.cache / "filter-detail.png")
    return 0


def compared(options, records, referee_engine, scene, film: filter_runs.Film) -> None:
    """The methods side by side with the reference."""
    surface = filter_scenes.surface(options.cache, scene, options.width)
    found = filter_methods.of_film(film, surface)
    referee = filter_scenes.referee(records, options.cache, referee_engine, scene, options.width, options.threads)
    if referee is None:
        return
    scale = exposure(referee.mean)
    row = [(name, shown(found[name].pixels, scale)) for name in SHOWN if name in found]
    row.append(("reference", shown(referee.mean, scale)))
    half = -(-len(row) // 2)
    grid([row[:half], row[half:]], options.cache / f"filter-{scene.name}.png")
