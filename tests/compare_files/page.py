# SPDX-License-Identifier: GPL-3.0-or-later
"""The HTML page of the real files: both pictures and their difference side by side, everything inside the one file."""

from __future__ import annotations

import html

import numpy as np

import report

STYLE = """
body { font: 14px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 1500px; padding: 0 1em;
  color: #222; background: #fafafa }
section { display: flex; flex-wrap: wrap; gap: 12px; padding: 12px; margin: 12px 0; background: #fff;
  border: 1px solid #ddd; border-left: 6px solid #3a9a4b }
section.fail { border-left-color: #c62828 } section.noise { border-left-color: #e0a100 }
h2 { font-size: 16px; margin: 0; width: 100% } figure { margin: 0 } figcaption { font-size: 12px; color: #666 }
img { max-width: 460px; background: #888 } pre { white-space: pre-wrap; margin: 0; font-size: 12px; width: 100% }
"""


def pictures(result) -> str:
    if result.reference is None:
        return ""
    white = max(float(np.quantile(np.nan_to_num(result.reference[..., :3]), 0.99)), 1e-6)
    parts = []
    if result.ours is not None:
        parts.append(report.figure(report.display(result.ours[..., :3], white), "Cardioid"))
    parts.append(report.figure(report.display(result.reference[..., :3], white), "Cycles"))
    if result.ours is not None and result.ours.shape == result.reference.shape:
        parts.append(report.figure(report.difference(result.ours, result.reference), "±10 %: red is brighter"))
    return "".join(parts)


def page(results: list, line, cell_lines, totals: str) -> str:
    """Results in the order given; `line` writes one as text, `cell_lines` a library's materials."""
    body = []
    for r in results:
        text = "\n".join([*line(r).split("   "), *cell_lines(r), *r.messages])
        body.append(f'<section class="{r.verdict}"><h2>{html.escape(r.name)}</h2>{pictures(r)}'
                    f"<pre>{html.escape(text)}</pre></section>")
    title = f"Real files: {sum(r.verdict != 'fail' for r in results)} of {len(results)} agree with Cycles"
    return (f'<!doctype html><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style><h1>{title}</h1>'
            f"<p>{html.escape(totals)}</p>" + "\n".join(body))
