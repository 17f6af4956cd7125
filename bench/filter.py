# SPDX-License-Identifier: GPL-3.0-or-later
"""Clusters, rejection and the filter beside other ways to a picture of few samples (thesis Figs. 6.10 to 6.17)."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from . import (
    charts,
    denoise,
    filter_convergence,
    filter_methods,
    filter_pictures,
    filter_quality,
    filter_references,
    filter_runs,
    filter_scenes,
    filter_tables,
    filter_verdicts,
    outcome,
    result,
    store,
)
from . import options as common
from .engines import CommandLine
from .progress import Progress

REDUCED = (filter_scenes.GLOSSY, filter_scenes.BUST, filter_scenes.GRID, f"{filter_scenes.BUST} (hybrid)")
JUDGED = filter_quality.JUDGED
SETTINGS = {
    "Cardioid": "path tracing, or photons and paths where the scene's name says hybrid; 16 bounces, nothing clamped",
    "raw": "no filter; `equal time`: as many samples as fit the time of `clusters`, filter included",
    "clusters": "the default filter: outlier rejection, then clusters",
    "thesis": "the filter as the thesis has it (6.3), on our clusters",
    "cross-bilateral": "feature weights alone (6.4's peer), with a wide (0.5) and a narrow (0.05) texture weight",
    "OIDN": "Intel Open Image Denoise, HDR, albedo and normal from Cycles (pyoidn): as Cycles uses it",
    "clamped at n": "indirect light clamped, as artists do, no filter",
}


def add_arguments(commands) -> None:
    parser = commands.add_parser("filter", help="the filter beside others: error over samples, pictures, rejection")
    parser.add_argument("--counts", default="", help="samples, with commas (4,16,64,256; to 1024 with --full)")
    parser.add_argument("--width", type=int, default=0, help="of the pictures (256; 384 with --full)")
    parser.add_argument("--pairs", type=int, default=0, help="for the cost of clusters while rendering (3; 9)")


def settle(options) -> None:
    """Defaults that depend on the size."""
    options.counts = [int(n) for n in (options.counts or "4,16,64,256" + (",1024" if options.full else "")).split(",")]
    options.width = options.width or (384 if options.full else 256)
    options.pairs = options.pairs or (9 if options.full else 3)
    options.pair_width = options.width


def referee_engine(engine: CommandLine, options) -> CommandLine:
    """CARDIOID_REFEREE: another build that renders the references, so that they outlive changes of the judged one."""
    program = os.environ.get("CARDIOID_REFEREE", engine.program)
    return CommandLine(program, engine.addon, options.cache)


class Findings:
    """Rows, plots and pictures, scene by scene."""

    def __init__(self, options, records: store.Store, engine: CommandLine):
        self.options, self.records, self.engine = options, records, engine
        self.rows: list[dict] = []
        self.curve: list[dict] = []
        self.pictures: list[result.Picture] = []
        self.plots: list[str] = []
        self.details: list[tuple] = []
        self.references: dict[str, str] = {}
        self.missing: list[str] = []
        self.place = result.folder(options.cache, "filter")
        self.place.mkdir(parents=True, exist_ok=True)

    def scene(self, name: str, progress: Progress) -> None:
        """Every method at every number of samples; pictures and rejection at the judged one."""
        options, scene = self.options, filter_scenes.SCENES[name]
        referee, words, problem = filter_references.referee(
            self.records, options, referee_engine(self.engine, options), scene, options.width
        )
        if problem:
            self.missing.append(problem)
            print(problem, flush=True)
        if referee is None:
            return
        self.references[name] = words
        surface = filter_scenes.surface(options.cache, scene, options.width)
        for samples in options.counts:
            progress.step(f"{name}, {samples} samples")
            job = scene.job(samples, 1, options.width, options.threads)
            film = filter_runs.Film(self.records, options.cache, self.engine, job)
            found = filter_quality.pictures_of(film, surface)
            self.rows += filter_quality.rows_of(found, name, samples, referee)
            if samples == JUDGED and "clusters" in found:
                self.judged(film, scene, found, referee)
            film.forget()

    def judged(self, film, scene, found, referee) -> None:
        rows = [row for row in self.rows if row["scene"] == scene.name and row["samples"] == JUDGED]
        self.pictures += filter_pictures.singles(scene.name, found, referee.mean, rows, self.place)
        if scene.mode == "path tracing":
            self.curve += filter_tables.over_n(film, scene.name)
        self.plots += filter_pictures.figures(film, scene, self.place)
        detail = filter_pictures.detail(film, scene)
        self.details += [detail] if detail else []


def costs_of(options, records, engine, progress: Progress) -> list[dict]:
    """What recording clusters costs while rendering."""
    rows = []
    for name in filter_tables.NAMES if options.full else filter_tables.NAMES[:1]:
        progress.step(f"{name}, with and without clusters, {options.pairs} pairs")
        row = filter_tables.overhead(records, options, engine, filter_scenes.SCENES[name])
        rows += [row] if row else []
    return rows


def convergence_of(options, records, engine, progress: Progress) -> list[dict]:
    """The filtered picture beside the raw one as samples are added."""
    rows = []
    names = filter_convergence.NAMES if options.full else filter_convergence.NAMES[:1]
    counts = filter_convergence.COUNTS if options.full else filter_convergence.COUNTS[:-1]
    for name in names:
        progress.step(f"{name}, to {counts[-1]} samples: does the filter vanish")
        rows += filter_convergence.rows_of(records, options, engine, filter_scenes.SCENES[name], counts)
    return rows


def tables_of(found: Findings, costs: list[dict], converged: list[dict]) -> list[result.Table]:
    note = "; ".join(f"reference of {name}: {words}" for name, words in found.references.items())
    quality = "Errors but the trimmed one are net of the reference's own (`reference`). "
    return [
        result.Table("quality", "Every method, over samples", filter_quality.COLUMNS, found.rows, quality + note),
        result.Table("rejection", "Outlier rejection over n (Fig. 6.10)", filter_tables.OVER_N, found.curve),
        result.Table("overhead", "Recording clusters while rendering", filter_tables.OVERHEAD, costs),
        result.Table("convergence", "The filter vanishes", filter_convergence.COLUMNS, converged),
    ]


def plots_of(found: Findings, converged: list[dict]) -> list[str]:
    made = [
        ("samples.png", bool(found.rows) and charts.methods(found.rows, found.place / "samples.png")),
        ("rejection.png", bool(found.curve) and charts.rejection(found.curve, found.place / "rejection.png")),
        ("convergence.png", bool(converged) and charts.vanishing(converged, found.place / "convergence.png")),
        ("detail.png", bool(found.details) and filter_pictures.grid([found.details], found.place / "detail.png")),
    ]
    return [name for name, there in made if there] + found.plots


def run(options, found) -> int:
    (engine,) = common.usable(found, "cardioid-cli")
    program = filter_runs.filter_program(engine)
    if not (Path(program).exists() or shutil.which(program)):
        raise RuntimeError(f"{program} is not there: it is built beside cardioid-render")
    settle(options)
    records = common.records_of(options, "filter")
    names = options.scene or (list(filter_scenes.SCENES) if options.full else REDUCED)
    for name in names:
        common.pick(filter_scenes.SCENES, name, "scene of the filter")
    steps = len(names) * len(options.counts) + (len(filter_tables.NAMES) + 2 if options.full else 2)
    progress, made = Progress(steps, records), Findings(options, records, engine)
    for name in names:
        made.scene(name, progress)
    costs = costs_of(options, records, engine, progress)
    converged = convergence_of(options, records, engine, progress)
    out = result.Result("filter", "Clusters and filter", "./scripts/bench filter --full", not options.full)
    out.tables = tables_of(made, costs, converged)
    out.plots, out.pictures = plots_of(made, converged), made.pictures
    out.verdicts = filter_verdicts.all_of(made.rows, costs, converged)
    out.settings = SETTINGS | {"filters": "; ".join(f"{k}: {', '.join(v)}" for k, v in filter_methods.FILTERS.items())}
    out.missing = [*made.missing, *filter(None, [denoise.problem()])]
    out.versions = {"cardioid-render": engine.stamp()}
    return outcome.finish(out, options, records)
