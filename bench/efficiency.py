# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiency 1 / (relative MSE · CPU seconds) against a rival, in interleaved pairs at equal settings and samples."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import exr, metrics, outcome, plot, reference, result, scene_list, store
from . import options as common
from .engines import Engine, Job
from .progress import Progress
from .scene_list import Scene

FIGURES = ("relmse", "relmse_trim", "rmse", "energy", "flip", "cpu", "cpu_net", "efficiency", "efficiency_net")
COLUMNS = {
    "scene": "",
    "mask": "",
    "engine": "",
    "samples": "d",
    "runs": "d",
    "relmse": ".5f",
    "relmse_trim": ".5f",
    "rmse": ".4f",
}
COLUMNS |= {
    "flip": ".4f",
    "energy": ".4f",
    "cpu": ".2f",
    "cpu_net": ".2f",
    "ratio": ".2f",
    "ratio_net": ".2f",
    "reference": ".1%",
}


@dataclass
class Plan:
    """What every scene of a comparison has in common."""

    rival: Engine
    ours: Engine
    referee: Engine
    pairs: int
    seconds: float
    threads: int
    bounces: int
    caustics: bool
    scale: float
    reference_factor: float


def job_for(plan: Plan, scene: Scene, samples: int, seed: int, out: Path | str = "") -> Job:
    width = max(32, round(scene.width * plan.scale))
    return Job(str(scene.path), str(out), samples, seed, plan.threads, plan.bounces, plan.caustics, width)


def identity(plan: Plan, scene: Scene) -> tuple:
    """What a record's key says of the scene and the settings; a changed file is another scene."""
    stamp = f"{scene.path.stat().st_mtime_ns:x}"
    programs = f"{plan.rival.stamp()}-{plan.ours.stamp()}"
    return (scene.name, stamp, programs, job_for(plan, scene, 1, 0).width, plan.threads, plan.bounces, plan.caustics)


def calibrate(records: store.Store, plan: Plan, scene: Scene) -> int:
    """Samples a pixel with which the rival takes about `plan.seconds` CPU seconds; a power of two."""
    key = ("probe", plan.rival.key, *identity(plan, scene))
    probe = records.get(*key)
    if probe is None:
        costs = [store.render(plan.rival, job_for(plan, scene, n, 1))["cpu"] for n in (1, 9)]
        probe = records.add(key, {"fixed": costs[0], "slope": max((costs[1] - costs[0]) / 8, 1e-3)})
    samples = max(1.0, (plan.seconds - probe["fixed"]) / probe["slope"])
    return max(4, 2 ** round(np.log2(samples)))


def measured(
    records: store.Store, cache: Path, plan: Plan, scene: Scene, engine: Engine, samples: int, seed: int
) -> dict | None:
    """One run's record, made now if it is not there; its picture is kept in the cache. None: out of time."""
    key = ("run", engine.key, *identity(plan, scene), samples, seed)
    path = cache / "runs" / ("-".join(str(k) for k in key[1:]) + ".exr")
    found = records.get(*key)
    if found and (samples == 1 or path.exists()):
        return found | {"path": str(path)}
    if records.out_of_time(key):
        return None
    path.parent.mkdir(parents=True, exist_ok=True)
    done = store.render(engine, job_for(plan, scene, samples, seed, path))
    kept = {
        k: done[k] for k in ("cpu", "wall", "peak_bytes", "load", "render_cpu", "render_wall", "stats") if k in done
    }
    return records.add(key, kept) | {"path": str(path)}


def fixed_costs(records: store.Store, cache: Path, plan: Plan, scene: Scene) -> dict[str, float] | None:
    """CPU seconds of a run with one sample: start-up, export and the tree; the median of three, interleaved."""
    found: dict[str, list[float]] = {plan.rival.key: [], plan.ours.key: []}
    for seed in (1, 2, 3):
        for engine in (plan.rival, plan.ours):
            run = measured(records, cache, plan, scene, engine, 1, seed)
            if run is None:
                return None
            found[engine.key].append(run["cpu"])
    return {key: float(np.median(values)) for key, values in found.items()}


