# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots of rays, memory, nodes and the filter. Each writes a PNG file and returns False without matplotlib."""

from __future__ import annotations

from pathlib import Path

OURS, THEIRS, THIRD = "#c2491d", "#3b6ea5", "#6b8f3a"
"""Cardioid; Cycles or the thesis; a third."""


def canvas():
    """matplotlib.pyplot without a screen; None without matplotlib."""
    try:
        import matplotlib
    except ImportError:
        return None
    matplotlib.use("Agg")
    from matplotlib import pyplot

    return pyplot


def tidy(axes) -> None:
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(True, axis="x", linewidth=0.4, color="0.85")
    axes.set_axisbelow(True)


def grouped(axes, groups: list[str], series: dict[str, list[float | None]], form: str) -> None:
    """Horizontal bars: a group a line of text, a bar a series in it, its value at its end."""
    height = 0.8 / len(series)
    for index, (name, values) in enumerate(series.items()):
        at = [i + (index - (len(series) - 1) / 2) * height for i in range(len(groups))]
        color = (OURS, THEIRS, THIRD)[index % 3]
        drawn = axes.barh(at, [value or 0.0 for value in values], height * 0.92, color=color, label=name)
        labels = [format(value, form) if value else "" for value in values]
        axes.bar_label(drawn, labels, padding=3, fontsize=8)
    axes.set_yticks(range(len(groups)), groups)
    axes.invert_yaxis()
    axes.margins(x=0.16)
    tidy(axes)


def bars(rows: list[dict], figures: dict[str, str], path: Path, form: str = ".2e") -> bool:
    """A panel for each figure (key → title): scenes down, a bar for each engine (`who`)."""
    pyplot = canvas()
    if pyplot is None:
        return False
    scenes, names = (list(dict.fromkeys(row[key] for row in rows)) for key in ("scene", "who"))
    size = (4.9 * len(figures) + 1.0, 1.3 + 0.75 * len(scenes))
    picture, panels = pyplot.subplots(1, len(figures), figsize=size, squeeze=False, sharey=True, layout="constrained")
    by = {(row["scene"], row["who"]): row for row in rows}
    for axes, (key, title) in zip(panels[0], figures.items()):
        series = {name: [by.get((scene, name), {}).get(key) for scene in scenes] for name in names}
        grouped(axes, [scene.replace("_", " ") for scene in scenes], series, form)
        axes.set_title(title, fontsize=10)
    panels[0][0].invert_yaxis() if len(figures) > 1 and len(figures) % 2 == 0 else None
    picture.legend(
        *panels[0][0].get_legend_handles_labels(), loc="outside lower center", ncols=len(names), frameon=False
    )
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True


def memory(rows: list[dict], sizes: list[dict], path: Path) -> bool:
    """Left: bytes a triangle and a pixel by engine. Right: Table 6.2's megabytes, ours and the thesis's."""
    pyplot = canvas()
    if pyplot is None:
        return False
    picture, (left, right) = pyplot.subplots(1, 2, figsize=(11, 3.0), layout="constrained")
    if rows:
        keys = {"per_triangle": "a triangle", "per_pixel": "a pixel"}
        grouped(left, list(keys.values()), {row["who"]: [row[key] for key in keys] for row in rows}, ".0f")
        left.legend(frameon=False, fontsize=8, loc="lower right")
    left.set_title("bytes", fontsize=10)
    scenes = list(dict.fromkeys(row["scene"] for row in sizes))
    by = {(row["scene"], row["who"]): row["megabytes"] for row in sizes}
    series = {who: [by.get((scene, who)) for scene in scenes] for who in ("ours", "thesis")}
    grouped(right, [scene.replace("_", " ") for scene in scenes], series, ".0f")
    right.set_title("MB of clusters with their buffers, 768², 16 samples", fontsize=10)
    right.legend(frameon=False, fontsize=8, loc="lower right")
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True
