# SPDX-License-Identifier: GPL-3.0-or-later
"""Linear pictures as PNG files, one exposure for all pictures of a scene, and sheets of many with titles.

Pictures are (h, w, 3) float, top row first. Display: sRGB's curve under a shoulder that bends what is brighter than 0.7
of white, so that the inside of a caustic is not burnt out; the same for every renderer.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

SHOULDER = 0.7
DPI = 150


def exposure(reference: np.ndarray, share: float = 0.8, level: float = 0.5) -> float:
    """The factor that puts the reference's quantile at `share` to `level` of white, linear."""
    return level / max(float(np.quantile(reference[..., :3].mean(-1), share)), 1e-9)


def display(linear: np.ndarray, scale: float) -> np.ndarray:
    """In [0, 1], to be shown as it is."""
    x = np.clip(np.nan_to_num(linear[..., :3].astype(np.float64) * scale), 0.0, None)
    over = (x - SHOULDER) / (1.0 - SHOULDER)
    x = np.where(x > SHOULDER, SHOULDER + (1.0 - SHOULDER) * np.tanh(np.maximum(over, 0.0)), x)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1 / 2.4) - 0.055).astype(np.float32)


def heat(values: np.ndarray, top: float) -> np.ndarray:
    """Values from 0 to `top` in matplotlib's inferno, (h, w, 3)."""
    from matplotlib import colormaps

    return colormaps["inferno"](np.clip(values / top, 0.0, 1.0))[..., :3].astype(np.float32)


def save_png(shown: np.ndarray, path: Path) -> None:
    """Writes a picture in [0, 1]."""
    from PIL import Image

    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.round(np.clip(shown, 0.0, 1.0) * 255).astype(np.uint8)).save(path, optimize=True)


@dataclass
class Tile:
    """One picture of a sheet; `shown` in [0, 1]; None leaves its place empty."""

    shown: np.ndarray | None
    title: str = ""
    below: str = ""


def sheet(rows: list[list[Tile]], path: Path, names: list[str] | None = None, width: float = 1.75) -> None:
    """Writes rows of pictures of one size with titles above, figures below and the rows' names at the left; `width`: of
    a picture, in inches."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    across = max(len(row) for row in rows)
    shape = next(tile.shown.shape for row in rows for tile in row if tile.shown is not None)
    tall = width * shape[0] / shape[1] + (0.28 if any(t.title or t.below for row in rows for t in row) else 0.05)
    figure, panels = pyplot.subplots(
        len(rows), across, figsize=(width * across + 0.35, tall * len(rows) + 0.1), squeeze=False, layout="constrained"
    )
    figure.get_layout_engine().set(w_pad=0.015, h_pad=0.015, wspace=0.01, hspace=0.01)
    for index, (row, axes) in enumerate(zip(rows, panels)):
        for axis in axes:
            axis.set(xticks=[], yticks=[])
            axis.spines[:].set_visible(False)
        for tile, axis in zip(row, axes):
            if tile.shown is None:
                continue
            axis.imshow(tile.shown, interpolation="nearest")
            axis.set_title(tile.title, fontsize=7.5, pad=2.5)
            axis.set_xlabel(tile.below, fontsize=7, labelpad=2.0)
        if names:
            axes[0].set_ylabel(names[index], fontsize=8.5, fontweight="bold")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=DPI)
    pyplot.close(figure)
