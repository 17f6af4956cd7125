# SPDX-License-Identifier: GPL-3.0-or-later
"""What each choice behind the defaults of PTPPM is worth: one setting changed at a time, equal samples.

`cost` is relMSE times CPU seconds over the default's: under 1, the change would be better.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from . import exr, guided, metrics, outcome, peer_scenes, reference, result, runs, scene_list, titles, verdicts
from . import options as common
from .engines import Job

HYBRID = runs.METHODS["PTPPM"]
VARIANTS = {
    "default": HYBRID,
    "PT": runs.METHODS["PT"],
    "per_pixel radii": (*HYBRID, "radius_schedule=per_pixel"),
    "radius 0.7": (*HYBRID, "photon_radius=0.7"),
    "radius 1.4": (*HYBRID, "photon_radius=1.4"),
    "radius 2": (*HYBRID, "photon_radius=2"),
    "shrink 0.5": (*HYBRID, "radius_shrink=0.5"),
    "shrink 0.8": (*HYBRID, "radius_shrink=0.8"),
    "indirect by photons": (*HYBRID, "indirect_caustics=photons"),
    "indirect by paths": (*HYBRID, "indirect_caustics=path_tracing"),
    "no blend": (*HYBRID, "blend_caustic_hits=false"),
    "not guided": (*HYBRID, "guided_emission=false"),
}
SOFT = ("cornell_large_lamp", "cornell_sky")
COLUMNS = {"scene": "", "choice": "", "runs": "d", "samples": ".0f", "cpu": ".2f", "relmse": ".5f"}
COLUMNS |= {"relmse_caustic": ".5f", "rmse": ".4f", "energy": ".4f", "cost": ".2f", "cost_caustic": ".2f"}


@dataclass
class Judged:
    """A scene with what its pictures are compared with."""

    name: str
    blend: Path
    width: int
    reference: np.ndarray
    masks: dict[str, np.ndarray]

    def evaluate(self, image: np.ndarray) -> dict[str, float]:
        out: dict[str, float] = {}
        for name, mask in self.masks.items():
            found = metrics.evaluate(image, self.reference, mask)
            out |= {key + ("" if name == "all" else f"_{name}"): value for key, value in found.items()}
        return out


def add_arguments(commands) -> None:
    parser = commands.add_parser("choices", help="one setting of PTPPM changed at a time: what backs the defaults")
    peer_scenes.add_argument(parser)
    parser.add_argument("--seconds", type=float, default=0.0, help="CPU seconds of a run (2, or 8 with --full)")
    parser.add_argument("--seeds", type=int, default=0, help="1, or 3 with --full")
    parser.add_argument("--choices", default=",".join(VARIANTS), help="comma-separated names")
    parser.add_argument(
        "--reference", type=float, default=24.0, help="samples of a reference over those of a run (%(default)s)"
    )


def soft_scene(records, options, engine, scene) -> Judged | None:
    """A scene whose lamps are so large that path tracing makes its reference."""
    job = Job(str(scene.path), "", 1, 1, options.threads, caustics=True, width=scene.width, settings=VARIANTS["PT"])
    pace = runs.pace(records, options.cache, engine, job)
    if pace is None:
        return None
    samples = runs.whole_passes(pace.samples(options.seconds) * options.reference / 8)
    ref = reference.make(records, options.cache, engine, scene.name, replace(job, samples=max(8, samples)), 8)
    if ref is None:
        return None
    masks = {"all": np.ones(ref.mean.shape[:2], bool), "caustic": guided.caustic_mask(ref.paths)}
    return Judged(scene.name, scene.path, scene.width, ref.mean, masks)


def scenes(records, options, engine) -> list[Judged]:
    wanted = options.scene or [*peer_scenes.NAMES, *SOFT]
    out = []
    for scene in peer_scenes.load_some(options.peers, wanted):
        out.append(Judged(scene.name, scene.blend, 0, scene.reference, scene.masks))
    for name in (name for name in wanted if name in SOFT):
        scene = scene_list.caustic_scenes(options.cache)[name]
        problem = scene.ready()
        judged = None if problem else soft_scene(records, options, engine, scene)
        if judged is None:
            print(f"skipped {name}: {problem or 'out of time'}", flush=True)
        else:
            out.append(judged)
    return out


def compare(records, options, engine, scene: Judged, names: list[str]) -> list[dict]:
    """A row for each choice, medians over the seeds."""
    job = Job(str(scene.blend), "", 1, 1, options.threads, caustics=True, width=scene.width, settings=HYBRID)
    pace = runs.pace(records, options.cache, engine, job)
    if pace is None:
        return []
    samples = pace.samples(options.seconds)
    found: dict[str, list[dict]] = {name: [] for name in names}
    for seed in range(1, options.seeds + 1):
        for name in names:
            own = replace(job, samples=samples, seed=seed, settings=VARIANTS[name])
            run = runs.measured(records, options.cache, engine, own)
            if run:
                figures = scene.evaluate(exr.load(Path(run["path"])))
                found[name].append({**figures, "cpu": run["cpu"], "samples": samples})
    return relative(
        [
            {"scene": scene.name, "choice": name, "runs": len(values), **peer_scenes.medians(values)}
            for name, values in found.items()
            if values
        ]
    )


def relative(rows: list[dict]) -> list[dict]:
    """Adds the cost over the default's."""
    base = next((row for row in rows if row["choice"] == "default"), None)
    for row in rows if base else []:
        for key, figure in (("cost", "relmse"), ("cost_caustic", "relmse_caustic")):
            row[key] = row[figure] * row["cpu"] / (base[figure] * base["cpu"])
    return rows


def judge(rows: list[dict]) -> list[result.Verdict]:
    """Large lamps: PTPPM never above PT. Elsewhere: no choice beats the default by over 10 %."""
    out = []
    for row in rows:
        if row.get("cost") is None or row["choice"] == "default":
            continue
        if row["choice"] == "PT" and row["scene"] in SOFT:
            over = 1.0 / row["cost"]
            claim = f"{row['scene']}: under its large lamps PTPPM is not above PT"
            holds = over <= 1.0 + verdicts.TIE
            out.append(result.Verdict(claim, "bench", holds, f"relMSE · CPU s {over:.2f} of PT's"))
        elif min(row["cost"], row["cost_caustic"]) < 1.0 - verdicts.TIE:
            costs = f"{row['cost']:.2f} of the default's cost, {row['cost_caustic']:.2f} in the caustics"
            claim = f"{row['scene']}: the default is as good as `{row['choice']}`"
            out.append(result.Verdict(claim, "bench", False, f"{costs}, energy {row['energy']:.4f}"))
    return out


def run(options, found) -> int:
    engine = runs.engine_of(found)
    records = common.records_of(options, "choices")
    options.seconds = options.seconds or (8.0 if options.full else 2.0)
    options.seeds = options.seeds or (3 if options.full else 1)
    names, rows = options.choices.split(","), []
    for scene in scenes(records, options, engine):
        rows += compare(records, options, engine, scene, names)
        print(f"   {scene.name}: done", flush=True)
    out = result.Result(
        "choices", "One setting of PTPPM changed at a time", "./scripts/bench choices --full", not options.full
    )
    out.tables = [result.Table("choices", "Equal samples; under 1 beats the default", titles.columns(COLUMNS), rows)]
    out.verdicts = judge(rows)
    out.versions = {"cardioid-render": engine.stamp()}
    return outcome.finish(out, options, records)
