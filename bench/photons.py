# SPDX-License-Identifier: GPL-3.0-or-later
"""Photons per CPU second and the stages' shares of the time, beside the thesis's tables 5.1 and 5.2; what guided
emission and the balance of the two halves are worth."""

from __future__ import annotations

from dataclasses import replace

from . import guided, peer_scenes, runs, scene_list, store, thesis
from .engines import Job

STAGES = {"build": ("build",), "camera": ("camera",), "trace": ("photon_trace",)}
STAGES |= {"index": ("photon_index",), "learn": ("photon_learn",)}
STAGE_COLUMNS = {"scene": "", "method": "", "cpu": ".1f", "samples": "d", "passes": "d", "emitted_per_s": ".3e"}
STAGE_COLUMNS |= {"stored_per_s": ".3e", "gathered_per_s": ".3e", "stored_of_emitted": ".1%", "camera": ".1%"}
STAGE_COLUMNS |= {"trace": ".1%", "gather": ".1%", "index": ".1%", "learn": ".1%", "build": ".1%"}
METHODS = {name: settings for name, settings in runs.METHODS.items()}
METHODS["PTPPM unguided"] = ("integrator=hybrid", "guided_emission=false")


def add_arguments(commands) -> None:
    parser = commands.add_parser("photons", help="photons per CPU second, stages, guided emission, balance")
    peer_scenes.add_argument(parser)
    parser.add_argument("--part", choices=("all", "stages", "guided"), default="all")
    parser.add_argument("--seconds", type=float, default=4.0, help="CPU seconds of a run (%(default)s)")
    parser.add_argument("--seeds", type=int, default=3)
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
    rows = []
    for scene in peer_scenes.load_some(options.peers, options.scene):
        for method, settings in METHODS.items():
            job = Job(str(scene.blend), "", 1, 1, options.threads, caustics=True, settings=settings)
            pace = runs.pace(records, options.cache, engine, job)
            run = pace and runs.measured(
                records, options.cache, engine, replace(job, samples=pace.samples(options.seconds))
            )
            if run:
                rows.append(stage_row(scene.name, method, run))
        rows += thesis_rows(scene.name)
    return rows


def run(options, found) -> int:
    engine = runs.engine_of(found)
    records = store.Store(options.cache / "photons.jsonl", options.budget)
    if options.part in ("all", "stages"):
        rows = stages(records, options, engine)
        store.publish(rows, STAGE_COLUMNS, options.cache / "photons-stages")
        print("Gathering is part of `camera` in ours: camera paths look into the photon map as they go.")
    if options.part in ("all", "guided"):
        scenes = scene_list.caustic_scenes(options.cache)
        rows = []
        for name in [n for n in options.scene if n in guided.SCENES] or guided.SCENES:
            problem = scenes[name].ready()
            print(f"skipped {name}: {problem}" if problem else f"   {name}", flush=True)
            rows += [] if problem else guided.compare(records, options, engine, scenes[name])
        store.publish(rows, guided.COLUMNS, options.cache / "photons-guided")
        for note in guided.judge(rows):
            print(note)
    return 0
