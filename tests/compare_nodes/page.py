# SPDX-License-Identifier: GPL-3.0-or-later
"""The HTML page: both pictures of every case and the difference, failures first; everything is inside the one file."""

from __future__ import annotations

import html

import numpy as np
from results import Result, line

from report import figure

STYLE = """
body { font: 13px/1.4 system-ui, sans-serif; margin: 2em; color: #222; background: #fafafa }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 8px }
section { padding: 8px; background: #fff; border: 1px solid #ddd; border-left: 5px solid #3a9a4b }
section.fail { border-left-color: #c62828 }
h3 { font-size: 13px; margin: 0 0 6px } h3 small { font-weight: normal; color: #666 }
div { display: flex; gap: 8px } img { width: 96px; height: 96px; image-rendering: pixelated } figure { margin: 0 }
figcaption { font-size: 11px; color: #666 } p { margin: 4px 0 0; font-size: 11px; overflow-wrap: anywhere }
"""


def scaled(tile: np.ndarray, low: float, high: float) -> np.ndarray:
    """(h, w, 3), bottom row first, to 8 bits, top row first: low is black, high white."""
    shown = np.clip((np.nan_to_num(tile) - low) / max(high - low, 1e-6), 0.0, 1.0)
    return (shown[::-1] * 255.0 + 0.5).astype(np.uint8)


def difference(ours: np.ndarray, reference: np.ndarray, tolerance: float) -> np.ndarray:
    """Black where equal, grey within the tolerance, from yellow to red beyond it (a hundred times)."""
    scale = np.maximum(np.maximum(np.abs(ours), np.abs(reference)), 1e-2)
    with np.errstate(invalid="ignore"):
        e = np.nan_to_num((np.abs(ours - reference) / scale).max(-1), nan=1e9)[::-1] / tolerance
    out = np.zeros((*e.shape, 3))
    out[...] = 90.0 * np.minimum(e, 1.0)[..., None]
    beyond = e > 1.0
    out[beyond] = (255.0, 0.0, 0.0)
    out[..., 1] = np.where(beyond, 220.0 * (1.0 - np.clip(np.log10(np.maximum(e, 1.0)) / 2.0, 0.0, 1.0)), out[..., 1])
    return out.astype(np.uint8)


def pictures(result: Result) -> str:
    if result.ours is None or result.reference is None:
        return ""
    low, high = np.quantile(np.nan_to_num(result.reference), (0.01, 0.99))
    if high - low < 1e-6:  # one value everywhere
        low, high = min(low, 0.0), max(high, 1.0)
    parts = [
        figure(scaled(result.ours, low, high), "Cardioid"),
        figure(scaled(result.reference, low, high), f"Cycles, {low:.3g} … {high:.3g}"),
        figure(difference(result.ours, result.reference, result.tolerance), "difference"),
    ]
    return "<div>" + "".join(parts) + "</div>"


def page(results: list[Result]) -> str:
    shown = sorted((r for r in results if not r.skipped), key=lambda r: (not r.failed, r.host, r.case))
    good = sum(r.passed for r in shown)
    title = f"Cardioid against Cycles, node by node: {good} of {len(shown)} cases agree"
    body = []
    for r in shown:
        head = f"{html.escape(r.case)} <small>{html.escape(r.host)} · {html.escape(r.uses)}</small>"
        text = html.escape(line(r).partition(": ")[2])
        body.append(
            f'<section class="{"fail" if r.failed else "pass"}"><h3>{head}</h3>{pictures(r)}<p>{text}</p></section>'
        )
    skipped = html.escape("; ".join(sorted({f"{r.case} ({r.host}): {r.skipped}" for r in results if r.skipped})))
    return (
        f'<!doctype html><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style><h1>{title}</h1><main>'
        + "\n".join(body)
        + f"</main><h2>Not in this Blender</h2><p>{skipped}</p>"
    )
