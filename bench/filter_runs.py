# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders that keep their film, and films filtered again, as records that are kept."""

from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from . import measure, runs, store
from .engines import CommandLine, Job


def filter_program(engine: CommandLine) -> str:
    """CARDIOID_FILTER, or the program beside the renderer."""
    return os.environ.get("CARDIOID_FILTER", str(Path(engine.program).with_name("cardioid-filter")))


def clean(name: str) -> str:
    return name.replace("=", "_").replace(",", "-").replace("/", "_")


def run_filter(engine: CommandLine, film: Path, out: Path, settings: tuple[str, ...], threads: int) -> dict:
    """Filters a film file; returns what the program counted."""
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder) / "stats.json"
        command = [filter_program(engine), str(film), "-o", str(out), "-q", "--stats", str(stats)]
        command += ["--threads", str(threads)]
        for setting in settings:
            command += ["--set", setting]
        cost = measure.run(command)
        if cost.code:
            raise store.failure("the film was not filtered", cost.lines, out)
        return json.loads(stats.read_text())


@dataclass
class Film:
    """One render, filtered as often as wanted. Its film is large: rendered when first needed, removed by `forget`."""

    records: store.Store
    cache: Path
    engine: CommandLine
    job: Job

    @property
    def key(self) -> tuple:
        return runs.identity("film", self.engine, self.job)

    @property
    def path(self) -> Path:
        return self.cache / "films" / (clean("-".join(str(part) for part in self.key)) + ".cardioid")

    def picture(self, name: str) -> Path:
        return self.path.with_name(self.path.stem + clean(name) + ".exr")

    def rendered(self) -> dict | None:
        """The render's record (`cpu`: of its process without start-up's export; `stats`), its film in place."""
        found = self.records.get(*self.key)
        if found and self.path.exists() and self.picture("-raw").exists():
            return found
        if self.records.out_of_time(self.key):
            return None
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            job = replace(self.job, out=str(self.picture("-raw")))
            command, env = self.engine.command(job, Path(folder))
            cost = measure.run([*command, "--set", "record_clusters=true", "--film", str(self.path)], env=env)
            if cost.code:
                self.forget()
                raise store.failure("no film was rendered", cost.lines, self.path)
            stats = json.loads((Path(folder) / "stats.json").read_text())
        return self.records.add(self.key, {"cpu": stats["cpu_seconds"], "process_cpu": cost.cpu, "stats": stats})

    def raw(self) -> tuple[dict, Path] | None:
        """The record and picture of the render, from the cache if they are there, film or not."""
        found = self.records.get(*self.key)
        if not (found and self.picture("-raw").exists()):
            found = self.rendered()
        return (found, self.picture("-raw")) if found else None

    def filtered(self, settings: tuple[str, ...], run: int = 0) -> tuple[dict, Path] | None:
        """Record (`cpu_seconds`, `seconds`, counts) and picture of the film filtered under these settings."""
        key = (*self.key, "filter", ",".join(settings), run)
        path = self.picture("-" + "-".join(settings))
        found = self.records.get(*key)
        if found and path.exists():
            return found, path
        if self.rendered() is None or self.records.out_of_time(key):
            return None
        return self.records.add(key, run_filter(self.engine, self.path, path, settings, self.job.threads)), path

    def forget(self) -> None:
        self.path.unlink(missing_ok=True)
