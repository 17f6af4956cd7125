# SPDX-License-Identifier: GPL-3.0-or-later
"""References: the mean of long runs with seeds that no measured run uses, and the error that this mean itself has."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from . import exr, metrics, store
from .engines import Engine, Job

FIRST_SEED = 500_000


@dataclass
class Reference:
    mean: np.ndarray
    error: dict[str, float]
    """Expected relmse and mse of the mean, from the scatter of its parts."""
    parts: int
    paths: list[Path] = field(default_factory=list)
    records: list[dict] = field(default_factory=list)


def make(
    records: store.Store, cache: Path, engine: Engine, name: str, job: Job, parts: int, first_seed: int = FIRST_SEED
) -> Reference | None:
    """The reference of a scene from `parts` pictures under a job's settings; None if time ran out before two."""
    pictures, paths, kept = [], [], []
    stamp = f"{Path(job.blend).stat().st_mtime_ns:x}"
    for part in range(parts):
        key = ("reference", engine.key, name, stamp, job.width, job.samples, job.bounces, job.caustics, part)
        key += tuple(filter(None, (engine.stamp(), *job.settings)))
        if first_seed != FIRST_SEED:
            key += (first_seed,)
        path = cache / "references" / ("-".join(str(k) for k in key[1:]) + ".exr")
        if not (records.get(*key) and path.exists()):
            if records.out_of_time(key):
                break
            path.parent.mkdir(parents=True, exist_ok=True)
            done = store.render(engine, replace(job, out=str(path), seed=first_seed + part))
            records.add(key, {"cpu": done["cpu"], "wall": done["wall"]})
            print(f"   {name}: reference {part + 1}/{parts}, {done['cpu']:.1f} CPU s", flush=True)
        pictures.append(exr.load(path))
        paths.append(path)
        kept.append(records.get(*key))
    if len(pictures) < 2:
        return None
    stack = np.array(pictures, np.float64)
    return Reference(stack.mean(0), metrics.reference_error(stack), len(pictures), paths, kept)
