# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiency of an engine over its rival's, scene by scene; error over CPU time; stages' shares of it."""

from __future__ import annotations

from pathlib import Path

from .charts import canvas


def efficiency(rows: list[dict], ours: str, rival: str, path: Path) -> bool:
    """Writes a bar chart of the ratios with quartiles and the bars asked for; False without matplotlib."""
    pyplot = canvas()
    if pyplot is None:
        return False
    chosen = [r for r in rows if r["engine"] == ours and r["mask"] == "all"]
    figure, axes = pyplot.subplots(figsize=(1.6 + 1.3 * max(len(chosen), 2), 4.2), layout="constrained")
    for shift, key, label in ((-0.2, "ratio", "whole process"), (0.2, "ratio_net", "without start-up and export")):
        x = [i + shift for i in range(len(chosen))]
        y = [r[key] for r in chosen]
        spread = [[r[key] - r[f"{key}_low"] for r in chosen], [r[f"{key}_high"] - r[key] for r in chosen]]
        axes.bar(x, y, 0.38, yerr=spread, capsize=3, label=label)
    for i, row in enumerate(chosen):
        axes.plot([i - 0.45, i + 0.45], [row["bar"]] * 2, color="black", linewidth=1.2)
    axes.axhline(1.0, color="grey", linewidth=0.8, linestyle=":")
    axes.set_xticks(range(len(chosen)), [r["scene"].replace("_", "\n") for r in chosen])
    axes.set_ylabel(f"efficiency over {rival}")
    axes.set_title("1 / (relative MSE · CPU seconds), median of pairs; black: the bar")
    axes.legend()
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    return True


STYLES = {"PTPPM": ("#d55e00", "o"), "PT": ("#0072b2", "s"), "SPPM": ("#009e73", "^")}
"""Colours that differ for all kinds of sight."""


def curves(rows: list[dict], path: Path, floors: dict[str, float], figure: str = "rmse", name: str = "RMSE") -> bool:
    """Writes error and energy over CPU seconds, a panel a scene and a line a method; False without matplotlib.

    `floors`: each reference's own expected error. Bands reach from the least to the greatest of the seeds
    (`<figure>_low`, `<figure>_high`).
    """
    pyplot = canvas()
    if pyplot is None:
        return False
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    picture, panels = pyplot.subplots(
        2,
        len(scenes),
        figsize=(3.6 * len(scenes), 4.8),
        squeeze=False,
        sharex="col",
        height_ratios=(3, 1),
        layout="constrained",
    )
    for column, scene in enumerate(scenes):
        upper, lower = panels[:, column]
        for method, (color, mark) in STYLES.items():
            own = [row for row in rows if row["scene"] == scene and row["method"] == method]
            if not own:
                continue
            cpu = [row["cpu"] for row in own]
            low, high = ([row.get(f"{figure}_{end}", row[figure]) for row in own] for end in ("low", "high"))
            upper.fill_between(cpu, low, high, color=color, alpha=0.18, linewidth=0)
            upper.loglog(cpu, [row[figure] for row in own], color=color, marker=mark, markersize=4.5, label=method)
            lower.semilogx(cpu, [100 * (row["energy"] - 1) for row in own], color=color, marker=mark, markersize=3.5)
        if floors.get(scene):
            upper.axhline(floors[scene], color="0.35", linestyle=":", linewidth=1.2, label="reference's own error")
        lower.axhline(0.0, color="0.35", linewidth=0.7)
        upper.set_title(scene, fontsize=11)
        lower.set_xlabel("CPU seconds")
        marks = sorted({row["mark"] for row in rows})
        lower.set_xticks(marks, [f"{mark:g}" for mark in marks])
        lower.set_xticks([], minor=True)
        reach = max(0.5, *(110 * abs(row["energy"] - 1) for row in rows))
        lower.set_ylim(-reach, reach)
        for axes in (upper, lower):
            axes.grid(True, which="both", linewidth=0.3, color="0.8")
            axes.spines[["top", "right"]].set_visible(False)
    panels[0][0].set_ylabel(name)
    panels[1][0].set_ylabel("energy, % off\nthe reference")
    picture.legend(*panels[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=4, frameon=False)
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True


PARTS = {
    "camera": ("path tracing (with gathering in ours)", "#0072b2"),
    "gather": ("gathering", "#56b4e9"),
    "trace": ("photon tracing", "#d55e00"),
    "index": ("indexing", "#e69f00"),
    "learn": ("learning", "#cc79a7"),
    "picture": ("picture", "#999999"),
    "build": ("building the scene", "#444444"),
}


def stages(rows: list[dict], path: Path) -> bool:
    """Writes the stages' shares of each row's time as bars, scene by scene (Table 5.2); False without matplotlib."""
    pyplot = canvas()
    if pyplot is None:
        return False
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    picture, panels = pyplot.subplots(
        1, max(len(scenes), 1), figsize=(3.4 * len(scenes) + 1.2, 3.0), squeeze=False, sharey=True, layout="constrained"
    )
    for scene, axes in zip(scenes, panels[0]):
        own = sorted((row for row in rows if row["scene"] == scene), key=lambda row: row["method"], reverse=True)
        start = [0.0] * len(own)
        for key, (name, color) in PARTS.items():
            values = [100 * (row.get(key) or 0.0) for row in own]
            axes.barh([row["method"] for row in own], values, 0.75, left=start, color=color, label=name)
            start = [a + b for a, b in zip(start, values)]
        axes.set_title(scene, fontsize=11)
        axes.set_xlabel("% of the time")
        axes.set_xlim(0, 100)
        axes.spines[["top", "right"]].set_visible(False)
    picture.legend(
        *panels[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=7, frameon=False, fontsize=8
    )
    picture.savefig(path, dpi=150)
    pyplot.close(picture)
    return True
