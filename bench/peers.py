# SPDX-License-Identifier: GPL-3.0-or-later
"""Ours (PTPPM, default settings) beside the products that an artist would take instead, at equal CPU seconds."""

from __future__ import annotations

import sys
from pathlib import Path

from . import exr, outcome, peer_scenes, peers_figures, products, result, runs, titles, verdicts
from . import options as common
from .progress import Progress

MARKS, FULL_MARKS = "12", "30,120"
COLUMNS = {"scene": "", "mark": "g", "title": "", "runs": "d", "cpu": ".1f", "cpu_process": ".1f", "samples": ".3g"}
COLUMNS |= {"relmse": ".5f", "relmse_trim": ".5f", "relmse_caustic": ".5f", "flip": ".4f"}
COLUMNS |= {"energy": ".4f", "energy_caustic": ".4f", "reference": ".1%"}
NOTE = (
    "`CPU s`: user and system seconds of the whole process less those of a run with one sample and without preparation "
    "for caustics, for every renderer; `whole process` has them all. `trimmed`: without the 0.1 % largest values. "
    "`reference's own share`: its own squared error over the measured one. Median of the seeds."
)
PICTURES = (
    "Pictures: one exposure a scene (the reference's 80 % quantile at half of white), a shoulder above 0.7 of white, "
    "sRGB's curve; no denoising but where the name says it. Lamps of Cycles and Cardioid are not seen by the camera, "
    "those of the others are: pixels that show one are compared in no figure."
)
FIGURES = {"relmse": "whole picture", "relmse_caustic": "caustics"}
REDUCED = (
    *("cardioid", "cardioid_filtered", "cycles34_default", "cycles34", "cycles34_shadow"),
    *("luxcore_default", "luxcore", "luxcore_bidir", "mitsuba", "mitsuba_particles"),
)
WHEEL_MODES = ("default", "path", "guided", "denoised")
"""Of the newest Blender at hand; --full takes all of all."""
NOT_RIVALS = ("mitsuba_split",)
"""Only by name: the method of the references."""


def add_arguments(commands) -> None:
    parser = commands.add_parser("peers", help="PTPPM against Cycles, LuxCore and Mitsuba at equal CPU seconds")
    peer_scenes.add_argument(parser)
    parser.add_argument("--marks", default="", help=f"CPU seconds ({MARKS}, or {FULL_MARKS} with --full)")
    parser.add_argument("--seeds", type=int, default=0, help="renders of each (1, or 3 with --full)")
    names = ", ".join(products.available())
    parser.add_argument("--products", default="", metavar="NAMES", help=f"of {names}")


def wanted(options, found: dict[str, products.Product]) -> list[str]:
    """The products asked for. Ends the program for a name that is none."""
    if options.products:
        names = options.products.split(",")
        for name in names:
            if name not in found:
                sys.exit(f"no product named {name}; there are {', '.join(found)}")
        return names
    if options.full:
        return [name for name in found if name not in NOT_RIVALS]
    wheels = [name for name in found if name.startswith("cycles") and not name.startswith("cycles34")]
    ready = [name for name in wheels if not found[name].problem()] or wheels
    newest = ready[-1].split("_")[0] if ready else ""
    chosen = [f"{newest}_{mode}".removesuffix("_path") for mode in WHEEL_MODES if newest]
    return [*REDUCED, *chosen]


def usable(names: list[str], found: dict[str, products.Product], missing: list[str]) -> dict[str, products.Product]:
    """Those that can run here; why the others cannot goes into `missing`."""
    out = {}
    for name in names:
        problem = found[name].problem()
        if problem:
            leave_out(found[name].title, problem, missing)
        else:
            out[name] = found[name]
    return out


def leave_out(title: str, why: str, missing: list[str]) -> None:
    print(f"left out {title}: {why}", flush=True)
    missing.append(f"{title}: {why}")


def interleaved(names: list[str], seed: int) -> list[str]:
    """The order of a round: every product is first in one of them."""
    turn = (seed - 1) % len(names)
    return names[turn:] + names[:turn]


def measure_all(setup, chosen, scenes, marks, seeds: int, missing: list[str]) -> dict[tuple, list[dict]]:
    """Figures by (scene, mark, product), one a seed. A product that fails is left out from there on."""
    figures: dict[tuple, list[dict]] = {}
    steps = sum(product.suits(scene) for product in chosen.values() for scene in scenes) * len(marks) * seeds
    progress = Progress(steps, setup.records)
    for mark in marks:
        for seed in range(1, seeds + 1):
            for scene in scenes:
                for name in interleaved(list(chosen), seed):
                    if name in chosen and chosen[name].suits(scene):
                        progress.step(f"{scene.name}, {chosen[name].title}, {mark:g} CPU s, seed {seed}")
                        one = measure_one(setup, chosen, name, scene, seed, mark, missing)
                        if one:
                            figures.setdefault((scene.name, mark, name), []).append(one)
    return figures


