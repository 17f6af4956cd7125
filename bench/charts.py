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
    axes.margins(x=0.16)
    tidy(axes)


def bars(rows: list[dict], figures: dict[str, str], path: Path, form: str = ".2f", unit: float = 1.0) -> bool:
    """A panel for each figure (key → title), in units: scenes down, a bar for each engine (`who`)."""
    pyplot = canvas()
    if pyplot is None:
        return False
    scenes, names = (list(dict.fromkeys(row[key] for row in rows)) for key in ("scene", "who"))
    size = (4.9 * len(figures) + 1.0, 1.3 + 0.75 * len(scenes))
    picture, panels = pyplot.subplots(1, len(figures), figsize=size, squeeze=False, sharey=True, layout="constrained")
    by = {(row["scene"], row["who"]): row for row in rows}
    for axes, (key, title) in zip(panels[0], figures.items()):
        series = {name: [(by.get((scene, name), {}).get(key) or 0.0) / unit for scene in scenes] for name in names}
        grouped(axes, [scene.replace("_", " ") for scene in scenes], series, form)
        axes.set_title(title, fontsize=10)
    panels[0][0].invert_yaxis()
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
    picture, (left, right) = pyplot.subplots(1, 2, figsize=(11, 3.3), layout="constrained")
    if rows:
        keys = {"per_triangle": "a triangle", "per_pixel": "a pixel"}
        grouped(left, list(keys.values()), {row["who"]: [row[key] for key in keys] for row in rows}, ".0f")
    left.set_title("bytes", fontsize=10)
    left.invert_yaxis()
    right.invert_yaxis()
    scenes = list(dict.fromkeys(row["scene"] for row in sizes))
    by = {(row["scene"], row["who"]): row["megabytes"] for row in sizes}
    series = {who: [by.get((scene, who)) for scene in scenes] for who in ("ours", "thesis")}
    grouped(right, [scene.replace("_", " ") for scene in scenes], series, ".0f")
    right.set_title("MB of clusters with their buffers, 768², 16 samples", fontsize=10)
    for axes in (left, right):
        axes.legend(frameon=False, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2)
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True


STYLES = {
    "raw": ("0.45", "o-", 1.4),
    "equal time": ("0.1", "x", 1.4),
    "cross-bilateral wide": ("#56b4e9", "s-", 1.2),
    "cross-bilateral narrow": ("#0072b2", "s-", 1.2),
    "thesis": ("#009e73", "^-", 1.2),
    "clusters": ("#d55e00", "o-", 2.4),
    "OIDN": ("#cc79a7", "D-", 1.2),
    "clusters, OIDN": ("#8e5a9e", "D:", 1.2),
}
"""Colour, mark and line, width of a method of the filter; others are not drawn."""


def methods(rows: list[dict], path: Path) -> bool:
    """Error over samples above, over CPU seconds below; a column a scene, a line a method."""
    pyplot = canvas()
    if pyplot is None:
        return False
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    size = (3.5 * len(scenes) + 0.6, 6.6)
    picture, panels = pyplot.subplots(2, len(scenes), figsize=size, squeeze=False, sharey="col", layout="constrained")
    for column, scene in enumerate(scenes):
        for key, title, axes in zip(("taken", "cpu"), ("samples", "CPU seconds, filter included"), panels[:, column]):
            for method, (color, style, width) in STYLES.items():
                own = [r for r in rows if r["scene"] == scene and r["method"] == method and r["relmse"] > 0]
                points = [r[key] for r in own], [r["relmse"] for r in own]
                axes.loglog(*points, style, color=color, linewidth=width, markersize=4.5, label=method)
            axes.set_xlabel(title)
            axes.grid(True, which="major", linewidth=0.4, color="0.85")
            axes.spines[["top", "right"]].set_visible(False)
        counts = sorted({row["samples"] for row in rows if row["scene"] == scene})
        panels[0][column].set_xticks(counts, [str(count) for count in counts])
        panels[0][column].set_xticks([], minor=True)
        panels[0][column].set_title(scene.replace("_", " "), fontsize=11)
    for axes in panels[:, 0]:
        axes.set_ylabel("relMSE")
    picture.legend(*panels[0][0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False)
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True


def rejection(rows: list[dict], path: Path) -> bool:
    """Fig. 6.10: seconds of rejection, and the share of samples it takes away, over n."""
    pyplot = canvas()
    if pyplot is None:
        return False
    picture, (left, right) = pyplot.subplots(1, 2, figsize=(9.5, 3.4), layout="constrained")
    for index, scene in enumerate(dict.fromkeys(row["scene"] for row in rows)):
        own = [row for row in rows if row["scene"] == scene]
        style = {
            "color": (OURS, THEIRS, THIRD)[index % 3],
            "marker": "o",
            "markersize": 4,
            "label": scene.replace("_", " "),
        }
        left.semilogx([row["n"] for row in own], [row["seconds"] for row in own], **style)
        right.semilogx([row["n"] for row in own], [100 * row["rejected"] for row in own], **style)
    for axes, title in ((left, "seconds of rejection"), (right, "samples rejected, %")):
        counts = sorted({row["n"] for row in rows})
        axes.set_xticks(counts, [str(count) for count in counts])
        axes.set_xticks([], minor=True)
        axes.set_ylim(bottom=0)
        axes.set_xlabel("n: like samples that a cluster needs")
        axes.set_title(title, fontsize=10)
        tidy(axes)
        axes.grid(True, linewidth=0.4, color="0.85")
    left.legend(frameon=False, fontsize=8)
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True


def vanishing(rows: list[dict], path: Path) -> bool:
    """Errors of the raw and the filtered picture, and how far they are apart, over samples."""
    pyplot = canvas()
    if pyplot is None:
        return False
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    picture, panels = pyplot.subplots(
        1, len(scenes), figsize=(4.8 * len(scenes), 3.6), squeeze=False, layout="constrained"
    )
    for scene, axes in zip(scenes, panels[0]):
        own = [row for row in rows if row["scene"] == scene]
        for key, name, color in (
            ("raw", "raw", "0.45"),
            ("filtered", "filtered", OURS),
            ("apart", "between them", THEIRS),
        ):
            points = [(row["samples"], row[key]) for row in own if row[key] > 0]
            axes.loglog(*zip(*points), "o-", color=color, markersize=4, label=name)
        counts = [row["samples"] for row in own]
        axes.set_xticks(counts, [str(count) for count in counts])
        axes.set_xticks([], minor=True)
        axes.set_xlabel("samples")
        axes.set_title(scene.replace("_", " "), fontsize=11)
        axes.grid(True, linewidth=0.4, color="0.85")
        axes.spines[["top", "right"]].set_visible(False)
    panels[0][0].set_ylabel("relMSE")
    panels[0][0].legend(frameon=False)
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True


def nodes(rows: list[dict], path: Path) -> bool:
    """Nanoseconds of a point beyond a plain one's, a line of bars for each material."""
    pyplot = canvas()
    if pyplot is None:
        return False
    picture, axes = pyplot.subplots(figsize=(9, 1.1 + 0.5 * len(rows)), layout="constrained")
    series = {"Cardioid": [row["cardioid_ns"] for row in rows], "Cycles": [row["cycles_ns"] for row in rows]}
    grouped(axes, [row["material"] for row in rows], series, ".0f")
    axes.invert_yaxis()
    axes.set_xlabel("CPU nanoseconds of a shading point, beyond a plain diffuse plane's")
    axes.legend(frameon=False, loc="lower right")
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True
