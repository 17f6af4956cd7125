# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures split into the path classes D1, D2, D3, C1, C2, and into what camera paths and photons bring (thesis
Fig. 5.1, 5.3, 5.5), with the checks that the parts are a whole.

Read from the light: D1 `L S* E`, D2 `L D S* E`, D3 `L D D (S|D)* E`, C1 `L S+ D (S|D)* E`, C2 `L D S+ D (S|D)* E`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from . import class_figures, class_verdicts, exr, film_reader, filter_runs, metrics, outcome, result, runs
from . import options as common
from .engines import Job
from .progress import Progress

CLASSES = ("D1", "D2", "D3", "C1", "C2")
SAME = "caustic_roughness=0.1"
"""What counts as a mirror decides which class a path is in; the add-on gives path tracing another value of it."""
METHODS = {
    "PT": ("integrator=path_tracing", SAME),
    "PTPPM": ("integrator=hybrid", SAME),
    "SPPM": ("integrator=photon_mapping", "photons=65536", SAME),
}
OWNERS = {
    "PT": dict.fromkeys(CLASSES, "camera paths"),
    "PTPPM": dict.fromkeys(CLASSES, "camera paths") | {"C1": "photons and camera paths, weighed"},
    "SPPM": dict.fromkeys(CLASSES, "photons") | {"D1": "camera paths"},
}
"""engine_cpp/path/partition.h with the add-on's defaults."""
DEPOSITS = {
    "SPPM, all light": ("integrator=photon_mapping", "guided_emission=false"),
    "PTPPM, unguided": ("integrator=hybrid", "guided_emission=false"),
    "PTPPM, guided": ("integrator=hybrid",),
}
FEW = ("photons=15000", "photon_radius=0.7", "indirect_caustics=photons", "blend_caustic_hits=false", SAME)
"""So few photons, gathered from so near, that a picture shows them one by one."""
LONG, PARTS = 16, 2
COLUMNS = {
    "scene": ["scene", ""],
    "method": ["method", ""],
    "class": ["class", ""],
    "by": ["estimated by", ""],
    "cpu": ["CPU s", ".1f"],
    "samples": ["samples", "d"],
    "noise": ["relMSE by scatter", ".5f"],
    "noise_share": ["of all error", ".1%"],
    "energy": ["energy over path tracing's", ".4f"],
    "share": ["of the light", ".2%"],
    "photons": ["of it by photons", ".1%"],
}
NOTE = (
    "Equal CPU seconds, two seeds. Error: the scatter of the seeds over the whole picture's brightness; it sees no "
    "bias. Energy sees it: the class's mean over that of path tracing with sixteen times the samples, whose noise is "
    "in it too. Photons' share: from the film of the first seed, which keeps what they bring apart."
)


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
    parser.add_argument("--seconds", type=float, default=0.0, help="CPU seconds of a run (2, or 20 with --full)")
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
    if method not in found.methods or film.rendered() is None:
        return
    raw = load(film.picture("-raw"))
    found.methods[method][0].photons = photon_part(film_reader.read(film.path), raw["D1"])
    film.forget()


def add_deposits(found: Scene, records, options, engine, base: Job) -> None:
    for name, settings in DEPOSITS.items():
        run = runs.measured(
            records, options.cache, engine, replace(base, samples=16, settings=(*settings, *FEW)), "deposits"
        )
        if run:
            planes = load(Path(run["path"]))
            light = planes["Combined"] - planes["D1"] if "SPPM" in name else planes["C1"] + planes["C2"]
            found.deposits[name] = light.mean(-1), run["stats"]["photons"]


def error(pictures: list[Pictures], plane: str, whole: np.ndarray) -> float:
    """relMSE of one picture of a class by the scatter of several, over the brightness of the whole; 0 with one."""
    stack = np.array([one.planes[plane].mean(-1) for one in pictures], np.float64)
    return float((stack.var(0, ddof=1) / (whole * whole + metrics.EPSILON)).mean()) if len(stack) > 1 else 0.0


def rows_of(scene: Scene) -> list[dict]:
    """A row a method and class, and one of the sum."""
    rows = []
    truth = {name: np.mean([one.planes[name].mean() for one in scene.long]) for name in (*CLASSES, "Combined")}
    whole = np.mean([one.planes["Combined"] for one in scene.long], 0).mean(-1)
    for method, pictures in scene.methods.items():
        squares = {name: error(pictures, name, whole) for name in (*CLASSES, "Combined")}
        means = {name: float(np.mean([one.planes[name].mean() for one in pictures])) for name in squares}
        parts = sum(squares[name] for name in CLASSES)
        for name in squares:
            row = {"scene": scene.name, "method": method, "class": name, "by": OWNERS[method].get(name, "")}
            row |= {"cpu": float(np.mean([one.cpu for one in pictures])), "samples": pictures[0].samples}
            row |= {"noise": squares[name], "energy": float(means[name] / max(truth[name], 1e-12))}
            row |= {"share": means[name] / max(means["Combined"], 1e-12)}
            if name in CLASSES:
                row["noise_share"] = squares[name] / max(parts, 1e-30)
            row["photons"] = photon_share(method, name, pictures[0])
            rows.append(row)
    return rows


def photon_share(method: str, name: str, picture: Pictures) -> float | None:
    """Which share of a class's light photons brought; None where the film does not tell classes apart."""
    if picture.photons is None:
        return None
    if name == "Combined" or (method == "PTPPM" and name == "C1"):
        return float(picture.photons.mean() / max(picture.planes[name].mean(), 1e-12))
    return 1.0 if OWNERS[method][name] == "photons" else 0.0


def run(options, found) -> int:
    engine = runs.engine_of(found)
    records = common.records_of(options, "classes")
    options.seconds = options.seconds or (20.0 if options.full else 2.0)
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
        rows += rows_of(measured)
    title = "Energy, error and estimator of each class in each method"
    out.tables = [result.Table("classes", title, COLUMNS, rows, NOTE)]
    out.verdicts = class_verdicts.all_of(scenes, rows)
    out.settings = {name: f"{', '.join(how)}; 24 bounces; {options.seconds:g} CPU s" for name, how in METHODS.items()}
    out.versions = {"cardioid-render": engine.stamp()}
    for scene in scenes:
        class_figures.add(out, options.cache, scene)
    return outcome.finish(out, options, records)
