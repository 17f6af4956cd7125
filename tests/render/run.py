#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cardioid against Cycles on small scenes; the last line is `N passed, N failed, N skipped`.

usage: tests/render/run.py [--case NAME ...] [--host NAME ...] [--html OUT.html] [--quick] [--self]

Every case is rendered by both engines in the same Blender, several seeds each, and compared by compare.py. Inconclusive
cases get more seeds; what is still inconclusive then has failed. Cycles' pictures are kept in build/render-cache.
Hosts: Debian's `blender`, and the bpy wheels in .venv/bpy45 and .venv/bpy50 (or CARDIOID_BPY_PYTHONS, colon-separated).
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import compare  # noqa: E402
import hosts  # noqa: E402

import report  # noqa: E402

ROUNDS = (8, 24, 64, 192)
"""Seeds a case has been rendered with after each round."""
REFERENCE_SEED = 1000

KNOWN_DIFFERENCES = {
    ("3.4", "glossy_multi_ggx"): "3.4 walks between facets at random; later versions and Cardioid compensate by albedo",
}
"""Cases whose blocks differ for a reason that the docs tell. Their means must still pass; they count as skipped, and
one whose blocks agree fails, so that the list cannot outlive its reasons."""


@dataclass
class Result:
    """What is known about a case in a host."""

    host: str
    case: str
    about: str
    comparison: compare.Comparison | None = None
    problem: str = ""
    ours: np.ndarray | None = None
    reference: np.ndarray | None = None
    cpu: dict[str, list[float]] = field(default_factory=lambda: {"ours": [], "reference": []})
    survivors: list[str] = field(default_factory=list)
    self_check: bool = False

    @property
    def verdict(self) -> str:
        if self.problem or self.comparison is None:
            return "fail"
        if self.survivors:
            return "fail"
        if self.known:
            only_blocks = self.comparison.verdict != "pass" and self.comparison.means_agree()
            return "known" if only_blocks else "fail"
        return self.comparison.verdict

    @property
    def known(self) -> str:
        """Why this case is allowed to differ in its blocks; empty for all others."""
        return "" if self.self_check else KNOWN_DIFFERENCES.get((self.host, self.case), "")


def evaluate(result: Result, outcome: hosts.Outcome) -> None:
    """Compares what has been rendered so far; a mutant that would pass fails the case."""
    ours, reference = outcome.load(result.case, "ours"), outcome.load(result.case, "reference")
    result.problem = (
        outcome.problems.get((result.case, "ours")) or outcome.problems.get((result.case, "reference")) or ""
    )
    result.ours = ours.mean(0) if len(ours) else None
    result.reference = reference.mean(0) if len(reference) else None
    result.cpu = {role: outcome.cpu.get((result.case, role), []) for role in ("ours", "reference")}
    if result.problem or len(ours) < 2 or len(reference) < 2:
        result.problem = result.problem or "not rendered"
        return
    result.comparison = compare.compare(ours, reference)
    if result.comparison.verdict == "pass":
        changed = compare.mutants(ours)
        result.survivors = [n for n, m in changed.items() if compare.compare(m, reference).verdict == "pass"]


def run_host(host: hosts.Host, wanted: list[str], engines: tuple[str, str], rounds, deadline: float) -> list[Result]:
    """All cases of a host, with more seeds for those that are inconclusive while there is time."""
    listing = host.listing()
    names = [n for n in listing["cases"] if not wanted or n in wanted]
    results = {
        n: Result(host.name, n, listing["cases"][n]["about"] or "", self_check=engines[0] == engines[1]) for n in names
    }
    outcome = hosts.Outcome(host, listing, {"ours": engines[0], "reference": engines[1]})
    done, open_cases = 0, names
    for count in rounds:
        if not open_cases or (done and time.monotonic() > deadline):
            break
        seeds = range(done, count)
        jobs = [(n, "ours", 1 + s) for n in open_cases for s in seeds]
        jobs += [(n, "reference", REFERENCE_SEED + s) for n in open_cases for s in seeds]
        outcome.render(jobs)
        for name in open_cases:
            evaluate(results[name], outcome)
        done = count
        open_cases = [n for n in open_cases if results[n].verdict == "inconclusive"]
        print(
            f"   {host.name}: {len(names)} cases, {count} seeds; inconclusive: {', '.join(open_cases) or 'none'}",
            flush=True,
        )
    return list(results.values())


def line(result: Result) -> str:
    """One case as text: verdict, energy and worst block with their intervals, CPU seconds a render."""
    text = f"{result.verdict.upper():12} {result.host} {result.case:26}"
    if result.problem or result.comparison is None or not result.comparison.means:
        return f"{text} {result.problem or (result.comparison and result.comparison.problem) or ''}"
    channel, mean = result.comparison.worst_mean()
    (x, y), block = result.comparison.worst_block()
    text += f" mean {channel} {mean.difference:+.2%} ± {mean.half_width:.2%}"
    text += f"   block {x},{y} {block.difference:+.2%} ± {block.half_width:.2%}"
    cpu = [f"{sum(v) / len(v):.2f}" if v else "kept" for v in (result.cpu["ours"], result.cpu["reference"])]
    text += f"   {cpu[0]} and {cpu[1]} CPU s"
    return text + (f"   mutant passed: {', '.join(result.survivors)}" if result.survivors else "")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", action="append", default=[], help="only this case (may be repeated)")
    parser.add_argument("--host", action="append", default=[], help="only this host: 3.4, bpy45, bpy50")
    parser.add_argument(
        "--html", type=Path, default=hosts.ROOT / "build" / "render.html", help="the page (default: %(default)s)"
    )
    parser.add_argument("--quick", action="store_true", help="first round only, in Debian's Blender")
    parser.add_argument("--self", action="store_true", dest="self_check", help="Cycles against Cycles with other seeds")
    parser.add_argument(
        "--seconds", type=float, default=400.0, help="of a host: no further round after them (default: %(default)s)"
    )
    options = parser.parse_args()
    engines = ("CYCLES", "CYCLES") if options.self_check else ("CARDIOID", "CYCLES")
    start = time.monotonic()
    found, missing = hosts.find()
    found = [
        h for h in found if (not options.host or h.name in options.host) and not (options.quick and h.name != "3.4")
    ]
    results: list[Result] = []
    for host in found:
        rounds = ROUNDS[:1] if options.quick else ROUNDS
        results += run_host(host, options.case, engines, rounds, time.monotonic() + options.seconds)
    order = {"fail": 0, "inconclusive": 1, "known": 2, "pass": 3}
    results.sort(key=lambda r: (order[r.verdict], r.host, r.case))
    for result in results:
        print(line(result))
    options.html.parent.mkdir(parents=True, exist_ok=True)
    options.html.write_text(report.page(results, line, engines))
    print(f"{os.path.relpath(options.html)}   {time.monotonic() - start:.0f} s")
    for name in missing:
        print(f"skipped {name}: not installed")
    known = [r for r in results if r.verdict == "known"]
    for result in known:
        print(f"skipped {result.host} {result.case}: {result.known}")
    passed = sum(r.verdict == "pass" for r in results)
    failed = len(results) - passed - len(known)
    print(f"{passed} passed, {failed} failed, {len(missing) + len(known)} skipped")
    return 0 if passed and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
