# SPDX-License-Identifier: GPL-3.0-or-later
"""Claims of the thesis's chapter 5 and whether error over CPU time bears them out."""

from __future__ import annotations

import numpy as np

from .result import Verdict

TIE = 0.10
SHARE = 0.10
"""What the reference's own squared error may be of a measured one."""
ENERGY = 0.01
POWER = {"rmse": 0.5, "relmse": 1.0}
NAMES = {"rmse": "RMSE", "relmse": "relMSE"}


def at(rows: list[dict], cpu: float, figure: str) -> float:
    """A method's error at exactly these CPU seconds: that of its nearest mark, scaled as unbiased estimates fall.

    SPPM's passes are long, so it meets its marks roughly only. It falls slower than this: in its favour where it had
    less time.
    """
    row = min(rows, key=lambda r: abs(np.log(r["cpu"] / cpu)))
    return row[figure] * (row["cpu"] / cpu) ** POWER[figure]


def judge(rows: list[dict], figure: str = "rmse", ours: str = "PTPPM") -> list[dict]:
    """Ours against the best of the others at each mark: `under`, `tie` (within 10 %) or `over`."""
    out = []
    for row in rows:
        if row["method"] != ours:
            continue
        same = [r for r in rows if r["scene"] == row["scene"] and r["method"] != ours]
        others = {m: at([r for r in same if r["method"] == m], row["cpu"], figure) for m in {r["method"] for r in same}}
        if others:
            best = min(others, key=lambda method: others[method])
            ratio = row[figure] / others[best]
            word = "under" if ratio < 1.0 else "tie" if ratio <= 1.0 + TIE else "over"
            out.append({"scene": row["scene"], "mark": row["mark"], "ratio": ratio, "best": best, "word": word})
    return out


def said(found: list[dict]) -> str:
    """Ratios mark by mark in words."""
    parts = [f"{v['mark']:g} s {v['ratio']:.2f} of {v['best']}'s" for v in found]
    lost, tied = (sum(v["word"] == word for v in found) for word in ("over", "tie"))
    tail = [f"{lost} of {len(found)} over"] if lost else []
    tail += [f"{tied} within {TIE:.0%}"] if tied else []
    return ", ".join(parts) + (f" ({', '.join(tail)})" if tail else "")


def lowest(rows: list[dict], scenes: tuple[str, ...]) -> list[Verdict]:
    """The claim of 5.7, by RMSE as there and by relMSE: scene by scene, then for all scenes."""
    out = []
    for figure, name in NAMES.items():
        found = judge(rows, figure)
        for scene in dict.fromkeys(v["scene"] for v in found):
            own = [v for v in found if v["scene"] == scene]
            holds = all(v["word"] != "over" for v in own)
            out.append(Verdict(f"{scene}: PTPPM's {name} is lowest at every time", "thesis 5.7.4", holds, said(own)))
        there = {v["scene"] for v in found}
        lost = sum(v["word"] == "over" for v in found)
        holds = False if lost else True if there == set(scenes) else None
        figures = f"{len(found) - lost} of {len(found)} times on {len(there)} of {len(scenes)} scenes"
        claim = f"PTPPM's {name} is lowest at all times on all three scenes"
        out.append(Verdict(claim, "thesis 5.7.4, Fig. 5.11", holds, figures))
    return out


def energies(rows: list[dict], ours: str = "PTPPM") -> Verdict:
    """A lower error bought with missing light would be a fault."""
    own = [row for row in rows if row["method"] == ours]
    worst = max(own, key=lambda row: abs(row["energy"] - 1), default=None)
    claim = f"{ours} loses and gains no light: within {ENERGY:.0%} of the reference's"
    if worst is None:
        return Verdict(claim, "honesty", None, "not run")
    figures = f"at most {worst['energy'] - 1:+.2%} ({worst['scene']}, {worst['mark']:g} CPU s)"
    return Verdict(claim, "honesty", abs(worst["energy"] - 1) <= ENERGY, figures)


def references(rows: list[dict]) -> list[Verdict]:
    """Whether the references are good enough for what was measured, scene by scene."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        own = [row for row in rows if row["scene"] == scene]
        over = [row for row in own if row["reference"] > SHARE]
        worst = max(own, key=lambda row: row["reference"])
        figures = f"at most {worst['reference']:.1%} ({worst['method']} at {worst['mark']:g} CPU s)"
        figures += f"; over it in {len(over)} of {len(own)} rows: these errors are too high by it" if over else ""
        claim = f"{scene}: the reference's own squared error is under a tenth of every measured one"
        out.append(Verdict(claim, "bench", not over, figures))
    return out


def notes(rows: list[dict]) -> list[str]:
    """Rows whose light is not all there, or more than there is."""
    out = []
    for row in rows:
        name = f"{row['scene']}, {row['mark']:g} CPU s, {row['method']}"
        if abs(row["energy"] - 1) > ENERGY:
            out.append(f"{name}: energy differs from the reference by {row['energy'] - 1:+.2%}")
    return out
