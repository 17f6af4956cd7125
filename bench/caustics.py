# SPDX-License-Identifier: GPL-3.0-or-later
"""Error over CPU time of PT, PTPPM and SPPM (thesis Fig. 5.11).

A curve is one render that goes on: every mark adds a range of samples, and the picture is the mean of all ranges so far
(passes are independent, so it is the picture of one long render). What later ranges repeat, start-up and training, is
known from a short run and counted once.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from . import exr, peer_scenes, plot, runs, store
from .engines import Job

TIE = 0.10
COLUMNS = {"scene": "", "mark": "g", "method": "", "runs": "d", "cpu": ".2f", "samples": ".0f"}
COLUMNS |= peer_scenes.COLUMNS | {"noise": ".4f", "reference": ".1%"}
POWER = {"rmse": 0.5, "relmse": 1.0}


def add_arguments(commands) -> None:
    parser = commands.add_parser("caustics", help="error over CPU time of PT, PTPPM and SPPM (thesis Fig. 5.11)")
    peer_scenes.add_argument(parser)
    parser.add_argument("--marks", default="4,8,16,32,64,128", help="CPU seconds (%(default)s)")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--methods", default=",".join(runs.METHODS))


def next_part(done: int, spent: float, mark: float, pace: runs.Pace) -> int:
    """How many samples to add so that the curve reaches a mark; 0: it is there already."""
    if done == 0:
        return pace.samples(mark)
    return runs.whole_passes((mark - spent) / pace.each)


def curve(records, cache: Path, engine, scene, settings: tuple[str, ...], seed: int, marks, threads: int) -> list[dict]:
    """Figures at each mark; fewer if time runs out."""
    job = Job(str(scene.blend), "", 1, seed, threads, caustics=True, settings=settings)
    pace = runs.pace(records, cache, engine, job)
    if pace is None:
        return []
    repeated, points, done, spent, total = 0.0, [], 0, 0.0, 0.0
    for mark in marks:
        count = next_part(done, spent, mark, pace)
        if count:
            part = Job(str(scene.blend), "", count, seed, threads, caustics=True)
            part = replace(part, settings=(*settings, f"first_sample={done}"))
            run = runs.measured(records, cache, engine, part)
            if run is None:
                break
            repeated = pace.repeated(runs.trains(run)) if done else 0.0
            cost = max(run["cpu"] - repeated, 1e-3)
            picture = exr.load(Path(run["path"])).astype(np.float64)
            total = (total * done + picture * count) / (done + count)
            fresh = count if done else count - runs.FIRST_SAMPLES
            if fresh >= runs.PROBE_SAMPLES:
                pace.each = (cost - (0.0 if done else pace.first)) / fresh
            done, spent = done + count, spent + cost
        picture = np.float32(total)
        points.append({"mark": mark, "cpu": spent, "samples": done, "picture": picture, **scene.evaluate(picture)})
    return points


def rows_of(scene, method: str, curves: list[list[dict]]) -> list[dict]:
    """Medians over the seeds, mark by mark, and the noise that their scatter tells of."""
    rows = []
    for mark in sorted({point["mark"] for one in curves for point in one}):
        found = [point for one in curves for point in one if point["mark"] == mark]
        row = {"scene": scene.name, "method": method, "runs": len(found), **peer_scenes.medians(found)}
        noise = peer_scenes.noise([point["picture"] for point in found], scene.masks["all"])
        rows.append(row | {"noise": noise})
    return rows


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


def notes(rows: list[dict]) -> list[str]:
    out = []
    for figure in ("rmse", "relmse"):
        found = judge(rows, figure)
        for v in found:
            ratio = f"PTPPM's {figure} is {v['ratio']:.2f} of {v['best']}'s"
            out.append(f"{v['scene']}, {v['mark']:g} CPU s: {ratio}: {v['word']}")
        if found:
            lost = sum(v["word"] == "over" for v in found)
            out.append(f"{figure}: PTPPM under PT and SPPM at every time: {'yes' if not lost else f'no, {lost} over'}")
    for row in rows:
        name = f"{row['scene']}, {row['mark']:g} CPU s, {row['method']}"
        if abs(row["energy"] - 1) > 0.01:
            out.append(f"{name}: energy differs from the reference by {row['energy'] - 1:+.2%}")
        if abs(row["cpu"] / row["mark"] - 1) > 0.1:
            out.append(f"{name}: took {row['cpu']:.1f} CPU s")
        if row["reference"] > 0.1:
            out.append(f"{name}: the reference's own error is {row['reference']:.0%} of the squared error")
    return out


def engine_of(found: dict):
    engine = found["cardioid-cli"]
    if engine.problem():
        sys.exit(f"{engine.key} cannot run: {engine.problem()}")
    return engine


def run(options, found) -> int:
    engine = engine_of(found)
    marks = sorted(float(mark) for mark in options.marks.split(","))
    records = store.Store(options.cache / "caustics.jsonl", options.budget)
    scenes = peer_scenes.load_all(options.peers, options.scene)
    curves: dict[tuple[int, str], list[list[dict]]] = {}
    for seed in range(1, options.seeds + 1):
        for index, scene in enumerate(scenes):
            for method in options.methods.split(","):
                settings = runs.METHODS[method]
                points = curve(records, options.cache, engine, scene, settings, seed, marks, options.threads)
                curves.setdefault((index, method), []).append(points)
                said = ", ".join(f"{p['cpu']:.1f} s {p['rmse']:.4f}" for p in points)
                print(f"   {scene.name}, {method}, seed {seed}: {said or 'out of time'}", flush=True)
    rows = [row for (index, method), one in curves.items() for row in rows_of(scenes[index], method, one)]
    rows.sort(key=lambda row: (row["scene"], row["mark"]))
    stem = options.cache / "caustics"
    store.publish(rows, COLUMNS, stem)
    if plot.curves(rows, stem.with_suffix(".png")):
        print(f"{stem.with_suffix('.png')}")
    for note in notes(rows):
        print(note)
    return 0 if rows else 1
