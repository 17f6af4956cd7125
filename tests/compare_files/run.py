#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Real files by Cardioid and by Cycles; the last line is `N passed, N failed, N skipped`.

usage: tests/compare_files/run.py BLENDS_DIR [--file NAME ...] [--html OUT.html] [--samples N] [--seeds N] [--blur]

Every .blend file under BLENDS_DIR (or $CARDIOID_BLENDS) is rendered by both engines in the same Blender: files that
need Blender 4 in the bpy wheels, the others in Debian's. Caustics and clamps are off in both, Cardioid traces paths
only.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render")]

import census  # noqa: E402
import hosts  # noqa: E402
import judge  # noqa: E402
import page  # noqa: E402
import renders  # noqa: E402

REFERENCE_SEED = 1000


@dataclass
class Result:
    """One file in one Blender."""

    name: str
    host: str
    blur: bool
    judgement: judge.Judgement | None = None
    cells: dict[str, judge.Judgement] = field(default_factory=dict)
    nodes: tuple[int, int, int, dict[str, int]] = (0, 0, 0, {})
    counts: dict[str, int] = field(default_factory=dict)
    messages: list[str] = field(default_factory=list)
    seconds: tuple[float, float] = (0.0, 0.0)
    problem: str = ""
    had_blur: bool = False
    ours: np.ndarray | None = None
    reference: np.ndarray | None = None

    @property
    def verdict(self) -> str:
        return "fail" if self.problem or self.judgement is None else self.judgement.verdict


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("blends", nargs="?", type=Path, default=os.environ.get("CARDIOID_BLENDS"))
    parser.add_argument("--file", action="append", default=[], help="only files whose name has this in it")
    parser.add_argument("--host", default="", help="render in this Blender alone: 3.4, bpy45, bpy50")
    parser.add_argument("--html", type=Path, default=hosts.ROOT / "build" / "files.html")
    parser.add_argument("--samples", type=int, default=64, help="of each picture (%(default)s)")
    parser.add_argument("--seeds", type=int, default=3, help="pictures of each engine (%(default)s)")
    parser.add_argument("--width", type=int, default=240)
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--limit", type=float, default=600.0, help="seconds for an engine and a file (%(default)s)")
    parser.add_argument("--blur", action="store_true", help="leave motion blur on; only files that have it")
    options = parser.parse_args()
    if not options.blends or not Path(options.blends).is_dir():
        parser.error("name a folder of .blend files")
    if options.seeds < 2:
        parser.error("at least two seeds: their scatter tells noise from difference")
    return options


def host_for(blend: Path, found: dict[str, hosts.Host], wanted: str) -> hosts.Host | None:
    """The oldest Blender here that opens the file."""
    if wanted:
        return found.get(wanted)
    version = renders.saved_by(blend)
    if version == (0, 0):
        return found.get("bpy50" if "needs-4" in blend.parts else "3.4")
    limits = {"3.4": (4, 0), "bpy45": (5, 0), "bpy50": (5, 1)}
    return next((found[name] for name, limit in limits.items() if name in found and version < limit), None)


def compare_file(blend: Path, host: hosts.Host, options, known: dict[str, str]) -> Result:
    result = Result(blend.stem, host.name, options.blur)
    task = {"blend": str(blend.resolve()), "threads": options.threads, "width": options.width,
            "samples": options.samples, "blur": options.blur}
    ours = renders.render(host, "CARDIOID", task, range(1, 1 + options.seeds), options.limit)
    result.had_blur = ours.facts.get("had_blur", False)
    if options.blur and not result.had_blur:
        return result
    first = range(REFERENCE_SEED, REFERENCE_SEED + options.seeds)
    reference = renders.render(host, "CYCLES", task, first, options.limit)
    result.counts, result.messages = ours.facts.get("census", {}), ours.messages
    result.nodes = census.shares(result.counts, known)
    result.seconds = ours.seconds, reference.seconds
    result.problem = ours.problem or reference.problem
    if ours.pictures:
        result.ours = ours.load().mean(0)
    if reference.pictures:
        result.reference = reference.load().mean(0)
    if not result.problem:
        a, b = ours.load(), reference.load()
        result.judgement = judge.judge(a, b)
        if ours.facts["cells"]:
            result.cells = judge.cells(a, b, ours.facts["cells"], ours.facts["cell"])
    return result


def line(result: Result) -> str:
    """One file as text."""
    text = f"{result.verdict.upper():5} {result.host:5} {result.name}{' (motion blur)' if result.blur else ''}"
    j = result.judgement
    if result.problem or j is None or j.problem:
        return f"{text}: {result.problem or (j and j.problem) or 'no picture'}"
    means = " ".join(f"{name} {f.value:+.1%}±{f.noise:.1%}" for name, f in j.means.items())
    total, has, same, missing = result.nodes
    text += f"   mean {means}   median block {j.block.value:.1%} (noise {j.block.noise:.1%}), 95th {j.worst_blocks:.1%}"
    text += f"   {total} nodes, {has / total:.1%} supported, {same / total:.1%} exactly" if total else "   no nodes"
    if missing:
        text += f"   missing: {', '.join(f'{k} {n}' for k, n in sorted(missing.items()))}"
    if result.cells:
        good = sum(c.verdict != "fail" for c in result.cells.values())
        text += f"   {good} of {len(result.cells)} materials"
    return text + f"   {result.seconds[0]:.1f} and {result.seconds[1]:.1f} s"


def cell_lines(result: Result) -> list[str]:
    """The materials of a library that differ, the worst first."""
    def size(j: judge.Judgement) -> float:
        return max((abs(f.value) for f in j.means.values()), default=np.inf)

    bad = sorted(((n, j) for n, j in result.cells.items() if j.verdict == "fail"), key=lambda i: -size(i[1]))
    return [f"      {name}: " + (j.problem or " ".join(f"{c} {f.value:+.1%}" for c, f in j.means.items())
                                  + f" median block {j.block.value:.1%}") for name, j in bad]


def totals(results: list[Result], known: dict[str, str]) -> str:
    counts: Counter = Counter()
    for r in results:
        counts.update(r.counts)
    total, has, same, missing = census.shares(counts, known)
    text = f"nodes: {total} instances, {has / max(total, 1):.2%} supported ({same / max(total, 1):.2%} as in Cycles)"
    return text + (f"; missing {dict(Counter(missing).most_common())}" if missing else "")


def main() -> int:
    options = arguments()
    known = census.states(hosts.ROOT / "docs" / "nodes.md")
    found = {h.name: h for h in hosts.find()[0]}
    results, skipped, begun = [], [], time.monotonic()
    for blend in sorted(Path(options.blends).rglob("*.blend")):
        if options.file and not any(part in blend.stem for part in options.file):
            continue
        host = host_for(blend, found, options.host)
        if host is None:
            skipped.append(f"skipped {blend.stem}: no Blender here opens it")
            continue
        result = compare_file(blend, host, options, known)
        if options.blur and not result.had_blur:
            continue
        results.append(result)
        print("\n".join([line(result), *cell_lines(result), *(f"      {m}" for m in result.messages)]), flush=True)
    print(totals(results, known))
    options.html.parent.mkdir(parents=True, exist_ok=True)
    options.html.write_text(page.page(results, line, cell_lines, totals(results, known)))
    print(f"{os.path.relpath(options.html)}   {time.monotonic() - begun:.0f} s")
    for text in skipped:
        print(text)
    passed = sum(r.verdict in ("pass", "noise") for r in results)
    print(f"{passed} passed, {len(results) - passed} failed, {len(skipped)} skipped")
    return 0 if passed and passed == len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
