# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as data URIs and as small files."""

from __future__ import annotations

import base64
import io
from pathlib import Path

from PIL import Image, ImageFile, ImageOps

ImageFile.MAXBLOCK = 1 << 24  # progressive JPEG is written in one piece, which Pillow expects to be smaller

MAX_SIDE = 1600
"""Pixels; larger pictures are shown smaller."""

PLOT_LIMIT = 300_000
"""Bytes; larger plots are sheets of pictures, which would fill the page."""


def data_uri(data: bytes, kind: str) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def within(image: Image.Image, longest: int) -> Image.Image:
    """The picture, made smaller if a side has more than `longest` pixels."""
    scale = longest / max(image.size)
    if scale >= 1.0:
        return image
    return image.resize([max(1, round(side * scale)) for side in image.size], Image.Resampling.LANCZOS)


def webp(image: Image.Image, quality: int) -> str:
    """The picture as WebP; quality 100 keeps every pixel."""
    out = io.BytesIO()
    within(image, MAX_SIDE).save(out, "WEBP", quality=quality, lossless=quality >= 100, method=4)
    return data_uri(out.getvalue(), "webp")


def thumb(image: Image.Image) -> str:
    """The middle of the picture, 192 × 128 pixels."""
    out = io.BytesIO()
    ImageOps.fit(image, (192, 128), Image.Resampling.LANCZOS).save(out, "WEBP", quality=85)
    return data_uri(out.getvalue(), "webp")


def jpeg_under(image: Image.Image, limit: int) -> bytes:
    """JPEG of at most `limit` bytes: quality goes down first, then size."""
    smaller = within(image, MAX_SIDE)
    while True:
        for quality in (92, 88, 84, 80, 75):
            out = io.BytesIO()
            smaller.save(out, "JPEG", quality=quality, optimize=True, progressive=True, subsampling=0)
            if out.tell() <= limit:
                return out.getvalue()
        smaller = within(smaller, int(max(smaller.size) * 0.85))


def plot(path: Path, quality: int) -> str:
    """A plot's data URI: SVG and small files as they are, others as pictures. OSError if it is none."""
    if path.suffix == ".svg":
        return data_uri(path.read_bytes(), "svg+xml")
    with Image.open(path) as image:
        pixels = image.convert("RGB")
        kind = (image.format or "").lower()
    small = kind in ("png", "jpeg", "webp") and path.stat().st_size <= PLOT_LIMIT
    return data_uri(path.read_bytes(), kind) if small else webp(pixels, quality)
