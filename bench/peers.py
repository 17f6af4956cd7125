# SPDX-License-Identifier: GPL-3.0-or-later
"""Ours (PTPPM, default settings) beside the products that an artist would take instead, at equal CPU seconds."""

from __future__ import annotations

import sys
from pathlib import Path

from . import peer_scenes, products, runs, store

COLUMNS = {"scene": "", "mark": "g", "product": "", "runs": "d", "cpu": ".1f", "samples": ".0f"}
COLUMNS |= peer_scenes.COLUMNS | {"relmse_trim": ".5f", "flip": ".4f"}
FIGURES = ("relmse", "relmse_caustic")
OURS, GOAL = "cardioid", "mi_split"


def add_arguments(commands) -> None:
    parser = commands.add_parser("peers", help="PTPPM against Cycles, LuxCore and Mitsuba at equal CPU seconds")
    peer_scenes.add_argument(parser)
    parser.add_argument("--marks", default="30,120", help="CPU seconds (%(default)s)")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument(
        "--products", default="cardioid,lux_pgi,cycles34,cycles5,mi_path", help="%(default)s; mi_split can be added"
    )


def usable(names: list[str]) -> dict[str, products.Product]:
    """The products asked for that can run here; the others are left out with a line."""
    found, out = products.available(), {}
    for name in names:
        if name not in found:
            sys.exit(f"no product named {name}; there are {', '.join(found)}")
        problem = found[name].problem()
        if problem:
            print(f"left out {name}: {problem}", flush=True)
        else:
            out[name] = found[name]
    return out


def interleaved(names: list[str], seed: int) -> list[str]:
    """The order of a round: every product is first in one of them."""
    turn = (seed - 1) % len(names)
    return names[turn:] + names[:turn]


def recorded_rows(folder: Path, scene: str, mark: float) -> list[dict]:
    """What the folder itself records, under names of their own: one seed, another machine."""
    names = {"relmse": "relmse_all", "rmse": "rmse_all", "energy": "ratio_all", "relmse_trim": "relmse_trim_all"}
    names |= {"relmse_caustic": "relmse_caustic", "rmse_caustic": "rmse_caustic", "energy_caustic": "ratio_caustic"}
    names |= {"cpu": "cpu", "samples": "spp"}
    rows = []
    for peer, record in peer_scenes.recorded(folder, scene, mark).items():
        row = {"scene": scene, "mark": mark, "product": f"{peer} (recorded)", "runs": 1}
        rows.append(row | {key: record[of] for key, of in names.items()})
    return rows


def judge(rows: list[dict], rivals: list[str]) -> list[str]:
    """Ours against every rival, against the goal, and its energy, at each mark of each scene."""
    out = []
    for own in (row for row in rows if row["product"] == OURS):
        here = [row for row in rows if (row["scene"], row["mark"]) == (own["scene"], own["mark"]) and row is not own]
        name = f"{own['scene']}, {own['mark']:g} CPU s"
        for figure, what in zip(FIGURES, ("whole", "caustic")):
            group = [row for row in here if row["product"] in rivals]
            if group:
                best = min(group, key=lambda row: row[figure])
                word = "met" if own[figure] < best[figure] else "missed"
                ratio = own[figure] / best[figure]
                out.append(f"{name}, {what}: {ratio:.2f} of the best rival's relMSE ({best['product']}): {word}")
            for row in here:
                if row["product"].startswith(GOAL):
                    word = "met" if own[figure] <= row[figure] else "missed"
                    ratio = own[figure] / row[figure]
                    out.append(f"{name}, {what}: {ratio:.2f} of {row['product']}'s relMSE: goal {word}")
        if abs(own["energy"] - 1) > 0.01:
            out.append(f"{name}: our energy differs from the reference by {own['energy'] - 1:+.2%}")
    return out


def run(options, found) -> int:
    engine = runs.engine_of(found)
    marks = sorted(float(mark) for mark in options.marks.split(","))
    records = store.Store(options.cache / "peers.jsonl", options.budget)
    setup = products.Setup(records, options.cache.resolve(), options.peers.resolve(), engine, options.threads)
    scenes = peer_scenes.load_all(setup.peers, options.scene)
    chosen = usable(options.products.split(","))
    figures: dict[tuple[str, float, str], list[dict]] = {}
    for mark in marks:
        for seed in range(1, options.seeds + 1):
            for scene in scenes:
                for name in interleaved(list(chosen), seed):
                    measure_one(setup, chosen, name, scene, seed, mark, figures)
    rows = []
    for (scene, mark, name), values in figures.items():
        row = {"scene": scene, "mark": mark, "product": name, "runs": len(values)}
        rows.append(row | peer_scenes.medians(values))
    for scene, mark in dict.fromkeys((row["scene"], row["mark"]) for row in rows):
        rows += recorded_rows(setup.peers, scene, mark)
    rows.sort(key=lambda row: (row["scene"], row["mark"], "recorded" in row["product"], row["relmse"]))
    store.publish(rows, COLUMNS, options.cache / "peers")
    for note in judge(rows, [name for name, product in chosen.items() if product.rival]):
        print(note)
    return 0 if rows else 1


def measure_one(setup, chosen, name, scene, seed, mark, figures) -> None:
    """One run into `figures`; a product that fails is left out from here on."""
    product = chosen.get(name)
    if product is None:
        return
    try:
        done = product.render(setup, scene, seed, mark)
    except RuntimeError as error:
        print(f"left out {name}: {error}", flush=True)
        del chosen[name]
        return
    if done is None:
        return
    values = scene.evaluate(peer_scenes.load_picture(Path(done["path"])))
    figures.setdefault((scene.name, mark, name), []).append({**values, "cpu": done["cpu"], "samples": done["samples"]})
    said = f"{done['cpu']:.1f} CPU s, relMSE {values['relmse']:.5f}, caustic {values['relmse_caustic']:.5f}"
    print(f"   {scene.name}, {name}, seed {seed}: {said}", flush=True)