def figures(
    run: dict, fixed: float, samples: int, ref: reference.Reference, mask: np.ndarray | None
) -> dict[str, float]:
    """All figures of one run. Net CPU seconds are those of the samples alone."""
    image = exr.load(Path(run["path"]))
    out = metrics.evaluate(image, ref.mean, mask)
    out["flip"] = metrics.flip(image, ref.mean, mask)
    out["cpu"] = run["cpu"]
    out["cpu_net"] = max(run["cpu"] - fixed, 1e-3) * samples / max(samples - 1, 1)
    out["efficiency"] = 1.0 / (out["relmse"] * out["cpu"])
    out["efficiency_net"] = 1.0 / (out["relmse"] * out["cpu_net"])
    return out


def compare_scene(records: store.Store, cache: Path, plan: Plan, scene: Scene) -> list[dict]:
    """Rows of one scene: an engine and a mask each, medians over the pairs; fewer pairs if time runs out."""
    samples = calibrate(records, plan, scene)
    fixed = fixed_costs(records, cache, plan, scene)
    runs: dict[str, list[dict]] = {plan.rival.key: [], plan.ours.key: []}
    for pair in range(plan.pairs):
        order = (plan.rival, plan.ours) if pair % 2 == 0 else (plan.ours, plan.rival)
        both = {e.key: measured(records, cache, plan, scene, e, samples, 101 + pair) for e in order}
        if None in both.values():
            break
        for key, run in both.items():
            runs[key].append(run)
        print(
            f"   {scene.name}: pair {pair + 1}/{plan.pairs}, "
            + ", ".join(f"{k} {r['cpu']:.1f} CPU s" for k, r in both.items()),
            flush=True,
        )
    job = job_for(plan, scene, max(1, round(samples * plan.reference_factor / 8)), 0)
    ref = reference.make(records, cache, plan.referee, scene.name, job, 8)
    if ref is None or fixed is None or not runs[plan.ours.key]:
        print(f"   {scene.name}: out of time; run the command again to go on", flush=True)
        return []
    masks = {"all": None} | scene.load_masks(ref.mean.shape[:2])
    rows = []
    for name, mask in masks.items():
        rows += table_rows(
            plan,
            scene,
            name,
            samples,
            ref,
            {k: [figures(r, fixed[k], samples, ref, mask) for r in v] for k, v in runs.items()},
        )
    return rows


def table_rows(
    plan: Plan, scene: Scene, mask: str, samples: int, ref: reference.Reference, all_figures: dict[str, list[dict]]
) -> list[dict]:
    """A row for each engine; ratios are medians over the pairs of the engine's efficiency over the rival's."""
    rows = []
    rival = all_figures[plan.rival.key]
    for engine in (plan.rival, plan.ours):
        own = all_figures[engine.key]
        row = {"scene": scene.name, "mask": mask, "engine": engine.key, "samples": samples, "runs": len(own)}
        for name in FIGURES:
            values = [f[name] for f in own if f[name] is not None]
            row[name] = float(np.median(values)) if values else None
        for name, of in (("ratio", "efficiency"), ("ratio_net", "efficiency_net")):
            ratios = [a[of] / b[of] for a, b in zip(own, rival)]
            row[name], row[f"{name}_low"], row[f"{name}_high"] = metrics.median_with_range(ratios)
        row["reference"] = ref.error["mse"] / row["rmse"] ** 2
        row["bar"] = scene.bar
        rows.append(row)
    return rows