def measure_one(setup, chosen, name: str, scene, seed: int, mark: float, missing: list[str]) -> dict | None:
    """A run's figures; None: out of time, or it failed and is no more among the chosen."""
    try:
        done = chosen[name].render(setup, scene, seed, mark)
    except RuntimeError as error:
        leave_out(chosen[name].title, " ".join(str(error).split()), missing)
        del chosen[name]
        return None
    if done is None:
        return None
    found = done | scene.evaluate(exr.load(Path(done["path"])))
    said = f"relMSE {found['relmse']:.5f}, caustic {found['relmse_caustic']:.5f}, energy {found['energy']:.3f}"
    print(f"   {found['cpu']:.1f} CPU s, {said}", flush=True)
    return found


def rows_of(figures: dict[tuple, list[dict]], known: dict[str, products.Product]) -> list[dict]:
    rows = []
    for (scene, mark, name), values in figures.items():
        product = known[name]
        row = {"scene": scene, "mark": mark, "product": name, "title": product.title, "filtered": product.filtered}
        rows.append(row | {"ours": product.ours, "runs": len(values)} | peer_scenes.medians(values))
    return sorted(rows, key=lambda row: (row["scene"], row["mark"], row["relmse"]))


def judge(rows: list[dict]) -> list[result.Verdict]:
    """Ours against the best of the others, unfiltered with unfiltered, filtered with filtered, at each mark of each
    scene. A verdict holds where ours has the lower error."""
    out = []
    for own in (row for row in rows if row["ours"]):
        same = [row for row in rows if all(row[key] == own[key] for key in ("scene", "mark", "filtered"))]
        rivals = [row for row in same if not row["ours"] and row["product"] not in NOT_RIVALS]
        if not rivals:
            continue
        for figure, where in FIGURES.items():
            best = min(rivals, key=lambda row: row[figure])
            kind = " of all that filter" if own["filtered"] else ""
            claim = f"{own['scene']}, {where}: {own['title']} has the lowest relMSE{kind} at {own['mark']:g} CPU s"
            holds = own[figure] < best[figure]
            said = [told(row, figure) for row in (own, best)]
            out.append(result.Verdict(claim, "equal time", holds, f"{said[0]}; the best rival: {said[1]}"))
    return out


def told(row: dict, figure: str) -> str:
    energy = "energy_caustic" if figure.endswith("caustic") else "energy"
    return f"{row['title']} {row[figure]:.5f} (energy {row[energy]:.3f}, {row['cpu']:.1f} CPU s)"


def energies(rows: list[dict]) -> list[result.Verdict]:
    own = [row | {"method": row["product"]} for row in rows if row["product"] == "cardioid"]
    return [verdicts.energies(own, "cardioid")] if own else []


def run(options, found) -> int:
    engine = runs.engine_of(found)
    words = options.marks or (FULL_MARKS if options.full else MARKS)
    marks = sorted(float(mark) for mark in words.split(","))
    seeds = options.seeds or (3 if options.full else 1)
    records = common.records_of(options, "peers")
    setup = products.Setup(records, options.cache.resolve(), engine, options.threads)
    scenes = peer_scenes.load_all(options.peers, options.scene)
    known, missing = products.available(), []
    chosen = usable(wanted(options, known), known, missing)
    titled = dict(chosen)
    figures = measure_all(setup, chosen, scenes, marks, seeds, missing)
    rows = rows_of(figures, known)
    made = result.Result("peers", "Beside other renderers, at equal CPU seconds", "./scripts/bench peers --full", False)
    made.reduced, made.missing = not options.full, missing
    title = "Error, energy and CPU seconds on the thesis's three scenes"
    made.tables = [result.Table("peers", title, titles.columns(COLUMNS), rows, NOTE)]
    seen = [row | {"method": row["title"]} for row in rows]
    made.verdicts = [*judge(rows), *energies(rows), *verdicts.references(seen)]
    made.settings = {product.title: product.words for product in titled.values()} | {"Pictures": PICTURES}
    made.versions = {known[key[2]].title: values[0]["version"] for key, values in figures.items()}
    peers_figures.add(made, outcome.place(made, options).parent, scenes, figures, rows, known)
    return outcome.finish(made, options, records)
