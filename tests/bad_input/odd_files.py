# SPDX-License-Identifier: GPL-3.0-or-later
"""Picture files that no program here writes: PNG of odd kinds and a CMYK TIFF, byte by byte."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
GREY, RGB = 0, 2


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(path: Path, width: int, height: int, pixel: bytes, *, bits: int = 8, color: int = RGB) -> Path:
    """Every pixel is `pixel`, as many bytes as `bits` and `color` ask for."""
    rows = (b"\0" + pixel * width) * height
    header = struct.pack(">IIBBBBB", width, height, bits, color, 0, 0, 0)
    path.write_bytes(_SIGNATURE + _chunk(b"IHDR", header) + _chunk(b"IDAT", zlib.compress(rows)) + _chunk(b"IEND", b""))
    return path


def cmyk_tiff(path: Path, width: int, height: int, ink: tuple[int, int, int, int]) -> Path:
    """Uncompressed, one strip, every pixel with these inks (0…255)."""
    data = bytes(ink) * (width * height)
    start = 8 + 2 + 12 * 11 + 4  # behind the header and a table of eleven entries
    short, long = 3, 4
    # Little endian: a short value in a field of four bytes is written as if it were a long one.
    entries = [(256, short, 1, width), (257, short, 1, height), (258, short, 4, start), (259, short, 1, 1),
               (262, short, 1, 5), (273, long, 1, start + 8), (277, short, 1, 4), (278, short, 1, height),
               (279, long, 1, len(data)), (284, short, 1, 1), (332, short, 1, 1)]
    table = b"".join(struct.pack("<HHII", *entry) for entry in entries)
    head = b"II*\0" + struct.pack("<IH", 8, len(entries)) + table + struct.pack("<I", 0)
    path.write_bytes(head + struct.pack("<4H", 8, 8, 8, 8) + data)
    return path
