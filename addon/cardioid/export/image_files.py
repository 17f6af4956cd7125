# SPDX-License-Identifier: GPL-3.0-or-later
"""Which file an image shows: libraries, sequences by frame, tiles, movies."""

from __future__ import annotations

import os
import re
from typing import Any

import bpy

_TOKENS = ("<UDIM>", "<UVTILE>")


def path_of(image: Any, user: Any, frame: int, tile: int = 0) -> str:
    """Absolute path of the file for this scene frame; the library's folder counts for linked images. A movie's ends in
    #frame=N, N from 0. `tile` is the number of a tile of a tiled image."""
    path = absolute(image.filepath, image.library)
    if image.source == "TILED":
        return tile_path(path, tile)
    if image.source in ("SEQUENCE", "MOVIE") and user is not None:
        number = sequence_frame(user, frame)
        if image.source == "SEQUENCE":
            return _sequence_path(path, number)
        last = max(image.frame_duration, 1) - 1
        return f"{path}#frame={min(max(number - 1, 0), last)}"
    return path


def absolute(path: str, library: Any) -> str:
    """`path` as Blender opens it: // is the folder of the .blend file, and files saved on Windows work elsewhere."""
    return bpy.path.abspath(path if os.sep == "\\" else path.replace("\\", "/"), library=library)


def sequence_frame(user: Any, frame: int) -> int:
    """Number of the file, or of the frame of a movie from 1, that an image user shows at a scene frame."""
    length = max(user.frame_duration, 1)
    position = frame - user.frame_start + 1
    position = (position - 1) % length + 1 if user.use_cyclic else min(max(position, 1), length)
    return position + user.frame_offset


def tile_path(path: str, number: int) -> str:
    """The file of tile `number` (1001 + u + 10 v)."""
    u, v = (number - 1001) % 10 + 1, (number - 1001) // 10 + 1
    for token, text in zip(_TOKENS, (str(number), f"u{u}_v{v}")):
        path = path.replace(token, text)
    return path


def _sequence_path(path: str, number: int) -> str:
    """The last run of digits in the file name becomes `number`, at the same width."""
    found = re.search(r"(\d+)(?=[^\d/\\]*$)", path)
    if not found:
        return path
    return f"{path[:found.start()]}{number:0{len(found.group())}d}{path[found.end():]}"


def packed_bytes(image: Any, path: str, tile: int = 0) -> bytes | None:
    """Bytes of the packed file; of a tiled image or sequence, those of the file that `path` names."""
    files = [f for f in image.packed_files if f.packed_file is not None]
    if tile and len(files) > 1:
        files = [f for f in files if getattr(f, "tile_number", 0) == tile] or _named(files, path)
    elif len(files) > 1:
        files = _named(files, path) or files
    if files:
        return bytes(files[0].packed_file.data)
    return bytes(image.packed_file.data) if image.packed_file and not tile else None


def _named(files: list[Any], path: str) -> list[Any]:
    name = bpy.path.basename(path)
    return [f for f in files if bpy.path.basename(f.filepath) == name]
