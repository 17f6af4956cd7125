# SPDX-License-Identifier: GPL-3.0-or-later
"""Photons per CPU second and the stages' shares of the time, beside the thesis's tables 5.1 and 5.2; what guided
emission and the balance of the two halves are worth."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from . import caustics, exr, metrics, peer_scenes, reference, runs, scene_list, store, thesis
from .engines import Job

STAGES = {"build": ("build",), "camera": ("camera",), "trace": ("photon_trace",)}
STAGES |= {"index": ("photon_index",), "learn": ("photon_learn",)}
STAGE_COLUMNS = {"scene": "", "method": "", "cpu": ".1f", "samples": "d", "passes": "d", "emitted_per_s": ".3e"}
STAGE_COLUMNS |= {"stored_per_s": ".3e", "gathered_per_s": ".3e", "stored_of_emitted": ".1%", "camera": ".1%"}
STAGE_COLUMNS |= {"trace": ".1%", "gather": ".1%", "index": ".1%", "learn": ".1%", "build": ".1%"}
METHODS = {name: settings for name, settings in runs.METHODS.items()}
METHODS["PTPPM unguided"] = ("integrator=hybrid", "guided_emission=false")

SCENES = ("pool_sun", "open_plane", "twelve_lamps")
GUIDED_COLUMNS = {"scene": "", "photons": "", "guided": "", "runs": "d", "samples": "d", "cpu": ".2f", "emitted": ".3e"}
GUIDED_COLUMNS |= {"gathered_per_emitted": ".3f", "relmse": ".5f", "relmse_caustic": ".5f", "rmse": ".4f"}
GUIDED_COLUMNS |= {"energy": ".4f", "energy_caustic": ".4f", "reference": ".1%"}
MORE_GATHERED, SLOWER = 5.0, 1.05
PARTS = 4


def add_arguments(commands) -> None:
    parser = commands.add_parser("photons", help="photons per CPU second, stages, guided emission, balance")
    peer_scenes.add_argument(parser)
    parser.add_argument("--part", choices=("all", "stages", "guided"), default="all")
    parser.add_argument("--seconds", type=float, default=4.0, help="CPU seconds of a run (%(default)s)")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument(
        "--reference", type=float, default=12.0, help="samples of a reference over those of a run (%(default)s)"
    )


# Stages ----------------------------------------------------------------------------------------------------------


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


# Guided emission and balance -------------------------------------------------------------------------------------


def caustic_mask(paths: list[Path]) -> np.ndarray:
    """Pixels of which caustics are more than a tenth, by the passes C1 and C2 of several pictures; 3×3 majority."""
    whole = np.mean([exr.load(path) for path in paths], 0).mean(-1)
    light = np.mean([exr.load(path, "C1") + exr.load(path, "C2") for path in paths], 0).mean(-1)
    found = np.pad((light > 0.1 * whole).astype(int), 1)
    votes = sum(found[i : i + whole.shape[0], j : j + whole.shape[1]] for i in range(3) for j in range(3))
    return votes >= 5


def variants(scene) -> dict[tuple[str, str], tuple[str, ...]]:
    """Settings by (photons, guided): `half` emits half a photon a pixel and sample, `auto` lets balance choose."""
    found = {}
    for guided in ("yes", "no"):
        own = ("integrator=hybrid", f"guided_emission={'true' if guided == 'yes' else 'false'}")
        found["half", guided] = (*own, f"photons={half_a_photon(scene)}")
        found["auto", guided] = (*own, "photons=0")
    return found


def half_a_photon(scene) -> int:
    """Half of the number of pixels at 16:10; the exact number does not matter, only that all variants have it."""
    return round(scene.width * scene.width * 0.625 / 2)


def make_reference(records, options, engine, scene, job: Job) -> reference.Reference | None:
    """Half of it guided and half of it not, so that neither side is its own judge."""
    samples = runs.FIRST_SAMPLES + runs.whole_passes(job.samples * options.reference / (2 * PARTS) - runs.FIRST_SAMPLES)
    halves = []
    for number, guided in enumerate(("yes", "no")):
        own = replace(job, samples=samples, settings=variants(scene)["auto", guided])
        first = reference.FIRST_SEED + number * PARTS
        halves.append(reference.make(records, options.cache, engine, scene.name, own, PARTS, first))
    if None in halves:
        return None
    one, two = halves
    error = {key: (one.error[key] + two.error[key]) / 4 for key in one.error}
    return reference.Reference((one.mean + two.mean) / 2, error, one.parts + two.parts, one.paths + two.paths)


def figures(run: dict, ref: reference.Reference, mask: np.ndarray) -> dict[str, float]:
    image = exr.load(Path(run["path"]))
    out = metrics.evaluate(image, ref.mean)
    if mask.any():
        out |= {f"{key}_caustic": value for key, value in metrics.evaluate(image, ref.mean, mask).items()}
    photons = run["stats"]["photons"]
    out |= {"cpu": run["cpu"], "emitted": photons["emitted"], "samples": run["stats"]["samples"]}
    out["gathered_per_emitted"] = photons["gathered"] / max(photons["emitted"], 1)
    out["reference"] = ref.error["relmse"] / out["relmse"]
    return out


def compare(records, options, engine, scene) -> list[dict]:
    """Rows of one scene: every variant with the same samples, medians over the seeds."""
    job = Job(str(scene.path), "", 1, 1, options.threads, caustics=True, width=scene.width)
    pace = runs.pace(records, options.cache, engine, replace(job, settings=variants(scene)["half", "yes"]))
    if pace is None:
        return []
    job = replace(job, samples=pace.samples(options.seconds))
    found: dict[tuple[str, str], list[dict]] = {key: [] for key in variants(scene)}
    for seed in range(1, options.seeds + 1):
        for key, settings in variants(scene).items():
            run = runs.measured(records, options.cache, engine, replace(job, seed=seed, settings=settings))
            if run:
                found[key].append(run)
    ref = make_reference(records, options, engine, scene, job)
    if ref is None:
        return []
    mask, rows = caustic_mask(ref.paths), []
    for (photons, guided), values in found.items():
        if values:
            row = {"scene": scene.name, "photons": photons, "guided": guided, "runs": len(values)}
            row |= peer_scenes.medians([figures(run, ref, mask) for run in values])
            rows.append(row | {"samples": job.samples})
    return rows


def judge(rows: list[dict]) -> list[str]:
    """The bars: 5 times the gathered photons per emitted one at equal error or less; never slower beyond 5 %."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        by = {(row["photons"], row["guided"]): row for row in rows if row["scene"] == scene}
        if len(by) < 4:
            out.append(f"{scene}: out of time; run the command again to go on")
            continue
        on, off = by["half", "yes"], by["half", "no"]
        more = on["gathered_per_emitted"] / max(off["gathered_per_emitted"], 1e-12)
        error = on["relmse"] / off["relmse"]
        caustic = on.get("relmse_caustic", 0.0) / max(off.get("relmse_caustic", 0.0), 1e-12)
        met = "met" if more >= MORE_GATHERED and error <= 1.0 else "missed"
        out.append(
            f"{scene}: guided emission gathers {more:.1f} times as many photons per emitted one at {error:.2f} of the "
            f"relMSE ({caustic:.2f} in the caustics): {met}"
        )
        for what, a, b in (("guided emission", on, off), ("balance", by["auto", "yes"], on)):
            for where in ("relmse", "relmse_caustic"):
                if where in a:
                    slower = a[where] * a["cpu"] / (b[where] * b["cpu"])
                    met = "met" if slower <= SLOWER else "missed"
                    out.append(f"{scene}: with {what} {slower:.2f} of the time to the same {where}: {met}")
    return out


def run(options, found) -> int:
    engine = caustics.engine_of(found)
    records = store.Store(options.cache / "photons.jsonl", options.budget)
    if options.part in ("all", "stages"):
        rows = stages(records, options, engine)
        store.publish(rows, STAGE_COLUMNS, options.cache / "photons-stages")
        print("Gathering is part of `camera` in ours: camera paths look into the photon map as they go.")
    if options.part in ("all", "guided"):
        scenes = scene_list.caustic_scenes(options.cache)
        rows = []
        for name in [n for n in options.scene if n in SCENES] or SCENES:
            problem = scenes[name].ready()
            print(f"skipped {name}: {problem}" if problem else f"   {name}", flush=True)
            rows += [] if problem else compare(records, options, engine, scenes[name])
        store.publish(rows, GUIDED_COLUMNS, options.cache / "photons-guided")
        for note in judge(rows):
            print(note)
    return 0
