# SPDX-License-Identifier: GPL-3.0-or-later
"""What a render did, in numbers: metadata of the picture and the table of --cardioid-print-stats.

A figure has one name everywhere, "photons.stored" say: the path of its key in the engine's statistics.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy

from . import core, progress
from .settings_table import k_integrators

k_labels = {row[3]: row[0] for row in k_integrators.values()}


@dataclass(frozen=True)
class Figure:
    """name: path of the key. value: as in the metadata. text: for people."""

    name: str
    label: str
    value: str
    text: str


def _whole(number: int) -> tuple[str, str]:
    return str(number), f"{number:,}".replace(",", " ")


def _seconds(number: float) -> tuple[str, str]:
    return f"{number:.3f}", f"{number:.2f} s"


def _share(number: float) -> tuple[str, str]:
    return f"{number:.6f}", f"{100 * number:.2f} %"


def _bytes(number: int) -> tuple[str, str]:
    return str(number), progress.memory(number)


k_figures = (
    # path of the key, label, words
    ("photons.passes", "Photon passes", _whole),
    ("photons.skipped_passes", "Photon passes with nothing to catch", _whole),
    ("photons.training_passes", "Passes that guide photons", _whole),
    ("photons.per_sample", "Photons for a sample", _whole),
    ("photons.emitted", "Photons emitted", _whole),
    ("photons.stored", "Photons stored", _whole),
    ("photons.stored_share", "Stored of emitted", _share),
    ("photons.gathered", "Photons gathered", _whole),
    ("photons.rays", "Photon rays", _whole),
    ("seconds.photon_trace", "Photon tracing", _seconds),
    ("seconds.photon_index", "Photon index", _seconds),
    ("seconds.camera", "Camera paths and gathering", _seconds),
    ("bytes.photons", "Memory of photons", _bytes),
    ("filter.seconds", "Noise filter, last run", _seconds),
    ("filter.clusters", "Clusters of light", _whole),
    ("filter.singles", "Clusters of one sample", _whole),
    ("filter.outlier_share", "Clusters withheld", _share),
    ("filter.withheld_share", "Light withheld", _share),
    ("counts.non_finite_dropped", "Samples dropped as not finite", _whole),
)


def figures(entry: dict[str, Any]) -> list[Figure]:
    """The figures of one rendered frame, layer and view (`entry` as in --cardioid-stats) that its engine has told."""
    found = _of_render(entry) if "settings" in entry else []  # a film that was opened does not know its render
    engine = {**_with_share(entry.get("engine", {})), "filter": _of_filter(entry)}
    for name, label, words in k_figures:
        group, key = name.split(".")
        value = engine.get(group, {}).get(key)
        if value is not None:
            found.append(Figure(name, label, *words(value)))
    return found


def _of_render(entry: dict[str, Any]) -> list[Figure]:
    settings = entry["settings"]
    spent = entry["export_seconds"] + entry["render_seconds"]
    return [
        Figure("integrator", "Integrator", settings["integrator"], k_labels.get(settings["integrator"], "")),
        Figure("samples", "Samples", *_whole(entry["samples"])),
        Figure("seed", "Seed", str(settings["seed"]), str(settings["seed"])),
        Figure("render_time", "Time with export", f"{spent:.2f}", f"{spent:.2f} s"),
    ]


def _with_share(engine: dict[str, Any]) -> dict[str, Any]:
    """Table 5.1's last column beside the counts that it comes from."""
    photons = engine.get("photons", {})
    if not photons.get("emitted"):
        return engine
    return {**engine, "photons": {**photons, "stored_share": photons.get("stored", 0) / photons["emitted"]}}


def _of_filter(entry: dict[str, Any]) -> dict[str, Any]:
    """What the filter did for the picture; empty when it did nothing."""
    stats = filter_stats(entry)
    return stats if stats.get("seconds") else {}


def table(entry: dict[str, Any]) -> str:
    """The figures as lines for a terminal."""
    rows = figures(entry)
    width = max(len(one.label) for one in rows)
    view = f", view {entry['view']}" if entry["view"] else ""
    lines = [f"Cardioid: frame {entry['frame']}, layer {entry['layer']}{view}"]
    return "\n".join(lines + [f"  {one.label:<{width}}  {one.text}" for one in rows])


def stamp(engine: bpy.types.RenderEngine, layer: str, entry: dict[str, Any]) -> None:
    """Metadata that Blender writes into the saved picture."""
    result = engine.get_result()
    if result is None:
        return
    result.stamp_data_add_field("cardioid.version", core.versions().get("engine", ""))
    for one in figures(entry):
        result.stamp_data_add_field(f"cardioid.{layer}.{one.name}", one.value)


def filter_stats(entry: dict[str, Any]) -> dict[str, Any]:
    """The filter's own figures: of the last filtering since the render, or else the render's."""
    return entry.get("filter") or entry.get("engine", {}).get("filter", {})


def filter_lines(stats: dict[str, Any], samples: int, settings: dict[str, Any]) -> list[str]:
    """What the filter did, for the panel."""
    lines = [f"{samples} samples"]
    if not settings.get("use_filter"):
        return [*lines, "Not filtered"]
    seconds = stats.get("elapsed", stats.get("seconds"))
    if seconds:
        lines.append(f"Filtered in {seconds:.1f} s")
    if "withheld_share" in stats:
        lines.append(f"Withheld: {100 * stats['withheld_share']:.2f} % of the light")
    return lines
