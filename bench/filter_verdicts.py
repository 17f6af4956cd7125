# SPDX-License-Identifier: GPL-3.0-or-later
"""Claims of the thesis's chapter 6, and whether the filter's figures bear them out; a lower error only counts with the
light that belongs to it."""

from __future__ import annotations

from itertools import pairwise

from . import references
from .filter_quality import JUDGED
from .result import Verdict

ENERGY = 0.02
"""How far a filtered picture's light may be from the unfiltered one's."""
OVERHEAD = 0.05
SHARE = 0.25
TEXTURE = 0.98


def said(row: dict) -> str:
    return f"relMSE {row['relmse']:.5f}, energy {row['energy']:.4f}, {row['cpu']:.2f} CPU s"


def by_method(rows: list[dict], scene: str, samples: int = JUDGED) -> dict[str, dict]:
    return {row["method"]: row for row in rows if row["scene"] == scene and row["samples"] == samples}


def best(found: dict[str, dict], start: str) -> dict | None:
    """The row of the lowest error among the methods whose names start so."""
    own = [row for name, row in found.items() if name.startswith(start)]
    return min(own, key=lambda row: row["relmse"]) if own else None


def against(rows: list[dict], start: str, claim: str, source: str) -> list[Verdict]:
    """Ours against the best of some methods, scene by scene."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        found = by_method(rows, scene)
        ours, other = found.get("clusters"), best(found, start)
        if ours is None or other is None:
            continue
        even = abs(ours["of_raw"] - 1) <= ENERGY
        figures = (
            f"{ours['relmse'] / other['relmse']:.2f} of its error ({said(ours)}; {other['method']}: {said(other)})"
        )
        if not even:
            figures += f"; but our light is {ours['of_raw'] - 1:+.1%} off the unfiltered picture's"
        out.append(Verdict(f"{scene}: {claim}", source, ours["relmse"] < other["relmse"] and even, figures))
    return out


def shares(rows: list[dict]) -> list[Verdict]:
    """The filter's part of all CPU seconds, Table 6.1 in small."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        found = by_method(rows, scene)
        if "clusters" in found and "raw" in found:
            share = 1 - found["raw"]["cpu"] / found["clusters"]["cpu"]
            figures = f"{share:.1%} of {found['clusters']['cpu']:.2f} CPU s; the thesis: 20 to 22 %"
            claim = f"{scene}: rejection and filter take at most a quarter of the time at {JUDGED} samples"
            out.append(Verdict(claim, "thesis Table 6.1", share <= SHARE, figures))
    return out


def kept_texture(rows: list[dict]) -> list[Verdict]:
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        ours = by_method(rows, scene).get("clusters")
        if ours and ours.get("texture_kept") is not None:
            kept = ours["texture_kept"]
            figures = f"correlation with the reference's fine detail {kept:.4f}, noise counted against it"
            out.append(Verdict(f"{scene}: texture is kept", "thesis 6.3, Fig. 6.14", kept >= TEXTURE, figures))
    return out


def recorded(costs: list[dict]) -> list[Verdict]:
    out = []
    for row in costs:
        figures = f"{row['overhead']:.1%} ({row['low']:.1%} to {row['high']:.1%}) of {row['plain_cpu']:.2f} CPU s"
        claim = f"{row['scene']}: recording clusters costs at most {OVERHEAD:.0%} of rendering"
        out.append(Verdict(claim, "bench", row["overhead"] <= OVERHEAD, figures))
    return out


def vanishes(rows: list[dict]) -> list[Verdict]:
    """The filtered picture comes closer to the raw one with every step."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = [row for row in rows if row["scene"] == scene]
        falls = all(b["apart"] < a["apart"] for a, b in pairwise(own))
        first, last = own[0], own[-1]
        figures = (
            f"relMSE between them {first['apart']:.1e} at {first['samples']}, {last['apart']:.1e} at {last['samples']}"
        )
        figures += f"; light {last['energy']:.5f} of the raw picture's"
        out.append(Verdict(f"{scene}: the filtered picture converges to the raw one", "bench", falls, figures))
    return out


def good_references(rows: list[dict]) -> list[Verdict]:
    """The reference's own error beside the smallest that is measured with it at the judged number of samples."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = list(by_method(rows, scene).values())
        if own:
            smallest = min(own, key=lambda row: row["relmse"])
            holds, words = references.good_enough(smallest["reference"], smallest["relmse"])
            claim = f"{scene}: the reference is good enough at {JUDGED} samples"
            out.append(Verdict(claim, "bench", holds, f"{words}, of {smallest['method']}"))
    return out


def all_of(rows: list[dict], costs: list[dict], converged: list[dict]) -> list[Verdict]:
    cross = against(
        rows, "cross-bilateral", "clusters have less error than cross-bilateral", "thesis 6.4, Figs. 6.15-6.17"
    )
    equal = against(
        rows, "equal time", "filtered has less error than path tracing in equal time", "thesis 6.4, Table 6.1"
    )
    oidn = against(rows, "OIDN", "clusters have less error than OIDN", "bench")
    found = [*cross, *equal, *oidn, *shares(rows), *kept_texture(rows), *recorded(costs)]
    return [*found, *vanishes(converged), *good_references(rows)]
