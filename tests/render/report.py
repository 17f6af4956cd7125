# SPDX-License-Identifier: GPL-3.0-or-later
"""The HTML page of a comparison: both pictures, the difference and the figures; everything is inside the one file."""

from __future__ import annotations

import base64
import html
import struct
import zlib

import numpy as np

STYLE = """
body { font: 14px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 1060px; padding: 0 1em;
  color: #222; background: #fafafa }
section { display: grid; grid-template-columns: repeat(3, 192px) 1fr; gap: 12px; padding: 12px; margin: 12px 0;
  background: #fff; border: 1px solid #ddd; border-left: 6px solid #3a9a4b }
section.fail { border-left-color: #c62828 } section.inconclusive { border-left-color: #e0a100 }
h2 { font-size: 16px; grid-column: 1 / -1; margin: 0 } h2 small { font-weight: normal; color: #666; margin-left: 1em }
img { width: 192px; height: 192px; image-rendering: pixelated; background: #888 } figure { margin: 0 }
figcaption { font-size: 12px; color: #666 } pre { white-space: pre-wrap; margin: 0; font-size: 12px }
"""


def png(pixels: np.ndarray) -> bytes:
    """8-bit RGB, (h, w, 3), top row first."""
    h, w = pixels.shape[:2]
    rows = np.concatenate([np.zeros((h, 1), np.uint8), pixels.reshape(h, w * 3)], axis=1).tobytes()

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", w, h, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def display(linear: np.ndarray, white: float) -> np.ndarray:
    """Linear (h, w, 3), bottom row first, to 8-bit sRGB, top row first."""
    x = np.clip(np.nan_to_num(linear) / white, 0.0, 1.0)
    srgb = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return (srgb[::-1] * 255.0 + 0.5).astype(np.uint8)


def difference(ours: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Grey where equal; red where ours is brighter, blue where darker, full colour at 10 % of the local brightness."""
    y, r = ours[..., :3].mean(-1), reference[..., :3].mean(-1)
    d = np.clip((y - r) / np.maximum(r, 0.1 * max(float(r.mean()), 1e-9)) / 0.1, -1.0, 1.0)[::-1]
    out = np.full((*d.shape, 3), 128.0)
    out[..., 0] += 127.0 * d
    out[..., 2] -= 127.0 * d
    out[..., 1] -= 100.0 * np.abs(d)
    return out.astype(np.uint8)


def figure(pixels: np.ndarray, caption: str) -> str:
    data, text = base64.b64encode(png(pixels)).decode(), html.escape(caption)
    return f'<figure><img alt="{text}" src="data:image/png;base64,{data}"><figcaption>{text}</figcaption></figure>'


def pictures(result, engines: tuple[str, str]) -> str:
    if result.reference is None:
        return ""
    white = max(float(np.quantile(np.nan_to_num(result.reference[..., :3]), 0.99)), 1e-6)
    parts = []
    if result.ours is not None:
        parts.append(figure(display(result.ours[..., :3], white), engines[0].title()))
    parts.append(figure(display(result.reference[..., :3], white), engines[1].title()))
    if result.ours is not None and result.ours.shape == result.reference.shape:
        parts.append(figure(difference(result.ours, result.reference), "difference, ±10 %: red is brighter"))
    return "".join(parts)


def blocks(result) -> str:
    """The blocks' differences in per cent, as they lie in the picture."""
    if result.comparison is None or not result.comparison.blocks:
        return ""
    rows = [" ".join(f"{100 * e.difference:+6.2f}" for e in row) for row in reversed(result.comparison.blocks)]
    return "\n\nblocks, per cent\n" + "\n".join(rows)


def page(results: list, line, engines: tuple[str, str]) -> str:
    """Results in the order given; `line` writes one as text."""
    passed = sum(r.verdict == "pass" for r in results)
    title = f"{engines[0].title()} against {engines[1].title()}: {passed} of {len(results)} cases agree"
    body = []
    for r in results:
        text = html.escape("\n".join(line(r).split("   ")) + blocks(r))
        head = f"{html.escape(r.case)}<small>Blender {html.escape(r.host)}, {r.verdict}: {html.escape(r.about)}</small>"
        body.append(f'<section class="{r.verdict}"><h2>{head}</h2>{pictures(r, engines)}<pre>{text}</pre></section>')
    return (
        f'<!doctype html><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style><h1>{title}</h1>'
        + "\n".join(body)
    )
