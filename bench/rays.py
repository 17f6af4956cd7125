# SPDX-License-Identifier: GPL-3.0-or-later
"""Camera paths and rays per CPU second, beside Cycles' and a bare Embree loop's."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
from dataclasses import replace
from pathlib import Path

from . import charts, kept, outcome, programs, result, store
from . import options as common
from .engines import BUILT, CommandLine, Engine, Job
from .progress import Progress
from .scene_list import Scene

COLUMNS = {
    "scene": ["scene", ""],
    "who": ["engine", ""],
    "cpu": ["CPU s", ".2f"],
    "paths": ["camera paths per CPU s", ".3e"],
    "rays": ["rays per CPU s", ".3e"],
    "per_path": ["rays a path", ".2f"],
    "of_rival": ["paths over Cycles'", ".2f"],
    "of_embree": ["of a bare Embree loop", ".1%"],
    "energy": ["energy over Cycles'", ".4f"],
}
NOTE = (
    "CPU seconds of the samples alone: the run's less those of a run with one sample, medians. Cycles counts no "
    "rays: it is given ours a path. Energy: mean of the picture over Cycles'; the error is not measured here but by "
    "`efficiency`. The bare loop traces the same rays, one thread, with nothing around (bench/cpp/embree_loop.cpp); "
    "`of a bare Embree loop` is our engine's share of its speed, camera paths without export or photons."
)
FULL_SCENES = (*common.REDUCED, "textured_interior", "hdri_exterior", "million_triangles")


def add_arguments(commands) -> None:
    parser = commands.add_parser("rays", help="camera paths and rays per CPU second, beside Cycles' and Embree's")
    parser.add_argument("--samples", type=int, default=0, help="of a run (32; 128 with --full)")
    parser.add_argument("--runs", type=int, default=0, help="of each engine and scene (2; 5 with --full)")
    parser.add_argument("--scale", type=float, default=0.0, help="of each scene's picture size (0.67; 1 with --full)")


def embree_loop() -> str:
    """The program of the bare loop: CARDIOID_EMBREE_LOOP, or the one that scripts/bench builds; empty without it."""
    built = BUILT / "bench" / "cpp" / "embree_loop"
    path = os.environ.get("CARDIOID_EMBREE_LOOP", str(built))
    return path if Path(path).exists() else ""


def bare(records: store.Store, command_line: CommandLine, scene: Scene, job: Job) -> dict | None:
    """What the bare loop says of a scene; None without it, if it fails (that is said) or out of time."""
    program = embree_loop()
    if not program or command_line.problem():
        return None
    key = ("embree", programs.of_file(Path(program)), *kept.identity("loop", command_line, job)[3:8])
    found = records.get(*key)
    if found or records.out_of_time(key):
        return found
    words = [program, str(command_line.scene_file(job))]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        print(f"{scene.name}: the bare Embree loop failed: {done.stderr.strip()[-200:]}")
        return None
    return records.add(key, json.loads(done.stdout))


def figures(runs: list[dict], ones: list[dict], samples: int) -> dict:
    """Medians of one engine: CPU seconds of `samples` samples, paths a second, rays a path where they are counted."""
    cpu = statistics.median(run["cpu"] for run in runs) - statistics.median(run["cpu"] for run in ones)
    row = {"cpu": max(cpu, 1e-3), "mean": statistics.mean(run["mean"] for run in runs)}
    row["paths"] = runs[0]["pixels"] * samples / row["cpu"]
    counts = runs[-1]["counters"].get("counts")
    if counts:
        row["per_path"] = (counts["rays"] + counts["shadow_rays"]) / max(counts["camera_paths"], 1)
    return row


def rows_of(scene: Scene, pair: list[Engine], found: dict[str, dict], loop: dict | None) -> list[dict]:
    """A row for each engine; the second of the pair is the one that the first is compared with."""
    ours, rival = (found[engine.key] for engine in pair)
    rows = []
    for engine in pair:
        own = found[engine.key]
        row = {"scene": scene.name, "engine": engine.key, "who": engine.title, **own}
        per_path = own.get("per_path") or ours.get("per_path")
        row["rays"] = own["paths"] * per_path if per_path else None
        row["of_rival"] = own["paths"] / rival["paths"]
        row["energy"] = own["mean"] / max(rival["mean"], 1e-12)
        if loop and engine is pair[0]:
            row["of_embree"] = loop["share_of_bare_embree"]
        rows.append(row)
    return rows


def measure(options, records: store.Store, pair: list[Engine], command_line: CommandLine) -> list[dict]:
    scenes = common.chosen_scenes(options, FULL_SCENES if options.full else common.REDUCED)
    runs, samples = options.runs or (5 if options.full else 2), options.samples or (128 if options.full else 32)
    scale = options.scale or (1.0 if options.full else 0.67)
    progress = Progress(len(scenes) * (runs * len(pair) + 1), records)
    rows = []
    for scene in scenes:
        job = Job(str(scene.path), "yes", 1, 1, options.threads, width=max(32, round(scene.width * scale)))
        many: dict[str, list[dict]] = {engine.key: [] for engine in pair}
        ones: dict[str, list[dict]] = {engine.key: [] for engine in pair}
        for seed in range(1, runs + 1):
            for engine in pair if seed % 2 else pair[::-1]:
                progress.step(f"{scene.name}, {engine.title}, run {seed}")
                one = kept.run(records, engine, replace(job, seed=seed), "rays")
                run = one and kept.run(records, engine, replace(job, seed=seed, samples=samples + 1), "rays")
                if run:
                    ones[engine.key].append(one)
                    many[engine.key].append(run)
        progress.step(f"{scene.name}, bare Embree loop")
        if all(many.values()):
            found = {engine.key: figures(many[engine.key], ones[engine.key], samples) for engine in pair}
            rows += rows_of(scene, pair, found, bare(records, command_line, scene, job))
    return rows


def verdicts(rows: list[dict], ours: str) -> list[result.Verdict]:
    """The first row of each scene is ours."""
    own = [row for row in rows if row["engine"] == ours]
    if not own:
        return []
    said = "; ".join(f"{row['scene']} {row['of_rival']:.2f} (energy {row['energy']:.4f})" for row in own)
    out = [
        result.Verdict(
            "more camera paths per CPU second than Cycles at equal settings",
            "bench",
            all(row["of_rival"] > 1 for row in own),
            said,
        )
    ]
    even = all(abs(row["energy"] - 1) <= 0.02 for row in own)
    out.append(result.Verdict("the same light as Cycles within 2 %", "bench", even, said))
    return out


def run(options, found) -> int:
    pair = common.usable(found, options.ours, options.rival)
    command_line = found["cardioid-cli"]
    records = common.records_of(options, "rays")
    rows = measure(options, records, pair, command_line)
    out = result.Result("rays", "Camera paths and rays per CPU second", "./scripts/bench rays --full", not options.full)
    out.tables = [result.Table("rays", out.title, COLUMNS, rows, NOTE)]
    out.settings = {engine.title: "path tracing, 24 bounces, caustics off, nothing clamped" for engine in pair}
    out.missing = [] if embree_loop() else ["the bare Embree loop is not built (bench/cpp/embree_loop.cpp)"]
    out.verdicts = verdicts(rows, pair[0].key)
    figures = {"paths": "million camera paths per CPU second", "rays": "million rays per CPU second"}
    if rows and charts.bars(rows, figures, outcome.place(out, options), unit=1e6):
        out.plots = ["rays.png"]
    return outcome.finish(out, options, records)
