# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs whose figures are kept and whose pictures are not: cost, counters, brightness."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from . import exr, store
from .engines import Engine, Job

FIGURES = ("cpu", "wall", "peak_bytes", "load", "render_cpu", "render_wall", "pixels", "version")


def identity(kind: str, engine: Engine, job: Job) -> tuple:
    """A run's key in the records: the engine's program and the scene's file are part of it."""
    blend = Path(job.blend) if job.blend else None
    where = (blend.stem, f"{blend.stat().st_mtime_ns:x}") if blend else ("default", "")
    how = (job.width, job.bounces, job.caustics, job.threads, job.only_load, ",".join(job.settings))
    return (kind, engine.key, engine.stamp(), *where, *how, job.samples, job.seed)


def counters(done: dict) -> dict:
    """The engine's own counts of the last frame; empty for engines without any."""
    renders = done.get("stats", {}).get("renders") or [{}]
    return (renders[-1].get("engine") or {}) | {"export_seconds": renders[-1].get("export_seconds", 0.0)}


def run(records: store.Store, engine: Engine, job: Job, kind: str, until=None) -> dict | None:
    """The record, made now if it is not there. `counters`: the engine's; `mean`: of the picture, where one was asked
    for (any `out`); `lines`: what was printed, where `until` is given. None: out of time."""
    key = identity(kind, engine, job)
    found = records.get(*key)
    if found:
        return found
    if records.out_of_time(key):
        return None
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder) / "out.exr") if job.out else ""
        done = store.render(engine, replace(job, out=out), until)
        record = {name: done[name] for name in FIGURES if name in done} | {"counters": counters(done)}
        if out:
            record["mean"] = float(exr.load(Path(out)).mean())
        if until:
            record["lines"] = done["lines"]
    return records.add(key, record)
