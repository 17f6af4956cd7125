# SPDX-License-Identifier: GPL-3.0-or-later
"""Photons per CPU second and the stages' shares of the time, beside the thesis's tables 5.1 and 5.2; what guided
emission and the balance of the two halves are worth."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from . import exr, guided, outcome, peer_scenes, result, runs, scene_list, thesis, titles
from . import options as common
from .engines import Job
from .progress import Progress

STAGES = {"build": ("build",), "camera": ("camera",), "trace": ("photon_trace",)}
STAGES |= {"index": ("photon_index",), "learn": ("photon_learn",)}
STAGE_COLUMNS = {"scene": "", "method": "", "cpu": ".1f", "relmse": ".5f", "energy": ".4f", "samples": "d"}
STAGE_COLUMNS |= {"passes": "d", "emitted_per_s": ".3e", "stored_per_s": ".3e", "gathered_per_s": ".3e"}
STAGE_COLUMNS |= {"stored_of_emitted": ".1%", "camera": ".1%", "trace": ".1%", "gather": ".1%", "index": ".1%"}
STAGE_COLUMNS |= {"learn": ".1%", "build": ".1%"}
METHODS = {name: settings for name, settings in runs.METHODS.items()}
METHODS |= {f"{name} unguided": (*METHODS[name], "guided_emission=false") for name in ("PTPPM", "SPPM")}
STAGES_NOTE = (
    "Shares of the engine's own clock. Gathering is part of `camera` in ours: camera paths look into the photon map as "
    "they go. Training, whose cost is in `learn`, happens once a render, so short runs show more of it than long ones."
)


def add_arguments(commands) -> None:
    parser = commands.add_parser("photons", help="photons per CPU second, stages, guided emission, balance")
    peer_scenes.add_argument(parser)
    parser.add_argument("--part", choices=("all", "stages", "guided"), default="all")
    parser.add_argument("--seconds", type=float, default=0.0, help="CPU seconds of a run (2, or 8 with --full)")
    parser.add_argument("--seeds", type=int, default=0, help="2, or 5 with --full")
    parser.add_argument(
        "--reference", type=float, default=12.0, help="samples of a reference over those of a run (%(default)s)"
    )


def stage_row(scene: str, method: str, run: dict) -> dict:
    """Rates over the process's CPU seconds, and shares of the engine's own clock."""
    stats = run["stats"]
    photons, seconds, cpu = stats["photons"], stats["seconds"], run["cpu"]
    row = {"scene": scene, "method": method, "cpu": cpu, "samples": stats["samples"], "passes": photons["passes"]}
    for name in ("emitted", "stored", "gathered"):
        row[name] = photons[name]
        row[f"{name}_per_s"] = photons[name] / cpu
    row["megabytes"] = stats["bytes"]["photons"] / 1e6
    row["stored_of_emitted"] = photons["stored"] / photons["emitted"] if photons["emitted"] else None
    total = sum(seconds.get(key, 0.0) for keys in STAGES.values() for key in keys)
    for name, keys in STAGES.items():
        row[name] = sum(seconds.get(key, 0.0) for key in keys) / total
    return row


def thesis_rows(scene: str) -> list[dict]:
    """The thesis's figures as rows of the same table."""
    rows = []
    for method in runs.METHODS:
        paths, passes, *_ = thesis.TABLE_5_2[scene, method]
        row = {"scene": scene, "method": f"{method} (thesis)", "samples": paths, "passes": passes}
        if method == "PTPPM":
            row["stored_of_emitted"] = thesis.TABLE_5_1[scene]["share"]
            row["emitted"], row["stored"] = thesis.TABLE_5_1[scene]["emitted"], thesis.TABLE_5_1[scene]["deposited"]
        rows.append(row | thesis.shares(scene, method))
    return rows


def stages(records, options, engine) -> list[dict]:
    """Rows of all scenes and methods, each followed by the thesis's of its scene."""
    rows, scenes = [], peer_scenes.load_some(options.peers, options.scene)
    progress = Progress(len(scenes) * len(METHODS), records)
    for scene in scenes:
        for method, settings in METHODS.items():
            progress.step(f"{scene.name}, {method}")
            job = Job(str(scene.blend), "", 1, 1, options.threads, caustics=True, settings=settings)
            pace = runs.pace(records, options.cache, engine, job)
            run = pace and runs.measured(
                records, options.cache, engine, replace(job, samples=pace.samples(options.seconds))
            )
            if run:
                figures = scene.evaluate(exr.load(Path(run["path"])))
                rows.append(stage_row(scene.name, method, run) | {key: figures[key] for key in ("relmse", "energy")})
        rows += thesis_rows(scene.name)
    return rows


def guidance(records, options, engine) -> tuple[list[dict], list[str]]:
    """Rows of what guided emission and balance are worth, and what was left out."""
    scenes, rows, missing = scene_list.caustic_scenes(options.cache), [], []
    for name in [n for n in options.scene if n in guided.SCENES] or guided.SCENES:
        problem = scenes[name].ready()
        print(f"skipped {name}: {problem}" if problem else f"   {name}", flush=True)
        missing += [f"{name}: {problem}"] if problem else []
        rows += [] if problem else guided.compare(records, options, engine, scenes[name])
    return rows, missing


def run(options, found) -> int:
    engine = runs.engine_of(found)
    records = common.records_of(options, "photons")
    out = result.Result(
        "photons", "Photons: rates, stages, guided emission", "./scripts/bench photons --full", not options.full
    )
    options.seconds = options.seconds or (8.0 if options.full else 2.0)
    options.seeds = options.seeds or (5 if options.full else 2)
    out.versions = {"cardioid-render": engine.stamp()}
    if options.part in ("all", "stages"):
        rows, shown = stages(records, options, engine), titles.columns(STAGE_COLUMNS)
        out.tables.append(result.Table("photons-stages", "Photons and the stages' time", shown, rows, STAGES_NOTE))
    if options.part in ("all", "guided"):
        rows, out.missing = guidance(records, options, engine)
        out.tables.append(result.Table("photons-guided", "Guided emission", titles.columns(guided.COLUMNS), rows))
        out.verdicts = guided.judge(rows)
    return outcome.finish(out, options, records)
