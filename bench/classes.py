# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures split into the path classes D1, D2, D3, C1, C2, and into what camera paths and photons bring (thesis
Fig. 5.1, 5.3, 5.5), with the checks that the parts are a whole.

Read from the light: D1 `L S* E`, D2 `L D S* E`, D3 `L D D (S|D)* E`, C1 `L S+ D (S|D)* E`, C2 `L D S+ D (S|D)* E`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from . import class_figures, class_rows, class_verdicts, exr, film_reader, filter_runs, outcome, result, runs
from . import options as common
from .class_verdicts import CLASSES
from .engines import Job
from .progress import Progress

SAME = "caustic_roughness=0.1"
"""What counts as a mirror decides which class a path is in; the add-on gives path tracing another value of it."""
METHODS = {
    "PT": ("integrator=path_tracing", SAME),
    "PTPPM": ("integrator=hybrid", SAME),
    "SPPM": ("integrator=photon_mapping", "photons=65536", SAME),
}
DEPOSITS = {
    "SPPM, all light": ("integrator=photon_mapping", "guided_emission=false"),
    "PTPPM, unguided": ("integrator=hybrid", "guided_emission=false"),
    "PTPPM, guided": ("integrator=hybrid",),
}
FEW = ("photons=15000", "photon_radius=0.7", "indirect_caustics=photons", "blend_caustic_hits=false", SAME)
"""So few photons, gathered from so near, that a picture shows them one by one."""
LONG, PARTS = 8, 2


@dataclass
class Pictures:
    """One run: planes by class and `Combined`, (h, w, 3), top row first. `photons`: their part; None without a film."""

    planes: dict[str, np.ndarray]
    cpu: float
    samples: int
    photons: np.ndarray | None = None


@dataclass
class Scene:
    """All of a scene: by method two seeds; path tracing's long runs; pictures of deposits with what was counted."""

    name: str
    methods: dict[str, list[Pictures]] = field(default_factory=dict)
    long: list[Pictures] = field(default_factory=list)
    deposits: dict[str, tuple[np.ndarray, dict]] = field(default_factory=dict)


def add_arguments(commands) -> None:
    parser = commands.add_parser("classes", help="pictures split into the path classes (thesis Fig. 5.1, 5.3, 5.5)")
    parser.add_argument("--seconds", type=float, default=0.0, help="CPU seconds of a run (4, or 20 with --full)")
    parser.add_argument("--width", type=int, default=0, help="of the pictures (384, or the files' own with --full)")


def load(path: Path) -> dict[str, np.ndarray]:
    """Planes of a picture file."""
    found = exr.channels(path)
    names = list(found)
    return {
        key: np.stack([found[exr.channel(names, layer, c)] for c in "RGB"], -1)
        for key, layer in (("Combined", ""), *((name, name) for name in CLASSES))
    }


def pictures_of(run: dict) -> Pictures:
    return Pictures(load(Path(run["path"])), run["cpu"], run["stats"]["samples"])


def photon_part(film: film_reader.FilmFile, d1: np.ndarray) -> np.ndarray:
    """What photons bring: what is in no layer of the filter, without D1 (film/film.h). Not for scenes with media."""
    taken = np.maximum(film.pixels["samples"], 1)[..., None].astype(np.float32)
    return (film.pixels["unfiltered"] / taken)[::-1] - d1


def measure(records, options, engine, scene, progress: Progress) -> Scene | None:
    """All runs of a scene; None if time ran out before each method had one."""
    found = Scene(scene.name)
    base = Job(str(scene.path), "", 1, 1, options.threads, caustics=True, width=options.width)
    counts = {}
    for method, settings in METHODS.items():
        progress.step(f"{scene.name}, {method}")
        pace = runs.pace(records, options.cache, engine, replace(base, settings=settings))
        if pace is None:
            return None
        counts[method] = pace.samples(options.seconds)
        for seed in (1, 2):
            job = replace(base, settings=settings, samples=counts[method], seed=seed)
            run = runs.measured(records, options.cache, engine, job)
            if run:
                found.methods.setdefault(method, []).append(pictures_of(run))
        add_photons(found, filter_runs.Film(records, options.cache, engine, replace(job, seed=1)), method)
    progress.step(f"{scene.name}, path tracing with {LONG} times the samples")
    for part in range(PARTS):
        samples = runs.whole_passes(counts["PT"] * LONG / PARTS)
        job = replace(base, settings=METHODS["PT"], samples=samples, seed=11 + part)
        run = runs.measured(records, options.cache, engine, job)
        found.long += [pictures_of(run)] if run else []
    add_deposits(found, records, options, engine, base)
    return found if len(found.methods) == len(METHODS) and found.long else None


def add_photons(found: Scene, film: filter_runs.Film, method: str) -> None:
    """The part of photons of the first seed's picture, from a run of the same samples that keeps its film."""
    if method not in found.methods:
        return
    path = film.picture("-photons")
    if not path.exists():
        if film.rendered() is None:
            return
        exr.save(path, photon_part(film_reader.read(film.path), load(film.picture("-raw"))["D1"]))
        film.forget()
    found.methods[method][0].photons = exr.load(path)


def add_deposits(found: Scene, records, options, engine, base: Job) -> None:
    for name, settings in DEPOSITS.items():
        run = runs.measured(
            records, options.cache, engine, replace(base, samples=16, settings=(*settings, *FEW)), "deposits"
        )
        if run:
            planes = load(Path(run["path"]))
            light = planes["Combined"] - planes["D1"] if "SPPM" in name else planes["C1"] + planes["C2"]
            found.deposits[name] = light.mean(-1), run["stats"]["photons"]


def run(options, found) -> int:
    engine = runs.engine_of(found)
    records = common.records_of(options, "classes")
    options.seconds = options.seconds or (20.0 if options.full else 4.0)
    options.width = options.width or (0 if options.full else 384)
    names = ("cornell", "metallic_ring", "open_plane") if options.full else ("cornell", "metallic_ring")
    chosen = common.chosen_scenes(options, names)
    progress = Progress((len(METHODS) + 1) * len(chosen), records)
    out = result.Result("classes", "The path classes", "./scripts/bench classes --full", not options.full)
    rows, scenes = [], []
    for scene in chosen:
        measured = measure(records, options, engine, scene, progress)
        if measured is None:
            out.missing.append(f"{scene.name}: out of time")
            continue
        scenes.append(measured)
        rows += class_rows.of_scene(measured)
    title = "Energy, error and estimator of each class in each method"
    out.tables = [result.Table("classes", title, class_rows.COLUMNS, rows, class_rows.NOTE)]
    out.verdicts = class_verdicts.all_of(scenes, rows)
    out.settings = {name: f"{', '.join(how)}; 24 bounces; {options.seconds:g} CPU s" for name, how in METHODS.items()}
    out.versions = {"cardioid-render": engine.stamp()}
    for scene in scenes:
        class_figures.add(out, options.cache, scene)
    return outcome.finish(out, options, records)
