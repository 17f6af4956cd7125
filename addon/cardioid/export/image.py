# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of shading nodes: each file, packed file or generated picture is handed to the engine once."""

from __future__ import annotations

import os
import re
from typing import Any

import bpy
import numpy as np

_ALPHA = {"STRAIGHT": "straight", "PREMUL": "premultiplied", "CHANNEL_PACKED": "channel_packed", "NONE": "none"}
_LIMITS = {"TILED": "tiles (UDIM) are not supported, tile 1001 is used everywhere",
           "MOVIE": "movies are not supported, the frame in memory is used"}
_RAW = "Non-Color"  # Blender keeps float pixels scene-linear: no conversion is left to do


class Images:
    """Indices of images in `scene`. Failures are warnings and index -1, which the engine paints magenta."""

    def __init__(self, scene: Any, frame: int, warnings: list[str]) -> None:
        self._scene, self._frame, self._warnings = scene, frame, warnings
        self._known: dict[tuple[int, str, str], int] = {}

    def index(self, image: Any, user: Any) -> int:
        if image is None:
            return -1
        path = _path(image, user, self._frame)
        key = (image.as_pointer(), path, image.colorspace_settings.name)
        if key not in self._known:
            self._known[key] = self._add(image, path)
        return self._known[key]

    def _add(self, image: Any, path: str) -> int:
        try:
            return self._scene.add_image(self._describe(image, path))
        except Exception as error:
            self._warnings.append(f"Image “{image.name}”: {error}")
            return -1

    def _describe(self, image: Any, path: str) -> dict[str, Any]:
        desc = {"name": image.name, "colorspace": image.colorspace_settings.name,
                "alpha_mode": _ALPHA.get(image.alpha_mode, "straight")}
        if image.source in _LIMITS:
            self._warnings.append(f"Image “{image.name}”: {_LIMITS[image.source]}")
        if image.source in ("GENERATED", "VIEWER", "MOVIE") or image.is_dirty:
            return {**desc, **_pixels(image)}
        packed = _packed(image, path)
        if packed is not None:
            return {**desc, "source": "packed", "packed": packed}
        return {**desc, "source": "file", "path": path}


def _path(image: Any, user: Any, frame: int) -> str:
    """Absolute path of the file for this frame; the library's folder counts for linked images."""
    path = absolute(image.filepath, image.library)
    if image.source == "SEQUENCE" and user is not None:
        return _sequence_path(path, sequence_frame(user, frame))
    if image.source == "TILED":
        return path.replace("<UDIM>", "1001").replace("<UVTILE>", "u1_v1")
    return path


def absolute(path: str, library: Any) -> str:
    """`path` as Blender opens it: // is the folder of the .blend file, and files saved on Windows work elsewhere."""
    return bpy.path.abspath(path if os.sep == "\\" else path.replace("\\", "/"), library=library)


def sequence_frame(user: Any, frame: int) -> int:
    """Number of the file that an image user shows at a scene frame."""
    length = max(user.frame_duration, 1)
    position = frame - user.frame_start + 1
    position = (position - 1) % length + 1 if user.use_cyclic else min(max(position, 1), length)
    return position + user.frame_offset


def _sequence_path(path: str, number: int) -> str:
    """The last run of digits in the file name becomes `number`, at the same width."""
    found = re.search(r"(\d+)(?=[^\d/\\]*$)", path)
    if not found:
        return path
    return f"{path[:found.start()]}{number:0{len(found.group())}d}{path[found.end():]}"


def _packed(image: Any, path: str) -> bytes | None:
    """Bytes of the packed file; of a tiled image or sequence, those of the file that `path` names."""
    files = list(image.packed_files)
    if len(files) > 1:
        name = bpy.path.basename(path)
        files = [f for f in files if bpy.path.basename(f.filepath) == name] or files
    if files:
        return bytes(files[0].packed_file.data)
    return bytes(image.packed_file.data) if image.packed_file else None


def _pixels(image: Any) -> dict[str, Any]:
    width, height = image.size
    if width == 0 or height == 0:
        raise ValueError("has no pixels")
    data = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(data)
    desc: dict[str, Any] = {"source": "pixels", "pixels": data.reshape(height, width, image.channels)}
    if image.is_float:
        desc.update(colorspace=_RAW, alpha_mode="premultiplied")
    return desc
