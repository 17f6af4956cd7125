#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Closure by closure against Cycles; the last line is `N passed, N failed, N skipped`.

usage: tests/compare_closures/run.py [--sheet NAME] [--host NAME] [--html OUT.html] [--text FOLDER] [--seconds N]

Balls under a sky and a small lamp, one for each value of each input of each shader (sheets.py), by both engines in the
same Blender. Sheets with undecided balls get more seeds. Balls that are still undecided then have not passed.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render")]

import cells  # noqa: E402
import hosts  # noqa: E402
import page  # noqa: E402

ROUNDS = (4, 12, 36)
REFERENCE_SEED = 1000
PREFIX = "closures_"
hosts.SILENCE = 300.0  # a sheet is many small pictures


def find() -> tuple[list[hosts.Host], list[str]]:
    """The hosts of tests/render with this folder's worker."""
    found, missing = hosts.find()
    for host in found:
        host.command = [c.replace(str(hosts.HERE / "worker.py"), str(HERE / "worker.py")) for c in host.command]
    return found, missing


def judge(host: hosts.Host, listing: dict, sheet: str, outcome: hosts.Outcome) -> list[cells.Cell]:
    labels = listing["cases"][sheet]["labels"]
    problem = outcome.problems.get((sheet, "ours")) or outcome.problems.get((sheet, "reference")) or ""
    ours, reference = (outcome.load(sheet, role) for role in ("ours", "reference"))
    found = []
    for i, label in enumerate(labels):
        cell = cells.Cell(host.name, sheet, label, problem=problem)
        if not problem and len(ours) > 1 and len(reference) > 1:
            a, b = (cells.part(images, i, listing["cell"], listing["ball"]) for images in (ours, reference))
            cells.judge(cell, a, b)
        found.append(cell)
    return found


def run_host(host: hosts.Host, options) -> tuple[list[cells.Cell], list]:
    listing = host.listing()
    sheets = [n for n in listing["cases"] if not options.sheet or n.removeprefix(PREFIX) in options.sheet]
    outcome = hosts.Outcome(host, listing, {"ours": "CARDIOID", "reference": "CYCLES"})
    results: dict[str, list[cells.Cell]] = {}
    done, waiting, begun = 0, sheets, time.monotonic()
    for count in ROUNDS:
        if not waiting or (done and time.monotonic() - begun > options.seconds):
            break
        jobs = [(n, "ours", 1 + s) for n in waiting for s in range(done, count)]
        jobs += [(n, "reference", REFERENCE_SEED + s) for n in waiting for s in range(done, count)]
        outcome.render(jobs)
        for sheet in waiting:
            results[sheet] = judge(host, listing, sheet, outcome)
        done = count
        waiting = [n for n in waiting if any(c.verdict == "inconclusive" for c in results[n])]
        print(f"   {host.name}: {count} seeds, undecided: {', '.join(waiting) or 'none'}", flush=True)
    pictures = []
    for sheet in sheets:
        shown = [outcome.load(sheet, role) for role in ("ours", "reference")]
        pictures.append((host.name, sheet, *(p.mean(0) if len(p) else None for p in shown)))
    return [c for found in results.values() for c in found], pictures


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sheet", action="append", default=[])
    parser.add_argument("--host", action="append", default=[], help="3.4, bpy45, bpy50")
    parser.add_argument("--html", type=Path, default=hosts.ROOT / "build" / "closures.html")
    parser.add_argument("--text", type=Path, help="a folder for one text file for each host")
    parser.add_argument("--seconds", type=float, default=600.0, help="no further round after this time, for each host")
    options = parser.parse_args()
    found, missing = find()
    everything, pictures, begun = [], [], time.monotonic()
    for host in found:
        if options.host and host.name not in options.host:
            continue
        results, shown = run_host(host, options)
        order = {"fail": 0, "inconclusive": 1, "pass": 2}
        results.sort(key=lambda c: (order[c.verdict], -c.size))
        for cell in results:
            if cell.verdict != "pass":
                print(cell.line())
        if options.text:
            options.text.mkdir(parents=True, exist_ok=True)
            (options.text / f"{host.name}.txt").write_text("\n".join(c.line() for c in results) + "\n")
        everything += results
        pictures += shown
    options.html.parent.mkdir(parents=True, exist_ok=True)
    options.html.write_text(page.page(everything, pictures))
    print(f"{os.path.relpath(options.html)}   {time.monotonic() - begun:.0f} s")
    for name in missing:
        print(f"skipped {name}: not installed")
    passed = sum(c.verdict == "pass" for c in everything)
    sheets = sorted({(c.host, c.sheet) for c in everything})
    for host, sheet in sheets:
        own = [c for c in everything if (c.host, c.sheet) == (host, sheet)]
        median = float(np.median([min(c.size, 10.0) for c in own]))
        good, bad = (sum(c.verdict == v for c in own) for v in ("pass", "fail"))
        print(f"   {host:5} {sheet.removeprefix(PREFIX):18} {good} of {len(own)} pass, {bad} differ; "
              f"median of the largest channel's difference {median:.2%}")
    print(f"{passed} passed, {len(everything) - passed} failed, {len(missing)} skipped")
    return 0 if passed and passed == len(everything) else 1


if __name__ == "__main__":
    sys.exit(main())
