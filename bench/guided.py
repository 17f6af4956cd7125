# SPDX-License-Identifier: GPL-3.0-or-later
"""What guided emission and the balance of the two halves are worth, each on and off at equal samples.

Guided emission is judged by photons at a fixed number of them (`half`: half a photon a pixel and sample), and by time
as users have it, with the number that balance chooses (`auto`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from . import exr, metrics, peer_scenes, reference, runs
from .engines import Job
from .result import Verdict

SCENES = ("pool_sun", "open_plane", "twelve_lamps")
COLUMNS = {"scene": "", "photons": "", "guided": "", "runs": "d", "samples": "d", "cpu": ".2f", "emitted": ".3e"}
COLUMNS |= {"gathered_per_emitted": ".3f", "relmse": ".5f", "relmse_caustic": ".5f", "relmse_C1": ".5f"}
COLUMNS |= {"relmse_trim": ".5f", "relmse_C1_trim": ".5f"}
COLUMNS |= {"rmse": ".4f", "energy": ".4f", "energy_caustic": ".4f", "reference": ".1%"}
FIGURES = ("relmse_trim", "relmse", "relmse_caustic", "relmse_C1_trim")
"""The first decides: in the others a handful of pixels may hold most of the error."""
MORE_GATHERED, SLOWER = 5.0, 1.05
PARTS = 4


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


@dataclass
class Truth:
    """What pictures are compared with. `own`: its own expected relMSE by figure, which is taken off the measured."""

    mean: np.ndarray
    c1: np.ndarray
    mask: np.ndarray
    own: dict[str, float]

    def evaluate(self, run: dict) -> dict[str, float]:
        """Errors of the whole picture, of pixels with caustics, and of what photons alone bring: the pass C1, over the
        whole picture's brightness."""
        image, c1 = exr.load(Path(run["path"])), exr.load(Path(run["path"]), "C1")
        out = metrics.evaluate(image, self.mean)
        squares = metrics.relative_squares(self.mean - self.c1 + c1, self.mean)
        out |= {"relmse_C1": float(squares.mean()), "relmse_C1_trim": metrics.trimmed(squares)}
        if self.mask.any():
            out |= {f"{key}_caustic": value for key, value in metrics.evaluate(image, self.mean, self.mask).items()}
        out["reference"] = self.own["relmse"] / out["relmse"]
        for name in self.own:
            out[name] = max(out[name] - self.own[name], 1e-9)
        photons = run["stats"]["photons"]
        out |= {"cpu": run["cpu"], "emitted": photons["emitted"], "samples": run["stats"]["samples"]}
        out["gathered_per_emitted"] = photons["gathered"] / max(photons["emitted"], 1)
        return out


def truth(parts: np.ndarray, c1: np.ndarray, mask: np.ndarray) -> Truth:
    """From independent pictures and their C1 passes, (n, h, w, 3) each."""
    r = parts.mean(0).mean(-1)
    scatter = {
        name: stack.mean(-1).var(0, ddof=1) / len(stack) / (r * r + metrics.EPSILON)
        for name, stack in (("relmse", parts), ("relmse_C1", c1))
    }
    own = {name: float(values.mean()) for name, values in scatter.items()}
    own |= {f"{name}_trim": metrics.trimmed(values) for name, values in scatter.items()}
    if mask.any():
        own["relmse_caustic"] = float(scatter["relmse"][mask].mean())
    return Truth(parts.mean(0), c1.mean(0), mask, own)


def make_truth(records, options, engine, scene, job: Job) -> Truth | None:
    """Half of it guided and half of it not, so that neither side is its own judge."""
    samples = runs.FIRST_SAMPLES + runs.whole_passes(job.samples * options.reference / (2 * PARTS) - runs.FIRST_SAMPLES)
    paths: list[Path] = []
    for number, guided in enumerate(("yes", "no")):
        own = replace(job, samples=samples, settings=variants(scene)["auto", guided])
        first = reference.FIRST_SEED + number * PARTS
        half = reference.make(records, options.cache, engine, scene.name, own, PARTS, first)
        if half is None or half.parts < PARTS:
            return None
        paths += half.paths
    parts, c1 = (np.array([exr.load(path, layer) for path in paths], np.float64) for layer in ("", "C1"))
    return truth(parts, c1, caustic_mask(paths))


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
    made, rows = make_truth(records, options, engine, scene, job), []
    if made is None:
        return []
    for (photons, guided), values in found.items():
        if values:
            row = {"scene": scene.name, "photons": photons, "guided": guided, "runs": len(values)}
            row |= peer_scenes.medians([made.evaluate(run) for run in values])
            rows.append(row | {"samples": job.samples})
    return rows


def judge(rows: list[dict]) -> list[Verdict]:
    """The bars: 5 times the gathered photons per emitted one at equal error or less; never slower beyond 5 %."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        by = {(row["photons"], row["guided"]): row for row in rows if row["scene"] == scene}
        more_claim = (
            f"{scene}: guided emission gathers {MORE_GATHERED:g} times the photons per emitted one, errs no more"
        )
        if len(by) < 4:
            out.append(Verdict(more_claim, "bench", None, "out of time; run the command again to go on"))
            continue
        on, off = by["half", "yes"], by["half", "no"]
        more = on["gathered_per_emitted"] / max(off["gathered_per_emitted"], 1e-12)
        error, own = on["relmse_trim"] / off["relmse_trim"], on["relmse_C1_trim"] / off["relmse_C1_trim"]
        figures = f"{more:.1f} times at {error:.2f} of the trimmed relMSE ({own:.2f} of that of C1)"
        out.append(Verdict(more_claim, "bench", more >= MORE_GATHERED and max(error, own) <= 1.0, figures))
        auto = by["auto", "yes"]
        for what, a, b in (("guided emission", auto, by["auto", "no"]), ("balance", auto, on)):
            times = {key: a[key] * a["cpu"] / (b[key] * b["cpu"]) for key in FIGURES if key in a}
            figures = "share of the time: " + ", ".join(
                f"{value:.2f} to the same {key}" for key, value in times.items()
            )
            claim = f"{scene}: with {what} the same error never takes more than {SLOWER:g} of the time"
            out.append(Verdict(claim, "bench", times[FIGURES[0]] <= SLOWER, figures))
    return out
