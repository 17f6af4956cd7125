# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads film files (engine_cpp/film/film_file.cpp, version 1) for plots of clusters, pictures of layers and detail."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MAGIC, VERSION, BLOCK, LAYERS = b"CARDFLM\n", 1, 8, 3
HEADER = struct.Struct("<8sIIQQ")
PIXEL = np.dtype(
    [
        ("radiance", "<f4", (5, 3)),
        ("unfiltered", "<f4", 3),
        ("detail", "<f4", 3),
        ("mirrored_detail", "<f4", 4),
        ("feature_normal", "<f4", 3),
        ("feature_depth", "<f4", 2),
        ("alpha_depth", "<f4", 2),
        ("normal", "<f4", 3),
        ("samples", "<u4"),
    ]
)
CLUSTER = np.dtype(
    [
        ("radiance", "<f4", 3),
        ("incident", "<f4"),
        ("radiance_squared", "<f4"),
        ("min", "<f4"),
        ("max", "<f4"),
        ("samples", "<u4"),
    ]
)


def checksum(data: bytes) -> int:
    """As scene/checksum.h, of a whole file's bytes."""
    mask, state, held = (1 << 64) - 1, 0x243F6A8885A308D3, len(data) % 8
    words = np.frombuffer(data + bytes(8 - held), "<u8").tolist()
    for word in words:
        state = ((((state << 23) | (state >> 41)) & mask) ^ word) * 0x9E3779B97F4A7C15 & mask
        state ^= state >> 32
    return state ^ held


@dataclass
class FilmFile:
    """`pixels` (h, w), bottom row first; `counts` (blocks, 192) of clusters in each list; `clusters` list by list."""

    contents: dict
    pixels: np.ndarray
    between: bytes
    counts: np.ndarray
    clusters: np.ndarray

    @property
    def shape(self) -> tuple[int, int]:
        return self.pixels.shape

    def lists(self) -> np.ndarray:
        """Number of the list of each cluster, (y · w + x) · 3 + layer, with blocks padded to whole ones."""
        return np.repeat(np.arange(self.counts.size), self.counts.ravel())

    def place(self, x: int, y: int, layer: int) -> int:
        columns = -(-self.shape[1] // BLOCK)
        block = y // BLOCK * columns + x // BLOCK
        return block * BLOCK * BLOCK * LAYERS + (y % BLOCK * BLOCK + x % BLOCK) * LAYERS + layer

    def of_pixel(self, x: int, y: int, layer: int) -> np.ndarray:
        ends = np.cumsum(self.counts.ravel(), dtype=np.int64)
        place = self.place(x, y, layer)
        return self.clusters[ends[place] - self.counts.ravel()[place] : ends[place]]

    def detail(self) -> np.ndarray:
        """D̂ (h, w, 3), top row first."""
        taken = np.maximum(self.pixels["samples"], 1)[..., None]
        return (self.pixels["detail"] / taken)[::-1]

    def layer(self, layer: int) -> np.ndarray:
        """The layer's mean radiance (h, w, 3), top row first."""
        height, width = self.shape
        rows, columns = -(-height // BLOCK), -(-width // BLOCK)
        sums = np.zeros((self.counts.size, 3))
        np.add.at(sums, self.lists(), self.clusters["radiance"])
        blocks = sums.reshape(rows, columns, BLOCK, BLOCK, LAYERS, 3)[..., layer, :]
        picture = blocks.transpose(0, 2, 1, 3, 4).reshape(rows * BLOCK, columns * BLOCK, 3)[:height, :width]
        return (picture / np.maximum(self.pixels["samples"], 1)[..., None])[::-1]

    def only(self, layer: int, path: Path) -> None:
        """Writes the film with the clusters of one layer alone."""
        chosen = self.lists() % LAYERS == layer
        counts = np.where(np.arange(self.counts.shape[1]) % LAYERS == layer, self.counts, 0).astype(np.uint8)
        text = json.dumps(self.contents).encode()
        text += b" " * (-len(text) % 16)
        data = HEADER.pack(MAGIC, VERSION, 0, len(text), int(chosen.sum())) + text + self.pixels.tobytes()
        data += self.between + counts.tobytes() + self.clusters[chosen].tobytes()
        path.write_bytes(data + struct.pack("<Q", checksum(data)))


def read(path: Path) -> FilmFile:
    data = path.read_bytes()
    magic, version, _, length, total = HEADER.unpack_from(data)
    if magic != MAGIC or version != VERSION:
        raise ValueError(f"{path} is no film file of version {VERSION}")
    contents = json.loads(data[HEADER.size : HEADER.size + length])
    _, _, width, height = contents["region"]
    at = HEADER.size + length
    pixels = np.frombuffer(data, PIXEL, width * height, at).reshape(height, width)
    blocks = -(-width // BLOCK) * -(-height // BLOCK)
    end = len(data) - 8 - total * CLUSTER.itemsize
    start = end - blocks * BLOCK * BLOCK * LAYERS
    counts = np.frombuffer(data, np.uint8, end - start, start).reshape(blocks, -1)
    extra = 48 * contents["photons"]
    if start - at - pixels.nbytes != extra * width * height:
        raise ValueError(f"{path}: its pixels have another layout than this reader knows")
    return FilmFile(
        contents, pixels, data[at + pixels.nbytes : start], counts, np.frombuffer(data, CLUSTER, total, end)
    )
