# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of shading nodes: each file, packed file or generated picture is handed to the engine once."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from .image_files import packed_bytes, path_of

_ALPHA = {"STRAIGHT": "straight", "PREMUL": "premultiplied", "CHANNEL_PACKED": "channel_packed", "NONE": "none"}
_RAW = "Non-Color"  # Blender keeps float pixels scene-linear: no conversion is left to do


class Images:
    """Indices of images in `scene`. Failures are warnings and index -1, which the engine paints magenta.

    spaces: names of the colour spaces of all images so far.
    """

    def __init__(self, scene: Any, frame: int, warnings: list[str]) -> None:
        self._scene, self._frame, self._warnings = scene, frame, warnings
        self._known: dict[tuple[int, str, str], int] = {}
        self.spaces: set[str] = set()

    def params(self, image: Any, user: Any) -> dict[str, Any]:
        """Parameters of a texture node: `image`, and `tiles` (number, index, …) of an image that has them."""
        if image is None or image.source != "TILED":
            return {"image": self.index(image, user)}
        tiles = {tile.number: self.index(image, user, tile.number) for tile in image.tiles}
        found = {number: index for number, index in tiles.items() if index >= 0}
        return {"image": next(iter(found.values()), -1),
                "tiles": [float(v) for pair in found.items() for v in pair]}

    def index(self, image: Any, user: Any, tile: int = 0) -> int:
        if image is None:
            return -1
        path = path_of(image, user, self._frame, tile)
        key = (image.as_pointer(), path, image.colorspace_settings.name)
        if key not in self._known:
            self._known[key] = self._add(image, path, tile)
        return self._known[key]

    def _add(self, image: Any, path: str, tile: int) -> int:
        label = f"Image “{image.name}”" + (f", tile {tile}" if tile else "")
        try:
            desc = self._describe(image, path, tile)
            self.spaces.add(desc["colorspace"])
            return self._scene.add_image(desc)
        except Exception as error:
            self._warnings.append(f"{label}: {error}")
            return -1

    def _describe(self, image: Any, path: str, tile: int) -> dict[str, Any]:
        desc = {"name": image.name, "colorspace": image.colorspace_settings.name,
                "alpha_mode": _ALPHA.get(image.alpha_mode, "straight")}
        # Of tiles, Blender shows the pixels of the first alone.
        first = not tile or tile == image.tiles[0].number
        if image.source in ("GENERATED", "VIEWER") or (image.is_dirty and image.source != "MOVIE" and first):
            return {**desc, **pixels_of(image)}
        packed = packed_bytes(image, path, tile)
        if packed is not None:
            return {**desc, "source": "packed", "packed": packed}
        if tile:
            _require_tile(path, image.is_dirty)
        return {**desc, "source": "file", "path": path}


def _require_tile(path: str, is_dirty: bool) -> None:
    if not os.path.exists(path):
        raise ValueError("it is not saved yet, and left out" if is_dirty or not path
                         else f"there is no “{path}”, it is left out")


def pixels_of(image: Any) -> dict[str, Any]:
    """Keywords of an image that is what Blender has in memory."""
    width, height = image.size
    if width == 0 or height == 0:
        raise ValueError("has no pixels")
    data = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(data)
    desc: dict[str, Any] = {"source": "pixels", "pixels": data.reshape(height, width, image.channels)}
    if image.is_float:
        desc.update(colorspace=_RAW, alpha_mode="premultiplied")
    return desc
