# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays per CPU second, seconds to the first tile, bytes per triangle and per pixel."""

from __future__ import annotations

import json
import re
import shlex
import statistics
import subprocess
import tempfile
from pathlib import Path

from . import measure, store
from .engines import Engine, Job
from .scene_list import Scene

FIRST_SAMPLE = re.compile(r"\bSample [1-9]\d*/|\b[1-9]\d* of \d+ samples")
BUILT = re.compile(r"\bSample \d+/|\b\d+ of \d+ samples")


def engine_stats(record: dict) -> dict:
    """The engine's own counters of the last frame in a run's record; empty for engines without any."""
    renders = record.get("stats", {}).get("renders") or [{}]
    return renders[-1].get("engine") or {}


# Rays ------------------------------------------------------------------------------------------------------------


def rays(
    engines: list[Engine], scene: Scene, scale: float, samples: int, runs: int, threads: int, embree_loop: str
) -> list[dict]:
    """Camera paths and rays per CPU second without start-up. Cycles counts no rays: it is given ours per path."""
    rows, per_path = [], None
    for engine in engines:
        job = Job(str(scene.path), "", 1, 1, threads, width=max(32, round(scene.width * scale)))
        fixed, full, last = [], [], {}
        for seed in range(1, runs + 1):
            for count, costs in ((1, fixed), (samples + 1, full)):
                with tempfile.TemporaryDirectory() as folder:
                    out = str(Path(folder) / "out.exr")
                    last = store.render(engine, Job(job.blend, out, count, seed, threads, width=job.width))
                costs.append(last["cpu"])
        cpu = max(statistics.median(full) - statistics.median(fixed), 1e-3)
        counts = engine_stats(last).get("counts", {})
        paths = last.get("pixels", 0) * samples
        row = {
            "scene": scene.name,
            "engine": engine.key,
            "cpu": cpu,
            "paths_per_cpu_s": paths / cpu,
            "counted": bool(counts),
        }
        if counts:
            traced = counts["rays"] + counts["shadow_rays"]
            per_path = traced / max(counts["camera_paths"], 1)
            row["paths_per_cpu_s"] = paths / cpu if paths else counts["camera_paths"] / cpu
        rows.append(row)
    for row in rows:
        row["rays_per_cpu_s"] = row["paths_per_cpu_s"] * per_path if per_path else None
    if embree_loop:
        bare = run_embree_loop(embree_loop, scene)
        for row in rows:
            row["of_embree"] = row["rays_per_cpu_s"] / bare if bare and row["rays_per_cpu_s"] else None
    return rows


def run_embree_loop(command: str, scene: Scene) -> float:
    """Rays per CPU second of a bare Embree loop: a command (`{scene}` is replaced) whose last line is a JSON object
    with `rays_per_cpu_second`, or Google Benchmark's JSON output with a counter of that name."""
    words = [word.replace("{scene}", str(scene.path)) for word in shlex.split(command)]
    text = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    try:
        found = json.loads(text)
    except json.JSONDecodeError:
        found = json.loads(text.strip().splitlines()[-1])
    if "benchmarks" in found:
        return max(float(b["rays_per_cpu_second"]) for b in found["benchmarks"] if "rays_per_cpu_second" in b)
    return float(found["rays_per_cpu_second"])


# Start -----------------------------------------------------------------------------------------------------------


def since_f12(lines: list[tuple[float, str]], pattern: re.Pattern) -> float | None:
    """Seconds from the line `F12` to the first later line that matches."""
    pressed = next((t for t, text in lines if text == "F12"), None)
    return (
        None
        if pressed is None
        else next((t - pressed for t, text in lines if t >= pressed and pattern.search(text)), None)
    )


def first_tile(engine: Engine, blend: str, width: int, runs: int, threads: int) -> dict:
    """Medians of seconds after F12: to the end of the build, to the first tile or sample, to a picture of one sample.

    The last is seen from outside and the same for every engine; the others are the engine's own clock (ours) or its
    printed progress (Cycles, which does not print at once: its first sample counts as done by then at the latest).
    """
    built, first, whole = [], [], []
    for seed in range(1, runs + 1):
        record = store.render(engine, Job(blend, "", 1, seed, threads, width=width))
        whole.append(record["render_wall"])
        entry = (record.get("stats", {}).get("renders") or [{}])[-1]
        seconds = engine_stats(record).get("seconds")
        if seconds:
            built.append(entry.get("export_seconds", 0.0) + seconds["build"])
            first.append(built[-1] - seconds["build"] + seconds["first_tile"])
        else:
            job = Job(blend, "", 4096, seed, threads, width=width)
            lines = store.render(engine, job, until=lambda text: bool(FIRST_SAMPLE.search(text)))["lines"]
            built.append(since_f12(lines, BUILT) or float("nan"))
            first.append(min(since_f12(lines, FIRST_SAMPLE) or float("inf"), whole[-1]))
    medians = {
        name: statistics.median(v) for name, v in (("built", built), ("first_tile", first), ("one_sample", whole))
    }
    return {"engine": engine.key, **medians, "runs": runs}


# Memory ----------------------------------------------------------------------------------------------------------


def peak(engine: Engine, blend: Path, width: int, threads: int, only_load: bool = False) -> int:
    with tempfile.TemporaryDirectory() as folder:
        out = "" if only_load else str(Path(folder) / "out.exr")
        return store.render(engine, Job(str(blend), out, 1, 1, threads, width=width, only_load=only_load))["peak_bytes"]


def memory(engine: Engine, small: Path, large: Path, triangles: tuple[int, int], threads: int) -> dict:
    """Slopes of the process's peak: bytes per triangle between two meshes less what Blender itself needs for them, and
    bytes per pixel between two resolutions."""
    more = triangles[1] - triangles[0]
    render = (peak(engine, large, 64, threads) - peak(engine, small, 64, threads)) / more
    load = (peak(engine, large, 64, threads, True) - peak(engine, small, 64, threads, True)) / more
    pixels = (peak(engine, small, 3072, threads) - peak(engine, small, 1024, threads)) / (3072**2 - 1024**2)
    return {"engine": engine.key, "per_triangle": render - load, "blender_per_triangle": load, "per_pixel": pixels}


def build_grid(path: Path, side: int) -> int:
    """A wavy grid of 2·side² triangles as a .blend file, made on first use; returns the number of triangles."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        script = Path(__file__).resolve().parent / "scenes" / "build_grid.py"
        command = [
            "blender",
            "-b",
            "--factory-startup",
            "--python-exit-code",
            "1",
            "-P",
            str(script),
            "--",
            str(path),
            str(side),
        ]
        cost = measure.run(command)
        if not path.exists():
            raise RuntimeError("the grid could not be built:\n" + "\n".join(text for _, text in cost.lines[-8:]))
    return 2 * side * side
