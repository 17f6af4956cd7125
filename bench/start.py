# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds from F12 to the first tile: of Blender's default scene and of a million triangles."""

from __future__ import annotations

import re
import statistics

from . import kept, outcome, result, store
from . import options as common
from .engines import Engine, Job
from .grids import build_grid
from .progress import Progress

FIRST_SAMPLE = re.compile(r"\bSample [1-9]\d*/|\b[1-9]\d* of \d+ samples")
BUILT = re.compile(r"\bSample \d+/|\b\d+ of \d+ samples")
COLUMNS = {
    "scene": ["scene", ""],
    "who": ["engine", ""],
    "built": ["end of the build, s", ".3f"],
    "first_tile": ["first tile or sample, s", ".3f"],
    "one_sample": ["whole picture of one sample, s", ".3f"],
    "cpu": ["CPU s of the process", ".2f"],
    "energy": ["energy over Cycles'", ".4f"],
    "runs": ["runs", "d"],
}
NOTE = (
    "Wall seconds after F12, medians. The first two are the engine's own clock (ours) or its printed progress (Cycles, "
    "which does not print at once: its first sample is done with a picture of one sample at the latest)."
)


def add_arguments(commands) -> None:
    parser = commands.add_parser("start", help="F12 to the first tile; export and build of a million triangles")
    parser.add_argument("--runs", type=int, default=0, help="of each engine and scene (3; 7 with --full)")


def since_f12(lines: list[tuple[float, str]], pattern: re.Pattern) -> float | None:
    """Seconds from the line `F12` to the first later line that matches."""
    pressed = next((t for t, text in lines if text == "F12"), None)
    if pressed is None:
        return None
    return next((t - pressed for t, text in lines if t >= pressed and pattern.search(text)), None)


def one_run(records: store.Store, engine: Engine, job: Job) -> dict | None:
    """Seconds of one start: `built`, `first_tile`, `one_sample`, `cpu`; None: out of time."""
    whole = kept.run(records, engine, job, "start")
    if whole is None:
        return None
    out = {"one_sample": whole["render_wall"], "cpu": whole["cpu"], "mean": whole["mean"]}
    seconds = whole["counters"].get("seconds")
    if seconds:
        exported = whole["counters"]["export_seconds"]
        return out | {"built": exported + seconds["build"], "first_tile": exported + seconds["first_tile"]}
    long = Job(job.blend, "", 4096, job.seed, job.threads, width=job.width)
    first = kept.run(records, engine, long, "first", until=lambda text: bool(FIRST_SAMPLE.search(text)))
    if first is None:
        return None
    tile = min(since_f12(first["lines"], FIRST_SAMPLE) or float("inf"), whole["render_wall"])
    return out | {"built": since_f12(first["lines"], BUILT), "first_tile": tile}


def row_of(name: str, engine: Engine, found: list[dict]) -> dict:
    """Medians over the runs; what was not told in any is left out."""
    row = {"scene": name, "engine": engine.key, "who": engine.title, "runs": len(found)}
    for key in ("built", "first_tile", "one_sample", "cpu", "mean"):
        values = [one[key] for one in found if one.get(key) is not None]
        row[key] = statistics.median(values) if values else None
    return row


def measure(options, records: store.Store, pair: list[Engine]) -> list[dict]:
    grid = options.cache / "scenes" / "grid-708.blend"
    build_grid(grid, 708)
    runs, rows = options.runs or (7 if options.full else 3), []
    scenes = (("default scene", "", 1920), ("million triangles", str(grid), 256))
    progress = Progress(len(scenes) * runs * len(pair), records)
    for name, blend, width in scenes:
        found: dict[str, list[dict]] = {engine.key: [] for engine in pair}
        for seed in range(1, runs + 1):
            for engine in pair if seed % 2 else pair[::-1]:
                progress.step(f"{name}, {engine.title}, run {seed}")
                one = one_run(records, engine, Job(blend, "yes", 1, seed, options.threads, width=width))
                found[engine.key] += [one] if one else []
        if all(found.values()):
            own = [row_of(name, engine, found[engine.key]) for engine in pair]
            for row in own:
                row["energy"] = row["mean"] / max(own[1]["mean"], 1e-12)
            rows += own
    return rows


def verdicts(rows: list[dict], ours: str) -> list[result.Verdict]:
    """Ours and its rival's rows follow each other."""
    out = []
    for own, other in zip(rows[0::2], rows[1::2]):
        said = f"{own['first_tile']:.2f} s against {other['first_tile']:.2f} s"
        sooner = own["first_tile"] <= other["first_tile"]
        out.append(
            result.Verdict(f"{own['scene']}: the first tile no later than Cycles' first sample", "bench", sooner, said)
        )
    return out


def run(options, found) -> int:
    pair = common.usable(found, options.ours, options.rival)
    records = common.records_of(options, "start")
    rows = measure(options, records, pair)
    out = result.Result("start", "From F12 to the first tile", "./scripts/bench start --full", not options.full)
    out.tables = [result.Table("start", out.title, COLUMNS, rows, NOTE)]
    out.settings = {engine.title: "path tracing, one sample, caustics off" for engine in pair}
    out.verdicts = verdicts(rows, pair[0].key)
    return outcome.finish(out, options, records)
