# SPDX-License-Identifier: GPL-3.0-or-later
"""Error over CPU time of PT, PTPPM and SPPM (thesis Fig. 5.11 and 5.14).

A curve is one render that goes on: every mark adds a range of samples, and the picture is the mean of all ranges so far
(passes are independent, so it is the picture of one long render). What later ranges repeat, start-up and training, is
known from a short run and counted once.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from . import convergence_figures, exr, outcome, peer_scenes, result, runs, titles, verdicts
from . import options as common
from .engines import Job
from .progress import Progress

COLUMNS = {"scene": "", "mark": "g", "method": "", "runs": "d", "cpu": ".2f", "samples": ".0f"}
COLUMNS |= peer_scenes.COLUMNS | {"noise": ".4f", "reference": ".1%"}
MARKS, FULL_MARKS = "2,4,8,16", "2,4,8,16,32,64,128"
SETTINGS = {
    "PT": "integrator path tracing: every class by camera paths, next-event estimation with MIS; 24 bounces",
    "PTPPM": "the add-on's defaults: caustics by guided photons, the rest by path tracing; 24 bounces",
    "SPPM": "integrator photon mapping with a photon a pixel and sample, the number that served it best; 24 bounces",
}


def add_arguments(commands) -> None:
    parser = commands.add_parser("convergence", help="error over CPU time of PT, PTPPM, SPPM (thesis Fig. 5.11, 5.14)")
    peer_scenes.add_argument(parser)
    parser.add_argument("--marks", default="", help=f"CPU seconds ({MARKS}, or {FULL_MARKS} with --full)")
    parser.add_argument("--seeds", type=int, default=0, help="renders of each (2, or 3 with --full)")
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
    """Medians over the seeds, mark by mark, the seeds' range, and the noise that their scatter tells of."""
    rows = []
    for mark in sorted({point["mark"] for one in curves for point in one}):
        found = [point for one in curves for point in one if point["mark"] == mark]
        row = {"scene": scene.name, "method": method, "runs": len(found), **peer_scenes.medians(found)}
        for figure in verdicts.POWER:
            row[f"{figure}_low"] = min(point[figure] for point in found)
            row[f"{figure}_high"] = max(point[figure] for point in found)
        noise = peer_scenes.noise([point["picture"] for point in found], scene.masks["all"])
        rows.append(row | {"noise": noise})
    return rows


def measure_all(records, options, engine, scenes, marks, seeds: int) -> dict[tuple[int, str], list[list[dict]]]:
    """Curves by (number of the scene, method), one a seed; a seed goes through all scenes before the next one."""
    curves: dict[tuple[int, str], list[list[dict]]] = {}
    progress = Progress(seeds * len(scenes) * len(options.methods.split(",")), records)
    for seed in range(1, seeds + 1):
        for index, scene in enumerate(scenes):
            for method in options.methods.split(","):
                progress.step(f"{scene.name}, {method}, seed {seed}")
                settings = runs.METHODS[method]
                points = curve(records, options.cache, engine, scene, settings, seed, marks, options.threads)
                if points:
                    curves.setdefault((index, method), []).append(points)
                said = ", ".join(f"{p['cpu']:.1f} s {p['rmse']:.4f}" for p in points)
                print(f"   {said or 'out of time'}", flush=True)
    return curves


def found_out(options, engine, scenes, curves, rows, marks, seeds: int) -> result.Result:
    """All but plots and pictures."""
    wanted = len(marks) * seeds * len(scenes) * len(options.methods.split(","))
    points = sum(len(one) for found in curves.values() for one in found)
    found = result.Result(
        "convergence", "Error over CPU time: PT, PTPPM, SPPM", "./scripts/bench convergence --full", not options.full
    )
    title = "Error, energy and CPU seconds of the methods (thesis Fig. 5.11)"
    note = f"Medians of {seeds} seeds. Last column: the reference's own squared error as a share of the measured one."
    note = " ".join([note, *verdicts.notes(rows)])
    found.tables = [result.Table("convergence", title, titles.columns(COLUMNS), rows, note)]
    found.verdicts = [*verdicts.lowest(rows, peer_scenes.NAMES), verdicts.energies(rows), *verdicts.references(rows)]
    found.settings = {method: SETTINGS[method] for method in options.methods.split(",")}
    found.complete = points == wanted
    found.versions = {"cardioid-render": engine.stamp()}
    return found


def run(options, found) -> int:
    engine = runs.engine_of(found)
    marks = sorted(float(mark) for mark in (options.marks or (FULL_MARKS if options.full else MARKS)).split(","))
    seeds = options.seeds or (3 if options.full else 2)
    records = common.records_of(options, "convergence")
    scenes = peer_scenes.load_all(options.peers, options.scene)
    curves = measure_all(records, options, engine, scenes, marks, seeds)
    rows = [row for (index, method), one in curves.items() for row in rows_of(scenes[index], method, one)]
    rows.sort(key=lambda row: (row["scene"], row["mark"]))
    if not rows:
        print("The time ended before the first mark.")
        return 1
    made = found_out(options, engine, scenes, curves, rows, marks, seeds)
    convergence_figures.add(made, options.cache, scenes, curves, rows)
    return outcome.finish(made, options, records)
