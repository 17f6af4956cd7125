# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of our command line program under given settings: how long a sample takes, and records that are kept."""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from pathlib import Path

from . import store
from .engines import Engine, Job

FIRST_SAMPLES = 8
"""The engine's training passes (render/passes.h): photons learn during these samples, then nothing changes any more."""
PROBE_SAMPLES = 24

METHODS = {
    "PT": ("integrator=path_tracing",),
    "PTPPM": ("integrator=hybrid",),
    "SPPM": ("integrator=photon_mapping", "photons=65536"),
}
"""SPPM has a photon a pixel of the peers' scenes: of the counts that were tried the one with the lowest error."""


def engine_of(found: dict[str, Engine]) -> Engine:
    """Our command line program. Ends the program with one sentence when it cannot run."""
    engine = found["cardioid-cli"]
    if engine.problem():
        sys.exit(f"{engine.key} cannot run: {engine.problem()}")
    return engine


def identity(kind: str, engine: Engine, job: Job) -> tuple:
    """A run's key in the records; a changed scene file or program makes another one."""
    blend = Path(job.blend)
    where = (blend.stem, f"{blend.stat().st_mtime_ns:x}", job.width, job.bounces, job.threads)
    return (kind, engine.key, engine.stamp(), *where, ",".join(job.settings), job.samples, job.seed)


def measured(records: store.Store, cache: Path, engine: Engine, job: Job, kind: str = "run") -> dict | None:
    """One run's record, made now if it is not there; its picture is kept in the cache. None: out of time."""
    key = identity(kind, engine, job)
    path = cache / "runs" / ("-".join(str(part) for part in key).replace("=", "_").replace(",", "-") + ".exr")
    found = records.get(*key)
    if found and path.exists():
        return found | {"path": str(path)}
    if records.out_of_time(key):
        return None
    path.parent.mkdir(parents=True, exist_ok=True)
    done = store.render(engine, replace(job, out=str(path)))
    kept = {name: done[name] for name in ("cpu", "wall", "peak_bytes", "load") if name in done}
    kept["stats"] = (done.get("stats", {}).get("renders") or [{}])[-1].get("engine", {})
    return records.add(key, kept) | {"path": str(path)}


@dataclass
class Pace:
    """CPU seconds of a process: `first` for start-up and the first samples, then `each` for every further one."""

    first: float
    each: float

    def samples(self, seconds: float) -> int:
        """How many samples a process of `seconds` makes: whole passes, at least the training ones."""
        return FIRST_SAMPLES + whole_passes((seconds - self.first) / self.each)

    def repeated(self, trains: bool) -> float:
        """What a process that goes on with a later sample spends before it: start-up, and training if there is any."""
        return self.first if trains else max(0.0, self.first - FIRST_SAMPLES * self.each)


def whole_passes(samples: float) -> int:
    """Samples rounded to passes of eight, which the engine makes after training."""
    return 8 * max(0, round(samples / 8))


def pace(records: store.Store, cache: Path, engine: Engine, job: Job) -> Pace | None:
    """From two short runs of their own seed. None: out of time."""
    costs = []
    for samples in (FIRST_SAMPLES, PROBE_SAMPLES):
        run = measured(records, cache, engine, replace(job, samples=samples, seed=0), "probe")
        if run is None:
            return None
        costs.append(run["cpu"])
    return Pace(costs[0], max((costs[1] - costs[0]) / (PROBE_SAMPLES - FIRST_SAMPLES), 1e-4))


def trains(run: dict) -> bool:
    return run["stats"].get("photons", {}).get("training_passes", 0) > 0
