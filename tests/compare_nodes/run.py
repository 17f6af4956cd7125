#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every shading node against Cycles, pixel by pixel; the last line is `N passed, N failed, N skipped`.

usage: tests/compare_nodes/run.py [--host 3.4|bpy45|bpy50 ...] [--case GLOB ...] [--html OUT] [--json OUT] [--quick]

A case is one tile whose emission is a node's output; all tiles of a host are one picture, rendered by both engines in
one Blender each. Prints a line for each case that fails, with the share of pixels that agree (and of those that are
explained: pixels.py), the worst pixel and its values; then the totals of each host.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "tests" / "render")]

import batches  # noqa: E402
import hosts  # noqa: E402
import page  # noqa: E402
from results import Result, line, results_of  # noqa: E402


def run_host(host: hosts.Host, options: argparse.Namespace) -> list[Result]:
    listing = batches.listing(host)
    names = [n for n in batches.chosen(listing, options.case) if not options.quick or listing[n]["quick"]]
    found: list[Result] = []
    with ThreadPoolExecutor(2) as pool:
        for group in ("exact", "perspective", "noisy"):
            own = [n for n in names if listing[n]["group"] == group]
            if own:
                ours = pool.submit(batches.render, host, "CARDIOID", own, group)
                reference = batches.render(host, "CYCLES", own, group)
                found += results_of(host.name, listing, own, ours.result(), reference)
    return found


def never_built(results: list[Result]) -> list[str]:
    """Cases that no host could build: a name is misspelt."""
    built = {r.case for r in results if not r.skipped}
    return sorted({r.case for r in results} - built)


def report(results: list[Result], options: argparse.Namespace, names: list[str]) -> tuple[int, int]:
    for name in names:
        own = [r for r in results if r.host == name]
        passed, failed = sum(r.passed for r in own), sum(r.failed for r in own)
        skipped = sum(bool(r.skipped) for r in own)
        explained = sum(r.passed and r.verdict is not None and r.verdict.explained > 0 for r in own)
        print(f"{name}: {passed} of {passed + failed} cases agree ({explained} of them with explained pixels), "
              f"{skipped} are not in this Blender")  # fmt: skip
    for path, text in ((options.json, json.dumps([r.summary() for r in results], indent=1)),
                       (options.html, page.page(results))):  # fmt: skip
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    print(os.path.relpath(options.html))
    return sum(r.passed for r in results), sum(r.failed for r in results)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--host", action="append", default=[], help="only this host: 3.4, bpy45, bpy50")
    parser.add_argument("--case", action="append", default=[], help="only cases whose name fits this pattern")
    parser.add_argument("--html", type=Path, default=ROOT / "build" / "compare_nodes.html", help="default: %(default)s")
    parser.add_argument("--json", type=Path, default=ROOT / "build" / "compare_nodes.json", help="default: %(default)s")
    parser.add_argument("--text", type=Path, help="also write each host's lines to this folder")
    parser.add_argument("--quick", action="store_true", help="one case of each kind, in Debian's Blender")
    options = parser.parse_args()
    batches.addon()
    found, missing = hosts.find()
    wanted = options.host or (["3.4"] if options.quick else [h.name for h in found])
    found = [h for h in found if h.name in wanted]
    results: list[Result] = []
    for host in found:
        start = time.monotonic()
        own = run_host(host, options)
        own.sort(key=lambda r: (not r.failed, r.case))
        lines = [line(r) for r in own if r.failed] + [f"{host.name}: {time.monotonic() - start:.0f} s"]
        print("\n".join(lines), flush=True)
        if options.text:
            options.text.mkdir(parents=True, exist_ok=True)
            options.text.joinpath(f"{host.name}.txt").write_text("\n".join(lines) + "\n")
        results += own
    passed, failed = report(results, options, [h.name for h in found])
    if len(found) == 3:
        for name in never_built(results):
            print(f"FAIL all {name}: no Blender has it: is the name right?")
            failed += 1
    for name in missing:
        print(f"skipped {name}: not installed")
    print(f"{passed} passed, {failed} failed, {len(missing)} skipped")
    return 0 if passed and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
