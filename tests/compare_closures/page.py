# SPDX-License-Identifier: GPL-3.0-or-later
"""The HTML page of the closures: each sheet by both engines, the difference, and a line for every ball."""

from __future__ import annotations

import html

import numpy as np

import report

STYLE = """
body { font: 14px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 1300px; padding: 0 1em; color: #222 }
figure { margin: 4px; display: inline-block } figcaption { font-size: 12px; color: #666 } img { max-width: 420px }
pre { font-size: 12px; white-space: pre-wrap; margin: 0 } .fail { color: #b71c1c } .inconclusive { color: #8a6000 }
"""


def pictures(ours: np.ndarray | None, reference: np.ndarray | None) -> str:
    if ours is None or reference is None:
        return "<p>no pictures</p>"
    white = max(float(np.quantile(reference[..., :3], 0.99)), 1e-6)
    shown = [(report.display(ours[..., :3], white), "Cardioid"), (report.display(reference[..., :3], white), "Cycles"),
             (report.difference(ours, reference), "±10 %: red is brighter")]
    return "".join(report.figure(pixels, caption) for pixels, caption in shown)


def page(found: list, sheets: list) -> str:
    """Cells in the order given, under the pictures of their sheets: (host, sheet, ours, reference)."""
    passed = sum(c.verdict == "pass" for c in found)
    title = f"Closures: {passed} of {len(found)} agree with Cycles"
    body = []
    for host, sheet, ours, reference in sheets:
        lines = [f'<pre class="{c.verdict}">{html.escape(c.line())}</pre>' for c in found
                 if (c.host, c.sheet) == (host, sheet)]
        body.append(f"<h2>{html.escape(sheet)}, Blender {html.escape(host)}</h2>{pictures(ours, reference)}"
                    + "\n".join(lines))
    return (f'<!doctype html><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style><h1>{title}</h1>'
            + "\n".join(body))
