# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots and pictures of `convergence`: Fig. 5.11, Fig. 5.14, and each method's pictures to compare."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import pictures, plot, result, verdicts
from .pictures import Tile

ORDER = ("PTPPM", "SPPM", "PT")
ERROR_TOP = 0.1
"""What is shown as the hottest error, as a share of white."""


def add(made: result.Result, cache: Path, scenes, curves: dict, rows: list[dict]) -> None:
    """Writes what can be drawn and names it in the result."""
    where = result.folder(cache, made.name)
    where.mkdir(parents=True, exist_ok=True)
    for figure, name in verdicts.NAMES.items():
        file = f"fig-5-11-{figure}.png"
        floors = {scene.name: scene.error["all"] for scene in scenes} if figure == "rmse" else {}
        if plot.curves(rows, where / file, floors, figure, name):
            made.plots.append(file)
        else:
            made.missing.append(f"{file}: matplotlib is not there")
    if made.missing:
        return
    for index, scene in enumerate(scenes):
        own = {method: curves[index, method] for method in ORDER if (index, method) in curves}
        if not own:
            continue
        file = f"fig-5-14-{scene.name}.png"
        over_time(scene, own, where / file)
        made.plots.append(file)
        made.pictures += shown_pictures(scene, own, where)


def over_time(scene, own: dict[str, list[list[dict]]], path: Path) -> None:
    """Fig. 5.14: pictures at equal CPU seconds, a row a method, and below their errors pixel by pixel."""
    scale = pictures.exposure(scene.shown())
    marks = sorted({point["mark"] for one in own.values() for point in one[0]})
    images, errors = [], []
    for curves in own.values():
        points = {point["mark"]: point for point in curves[0]}
        images.append([image_tile(points.get(mark), scale) for mark in marks])
        errors.append([error_tile(points.get(mark), scene, scale) for mark in marks])
    for tile, mark in zip(images[0], marks):
        tile.title = f"{mark:g} CPU s"
    names = [*own, *(f"{name}: error" for name in own)]
    pictures.sheet([*images, *errors], path, names)


def image_tile(point: dict | None, scale: float) -> Tile:
    if point is None:
        return Tile(None)
    return Tile(pictures.display(point["picture"], scale), "", f"{point['cpu']:.1f} s, {point['samples']} samples")


def error_tile(point: dict | None, scene, scale: float) -> Tile:
    """|y − r| on the mean of the channels; black where pixels are not compared."""
    if point is None:
        return Tile(None)
    difference = np.abs(point["picture"].mean(-1) - scene.reference.mean(-1)) * scene.masks["all"]
    below = f"RMSE {point['rmse']:.4f}, energy {point['energy']:.3f}"
    return Tile(pictures.heat(difference * scale, ERROR_TOP), "", below)


def shown_pictures(scene, own: dict[str, list[list[dict]]], where: Path) -> list[result.Picture]:
    """PNG files of the first seed at the first and the last mark, and the reference."""
    scale = pictures.exposure(scene.shown())
    file = f"{scene.name}-reference.png"
    pictures.save_png(pictures.display(scene.reference, scale), where / file)
    out = [result.Picture(scene.name, "reference", file, reference=True)]
    for method, curves in own.items():
        for point in dict.fromkeys((0, len(curves[0]) - 1)):
            p = curves[0][point]
            file = f"{scene.name}-{method}-{p['mark']:g}.png"
            pictures.save_png(pictures.display(p["picture"], scale), where / file)
            label = f"{method}, {p['mark']:g} CPU s"
            settings = f"{p['samples']} samples"
            out.append(result.Picture(scene.name, label, file, settings, p["cpu"], p["relmse"], p["energy"]))
    return out