def notes(rows: list[dict], ours: str) -> list[str]:
    """What has to be said of the rows: references that are too noisy, energy that differs, bars met and missed."""
    out = []
    for row in rows:
        name = f"{row['scene']} ({row['mask']}, {row['engine']})"
        if row["reference"] > 0.1:
            out.append(
                f"{name}: the reference's own error is {row['reference']:.0%} of the squared error (wanted: < 10 %)"
            )
        if row["mask"] in ("all", "without lamp") and abs(row["energy"] - 1) > 0.01:
            out.append(f"{name}: energy differs from the reference by {row['energy'] - 1:+.2%}")
        if row["engine"] == ours and row["mask"] == "all":
            word = "met" if row["ratio"] >= row["bar"] else "missed"
            ratios = f"{row['ratio']:.2f} times the rival ({row['ratio_net']:.2f} without fixed costs)"
            out.append(f"{row['scene']}: {ratios}, bar {row['bar']:g}: {word}")
    return out


def add_arguments(commands) -> None:
    parser = commands.add_parser(
        "efficiency", help="1 / (relative MSE · CPU seconds), interleaved pairs, equal settings"
    )
    parser.add_argument("--pairs", type=int, default=0, help="(3; 7 with --full)")
    parser.add_argument(
        "--seconds", type=float, default=0.0, help="CPU seconds of a run of the rival (4; 15 with --full)"
    )
    parser.add_argument("--bounces", type=int, default=24)
    parser.add_argument("--caustics", action="store_true", help="leave caustics on (off in both engines without this)")
    parser.add_argument("--scale", type=float, default=0.0, help="of each scene's picture size (0.67; 1 with --full)")
    parser.add_argument("--referee", default="cycles", help="the engine of the references (%(default)s)")
    parser.add_argument(
        "--reference", type=float, default=24.0, help="samples of a reference over those of a run (%(default)s)"
    )


def plan_of(options, found: dict[str, Engine]) -> Plan:
    rival, ours, referee = common.usable(found, options.rival, options.ours, options.referee)
    pairs, seconds, scale = (7, 15.0, 1.0) if options.full else (3, 4.0, 0.67)
    return Plan(
        rival,
        ours,
        referee,
        options.pairs or pairs,
        options.seconds or seconds,
        options.threads,
        options.bounces,
        options.caustics,
        options.scale or scale,
        options.reference,
    )


def verdicts(rows: list[dict], ours: str) -> list[result.Verdict]:
    out = []
    for row in (row for row in rows if row["engine"] == ours and row["mask"] == "all"):
        said = f"{row['ratio']:.2f} times, energy {row['energy']:.4f}, {row['cpu']:.2f} CPU s"
        claim = f"{row['scene']}: {row['bar']:g} times the rival's efficiency"
        out.append(result.Verdict(claim, "bench", row["ratio"] >= row["bar"], said))
    return out


def run(options, found) -> int:
    plan = plan_of(options, found)
    names = list(scene_list.all_scenes(options.cache)) if options.full else common.REDUCED
    records = common.records_of(options, "efficiency")
    scenes = common.chosen_scenes(options, names)
    progress, rows = Progress(len(scenes), records), []
    for scene in scenes:
        progress.step(scene.name)
        rows += compare_scene(records, options.cache, plan, scene)
    out = result.Result("efficiency", "Efficiency beside Cycles", "./scripts/bench efficiency --full", not options.full)
    columns = {key: [key.replace("_", " "), form] for key, form in COLUMNS.items()}
    out.tables = [result.Table("efficiency", out.title, columns, rows, "\n".join(notes(rows, plan.ours.key)))]
    words = f"{plan.bounces} bounces, caustics {'on' if plan.caustics else 'off'}, nothing clamped, equal samples"
    out.settings = {engine.title: words for engine in (plan.rival, plan.ours)}
    out.verdicts = verdicts(rows, plan.ours.key)
    if rows and plot.efficiency(rows, plan.ours.key, plan.rival.title, outcome.place(out, options)):
        out.plots = ["efficiency.png"]
    return outcome.finish(out, options, records)
