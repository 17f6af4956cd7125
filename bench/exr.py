# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as float32 (h, w, 3), top row first."""

from __future__ import annotations

from pathlib import Path

import numpy as np


def load(path: Path, layer: str = "") -> np.ndarray:
    """R, G and B of a layer of an EXR file; without one, of the picture itself: `R` or `ViewLayer.Combined.R`."""
    import OpenEXR

    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        return np.stack([np.asarray(channels[channel(list(channels), layer, c)].pixels, np.float32) for c in "RGB"], -1)


def channels(path: Path) -> dict[str, np.ndarray]:
    """All planes of an EXR file by their names, as float32 (h, w)."""
    import OpenEXR

    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: np.asarray(plane.pixels, np.float32) for name, plane in file.channels().items()}


def channel(names: list[str], layer: str, color: str) -> str:
    """The name of a layer's colour among a file's channels. A plain R is the picture; `C1.R` is not."""
    ends = [f"{layer}.{color}"] if layer else [color, f"Combined.{color}"]
    for name in names:
        if name in ends or (name.endswith("." + ends[-1])):
            return name
    raise KeyError(f"no channel {' or '.join(ends)} among {', '.join(names)}")


def save(path: Path, pixels: np.ndarray) -> None:
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": np.ascontiguousarray(pixels[..., :3], dtype=np.float32)}) as file:
        file.write(str(path))
