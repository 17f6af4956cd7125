# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as float32 (h, w, 3), top row first."""

from __future__ import annotations

from pathlib import Path

import numpy as np


def load(path: Path) -> np.ndarray:
    """R, G and B of an EXR file, by the first of each channel name's last part (`ViewLayer.Combined.R`)."""
    import OpenEXR

    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        found = {}
        for name in channels:
            found.setdefault(name.rsplit(".", 1)[-1], np.asarray(channels[name].pixels, np.float32))
        return np.stack([found[c] for c in "RGB"], -1)


def save(path: Path, pixels: np.ndarray) -> None:
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": np.ascontiguousarray(pixels[..., :3], dtype=np.float32)}) as file:
        file.write(str(path))
