# SPDX-License-Identifier: GPL-3.0-or-later
"""`./scripts/bench references`: makes the filter's references anew, which bench/references keeps. `filter` takes the
kept one if it belongs to the scene, else a shorter one that is made on the spot."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from . import exr, filter_scenes, outcome, quality, reference, references, regions, result, store
from . import options as common
from .engines import CommandLine
from .progress import Progress

WIDTH, PARTS = 256, 8
SAMPLES = {"glossy_spheres": 256, "bust_in_water": 768, "coloured_grid": 256}
"""Of each of the parts: about 350, 1300 and 40 CPU seconds in all."""
FULL_FACTOR = 4
COLUMNS = {
    "scene": ["scene", ""],
    "samples": ["samples", "d"],
    "error": ["own relMSE", ".2e"],
    "energy": ["second half's energy over the first's", ".5f"],
    "cpu": ["CPU s", ".0f"],
    "kilobytes": ["kB", ".0f"],
    "digest": ["scene's digest", ""],
}


def add_arguments(commands) -> None:
    parser = commands.add_parser("references", help="makes the filter's references in bench/references anew")
    parser.add_argument("--samples", type=int, default=0, help="of each of eight parts (by scene; 4 times with --full)")
    parser.add_argument("--width", type=int, default=WIDTH, help="of the pictures (%(default)s)")
    parser.add_argument("--out", type=Path, default=references.FOLDER, help="where they are kept (bench/references)")


def scene_of(file: str) -> filter_scenes.FilterScene:
    """The first entry of a scene's file, whose reference all its modes share."""
    return next(scene for scene in filter_scenes.SCENES.values() if scene.file == file)


def make(records: store.Store, options, engine: CommandLine, file: str, progress: Progress) -> dict | None:
    """Renders what is missing and writes the reference; its row. None: out of time, the parts so far are kept."""
    scene = scene_of(file)
    samples = options.samples or SAMPLES[file] * (FULL_FACTOR if options.full else 1)
    job = replace(scene.reference_job(options.width, options.threads), samples=samples)
    found = None
    for count in range(1, PARTS + 1):
        progress.step(f"{file}, part {count} of {PARTS}, {samples} samples")
        found = reference.make(records, options.cache, engine, file, job, count, filter_scenes.FIRST_SEED)
    if found is None or found.parts < PARTS:
        return None
    pictures = np.array([exr.load(path) for path in found.paths], np.float64)
    seconds = sum(record["cpu"] for record in found.records)
    how = "photons and paths (hybrid), 16 bounces, nothing clamped; " + ", ".join(job.settings)
    kept = references.save(
        file,
        pictures,
        scene.blend,
        "Cardioid, command line",
        PARTS * samples,
        settings=how,
        seconds=seconds,
        program=engine.stamp(),
        folder=options.out,
    )
    row = {"scene": file, "samples": PARTS * samples, "error": kept.error["relmse"], "cpu": seconds}
    row["energy"] = float(kept.parts[1].mean() / kept.parts[0].mean())
    return row | {"kilobytes": (options.out / f"{file}.exr").stat().st_size / 1e3, "digest": kept.about.digest}


def run(options, found) -> int:
    (engine,) = common.usable(found, "cardioid-cli")
    records = common.records_of(options, "references")
    names = options.scene or list(SAMPLES)
    for name in names:
        common.pick(SAMPLES, name, "scene with a reference")
    progress = Progress(len(names) * PARTS, records)
    rows = [row for name in names if (row := make(records, options, engine, name, progress))]
    out = result.Result("references", "References of the filter", "./scripts/bench references --full", not options.full)
    out.tables = [result.Table("references", out.title, COLUMNS, rows, f"Written to {options.out.name}/.")]
    return outcome.finish(out, options, records)


def referee(records, options, engine, scene, width: int) -> tuple[quality.Referee | None, str, str]:
    """A scene's referee, what it is in words, and why it is not the kept one (empty if it is). None: out of time."""
    surface = filter_scenes.surface(options.cache, scene, width)
    try:
        kept = references.load(scene.file, references.digest(scene.blend), width=width)
    except references.Refused as error:
        made = filter_scenes.referee(records, options.cache, engine, scene, width, options.threads)
        words = f"made here: {scene.parts} parts of {scene.samples} samples, hybrid"
        return made, words, f"{error}; a shorter one is made instead"
    parts = kept.parts.astype(np.float64)
    masks = regions.regions((parts[0], parts[1]), surface)
    return quality.Referee(parts, masks), f"kept: {kept.about.engine}, {kept.about.samples} samples", ""
