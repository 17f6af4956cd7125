# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders to OpenEXR through Blender and reads it back with a reader of our own (uncompressed scanline files)."""

from __future__ import annotations

import struct
from pathlib import Path

import bpy
import numpy as np


def set_exr(scene: bpy.types.Scene, multilayer: bool) -> None:
    """32-bit uncompressed OpenEXR, in the words of this version."""
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE" if multilayer else "IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER" if multilayer else "OPEN_EXR"
    settings.color_depth = "32"
    settings.exr_codec = "NONE"
    if not multilayer:
        settings.color_mode = "RGBA"


def render(path: Path, multilayer: bool = True, scene: bpy.types.Scene | None = None) -> dict[str, np.ndarray]:
    scene = scene or bpy.context.scene
    set_exr(scene, multilayer)
    scene.render.filepath = str(path.with_suffix(".exr"))
    bpy.ops.render.render(write_still=True, scene=scene.name)
    return read(path.with_suffix(".exr"))


def read(path: Path) -> dict[str, np.ndarray]:
    """Channel name to (h, w) floats, bottom row first; single-part or multi-part, uncompressed."""
    data = Path(path).read_bytes()
    flags = struct.unpack_from("<I", data, 4)[0]
    headers, offset = _headers(data, 8, bool(flags & 0x1000))
    channels: dict[str, np.ndarray] = {}
    counts = [header["dataWindow"][3] - header["dataWindow"][1] + 1 for header in headers]
    for header, lines in zip(headers, counts):
        offsets = struct.unpack_from(f"<{lines}Q", data, offset)
        offset += 8 * lines
        channels.update(_part(data, header, offsets, 4 if flags & 0x1000 else 0))
    return channels


def metadata(path: Path) -> dict[str, str]:
    """String attributes of the first header."""
    data = Path(path).read_bytes()
    flags = struct.unpack_from("<I", data, 4)[0]
    header = _headers(data, 8, bool(flags & 0x1000))[0][0]
    return {name: value for name, value in header.items() if isinstance(value, str)}


def _text(data: bytes, offset: int) -> tuple[str, int]:
    end = data.index(b"\0", offset)
    return data[offset:end].decode(), end + 1


def _headers(data: bytes, offset: int, several: bool) -> tuple[list[dict], int]:
    headers = []
    while True:
        header, offset = _header(data, offset)
        if not header:
            return headers, offset
        headers.append(header)
        if not several:
            return headers, offset


def _header(data: bytes, offset: int) -> tuple[dict, int]:
    header = {}
    while data[offset]:
        name, offset = _text(data, offset)
        kind, offset = _text(data, offset)
        size = struct.unpack_from("<I", data, offset)[0]
        value = data[offset + 4:offset + 4 + size]
        offset += 4 + size
        if kind == "box2i":
            header[name] = struct.unpack("<4i", value)
        elif kind == "chlist":
            header[name] = _channel_list(value)
        elif kind == "compression":
            assert value[0] == 0, "only uncompressed files are read"
        elif kind == "string":
            header[name] = value.decode()
    return header, offset + 1


def _channel_list(value: bytes) -> list[tuple[str, int]]:
    listed, offset = [], 0
    while value[offset]:
        name, offset = _text(value, offset)
        listed.append((name, struct.unpack_from("<I", value, offset)[0]))
        offset += 16
    return listed


def _part(data: bytes, header: dict, offsets: tuple[int, ...], part_bytes: int) -> dict[str, np.ndarray]:
    x0, y0, x1, y1 = header["dataWindow"]
    width, height = x1 - x0 + 1, y1 - y0 + 1
    pictures = {name: np.empty((height, width), np.float32) for name, _ in header["channels"]}
    for offset in offsets:
        y = struct.unpack_from("<i", data, offset + part_bytes)[0] - y0
        at = offset + part_bytes + 8
        for name, kind in header["channels"]:
            dtype = {0: np.uint32, 1: np.float16, 2: np.float32}[kind]
            pictures[name][height - 1 - y] = np.frombuffer(data, dtype, width, at)
            at += width * np.dtype(dtype).itemsize
    prefix = header.get("name", "")
    return {name if name.startswith(prefix) or not prefix else f"{prefix}.{name}": picture
            for name, picture in pictures.items()}
