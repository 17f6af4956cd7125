# SPDX-License-Identifier: GPL-3.0-or-later
"""Plot and pictures of `peers`."""

from __future__ import annotations

from pathlib import Path

from . import exr, pictures, result

OURS, FILTERED, OTHER = "#d55e00", "#009e73", "#0072b2"
"""Colours that differ for all kinds of sight."""


def add(made: result.Result, where: Path, scenes, figures: dict[tuple, list[dict]], rows: list[dict], known) -> None:
    """Writes what can be drawn and names it in the result."""
    try:
        if rows:
            for mark in sorted({row["mark"] for row in rows}):
                file = f"peers-{mark:g}.png"
                errors([row for row in rows if row["mark"] == mark], where / file, mark)
                made.plots.append(file)
        for scene in scenes:
            made.pictures += shown(scene, figures, where, known)
    except ImportError as error:
        made.missing.append(f"plots and pictures: {error.name} is not there (scripts/setup bench)")


def errors(rows: list[dict], path: Path, mark: float) -> None:
    """A panel a scene, a line a renderer, on a logarithmic axis: relMSE of the picture (full) and of the caustics
    (hollow), best first; the energy ratio stands beside."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    tall = max(sum(row["scene"] == scene for row in rows) for scene in scenes)
    size = (5.0 * len(scenes), 1.2 + 0.27 * tall)
    figure, panels = pyplot.subplots(1, len(scenes), figsize=size, squeeze=False, layout="constrained", sharex=True)
    for scene, axes in zip(scenes, panels[0]):
        own = [row for row in rows if row["scene"] == scene]
        for line, row in enumerate(own):
            color = OURS if row["ours"] else FILTERED if row["filtered"] else OTHER
            low, high = sorted((row["relmse"], row["relmse_caustic"]))
            axes.plot([low, high], [line, line], color=color, linewidth=1.0, alpha=0.5)
            axes.plot(row["relmse"], line, "o", color=color, markersize=6.5)
            axes.plot(row["relmse_caustic"], line, "o", color=color, markersize=6.5, markerfacecolor="white")
            faded = {"fontsize": 7, "color": "0.35", "transform": axes.get_yaxis_transform()}
            axes.text(1.01, line, f"{row['energy']:.3f}", va="center", **faded)
        axes.text(1.01, -1, "energy", va="center", fontsize=7, color="0.35", transform=axes.get_yaxis_transform())
        axes.set(xscale="log", title=scene, xlabel="relMSE: ● picture, ○ caustics")
        axes.set_yticks(range(len(own)), [row["title"] for row in own], fontsize=8)
        axes.set_ylim(len(own) - 0.4, -1.4)
        axes.grid(True, axis="x", which="both", linewidth=0.3, color="0.8")
        axes.spines[["top", "right"]].set_visible(False)
    figure.suptitle(f"Error at {mark:g} CPU seconds; orange: ours, green: with a denoiser", fontsize=10)
    figure.savefig(path, dpi=130)
    pyplot.close(figure)


def shown(scene, figures: dict[tuple, list[dict]], where: Path, known) -> list[result.Picture]:
    """PNG files of every renderer's first seed, and the reference."""
    scale = pictures.exposure(scene.shown())
    file = f"{scene.name}-reference.png"
    pictures.save_png(pictures.display(scene.reference, scale), where / file)
    out = [result.Picture(scene.name, "reference", file, reference=True)]
    for (name, mark, key), values in figures.items():
        if name != scene.name:
            continue
        one, file = values[0], f"{name}-{key}-{mark:g}.png"
        pictures.save_png(pictures.display(exr.load(Path(one["path"])), scale), where / file)
        label, settings = f"{known[key].title}, {mark:g} CPU s", f"{one['samples']:.0f} samples; {known[key].words}"
        out.append(result.Picture(name, label, file, settings, one["cpu"], one["relmse"], one["energy"]))
    return out
